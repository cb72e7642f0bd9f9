# doors.py: rows for the test of all doors. A row is one wish about a light, a material, a camera, an environment or a setting,
# written for each door. The rows are generated from the schema of scene files, which the program prints from its tables, and from
# the completions of options. tests/cli/test_doors.py and tests/python/test_doors.py compare the doors.
import json
import re
import subprocess

# The model of all rows, for the command line and for a scene file.
MODEL = ["torus", "--segments=24x12"]
OBJECT = {"shape": "torus", "slices": 24, "stacks": 12}
IMAGE = {"size": [16, 16], "samples": 1}
CAMERA = {"eye": [2, 1.5, 3], "target": [0, 0, 0]}

# A subject: the path of its object in the schema, the settings that make its keys visible, and the keys that all rows of the subject
# contain. "material" is the material of the object.
PAINT = {"ambient": [0.1, 0.2, 0.3], "diffuse": [0.6, 0.5, 0.4], "specular": [0.3, 0.3, 0.3], "shininess": 9}
LAMP = {"type": "point", "position": [3, 0.5, 0.5], "ambient": [0.2, 0.3, 0.2]}
LIT = {"shadows": True, "ao": "rays", "ao_samples": 4, "ao_radius": 1, "camera": CAMERA, "material": PAINT}
SEEN = {"camera": CAMERA, "lights": [LAMP]}
PHYSICAL = {"material": {"metallic": 1, "roughness": 0.4}, "environment": {"builtin": "studio"}}
EDGES = {"edges": ["crease", "silhouette"], "edge_angle": 10}
SUBJECTS = {
    "ambient": ("$defs/ambient_light", LIT, {"type": "ambient"}),
    "hemisphere": ("$defs/hemisphere_light", LIT, {"type": "hemisphere"}),
    "point": ("$defs/point_light", LIT, {"type": "point", "position": [3, 0.5, 0.5]}),
    "directional": ("$defs/directional_light", LIT, {"type": "directional", "direction": [-3, -0.5, -0.5]}),
    "spot": ("$defs/spot_light", LIT, {"type": "spot", "position": [3, 0.5, 0.5], "direction": [-3, -0.5, -0.5]}),
    "material": ("$defs/material", {**SEEN, "reflection_map": {"builtin": "studio"}}, {}),
    "camera": ("properties/camera", {}, {"eye": [2, 1.5, 3]}),
    "environment": ("properties/environment", {**SEEN, "material": {"reflectivity": [0.8, 0.8, 0.8]}}, {"builtin": "studio"}),
    "image": ("properties/image", {"camera": CAMERA}, {}),
    "setting": ("", SEEN, {}),
}
# Further settings for the rows of a key, so that the key is visible.
CONTEXT = {
    "material: fibre": {"reflection": "kajiya-kay"}, "material: roughness_angle": {"reflection": "oren-nayar"}, "material: toon_steps": {"reflection": "toon"},
    "setting: match_highlights": {"material": PAINT}, "setting: single_scattering": PHYSICAL, "setting: reference": PHYSICAL, "setting: background_environment": PHYSICAL, "setting: specular_aa": PHYSICAL,
    "setting: gl1": {"material": {**PAINT, "shininess": 200}}, "setting: shadow_terminator": {"shadows": True},
    "setting: shadow_samples": {"shadows": True, "lights": [{**LAMP, "radius": 1}]}, "setting: flat_normal": {"shading": "flat"}, "setting: ao": {"ao_radius": 1}, "setting: ao_radius": {"ao": "rays"},
    "setting: ao_samples": {"ao": "rays", "ao_radius": 1}, "setting: paths": {"bounces": 1},
    "setting: wireframe_width": {"wireframe": True}, "setting: wireframe_color": {"wireframe": True}, "setting: edge_angle": {"edges": ["crease"]},
    "setting: edge_width": EDGES, "setting: edge_color": EDGES, "setting: hidden_lines": EDGES,
}
LIGHTS = ("ambient", "hemisphere", "point", "directional", "spot")
GROUPS = ("image", "environment", "setting")
NOT_SETTINGS = ("lambent", "image", "camera", "environment", "reflection_map", "materials", "objects", "lights", "sections")

# Other names of keys as options.
OPTION_NAMES = {"image.color": "color-mode", "environment.builtin": "environment", "environment.rotation": "environment-rotation", "reflection_map.builtin": "reflection-map", "camera.ortho_half_height": "ortho"}
PAIRED = {"ground_color": {"ground": "color"}}  # keys that belong together
PARTNERS = {"near": "far", "far": "near", "ground_color": "ground"}  # keys of which one alone is refused


def schema_of(program):
    return json.loads(subprocess.run([program, "generate", "scene-schema"], stdout=subprocess.PIPE, check=True).stdout)


def completions(program, *words):
    lines = subprocess.run([program, "complete", "--", *words], stdout=subprocess.PIPE, check=True).stdout.decode().splitlines()
    return [line.split("\t")[0] for line in lines]


def keys_of_words(program, subject):
    """The keys that an option completes."""
    word = {"material": "--material=", "camera": "--camera="}.get(subject, f"--light={subject}:")
    return {found[1] for line in completions(program, "teapot", word) if (found := re.match(r"--\w+=(?:\w+:)?(\w+)=$", line))}


def properties(schema, subject):
    """The keys of a subject with their schemas; a reference is replaced by its target."""
    at = schema
    for step in filter(None, SUBJECTS[subject][0].split("/")):
        at = at[step]
    found = {key: value for key, value in at["properties"].items() if key != "type" and not (subject == "setting" and key in NOT_SETTINGS)}

    def resolved(value):
        return {**resolved(schema["$defs"][value["$ref"].rsplit("/", 1)[1]]), **value} if "$ref" in value else value
    return {key: resolved(value) for key, value in found.items()}


def number_values(about):
    low, high = about.get("minimum", about.get("exclusiveMinimum")), about.get("maximum")
    whole = about["type"] == "integer"
    middle = (low or 0) + ((high if high is not None and high < 1e5 else (low or 0) + 3) - (low or 0)) / 5
    found = {"middle": int(middle) if whole else middle}
    if low is not None:
        found.update(minimum=low, below=low - 1)
    if high is not None and high < 1000:
        found["maximum"] = high
    if high is not None:
        found["above"] = 2 * high
    if "default" in about:
        found["default"] = about["default"]
    if whole and high > 1e5:
        found["middle"] = 64
    return {**found, "large": 1e31, "wrong text": "many", "wrong list": [1, 2], **({"wrong fraction": 2.5} if whole else {})}


COLORS = {"middle": [0.2, 0.4, 0.6], "zero": [0, 0, 0], "above": [2, 0.5, 0.25], "hex": "#ff8800", "short": "#f80", "name": "orange", "number": 0.5,
          "below": [-0.1, 0.2, 0.3], "alpha": "#ff880080", "wrong name": "nocolour", "wrong two": [1, 0.5], "four": [0.2, 0.3, 0.4, 0.5], "opaque": [1, 1, 1, 2]}
MATRICES = {9: [20, 0, 7.5, 0, 20, 7.5, 0, 0, 1], 16: [1, 0, 0, 0.5, 0, -1, 0, 0.5, 0, 0, -1, 4, 0, 0, 0, 1]}  # K and pose
VECTORS = {"middle": [0.5, 1, 2], "zero": [0, 0, 0], "wrong two": [1, 2], "wrong number": 5, "wrong text": "north"}


def values(about):
    """Values for a key by a name: allowed values, and values that each door refuses. "wrong" in the name means that the value has another type; doors may
    describe the type that they expect in their own spelling."""
    if "anyOf" in about:
        return COLORS
    if "enum" in about or "examples" in about:
        return {**{str(word): word for word in about.get("enum", about.get("examples"))}, "unknown": "nonsense"}
    kind = about["type"] if isinstance(about["type"], str) else about["type"][0]  # a number, or a text with a unit
    if kind in ("number", "integer"):
        return number_values(about)
    if kind == "boolean":
        return {"true": True, "false": False, "wrong text": "maybe", "wrong list": [1, 2]}
    if kind == "string":
        return {"middle": "lamp", "empty": ""}
    if "enum" in about["items"]:
        words = about["items"]["enum"]
        return {"one": words[:1], "all": words, "none": [], "unknown": ["nonsense"], "wrong number": 5}
    if about["items"]["type"] == "string":
        return {"missing": ["missing.png"] * about["minItems"]}
    if about["maxItems"] in MATRICES:
        return {"middle": MATRICES[about["maxItems"]], "zero": [0] * about["maxItems"], "wrong two": [1, 2], "wrong text": "north"}
    low, high = about["items"].get("minimum"), about["items"].get("maximum")
    if (about["minItems"], about["maxItems"]) == (2, 2):
        return {"middle": [12, 10], "zero": [0, 10], "above": [high + 1, 10], "one": [10], "wrong text": "large"}
    fourth = {"w one": [1, 2, 3, 1], "w zero": [1, 2, 3, 0], "w negative": [1, 2, 3, -2], "w two": [2, 4, 6, 2], "all zero": [0, 0, 0, 0]} if about["maxItems"] == 4 else {"wrong four": [1, 2, 3, 1]}
    return {**VECTORS, **fourth, **({"below": [0, -1, 0]} if low is not None else {})}


# Rules that need more than two keys, other spellings and units. subject: {name: keys}; a key with the value None is removed.
MORE = {
    "material": {
        "name": "gold", "classic": "ruby", "glass": "glass", "hex": "#ff8800", "colour": "orange", "no name": "golb",
        "name and key": {"name": "gold", "opacity": 0.5}, "name in keys": {"name": "ruby"}, "wrong name": {"name": "golb"}, "color": {"color": "#ff8800"},
        "color list": {"color": [1, 0, 0]}, "color number": {"color": 0.5}, "color and ks": {"ks": 0.5, "color": [1, 0, 0]}, "specular_color": {"specular_color": [1, 1, 1]},
        "ka": {"ka": 0.5}, "kd": {"kd": 0.5}, "ks": {"ks": 0.5}, "kr": {"kr": 0.5}, "ks below": {"ks": -1}, "diffuse and kd": {"diffuse": [1, 0.5, 0], "kd": 0.5},
        "color and kd": {"color": [1, 0.5, 0], "kd": 0.5}, "ambient of diffuse": {"diffuse": [1, 0, 0], "ambient": "diffuse"},
        "ambient word": {"ambient": "diffuse"}, "specular color and ks": {"specular_color": [1, 0, 0], "ks": 0.5},
        "opacity of alpha": {"diffuse": [1, 0, 0, 0.5], "opacity": 0.5}, "unknown": {"shinines": 3}, "reflection": {"reflection": "ggx"},
        "not physical": {"physical": False, "metallic": 1},
    },
    "point": {
        "nothing": {"position": None}, "unknown": {"rang": 3}, "camera": {"position": None, "frame": "camera"}, "object": {"frame": "object"}, "view": {"frame": "view"},
        "object named": {"frame": "object", "object": "torus"}, "object in frame": {"frame": "object:torus"}, "object missing": {"frame": "object", "object": "ball"}, "colour and diffuse": {"color": [1, 0, 0], "diffuse": [0.5, 0.5, 0.5], "intensity": 2},
        "w zero and range": {"position": [1, 2, 3, 0], "range": 3}, "w zero and attenuation": {"position": [1, 2, 3, 0], "attenuation": [1, 1, 0]},
        "w zero and radius": {"position": [1, 2, 3, 0], "radius": 2}, "attenuation zero": {"attenuation": [0, 0, 0]}, "flag of occluded": {"occluded": True},
        "radii": {"position": ["1r", "2r", "3r"]}, "radii mixed": {"position": ["1r", 2, 3]}, "radii and zero": {"position": ["1r", 0, "3r"]}, "range in radii": {"range": "4r"},
        "radius in radii": {"radius": "0.5r"}, "attenuation in radii": {"attenuation": [1, "1r", "0.5r"]}, "attenuation constant in radii": {"attenuation": ["1r", 0, 0]},
    },
    "directional": {
        "nothing": {"direction": None}, "position and target": {"direction": None, "position": [1, 2, 3], "target": [0, 0, 0]}, "position": {"direction": None, "position": [1, 2, 3]},
        "position w": {"direction": None, "position": [1, 2, 3, 0]}, "target alone": {"direction": None, "target": [0, 0, 0]}, "direction and target": {"target": [0, 0, 0]},
        "same point": {"direction": None, "position": [1, 2, 3], "target": [1, 2, 3]}, "radius 90": {"radius": 90}, "radius in radii": {"radius": "1r"},
        "angle": {"radius": "5deg"}, "in radii": {"direction": None, "position": ["1r", "2r", "3r"], "target": ["0r", "0r", "0r"]},
    },
    "spot": {
        "nothing": {"position": None, "direction": None}, "position": {"direction": None}, "target": {"direction": None, "target": [3, 0.5, -4]}, "both": {"target": [0, 0, 0]},
        "same point": {"direction": None, "target": [3, 0.5, 0.5]}, "target and exponent": {"direction": None, "target": [0, 0, 0], "exponent": 4}, "cutoff 90": {"cutoff": 90},
        "cutoff 100": {"cutoff": 100}, "cutoff 180": {"cutoff": 180}, "cone": {"inner": 10, "outer": 20}, "cone equal": {"inner": 20, "outer": 20}, "cone swapped": {"inner": 20, "outer": 10},
        "cone and cutoff": {"inner": 10, "outer": 20, "cutoff": 30}, "cone and exponent": {"inner": 10, "outer": 20, "exponent": 3}, "outer 90": {"inner": 10, "outer": 90},
        "angle": {"cutoff": "30deg"}, "target in radii": {"direction": None, "target": ["0r", "0r", "1r"]}, "position zero w": {"direction": None, "position": [1, 2, 3, 0]},
        "camera": {"frame": "camera", "position": None, "direction": None}, "target in camera": {"frame": "camera", "position": None, "direction": None, "target": [0, 0, -3]},
    },
    "hemisphere": {"nothing": {}, "up in camera": {"up": [0.5, 1, 2], "frame": "camera"}, "intensity": {"intensity": 2}, "color": {"color": [1, 0.5, 0.2]}, "color and intensity": {"color": [1, 0.5, 0.2], "intensity": 2},
                   "color and sky": {"color": [1, 0.5, 0.2], "sky": [0.1, 0.2, 0.3], "intensity": 2}},
    "ambient": {"nothing": {}, "both": {"color": [1, 0, 0], "intensity": 2}, "colour and ambient": {"color": [1, 0, 0], "ambient": [0.1, 0.2, 0.3]}},
    "camera": {"nothing": {"eye": None}, "no eye": {"eye": None, "fovy": 30}, "same point": {"target": [2, 1.5, 3]}, "near far": {"near": 3.6, "far": 4}, "far near": {"near": 9, "far": 1},
               "near negative": {"near": -1, "far": 9}, "near negative in parallel": {"near": -1, "far": 9, "ortho_half_height": 2}, "fovy 180": {"fovy": 180},
               "ortho": {"ortho": 2}, "calibrated": {"fx": 20, "fy": 22, "cx": 3, "cy": 9.5}, "fx negative": {"fx": -20, "fy": 22, "cx": 3, "cy": 9.5},
               "K and pose": {"eye": None, "K": MATRICES[9], "pose": MATRICES[16]}, "opengl": {"eye": None, "K": MATRICES[9], "pose": MATRICES[16], "convention": "opengl"},
               "distortion": {"fx": 20, "fy": 22, "cx": 3, "cy": 9.5, "k1": 0.1}, "K with skew": {"K": [20, 1, *MATRICES[9][2:]]}, "unknown": {"fov": 30}, "angle": {"fovy": "40deg"}},
    "environment": {"rotation": {"rotation": 40}, "none": {"builtin": None}, "rotation alone": {"builtin": None, "rotation": 40}},
    "image": {"unknown": {"sice": [16, 16]}, "samples 3": {"samples": 3}, "both modes": {"color": "raw", "color_mode": "raw"}, "size 2.5": {"size": [2.5, 2]}},
    "setting": {"stage and shading": {"stage": "fragment", "shading": "gouraud"}, "stage and phong": {"stage": "vertex", "shading": "phong"}, "unknown": {"shadowz": True},
                "ground and colour": {"ground": "color", "ground_color": "#446688"}, "angle": {"edge_angle": "40deg", "edges": ["crease"]}},
}


class Row:
    """A wish: the keys of a subject, and further settings. `keys` is a dict, or the name of a material."""

    def __init__(self, subject, name, keys, context):
        self.subject, self.name, self.keys, self.more = subject, f"{subject}: {name}", keys, {"image": IMAGE, **SUBJECTS[subject][1], **context}

    def scene(self):
        """The scene file."""
        root = root_of(self.more)
        if self.subject in LIGHTS:
            root["lights"] = [self.keys]
        elif self.subject == "material":
            root["objects"][0]["material"] = self.keys
        elif self.subject == "setting":
            root.update(self.keys)
        else:
            root[self.subject] = {**root.get(self.subject, {}), **self.keys}
        return root

    def options(self):
        """The options of the row, as a dict of values as text; True is an option without a value."""
        keys = self.keys
        if self.subject in LIGHTS:
            return {"light": light_text(keys)}
        if self.subject == "material":
            return {"material": material_text(keys)} if keys else {}
        if self.subject != "setting":
            return options_of(self.subject, keys)
        if keys.get("ground") == "color" and "ground_color" in keys:  # one option
            keys = {"ground": keys["ground_color"], **{key: value for key, value in keys.items() if not key.startswith("ground")}}
        return {name: text for key, value in keys.items() for name, text in options_of(key, value).items()}

    def context(self):
        """The options that make the row visible."""
        return {name: text for key, value in self.more.items() for name, text in options_of(key, value).items()}

    def words(self):
        return words_of({**self.context(), **self.options()})

    def settings(self):
        """The settings file, or None if the subject is no setting."""
        if self.subject not in GROUPS or {"ambient", "up", "faces", "equirectangular"} & set(self.keys):
            return None
        return dict(self.keys) if self.subject == "setting" else {self.subject: self.keys}


def root_of(settings):
    """A scene file with the model and these settings."""
    root = {"lambent": 1, "objects": [dict(OBJECT)], **settings}
    if "material" in root:
        root["objects"][0]["material"] = root.pop("material")
    return root


def text_of(value, yes="yes", no="no", between="/"):
    if isinstance(value, bool):
        return yes if value else no
    if isinstance(value, list):
        return between.join(text_of(item) for item in value)
    return value if isinstance(value, str) else repr(value).removesuffix(".0")


def words_of(options):
    return [f"--{name}" if value is True else f"--{name}={value}" for name, value in options.items()]


def pairs(keys):
    return ",".join(f"{key}={text_of(value)}" for key, value in keys.items())


def light_text(keys):
    rest = {key: value for key, value in keys.items() if key != "type"}
    return keys["type"] + (":" + pairs(rest) if rest else "")


def material_text(keys):
    if isinstance(keys, str):
        return keys
    rest = pairs({key: value for key, value in keys.items() if key != "name"})
    return ",".join(filter(None, [keys.get("name"), rest]))


def options_of(key, value):
    """A top-level key of a scene file as options."""
    if key == "lights":
        return {"light": light_text(value[0])}
    if key == "material":
        return {"material": material_text(value)}
    if key == "camera":
        return {"camera": pairs({OPTION_NAMES.get("camera." + name, name): found for name, found in value.items()})}
    if isinstance(value, dict):
        return {name: text for inner, found in value.items() for name, text in options_of(OPTION_NAMES.get(f"{key}.{inner}", inner), found).items()}
    name = key.replace("_", "-")
    if value is False and name not in SWITCHES:
        return {}
    if value is True and name not in SWITCHES:
        return {name: True}
    if isinstance(value, list) and (not value or isinstance(value[0], str)):
        return {name: ",".join(value) or "none"}
    return {name: text_of(value, "on", "off", "x" if name == "size" else "/")}


SWITCHES = {"surfaces", "shadow-terminator"} # flags that the command line writes as on or off


def rows(schema):
    """All rows: each key with each value, each pair of keys, and MORE."""
    found = {}

    def add(subject, name, keys, context={}):
        row = Row(subject, name, keys, context)
        found.setdefault(row.name, row)

    for subject, (_, _, base) in SUBJECTS.items():
        known = properties(schema, subject)
        add(subject, "base", dict(base))
        for key, about in known.items():
            context = CONTEXT.get(f"{subject}: {key}", {})
            add(subject, f"{key} missing", dict(base), context)
            for name, value in values(about).items():
                add(subject, f"{key} {name}", {**base, **PAIRED.get(key, {}), key: value}, context)
        middles = {key: middle_of(about) for key, about in known.items()}
        for a in middles if subject not in ("setting", "image") else ():
            for b in middles:
                if a < b and not {a, b} & {"faces", "equirectangular"}:
                    add(subject, f"{a} and {b}", {**base, a: middles[a], b: middles[b]})
        for key in sorted(set().union(*(properties(schema, other) for other in LIGHTS)) - set(known)) if subject in LIGHTS else ():
            add(subject, f"{key} foreign", {**base, key: 1})
        for name, keys in MORE.get(subject, {}).items():
            add(subject, "more: " + name, keys if isinstance(keys, str) else {key: value for key, value in {**base, **keys}.items() if value is not None})
    return found


def middle_of(about):
    """An allowed value that is not the default."""
    if "enum" in about or "examples" in about:
        return next(word for word in reversed(about.get("enum", about.get("examples"))) if word != about.get("default"))
    return next(value for value in values(about).values() if value != about.get("default"))


def visible(found, results, subject, key):
    """Whether the picture of a row changes if the key is omitted."""
    def text(row, keys):
        return json.dumps([row.more, keys], sort_keys=True)
    mine = [row for row in found.values() if row.subject == subject and isinstance(row.keys, dict)]
    base, drawn = SUBJECTS[subject][2], {text(row, row.keys): results[row.name] for row in mine}
    for row in mine:
        if key in row.keys and row.keys[key] != base.get(key) and results[row.name][0] == "picture":
            rest = {name: value for name, value in {**row.keys, key: base.get(key)}.items() if value is not None and name != PARTNERS.get(key)}
            if drawn.get(text(row, rest), results[row.name])[0] == "picture" and drawn.get(text(row, rest), results[row.name]) != results[row.name]:
                return True
    return False
