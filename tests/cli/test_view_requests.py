# test_view_requests.py: the access control of `lambent view`, and the effect of hostile requests.
import contextlib
import select
import socket
import subprocess
import time

from view_server import WAIT, ViewCase


SOON = 20  # seconds: less than the half minute after which the library itself closes a silent connection


class Requests(ViewCase):
    # --- access control

    def test_token(self):
        server = self.serve("cube.obj")
        last = server.token[:-1] + ("0" if server.token[-1] != "0" else "1")
        for path in ("/", "/favicon.ico", "/files/cube.obj", "/%s/" % ("0" * 32), "/%s/" % last, "/%s/" % server.token[:-1], "/%s" % server.token,
                     "/%s0/" % server.token, "/%s/" % server.token.upper() if server.token.upper() != server.token else "/x"):
            self.assertEqual(server.raw(path)[0], 403, path)
        self.assertEqual(server.get("")[0], 200)
        self.assertEqual(server.get("no-such-page")[0], 404)

    def test_host_and_origin(self):
        server = self.serve("cube.obj")
        port = server.port
        for host in ("evil.example", "evil.example:%d" % port, "127.0.0.1", "127.0.0.1:%d" % (port + 1), "localhost", "[::1]:%d" % port,
                     "127.0.0.1:%d.evil.example" % port, ""):
            self.assertEqual(server.get("", headers={"Host": host})[0], 403, host)
        for host in ("127.0.0.1:%d" % port, "localhost:%d" % port, "LOCALHOST:%d" % port):
            self.assertEqual(server.get("", headers={"Host": host})[0], 200, host)
        for name, value, status in (("Origin", "http://evil.example", 403), ("Origin", "null", 403), ("Origin", "https://127.0.0.1:%d" % port, 403),
                                    ("Origin", "http://127.0.0.1:%d" % port, 200), ("Sec-Fetch-Site", "cross-site", 403),
                                    ("Sec-Fetch-Site", "same-site", 403), ("Sec-Fetch-Site", "none", 200), ("Sec-Fetch-Site", "same-origin", 200)):
            self.assertEqual(server.get("files/cube.obj", headers={name: value})[0], status, value)

    def test_repeated_headers(self):
        """If there are two headers, a relay could have checked the other one."""
        server = self.serve("cube.obj")
        own = "127.0.0.1:%d" % server.port
        good = {"Host": own, "Origin": "http://" + own, "Sec-Fetch-Site": "same-origin"}
        for name, others in (("Host", [own, "evil.example", ""]), ("Origin", [good["Origin"], "http://evil.example"]), ("Sec-Fetch-Site", ["none", "cross-site"])):
            for other in others:
                for pair in ((good[name], other), (other, good[name])):
                    lines = [(key, value) for key, value in good.items() if key != name] + [(name, pair[0]), (name.lower(), pair[1])]
                    self.assertIn(self.status(server, "files/cube.obj", lines), (400, 403), (name, pair))
        self.assertEqual(self.status(server, "files/cube.obj", list(good.items())), 200)

    def status(self, server, path, lines):
        """The status of the answer to exactly these headers."""
        with socket.create_connection(("127.0.0.1", server.port), timeout=SOON) as connection:
            connection.sendall("".join(["GET /%s/%s HTTP/1.1\r\n" % (server.token, path), *("%s: %s\r\n" % line for line in lines), "\r\n"]).encode())
            return int(connection.recv(4096).split()[1])

    def test_zero_bytes(self):
        """The library decodes %00 as the end of a name, so anything could follow it."""
        server = self.serve("cube.obj")
        (self.folder / "cube%00.obj").write_text("v 0 0 0\n")
        for path in ("files/cube.obj%00", "files/cube.obj%00y.obj", "files/%00cube.obj", "files/cube%00.obj", "page%00", "%00", "thumb/cube.obj%00",
                     "draw?w=%2Fcube.obj%00&w=--size=8", "draw?w=%2Fcube.obj&w=--size=8&%00", "draw%00?w=%2Fcube.obj&w=--size=8"):
            self.assertEqual(server.get(path)[0], 404, path)
        self.assertEqual(server.get("files/cube%2500.obj")[0], 200)
        self.assertEqual(server.raw("/%s%%00/" % server.token)[0], 403)

    def test_methods(self):
        server = self.serve("cube.obj")
        for method in ("POST", "PUT", "DELETE", "OPTIONS", "PATCH", "TRACE", "BREW"):
            status, headers, _ = server.get("", method=method, body=b"x" * 5000 if method in ("POST", "PUT") else None)
            self.assertEqual((status, headers.get("Allow")), (405, "GET, HEAD"), method)
        status, headers, body = server.get("files/cube.obj", method="HEAD")
        self.assertEqual((status, body, int(headers["Content-Length"])), (200, b"", (self.folder / "cube.obj").stat().st_size))

    # --- other users

    def test_other_users(self):
        """A connection of another user is refused even with the token; root's connection is not, because relays belong to root."""
        other = self.plain_user()
        if other is None:
            self.skipTest("runs without the right to become another user")
        server = self.serve("cube.obj")
        ask = ("import http.client, sys\nc = http.client.HTTPConnection('127.0.0.1', %d, timeout=%d)\nc.request('GET', '/%s/files/cube.obj')\n"
               "a = c.getresponse()\nprint(a.status, a.read(60).decode())" % (server.port, WAIT, server.token))
        said = [subprocess.run(["python3", "-S", "-c", ask], user=user, stdout=subprocess.PIPE, check=True, cwd="/").stdout.decode() for user in (None, other)]
        self.assertTrue(said[0].startswith("200 "), said)
        self.assertEqual(said[1], "403 this viewer answers only the user who has started it\n")

    # --- hostile requests

    def test_hostile(self):
        server = self.serve("cube.obj")
        host = b"Host: 127.0.0.1:%d\r\n" % server.port
        waiting = []
        for i in range(200):  # incomplete requests
            connection = socket.create_connection(("127.0.0.1", server.port), timeout=WAIT)
            self.addCleanup(connection.close)
            connection.sendall([b"GET /", b"", b"GET / HTTP/1.1\r\n" + host, b"GET /%s/ HTTP/1.1\r\nX: " % server.token.encode()][i % 4])
            waiting.append(connection)
        self.assertEqual(server.get("files/cube.obj")[0], 200)
        for junk in (b"GET / HTTP/1.1\r\n" + host + b"X: " + b"a" * 200000 + b"\r\n\r\n", b"GET /" + b"a" * 200000 + b" HTTP/1.1\r\n" + host + b"\r\n",
                     b"\x16\x03\x01\x02\x00\x01\x00\x01\xfc\x03\x03", b"\0" * 100, b"GET\r\n\r\n", b"A" * 70000, b"GET / HTTP/9.9\r\n\r\n",
                     b"GET http://evil.example/ HTTP/1.1\r\n" + host + b"\r\n", b"GET /%ff%fe/../..// HTTP/1.1\r\n" + host + b"\r\n",
                     b"POST / HTTP/1.1\r\n" + host + b"Content-Length: 99999999999999\r\n\r\n", b"GET / HTTP/1.1\r\n" + b"X: y\r\n" * 5000 + b"\r\n",
                     b"GET /" + server.token.encode() + b"/draw?" + b"w=a&" * 8000 + b" HTTP/1.1\r\n" + host + b"\r\n"):
            connection = socket.create_connection(("127.0.0.1", server.port), timeout=1)  # some get no answer
            try:
                connection.sendall(junk)
                answer = connection.recv(4096)
                self.assertNotIn(b" 200 ", answer[:20], junk[:60])
            except OSError:
                pass
            finally:
                connection.close()
        self.assertEqual(server.get("files/cube.obj")[0], 200)
        for connection in waiting:
            connection.close()
        self.assertEqual(server.task("draw", "/cube.obj", "--size=8")[0], 200)
        self.assertIsNone(server.process.poll())

    HALVES = (b"GET /", b"", b"GET / HTTP/1.1\r\nHost: x\r\n", b"POST / HTTP/1.1\r\nX: ")

    def test_more_half_requests_than_connections(self):
        """A client that keeps many incomplete requests open, and reopens closed ones, does not keep other clients out."""
        server, begin, waiting = self.serve("cube.obj"), time.monotonic(), []
        self.assertEqual(server.task("model", "/cube.obj")[0], 200)
        events = server.events()
        for _ in range(3):
            for i in range(600):  # the server accepts 256 at once, and the same number may wait
                connection = socket.create_connection(("127.0.0.1", server.port), timeout=SOON)
                self.addCleanup(connection.close)
                connection.sendall(self.HALVES[i % 4])
                waiting.append(connection)
            for path in ("files/cube.obj", "draw?w=/cube.obj&w=--size=8"):
                self.assertEqual(self.status(server, path, [("Host", "127.0.0.1:%d" % server.port)]), 200)
        closed = [self.is_closed(connection, 0) for connection in waiting[-100:]]
        if time.monotonic() - begin < 4:  # otherwise they may be so old that they are closed
            self.assertNotIn(True, closed)
        for connection in waiting[:1000]:  # the oldest
            self.assertTrue(self.is_closed(connection))
        (self.folder / "cube.obj").write_text("v 0 0 0\n")
        events.until(b'data: "/cube.obj"')  # an open page stays connected

    def test_readers_that_never_read(self):
        """Clients that do not read their answers, and many pages that wait for events, do not delay other clients."""
        server, host = self.serve("cube.obj"), b" HTTP/1.1\r\nHost: 127.0.0.1:%d\r\n\r\n"
        self.assertEqual(server.task("model", "/cube.obj")[0], 200)
        (self.folder / "large.bin").write_bytes(bytes(8 << 20))
        for path, count in ((b"files/large.bin", 300), (b"events", 400)):
            for _ in range(count):
                connection = socket.create_connection(("127.0.0.1", server.port), timeout=WAIT)
                self.addCleanup(connection.close)
                connection.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
                connection.sendall(b"GET /%s/%s" % (server.token.encode(), path) + host % server.port)
        times = []
        for _ in range(5):
            begin = time.monotonic()
            self.assertEqual(server.task("draw", "/cube.obj", "--size=8")[0], 200)
            times.append(time.monotonic() - begin)
        print("# seconds of the requests:", *(f"{t:.3f}" for t in times))
        self.assertLess(max(times), 2)  # 0.3 s on an idle machine

    def test_no_answer_waits_for_a_timeout(self):
        """A drawing that is finished at any moment of the server's loop is answered at once."""
        server = self.serve("cube.obj")
        times = []
        for _ in range(60):
            begin = time.monotonic()
            self.assertEqual(server.task("draw", "/cube.obj", "--size=8")[0], 200)
            times.append(time.monotonic() - begin)
        self.assertLessEqual(len([t for t in times if t > 0.45]), 2, sorted(times)[-9:])  # on a busy machine; the loop's timeout is 0.5 s

    def test_many_words(self):
        """A request with too many words has an answer."""
        server = self.serve("cube.obj")
        for count, status in ((100, 422), (2000, 414), (20000, 414)):
            answer = server.task("draw", *["/cube.obj"], *["a"] * count)
            self.assertEqual(answer[0], status, count)
        self.assertEqual(server.task("draw", "/cube.obj", "--size=8")[0], 200)

    def is_closed(self, connection, wait=WAIT):
        connection.settimeout(wait)
        try:
            return connection.recv(1) == b""
        except BlockingIOError:
            return False
        except ConnectionError:
            return True

    def test_half_requests_end(self):
        """An incomplete request is dropped after some seconds, even if more data keeps arriving."""
        server = self.serve("cube.obj")
        self.assertEqual(server.task("model", "/cube.obj")[0], 200)
        events = server.events()
        connections = [socket.create_connection(("127.0.0.1", server.port), timeout=WAIT) for _ in self.HALVES]
        for connection, half in zip(connections, self.HALVES):
            self.addCleanup(connection.close)
            connection.sendall(half)
        last = connections[-1]
        for _ in range(WAIT):
            if select.select([last], [], [], 1)[0]:
                break
            try:
                last.sendall(b"a")
            except (BrokenPipeError, ConnectionResetError): # closed in the meantime
                break
        else:
            self.fail("it is still waited for")
        for connection in connections:
            self.assertTrue(self.is_closed(connection))
        (self.folder / "cube.obj").write_text("v 0 0 0\n")
        events.until(b'data: "/cube.obj"')

    def test_half_requests_end_while_bytes_arrive(self):
        """Bytes that arrive while the server drops a request do not keep the connection open."""
        server = self.serve("cube.obj")
        connections = [socket.create_connection(("127.0.0.1", server.port), timeout=SOON) for _ in range(60)]
        for connection in connections:
            self.addCleanup(connection.close)
            connection.sendall(self.HALVES[3])
        sent = 0
        while sent < 40000 and not select.select(connections, [], [], 0.0001)[0]:  # bytes of each, fewer than the server accepts
            for connection in connections:
                with contextlib.suppress(BrokenPipeError, ConnectionResetError): # closed in the meantime
                    connection.sendall(b"a")
            sent += 1
        for connection in connections:
            self.assertTrue(self.is_closed(connection, SOON))
