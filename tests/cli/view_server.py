# view_server.py: a running `lambent view` and requests to it, shared by tests/cli/test_view*.py.
import http.client
import os
import re
import signal
import socket
import subprocess
import urllib.parse

from harness import PROGRAM, Case

POLICY = "default-src 'none'; script-src 'sha256-x'; img-src blob: data:; base-uri 'none'; form-action 'none'"
PAGE = ("<!doctype html>\n<html>\n<head>\n<meta http-equiv=\"Content-Security-Policy\" content=\"%s\">\n</head>\n<body>\n<main></main>\n"
        "</body>\n</html>\n" % POLICY)
WAIT = 60  # seconds after which an expected result counts as missing


class Server:
    """A running viewer."""

    def __init__(self, case, *words):
        self.case = case
        self.process = subprocess.Popen([PROGRAM, "view", "--no-open", *map(str, words)], cwd=case.folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                        env={**os.environ, "LAMBENT_PAGE": str(case.page)})
        case.addCleanup(self.end)
        line = self.process.stdout.readline().decode()
        found = re.fullmatch(r"http://127\.0\.0\.1:(\d+)/([0-9a-f]{32})/\n", line)
        if not found:
            case.fail("no address: " + repr(line) + self.process.stderr.read().decode())
        self.port, self.token = int(found[1]), found[2]

    def end(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self.process.stdout.close()
        self.process.stderr.close()

    def raw(self, path, method="GET", headers=None, body=None):
        """The answer to a request: status, headers, body."""
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=WAIT)
        try:
            connection.request(method, path, body=body, headers=headers or {})
            answer = connection.getresponse()
            return answer.status, dict(answer.getheaders()), answer.read()
        finally:
            connection.close()

    def get(self, path, **more):
        return self.raw("/%s/%s" % (self.token, path), **more)

    def task(self, word, *words, **more):
        return self.get(word + "?" + urllib.parse.urlencode([("w", w) for w in words] + [("c", "test"), *more.items()]))

    def events(self):
        """A connection that receives change events, after its first line."""
        connection = socket.create_connection(("127.0.0.1", self.port), timeout=WAIT)
        self.case.addCleanup(connection.close)
        connection.sendall(b"GET /%s/events HTTP/1.1\r\nHost: 127.0.0.1:%d\r\n\r\n" % (self.token.encode(), self.port))
        return Events(self.case, connection)

    def interrupt(self):
        self.process.send_signal(signal.SIGINT)
        return self.process.wait(timeout=WAIT)


class Events:
    def __init__(self, case, connection):
        self.case, self.connection, self.seen = case, connection, b""
        self.until(b": \n\n")

    def until(self, wanted):
        while wanted not in self.seen:
            part = self.connection.recv(4096)
            self.case.assertTrue(part, f"{wanted}: the connection has ended after {self.seen}")
            self.seen += part
        self.seen = self.seen.split(wanted, 1)[1]


class ViewCase(Case):
    def setUp(self):
        super().setUp()
        self.page = self.folder / "page.html"
        self.page.write_text(PAGE)
        done = self.run_program("view", "--help")
        self.assertEqual(done.returncode, 0)
        if b"libmicrohttpd" in self.run_program("view", "no-such-model.obj").stderr:
            self.skipTest("libmicrohttpd is not there")

    def serve(self, *words):
        return Server(self, *words)
