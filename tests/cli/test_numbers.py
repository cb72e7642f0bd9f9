# test_numbers.py: the numbers in pages, help and headers equal the numbers in the code. Defaults are tested, tables are generated
# from the program's own numbers, and numbers in sentences are compared between page and source.
import importlib.util
import json
import math
import re
import subprocess

from harness import PROGRAM, ROOT, Case, write_png

WORDS = {w: n for n, w in enumerate("zero one two three four five six seven eight nine ten eleven twelve".split())}
NUMBER = r"((?:\d{1,3}(?:,\d{3})+|\d+)(?:\.\d+)?|\.\d+|" + "|".join(WORDS) + ")"


def number(text):
    return WORDS[text] if text in WORDS else float(text.replace(",", ""))


def c_value(text):
    """The value of a C constant: a number, or a product or shift of numbers."""
    text = re.sub(r"(?<=[\d.])(?:f|u|L|ULL)\b", "", text.strip())
    if not re.fullmatch(r"[\d.eE+x() */<-]+", text):
        raise ValueError("not a constant: " + text)
    return float(eval(text.replace("/", "*1.0/")))  # only digits and operators


class Source:
    """A number in the code, looked up when a row is checked."""

    def __init__(self, what, look_up):
        self.what, self.look_up = what, look_up


def constant(path, name):
    """An enumerator or a macro."""
    def look_up():
        found = re.search(r"(?m)(?:^#define\s+%s\s+|\b%s\s*=\s*)([^,;}\n]+?)\s*(?:[,;}]|//|$)" % (name, name), (ROOT / path).read_text())
        return found and c_value(found.group(1))
    return Source(f"{name} of {path}", look_up)


def code(path, pattern):
    """The match of a pattern's group in a source file, or in one file of a folder, if the number has no name."""
    def look_up():
        files = sorted((ROOT / path).rglob("*.c")) if (ROOT / path).is_dir() else [ROOT / path]
        found = [match for file in files for match in [re.search(pattern, file.read_text())] if match]
        return c_value(found[0].group(1)) if found else None
    return Source(f"/{pattern}/ of {path}", look_up)


def generated(kind):
    return subprocess.run([PROGRAM, "generate", kind], stdout=subprocess.PIPE, check=True).stdout.decode()


def option(name, row=0):
    """The default of an option in the table of options, which test_defaults_of_options tries. `row` counts options of the same name."""
    def look_up():
        found = re.findall(r"(?m)^\| `(?:-\w`, `)?--%s[ `][^|]*(?:\\\|[^|]*)*\| ([^|]*?) \|" % name, generated("markdown"))
        return number(re.match(NUMBER, found[row]).group()) if found else None
    return Source("the default of --" + name, look_up)


def field(name, key="default"):
    """The default or bound of a material field, from its table through the schema."""
    return Source(f"the {key} of the field {name}",
                  lambda: float(json.loads(generated("scene-schema"))["$defs"]["material"]["properties"][name][key]))


def counted(what, count):
    return Source(what, lambda: float(count()))


LAYERS = constant("src/core/cpu/raster/tile.h", "LAYERS_MAX")
TILE = constant("src/core/frame/frame.h", "FRAME_TILE")
FEW_LIGHTS = constant("src/core/cpu/lights/light_bounds.h", "LIGHTS_ALL_SUMMED")
FOVY = code("src/core/scene/camera.c", r"fovy_rad = (\d+) \* \(PI / 180\)")
FILL = constant("src/core/scene/camera_fit.c", "FILL")
CREASE = code("src/core/scene/scene.c", r"math_radians\((\d+)\)")
SPHERE = constant("src/effects/environment/cube_map.h", "CUBE_SIDE_MOST")
PERCENT_FILL = counted("100 times " + FILL.what, lambda: 100 * FILL.look_up())
TEAPOT = counted("the triangles of `lambent teapot`", lambda: json.loads(subprocess.run(
    [PROGRAM, "teapot", "-s", "8", "-o", "/dev/null", "--json"], stdout=subprocess.PIPE, check=True).stdout)["model"]["triangles"])
OVER_CHECK = code("classroom/check", r"share_over <= ([\d.]+)")
PIXELS_OVER_CHECK = counted("1 divided by " + OVER_CHECK.what, lambda: 1 / OVER_CHECK.look_up())
TOLERANCE = code("classroom/check/check.c", r"p->tolerance : ([\d.]+) / 255")

SAMPLES = [constant("src/core/frame/frame.c", name) for name in ("TINY_SAMPLES", "TINY_SIDE", "SMALL_SAMPLES", "SMALL_SIDE", "LARGE_SAMPLES")]
BLOCK = constant("src/core/cpu/lights/light_cull_blocks.inc", "BLOCK_SHIFT")
LEAST_ID = code("src/core/device/encode_values.c", r"uint8_t\)\((\d+) \+")
OVERDRAW = code("src/core/device/encode_values.c", r"/ \(v\[c\] \+ ([\d.]+)f")

# A page, a sentence of it in which {} replaces each number determined by the code, and the sources of these
# numbers.
ROWS = [
    ("docs/lighting/shadows.md", "With N above {}, Lambent looks at cells", constant("src/effects/rays/light_pattern.h", "LIGHT_PROBES")),
    ("docs/lighting/shadows.md", "at least {} rays are traced", constant("src/effects/rays/light_pattern.h", "CELL_PROBES")),
    ("docs/lighting/pixels.md", "rounds vertices to 1/{} of a pixel", constant("src/core/cpu/raster/tile.h", "SUBPIXEL")),
    ("docs/lighting/pixels.md", "lies up to 1/{} of a pixel outside", constant("src/core/cpu/raster/tile.h", "SUBPIXEL")),
    ("docs/lighting/pixels.md", "uses {} samples in pictures of up to {}² pixels, {} samples up to {}² pixels, and {} samples in larger pictures", *SAMPLES),
    ("docs/scene-file.md", "| `samples` | {} up to {}² pixels, {} up to {}², {} above |", *SAMPLES),
    ("program/options/option_table.c", "\"{} up to {}x256 pixels, {} up to {}x512, {} above\"", *SAMPLES),
    ("include/lambent/device.h", "for a picture of this size: {} up to {}² pixels, so that thin wires do not break into dashes, {} up to {}², and {} above", *SAMPLES),
    ("docs/view.md", "more than {} triangles, lines and points", constant("tools/view/drawing/view_draw.h", "VIEW_TRIANGLES_MAX")),
    ("docs/view.md", "files of more than {} MB", counted("megabytes of PAGE_FILES_MAX", lambda: constant("tools/page/page.h", "PAGE_FILES_MAX").look_up() / 1e6)),
    ("docs/view.md", "minutes, by default {}", constant("tools/view/view_server.c", "IDLE_MINUTES")),
    ("docs/view.md", "a picture of {}x{} pixels", *2 * [constant("tools/view/view_page.h", "VIEW_THUMBNAIL")]),
    ("docs/view.md", "a token of {} random bits", counted("bits of VIEW_TOKEN_SIZE", lambda: (constant("tools/view/view.h", "VIEW_TOKEN_SIZE").look_up() - 1) * 4)),
    ("docs/web.md", "is limited to {} MB", counted("megabytes of PAGE_FILES_MAX", lambda: constant("tools/page/page.h", "PAGE_FILES_MAX").look_up() / 1e6)),
    ("docs/lighting/diffuse.md", "`roughness_angle` in degrees (default: {})", field("roughness_angle")),
    ("docs/lighting/lights.md", "With more than {} lights, Lambent skips the weakest lights", FEW_LIGHTS),
    ("docs/lighting/surfaces.md", "At most {} translucent triangles may cover one pixel", LAYERS),
    ("docs/lighting/reflection.md", "Cube faces may have up to {} pixels on a side", SPHERE),
    ("docs/lighting/reflection.md", "built in, computed, with faces of {}×{} pixels", *2 * [constant("src/effects/environment/environment_made.c", "SIDE")]),
    ("docs/internals/cpu.md", "tiles of {}×{} pixels", TILE, TILE),
    ("docs/internals/cpu.md", "A thread can store {} such fragments", LAYERS),
    ("docs/internals/cpu.md", "shaded in batches of {}", constant("src/core/cpu/shade/shading_batch.h", "BATCH_MAX")),
    ("docs/internals/cpu.md", "over up to {} points", constant("src/core/cpu/shade/shading_batch.h", "LIGHT_BATCH")),
    ("docs/internals/cpu.md", "With more than {} lights ({} for Gouraud and flat shading)",
     code("src/core/cpu/lights/light_bounds.h", r"LAM_SHADING_PHONG \? (\d+) :"), FEW_LIGHTS),
    ("include/lambent/check.h", "32..1024 pixels; 0: {}", code("classroom/check/check.c", r"p->size : (\d+);")),
    ("docs/internals/cpu.md", "With more than {} lights, Lambent also skips the weakest", FEW_LIGHTS),
    ("docs/internals/cpu.md", "in groups of {}. Lambent tests each group", constant("src/core/cpu/lights/light_bounds.h", "LIGHTS_IN_GROUP")),
    ("docs/internals/cpu.md", "one block of {}×{} pixels", *2 * [counted("1 << BLOCK_SHIFT of light_cull_blocks.inc", lambda: 2 ** BLOCK.look_up())]),
    ("docs/internals/normals.md", "If {} positions have the same small number of corners", constant("src/core/geometry/normals/corner_fan.h", "FAN_POSITIONS")),
    ("docs/show.md", "front blue (0, {}, 255), back red (255, {}, 0)", code("src/core/device/encode_values.c", r"front\[3\] = \{0, (\d+)"),
     code("src/core/device/encode_values.c", r"back\[3\] = \{255, (\d+)")),
    ("docs/show.md", "no channel below {}", LEAST_ID),
    ("docs/show.md", "c/(c + {}): 1 is {}, 2 is {}, 3 is {}", OVERDRAW, *[counted(f"the byte of {n} of {n} + OVERDRAW",
     lambda n=n: math.floor(255 * n / (n + OVERDRAW.look_up()) + 0.5)) for n in (1, 2, 3)]),
    ("docs/check.md", "exponent {}; attenuation 1/(1 + {} d + {} d²)", code("classroom/check/contracts/nyu.json", r'"shininess": (\d+)'),
     code("classroom/check/contracts/nyu.json", r'"attenuation": \[1, ([\d.]+),'),
     code("classroom/check/contracts/nyu.json", r'"attenuation": \[1, [\d.]+, ([\d.]+)\]')),
    ("src/core/scene/fields/outputs.c", "c/(c + {}) for a pixel that c triangles cover", OVERDRAW),
    ("include/lambent/device.h", "no channel below {}", LEAST_ID),
    ("docs/opengl.md", "in tiles of {}×{} pixels", *2 * [constant("src/gpu/gl/gl_device.h", "PART_SIZE_MAX")]),
    ("docs/opengl.md", "the teapot ({} triangles)", TEAPOT),
    ("docs/shaders.md", "RGBA32F, {} texels wide", constant("src/gpu/glsl/glsl.h", "GLSL_LIST_WIDTH")),
    ("src/gpu/glsl/glsl_declarations.c", "float texture, {} texels wide, no filter: the lights", constant("src/gpu/glsl/glsl.h", "GLSL_LIST_WIDTH")),
    ("src/gpu/glsl/glsl_declarations.c", "float texture, {} texels wide, no filter: the products", constant("src/gpu/glsl/glsl.h", "GLSL_LIST_WIDTH")),
    ("docs/formats.md", "on any axis is more than {} times its size", constant("src/core/geometry/origin.h", "ORIGIN_RATIO")),
    ("docs/formats.md", "| `Ns` | shininess, 0 to {}; by default {}. With exactly 0,", code("src/formats/import/obj/mtl.c", r"field->max : (\w+)f"), field("shininess")),
    ("docs/check.md", "at most one pixel in {} differs by more than `--tolerance` ({} steps of 1/255)", PIXELS_OVER_CHECK, TOLERANCE),
    ("docs/check.md", "the shader exceeded `--stop-after` ({} seconds)", option("stop-after", 1)), # the first option of this name belongs to pictures
    ("docs/lighting.md", "about {} hundred lines", counted("the hundreds of lines of lobes.h, lights.h and sum.h", lambda: round(sum(
        len((ROOT / "src/core/lighting" / name).read_text().splitlines()) for name in ("lobes.h", "lights.h", "sum.h")) / 100))),
    ("tools/help/topics.c", "`--tolerance` (default {}) applies to each channel of a pixel. At most one pixel in {} may exceed",
     TOLERANCE, PIXELS_OVER_CHECK),
    ("program/options/option_table.c", "fills {} % of the picture's width or height", PERCENT_FILL),
    ("program/options/option_table.c", "a vertical field of view of {} degrees", FOVY),
    ("program/options/option_table.c", "`fovy` is the full vertical angle in degrees (default: {})", FOVY),
    ("program/options/option_table.c", "With more than {} lights, Lambent skips the weakest", FEW_LIGHTS),
    ("include/lambent/camera.h", "in (0, π); 0: {}°", FOVY),
    ("include/lambent/camera.h", "in (0, 1]. 0: {}.", FILL),
    ("include/lambent/camera.h", "fovy=degrees default: {};", FOVY),
    ("include/lambent/scene.h", "do not share a computed normal. 0: {}°", CREASE),
    ("include/lambent/device.h", "In frames with more than {} lights", FEW_LIGHTS),
    ("include/lambent/device.h", "more than {} translucent triangles over one pixel", LAYERS),
    ("include/lambent/check.h", "1 = full range; 0: {}/255. A scene passes if at most one pixel in {}", TOLERANCE, PIXELS_OVER_CHECK),
    ("include/lambent/words.h", "A text is at most {} bytes long",
     counted("WORDS_MAX - 1", lambda: constant("src/core/description/description.h", "WORDS_MAX").look_up() - 1)),
]


def plain(text):
    """The text of a page, a header or a C string, without line breaks and comment marks."""
    return re.sub(r"\s+(?://\s+)?", " ", re.sub(r'"\s*\n\s*"', "", text))


class Sentences(Case):
    def test_sentences(self):
        """Every number of a row equals the number in the code."""
        for path, sentence, *sources in ROWS:
            with self.subTest(f"{path}: {sentence}"):
                pattern = NUMBER.join(re.escape(part) for part in sentence.split("{}"))
                found = re.search(pattern, plain((ROOT / path).read_text()))
                self.assertIsNotNone(found, "the sentence is not there: change its row with it")
                self.assertEqual(len(found.groups()), len(sources))
                for text, source in zip(found.groups(), sources):
                    value = source.look_up()
                    self.assertIsNotNone(value, source.what + " is not there")
                    self.assertAlmostEqual(number(text), value, delta=1e-6 * abs(value), msg=source.what)

    def test_made_sections(self):
        """The sections generated by scripts/docs.py are up to date."""
        spec = importlib.util.spec_from_file_location("docs_script", ROOT / "scripts" / "docs.py")
        script = importlib.util.module_from_spec(spec)
        spec.loader.exec_module(script)
        pages = script.pages_with_sections(PROGRAM)
        self.assertEqual(set(pages), {"docs/lighting/lights.md", "docs/lighting/explain.md", "docs/check/contract-file.md", "docs/scene-file.md", "docs/teaching.md", "docs/formats.md"})
        for path, text in pages.items():
            self.assertEqual((ROOT / path).read_text(), text, f"{path}: python3 scripts/docs.py build/lambent --text rewrites it")

    def test_shown_shader(self):
        """The sum in docs/shaders.md is part of its command's output."""
        page = (ROOT / "docs/shaders.md").read_text()
        command, shown = re.search(r"(?s)    lambent (shader [^\n]*--products)\n\nThe sum in this shader is:\n\n```glsl\n(.*?)```", page).groups()
        self.assertIn(shown, self.good(*command.split()).stdout.decode())


# Options whose default cannot be given as a value, with the text in the table.
NOT_VALUES = {"point-size", "output", "quality", "color", "view", "camera", "light", "material", "back-faces", "back-material", "cull", "segments", "environment", "reflectivity", "threads",
              "gl-device", "edges", "time-limit", "memory-limit", "triangle-limit", "object-limit", "layer-limit", "expansion-limit", "pixel-limit", "file-limit", "json-depth-limit", "allow-path", "show", "up", "reflection", "isa", "device", "repeat", "scene", "variant", "animation", "time", "views", "sizes", "journal"}
# The additional options that make an option effective, and another value of the option.
CONTEXT = {
    "frames": (["--sweep", "zoom=1..2"], "4"), "fps": (["--turntable", "3"], "12"),
    "sandbox": ([], None), "retry-failed": ([], None), "shard": ([], None), "shard-by": ([], None), "size": ([], "64"), "samples": ([], "2"), "exposure": ([], "1"), "tone": ([], "aces"), "crease-angle": ([], "20"), "compress": ([], None), "term": ([], None),
    "background": ([], "white"), "color-mode": ([], "raw"), "azimuth": ([], "31"), "elevation": ([], "21"), "zoom": ([], "1.1"), "fov": ([], "40"),
    "projection": ([], "orthographic"), "rig": ([], "headlight"), "ambient": ([], "0.1"), "light-cutoff": (["lights.json"], "0.1"),
    "light-scale": ([], "1.1"), "shading": ([], "flat"), "stage": ([], None), "flat-normal": (["--shading", "flat"], "vertex"),
    "bounces": (["--paths", 2], "1"), "paths": (["--bounces", 1], "3"),
    "reference": (["--environment", "studio", "--material", "#ffc356,metallic=1,roughness=0.3"], "64"),
    "anisotropy": (["floor.obj"], "1"), "map-filter": (["floor.obj"], "nearest"), "denoise": (["--bounces", "2", "--paths", "4"], "off"), "noise": (["--bounces", "1", "--paths", "4"], None), "stop-after": (["--bounces", "1", "--paths", "4"], None), "line-width": (["lines.obj"], "3"), "viewer": ([], "infinite"), "normals": ([], "facet"),
    "texture-filter": (["floor.obj"], None), "section": ([], "x=40%"), "arrange": ([], None), "explode": (["parts.obj"], "0.5"),
    "shadow-terminator": (["--shadows", "--light", "point:position=2r/3r/1r"], "off"),
    "shadow-samples": (["--shadows", "--light", "point:position=2r/3r/1r,radius=0.5"], "3"),
    "hidden-lines": (["--wireframe"], "show"), "surfaces": ([], "off"),
    "deflection": ([], None), "look": ([], "classic"), "ground": ([], "checker"), "ao": ([], "off"), "cavity": ([], "off"), "brighten": (["dark.obj"], "off"), "glass": ([], None), "specular-aa": (["--material", "#ffc356,metallic=1,roughness=0.3"], "off"), "ao-radius": ([], "0.3"), "ao-samples": (["--ao", "rays"], "16"),
    "environment-rotation": (["--reflection-map", "studio", "--reflectivity", "0.5"], "90"),
}


class Defaults(Case):
    def setUp(self):
        super().setUp()
        # A tent of twelve sides without normals: they meet at 30 degrees.
        ring = [(round(math.cos(i * math.pi / 6), 4), round(math.sin(i * math.pi / 6), 4)) for i in range(12)]
        (self.folder / "tent.obj").write_text(
            "".join(f"v {x} -1 {z}\n" for x, z in ring) + "".join(f"v {x} 1 {z}\n" for x, z in ring) +
            "".join(f"f {i + 1} {i + 13} {(i + 1) % 12 + 13} {(i + 1) % 12 + 1}\n" for i in range(12)))
        (self.folder / "parts.obj").write_text((ROOT / "examples" / "models" / "parts.obj").read_text())
        (self.folder / "lines.obj").write_text("v -1 0 0\nv 1 0 0\nv 0 1 1\nl 1 2\np 3\n")
        # A striped floor, seen at an angle.
        (self.folder / "stripes.png").write_bytes(write_png(2, 2, bytes([255] * 8 + [0, 0, 0, 255] * 2)))
        (self.folder / "floor.mtl").write_text("newmtl a\nmap_Kd -s 20 20 stripes.png\n")
        (self.folder / "floor.obj").write_text("mtllib floor.mtl\nusemtl a\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\n"
                                               "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 4/4 3/3 2/2 1/1\n")
        (self.folder / "dark.mtl").write_text("newmtl a\nKd 0.02 0.02 0.02\n")
        (self.folder / "dark.obj").write_text((self.folder / "floor.obj").read_text().replace("floor.mtl", "dark.mtl"))
        lights = [{"type": "point", "position": [i % 5 - 2, i // 5 - 2, 3], "color": [.05, .05, .05], "attenuation": [0, 0, 1]} for i in range(25)]
        (self.folder / "lights.json").write_text(json.dumps({"lambent": 1, "objects": [{"shape": "sphere"}], "lights": lights}))

    def test_defaults_of_options(self):
        """An option with its default value changes nothing; with another value, it changes the picture."""
        made = generated("markdown")
        table = made[made.index("### Picture"):made.index("### Comparing")] if "### Comparing" in made else made[made.index("### Picture"):]
        tried = 0
        for name, standard in re.findall(r"(?m)^\| `(?:-\w`, `)?--([\w-]+) [^`]*` \| ([^|]+?) \|", table):
            if name in NOT_VALUES or name not in CONTEXT and name in self.other_commands(made):
                continue
            self.assertIn(name, CONTEXT, f"--{name}: add a row for it")
            more, other = CONTEXT[name]
            model = more[0] if more and more[0].endswith((".json", ".obj")) else "tent.obj"
            words = [model, *[w for w in more if w != model], *([] if name == "size" else ["-s", "96"])]
            with self.subTest(name):
                value = re.match(r"[^\s,;]+", standard).group()
                without = self.good(*words, "-o", "-").stdout
                self.assertTrue(self.good(*words, f"--{name}", value, "-o", "-").stdout == without, f"--{name} {value} is not the default")
                if other:
                    self.assertFalse(self.good(*words, f"--{name}", other, "-o", "-").stdout == without, f"--{name} {other} changes nothing")
                tried += 1
        self.assertGreaterEqual(tried, len(CONTEXT))

    def test_defaults_of_keys(self):
        """The same for the keys in the values of --edges, --wireframe and --turntable, whose defaults stand in the text."""
        made = generated("markdown")
        for words, key, standard, other, text in (
                (["--edges"], "angle", "40", "20", "`angle` (default: 40 degrees)"), (["--edges"], "width", "1.5", "3", "`width` (default: 1.5 pixels)"),
                (["--edges"], "color", "black", "red", "`color` (default: black)"), (["--wireframe"], "width", "1", "2", "the width in pixels (default: 1)"),
                (["--wireframe"], "color", "black", "red", "the colour (default: black)"), (["--turntable", "3"], "light", "camera", "model", "keeping the lights fixed to the camera")):
            with self.subTest((words, key)):
                self.assertIn(text, made)
                plain = {"--edges": ["all"]}.get(words[0], words[1:])
                draw = lambda *value: self.good("tent.obj", "-s", "96", words[0], *value, "-o", "-").stdout
                joined = lambda value: [",".join([*plain, f"{key}={value}"])]
                self.assertEqual(draw(*joined(standard)), draw(*plain))
                self.assertNotEqual(draw(*joined(other)), draw(*plain))

    def other_commands(self, made):
        """Options of commands other than the one that draws."""
        return {name for name in re.findall(r"(?m)^\| `(?:-\w`, `)?--([\w-]+)", made)
                if b"does not apply" in self.run_program("tent.obj", "-s", 8, "-o", "-", f"--{name}", "1").stderr}

    def scene(self):
        return {"lambent": 1, "image": {"size": [96, 96]}, "camera": {"eye": [0, 1, 4]},
                "objects": [{"file": "tent.obj"}, {"shape": "torus"}],
                "lights": [{"type": kind} for kind in ("ambient", "hemisphere", "point", "directional", "spot")]}

    def draw(self, scene):
        (self.folder / "scene.json").write_text(json.dumps(scene))
        return self.good("scene.json", "-o", "-").stdout

    def test_defaults_of_scene_files(self):
        """A key of a scene file with its default in the schema changes nothing."""
        schema = json.loads(generated("scene-schema"))
        own = schema["properties"]
        places = [(own, lambda s: s), (own["image"]["properties"], lambda s: s["image"]), (own["camera"]["properties"], lambda s: s["camera"]),
                  (schema["$defs"]["file"]["properties"], lambda s: s["objects"][0]),
                  (schema["$defs"]["shape"]["properties"], lambda s: s["objects"][1])]
        for i, kind in enumerate(("ambient", "hemisphere", "point", "directional", "spot")):
            places.append((schema["$defs"][kind + "_light"]["properties"], lambda s, i=i: s["lights"][i]))
        tried = 0
        without = self.draw({k: v for k, v in self.scene().items()})
        for properties, place in places:
            for key, about in properties.items():
                # Keys that exclude each other, such as a spot's other cone.
                if "default" not in about or key in ("size", "inner", "outer"):
                    continue
                with self.subTest(f"{key} {about['default']}"):
                    scene = self.scene()
                    place(scene)[key] = about["default"]
                    self.assertTrue(self.draw(scene) == without)
                    tried += 1
        self.assertGreater(tried, 30)
        with self.subTest("size"):
            scene = self.scene()
            del scene["image"]["size"]
            one = self.draw(scene)
            scene["image"]["size"] = own["image"]["properties"]["size"]["default"]
            self.assertTrue(self.draw(scene) == one)

    def test_defaults_on_the_page_of_scene_files(self):
        """The default column of the tables in docs/scene-file.md matches the schema."""
        schema = json.loads(generated("scene-schema"))
        own, checked = schema["properties"], 0
        tables = {"Top-level keys": own, "image": own["image"]["properties"], "camera": own["camera"]["properties"],
                  "Objects": schema["$defs"]["shape"]["properties"], "Lights": schema["$defs"]["point_light"]["properties"]}
        page = (ROOT / "docs/scene-file.md").read_text()
        for title, properties in tables.items():
            section = re.search(r"(?ms)^##+ %s\n(.*?)(?=^#|\Z)" % title, page).group(1)
            header = [cell.strip() for cell in re.search(r"(?m)^\| key \|.*$", section).group().split("|")]
            for row in re.findall(r"(?m)^\| `.*$", section):
                cells = [cell.strip() for cell in row.split("|")]
                for key in re.findall(r"`(\w+)`", cells[1]):
                    stated = properties.get(key, {}).get("default")
                    if stated is None or stated == [] or key == "intensity":
                        continue
                    with self.subTest(f"{title}: {key}"):
                        cell = cells[header.index("default")]
                        found = re.match(r"`([^`]*)`|[\d./]+", cell)
                        self.assertIsNotNone(found, cell)
                        if isinstance(stated, (int, float)) and not isinstance(stated, bool):
                            self.assertAlmostEqual(stated, c_value(found.group().strip("`")), delta=1e-5)
                        else:
                            self.assertEqual(found.group(1), stated if isinstance(stated, str) else json.dumps(stated))
                        checked += 1
        self.assertGreater(checked, 15)
