"""stores.py: reads and writes whole objects by their addresses: S3 by boto3, http and https by urllib3, folders, and everything else by fsspec.

A store has four functions: `list` the objects below a folder, `open` one for reading, `tag` tells whether one has changed, `put` writes one whole."""
import base64
import contextlib
import datetime
import functools
import hashlib
import mimetypes
import os
import re
import threading
import time
import urllib.parse

TRIES, CHUNK, CONNECTIONS = 5, 1 << 18, 64
LOCK = threading.Lock()  # a store is made once, and all threads share it


class Problem(Exception):
    """A failure in one sentence. `name` and `exit` are those of the exit codes; `cause` is model or machine, as in the journal."""

    def __init__(self, text, name="cannot-read", exit=2, cause="model", kind=""):
        super().__init__(text)
        self.name, self.exit, self.cause, self.kind = name, exit, cause, kind


class Broken(Exception):
    """A transfer that was cut or damaged on its way, so it is tried again."""


def join(folder, name):
    return folder + name if not folder or folder.endswith("/") else folder + "/" + name


def folder_of(address):
    return address[:address.rfind("/") + 1]


def inside(name):
    """Whether a relative path stays in its folder."""
    return bool(name) and not {"", ".", ".."}.intersection(name.split("/")) and "\\" not in name and "\0" not in name


def parts_of(address):
    """s3://bucket/a/b -> Bucket, Key"""
    return dict(zip(("Bucket", "Key"), address.split("://", 1)[1].partition("/")[::2]))


class Store:
    """What a store does unless it does better."""

    def list(self, folder):
        raise Problem("%s: this store does not list its files; name the models with --list" % folder, "usage", 1)

    def put(self, address, data):
        raise Problem("%s: Lambent only reads from this store" % address, "usage", 1)

    def sentence(self, error):
        """The sentence of an error, and its kind: the object is gone, the model or the machine is at fault, or trying again may help."""
        text = getattr(error, "strerror", None) or str(error).split("\n")[0] or type(error).__name__
        return text, "gone" if isinstance(error, FileNotFoundError) else "model" if isinstance(error, (IsADirectoryError, PermissionError)) else "again"


class Files(Store):
    """Folders of this machine. A link that leads out of the folder of the run is not followed."""

    def list(self, folder):
        for path, folders, names in os.walk(folder or "."):
            folders[:] = sorted(name for name in folders if not name.startswith("."))
            for name in sorted(names):
                file = os.path.join(path, name)
                if not name.startswith(".") and os.path.isfile(file):
                    yield join(folder, os.path.relpath(file, folder or ".")), os.path.getsize(file), self.tag(file)

    def open(self, address, root):
        if not (os.path.realpath(address) + "/").startswith(os.path.join(os.path.realpath(root or "."), "")):
            raise Problem("%s: is a link that leads out of %s" % (address, root or "."))
        stream = open(address, "rb")
        return stream, os.fstat(stream.fileno()).st_size, self.tag(address), None

    def tag(self, address):
        found = os.stat(address)
        return "%x-%x" % (found.st_mtime_ns, found.st_size)

    def put(self, address, data):
        os.makedirs(folder_of(address) or ".", exist_ok=True)
        part = "%s.%x.part" % (folder_of(address), time.time_ns())
        with open(part, "wb") as file:
            file.write(data)
        os.replace(part, address)
        return self.tag(address)


class S3(Store):
    """S3 and its kind. Retries and deadlines of requests are botocore's; a body is compared with its length and its MD5."""

    SENTENCES = {
        "NoSuchBucket": "there is no such bucket", "NoSuchKey": "there is no such object", "AccessDenied": "access is denied to this key (AWS_ACCESS_KEY_ID)",
        "InvalidAccessKeyId": "the store does not know the key (AWS_ACCESS_KEY_ID)", "SignatureDoesNotMatch": "the secret (AWS_SECRET_ACCESS_KEY) does not belong to the key",
        "RequestTimeTooSkewed": "this machine's clock differs from the store's by more than 15 minutes; set the clock"}

    def __init__(self):
        import boto3
        from botocore.config import Config
        config = Config(retries={"mode": "standard", "max_attempts": 4}, connect_timeout=10, read_timeout=60, max_pool_connections=CONNECTIONS,
                        parameter_validation=False)
        self.client = boto3.Session().client("s3", endpoint_url=os.environ.get("AWS_ENDPOINT_URL_S3") or os.environ.get("AWS_ENDPOINT_URL"), config=config)

    def list(self, folder):
        bucket, prefix = parts_of(folder).values()
        page, more = {"IsTruncated": True}, {}
        while page["IsTruncated"]:
            page = attempt(folder, lambda _: self.client.list_objects_v2(Bucket=bucket, Prefix=prefix, **more))
            more = {"ContinuationToken": page.get("NextContinuationToken")}
            for found in page.get("Contents", ()):
                if not found["Key"].endswith("/"):
                    yield "s3://%s/%s" % (bucket, found["Key"]), found["Size"], found["ETag"].strip('"')

    def open(self, address, root):
        answer = self.client.get_object(**parts_of(address))
        tag = answer["ETag"].strip('"')
        plain = re.fullmatch("[0-9a-f]{32}", tag) and not answer.get("SSECustomerAlgorithm") and answer.get("ServerSideEncryption", "AES256") == "AES256"
        return answer["Body"], answer.get("ContentLength"), tag, tag if plain else None

    def tag(self, address):
        return self.client.head_object(**parts_of(address))["ETag"].strip('"')

    def put(self, address, data):
        kind = mimetypes.guess_type(address)[0] or "application/octet-stream"
        checksum = base64.b64encode(hashlib.md5(data).digest()).decode()  # the store refuses bytes that were damaged on the way
        return self.client.put_object(**parts_of(address), Body=data, ContentMD5=checksum, ContentType=kind)["ETag"].strip('"')

    def sentence(self, error):
        from botocore import exceptions
        if isinstance(error, exceptions.ClientError):
            status, code = error.response["ResponseMetadata"].get("HTTPStatusCode", 0), error.response["Error"].get("Code", "")
            code = {"404": "NoSuchKey", "403": "AccessDenied"}.get(code, code)  # of an answer without a body
            if 300 <= status < 400:
                return "the store redirects to another address, which Lambent does not follow", "model"
            return self.SENTENCES.get(code, "the store answers %s (%s)" % (code, error.response["Error"].get("Message", ""))), \
                "again" if code == "BadDigest" or status >= 500 else "gone" if code == "NoSuchKey" else "machine"
        if isinstance(error, (exceptions.NoCredentialsError, exceptions.PartialCredentialsError)):
            return "there are no credentials; set AWS_ACCESS_KEY_ID and AWS_SECRET_ACCESS_KEY, or AWS_PROFILE", "machine"
        if isinstance(error, exceptions.EndpointConnectionError):
            return "cannot connect to %s; check AWS_ENDPOINT_URL" % self.client.meta.endpoint_url, "machine"
        return str(error).split("\n")[0], "again"


class Web(Store):
    """http and https, only for reading."""

    def __init__(self):
        import urllib3
        self.pool = urllib3.PoolManager(maxsize=CONNECTIONS, retries=False, timeout=urllib3.Timeout(connect=10, read=60))

    def request(self, method, address):
        answer = self.pool.request(method, urllib.parse.quote(address, "/:%?=&@+~,;!$'()*[]"), preload_content=False, redirect=False)
        if 300 <= answer.status < 400:
            raise Problem("%s: redirects to %s, which Lambent does not follow" % (address, answer.headers.get("Location", "")[:200]))
        if answer.status in (404, 410):
            raise FileNotFoundError(answer.status, "there is no such file")
        if answer.status != 200:
            raise Broken("the server answers %d" % answer.status)
        return answer

    def open(self, address, root):
        answer = self.request("GET", address)
        length = answer.headers.get("Content-Length", "")
        return answer, int(length) if length.isdecimal() else None, self.tag(address, answer), None

    def tag(self, address, answer=None):
        answer = answer or self.request("HEAD", address)
        return answer.headers.get("ETag") or answer.headers.get("Last-Modified") or answer.headers.get("Content-Length") or "none"


class Other(Store):
    """Every other address that fsspec knows. The tests run it only with fsspec's store in memory."""

    def __init__(self, protocol):
        import fsspec
        self.store, self.protocol = fsspec.filesystem(protocol), protocol

    def tag_in(self, found):
        marks = [found[name] for name in ("ETag", "etag", "md5Hash", "generation", "mtime", "last_modified", "updated", "created") if found.get(name)]
        mark = marks[0] if marks else time.time_ns()  # never the same, if the store does not tell
        mark = mark.replace(tzinfo=mark.tzinfo or datetime.timezone.utc).timestamp() if isinstance(mark, datetime.datetime) else mark
        return "%s-%s" % (mark, found.get("size"))

    def list(self, folder):
        for path, found in sorted(attempt(folder, lambda _: self.store.find(folder, detail=True)).items()):
            yield "%s://%s" % (self.protocol, path.lstrip("/")), found["size"], self.tag_in(found)

    def open(self, address, root):
        found = self.store.info(address)
        return self.store.open(address, "rb"), found["size"], self.tag_in(found), None

    def tag(self, address):
        return self.tag_in(self.store.info(address))

    def put(self, address, data):
        self.store.makedirs(folder_of(address), exist_ok=True)
        self.store.pipe_file(address + ".part", data)
        self.store.mv(address + ".part", address)
        return self.tag(address)


@functools.cache
def store_named(protocol):
    return {"": Files, "s3": S3, "http": Web, "https": Web}.get(protocol, lambda: Other(protocol))()


def store_of(address):
    protocol = re.match(r"([a-z][a-z0-9+.-]*)://", address)
    with LOCK:
        try:
            return store_named(protocol[1] if protocol else "")
        except Exception as error:  # a missing package, or settings that boto3 rejects
            raise Problem("%s: %s" % (address, error), "unsupported", 3) from None


def attempt(address, action, name="cannot-read", exit=2):
    """Calls an action of a store. Transfers that broke off are tried again; a failure becomes a Problem."""
    store = store_of(address)
    for number in range(TRIES):
        try:
            return action(store)
        except Exception as error:
            if isinstance(error, Problem):
                raise
            text, fault = (str(error), "again") if isinstance(error, Broken) else store.sentence(error)
            if fault != "again" or number == TRIES - 1:
                raise Problem("%s: %s" % (address, text), name, exit, "machine" if fault in ("again", "machine") or exit == 5 else "model", fault) from None
        time.sleep(min(0.05 * 2 ** number, 5))


def fetch(address, path, root="", limit=1 << 30):
    """Copies an object into a file, whole and unchanged. Returns its tag and its number of bytes."""

    def once(store):
        stream, length, tag, checksum = store.open(address, root)
        count, digest = 0, hashlib.md5()
        with contextlib.closing(stream), open(path, "wb") as file:
            while max(count, length or 0) <= limit and (data := stream.read(CHUNK)):
                file.write(data)
                digest.update(data if checksum else b"")
                count += len(data)
        if max(count, length or 0) > limit:
            raise Problem("%s: has %d bytes or more; --size-limit is %d" % (address, max(count, length or 0), limit), "limit", 4)
        if length not in (None, count) or checksum not in (None, digest.hexdigest()):
            raise Broken("%d of %s bytes arrived, or they differ from the store's checksum" % (count, length))
        if isinstance(store, Files) and store.tag(address) != tag:
            raise Broken("changes while it is read")
        return tag, count

    return attempt(address, once)


def put(address, data):
    return attempt(address, lambda store: store.put(address, data), "cannot-write", 5)


def tag(address):
    """What changes when the object does; None if there is none."""
    try:
        return attempt(address, lambda store: store.tag(address))
    except Problem as problem:
        if problem.kind != "gone":
            raise


def listed(folder):
    """The objects below a folder as (address, bytes, tag), in the order of their names, as they come."""
    return store_of(folder).list(folder if folder.endswith("/") or not folder else folder + "/")


def read(address, limit=1 << 30):
    """The bytes of a small object."""
    import tempfile
    with tempfile.NamedTemporaryFile() as file:
        fetch(address, file.name, folder_of(address), limit)
        return file.read()
