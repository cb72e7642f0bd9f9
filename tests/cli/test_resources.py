# test_resources.py: a small stack, few open files and a full disk: the program works or states the missing resource.
import re
import resource
import subprocess

from harness import Case, PROGRAM
from test_limits import SANITIZED


class Resources(Case):
    def limited(self, kind, limit, *words):
        def apply():
            resource.setrlimit(kind, (limit, resource.getrlimit(kind)[1]))
        return subprocess.run([PROGRAM, *words], cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True, preexec_fn=apply, timeout=60)

    def test_small_stack(self):
        """Threads of programs that use the library may have a small stack. Every command works with 256 kB."""
        if SANITIZED:
            self.skipTest("sanitizers take more of the stack")
        runs = [line.split() for line in """
            render cube.obj -s 32 -o a.png
            render teapot -s 64 --wireframe -o a.png
            render teapot -s 64 --edges all --samples 4 -o a.jpg
            render cube.obj -s 32 --shadows --ground shadow --ao rays --environment studio --material gold -o a.exr
            render cube.ply -s 32 --ao screen --isa scalar -o a.webp
            render cube.obj cube.ply --views front,left --sizes 16,32 -o a/{stem}{ext}-{view}-{size}.png
            render cube.obj --turntable 3 -s 16 -o turn.webp
            render cube.obj -s 16 --config settings.json -o set.png
            config
            batch cube.obj cube.stl -s 16 -o b/{stem}{ext}.png
            batch cube.obj cube.stl -s 16 --isolate -o c/{stem}{ext}.png
            journal b/lambent.jsonl
            sheet cube.obj cube.stl -s 16 -o contact.png
            compare cube.obj -s 32 -o sheet.png
            compare cube.obj -s 32 -o sheet.svg
            explain cube.obj 16,16 -s 32 -o figure.png
            info cube.obj
            check --list
            shader cube.obj
            diff a/cubeobj-front-16.png a/cubeply-front-16.png --tolerance 255
            diff cube.obj cube.obj -s 16 -o diff.html
            hash cube.obj cube.stl -s 16 -o p.hash --pictures kept
            hash --check p.hash -s 16 --update
            convert cube.obj c.glb --thumbnail
            convert cube.obj c.obj
            convert cube.obj c.ply
            convert cube.obj c.stl
            convert cube.obj c.3mf
            plot attenuation -o plot.png
            exercises --count 1 -o class/
            lights cube.obj
            shape --parametric x=u;y=v;z=0 -o shape.obj
            view --help
            shapes
            formats
            looks studio
            materials -s 16 -o materials.png
            devices
            help shading
            complete -- rend
            generate markdown""".strip().splitlines()]
        (self.folder / "settings.json").write_text('{"shadows": true, "image": {"background": "white"}}')
        listed = re.search(r"\nCommands:\n(.*?)\n\n", self.good("help").stdout.decode(), re.S)[1]
        self.assertEqual({words[0] for words in runs} - {"render"}, set(re.findall(r"(?m)^  (\w+)", listed)))
        for words in runs:
            done = self.limited(resource.RLIMIT_STACK, 256 << 10, *words)
            self.assertEqual(done.returncode, 0, (words, done.stderr))

    def test_few_files(self):
        """If no further file can be opened, the error message states this, and names neither the sandbox nor a permission."""
        self.good("cube.obj", "-s", 16, "-o", "a.png")
        for words in (["cube.obj", "-s", "16", "-o", "b.png"], ["info", "cube.obj"], ["compare", "cube.obj", "-s", "16", "-o", "c.png"], ["diff", "a.png", "a.png"],
                      ["batch", "cube.obj", "cube.stl", "-s", "16", "-o", "b/{stem}{ext}.png"],
                      ["batch", "cube.obj", "cube.stl", "-s", "16", "--isolate", "--journal", "none", "-o", "b/{stem}{ext}.png"]):
            codes = set()
            for limit in range(4, 14):
                done = self.limited(resource.RLIMIT_NOFILE, limit, *words)
                codes.add(done.returncode)
                if done.returncode:
                    errors = [line for line in done.stderr.decode().splitlines() if line.startswith("lambent: ")]
                    self.assertTrue(errors)
                    for line in errors:
                        self.assertIn("Too many open files", line, (limit, words))
            self.assertGreater(len(codes), 1, words)
            self.assertIn(0, codes, words)

    # --- a full disk

    def files(self):
        return {path.name for path in (self.folder / "out").iterdir()}

    def test_full_disk_at_the_start(self):
        (self.folder / "out").mkdir()
        (self.folder / "out" / "lambent.jsonl").symlink_to("/dev/full")
        self.bad(5, "batch", "cube.obj", "-s", 16, "--resume", "-o", "out/{stem}.png", "--journal", "out/lambent.jsonl", says="lambent.jsonl: cannot write: No space left on device", leaves={"out"})
        self.assertEqual(self.files(), {"lambent.jsonl"})
        # Models that a killed run was drawing are recorded until the next run begins.
        running = self.folder / "out" / "lambent.jsonl.running"
        running.write_bytes(bytes(8192))
        self.bad(5, "batch", "cube.obj", "-s", 16, "--resume", "-o", "out/{stem}.png", "--journal", "out/lambent.jsonl", says="No space left on device", leaves={"out"})
        self.assertEqual(running.read_bytes(), bytes(8192))

    def test_full_disk_later(self):
        """If the journal cannot be extended, the run ends and leaves no FILE.running."""
        for i in range(100):
            (self.folder / f"{i}.obj").write_bytes((self.folder / "cube.obj").read_bytes())
        words = "batch . -s 8 -j 2 -o out/{stem}{ext}.png"
        script = f'ulimit -f 20; trap "" XFSZ; exec "{PROGRAM}" {words}'  # kilobytes per file
        done = subprocess.run(["bash", "-c", script], cwd=self.folder, capture_output=True, timeout=60)
        self.assertEqual(done.returncode, 5, done.stderr)
        self.assertIn(b"lambent.jsonl: cannot write: File too large", done.stderr)
        self.assertIn("lambent.jsonl", self.files())
        self.assertNotIn("lambent.jsonl.running", self.files())
        self.good(*words.split(), "--resume")
        self.assertEqual(self.files(), {"lambent.jsonl", "cubeobj.png", "cubeply.png", "cubestl.png", *(f"{i}obj.png" for i in range(100))})
