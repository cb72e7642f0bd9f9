# test_animation.py: --turntable and --sweep: the files; each frame must equal the still picture of its values.
import ctypes
import ctypes.util
import hashlib
import json
import os
import shutil
import signal
import struct
import subprocess
import unittest

from gif import read_gif
from harness import PROGRAM, SHARED_MODELS, Case, covered, decode_png, pixel, png_chunks, read_png, wait_until_caught

SMALL = ["-s", "64", "-q"]


class Frame:
    def __init__(self, control):
        (self.sequence, self.width, self.height, self.x, self.y, self.delay, self.rate, self.dispose,
         self.blend) = struct.unpack(">IIIIIHHBB", control)
        self.packed = b""


class Apng:
    """Decodes an animated PNG by the rules of the specification, and checks the rules."""

    def __init__(self, data):
        self.boxes, frames, sequence, ended = [], [], 0, False
        for kind, body in png_chunks(data):
            assert not ended
            if kind == b"IHDR":
                self.width, self.height, depth, self.color, *rest = struct.unpack(">IIBBBBB", body)
                assert depth == 8 and rest == [0, 0, 0]
            elif kind == b"acTL":
                assert not frames
                self.count, self.loops = struct.unpack(">II", body)
            elif kind == b"fcTL":
                frames.append(Frame(body))
                assert frames[-1].sequence == sequence
                sequence += 1
            elif kind == b"IDAT":
                assert len(frames) == 1, "the first frame is the picture of programs that know no animation"
                frames[0].packed += body
            elif kind == b"fdAT":
                assert len(frames) > 1 and struct.unpack(">I", body[:4])[0] == sequence
                sequence += 1
                frames[-1].packed += body[4:]
            ended = kind == b"IEND"
        assert ended and len(frames) == self.count
        self.delays = {(frame.delay, frame.rate) for frame in frames}
        self.boxes = [(frame.x, frame.y, frame.width, frame.height) for frame in frames]
        assert self.boxes[0] == (0, 0, self.width, self.height)
        canvas, self.pictures = bytearray(4 * self.width * self.height), []
        for frame in frames:
            assert (frame.dispose, frame.blend) == (0, 0)
            assert frame.x + frame.width <= self.width and frame.y + frame.height <= self.height
            pixels = decode_png(frame.width, frame.height, self.color, frame.packed)
            for y in range(frame.height):
                at = 4 * ((frame.y + y) * self.width + frame.x)
                canvas[at:at + 4 * frame.width] = pixels[4 * y * frame.width:4 * (y + 1) * frame.width]
            self.pictures.append((self.width, self.height, bytes(canvas)))


class WebpFrames:
    """The frames of an animated WebP, decoded by libwebpdemux from libwebp-dev."""

    def __init__(self, data):
        class Data(ctypes.Structure):
            _fields_ = [("bytes", ctypes.c_char_p), ("size", ctypes.c_size_t)]

        class Info(ctypes.Structure):
            _fields_ = [(name, ctypes.c_uint32) for name in ("width", "height", "loops", "background", "count")] + [("pad", ctypes.c_uint32 * 4)]

        library = ctypes.CDLL("libwebpdemux.so.2")
        library.WebPAnimDecoderNewInternal.restype = ctypes.c_void_p
        given = Data(data, len(data))
        decoder = ctypes.c_void_p(library.WebPAnimDecoderNewInternal(ctypes.byref(given), None, 0x0107))
        assert decoder.value
        info = Info()
        assert library.WebPAnimDecoderGetInfo(decoder, ctypes.byref(info))
        self.loops, self.count, self.pictures, self.ends = info.loops, info.count, [], []
        pixels, end = ctypes.POINTER(ctypes.c_ubyte)(), ctypes.c_int()
        while library.WebPAnimDecoderHasMoreFrames(decoder):
            assert library.WebPAnimDecoderGetNext(decoder, ctypes.byref(pixels), ctypes.byref(end))
            self.pictures.append((info.width, info.height, bytes(pixels[:4 * info.width * info.height])))
            self.ends.append(end.value)
        library.WebPAnimDecoderDelete(decoder)


def have_demux():
    try:
        ctypes.CDLL("libwebpdemux.so.2")
        return True
    except OSError:
        return False


class Animated(Case):
    def read(self, name):
        return (self.folder / name).read_bytes()

    def animated(self, *words):
        self.good(*words, *SMALL, "-o", "a.png")
        return Apng(self.read("a.png"))

    def still(self, *words):
        self.good(*words, *SMALL, "-o", "still.png")
        return read_png(self.read("still.png"))


class Turntable(Animated):
    def test_frames_are_the_stills_of_their_angles(self):
        for words in (["cube.obj"], ["cube.obj", "-b", "white"], ["torus-knot", "--material", "gold", "--shadows"],
                      ["cube.obj", "--rotate", "x:20", "--light", "point:position=1r/1r/2r"]):
            animation = self.animated(*words, "--turntable", "4")
            self.assertEqual((animation.count, animation.loops, animation.delays), (4, 0, {(1, 24)}))
            for k in range(4):
                self.assertEqual(animation.pictures[k], self.still(*words, "--rotate", f"y:{90 * k}"), f"{words} {k}")
            self.assertEqual(read_png(self.read("a.png")), animation.pictures[0])

    def test_the_up_axis_is_the_models(self):
        for up, turn in (("z", "z:90"), ("x", "x:90"), ("-y", "y:-90"), ("-z", "z:-90")):
            animation = self.animated("cube.obj", "--up", up, "--turntable", "4")
            self.assertEqual(animation.pictures[1], self.still("cube.obj", "--up", up, "--rotate", turn), up)

    def test_light_that_turns_with_the_model(self):
        # A light in the world's frame: the camera circles the model, against the turn.
        light = ["--light", "directional:direction=-1/-1/-1"]
        animation = self.animated("cube.obj", *light, "--turntable", "4", "--turntable-light", "model")
        self.assertEqual(self.good("cube.obj", *light, "--turntable", "4,light=model", "-o", "-").stdout,
                         self.good("cube.obj", *light, "--turntable", "4", "--turntable-light", "model", "-o", "-").stdout)
        for k in range(4):
            self.good("cube.obj", *light, "--azimuth", 30 - 90 * k, "--sweep", "azimuth=%d..%d" % (30 - 90 * k, 390 - 90 * k),
                      "--frames", "2", *SMALL, "-o", "around.png")
            around = Apng(self.read("around.png")).pictures[0]
            self.assertEqual(covered(animation.pictures[k]), covered(around))
            steps = max(abs(a - b) for a, b in zip(animation.pictures[k][2], around[2]))
            self.assertLessEqual(steps, 1, k)
        # Lights in the camera's frame stay where they are in the first frame. The tops of the frames, which lights of a moving
        # camera would light equally, therefore differ.
        fixed = self.animated("cube.obj", "--turntable", "2", "--turntable-light", "model", "--rig", "headlight")
        self.assertGreater(sum(fixed.pictures[0][2]), 1.5 * sum(fixed.pictures[1][2][i] for i in range(len(fixed.pictures[1][2])) if i % 4 < 3))
        still = self.animated("cube.obj", "--turntable", "2", "--rig", "headlight")
        self.assertEqual(still.pictures[0], fixed.pictures[0])

    def test_one_camera_serves_all_frames(self):
        # A long box would fill the picture in some frames and be smaller in others.
        (self.folder / "bar.obj").write_text("v -5 -1 -1\nv 5 -1 -1\nv 5 1 -1\nv -5 1 -1\nv -5 -1 1\nv 5 -1 1\nv 5 1 1\nv -5 1 1\n"
                                             "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n")
        for sweep in (["--turntable", "8"], ["--turntable", "8", "--turntable-light", "model"], ["--sweep", "azimuth=0..360", "--frames", "8"]):
            boxes = [covered(picture) for picture in self.animated("bar.obj", "--projection", "orthographic", "--elevation", "0", *sweep).pictures]
            heights = {box[3] - box[1] for box in boxes}
            self.assertLessEqual(max(heights) - min(heights), 1, sweep)
            self.assertGreater(max(box[2] - box[0] for box in boxes), 50)
            self.assertGreater(max(box[2] - box[0] for box in boxes), 2 * min(box[2] - box[0] for box in boxes), sweep)

    def test_only_what_changes_is_stored(self):
        animation = self.animated("cube.obj", "-b", "white", "--turntable", "6")
        left, top, right, bottom = 64, 64, 0, 0
        for picture in animation.pictures:
            for y in range(64):
                for x in range(64):
                    if pixel(picture, x, y) != (255, 255, 255, 255):
                        left, top, right, bottom = min(left, x), min(top, y), max(right, x + 1), max(bottom, y + 1)
        for x, y, width, height in animation.boxes[1:]:
            self.assertTrue(left <= x and top <= y and x + width <= right and y + height <= bottom)
        # Equal frames contain one pixel.
        same = self.animated("sphere", "--sweep", "exposure=0..0", "--frames", "3")
        self.assertEqual(same.boxes[1:], [(0, 0, 1, 1)] * 2)

    def test_frames_of_more_channels_than_the_first(self):
        # Black on white, then red on white; the first frame has no transparent pixel.
        animation = self.animated("sphere", "--color", "red", "-b", "white", "--sweep", "light-scale=0..1", "--frames", "3")
        self.assertEqual(animation.color, 2)
        grey = self.animated("sphere", "-b", "white", "--sweep", "light-scale=0..1", "--frames", "3")
        self.assertEqual(grey.color, 0)
        for k, scale in enumerate((0, 0.5, 1)):
            self.assertEqual(animation.pictures[k], self.still("sphere", "--color", "red", "-b", "white", "--light-scale", scale))
        zoomed = self.animated("sphere", "--sweep", "zoom=4..1", "--frames", "2")
        self.assertEqual(zoomed.color, 4)
        self.assertEqual(zoomed.pictures[0], self.still("sphere", "--zoom", "4"))
        self.assertEqual(zoomed.pictures[1], self.still("sphere", "--zoom", "1"))

    def test_the_bytes_depend_on_the_pictures_alone(self):
        first = None
        isas = ["scalar"] + [isa for isa in ("sse4", "avx2", "avx512", "neon")
                             if self.run_program("cube.obj", "--isa", isa, *SMALL, "-o", "x.png").returncode == 0]
        for isa in isas:
            for threads in (1, 3):
                self.good("torus-knot", "-s", "300x200", "--turntable", "5", "--isa", isa, "-j", threads, "-q", "-o", "a.png")
                first = first or self.read("a.png")
                self.assertEqual(self.read("a.png"), first, (isa, threads))

    def test_files_of_frames(self):
        animation = self.animated("cube.obj", "--turntable", "12")
        self.good("cube.obj", "--turntable", "12", *SMALL, "-o", "turn/{stem}-{frame}.png")
        self.assertEqual(sorted(os.listdir(self.folder / "turn")), [f"cube-{k:02}.png" for k in range(12)])
        for k in range(12):
            self.assertEqual(read_png(self.read(f"turn/cube-{k:02}.png")), animation.pictures[k])
        self.good("cube.obj", "--turntable", "2", *SMALL, "-o", "{frame}.jpg")
        self.good("cube.obj", "--turntable", "2", *SMALL, "-o", "{frame}.pfm")
        self.assertTrue({"0.jpg", "1.jpg", "0.pfm", "1.pfm"} <= self.new_files())

    def test_standard_output_and_default_name(self):
        self.animated("cube.obj", "--turntable", "3")
        self.assertEqual(self.good("cube.obj", "--turntable", "3", *SMALL, "-o", "-").stdout, self.read("a.png"))
        self.good("cube.obj", "--turntable", "3", *SMALL)
        self.assertEqual(self.read("cube.png"), self.read("a.png"))
        self.good("cube.obj", "sphere", "--turntable", "3", *SMALL, "-o", "both/")
        self.assertEqual(sorted(os.listdir(self.folder / "both")), ["cube.png", "sphere.png"])
        self.assertEqual(self.read("both/cube.png"), self.read("a.png"))

    def test_the_time_of_a_frame(self):
        for fps, delay in (("30", (1, 30)), ("12.5", (1000, 12500)), ("0.1", (1000, 100)), ("99.5", (100, 9950))):
            self.assertEqual(self.animated("cube.obj", "--turntable", "2", "--fps", fps).delays, {delay})

    @unittest.skipUnless(have_demux(), "libwebpdemux is not installed")
    def test_webp(self):
        png = self.animated("cube.obj", "--turntable", "5", "--fps", "30")
        self.good("cube.obj", "--turntable", "5", "--fps", "30", *SMALL, "-o", "a.webp")
        webp = WebpFrames(self.read("a.webp"))
        self.assertEqual((webp.count, webp.loops, webp.ends), (5, 0, [33, 67, 100, 133, 167]))
        for k in range(5):
            for (_, _, a), (_, _, b) in ((png.pictures[k], webp.pictures[k]),):
                for i in range(0, len(a), 4):  # a transparent pixel has no colour
                    self.assertTrue(a[i:i + 4] == b[i:i + 4] or (a[i + 3] == 0 and b[i + 3] == 0), (k, i))
        self.good("cube.obj", "--turntable", "5", "--quality", "50", *SMALL, "-o", "lossy.webp")
        self.assertEqual(WebpFrames(self.read("lossy.webp")).count, 5)


class Sweep(Animated):
    def test_values_of_options_materials_and_turns(self):
        for key, values, words in (
                ("exposure", "-1..1", lambda v: ["--exposure", v]), ("opacity", "0..1", lambda v: ["--opacity", v]),
                ("shininess", "5..95", lambda v: ["--shininess", v]), ("kd", "0..1", lambda v: ["--material", f"kd={v}"]),
                ("material.shininess", "5..95", lambda v: ["--material", f"shininess={v}"]),
                ("ambient", "0..0.5", lambda v: ["--ambient", v]), ("rotate.x", "0..90", lambda v: ["--rotate", f"x:{v}"]),
("zoom", "1..2", lambda v: ["--zoom", v])):
            first, last = map(float, values.split(".."))
            animation = self.animated("sphere", "-b", "navy", "--sweep", f"{key}={values}", "--frames", "3")
            for k in range(3):
                self.assertEqual(animation.pictures[k], self.still("sphere", "-b", "navy", *words((first + (last - first) * k / 2))), f"{key} {k}")

    def test_options_that_load(self):
        camera = ["--camera", "eye=1/2/4", "-b", "white"]
        for shape, key, values in (("sphere", "segments", (4, 6, 8)), ("torus-knot", "crease-angle", (0, 30, 60))):
            animation = self.animated(shape, *camera, "--sweep", f"{key}={values[0]}..{values[2]}", "--frames", "3")
            for k in range(3):
                self.assertEqual(animation.pictures[k], self.still(shape, *camera, f"--{key}", values[k]), f"{key} {k}")

    def test_keys_of_a_part(self):
        (self.folder / "m.mtl").write_text("newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 1 0\n")
        (self.folder / "two.obj").write_text("mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nusemtl a\nf 1 2 3\nusemtl b\nf 2 4 5\n")
        animation = self.animated("two.obj", "--sweep", "kd@b=0..1", "--frames", "2")
        for k in range(2):
            self.assertEqual(animation.pictures[k], self.still("two.obj", "--material", f"kd={k}@b"))

    def test_lights(self):
        base = ["sphere", "-b", "white", "--view", "front"]
        light = "directional:direction="
        animation = self.animated(*base, "--light", light + "0/0/-1", "--sweep", "light.azimuth=0..360", "--frames", "4")
        # A light from azimuth 0, 90, 180 and 270: from the front, the right, behind and the left.
        for k, way in enumerate(("0/0/-1", "-1/0/0", "0/0/1", "1/0/0")):
            still = self.still(*base, "--light", light + way)
            self.assertLessEqual(max(abs(a - b) for a, b in zip(animation.pictures[k][2], still[2])), 1, k)
        animation = self.animated(*base, "--light", light + "0/0/-1", "--sweep", "light.elevation=0..90", "--frames", "2")
        still = self.still(*base, "--light", light + "0/-1/0")
        self.assertLessEqual(max(abs(a - b) for a, b in zip(animation.pictures[1][2], still[2])), 1)
        # With z up the front is -y.
        animation = self.animated(*base, "--up", "z", "--light", light + "0/1/0", "--sweep", "light.azimuth=0..90", "--frames", "2")
        still = self.still(*base, "--up", "z", "--light", light + "-1/0/0")
        self.assertLessEqual(max(abs(a - b) for a, b in zip(animation.pictures[1][2], still[2])), 1)

    def test_fields_of_lights(self):
        base = ["torus-knot", "-b", "white"]
        spot = "spot:position=0/0/4,name=lamp,cutoff=%s"
        animation = self.animated(*base, "--light", "ambient:color=0.1", "--light", spot % 5, "--sweep", "light.lamp.cutoff=5..20", "--frames", "2")
        for k, cutoff in enumerate((5, 20)):
            self.assertEqual(animation.pictures[k], self.still(*base, "--light", "ambient:color=0.1", "--light", spot % cutoff))
        by_number = self.animated(*base, "--light", "ambient:color=0.1", "--light", spot % 5, "--sweep", "light.2.cutoff=5..20", "--frames", "2")
        self.assertEqual(by_number.pictures, animation.pictures)
        moved = self.animated(*base, "--light", "point:position=0/0/4", "--sweep", "light.position.x=0..3", "--frames", "2")
        self.assertEqual(moved.pictures[1], self.still(*base, "--light", "point:position=3/0/4"))
        red = self.animated(*base, "--light", "point:position=0/0/4", "--sweep", "light.diffuse.r=0..1", "--frames", "2")
        self.assertEqual(red.pictures[0], self.still(*base, "--light", "point:position=0/0/4,diffuse=0/1/1"))
        dim = self.animated(*base, "--light", "point:position=0/0/4", "--sweep", "light.intensity=0.25..1", "--frames", "2")
        self.assertEqual(dim.pictures[0], self.still(*base, "--light", "point:position=0/0/4,intensity=0.25"))
        # The studio's lights have names.
        studio = self.animated(*base, "--sweep", "light.key.intensity=1..0", "--frames", "2")
        self.assertEqual(studio.pictures[0], self.still(*base))
        self.assertNotEqual(studio.pictures[1], studio.pictures[0])

    def test_a_spot_keeps_its_aim(self):
        base = ["sphere", "--view", "top", "-b", "white"]
        spot = "spot:position=%s,cutoff=3"
        animation = self.animated(*base, "--light", spot % "0/4/0.001", "--sweep", "light.azimuth=0..360", "--frames", "4")
        for k in range(1, 4):
            lit = [sum(picture[2][i] > 100 for i in range(0, len(picture[2]), 4)) for picture in (animation.pictures[0], animation.pictures[k])]
            self.assertLessEqual(abs(lit[0] - lit[1]), 4)

    def test_stops_and_loops(self):
        def values(sweep, frames):
            """The exposures, computed from a grey picture of one light: 2^stops."""
            animation = self.animated("sphere", "--color-mode", "raw", "--light", "ambient:color=0.1", "--sweep", "exposure=" + sweep, "--frames", frames)
            return [round(pixel(picture, 32, 32)[0] / 255 / 0.1 / 0.8, 1) for picture in animation.pictures]
        up = values("0..2", 3)
        self.assertEqual([round(v / up[0]) for v in up], [1, 2, 4])
        back = values("0..2..0", 4)  # the last frame comes one step before the first
        self.assertEqual([round(v / back[0]) for v in back], [1, 2, 4, 2])

    def test_elevation_keeps_the_distance(self):
        # A sphere has the same size from everywhere.
        boxes = {covered(p) for p in self.animated("sphere", "--sweep", "elevation=-80..80", "--sweep", "azimuth=0..90", "--frames", "5").pictures}
        self.assertLessEqual(max(b[2] - b[0] for b in boxes) - min(b[2] - b[0] for b in boxes), 1)
        side = self.animated("cube.obj", "--projection", "orthographic", "--azimuth", "0", "--sweep", "elevation=0..90", "--frames", "2")
        top = self.still("cube.obj", "--projection", "orthographic", "--view", "top", "--rotate", "x:0", "--rotate", "y:0")
        self.assertEqual(covered(side.pictures[1]), covered(top))

    def test_with_a_turntable(self):
        animation = self.animated("cube.obj", "--turntable", "4", "--sweep", "exposure=0..-2..0")
        for k, stops in enumerate((0, -1, -2, -1)):
            self.assertEqual(animation.pictures[k], self.still("cube.obj", "--rotate", f"y:{90 * k}", "--exposure", stops))

    @unittest.skipUnless(SHARED_MODELS.is_dir(), "needs shared/models")
    def test_time_of_an_animation(self):
        fox = SHARED_MODELS / "glb" / "bevy" / "Fox.glb"
        report = self.report(fox, "--animation", "Walk", "--sweep", "time", "--fps", "10", "-s", "64", "-o", "a.png")
        animation = Apng(self.read("a.png"))
        info = json.loads(self.good("info", fox, "--json").stdout)
        walk = [a for a in info["animations"] if a["name"] == "Walk"][0]
        self.assertEqual(animation.count, round(walk["length_s"] * 10) if "length_s" in walk else animation.count)
        self.assertEqual(report["image"]["animation"]["frames"], animation.count)
        # One camera that shows every pose completely; still pictures with this camera are the same.
        camera = report["camera"]
        words = "eye={}/{}/{},target={}/{}/{},up={}/{}/{},fovy={}".format(*camera["eye"], *camera["target"], *camera["up"], camera["fovy_deg"])
        part = self.animated(fox, "--animation", "Walk", "--camera", words, "--sweep", "time=0..0.4", "--frames", "3")
        for k in range(3):
            self.assertEqual(part.pictures[k], self.still(fox, "--animation", "Walk", "--camera", words, "--time", 0.2 * k))
        for picture in animation.pictures:
            left, top, right, bottom = covered(picture)
            self.assertTrue(left > 0 and top > 0 and right < 64 and bottom < 64)

    @unittest.skipUnless(SHARED_MODELS.is_dir(), "needs shared/models")
    def test_exposure_is_the_first_frames(self):
        lights = next((SHARED_MODELS / "gltf" / "khr_lights_example").glob("*.gl*"), None)
        if not lights:
            self.skipTest("no model with lights in candela")
        report = self.report(lights, "--rig", "file", "--turntable", "3", "-s", "64", "-o", "a.png")
        self.assertEqual(report["image"]["exposure"], "auto")
        stops = report["image"]["exposure_stops"]
        animation = Apng(self.read("a.png"))
        for k in range(3):
            still = self.still(lights, "--rig", "file", "--rotate", f"y:{120 * k}", "--exposure", stops)
            self.assertLessEqual(max(abs(a - b) for a, b in zip(animation.pictures[k][2], still[2])), 1, k)


class Gif(Animated):
    def gif(self, *words):
        self.good(*words, "-o", "a.gif", *SMALL)
        return read_gif((self.folder / "a.gif").read_bytes())

    def test_frames_are_the_still_pictures(self):
        """The colours differ by less than the dither and half a box of the palette; the transparent pixels are those below half of alpha."""
        words = ("torus", "--color", "orange", "--turntable", "6")
        width, height, loops, frames = self.gif(*words)
        self.assertEqual((width, height, loops, len(frames)), (64, 64, 0, 6))
        self.good(*words, "-o", "{frame}.png", *SMALL)
        for i, (_, pixels) in enumerate(frames):
            _, _, still = read_png((self.folder / f"{i}.png").read_bytes())
            for at in range(0, len(still), 4):
                beside = [still[near + 3] for near in (at - 4, at + 4, at - 256, at + 256) if 0 <= near < len(still)]
                if still[at + 3] in (0, 255) or 255 in beside:
                    self.assertEqual(pixels[at + 3], 255 * (still[at + 3] >= 128))
                if pixels[at + 3]:
                    self.assertLessEqual(max(abs(a - b) for a, b in zip(pixels[at:at + 3], still[at:at + 3])), 24, (i, at))
        self.assertGreater(len({frames[0][1][at:at + 3] for at in range(0, len(frames[0][1]), 4)}), 100)

    def test_delays_add_up(self):
        for fps, delays in ((24, [4, 4, 5, 4, 4, 4, 4, 4, 5]), (12, [8, 9, 8, 8, 9, 8]), (50, [2] * 8), (0.5, [200, 200])):
            found = [delay for delay, _ in self.gif("cube", "--turntable", len(delays), "--fps", fps)[3]]
            self.assertEqual(sum(found), round(100 * len(delays) / fps))
            self.assertEqual(sorted(found), sorted(delays))
        self.bad(1, "cube", "--turntable", "4", "--fps", "60", "-o", "b.gif", says="GIF: 60 frames a second, expected at most 50", leaves={"a.gif"})

    def test_transparency(self):
        soft = self.gif("cube", "--look", "catalog", "--turntable", "2")[3][0][1]
        colors = {bytes(soft[at:at + 4]) for at in range(0, len(soft), 4)}
        self.assertIn(bytes(4), colors)
        self.assertGreater(sum(soft[at:at + 4] == b"\0\0\0\xff" for at in range(0, len(soft), 4)), 20)  # the dithered shadow
        self.assertTrue(all(alpha == 255 for alpha in self.gif("cube", "-b", "white", "--turntable", "2")[3][0][1][3::4]))
        self.assertEqual(self.gif("cube", "--hide", "cube", "--turntable", "2")[3][0][1], bytes(4 * 64 * 64))

    def test_still_and_small(self):
        _, _, loops, frames = self.gif("cube")
        self.assertEqual((loops, len(frames)), (None, 1))
        for size in ("1", "1x7", "300x1"):
            self.good("cube", "-s", size, "-o", "b.gif")
            read_gif((self.folder / "b.gif").read_bytes())
        self.good("teapot", "-s", "700x500", "--material", "gold", "-o", "b.gif")  # more codes than the table of LZW holds
        read_gif((self.folder / "b.gif").read_bytes())

    def test_same_bytes_everywhere(self):
        hashes = set()
        for words in ((), ("--threads", 1), ("--isa", "scalar")):
            self.gif("teapot", "--material", "gold", "--turntable", "3", *words)
            hashes.add(hashlib.sha256((self.folder / "a.gif").read_bytes()).hexdigest())
        self.assertEqual(hashes, {"0f8af58eaf312776b630d14cbcb0a7b76a69cb511471ea0a8d969e8955bea11b"})

    def test_stream(self):
        words = ("cube", "--turntable", "3", "-s", "16")
        stream = self.good(*words, "--stream", "-q").stdout
        self.good(*words, "-o", "{frame}.png")
        self.assertEqual(stream, b"".join((self.folder / f"{i}.png").read_bytes() for i in range(3)))
        self.bad(1, *words, "--stream", "-o", "x.png", says="expected -o -", leaves=self.new_files())
        self.bad(1, "cube", "--stream", says="needs --turntable", leaves=self.new_files())
        if shutil.which("ffmpeg"):
            video = subprocess.run(["ffmpeg", "-v", "error", "-f", "image2pipe", "-i", "-", "-f", "framemd5", "-"], input=stream, stdout=subprocess.PIPE, check=True).stdout
            self.assertEqual(sum(not line.startswith(b"#") for line in video.splitlines()), 3)

    @unittest.skipUnless((SHARED_MODELS / "glb/kaykit_adventurers/Knight.glb").exists(), "no models")
    def test_an_animation_moves(self):
        knight = SHARED_MODELS / "glb/kaykit_adventurers/Knight.glb"
        length = next(row["seconds"] for row in json.loads(self.good("info", knight, "--json").stdout)["animations"] if row["name"] == "Walking_A")
        frames = self.gif(knight, "--animation", "Walking_A", "--fps", "10")[3]
        self.assertEqual(len(frames), round(10 * length))
        self.assertGreater(len({pixels for _, pixels in frames}), len(frames) // 2)
        # The surfaces of the frames fill the picture, as in a still picture, and not only a box around all poses.
        boxes = [covered(picture) for picture in self.animated(knight, "--animation", "Walking_A", "--sweep", "time", "--frames", "8").pictures]
        height = max(box[3] for box in boxes) - min(box[1] for box in boxes)
        self.assertTrue(0.86 * 64 <= height < 64, height)
        for words in (("--time", "0.3", "-o", "b.gif"), ("-o", "b.png")):
            self.good(knight, "--animation", "Walking_A", *words, *SMALL)
        self.assertEqual(len(read_gif((self.folder / "b.gif").read_bytes())[3]), 1)
        self.assertNotIn(b"acTL", (self.folder / "b.png").read_bytes())


class Reports(Animated):
    def test_json(self):
        report = self.report("cube.obj", "--turntable", "12", "--fps", "6", "-s", "64", "-o", "{frame}.png")
        self.assertEqual(report["image"]["animation"], {"frames": 12, "frames_per_second": 6, "last": "11.png"})
        self.assertEqual(report["image"]["path"], "00.png")
        self.assertEqual(report["image"]["bytes"], sum(len(self.read(f"{k:02}.png")) for k in range(12)))
        self.assertEqual(report["times_ms"]["frames"], 12)
        report = self.report("cube.obj", "--turntable", "12", "-s", "64", "-o", "a.png")
        self.assertEqual(report["image"]["animation"]["last"], None)
        self.assertEqual(report["image"]["bytes"], len(self.read("a.png")))

    def test_table_line_and_plan(self):
        text = self.good("cube.obj", "--turntable", "12", "-s", "64", "-v", "-o", "a.png").stderr.decode()
        self.assertIn("frames   12, 24 a second: 0.5 s, forever", text)
        self.assertIn("12 frames, the median one above", text)
        self.assertIn("a.png  3 frames  64x64", self.good("cube.obj", "--turntable", "3", "-s", "64", "-o", "a.png").stderr.decode())
        self.assertIn("0.png to 2.png  3 frames", self.good("cube.obj", "--turntable", "3", "-s", "64", "-o", "{frame}.png").stderr.decode())
        os.remove(self.folder / "a.png")
        for k in range(3):
            os.remove(self.folder / f"{k}.png")
        self.assertIn("frames    3, 24 a second", self.good("cube.obj", "--turntable", "3", "--dry-run", "-o", "a.png").stdout.decode())
        self.assertEqual(self.new_files(), set())
        self.assertEqual(self.report("cube.obj", "--turntable", "3", "--dry-run", "-o", "{frame}.png")["planned"]["animation"]["last"], "2.png")

    def test_warnings_are_printed_once(self):
        text = self.good("sphere", "--reflection-map", "sky", "--turntable", "4", "-s", "32", "-o", "a.png").stderr.decode()
        self.assertEqual(text.count("the environment is invisible"), 1)

    def test_interrupt(self):
        for name, leaves in (("a.png", r"^$"), ("{frame}.png", r"^(\d{5}\.png)?$")):
            process = subprocess.Popen([PROGRAM, "torus-knot", "--turntable", "99999", "-s", "200", "-o", name], cwd=self.folder, stderr=subprocess.PIPE)
            wait_until_caught(process, signal.SIGINT)
            process.send_signal(signal.SIGINT)
            text = process.communicate(timeout=30)[1].decode()
            self.assertEqual(process.returncode, -signal.SIGINT, text)
            self.assertIn("interrupted", text)
            for file in self.new_files():
                self.assertRegex(file, leaves)
                read_png(self.read(file))  # whole
                os.remove(self.folder / file)


class Errors(Animated):
    def test_numbers_of_frames(self):
        for words in (["--turntable", "0"], ["--turntable", "1"], ["--turntable", "-5"], ["--turntable", "2.5"], ["--turntable", "x"]):
            self.bad(1, "cube.obj", *words, says="option '--turntable': found")
        self.bad(1, "cube.obj", "--sweep", "exposure=0..1", "--frames", "1", says="option '--frames': found '1', expected a whole number from 2")
        self.bad(1, "cube.obj", "--turntable", "4", "--fps", "0", says="option '--fps': found '0'")

    def test_options_that_need_others(self):
        self.bad(1, "cube.obj", "--frames", "4", says="option '--frames' needs --sweep")
        self.bad(1, "cube.obj", "--fps", "4", says="option '--fps' needs --turntable or --sweep")
        self.bad(1, "cube.obj", "--turntable-light", "model", says="option '--turntable-light' needs --turntable")
        self.bad(1, "cube.obj", "--sweep", "zoom=1..2", "--turntable-light", "model", says="option '--turntable-light' needs --turntable")
        self.bad(1, "cube.obj", "--turntable", "4", "--frames", "4", says="option '--frames' applies only to --sweep")
        self.bad(1, "cube.obj", "--turntable", "4", "--repeat", "4", says="'--turntable' and '--repeat' cannot be used together")
        self.bad(1, "cube.obj", "--sweep", "zoom=1..2", "--save-scene", "x.json", says="'--sweep' and '--save-scene' cannot")
        self.bad(1, "cube.obj", "--sweep", "azimuth=1..2", "--camera", "eye=1/2/3", says="'--camera' and '--sweep azimuth' cannot")
        self.bad(1, "compare", "cube.obj", "--turntable", "4", says="option '--turntable' does not apply")
        self.bad(1, "cube.obj", "-o", "{frame}.png", says="{frame}")

    def test_formats(self):
        for format in ("jpg", "ppm", "pfm"):
            done = self.bad(3, "cube.obj", "--turntable", "4", "-o", f"a.{format}", says=f"a file of format {format} contains one picture; expected .png, .webp or .gif, or {{frame}}")
            self.assertEqual(done.stderr.decode().count("\n"), 1)

    def test_sweeps(self):
        for value, says in (("zoom", "expected zoom=FROM..TO"), ("zoom=", "expected two numbers with two dots"), ("zoom=1", "expected two numbers with two dots"),
                            ("zoom=1..", "expected two numbers"), ("zoom=1..x", "expected two numbers"), ("zoom=0..1", "expected a number from 0.001"),
                            ("zom=1..2", "did you mean 'zoom'?"), ("view=1..2", "'view' has no numbers"), ("threads=1..2", "'threads' has no numbers"),
                            ("quality=1..2", "'quality' has no numbers"), ("roughnes=0..1", "did you mean 'roughness'?"), ("elevation=0..95", "found '95'"),
                            ("light.foo=0..1", "expected light.NUMBER"), ("light.position=0..1", "expected light.NUMBER"), ("light=0..1", "expected light.NUMBER"),
                            ("light.shadows=0..1", "expected light.NUMBER"), ("rotate.w=0..1", "unknown key")):
            self.bad(1, "cube.obj", "--sweep", value, says=["option '--sweep'", says])
        self.bad(1, "cube.obj", "--sweep", "light.9.azimuth=0..1", says=["there is no light '9'", "the lights are 1 ("])
        self.bad(1, "cube.obj", "--light", "point", "--sweep", "light.cutoff=0..1", says="no light has 'cutoff'; the lights are 1 (point)")
        self.bad(1, "cube.obj", "--light", "point", "--sweep", "light.1.cutoff=0..1", says="light 1 has no cutoff")
        self.bad(1, "cube.obj", "--light", "point", "--sweep", "light.occluded=0..2", says="option '--sweep'")
        self.bad(1, "cube.obj", "--sweep", "time", says="does not state how long its animation is")

    def test_a_folder_that_is_missing(self):
        self.bad(5, "cube.obj", "--turntable", "3", "-o", "no/a.png", says="no")

    def test_memory_of_frames(self):
        # A given time limit applies to all frames together, the default to each frame.
        done = self.bad(4, "torus-knot", "--turntable", "5000", "-s", "400", "--time-limit", "1", "-o", "a.png", says="time limit of 1 s")
        self.assertEqual(done.stderr.decode().count("\n"), 1)
