# harness.py: functions shared by the tests of the program: run the program, read its pictures and
# check its reports.
import itertools
import json
import os
import pathlib
import shutil
import struct
import subprocess
import tempfile
import time
import unittest
import zlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
OWN_MODELS = ROOT / "tests" / "models"
SHARED_MODELS = pathlib.Path(os.environ.get("LAMBENT_MODELS", ROOT.parent / "shared" / "models"))
PROGRAM = os.environ.get("LAMBENT", str(ROOT / "build" / "lambent"))
HAS_SANDBOX = b"sandbox off" not in subprocess.run([PROGRAM, "--version"], stdout=subprocess.PIPE).stdout


def long(test):
    """Marks a test of `make test-long`; otherwise, tests/cli/run.py skips it."""
    test.long = True
    return test


def wait_until_caught(process, number):
    """Waits until the program catches signals; an earlier signal would end it immediately."""
    for _ in range(1000):
        with open(f"/proc/{process.pid}/status") as status:
            caught = next(line for line in status if line.startswith("SigCgt")).split()[1]
        if int(caught, 16) >> (number - 1) & 1:
            return
        time.sleep(0.01)
    raise TimeoutError("the program does not catch the signal")


def writers_and_others(pid):
    """The child processes of a process: the writer processes of the sandbox, and the others, as soon as they can be distinguished."""
    children = pathlib.Path(f"/proc/{pid}/task/{pid}/children")
    for _ in range(1000):
        try:
            names = [(int(child), pathlib.Path(f"/proc/{child}/comm").read_text().strip()) for child in children.read_text().split()]
        except OSError:
            return [], []
        writers = [child for child, name in names if name == "lambent-writer"]
        others = [child for child, name in names if name != "lambent-writer"]
        # A writer gets its name shortly after it starts, and each process that draws to a file has a writer.
        if not HAS_SANDBOX or len(others) <= len(writers):
            break
        time.sleep(0.001)
    return writers, others


class Case(unittest.TestCase):
    """A test in an empty folder of its own, with copies of tests/models/cube.*."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="lambent-cli-"))
        self.addCleanup(shutil.rmtree, self.folder, True)
        for model in OWN_MODELS.glob("cube.*"):
            shutil.copy(model, self.folder)
        self.given = set(os.listdir(self.folder))

    def run_program(self, *words, stdin=b"", env=None, stdout=subprocess.PIPE, timeout=60, user=None):
        environment = {k: v for k, v in os.environ.items() if k not in ("NO_COLOR", "TERM")}
        environment["XDG_CONFIG_HOME"] = str(self.folder / "no-settings")  # ignore the settings of the user who runs the tests
        environment.update(env or {})
        given = {"stdin": stdin} if hasattr(stdin, "fileno") else {"input": stdin}
        return subprocess.run([PROGRAM, *map(str, words)], cwd=self.folder, stdout=stdout, stderr=subprocess.PIPE,
                              env=environment, timeout=timeout, user=user, **given)

    def good(self, *words, **more):
        """Runs the program, which must succeed."""
        done = self.run_program(*words, **more)
        self.assertEqual(done.returncode, 0, f"lambent {' '.join(map(str, words))}: {done.stderr.decode()}")
        return done

    def bad(self, code, *words, says=(), leaves=(), **more):
        """Runs the program, which must fail with this exit code and an error message that contains all texts in `says`, and must make no files
        except `leaves`."""
        before = set(os.listdir(self.folder))
        done = self.run_program(*words, **more)
        text = done.stderr.decode(errors="replace")
        self.assertEqual(done.returncode, code, f"lambent {' '.join(map(str, words))}: {text}")
        self.assertTrue(text.startswith("lambent: "), text)
        for part in [says] if isinstance(says, str) else says:
            self.assertIn(part, text)
        self.assertLessEqual(set(os.listdir(self.folder)) - before, set(leaves))
        return done

    def plain_user(self):
        """The user for tests of permissions: root may do everything, so the test switches to nobody."""
        if os.geteuid() != 0:
            return None
        os.chmod(self.folder, 0o755)
        try:
            self.run_program("--version", user=65534).check_returncode()
        except (OSError, subprocess.SubprocessError):
            self.skipTest("runs as root, and nobody may not start the program")
        return 65534

    def new_files(self):
        return set(os.listdir(self.folder)) - self.given

    def report(self, *words, **more):
        """Runs the program, which must succeed; returns its checked report."""
        report = json.loads(self.good(*words, "--json", **more).stdout)
        check_report(self, report)
        return report

    def png(self, *words, **more):
        """The picture that a run writes to standard output, as (width, height, RGBA bytes)."""
        return read_png(self.good(*words, "-o", "-", **more).stdout)


def pixel(picture, x, y):
    width, _, data = picture
    return tuple(data[(y * width + x) * 4:(y * width + x) * 4 + 4])


def covered(picture):
    """The bounding box of the pixels that are not transparent: (left, top, right, bottom), right and bottom excluded."""
    width, height, data = picture
    inside = [i for i in range(width * height) if data[i * 4 + 3]]
    columns = [i % width for i in inside]
    return min(columns), inside[0] // width, max(columns) + 1, inside[-1] // width + 1


def png_chunks(data):
    """The checked chunks of a PNG, as (kind, body)."""
    assert data[:8] == b"\x89PNG\r\n\x1a\n", data[:20]
    at = 8
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + length]
        assert zlib.crc32(kind + body) == struct.unpack(">I", data[at + 8 + length:at + 12 + length])[0], kind
        yield kind, body
        at += 12 + length


def read_png(data):
    """Decodes an 8-bit PNG without a palette or interlacing to RGBA, and checks every chunk."""
    packed, texts = b"", {}
    for kind, body in png_chunks(data):
        if kind == b"IHDR":
            width, height, depth, color, _, _, interlace = struct.unpack(">IIBBBBB", body)
            assert depth == 8 and color in (0, 2, 4, 6) and interlace == 0
        elif kind == b"IDAT":
            packed += body
        elif kind == b"tEXt":
            name, text = body.split(b"\0", 1)
            texts[name.decode()] = text.decode()
    assert texts.get("Software", "").startswith("lambent"), texts
    return width, height, decode_png(width, height, color, packed)


def decode_png(width, height, color, packed):
    """The RGBA pixels of a PNG's zlib stream."""
    step = {0: 1, 4: 2, 2: 3, 6: 4}[color]
    raw, rows, before = zlib.decompress(packed), bytearray(), bytes(width * step)
    assert len(raw) == height * (width * step + 1)
    for y in range(height):
        start = y * (width * step + 1)
        row = bytearray(raw[start + 1:start + 1 + width * step])
        unfilter(raw[start], row, before, step)
        before = row
        pixels = bytearray(b"\xff") * (width * 4)
        for channel in range(4 if step % 2 == 0 else 3):  # grey gives three channels; the last channel is alpha
            pixels[channel::4] = row[step - 1 if channel == 3 else min(channel, (step - 1) // 2 * 2)::step]
        rows += pixels
    return bytes(rows)


def chunk(kind, body):
    """A chunk of a PNG file."""
    return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))


def write_png(width, height, pixels):
    """RGBA, unfiltered."""
    raw = b"".join(b"\0" + pixels[y * width * 4:(y + 1) * width * 4] for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b""))


def unfilter(kind, row, before, step):
    if kind == 0:
        return
    if kind == 1:
        for channel in range(step):
            row[channel::step] = bytes(sum & 255 for sum in itertools.accumulate(row[channel::step]))
        return
    if kind == 2:
        row[:] = bytes((a + b) & 255 for a, b in zip(row, before))
        return
    for i in range(len(row)):
        left, up = row[i - step] if i >= step else 0, before[i]
        if kind == 3:
            guess = (left + up) // 2
        else:
            corner = before[i - step] if i >= step else 0
            from_left, from_up, from_corner = abs(up - corner), abs(left - corner), abs(left + up - 2 * corner)
            guess = left if from_left <= from_up and from_left <= from_corner else up if from_up <= from_corner else corner
        row[i] = (row[i] + guess) & 255


SCHEMA = json.loads((ROOT / "docs" / "report.schema.json").read_text())


def check_report(case, report):
    check_value(case, report, SCHEMA, "report")
    if report["error"] is None and "planned" not in report:
        for key in ("image", "camera", "device", "times_ms", "counts"):
            case.assertIn(key, report)


def check_value(case, value, schema, place, root=SCHEMA):
    """Implements the part of JSON Schema that the schemas of docs/ use (`root` is the complete schema); an unknown keyword is an error."""
    known = {"type", "enum", "required", "dependentRequired", "additionalProperties", "properties", "items", "minItems", "maxItems", "minimum",
             "$ref", "$defs", "$schema", "title", "description"}
    case.assertLessEqual(set(schema), known, place)
    if "$ref" in schema:
        schema = root["$defs"][schema["$ref"].rsplit("/", 1)[1]]
    if "enum" in schema:
        case.assertIn(value, schema["enum"], place)
    if "type" in schema:
        kinds = schema["type"] if isinstance(schema["type"], list) else [schema["type"]]
        case.assertTrue(any(is_kind(value, kind) for kind in kinds), f"{place}: {value!r} is not {kinds}")
    if isinstance(value, dict):
        needed = [key for given, keys in schema.get("dependentRequired", {}).items() if given in value for key in keys]
        for key in [*schema.get("required", ()), *needed]:
            case.assertIn(key, value, place)
        others = schema.get("additionalProperties", False)
        for key, inner in value.items():
            if others is False:
                case.assertIn(key, schema["properties"], place)
            check_value(case, inner, schema.get("properties", {}).get(key, others), f"{place}.{key}", root)
    if isinstance(value, list):
        case.assertGreaterEqual(len(value), schema.get("minItems", 0), place)
        case.assertLessEqual(len(value), schema.get("maxItems", len(value)), place)
        for i, inner in enumerate(value):
            check_value(case, inner, schema["items"], f"{place}[{i}]", root)
    if "minimum" in schema and value is not None:
        case.assertGreaterEqual(value, schema["minimum"], place)


def is_kind(value, kind):
    if isinstance(value, bool):
        return kind == "boolean"
    return {"object": isinstance(value, dict), "array": isinstance(value, list), "boolean": False, "string": isinstance(value, str),
            "integer": isinstance(value, int), "number": isinstance(value, (int, float)), "null": value is None}[kind]
