# test_pull_requests.py: packaging/ci: the script in a repository of its own, called like GitHub and GitLab do.
import os
import re
import shutil
import subprocess

from harness import PROGRAM, ROOT, Case

CI = ROOT / "packaging" / "ci"


class PullRequests(Case):
    def setUp(self):
        super().setUp()
        if not shutil.which("git"):
            self.skipTest("git is missing")
        self.repository = self.folder / "repository"
        (self.repository / "models" / "sub").mkdir(parents=True)
        self.git("init", "--quiet", "--initial-branch", "main")
        for name in ("a.stl", "sub/b.stl", "gone.stl"):
            shutil.copy(self.folder / "cube.stl", self.repository / "models" / name)
        self.commit("models")
        self.git("checkout", "--quiet", "-b", "topic")

    def git(self, *words):
        """Git without the user's settings."""
        environment = {**os.environ, "GIT_CONFIG_GLOBAL": "/dev/null", "GIT_CONFIG_NOSYSTEM": "1"}
        done = subprocess.run(["git", "-c", "user.name=a", "-c", "user.email=a@b", *words], cwd=self.repository, env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def commit(self, message):
        self.git("add", "-A")
        self.git("commit", "--quiet", "-m", message)

    def change(self):
        self.good("shape", "torus", "-o", "repository/models/a.stl", "-q")
        self.good("shape", "cone", "-o", "repository/models/new.stl", "-q")
        os.remove(self.repository / "models" / "gone.stl")
        self.commit("change")

    def script(self, *words, code=0, cwd=None, **env):
        return self.shell([str(CI / "lambent-diff"), *words], code, cwd, env)

    def shell(self, command, code, cwd, env):
        environment = {k: v for k, v in os.environ.items() if not k.startswith(("GITHUB_", "LAMBENT_"))}
        environment.update({"LAMBENT": PROGRAM, **env})
        done = subprocess.run(command, cwd=cwd or self.repository, env=environment, capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertEqual(len(self.git("worktree", "list").splitlines()), 1)  # no files are left behind
        return done

    def test_changes(self):
        self.change()
        out = self.script("main", "models", "-s", "64", GITHUB_STEP_SUMMARY=str(self.folder / "summary.md")).stdout
        for line in ("changed  a.stl", "added    new.stl", "removed  gone.stl", "1 changed, 0 failed, 1 added, 1 removed, 1 equal"):
            self.assertIn(line, out)
            self.assertIn(line, (self.folder / "summary.md").read_text())
        page = (self.repository / "lambent-diff.html").read_text()
        self.assertEqual(page.count("<img"), 5)
        self.assertRegex(page, "<h1>models: [0-9a-f]{7,} and this branch</h1>")
        self.script("main", "models", "-s", "64", LAMBENT_FAIL="true", code=6)

    def test_names_that_are_markup(self):
        """Names stay within the block of the summary, each on one line."""
        name = "a\n```\n::error::x ````.stl"
        self.good("shape", "cone", "-o", "repository/models/new.stl", "-q")
        os.rename(self.repository / "models" / "new.stl", self.repository / "models" / name)
        self.commit("change")
        out = self.script("main", "models", "-s", "16", GITHUB_STEP_SUMMARY=str(self.folder / "summary.md")).stdout
        self.assertIn("added    a\\n```\\n::error::x ````.stl\n", out)
        lines = (self.folder / "summary.md").read_text().splitlines()
        self.assertEqual([i for i, line in enumerate(lines) if line.startswith("```")], [2, len(lines) - 1])
        self.assertEqual((lines[2], lines[-1]), ("`````", "`````"))

    def test_since_the_branch_left(self):
        """Later changes in the base are ignored."""
        self.git("checkout", "--quiet", "main")
        self.good("shape", "torus", "-o", "repository/models/a.stl", "-q")
        self.commit("main goes on")
        self.git("checkout", "--quiet", "topic")
        self.assertIn("0 changed, 0 failed, 0 added, 0 removed, 3 equal", self.script("main", "models", "-s", "32").stdout)

    def test_folders(self):
        """A folder below the current one, and a folder that does not exist in the base."""
        self.change()
        self.assertIn("1 equal", self.script("main", "sub", "-s", "32", cwd=self.repository / "models").stdout)
        self.git("mv", "models/sub", "fresh")
        self.commit("fresh")
        self.assertIn("1 added", self.script("main", "fresh/", "-s", "32").stdout)

    def test_failures(self):
        (self.repository / "models" / "bad.obj").write_text("nonsense")
        self.commit("bad")
        done = self.script("main", "models", "-s", "32", code=7)
        self.assertIn("failed   bad.obj", done.stdout)
        self.assertIn("models/bad.obj:1", done.stderr)
        self.assertIn("fetch-depth: 0", self.script("nothing", "models", code=1).stderr)
        self.assertIn("no such folder", self.script("main", "elsewhere", code=2).stderr)
        self.assertIn("expected a base and a folder", self.script("main", code=1).stderr)
        self.script("main", "models", "--no-such-option", code=1)

    def test_github(self):
        """The step of the action, run like GitHub does, with its inputs and environment."""
        self.change()
        text = (CI / "action.yml").read_text()
        step = text[text.index("- shell: sh"):text.index("- if: always()")]
        inputs = dict(re.findall(r"^  (\w+):\n    description: .*\n    default: \"?(.*?)\"?$", text, re.M), models="models", base="main", options="-s 64")
        self.assertEqual(sorted(inputs), ["base", "fail", "lambent", "models", "options", "report"])
        values = {"github.action_path": str(CI), "inputs.lambent": PROGRAM, **{f"inputs.{k}": v for k, v in inputs.items() if k != "lambent"}}
        env = {key: re.sub(r"\$\{\{ (.*?) \}\}", lambda m: values[m[1]], value) for key, value in re.findall(r"^        (\w+): (.*)$", step, re.M)}
        command = re.search(r"^      run: '(.*)'$", step, re.M)[1]
        self.assertIn("1 changed", self.shell(["sh", "-e", "-c", command], 0, None, env).stdout)
        self.assertTrue((self.repository / inputs["report"]).exists())

    def test_gitlab(self):
        self.change()
        text = (CI / "gitlab.yml").read_text()
        values = dict(re.findall(r"^    (\w+): \"?(.*?)\"?$", text[text.index("  variables:"):text.index("  script:")], re.M))
        lines = re.findall(r"^    - (.*)$", text[text.index("  script:"):text.index("  artifacts:")], re.M)
        self.git("clone", "--quiet", "--bare", ".", str(self.folder / "origin.git"))
        self.git("remote", "add", "origin", str(self.folder / "origin.git"))
        env = {**values, "LAMBENT": PROGRAM, "SCRIPT": str(CI / "lambent-diff"), "OPTIONS": "-s 64", "CI_MERGE_REQUEST_TARGET_BRANCH_NAME": "main"}
        self.assertIn("1 changed", self.shell(["bash", "-e", "-o", "pipefail", "-c", "\n".join(lines)], 0, None, env).stdout)
        kept = re.search(r"paths: \[(.*)\]", text)[1]
        self.assertEqual(kept, values["LAMBENT_REPORT"])
        self.assertTrue((self.repository / kept).exists())

    def test_container_file(self):
        """Each file that it copies is in the repository or is built by `make static`."""
        for name in re.findall(r"^COPY (?!--from)(\S+) ", (CI / "Containerfile").read_text(), re.M):
            self.assertTrue(name == "build-static/lambent" or (ROOT / name).is_file(), name)
