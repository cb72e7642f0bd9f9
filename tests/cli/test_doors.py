# test_doors.py: the same wish through two doors gives the same picture, or the same refusal. The doors are the command line, a scene
# file, a scene file that the program has saved, a job, the settings file, and the page with `lambent view`; tests/python/test_doors.py
# adds Python. doors.py generates the rows from the program's tables.
import base64
import concurrent.futures
import difflib
import fnmatch
import hashlib
import json
import os
import re
import shutil
import subprocess
import threading
import unittest
import urllib.parse

import doors
from harness import PROGRAM, ROOT, Case, read_png
from test_scene import SCHEMA, misfit
from view_server import ViewCase

# Disagreements that stay, with the reason. "DOOR: SUBJECT: ROW"; * stands for any text.
DECIDED = {
    "scene: camera: more: no*": "--camera without eye changes the fitted camera; a scene file documents a default eye",
    "scene: environment: more: *": "--environment-rotation also turns the environment of a scene file; an empty object names nothing",
    "*: environment: builtin unknown": "--environment also accepts a picture, which each door opens in its own folders",
    "*: image: more: both modes": "of options given twice the last counts; a file contains one of them",
    "scene: camera: ortho and ortho_half_height": "two names of a key; the test writes both as ortho for the option",
    "*: image: size one": "-s 800 is short for 800x800",
    "settings: image: color *": "settings files never had the former name of color_mode",
    "page: *: name empty": "the page writes lights that the program has read, so the name is not empty",
}
# Keys that a door lacks, because it spells them in another way.
LACKING = {
    "words": {"camera: ortho_half_height", "material: name"},
    "schema": set(),
}
# Doors whose refusals use the sentence of the command line. Files name the path of the key instead.
SAME_SENTENCES = ("command line", "saved", "page")

# Keys that no row makes visible in the picture, with the reason.
INVISIBLE = {
    **{f"{subject}: name": "reports and --show use it" for subject in doors.LIGHTS},
    **{f"{subject}: object": "the object is at the origin" for subject in doors.LIGHTS},
    "ambient: frame": "ambient light has no direction",
    **{f"camera: {key}": "needs other keys; rows of MORE, and test_cameras.py" for key in ("fx", "fy", "cx", "cy", "pose", "width", "height")},
    "directional: target": "rows of MORE contain it together with position",
    "environment: faces": "pictures: test_environment.py",
    "environment: equirectangular": "pictures: test_environment.py",
    "setting: anisotropy": "needs a texture: test_textures.py",
    **{f"setting: {key}": "needs bounces: test_bounces.py" for key in ("caustics", "denoise", "noise", "stop_after")},
    "setting: map_filter": "needs a texture: test_textures.py",
    "setting: brighten": "needs a model file: test_newcomers.py",
    "setting: glass": "needs a blended material with a name: test_gltf.py",
    "setting: light_cutoff": "skips weak lights among many: test_many_lights.c",
    "setting: line_width": "needs lines: test_strokes.c",
    "setting: point_size": "needs points: test_strokes.c",
}

SENTENCE = re.compile(r"(?:lambent: |line \d+: |option '--[\w-]+': |[\w./-]+\.json(?::\d+)?: |[a-z_]+(?:\[\d+\])?(?:\.[a-z_]+(?:\[\d+\])?)*: )")


def sentence(text):
    """A message without the place that it names, and without the value as the user has spelled it."""
    text = text.strip().split("\n")[0]
    while found := SENTENCE.match(text):
        text = text[found.end():]
    return re.sub(r"(?:found|\w+ is) .*?, expected", "expected", text)


def picture(data):
    return "picture", hashlib.sha1(data).hexdigest()


def refused(text):
    return "refused", sentence(text)


ROWS = doors.rows(doors.schema_of(PROGRAM))


class DoorCase(Case):
    """Compares doors with jobs, which contain the options of the command line. The jobs are drawn once for all tests."""

    words, said, used = None, None, set()

    def setUp(self):
        super().setUp()
        if not DoorCase.words:
            DoorCase.words = self.jobs(ROWS)

    def jobs(self, rows):
        """Draws rows in one worker. Its jobs contain the options of the command line."""
        def job(name, row):
            return json.dumps({"id": name, "model": doors.MODEL[0], "format": "png", "options": {"segments": "24x12", **row.context(), **row.options()}})
        done = self.run_program("batch", "--jobs", "-", "-q", stdin="\n".join(job(*item) for item in rows.items()).encode(), timeout=300)
        answers = {answer["id"]: answer for answer in map(json.loads, done.stdout.splitlines()) if "id" in answer}
        drawn = {name: base64.b64decode(answer["data"]) for name, answer in answers.items() if not answer["exit"]}
        DoorCase.said = {name: re.sub(r"^line \d+: ", "", answer["error"] or "") for name, answer in answers.items()}
        DoorCase.said.update({name: "%dx%d %s" % (*read_png(data)[:2], hashlib.sha1(read_png(data)[2]).hexdigest()[:16]) for name, data in drawn.items()})
        return {name: picture(drawn[name]) if name in drawn else refused(answers[name]["error"]) for name in rows}

    def each(self, work, rows):
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            return dict(zip(rows, pool.map(work, rows.values())))

    def command(self, *words):
        done = self.run_program(*words, "-o", "-", "-q", "--threads=1")
        self.assertIn(done.returncode, (0, 1, 2), (words, done.stderr))
        return picture(done.stdout) if done.returncode == 0 else refused(done.stderr.decode())

    def compare(self, door, found):
        """Compares results with those of the command line, and the disagreements with the table."""
        def outcome(name, result):
            return result if result[0] == "picture" or door in SAME_SENTENCES and " wrong " not in name else result[:1]
        apart = {name: (DoorCase.words[name], result) for name, result in found.items() if outcome(name, result) != outcome(name, DoorCase.words[name])}
        expected = [pattern for pattern in DECIDED if fnmatch.fnmatchcase(door, pattern.split(":")[0])]
        new = {name: pair for name, pair in apart.items() if not any(fnmatch.fnmatchcase(f"{door}: {name}", pattern) for pattern in expected)}
        DoorCase.used |= {pattern for pattern in expected if any(fnmatch.fnmatchcase(f"{door}: {name}", pattern) for name in apart)}
        gone = [pattern for pattern in expected if pattern not in DoorCase.used and not pattern.startswith("*")]
        lines = [f"{name}\n    job: {' '.join(a)}\n    {door}: {' '.join(b)}" for name, (a, b) in new.items()]
        if new or gone:
            self.fail("\n".join([f"{door}: {len(new)} of {len(found)} rows disagree", *lines[:60], *(f"these rows agree, so delete the line: {one}" for one in gone)]))

    def recorded(self, door, said):
        """Compares with the file in tests/cli/doors_recorded. LAMBENT_UPDATE=1 records it again."""
        path = ROOT / "tests" / "cli" / "doors_recorded" / f"{door}.txt"
        found = [f"{name} = {said[name]}\n" for name in sorted(said)]
        if os.environ.get("LAMBENT_UPDATE"):
            path.write_text("".join(found))
        before = path.read_text().splitlines(True)
        self.assertEqual(found, before, "".join(difflib.unified_diff(before, found, "recorded", "found", n=0)))

    def drawn_scenes(self, scenes, said=None):
        """Draws scene files in one run of batch. Stores the messages of refused files in `said`."""
        names = list(scenes)
        for i, name in enumerate(names):
            (self.folder / f"{i}.json").write_text(scenes[name])
        self.run_program("batch", *(f"{i}.json" for i in range(len(names))), "-o", "out/{stem}.png", "--journal", "journal", "-q", timeout=300)
        found = {}
        for line in (self.folder / "journal").read_text().splitlines():
            entry = json.loads(line)
            if "model" in entry:
                name = names[int(entry["model"].removesuffix(".json"))]
                self.assertIn(entry["exit"], (0, 2), entry)
                if said is not None and entry["exit"]:
                    said[name] = re.sub(r"^\d+\.json: ", "", entry["error"])
                found[name] = refused(entry["error"]) if entry["exit"] else picture((self.folder / entry["output"]).read_bytes())
        return found


class Doors(DoorCase):
    def test_scene(self):
        said = {}
        scenes = {name: row.scene() for name, row in ROWS.items()}
        found = self.drawn_scenes({name: json.dumps(scene) for name, scene in scenes.items()}, said)
        self.compare("scene", found)
        self.recorded("scene", said)
        # The schema accepts each scene that the program draws. It cannot express rules between keys, so it accepts some that the program refuses.
        wrong = {name: why for name, scene in scenes.items() if (why := misfit(scene, SCHEMA)) and found[name][0] == "picture"}
        wrong.pop("point: more: flag of occluded", None)  # a former spelling
        self.assertEqual(wrong, {})
        for name, row in ROWS.items():
            if " wrong " in name and not name.endswith(" name") or name.endswith((" below", ": more: unknown")):
                self.assertIsNotNone(misfit(scenes[name], SCHEMA), name)

    def test_command_line(self):
        """Each key once in a process of its own, which also saves the scene; the saved scene gives the same picture."""
        def draw(row):
            return self.command(*doors.MODEL, *row.words(), "--no-config", f"--save-scene={self.folder}/saved-{id(row)}.json")
        rows = {name: row for name, row in ROWS.items() if " and " not in name}
        found = self.each(draw, rows)
        self.compare("command line", found)
        self.compare("saved", self.drawn_scenes({name: (self.folder / f"saved-{id(row)}.json").read_text() for name, row in rows.items() if found[name][0] == "picture"}))

    def test_settings(self):
        def draw(row):
            path = self.folder / f"{id(row)}.json"
            path.write_text(json.dumps(row.settings()))
            return self.command(*doors.MODEL, *doors.words_of({name: value for name, value in row.context().items() if name not in row.options()}), "--config", path)
        self.compare("settings", self.each(draw, {name: row for name, row in ROWS.items() if row.settings() is not None}))

    def test_recorded(self):
        """The pixels and the messages of jobs are the recorded ones."""
        self.recorded("job", DoorCase.said)

    def test_visible(self):
        """Each key changes the picture of a row, so that a door that ignores the key is noticed."""
        schema = doors.schema_of(PROGRAM)
        unseen = {f"{subject}: {key}" for subject in doors.SUBJECTS for key in doors.properties(schema, subject) if not doors.visible(ROWS, DoorCase.words, subject, key)}
        self.assertEqual(unseen, set(INVISIBLE))


class Page(DoorCase, ViewCase):
    def test_page(self):
        """The page keeps the words of a command line, and writes the lights of a scene as words; `lambent view` draws its pictures."""
        if not shutil.which("node"):
            self.skipTest("node is missing")
        script = self.folder / "page.mjs"
        script.write_text(f"""import {{ lightWords }} from '{ROOT}/web/page/words/lights.js';
import {{ State, toFragment, fromFragment }} from '{ROOT}/web/page/words/state.js';
import {{ readFileSync }} from 'node:fs';
const rows = JSON.parse(readFileSync(0));
console.log(JSON.stringify(rows.map(({{ words, light }}) => {{
  if (light) words = new State(words).withValues('light', [lightWords(light)]);
  return fromFragment(toFragment(words));
}})));
""")
        rows = {name: row for name, row in ROWS.items() if " and " not in name or row.subject in ("point", "hemisphere")}
        given = [{"words": [*doors.MODEL, *row.words()], "light": row.keys if row.subject in doors.LIGHTS else None}
                 for row in rows.values()]
        done = subprocess.run(["node", script], input=json.dumps(given).encode(), stdout=subprocess.PIPE, check=True)
        server = self.serve("cube.obj")

        def draw(words):
            # A client of its own, because a client's next request cancels its last one.
            query = urllib.parse.urlencode([("w", word) for word in words] + [("c", threading.get_ident())])
            status, _, body = server.get("picture?" + query)
            return picture(body) if status == 200 else refused(body.decode())
        self.compare("page", self.each(draw, dict(zip(rows, json.loads(done.stdout)))))


class Tables(Case):
    """Each door has each key of the tables."""

    def test_keys(self):
        schema = doors.schema_of(PROGRAM)
        lacking = {"words": set(), "schema": set()}
        for subject in (*doors.LIGHTS, "material", "camera"):
            words, keys = doors.keys_of_words(PROGRAM, subject), set(doors.properties(schema, subject))
            lacking["words"] |= {f"{subject}: {key}" for key in keys - words}
            lacking["schema"] |= {f"{subject}: {key}" for key in words - keys}
        self.assertEqual(lacking, LACKING)

    def test_metals(self):
        """A material's name means the same in each door, under each look."""
        names = [line.split()[0] for line in self.good("materials").stdout.decode().splitlines() if len(line.split()) == 11]
        self.assertGreaterEqual(len(names), 24)
        looks = [word.removeprefix("--look=") for word in doors.completions(PROGRAM, "teapot", "--look=") if word.startswith("--look=")]
        self.assertIn("classic", looks)
        for name in names:
            (self.folder / "m.json").write_text(json.dumps({"lambent": 1, "image": doors.IMAGE, "objects": [{**doors.OBJECT, "material": name}]}))
            for look in looks if name in ("gold", "ruby") else looks[:1]:
                words = ["--look", look, "--size=16", "--samples=1", "-o", "-", "--no-config"]
                with self.subTest(name=name, look=look):
                    self.assertEqual(self.good("m.json", *words).stdout, self.good(*doors.MODEL, "--material", name, *words).stdout)
