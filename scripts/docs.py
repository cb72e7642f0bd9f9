#!/usr/bin/env python3
"""docs.py LAMBENT [--text]: regenerates the generated parts of the documentation: the manual of the command line, the tables that are
made from the program's own numbers, and (not with --text) every picture drawn by a command in a Markdown file of the project. Such a
command is a line of a code block that begins with `lambent ` and names its picture with `-o docs/pictures/…`. A generated table is between `<!--
NAME: made by scripts/docs.py -->` and `<!-- end of NAME -->`."""
import glob
import json
import math
import os
import re
import shlex
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def pages():
    return [os.path.join(ROOT, "README.md")] + sorted(glob.glob(os.path.join(ROOT, "docs", "**", "*.md"), recursive=True))


def commands():
    for path in pages():
        for line in open(path, encoding="utf-8"):
            if re.match(r"\s*lambent .*-o docs/pictures/", line):
                yield shlex.split(line, comments=True)


os.environ["CI"] = "docs"  # the pages must not depend on the user's settings


def output(program, *words):
    return subprocess.run([program, *words], stdout=subprocess.PIPE, check=True).stdout.decode()


def grey(color):
    """A colour with equal channels as one number, any other colour as three."""
    return "%g" % color[0] if len(set(color)) == 1 else ", ".join("%g" % c for c in color)


def light_row(rig, light):
    place, more = "", []
    if light["type"] == "directional":
        place = ", ".join("%g" % (0.0 - x) for x in light["direction"]).replace("-", "−")
    if "position" in light:
        # of a ball: half the diagonal of its box is the root of 3
        unit, size = ("d", math.sqrt(3)) if light.get("frame") == "view" else ("r", 1)
        place = ", ".join("%g%s" % (round(x / size, 4), unit) for x in light["position"]).replace("-", "−")
    if light["type"] in ("ambient", "hemisphere"):
        more = ["%s %s" % (key, grey(light[key])) for key in ("ambient", "sky", "ground") if key in light]
    elif any(light["ambient"]):
        more = ["ambient " + grey(light["ambient"])]
    if "attenuation" in light:
        a, b, c = light["attenuation"]
        more.append("attenuation %g/%g/%g" % (a, b, c) if "position" not in light or light.get("frame") != "view" else
                    "attenuation %g/%g/%.3gd" % (a, b * math.sqrt(3), c * 3))
    name = light["name"] + ("" if light["name"] == light["type"] else ", " + light["type"])
    return "| %s | %s | %s | %s | %s | %s |" % (rig, name, place, grey(light["diffuse"]) if "diffuse" in light else "",
                                                grey(light["specular"]) if "specular" in light else "", "; ".join(more))


def rigs(program, _):
    """The rigs' lights, from `lambent lights` for a sphere with radius 1 around the origin: of few triangles, and of many (curved)."""
    yield "| rig | light | from | diffuse | specular | others |"
    yield "|---|---|---|---|---|---|"
    manual = output(program, "generate", "markdown")
    words = re.search(r"(?m)^\| `--rig NAME`.*$", manual).group()
    for rig in re.findall(r"<br>`([\w-]+)`:", words):
        if rig in ("auto", "none", "file", "default"):
            continue
        for segments, form in (("16x8", ""), ("64x32", ", curved models")):
            if rig == "studio" or not form:
                lights = json.loads(output(program, "lights", "sphere", "--segments", segments, "--rig", rig))["lights"]
                for i, light in enumerate(lights):
                    yield light_row("`%s`%s" % (rig, form) if i == 0 else "", light)


def explained(program, before):
    """The output of the last command before the section, as a code block."""
    command = re.findall(r"`lambent (explain [^`]*)`", before)[-1]
    yield ""
    for line in output(program, *shlex.split(command)).splitlines():
        yield "    " + line if line else ""
    yield ""


def roles(program, _):
    """The keys of a name in a contract of `lambent check`, from its schema."""
    kinds = json.loads(output(program, "generate", "contract-schema"))["$defs"]
    found = {}
    for kind, word in (("attribute", "attribute"), ("uniform", "uniform"), ("constant", "number")):
        for role in kinds[kind + "_role"]["oneOf"]:
            found.setdefault(role["const"], (role["description"], []))[1].append(word)
    yield "| role | for | meaning |"
    yield "|---|---|---|"
    for name, (meaning, words) in found.items():
        yield "| `%s` | %s | %s |" % (name, ", ".join(words), meaning)


def settings(program, _):
    """The keys of scene files that are also options, from the schema: keys with a default and an option of the same name."""
    schema = json.loads(output(program, "generate", "scene-schema"))["properties"]
    manual = output(program, "generate", "markdown")
    yield "| key | default | values | meaning |"
    yield "|---|---|---|---|"
    for key, value in schema.items():
        if "$ref" in value and "color" in value["$ref"] and key != "ambient":
            yield "| `%s` | none | a colour | %s |" % (key, value["description"])
            continue
        if key == "up" or ("default" not in value and value.get("type") != "number") or "`--%s" % key.replace("_", "-") not in manual:
            continue
        if value["type" if "type" in value else "enum"] == "array":
            yield "| `%s` | none | a list of %s | %s |" % (key, ", ".join("`\"%s\"`" % word for word in value["items"]["enum"]), value["description"])
            continue
        values = ", ".join("`%s`" % word for word in value["enum"]) if "enum" in value else \
            "`true`, `false`" if value["type"] == "boolean" else "%.10g to %.10g" % (value["minimum"], value["maximum"])
        standard = "`%s`" % json.dumps(value["default"]).strip('"') if "default" in value else "–"
        yield "| `%s` | %s | %s | %s |" % (key, standard, values, value["description"])


def mistakes(program, _):
    """The mistakes of `lambent shader --mistake`."""
    yield "| `--mistake` | mistake | visible effect | needs |"
    yield "|---|---|---|---|"
    for row in json.loads(output(program, "shader", "--mistake", "list", "--json")):
        yield "| `%s` | %s | %s | %s |" % (row["mistake"], row["wrong"], row["looks"], row["needs"] or "")


def formats(program, _):
    """The formats of models and pictures, from `lambent formats`."""
    written, read = re.findall(r"(?m)^  (\w+) +((?:\.\w+ ?)+(?:\w+)?)(?:  (.*))?$", output(program, "formats")), output(program, "formats").splitlines()[-1]
    yield "| format | extensions | use |"
    yield "|---|---|---|"
    for name, endings, numbers in written:
        yield "| `%s` | %s | %s |" % (name, ", ".join("`.%s`" % ending.strip(".") for ending in endings.split()),
                                      "reads models" + (", %s" % numbers if numbers and "lambent-formats" in numbers else "")
                                      if not numbers or "lambent-formats" in numbers else "writes pictures: " + numbers)
    yield ""
    yield "Pictures can be read from these formats: %s." % read.strip()


SECTIONS = {"formats": formats, "rigs": rigs, "explained": explained, "roles": roles, "settings": settings, "mistakes": mistakes}


def pages_with_sections(program):
    """The pages with generated sections, up to date, by their path in the project."""
    made = {}
    for path in pages():
        with open(path, encoding="utf-8") as file:
            text = file.read()
        for name, lines in SECTIONS.items():
            begin, end = "<!-- %s: made by scripts/docs.py -->\n" % name, "<!-- end of %s -->" % name
            if begin in text:
                before, rest = text.split(begin, 1)
                text = before + begin + "\n".join(lines(program, before)) + "\n" + end + rest.split(end, 1)[1]
                made[os.path.relpath(path, ROOT)] = text
    return made


def main():
    program = os.path.abspath(sys.argv[1])
    texts = {"docs/command-line.md": output(program, "generate", "markdown"), **pages_with_sections(program)}
    for path, text in texts.items():
        with open(os.path.join(ROOT, path), "w", encoding="utf-8") as file:
            file.write(text)
    if "--text" in sys.argv:
        return
    subprocess.run([sys.executable, os.path.join(ROOT, "scripts", "contracts.py"), program], check=True)
    os.makedirs(os.path.join(ROOT, "docs", "pictures", "lighting"), exist_ok=True)
    for command in commands():
        print(" ".join(command))
        done = subprocess.run([program] + command[1:], cwd=ROOT)
        # The exit code of a check is its verdict: 6 means that the shader fails. 3: no OpenGL here; the sheet stays unchanged.
        by_opengl = command[1] == "check" or "mistake=" in " ".join(command)
        if done.returncode not in ((0, 3, 6) if by_opengl else (0,)):
            sys.exit("docs.py: %s ended with %d" % (" ".join(command), done.returncode))


if __name__ == "__main__":
    main()
