#!/usr/bin/env python3
"""contracts.py LAMBENT [--check]: writes docs/check/contracts.md: for each built-in contract, its names, a correct program (classroom/tests/check), and the
reports of `lambent check` for the course's own programs (classroom/tests/check/lectures). Without OpenGL the page does not change.

--check compares the page with the generated page, except for the reports, and fails if they differ."""
import json
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PAGE = os.path.join(ROOT, "docs", "check", "contracts.md")
SHADERS = os.path.join("classroom", "tests", "check")
sys.path.insert(0, os.path.join(ROOT, SHADERS))
from lectures import LECTURES  # noqa: E402

# The correct program that the page shows for each contract. `lambent shader` prints the program for
# Lambent's own contract.
CORRECT = {"pittsburgh": "pittsburgh", "oregon": "oregon", "nyu": "nyu", "learnopengl": "learnopengl", "learnopengl-pbr": "learnopengl-pbr", "gltf": "gltf", "angel": "angel", "mdn": "mdn",
           "threejs": "threejs", **{name: name for name in ("webglfundamentals", "feup", "stthomas", "chile", "glsl120")}}
SPACES = {"eye": "eye space", "world": "world space", "object": "the model's space"}
REPORT = "`lambent check %s.frag --vertex %s.vert%s` reports:"


def read(*path):
    with open(os.path.join(ROOT, *path), encoding="utf-8") as file:
        return file.read()


def indented(text):
    return "".join("    " + line if line.strip() else line for line in text.rstrip().splitlines(keepends=True)) + "\n"


def report(program, name, options):
    """The report of a program of classroom/tests/check, without the driver's name."""
    done = subprocess.run([program, "check", name + ".frag", "--vertex", name + ".vert", *options.split()], cwd=os.path.join(ROOT, SHADERS),
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    if done.returncode == 3:
        return None
    if done.returncode not in (0, 6):
        sys.exit("contracts.py: %s: %s" % (name, done.stderr.decode()))
    text = re.sub(r"(?m)^(  contract .*shader); .*$", r"\1", done.stdout.decode())
    return text.replace("lectures/", "") if done.returncode else "".join(text.splitlines(keepends=True)[:2])


def meanings(program):
    schema = json.loads(subprocess.run([program, "generate", "contract-schema"], stdout=subprocess.PIPE, check=True).stdout)
    return {role["const"]: role["description"] for kind in ("attribute", "uniform", "constant")
            for role in schema["$defs"][kind + "_role"]["oneOf"]}


def names_table(contract, meaning):
    """Returns a row for each name; members of light structs that repeat an earlier struct share its row."""
    yield "| | name | type | meaning |"
    yield "|---|---|---|---|"
    groups = {}
    for kind in ("attributes", "uniforms"):
        for name, row in contract.get(kind, {}).items():
            if row["role"] == "zero":
                continue
            text = row.get("meaning", meaning[row["role"]])
            place = row.get("space", contract["space"]) if row["role"] in IN_SPACE else None
            text += "; in " + SPACES[place] if place and SPACES[place] not in text else ""
            own = "`%s`" % name + "".join(", `%s`" % other for other in row.get("also", ()))
            before, _, member = name.rpartition(".")
            same = groups.setdefault((member, text, row["type"]), []) if before else []
            same.append([kind[:-1], own, row["type"], text])
            if len(same) == 1:
                yield same[0]
            else:
                same[0][1] += ", `%s`" % name


IN_SPACE = {"normal_matrix", "eye_position", "light_position", "light_x", "light_y", "light_z", "light_direction", "light_travel"}


def facts(contract):
    yield "GLSL " + ", ".join(contract["glsl"])
    yield "lit in " + SPACES[contract["space"]]
    yield "terms: " + ", ".join(contract["terms"])
    if "specular" in contract["terms"]:
        yield "highlight: " + {"phong": "Phong's", "blinn-phong": "Blinn–Phong's", "metallic-roughness": "metalness and roughness"}[contract["highlight"]]


FORMS = {"masking": {"smith": "Smith's masking for GGX with correlated heights", "schlick": "Schlick's approximation of the masking, k = (roughness + 1)²/8"},
         "diffuse": {"dielectric": "a diffuse part of (1 − metallic)(1 − F), F from 0.04", "mix": "a diffuse part of (1 − metallic)(1 − F)",
                     "whole": "a diffuse part of 1 − metallic"},
         "tone": {"reinhard": "Reinhard's tone curve"}, "encoding": {"gamma": "gamma-encoded, pow(x, 1/2.2)"}}

MAPS = {"colors": {"linear": "the colours are linear, because the sampler converts a texture with an sRGB format",
                   "gamma": "the colours are encoded, and the shader decodes them with pow(x, 2.2)"},
        "v": {"up": "v runs upward in the picture", "down": "v runs downward in the picture, as in glTF files"}}


def value(x):
    words = {"diffuse": "the surface's", "light": "the light's"}
    return ", ".join("%g" % part for part in x) if isinstance(x, list) else words[x] if x in words else "%g" % x


def files(name):
    return ", ".join("[%s.%s](../../classroom/tests/check/%s.%s)" % (os.path.basename(name), ending, name, ending) for ending in ("vert", "frag"))


def section(program, contract, meaning):
    name = contract["name"]
    yield "## `%s`" % name
    yield ""
    yield "%s. %s." % (contract["title"], "; ".join(facts(contract)))
    yield ""
    rows = list(names_table(contract, meaning))
    yield from (row if isinstance(row, str) else "| %s | %s | %s | %s |" % tuple(row) for row in rows)
    built_ins = contract.get("built_ins")
    if built_ins:
        yield ""
        yield "Built-in GLSL names: " + ", ".join("`%s`" % word for word in built_ins) + "."
    fixed = contract.get("undeclared", {})
    if fixed:
        yield ""
        yield "Values for inputs that a shader does not declare: " + "; ".join("`%s` %s" % (key, value(x)) for key, x in fixed.items()) + "."
    numbers = contract.get("constants", {})
    if numbers:
        yield "Variables whose numbers replace these values: " + ", ".join("`%s`" % key for key in numbers) + "."
    forms = contract.get("physical")
    if forms:
        yield ""
        yield "Metalness and roughness: " + "; ".join(FORMS[key][word] for key, word in forms.items() if word in FORMS[key]) + "."
    maps = contract.get("maps")
    if maps:
        yield "Maps: " + "; ".join(MAPS[key][word] for key, word in maps.items()) + "."
    correct = CORRECT.get(name)
    if correct:
        yield ""
        yield "The vertex shader of a correct program (%s):" % files(correct)
        yield ""
        yield indented(read(SHADERS, correct + ".vert"))
        yield "The fragment shader of this program:"
        yield ""
        yield indented(read(SHADERS, correct + ".frag"))
        # If the names leave strengths open, the use of the inputs decides; the name selects the
        # contract.
        yield from reported(program, correct, " --contract " + name if contract.get("strengths") == "any" else "")
    if contract.get("printed"):
        yield ""
        yield "`lambent shader` prints correct programs of this contract ([shaders](../shaders.md)).\n"
    for lecture, course, title, _, _ in LECTURES:
        if course == name:
            yield "The course's own program, %s (%s)." % (title, files("lectures/" + lecture))
            yield from reported(program, "lectures/" + lecture, " --contract " + name)


def reported(program, name, options=""):
    text = report(program, name, options) if program else ""
    if text is None:
        sys.exit(0)  # no OpenGL
    yield REPORT % (name, name, options)
    yield ""
    yield indented(text) if program else ""


def glance():
    yield "| contract | the course's own program | `lambent check` |"
    yield "|---|---|---|"
    for _, course, title, verdict, found in LECTURES:
        # For programs that compile, the expected findings are names of mistakes; otherwise they are parts of the
        # messages and hints.
        text = ", ".join("`%s`" % x for x in found) if verdict == "differs" else "; ".join(x.replace("|", "\\|") for x in found)
        yield "| [`%s`](#%s) | %s | %s: %s |" % (course, course, title, verdict, text)
    yield ""


def page(program, runs):
    meaning = meanings(program)
    yield """# Built-in contracts of `lambent check`

This page lists the names that each built-in contract expects, and the mistakes that the check finds in the courses' own programs.

`scripts/contracts.py` (`make docs`) writes this page. Each section contains a contract's names, a correct program, and the report on
the course's own program, rewritten with the same mistakes. [Checking a shader](../check.md) explains the reports, and [contract
files](contract-file.md) explains how to write your own contract.
"""
    yield from glance()
    order = re.findall(r'\{"([\w-]+)", text_\w+_json\}', read("classroom", "check", "contract", "contract.c"))
    for name in order:
        yield "\n".join(section(program if runs else None, json.loads(read("classroom", "check", "contracts", name + ".json")), meaning)) + "\n"


def without_reports(text):
    """The page without the indented blocks after each report's mark."""
    return re.sub(r"(?m)(^`lambent check .*` reports:\n)(?:(?:    .*)?\n)*", r"\1", text)


def main():
    program = os.path.abspath(sys.argv[1])
    if "--check" in sys.argv:
        expected = re.sub(r"\n{3,}", "\n\n", "\n".join(page(program, False)))
        if without_reports(expected) != without_reports(read("docs", "check", "contracts.md")):
            sys.exit("docs/check/contracts.md is not up to date: scripts/contracts.py %s" % sys.argv[1])
        return
    text = re.sub(r"\n{3,}", "\n\n", "\n".join(page(program, True)))
    with open(PAGE, "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main()
