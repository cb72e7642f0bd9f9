"""store.py: a real object store for the tests: OpenStack Swift with its S3 interface, on loopback, with its rings and data in a folder; and a proxy
in front of it that delays, throttles, answers 503, cuts and corrupts, or answers as a hostile store would. Needs root and Debian's packages."""
import asyncio
import collections
import os
import pathlib
import random
import shutil
import socket
import subprocess
import threading
import time

PROGRAMS = ("swift-ring-builder", "swift-proxy-server", "swift-object-server", "swift-container-server", "swift-account-server", "memcached", "unshare")
KEYS = {"AWS_ACCESS_KEY_ID": "test:tester", "AWS_SECRET_ACCESS_KEY": "testing", "AWS_DEFAULT_REGION": "us-east-1", "AWS_EC2_METADATA_DISABLED": "true"}
PIPELINE = "catch_errors gatekeeper healthcheck proxy-logging cache listing_formats s3api tempauth copy slo dlo proxy-logging proxy-server"
MORE = {"cache": "memcache_servers = %s", "s3api": "s3_acl = false\nlocation = us-east-1", "tempauth": "user_test_tester = testing .admin"}


def why_not():
    """Why the store cannot run here, or None."""
    missing = [name for name in PROGRAMS if not shutil.which(name, path=os.environ.get("PATH", "") + ":/usr/sbin")]
    if missing:
        return "not installed: %s (packages.txt, group store)" % " ".join(missing)
    if os.geteuid():
        return "Swift's servers need root"
    if subprocess.run(["unshare", "--mount", "true"], stderr=subprocess.DEVNULL).returncode:
        return "no mount namespaces"
    return None


def free_ports(count):
    sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(count)]
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


class Swift:
    def __init__(self, folder, host="127.0.0.1"):
        self.folder, self.processes = pathlib.Path(folder), []
        etc = self.folder / "etc"
        for path in (etc, self.folder / "node/d1", self.folder / "log"):
            path.mkdir(parents=True)
        self.port, memory, *ports = free_ports(5)
        (etc / "swift.conf").write_text("[swift-hash]\nswift_hash_path_suffix = s\nswift_hash_path_prefix = p\n[storage-policy:0]\nname = one\ndefault = yes\n")
        common = "[DEFAULT]\nworkers = 1\nuser = root\nlog_level = WARNING\nswift_dir = %s\n" % etc
        self.start("memcached", "-u", "root", "-l", "127.0.0.1", "-p", str(memory), "-m", "64")
        for kind, port in zip(("object", "container", "account"), ports):
            for words in (["create", "6", "1", "1"], ["add", "r1z1-127.0.0.1:%d/d1" % port, "1"], ["rebalance"]):
                self.inside("swift-ring-builder", str(etc / (kind + ".builder")), *words)
            (etc / (kind + ".conf")).write_text(common + """bind_ip = 127.0.0.1
bind_port = %d
devices = %s/node
mount_check = false
fallocate_reserve = 0
[pipeline:main]
pipeline = %s-server
[app:%s-server]
use = egg:swift#%s
""" % (port, self.folder, kind, kind, kind))
            self.start("swift-%s-server" % kind, str(etc / (kind + ".conf")))
        filters = "".join("[filter:%s]\nuse = egg:swift#%s\n%s\n" % (name, {"cache": "memcache", "proxy-logging": "proxy_logging"}.get(name, name), MORE.get(name, ""))
                          for name in dict.fromkeys(PIPELINE.split()[:-1]))
        (etc / "proxy.conf").write_text(common + "bind_ip = %s\nbind_port = %d\n[pipeline:main]\npipeline = %s\n[app:proxy-server]\nuse = egg:swift#proxy\n"
                                        "account_autocreate = true\n%s" % (host, self.port, PIPELINE, filters.replace("%s", "127.0.0.1:%d" % memory)))
        self.start("swift-proxy-server", str(etc / "proxy.conf"))
        self.address = "http://%s:%d" % (host, self.port)
        until = time.time() + 60
        while time.time() < until:
            with socket.socket() as probe:
                if not probe.connect_ex((host, self.port)):
                    break
            time.sleep(0.2)

    def inside(self, *words):
        """Swift reads /etc/swift/swift.conf: it sees this folder there, and the machine's own stays as it is."""
        self.command = ["unshare", "--mount", "sh", "-c", 'mount --bind "$0" /etc/swift && exec "$@"', str(self.folder / "etc")]
        subprocess.run([*self.command, *words], stdout=subprocess.DEVNULL, check=True)

    def start(self, name, *words):
        path = {**os.environ, "PATH": os.environ.get("PATH", "") + ":/usr/sbin"}
        with open(self.folder / "log" / name, "wb") as log:
            self.processes.append(subprocess.Popen([*(self.command if name != "memcached" else ()), name, *words], stdout=log, stderr=log, env=path,
                                                   start_new_session=True))

    def client(self, address=None):
        import boto3
        from botocore.config import Config
        return boto3.client("s3", endpoint_url=address or self.address, aws_access_key_id=KEYS["AWS_ACCESS_KEY_ID"], region_name="us-east-1",
                            aws_secret_access_key=KEYS["AWS_SECRET_ACCESS_KEY"], config=Config(retries={"max_attempts": 10}))

    def stop(self):
        for process in self.processes:
            os.killpg(process.pid, 15)
        for process in self.processes:
            process.wait()


class Proxy:
    """`delay` in seconds for each request, `rate` in bytes a second for all bodies, `fail`, `cut` and `corrupt` as shares of the requests. `hostile`
    is a function of the method and the path that returns an answer's bytes, or None; an answer that is "endless" repeats its last byte."""

    def __init__(self, upstream, delay=0.0, rate=0, fail=0.0, cut=0.0, corrupt=0.0, hostile=None, host="127.0.0.1"):
        self.upstream, self.delay, self.rate, self.fail, self.cut, self.corrupt, self.hostile = upstream, delay, rate, fail, cut, corrupt, hostile
        self.rng, self.requests, self.free_at, self.put_bytes = random.Random(7), [], 0.0, collections.Counter()  # bytes that arrive at each path
        self.began, self.ended, self.tasks = 0.0, 0.0, set()  # the times of bodies
        self.loop, ready = asyncio.new_event_loop(), threading.Event()

        def serve():
            asyncio.set_event_loop(self.loop)
            server = self.loop.run_until_complete(asyncio.start_server(self.connection, host, 0, limit=1 << 20))
            self.address = "http://%s:%d" % server.sockets[0].getsockname()[:2]
            ready.set()
            self.loop.run_forever()

        threading.Thread(target=serve, daemon=True).start()
        ready.wait()

    def stop(self):
        def cancel():
            for task in asyncio.all_tasks(self.loop):
                task.cancel()
            self.loop.call_later(0.1, self.loop.stop)
        self.loop.call_soon_threadsafe(cancel)

    def lot(self, share):
        return share and self.rng.random() < share

    def lasted(self):
        """The seconds from the first byte to the last."""
        return self.ended - self.began

    async def pace(self, count):
        if count:
            self.began, self.ended = self.began or time.monotonic(), time.monotonic()
        if self.rate:
            now = self.loop.time()
            self.free_at = max(now, self.free_at) + count / self.rate
            await asyncio.sleep(self.free_at - now)

    async def connection(self, reader, writer):
        upstream = None
        self.tasks.add(asyncio.current_task())  # the loop alone does not keep them
        try:
            while head := await reader.readuntil(b"\r\n\r\n"):
                method, path = head.split(b" ", 2)[:2]
                self.requests.append((method.decode(), path.decode()))
                fields = dict(line.lower().split(b": ", 1) for line in head.split(b"\r\n")[1:] if b": " in line)
                if fields.pop(b"expect", None):
                    writer.write(b"HTTP/1.1 100 Continue\r\n\r\n")
                    head = b"\r\n".join(line for line in head.split(b"\r\n") if not line.lower().startswith(b"expect"))
                body = await reader.readexactly(int(fields.get(b"content-length", 0)))
                await asyncio.sleep(self.delay)
                await self.pace(len(body))
                answer = self.hostile and self.hostile(method.decode(), path.decode())
                if answer:
                    writer.write(answer)
                    while answer.endswith(b"endless"):
                        writer.write(b"x" * 65536)
                        await writer.drain()
                    break
                if self.lot(self.fail):
                    writer.write(b"HTTP/1.1 503 Slow Down\r\nContent-Length: 0\r\n\r\n")
                    continue
                if body and self.lot(self.corrupt):
                    body = body[:len(body) // 2] + bytes([body[len(body) // 2] ^ 1]) + body[len(body) // 2 + 1:]
                if not upstream:
                    upstream = await asyncio.open_connection(*self.upstream.removeprefix("http://").split(":"), limit=1 << 20)
                self.put_bytes[path.decode()] += len(body)
                upstream[1].write(head + body)
                if not await self.answer(upstream[0], writer, method, b"list-type" in path):
                    break
        except (asyncio.IncompleteReadError, ConnectionError, asyncio.CancelledError):
            pass
        finally:
            self.tasks.discard(asyncio.current_task())
            writer.close()
            if upstream:
                upstream[1].close()

    async def answer(self, reader, writer, method, is_list):
        """Passes an answer on. Returns whether the connection goes on."""
        head = await reader.readuntil(b"\r\n\r\n")
        fields = dict(line.lower().split(b": ", 1) for line in head.split(b"\r\n")[1:] if b": " in line)
        chunked = fields.get(b"transfer-encoding") == b"chunked"
        left = 0 if method == b"HEAD" or chunked else int(fields.get(b"content-length", 0))
        writer.write(head)
        if chunked:
            while size := await reader.readline():
                writer.write(size + await reader.readexactly(int(size, 16) + 2))
                if int(size, 16) == 0:
                    return True
        is_get = method == b"GET" and left
        cut = is_get and self.lot(self.cut) and left // 2
        corrupt = is_get and not is_list and self.lot(self.corrupt) and left // 2  # S3 has no checksums of lists
        while left:
            data = await reader.read(min(left, 1 << 16))
            if not data:
                return False
            if corrupt and left > corrupt >= left - len(data):
                data, corrupt = data[:-1] + bytes([data[-1] ^ 1]), False
            await self.pace(len(data))
            writer.write(data)
            await writer.drain()
            left -= len(data)
            if cut and left <= cut:
                return False
        return b"close" not in fields.get(b"connection", b"")
