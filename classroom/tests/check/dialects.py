"""dialects.py: rewrites the shaders of this folder, which are GLSL 120, in other versions of GLSL.

A dialect is the text of the version line without `#version `; "" means no version line, and "web" means WebGL 1: no version line, and mediump."""
import re

OLD = ("", "110", "120", "100", "web")
COMPATIBILITY = ("130", "140", "150 compatibility", "330 compatibility", "400 compatibility")
CORE = ("150", "330", "330 core", "400", "410 core", "430 core", "450")
ES = ("100", "web", "300 es", "310 es")
DESKTOP_OLD = ("", "110", "120")
ALL = ("", "110", "120", "130", "140", "150", "330 core", "400", "450", "330 compatibility", "100", "web", "300 es", "310 es")


def translate(text, ending, dialect, output="frag_color", precision=None):
    """Converts a GLSL 120 shader (`ending`: vert or frag) to a dialect. `precision` applies to ES; None means mediump in version 100, and otherwise
    highp."""
    text = re.sub(r"^#version .*\n", "", text)
    first = "#version %s\n" % dialect if dialect not in ("", "web") else ""
    if dialect in ES and ending == "frag":
        first += "precision %s float;\n" % (precision or ("mediump" if dialect in ("web", "100") else "highp"))
    if dialect in OLD:
        return first + text
    text = re.sub(r"\bvarying\b", "out" if ending == "vert" else "in", text)
    text = re.sub(r"\battribute\b", "in", text)
    if ending == "frag" and dialect not in COMPATIBILITY and "gl_FragColor" in text:
        text = "out vec4 %s;\n" % output + text.replace("gl_FragColor", output)
    return first + text
