"""_options.py: keyword arguments: the rows of the library's table of settings, and the members of its parameter structs."""
import difflib
import math
import os

import numpy as np

from ._core import BadValue, every, path_bytes, shown, text_of
from ._fields import choose, color, range_of, words_of
from ._members import MEMBERS
from ._native import ffi, lib

# Members that are not keywords, and members whose program option has another name.
LEFT_OUT = {"reserved", "user", "open", "release", "cancel", "progress", "override_color", "from_angles", "normals_when_drawn", "allowed_path_count", "threads"}
OTHER_NAMES = {"color": "color_mode", "fovy": "fov", "output": "show"}
UNITS = ("_rad", "_s", "_bytes")

# Numbers outside the valid range that mean "the default" in the library; nan is outside every
# range.
RANGES = {"zoom": (0, math.inf), "fov": (0, 180), "time_limit": (0, math.inf)}


def range_in_words(low, high):
    return "above %g" % low + (" and below %g" % high if high < math.inf else "") if low > -math.inf else "that is finite"


class Member:
    """A keyword that sets a member of a struct."""

    def __init__(self, struct, member, kind):
        self.struct, self.member, self.kind = struct, member, kind
        name = next((member.removesuffix(unit) for unit in UNITS if member.endswith(unit) and not member.startswith("file_limit")), member)
        self.name, self.doc = OTHER_NAMES.get(name, name), MEMBERS[struct][member]
        self.words = words_of(kind.cname.removeprefix("enum ")) if kind.kind == "enum" else None
        if member == "rig":
            self.words = {"file" if word == "none" else word: value for word, value in self.words.items()}
        numbers = "float" if kind.cname in ("float", "double") else "Sequence[str]" if kind.cname == "char * *" else "str" if kind.kind == "pointer" else "int"
        self.type = "Color" if kind.kind == "struct" else "bool" if kind.cname == "_Bool" else "Literal" if self.words else numbers

    def store(self, struct, value, kept, mode):
        setattr(struct, self.member, self.value(value, kept, mode))
        if self.kind.cname == "char * *":
            struct.allowed_path_count = len(value)

    def value(self, value, kept, mode):
        if self.words:
            return choose(self.name, self.words, value)
        if self.type == "Color":
            return color(self.name, value, mode)
        low, high = RANGES.get(self.name, (-math.inf, math.inf))
        if isinstance(value, (int, float)) and self.type == "float" and not low < value < high:
            raise BadValue("%s: found %s, expected a number %s" % (self.name, shown(value), range_in_words(low, high)))
        if self.name == "crease_angle" and isinstance(value, (int, float)) and not 0 <= value <= 180:
            raise BadValue("crease_angle: found %s, expected a number from 0 to 180" % shown(value))
        try:
            if self.type in ("str", "Sequence[str]"):
                texts = [ffi.new("char[]", path_bytes(str(text))) for text in ([value] if self.type == "str" else value)]
                kept += texts
                kept.append(ffi.new("char *[]", texts))
                return texts[0] if self.type == "str" else kept[-1]
            number = float(value) if self.type == "float" else value
            return math.radians(number) if self.member.endswith("_rad") else ffi.new(self.kind.cname + " *", number)[0]
        except (TypeError, ValueError, OverflowError):
            raise BadValue("%s: found %s, expected %s" % (self.name, shown(value), {"bool": "True or False", "int": "a whole number", "float": "a number"}.get(self.type, "a " + self.type))) from None


class Setting:
    """A keyword that sets a row of the table of settings."""

    def __init__(self, row):
        self.row, self.name, self.member, self.struct = row, text_of(row.key), text_of(row.member), "lam_draw_params"
        self.words = self.words_of_row() if row.word else None
        self.flag = row.type in (lib.LAM_SETTING_FLAG, lib.LAM_SETTING_NOT_FLAG)
        self.number = row.type in (lib.LAM_SETTING_WHOLE, lib.LAM_SETTING_NUMBER, lib.LAM_SETTING_ANGLE)
        words = [text_of(row.summary)]
        if self.number:
            words += [range_of(row.min, row.max) + " degrees" * (row.type == lib.LAM_SETTING_ANGLE)] + ["default %.4g" % row.standard] * (row.standard >= row.min)
        self.doc = " ".join(words[:1]) + (" (%s)" % "; ".join(words[1:]) if words[1:] else "")
        self.type = ("bool" if self.flag else "str" if row.type == lib.LAM_SETTING_WORDS else "Literal" if self.words else
                     "int" if row.type == lib.LAM_SETTING_WHOLE else "float" if self.number else "Color")

    def words_of_row(self):
        found, value, index = {}, ffi.new("int *"), 0
        while (word := self.row.word(index, value)) != ffi.NULL:
            found[text_of(word)], index = value[0], index + 1
        return found

    def store(self, struct, value, kept, mode):
        setattr(struct, self.member, self.value(value, mode))

    def value(self, value, mode):
        row = self.row
        if self.flag:
            wanted = value if isinstance(value, bool) else choose(self.name, {"on": True, "off": False}, value)
            return wanted != (row.type == lib.LAM_SETTING_NOT_FLAG)
        if row.type == lib.LAM_SETTING_WORDS:
            words, bits = {**self.words, "all": sum(set(self.words.values())), "none": 0}, 0
            for word in value if hasattr(value, "__iter__") and not isinstance(value, str) else str(value).split(","):
                bits |= choose(self.name, words, word)
            return bits
        if self.words:
            return choose(self.name, self.words, value)
        if not self.number:
            found = color(self.name, value, mode)
            return found if row.type == lib.LAM_SETTING_RGBA else found[:3]
        whole = row.type == lib.LAM_SETTING_WHOLE
        try:
            number = float(value)
        except (TypeError, ValueError):
            number = math.nan
        if not (row.min <= number <= row.max or row.zero and number == 0) or whole and number != int(number):
            raise BadValue("%s: found %s, expected %s %s%s" % (self.name, shown(value), "a whole number from" if whole else "a number from",
                                                             range_of(row.min, row.max), ", or 0" if row.zero else ""))
        if row.zero_is_negative and number == 0:
            return -1
        return int(number) if whole else math.radians(number) if row.type == lib.LAM_SETTING_ANGLE else number


def find_keywords():
    found = {setting.name: setting for setting in map(Setting, every(lib.lam_draw_setting))}
    members = {setting.member for setting in found.values()}
    for struct in ("lam_draw_params", "lam_load_params", "lam_view", "lam_control"):
        for name, field in ffi.typeof(struct).fields:
            if name not in LEFT_OUT and not (struct == "lam_draw_params" and name in members):
                member = Member(struct, name, field.type)
                found.setdefault(member.name, member)
    return found


KEYWORDS = find_keywords()
STRUCTS = {"lam_draw_params", "lam_view", "lam_control"} # of an existing scene
# Keywords outside the tables, with type and meaning.
OTHERS = {
    "view": ("Literal", "The side to look from: a name; azimuth and elevation replace its angles."),
    "camera": ("Camera | str", "The camera, or its words (\"eye=2/1/4,fovy=40\"), or the name of a camera of the file."),
    "floats": ("bool", "Linear floats, premultiplied by alpha, in place of 8 bits."),
    "threads": ("int", "Threads that load and draw; 0: one for each processor."),
}
# Keywords that change the scene; allowed only for models that the call loads.
CHANGES = {
    "material": ("Material | str", "For all surfaces: a material, or words such as \"ruby\" and \"roughness=0.3\", which change the file's."),
    "light": ("Light | str | Sequence[Light | str]", "Lights in place of the file's and the studio's, which `rig` names."),
    "ambient": ("Color", "Light from everywhere, in addition to the lights."),
    "color": ("Color", "The colour of all materials; the model's own colours multiply it."),
    "hide": ("str | Sequence[str]", "Names of objects, parts or materials that are not drawn."),
    "only": ("str | Sequence[str]", "Names of objects, parts or materials; all others are not drawn."),
    "rotate": ("str | Sequence[str]", "Turns the model about its centre: \"y:30\", an axis and degrees; several in order."),
    "environment": ("str", "A picture, or a built-in environment, that lights all materials."),
    "reflection_map": ("str", "The same in place of environment; classic materials only reflect it, by their reflectivity."),
    "section": ("str | Sequence[str]", "Planes that cut the model: \"x=0\", \"z=40%\" (docs/sections.md)."),
    "environment_rotation": ("float", "Its angle about the up axis, in degrees."),
}


def keywords_of(structs=None):
    """The keywords that are members of these structs; None means all."""
    return {name: keyword for name, keyword in KEYWORDS.items() if structs is None or keyword.struct in structs}


class Options:
    """The checked keyword arguments of a call."""

    def __init__(self, given, structs=None, others=()):
        names = [*keywords_of(structs), *others, "threads"]
        for name in given:
            if name not in names:
                close = difflib.get_close_matches(name, names, 1)
                known = "; it is for lambent.render with a model" if name in {*KEYWORDS, *OTHERS, *CHANGES} else ""
                raise TypeError("unexpected keyword argument %r%s" % (name, "; did you mean %r?" % close[0] if close and not known else known))
        self.given, self.kept = {name: value for name, value in given.items() if value is not None}, []
        # The program's words for lights: with "file", only the scene's lights are used; "none" and "default" remove them.
        self.no_lights = str(self.given.get("rig")) in ("none", "default")
        if self.no_lights:
            self.given["rig"] = "file" if self.given["rig"] == "none" else "auto"
        around = str(self.given.get("background", "")).partition(":")
        if around[0] == "environment" and "background_environment" in names: # the form of --background
            del self.given["background"]
            self.given["background_environment"] = max(float(around[2]), 0.045) if around[1] else 0.045
        self.mode = choose("color_mode", KEYWORDS["color_mode"].words, self.given.get("color_mode", "srgb"))
        self.fit_exposure = str(self.given.get("exposure")) == "auto"
        if self.fit_exposure:
            del self.given["exposure"]
        self.load, self.control = self.filled("lam_load_params"), self.filled("lam_control")
        self.filled("lam_draw_params")
        if not isinstance(self.given.get("floats", False), (bool, np.bool_)):
            raise BadValue("floats: found %s, expected True or False" % shown(self.given["floats"]))
        side = choose("view", words_of("lam_side"), self.given.get("view", "three-quarter"))
        self.view = self.filled("lam_view", lib.lam_view_of_side(side))

    def __contains__(self, name):
        return name in self.given

    def get(self, name, otherwise=None):
        return self.given.get(name, otherwise)

    def filled(self, struct, start=None):
        """A struct whose members are set from the keywords."""
        made = ffi.new(struct + " *", *([start] if start is not None else []))
        for name, value in self.given.items():
            if name in KEYWORDS and (KEYWORDS[name].struct == struct or KEYWORDS[name].name == "color_mode" and struct == "lam_load_params"):
                KEYWORDS[name].store(made, value, self.kept, self.mode)
        return made


def describe_keywords(groups, structs=None):
    """The description of the keywords for docstrings."""
    rows = [(name, doc) for group in groups for name, (_, doc) in group.items()]
    rows += [(name, keyword.doc + (" [%s]" % ", ".join(keyword.words) if keyword.words else "")) for name, keyword in keywords_of(structs).items()]
    return "".join("    %-18s %s\n" % row for row in rows)
