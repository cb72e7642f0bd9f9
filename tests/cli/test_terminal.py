# test_terminal.py: --term: pictures in a terminal, a pseudo-terminal that answers like kitty, xterm or foot.
import base64
import ctypes
import fcntl
import os
import pty
import re
import select
import signal
import struct
import subprocess
import termios
import unittest

from harness import PROGRAM, Case, pixel, read_png

QUERY = b"\x1b_Gi=31,s=1,v=1,a=q,t=d,f=24;AAAA\x1b\\"
ATTRIBUTES = b"\x1b[c"
KITTY = b"\x1b_Gi=31;OK\x1b\\\x1b[?62;c"
SIXEL = b"\x1b[?62;4;22c"
TEXT = b"\x1b[?62;22c"
HIDDEN = ("NO_COLOR", "TMUX", "KITTY_WINDOW_ID", "TERM_PROGRAM", "COLORTERM", "CI", "INSIDE_EMACS")


def has_chafa():
    try:
        return bool(ctypes.CDLL("libchafa.so.0"))
    except OSError:
        return False


def kitty_picture(text):
    """The PNG in kitty's sequences, and the keys of the first sequence."""
    parts = re.findall(rb"\x1b_G([^;]*);([A-Za-z0-9+/=]*)\x1b\\", text)
    assert parts
    for number, (keys, data) in enumerate(parts):
        keys = dict(item.split(b"=") for item in keys.split(b","))
        assert len(data) <= 4096 and (number == len(parts) - 1 or len(data) % 4 == 0)
        assert keys[b"m"] == (b"0" if number == len(parts) - 1 else b"1")
        assert number == 0 or set(keys) == {b"m"}
    first = dict(item.split(b"=") for item in parts[0][0].split(b","))
    return base64.b64decode(b"".join(data for _, data in parts), validate=True), first


def sixel_picture(text):
    """The picture in DCS q: width, height, and the colour (r, g, b) of each pixel; transparent pixels are missing."""
    body = re.search(rb'\x1bP[\d;]*q"1;1;(\d+);(\d+)(.*?)\x1b\\', text, re.S)
    width, height, rows = int(body[1]), int(body[2]), body[3].decode()
    colors, pixels, x, y, color = {}, {}, 0, 0, 0
    for number, defined, repeat, sign, move in re.findall(r"#(\d+)((?:;\d+){4})?|(?:!(\d+))?([?-~])|([$-])", rows):
        if number:
            color = int(number)
            if defined:
                kind, *rgb = map(int, defined[1:].split(";"))
                assert kind == 2
                colors[color] = tuple(round(c * 255 / 100) for c in rgb)
        elif move:
            x, y = 0, y + 6 * (move == "-")
        else:
            for _ in range(int(repeat or 1)):
                for bit in range(6):
                    if (ord(sign) - 63) >> bit & 1:
                        pixels[x, y + bit] = colors[color]
                x += 1
    return width, height, pixels


class Terminal(Case):
    def in_terminal(self, *words, answer=None, env=None, size=(80, 24, 800, 480), code=0, stdin=None, at_query=None):
        """The program's output to a terminal that answers the questions in this way; standard error is separate."""
        master, slave = pty.openpty()
        columns, rows, width, height = size
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, width, height))
        before = termios.tcgetattr(slave)
        environment = {k: v for k, v in os.environ.items() if k not in HIDDEN}
        environment.update({"TERM": "xterm-256color", **(env or {})})
        if answer:  # which arrives, even on a busy machine
            environment["LAMBENT_TERM_WAIT"] = "60000"
        process = subprocess.Popen([PROGRAM, *map(str, words)], cwd=self.folder, stdin=stdin or slave, stdout=slave, stderr=subprocess.PIPE,
                                   env=environment, start_new_session=True, preexec_fn=lambda: fcntl.ioctl(1, termios.TIOCSCTTY, 0))
        text, answered = b"", False
        try:
            while process.poll() is None or select.select([master], [], [], 0)[0]:
                if select.select([master], [], [], 0.05)[0]:
                    text += os.read(master, 65536)
                if text.endswith(ATTRIBUTES) and not answered:
                    answered = True
                    if at_query:
                        at_query(process, slave)
                    if answer:
                        os.write(master, answer)
            self.errors = process.stderr.read().decode()
            self.assertEqual(process.wait(), code, self.errors)
            self.assertEqual(termios.tcgetattr(slave), before, "the terminal's settings have changed")
            self.assertFalse(select.select([slave], [], [], 0)[0] and answer, "an answer was left for the shell")
        finally:
            process.kill()
            process.wait()
            process.stderr.close()
            os.close(master)
            os.close(slave)
        return text

    def test_kitty(self):
        """The terminal, recognised by its name or by its answer, gets the bytes of the file; the file is also written."""
        self.good("torus", "-s", 200, "-o", "named.png")
        want = (self.folder / "named.png").read_bytes()
        text = self.in_terminal("torus", "-s", 200, answer=KITTY)
        self.assertTrue(text.startswith(QUERY + ATTRIBUTES), text[:80])
        png, keys = kitty_picture(text[len(QUERY + ATTRIBUTES):])
        self.assertEqual(keys, {b"a": b"T", b"f": b"100", b"q": b"2", b"m": keys[b"m"]})
        self.assertTrue(png == want == (self.folder / "torus.png").read_bytes())
        self.assertIn("torus.png  200x200", self.errors)
        for env in ({"TERM": "xterm-kitty"}, {"KITTY_WINDOW_ID": "1"}, {"TERM_PROGRAM": "ghostty"}):
            text = self.in_terminal("torus", "-s", 200, env=env)
            self.assertNotIn(ATTRIBUTES, text)
            self.assertTrue(kitty_picture(text)[0] == want)

    def test_no_file(self):
        """-o - shows the picture, and writes neither a file nor raw PNG bytes."""
        text = self.in_terminal("torus", "-s", 200, "-o", "-", env={"TERM": "xterm-kitty"})
        self.assertTrue(kitty_picture(text)[0] == self.good("torus", "-s", 200, "-o", "-").stdout)
        self.assertEqual(self.new_files(), set())
        for env, answer in (({}, TEXT), ({"TERM": "dumb"}, None)):
            text = self.in_terminal("torus", "-o", "-", env=env, answer=answer, code=1)
            self.assertNotIn(b"PNG", text)
            self.assertIn("--term blocks", self.errors)
        self.assertEqual(self.new_files(), set())

    def test_size(self):
        """A picture larger than the window is scaled down by the terminal to fit both directions, above a line for the prompt."""
        for size, more in (((80, 24, 800, 480), (b"r", b"22")), ((20, 60, 200, 1200), (b"c", b"20")), ((80, 24, 0, 0), (b"r", b"22")),
                           ((300, 100, 3000, 2000), None)):
            _, keys = kitty_picture(self.in_terminal("torus", "-s", "1000", "--term", "kitty", size=size))
            self.assertEqual({k: v for k, v in keys.items() if k in (b"r", b"c")}, dict([more] if more else []), size)
        # If the window has no size in pixels, the terminal reports the size of a cell.
        text = self.in_terminal("torus", "-s", 300, size=(80, 24, 0, 0), answer=b"\x1b[6;40;20t" + KITTY)
        self.assertIn(b"\x1b[16t", text)
        self.assertNotIn(b"r", kitty_picture(text.split(ATTRIBUTES)[1])[1])
        _, keys = kitty_picture(self.in_terminal("torus", "-s", 500, size=(80, 24, 0, 0), answer=b"\x1b[6;10;5t" + KITTY).split(ATTRIBUTES)[1])
        self.assertEqual(keys[b"r"], b"22")

    def test_iterm2(self):
        for env in ({"TERM_PROGRAM": "iTerm.app"}, {"TERM_PROGRAM": "WezTerm"}):
            text = self.in_terminal("torus", "-s", 200, env=env)
            found = re.fullmatch(rb"\x1b\]1337;File=inline=1;size=(\d+):([^\a]*)\a\r\n", text)
            png = base64.b64decode(found[2], validate=True)
            self.assertEqual(len(png), int(found[1]))
            self.assertTrue(png == (self.folder / "torus.png").read_bytes())
        text = self.in_terminal("torus", "-s", 900, "--term", "iterm2")
        self.assertIn(b";height=22:", text)

    def test_silent(self):
        """Nothing is sent if nothing would be visible, and the terminal is not queried if the answer is known to be no."""
        for words, env, answer in ((["-o", "a.png"], {}, None), (["--json"], {}, None), (["--quiet"], {}, None), (["--dry-run"], {}, None),
                                   (["--term", "off"], {}, None), (["cube"], {}, None), (["--turntable", "3"], {}, None),
                                   (["--views", "front,left", "-o", "{stem}-{view}.png"], {}, None),
                                   ([], {"TERM": "dumb"}, None), ([], {"TERM": "linux"}, None), ([], {"CI": "1"}, None)):
            text = self.in_terminal("torus", "-s", 16, *words, env=env, answer=answer)
            self.assertNotIn(b"\x1b", text, (words, env))
        # A text terminal is queried once. tmux passes on kitty's variables, but not its graphics.
        for env in ({}, {"TERM": "tmux-256color", "TMUX": "/tmp/t,1,0", "KITTY_WINDOW_ID": "1"}):
            self.assertEqual(self.in_terminal("torus", "-s", 16, answer=TEXT, env=env), QUERY + ATTRIBUTES)
        # Without an answer, the wait ends.
        self.assertEqual(self.in_terminal("torus", "-s", 16), QUERY + ATTRIBUTES)
        self.assertTrue((self.folder / "torus.png").exists())
        # A pipe, as in scripts.
        done = self.good("torus", "-s", 16, env={"TERM": "xterm-kitty"})
        self.assertEqual(done.stdout, b"")

    def test_refused(self):
        left = self.new_files()
        done = self.good("torus", "-s", 16, "--term", "kitty", "-o", "-")
        self.assertEqual(read_png(done.stdout)[:2], (16, 16))
        self.assertIn("warning: option '--term' shows nothing: standard output is not a terminal", done.stderr.decode())
        self.bad(1, "batch", "torus", "--term", "kitty", says=("batch", "--term"), leaves=left)
        self.bad(1, "torus", "--term", "pictures", says="auto, kitty, iterm2, sixel, blocks or off", leaves=left)
        for words, says in ((["torus", "cube"], "one picture"), (["torus", "--turntable", "3"], "one picture"), (["torus", "--json"], "--json"),
                            (["torus", "-o", "a.exr"], "a.exr"), (["torus", "-o", "a.html"], "a.html")):
            text = self.in_terminal(*words, "--term", "kitty", code=1)
            self.assertNotIn(b"\x1b", text)
            self.assertIn(says, self.errors)
        self.assertEqual(self.new_files(), left)

    def test_signal(self):
        """Ctrl-C during the query: the terminal's settings are restored, and the shell sees the signal."""
        seen = []

        def interrupt(process, slave):
            seen.append(termios.tcgetattr(slave)[3] & (termios.ECHO | termios.ICANON))
            process.send_signal(signal.SIGINT)
        self.in_terminal("torus", at_query=interrupt, answer=TEXT, code=-signal.SIGINT)
        self.assertEqual(seen, [0])
        self.assertEqual(self.new_files(), set())

    def test_commands(self):
        """Sheets, plots and materials are shown like pictures of models."""
        for words, name in ((["compare", "torus", "--sheet", "ambient", "-s", "64"], "torus-ambient.png"), (["plot", "spot", "-s", "160x100"], "spot.png"),
                            (["shape", "torus", "-s", "32"], "torus.png")):
            png, _ = kitty_picture(self.in_terminal(*words, env={"TERM": "xterm-kitty"}))
            self.assertTrue(png == (self.folder / name).read_bytes(), words)
            os.remove(self.folder / name)
            self.assertTrue(kitty_picture(self.in_terminal(*words, "-o", "-", env={"TERM": "xterm-kitty"}))[0] == png)
        png, _ = kitty_picture(self.in_terminal("materials", "-s", "300x180", "--term", "kitty"))
        self.assertTrue(png == self.good("materials", "-s", "300x180", "-o", "-").stdout)
        self.assertEqual(self.new_files(), set())

    @unittest.skipUnless(has_chafa(), "libchafa is not installed")
    def test_sixel(self):
        """The sixels equal the picture: its size if it fits, its colours and its transparent pixels."""
        text = self.in_terminal("torus", "-s", "120", "--background", "white", answer=SIXEL)
        width, height, pixels = sixel_picture(text.split(ATTRIBUTES)[1])
        picture = read_png((self.folder / "torus.png").read_bytes())
        self.assertEqual((width, height), (120, 120))
        self.assertEqual(len(pixels), 120 * 120)
        off = [abs(a - b) for x, y in pixels for a, b in zip(pixels[x, y], pixel(picture, x, y))]
        self.assertLess(sum(off) / len(off), 4)
        self.assertGreater(len(set(pixels.values())), 20)
        width, height, pixels = sixel_picture(self.in_terminal("torus", "-s", "1000x500", "--term", "sixel", answer=TEXT).split(ATTRIBUTES)[1])
        self.assertEqual((width, height), (792, 396)) # sixel rows are six pixels high
        self.assertNotIn((5, 5), pixels)
        self.assertIn((396, 300), pixels)

    @unittest.skipUnless(has_chafa(), "libchafa is not installed")
    def test_blocks(self):
        """As many lines and columns as fit, with the terminal's number of colours."""
        for size, shape, lines, columns in (((80, 24, 800, 480), "400", 22, 44), ((30, 24, 300, 480), "400", 15, 30), ((80, 24, 0, 0), "400x100", 10, 80)):
            for env, color in (({"COLORTERM": "truecolor"}, rb"\x1b\[(?:\d+;)*[34]8;2;"), ({}, rb"\x1b\[(?:\d+;)*[34]8;5;"), ({"TERM": "xterm"}, rb"\x1b\[(?:\d+;)*[39]\d")):
                text = self.in_terminal("torus", "-s", shape, "--background", "white", "--term", "blocks", size=size, env=env)
                rows = text.decode().splitlines()
                self.assertEqual(len(rows), lines, (size, env))
                for row in rows:
                    self.assertEqual(len(re.sub(r"\x1b\[[\d;?]*[a-zA-Z]", "", row)), columns)
                self.assertRegex(text, color)
                self.assertEqual(re.search(rb"[34]8;2;", text) is not None, "COLORTERM" in env)
                self.assertRegex(text.decode(), "[▀▄▌▐▖▗▘▝▚▞▁-█]")
