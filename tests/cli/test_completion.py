# test_completion.py: the completions of the shells: the underlying command, and each shell as users see
# it.
import os
import pty
import re
import select
import shutil
import subprocess
import time
import unittest

from harness import PROGRAM, Case


class Words(Case):
    def words(self, *words):
        """The candidates for the last word."""
        lines = self.good("complete", "--", *words).stdout.decode().splitlines()
        return [line.split("\t")[0] for line in lines]

    def test_first_word(self):
        found = self.words("")
        shapes = [line.split()[0] for line in self.good("shapes").stdout.decode().splitlines()]
        for word in ("render", "compare", "generate", *shapes, ":files"):
            self.assertIn(word, found)
        self.assertEqual(self.words("te"), ["teapot", ":files"])
        self.assertEqual(self.words("compare", "te"), ["teapot", ":files"])
        self.assertEqual(self.words("explain", "teapot", ""), [])
        self.assertEqual(self.words("diff", "a"), [":files"])
        self.assertEqual(self.words("plot", ""), ["attenuation", "spot", "highlight", "lambert", "fresnel", "tone", "depth", "lobe"])
        self.assertEqual(self.words("generate", "b"), ["bash"])
        self.assertEqual(self.words("shapes", ""), [])
        self.assertEqual(self.words("help", "exit"), ["exit-codes"])
        self.assertIn("crease-angle", self.words("help", ""))
        self.assertEqual(len(self.words("help", "")), len(set(self.words("help", ""))))

    def test_every_option(self):
        """The command's own options and no others; its help lists every one of them."""
        for command in ("render", "compare", "check", "diff", "plot", "shader", "lights", "materials"):
            rows, _, shared = self.good(command, "--help").stdout.decode().partition("\nShared with ")
            options = set(re.findall(r"(?m)^  (?:-\w, |    )(--[a-z][a-z0-9-]*)", rows))
            options |= set(re.findall(r"--[a-z][a-z0-9-]*", shared.partition(":\n")[2]))
            self.assertEqual(set(self.words(command, "-")), options, command)
        self.assertEqual(self.words("--crea"), ["--crease-angle"])
        self.assertEqual(self.words("teapot", "--shading", "flat", "--crea"), ["--crease-angle"])
        self.assertEqual(self.words("--", "--crea"), [":files"])  # a file of that name

    def test_values(self):
        names = [line.split()[0] for line in self.good("materials").stdout.decode().splitlines() if len(line.split()) == 11]
        self.assertEqual(len(names), 24)
        found = self.words("--material", "")
        for word in (*names, "red", "orange", "shininess=", "kd=", "color=", "specular_color=", "fibre="):
            self.assertIn(word, found)
        for words, wanted in ((("--material", "gol"), ["gold"]), (("--material", "gold,shi"), ["gold,shininess="]),
                              (("--back-material", "diffuse=or"), ["diffuse=orange"]), (("--material", "color=na"), ["color=navy"]),
                              (("--material", "gold@"), []), (("--material", "fibre="), ["fibre=yes", "fibre=no"]),
                              (("--light", "po"), ["point", "point:"]), (("--light", "+po"), ["+point", "+point:"]),
                              (("--light", "no"), ["none"]), (("--light", "spot:cut"), ["spot:cutoff="]),
                              (("--light", "point:cut"), []), (("--light", "hemisphere:sk"), ["hemisphere:sky="]),
                              (("--light", "spot:position=1/2/3,fr"), ["spot:position=1/2/3,frame="]),
                              (("--light", "spot:frame=c"), ["spot:frame=camera"]), (("--light", "point:color=na"), ["point:color=navy"]),
                              (("--camera", "eye=1/2/3,fo"), ["eye=1/2/3,fovy="]), (("--view", "to"), ["top"]), (("--up", "-"), ["-x", "-y", "-z"]),
                              (("--shading=fl",), ["--shading=flat"]), (("--shading=",), ["--shading=" + w for w in ("flat", "gouraud", "smooth", "phong", "normal")]),
                              (("--color", "na"), ["navy"]), (("-b", "tr"), ["transparent"]), (("--show", "light"), ["light:"]),
                              (("--environment", "st"), ["studio", ":files"]), (("-o", "x"), [":files"]), (("--output=x",), [":files"]),
                              (("--size", ""), []), (("compare", "x.obj", "--across", "view=f"), ["view=front"]),
                              (("compare", "--across", "color=red,na"), ["color=red,navy"]), (("compare", "--across", "crea"), ["crease-angle="]),
                              (("--sweep", "azi"), ["azimuth="]), (("--sweep", "light.e"), ["light.elevation="]), (("--sweep", "metal"), ["metallic="]),
                              (("compare", "--sheet", "te"), ["terms"]), (("--sheet", "te"), []), (("--font=",), [])):
            self.assertEqual(self.words(*words), wanted, words)

    def test_candidates_are_right(self):
        """Every value that the completion offers is accepted."""
        options = self.words("-")
        needs = {"--turntable-light": ["--turntable", 2]}  # options that other options require
        tried = 0
        for option in options:
            for word in self.words(option + "="):
                word = word.removeprefix(option + "=")
                if word == ":files" or word[-1] in ":=" or option in ("--device", "--isa", "--texture-filter") or (option, word) in (("--show", "all"), ("--shard-by", "list")):
                    continue
                tried += 1
                self.assertNotEqual(self.run_program("sphere", "-s", 4, "-o", "-", option, word, *needs.get(option, ())).returncode, 1, (option, word))
        self.assertGreater(tried, 120)
        # A key is valid alone: the error names the wrong value, not the key.
        for option, start in (("--material", ""), ("--camera", ""), *(("--light", kind + ":") for kind in ("point", "spot", "directional", "hemisphere", "ambient"))):
            for key in self.words(option, start):
                if key.endswith("="):
                    done = self.run_program("cube.obj", option, key + "?")
                    self.assertNotIn(b"unknown key", done.stderr, (option, key))
                    self.assertNotIn(b"light has no", done.stderr, (option, key))


class Shells(Case):
    LINES = {"--material gol": "--material gold ", "--material gold,shi": "--material gold,shininess=", "--light spot:cu": "--light spot:cutoff=",
             "--light spot:cutoff=3,col": "--light spot:cutoff=3,color=", "--shading=fl": "--shading=flat ", "cube.o": "cube.obj ",
             "cube.obj --crea": "cube.obj --crease-angle ", "tea": "teapot ", "generate fi": "generate fish ", "-o my": "-o my\\ folder/"}

    def setUp(self):
        super().setUp()
        (self.folder / "my folder").mkdir()
        (self.folder / "bin").mkdir()
        os.symlink(PROGRAM, self.folder / "bin" / "lambent")
        self.environment = {**os.environ, "TERM": "dumb", "PATH": f"{self.folder}/bin:{os.environ['PATH']}", "HOME": str(self.folder), "PS1": "> "}

    def typed(self, shell, setup):
        """Returns the command lines after a tab key, in a terminal."""
        mine, its = pty.openpty()
        process = subprocess.Popen(shell, cwd=self.folder, stdin=its, stdout=its, stderr=its, env=self.environment, start_new_session=True)
        os.close(its)
        self.addCleanup(os.close, mine)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)

        def until(pattern):
            text, end = "", time.monotonic() + 20
            while not re.search(pattern, text) and time.monotonic() < end:
                if select.select([mine], [], [], 0.1)[0]:
                    text += os.read(mine, 65536).decode(errors="replace")
            return text
        os.write(mine, (setup + "; echo rea''dy\n").encode())
        until(r"ready\r?\n")
        for line, wanted in self.LINES.items():
            os.write(mine, f"lambent {line}\t".encode())
            text = until(re.escape(f"lambent {wanted}")).replace("\x07", "")
            self.assertIn(f"lambent {wanted}", text, (shell[0], line))
            os.write(mine, b"\x15")

    def test_bash(self):
        subprocess.run(["bash", "-n"], input=self.good("generate", "bash").stdout, check=True)
        self.typed(["bash", "--norc", "--noprofile", "-i"], "bind 'set bell-style none'; source <(lambent generate bash)")

    @unittest.skipUnless(shutil.which("zsh"), "no zsh")
    def test_zsh(self):
        self.typed(["zsh", "-f", "-i"], "unsetopt beep; autoload -U compinit; compinit -u -D; source <(lambent generate zsh)")
        # As a function of $fpath, as it is installed.
        (self.folder / "_lambent").write_bytes(self.good("generate", "zsh").stdout)
        self.typed(["zsh", "-f", "-i"], "unsetopt beep; fpath=($PWD $fpath); autoload -U compinit; compinit -u -D")

    @unittest.skipUnless(shutil.which("fish"), "no fish")
    def test_fish(self):
        (self.folder / "lambent.fish").write_bytes(self.good("generate", "fish").stdout)
        for line, wanted in self.LINES.items():
            done = subprocess.run(["fish", "--no-config", "-c", f"source lambent.fish; complete -C'lambent {line}'"], cwd=self.folder,
                                  env=self.environment, capture_output=True, check=True)
            found = [answer.split("\t")[0] for answer in done.stdout.decode().splitlines()]
            self.assertEqual(found, [wanted.split(" ", 1)[1].strip().replace("\\", "") if " " in wanted.strip() else wanted.strip()], line)
