"""The keywords, materials, lights and cameras of the package give the pictures and the refusals of the command line: the rows of tests/cli/doors.py."""
import base64
import fnmatch
import json
import os
import pathlib
import subprocess
import sys
import unittest

import lambent

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cli"))
import doors  # noqa: E402

PROGRAM = os.environ["LAMBENT"]

# Disagreements that stay, with the reason, and those of today, as in tests/cli/test_doors.py.
DECIDED = {
    "camera: more: no*": "Camera has the default eye of a scene file; --camera without eye changes the fitted camera",
    "material: name empty": "Material has the default name \"\", a material without a name",
}
KNOWN = {
    "point: more: object named": "the object is looked up in the scene that is drawn",
    "point: more: object in frame": "the object is looked up in the scene that is drawn",
    "environment: *rotation*": "-360000 to 360000 degrees",
    "setting: ambient *": "a colour without alpha",
    "setting: ground_color *": "a colour without alpha",
}


def keywords(row):
    """The row as keyword arguments."""
    keys = row.keys
    if row.subject in doors.LIGHTS:
        return {"light": lambent.Light(**keys)}
    if row.subject == "material":
        return {"material": keys if isinstance(keys, str) else lambent.Material(keys.get("name", ""), **{key: value for key, value in keys.items() if key != "name"})}
    if row.subject == "camera":
        return {"camera": lambent.Camera(**{doors.OPTION_NAMES.get("camera." + key, key): value for key, value in keys.items()})}
    names = {"environment.builtin": "environment", "environment.rotation": "environment_rotation", "reflection_map.builtin": "reflection_map", "image.color": "color_mode"}
    return {names.get(f"{row.subject}.{key}", key): value for key, value in keys.items()}


class Doors(unittest.TestCase):
    def test_rows(self):
        rows = {name: row for name, row in doors.rows(doors.schema_of(PROGRAM)).items()
                if row.subject not in ("image", "environment") or not {"size", "faces", "equirectangular"} & set(row.keys)}
        jobs = "\n".join(json.dumps({"id": name, "model": doors.MODEL[0], "format": "png", "options": {"segments": "24x12", **row.context(), **row.options()}})
                         for name, row in rows.items())
        done = subprocess.run([PROGRAM, "batch", "--jobs", "-", "-q"], input=jobs.encode(), stdout=subprocess.PIPE)
        answers = {answer["id"]: answer for answer in map(json.loads, done.stdout.splitlines()) if "id" in answer}
        apart, used, known = [], set(), {**DECIDED, **KNOWN}
        for name, row in rows.items():
            wanted = base64.b64decode(answers[name]["data"]) if answers[name]["exit"] == 0 else None
            scene = doors.root_of(row.more)
            try:
                found = lambent.render(json.dumps(scene).encode(), name="s.json", threads=1, **keywords(row)).png()
            except (lambent.Error, AttributeError, TypeError) as error:
                found, said = None, error
            if found != wanted:
                pattern = next((one for one in known if fnmatch.fnmatchcase(name, one)), None)
                used.add(pattern)
                if not pattern:
                    apart.append("%s: %s, %s" % (name, answers[name]["error"] or "a picture", "a picture" if found else repr(said)))
        gone = ["these rows agree, so delete the line: " + one for one in set(known) - used]
        if apart or gone:
            self.fail("\n".join(["%d of %d rows disagree" % (len(apart), len(rows)), *apart[:80], *gone]))
