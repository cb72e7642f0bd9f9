# test_view.py: `lambent view`: the answers of its server, and when it ends. test_view_requests.py tests the access control, and
# tests/browser.py tests the page in a browser.
import hashlib
import http.client
import json
import os
import pathlib
import re
import select
import shutil
import signal
import socket
import subprocess
import urllib.parse

from harness import PROGRAM, read_png, write_png
from view_server import PAGE, WAIT, ViewCase


class View(ViewCase):
    def textured(self):
        place = self.folder / "models"
        (place / "pictures").mkdir(parents=True)
        (place / "quad.obj").write_text("mtllib quad.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nusemtl a\nf 1/1 2/2 3/3\n")
        (place / "quad.mtl").write_text("newmtl a\nKd 1 1 1\nmap_Kd pictures/a.png\n")
        (place / "pictures" / "a.png").write_bytes(write_png(1, 1, b"\xff\x40\x20\xff"))
        return place

    # --- the page

    def test_page(self):
        server = self.serve("cube.obj", "--background", "#fff", "--size", "64")
        status, headers, body = server.get("")
        text = body.decode()
        self.assertEqual(status, 200)
        self.assertIn("connect-src 'self'; base-uri 'none'", text)
        self.assertEqual(text.replace("; connect-src 'self'", "").split("<script")[0], PAGE.split("</body>")[0])
        self.assertEqual(json.loads(re.search(r'id="inside-words">([^<]*)<', text)[1]), ["/cube.obj", "--size=64", "--background=#fff"])
        self.assertEqual(json.loads(re.search(r'id="served">([^<]*)<', text)[1]), {"gallery": False, "threads": False})
        self.assertEqual(headers["Cache-Control"], "no-store")
        self.assertEqual(headers["Referrer-Policy"], "no-referrer")
        self.assertEqual(headers["X-Content-Type-Options"], "nosniff")
        self.assertEqual(headers["Cross-Origin-Resource-Policy"], "same-origin")
        self.assertEqual(headers["Cross-Origin-Opener-Policy"], "same-origin")
        self.assertEqual(headers["Cross-Origin-Embedder-Policy"], "require-corp")
        self.assertEqual(server.get("threads.wasm")[0], 404)
        self.assertIn("frame-ancestors 'none'", headers["Content-Security-Policy"])
        self.assertEqual(server.get("files/cube.obj")[1]["Content-Security-Policy"], "default-src 'none'; sandbox")
        self.assertEqual(server.interrupt(), 0)
        self.assertIn(b"ssh -L %d:127.0.0.1:%d " % (server.port, server.port), server.process.stderr.read())

    def test_threads(self):
        (self.folder / "lambent-threads.wasm").write_bytes(b"\0asm of this test")
        server = self.serve("cube.obj")
        self.assertEqual(json.loads(re.search(r'id="served">([^<]*)<', server.get("")[2].decode())[1]), {"gallery": False, "threads": True})
        status, headers, body = server.get("threads.wasm")
        self.assertEqual((status, headers["Content-Type"], body), (200, "application/wasm", b"\0asm of this test"))
        self.assertEqual(server.interrupt(), 0)

    def test_shape(self):
        server = self.serve("teapot", "--size", "32")
        self.assertIn(b'id="inside-words">["teapot", "--size=32"]', server.get("")[2])
        self.assertEqual(server.get("files/cube.obj")[0], 404)

    def test_two_have_two_tokens(self):
        one, other = self.serve("cube.obj"), self.serve("cube.obj")
        self.assertNotEqual(one.token, other.token)
        self.assertNotEqual(one.port, other.port)

    # --- which files

    def test_paths(self):
        place = self.textured()
        (self.folder / "secret.obj").write_text("v 0 0 0\n")
        (place / "secret.txt").write_text("secret")
        (place / ".hidden.obj").write_text("v 0 0 0\n")
        (place / ".git").mkdir()
        (place / ".git" / "a.json").write_text("{}")
        (place / "out.obj").symlink_to(self.folder / "secret.obj")
        (place / "away").symlink_to(self.folder)
        (place / "in.obj").symlink_to("quad.obj")
        (place / "folder.obj").mkdir()
        os.mkfifo(place / "pipe.obj")
        server = self.serve("models/quad.obj")
        for path in ("/quad.obj", "/quad.mtl", "/pictures/a.png", "/in.obj", "/pictures/../quad.obj", "/./quad.obj"):
            hidden = "/." in path
            self.assertEqual(server.get("files" + path)[0], 404 if hidden else 200, path)
        for path in ("/../secret.obj", "/..%2fsecret.obj", "/%2e%2e/secret.obj", "/%2e%2e%2fsecret.obj", "/pictures/../../secret.obj", "//etc/passwd",
                     "/%2fetc/passwd", urllib.parse.quote(str(self.folder / "secret.obj")), "/out.obj", "/away/secret.obj", "/secret.txt", "/.hidden.obj", "/.git/a.json",
                     "/folder.obj", "/pipe.obj", "/", "", "/quad.obj/", "/nothing.obj", "/" + "a" * 3000 + ".obj", "/pictures",
                     "/proc/self/environ", "/.environment/1-x"):
            status = server.get("files" + path)[0]
            self.assertEqual(status, 404, path)
            for word in ("model", "draw"):
                found = server.task(word, urllib.parse.unquote(path) or "x", "--size=8")[0]
                self.assertEqual(found, 422, word + " " + path)

    def test_named_link(self):
        """The user may name a link that leads elsewhere; the files of its model are searched next to the link."""
        place = self.textured()
        (self.folder / "other").mkdir()
        (self.folder / "other" / "link.obj").symlink_to(place / "quad.obj")
        server = self.serve("other/link.obj")
        self.assertEqual(server.get("files/link.obj")[2], (place / "quad.obj").read_bytes())
        about = json.loads(server.task("model", "/link.obj")[2])
        self.assertEqual([file["path"] for file in about["files"]], ["/link.obj"])
        self.assertEqual(about["missing"], ["/quad.mtl"])
        events = server.events()
        (place / "quad.obj").write_text("v 0 0 0\n")
        events.until(b'data: "/link.obj"')

    def test_model(self):
        place = self.textured()
        server = self.serve("models")
        about = json.loads(server.task("model", "/quad.obj")[2])
        self.assertEqual(sorted(file["path"] for file in about["files"]), ["/pictures/a.png", "/quad.mtl", "/quad.obj"])
        for file in about["files"]:
            self.assertEqual(file["size"], (place / file["path"][1:]).stat().st_size)
        self.assertEqual((about["triangles"], about["missing"], about["native"]), (1, [], None))
        (place / "sub").mkdir()
        (place / "sub" / "x.obj").write_text("mtllib x.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n")
        about = json.loads(server.task("model", "/sub/x.obj")[2])
        self.assertEqual(([file["path"] for file in about["files"]], about["missing"]), (["/sub/x.obj"], ["/sub/x.mtl"]))

    def test_environment(self):
        (self.folder / "sky").mkdir()
        (self.folder / "sky" / "my sky.png").write_bytes(write_png(4, 2, b"\x40\x80\xff\xff" * 8))
        (self.folder / "in").mkdir()
        (self.folder / "in" / "cube.obj").write_bytes((self.folder / "cube.obj").read_bytes())
        words = ["--environment", "sky/my sky.png", "--reflectivity", "1", "--size", "32"]
        server = self.serve("in/cube.obj", *words)
        own = json.loads(re.search(rb'id="inside-words">([^<]*)<', server.get("")[2])[1])
        self.assertIn("--environment=/.environment/1-my sky.png", own)
        self.assertEqual(server.get("files/.environment/1-my%20sky.png")[2], (self.folder / "sky" / "my sky.png").read_bytes())
        self.assertEqual(server.get("files/.environment/2-x")[0], 404)
        self.assertEqual(server.task("picture", *own)[2], self.good("in/cube.obj", *words, "-o", "-").stdout)
        self.assertEqual(server.task("picture", "/cube.obj", "--environment=/../sky/my sky.png")[0], 422)
        self.assertEqual(server.task("picture", "/cube.obj", "--environment=/etc/passwd")[0], 422)

    # --- pictures

    def test_pictures(self):
        server = self.serve("cube.obj")
        for words in (["--size=64"], ["--size=40x30", "--background=white", "--shading=flat", "--azimuth=70"],
                      ["--size=48", "--look=classic"], ["--size=50", "--light=point:position=2r/3r/1r", "--shadows"]):
            status, headers, body = server.task("picture", "/cube.obj", *words)
            self.assertEqual((status, headers["Content-Type"]), (200, "image/png"))
            written = self.good("cube.obj", *words, "-o", "-").stdout
            self.assertEqual(hashlib.sha256(body).hexdigest(), hashlib.sha256(written).hexdigest())
            line, pixels = server.task("draw", "/cube.obj", *words)[2].split(b"\n", 1)
            about = json.loads(line)
            self.assertEqual((about["width"], about["height"], pixels), read_png(written))
            self.assertEqual(about["triangles"], 12)
            self.assertEqual(len(about["camera"]["eye"]), 3)
        # Not the previous picture, because the file is another one.
        (self.folder / "cube.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n")
        self.assertEqual(json.loads(server.task("draw", "/cube.obj", "--size=8")[2].split(b"\n")[0])["triangles"], 1)
        (self.folder / "cube.obj").write_text("v 0 0\n")
        status, _, body = server.task("draw", "/cube.obj", "--size=8")
        self.assertEqual(status, 422)
        self.assertEqual(b"lambent: " + body + b"\n", self.run_program("cube.obj", "-s", 8).stderr)

    def test_kept_model(self):
        # A drawing setting keeps the model loaded: the reading time is the same as for the first picture. Edges need the file's polygons.
        server = self.serve("cube.obj")

        def read_ms(*words):
            line, pixels = server.task("draw", "/cube.obj", "--size=40", *words)[2].split(b"\n", 1)
            self.assertEqual(pixels, read_png(self.good("cube.obj", "--size=40", *words, "-o", "-").stdout)[2])
            return json.loads(line)["read_ms"]

        first = read_ms()
        for words in (["--ao=screen"], ["--shading=flat", "--shadows"], ["--surfaces=off"], ["--hidden-lines=show", "--edge-width=2"]):
            self.assertEqual(read_ms(*words), first, words)
        edges = read_ms("--edges=all")
        self.assertNotEqual(edges, first)
        self.assertEqual(read_ms("--edges=all", "--edge-width=3", "--edge-color=red"), edges)
        self.assertNotEqual(read_ms("--wireframe"), edges)

    def test_explain(self):
        server = self.serve("cube.obj")
        status, _, body = server.task("explain", "/cube.obj", "--size=64", x=32, y=30)
        own = json.loads(self.good("explain", "cube.obj", "32,30", "--size", 64, "--json").stdout)
        found = json.loads(body)
        self.assertEqual(status, 200)
        self.assertEqual({**found, "model": ""}, {**own, "model": ""})
        for place in ({"x": 64, "y": 0}, {"x": "a", "y": 0}, {}):
            self.assertEqual(server.task("explain", "/cube.obj", "--size=64", **place)[0], 422)

    def test_refused_words(self):
        (self.folder / "own.look").write_text("background = white\n")
        server = self.serve("cube.obj")
        for word in ("--output=x.png", "--save-scene=x.json", "--look=own.look", "--threads=1", "--memory-limit=none", "--device=gl", "--sandbox=off", "--sizzle=3",
                     "--turntable=4", "--show=all", "--shading=round", "second.obj", "--allow-path=/", "--size=0"):
            status, headers, body = server.task("draw", "/cube.obj", word)
            self.assertEqual((status, headers["Content-Type"]), (422, "text/plain; charset=utf-8"), word)
            self.assertTrue(body, word)
        self.assertEqual(self.new_files(), {"page.html", "own.look"})
        self.assertEqual(server.get("draw")[0], 400)
        self.assertEqual(server.task("draw", "/cube.obj", "--size=8")[0], 200)

    def test_limits(self):
        server = self.serve("cube.obj", "--triangle-limit", "11")
        status, _, body = server.task("draw", "/cube.obj", "--size=8")
        self.assertEqual(status, 422)
        self.assertIn(b"--triangle-limit", body)

    def test_native(self):
        """The program draws what the page cannot draw, and states the reason."""
        (self.folder / "many.obj").write_text("v 0 0 0\n" + "p 1\n" * 2000001)
        server = self.serve("many.obj")
        about = json.loads(server.task("model", "/many.obj")[2])
        self.assertIn("2000001", about["native"])
        self.assertIsNone(json.loads(server.task("model", "/cube.obj")[2])["native"])

    def test_newer_picture(self):
        """A newer picture of a page cancels its older one; a picture of another page does not."""
        server = self.serve("teapot")
        slow = urllib.parse.urlencode([("w", "teapot"), ("w", "--size=3000"), ("w", "--samples=16"), ("w", "--shadows"), ("w", "--ao=rays"), ("w", "--ao-samples=64"), ("c", "test")])
        connection = http.client.HTTPConnection("127.0.0.1", server.port, timeout=WAIT)
        self.addCleanup(connection.close)
        connection.request("GET", "/%s/draw?%s" % (server.token, slow))
        while not subprocess.run(["pgrep", "-P", str(server.process.pid)], stdout=subprocess.PIPE).stdout:
            pass  # until drawing starts
        self.assertEqual(server.task("draw", "teapot", "--size=8")[0], 200)
        self.assertEqual(connection.getresponse().status, 409)

    # --- changes

    def test_changes(self):
        place = self.textured()
        server = self.serve("models/quad.obj")
        self.assertEqual(server.task("model", "/quad.obj")[0], 200)
        events = server.events()
        new = place / "new"
        new.write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n")
        new.rename(place / "quad.obj")
        events.until(b'data: "/quad.obj"\n\n')
        (place / "quad.mtl").write_text("newmtl b\n")
        events.until(b'data: "/quad.mtl"\n\n')
        (place / "pictures" / "a.png").write_bytes(write_png(1, 1, b"\x00\x40\x20\xff"))
        events.until(b'data: "/pictures/a.png"\n\n')
        (place / "quad.mtl").unlink()
        events.until(b'data: "/quad.mtl"\n\n')

    def test_folder_that_is_replaced(self):
        """If another folder replaces a folder, its files count as changed, and are watched from then on."""
        place = self.textured()
        server = self.serve("models/quad.obj")
        self.assertEqual(server.task("model", "/quad.obj")[0], 200)
        events = server.events()
        (place / "pictures").rename(place / "old")
        events.until(b'data: "/pictures/"\n\n')
        (place / "old" / "a.png").write_bytes(b"no longer the model's")
        (place / "pictures").mkdir()
        (place / "pictures" / "a.png").write_bytes(write_png(1, 1, b"\x00\x40\x20\xff"))
        events.until(b'data: "/pictures/"\n\n')  # it exists again
        (place / "pictures" / "a.png").write_bytes(write_png(1, 1, b"\x00\x00\x20\xff"))
        events.until(b'data: "/pictures/a.png"\n\n')
        shutil.rmtree(place / "pictures")
        events.until(b'data: "/pictures/"\n\n')

    def test_more_changes_than_the_kernel_keeps(self):
        limit = int(pathlib.Path("/proc/sys/fs/inotify/max_queued_events").read_text())
        if limit > 100000:
            self.skipTest(f"the kernel keeps {limit} changes")
        place = self.textured()
        server = self.serve("models/quad.obj")
        self.assertEqual(server.task("model", "/quad.obj")[0], 200)
        events = server.events()
        server.process.send_signal(signal.SIGSTOP)
        (place / "x").write_text("")
        for i in range(limit // 4 + 100):
            (place / "x").rename(place / "y")
            (place / "y").rename(place / "x")
        server.process.send_signal(signal.SIGCONT)
        events.until(b'data: "/"\n\n')
        (place / "quad.mtl").write_text("newmtl b\n")
        events.until(b'data: "/quad.mtl"\n\n')

    def test_change_of_what_cannot_be_read(self):
        (self.folder / "cube.obj").write_text("v 1 1\n")
        server = self.serve("cube.obj")
        self.assertEqual(server.task("model", "/cube.obj")[0], 422)
        events = server.events()
        (self.folder / "cube.obj").write_text("v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n")
        events.until(b'data: "/cube.obj"\n\n')
        self.assertEqual(server.task("model", "/cube.obj")[0], 200)

    # --- gallery

    def test_gallery(self):
        place = self.textured()
        (place / "bad <b> & \".obj").write_text("v 1 1\n")
        (place / "pictures" / "x.stl").write_bytes((self.folder / "cube.stl").read_bytes())
        (place / "out.obj").symlink_to(self.folder / "cube.obj")
        (place / "data.json").write_text("{}")
        server = self.serve("models/", "--background", "white")
        text = server.get("")[2].decode()
        names = ["/bad%20%3Cb%3E%20%26%20%22.obj", "/pictures/x.stl", "/quad.obj"]
        self.assertEqual(re.findall(r'data-thumb="thumb([^"]*)"', text), names)
        self.assertEqual(re.findall(r'href="page#([^"]*)"', text), [name + "&--background%3Dwhite" for name in names])
        sizes = [os.path.getsize(place / name) for name in ("bad <b> & \".obj", "pictures/x.stl", "quad.obj")]
        self.assertEqual([int(size) for size in re.findall(r'<li data-size="(\d+)" data-time="\d{9,}">', text)], sizes)
        self.assertIn("bad &lt;b&gt; &amp; &quot;.obj", text)
        self.assertEqual(re.findall("<script[^>]*>", text), ['<script type="module" src="gallery.js">'])
        self.assertIn("default-src 'none'; script-src 'self'; connect-src 'self'; img-src blob: data:;", text)
        self.assertEqual(server.get("gallery.js")[1]["Content-Type"], "text/javascript")
        self.assertEqual(server.get("gallery.css")[1]["Content-Type"], "text/css")
        page = server.get("page")[2].decode()
        self.assertEqual(json.loads(re.search(r'id="served">([^<]*)<', page)[1]), {"gallery": True, "threads": False})
        self.assertNotIn("inside-words", page)
        status, headers, body = server.get("thumb/quad.obj")
        self.assertEqual((status, headers["Content-Type"]), (200, "image/png"))
        self.assertEqual(body, self.good("models/quad.obj", "--background", "white", "--size", "256", "-o", "-").stdout)
        status, headers, body = server.get("thumb" + names[0])
        self.assertEqual((status, headers["Content-Type"]), (422, "image/svg+xml"))
        self.assertNotIn("models/", body.decode())
        self.assertIn("&lt;b&gt; &amp; &quot;", re.sub(r"</tspan><tspan[^>]*>", " ", body.decode()))
        for path in ("/out.obj", "/../cube.obj", "/nothing.obj", "/data.txt"):
            self.assertEqual(server.get("thumb" + path)[0], 404, path)
        (place / "later.obj").write_bytes((self.folder / "cube.obj").read_bytes())
        self.assertIn("later.obj", server.get("")[2].decode())

    def test_many_thumbnails(self):
        place = self.folder / "many"
        place.mkdir()
        for i in range(40):
            (place / f"{i}.obj").write_bytes((self.folder / "cube.obj").read_bytes())
        server = self.serve("many")
        connections = []
        for i in range(40):
            connections.append(http.client.HTTPConnection("127.0.0.1", server.port, timeout=WAIT))
            self.addCleanup(connections[-1].close)
            connections[-1].request("GET", "/%s/thumb/%d.obj" % (server.token, i))
        for connection in connections[20:]:  # scrolled away
            connection.close()
        pictures = {connection.getresponse().read() for connection in connections[:20]}
        self.assertEqual(len(pictures), 1)
        self.assertEqual(server.task("draw", "/1.obj", "--size=8")[0], 200)

    # --- the end

    def test_idle(self):
        server = self.serve("cube.obj", "--idle", "0.002")
        self.assertEqual(server.process.wait(timeout=WAIT), 0)
        self.assertIn(b"--idle", server.process.stderr.read())

    def test_a_page_that_is_open_keeps_it(self):
        server = self.serve("cube.obj", "--idle", "0.002")
        try:
            events = server.events()
        except (OSError, AssertionError):
            return  # the machine was so busy that the process had ended
        self.assertFalse(select.select([events.connection], [], [], 1)[0] and not events.connection.recv(1, socket.MSG_PEEK), "the connection has ended")
        self.assertIsNone(server.process.poll())
        events.connection.close()
        self.assertEqual(server.process.wait(timeout=WAIT), 0)

    def test_interrupt(self):
        server = self.serve("teapot")
        events, connection = server.events(), http.client.HTTPConnection("127.0.0.1", server.port, timeout=WAIT)
        self.addCleanup(connection.close)
        connection.request("GET", "/%s/draw?%s" % (server.token, urllib.parse.urlencode([("w", "teapot"), ("w", "--size=4000"), ("w", "--samples=16"), ("c", "x")])))
        self.assertEqual(server.interrupt(), 0)
        while events.connection.recv(4096):
            pass
        children = subprocess.run(["pgrep", "-P", str(server.process.pid)], stdout=subprocess.PIPE).stdout
        self.assertEqual(children, b"")

    def test_interrupt_with_many_requests(self):
        """Requests that arrive while the server ends are answered or lost, and the server still ends."""
        server = self.serve("teapot")
        query = urllib.parse.urlencode([("w", "teapot"), ("w", "--size=4000"), ("w", "--samples=16")])
        connections = []
        for i in range(120):
            connection = socket.create_connection(("127.0.0.1", server.port), timeout=WAIT)
            self.addCleanup(connection.close)
            connections.append(connection)
            connection.sendall(b"GET /%s/draw?%s&c=%d HTTP/1.1\r\nHost: 127.0.0.1:%d\r\n" % (server.token.encode(), query.encode(), i, server.port) +
                               (b"\r\n" if i % 2 else b""))
        server.process.send_signal(signal.SIGINT)
        for connection in connections[::2]:  # their requests become complete now
            try:
                connection.sendall(b"\r\n")
            except OSError:
                pass  # it has ended
        self.assertEqual(server.process.wait(timeout=WAIT), 0)

    # --- unsupported cases

    def test_errors(self):
        env = {"LAMBENT_PAGE": str(self.page)}
        self.bad(2, "view", "nothing.obj", says="nothing.obj: cannot read", env=env)
        self.bad(1, "view", "-", says="standard input", env=env)
        self.bad(1, "view", says="missing argument", env=env)
        self.bad(1, "view", "cube.obj", "cube.ply", says="unexpected argument 'cube.ply'", env=env)
        self.bad(1, "view", "cube.obj", "--port", "99999", says="--port", env=env)
        self.bad(1, "view", "cube.obj", "--idle", "0", says="--idle", env=env)
        for words in (["-o", "x.png"], ["--save-scene", "x.json"], ["--durable"], ["--term", "kitty"]):
            self.bad(1, "view", "cube.obj", *words, says="does not apply to this command; it belongs to render", env=env)
            self.assertNotIn(words[0].encode() + b" ", self.good("view", "--help").stdout)
        self.bad(1, "view", "cube.obj", "--show", "all", says="option '--show all' writes the layers of an .exr file", env=env)
        self.bad(2, "view", "cube.obj", "--environment", "nothing.png", says="nothing.png", env=env)
        with socket.create_server(("127.0.0.1", 0)) as taken:
            port = taken.getsockname()[1]
            self.bad(4, "view", "cube.obj", "--port", port, says=f"port {port} of 127.0.0.1", env=env)
        self.page.write_text("<p>another page</p>")
        self.bad(3, "view", "cube.obj", says="make web", env=env)

    def test_without_the_library(self):
        (self.folder / "libmicrohttpd.so.12").write_bytes(b"")
        done = self.run_program("view", "cube.obj", env={"LD_LIBRARY_PATH": str(self.folder), "LAMBENT_PAGE": str(self.page)})
        self.assertEqual(done.returncode, 3)
        self.assertRegex(done.stderr.decode(), r"^lambent: view needs libmicrohttpd\.so\.12, .*libmicrohttpd12")

    def test_sandbox(self):
        said = subprocess.run([PROGRAM, "--version"], stdout=subprocess.PIPE).stdout.decode()
        if "and seccomp" not in said:
            self.skipTest("this machine or build has no complete sandbox")
        server = self.serve("cube.obj", "--sandbox", "require")
        self.assertEqual(server.task("draw", "/cube.obj", "--size=8")[0], 200)
        children = subprocess.run(["pgrep", "-P", str(server.process.pid)], stdout=subprocess.PIPE).stdout.split()
        names = [pathlib.Path("/proc", child.decode(), "comm").read_text().strip() for child in children]
        children = [child for child, name in zip(children, names) if name != "lambent-import"]  # it has its own sandbox
        self.assertEqual(len(children), 1, names)
        filters = [int(re.search(r"Seccomp_filters:\s*(\d+)", pathlib.Path("/proc", str(pid), "status").read_text())[1]) for pid in
                   (server.process.pid, children[0].decode())]
        self.assertEqual(filters[1], filters[0] + 1)
        handles = [os.readlink(f"/proc/{children[0].decode()}/fd/{name}") for name in os.listdir(f"/proc/{children[0].decode()}/fd")]
        internet = {line.split()[9] for file in ("tcp", "tcp6") for line in pathlib.Path("/proc/net", file).read_text().splitlines()[1:]}
        sockets = [name[8:-1] for name in handles if name.startswith("socket:")]  # only that of lambent-import's starter
        self.assertLessEqual(len(sockets), 1)
        self.assertFalse(internet & set(sockets))
