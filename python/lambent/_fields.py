"""_fields.py: converts values given by users, and defines the classes Material, Light and Camera, whose attributes are the rows of the library's
tables."""
import math
import os

import numpy as np

from ._core import BadValue, Unsupported, call, every, shown, text_bytes, text_of
from ._members import MEMBERS
from ._native import ffi, lib


def words_of(kind):
    """The words of an enumeration and their values, from the library or from the enumerators' names: LAM_RIG_THREE_POINT is "three-point"."""
    names = sorted(item for item in ffi.typeof(kind).elements.items() if not item[1].endswith("_COUNT"))
    name_of, common = getattr(lib, kind + "_name", None), os.path.commonprefix([name for _, name in names]).rfind("_") + 1
    return {text_of(name_of(number)) if name_of else name[common:].lower().replace("_", "-"): number for number, name in names}


def choose(what, words, value):
    """The value of a word."""
    word = str(value).lower().replace("_", "-")
    if word not in words:
        raise BadValue("%s: found %s, expected %s" % (what, shown(value), " or ".join(filter(None, [", ".join(list(words)[:-1]), list(words)[-1]]))))
    return words[word]


def color(what, value, mode=lib.LAM_COLOR_SRGB):
    """A colour as four linear numbers: from a text ("#ff8800", "white"; decoded from sRGB), from one number, or from three or four."""
    found = ffi.new("lam_rgba *")
    try:
        call(lib.lam_color_parse, text_bytes("a colour", written(value)), mode, found)
    except BadValue as error:
        raise BadValue("%s: %s" % (what, error)) from None
    return found.r, found.g, found.b, found.a


def written(value):
    """A value in the form of the program's options: 1/2/3, yes, 0.5."""
    if isinstance(value, (bool, str)):
        return ("no", "yes")[value] if isinstance(value, bool) else value
    try:
        return "/".join(number if isinstance(number, str) else repr(float(number)) for number in (value if hasattr(value, "__iter__") else [value]))
    except (TypeError, ValueError, OverflowError):
        raise BadValue("found %s, expected a string, a number or a list of numbers" % shown(value)) from None


def range_of(low, high):
    if math.isinf(high):
        return None if math.isinf(low) else "%.10g or more" % low
    return "%.10g to %.10g" % (low, high)


def plain(numbers):
    return numbers[0] if len(numbers) == 1 else tuple(numbers)


class Field:
    """An attribute: the rows with its key in a table of fields."""

    TYPES = {lib.LAM_FIELD_FLAG: ("bool", 1), lib.LAM_FIELD_RGB: ("Color", 3), lib.LAM_FIELD_RGBA: ("Color", 4),
             lib.LAM_FIELD_POINT: ("Numbers", 3), lib.LAM_FIELD_DIRECTION: ("Numbers", 3), lib.LAM_FIELD_TRIPLE: ("Numbers", 3)}

    def __init__(self, rows):
        self.key, self.rows = text_of(rows[0].key), rows
        self.type = self.TYPES.get(rows[0].type, ("float", 1))[0]
        self.__doc__ = "\n".join(map(self.describe, rows))

    def describe(self, row):
        numbers = ["%.3g" % number for number in row.standard[0:self.TYPES.get(row.type, ("float", 1))[1]]]
        standard = str(row.standard[0] != 0) if row.type == lib.LAM_FIELD_FLAG else "/".join(numbers if len(set(numbers)) > 1 else numbers[:1])
        kinds = [kind for kind, number in words_of("lam_light_type").items() if row.light_types >> number & 1]
        return "; ".join(filter(None, [text_of(row.summary), range_of(row.min, row.max) if row.type != lib.LAM_FIELD_FLAG else None, text_of(row.unit),
                                       "default " + standard, ", ".join(kinds)]))

    def __get__(self, owner, cls=None):
        if owner is None:
            return self
        numbers = ffi.new("double[4]")
        row = owner._row(self)
        count = lib.lam_field_get_written(row, owner.struct, numbers)
        return bool(numbers[0]) if row.type == lib.LAM_FIELD_FLAG else plain(numbers[0:count])

    def __set__(self, owner, value):
        owner._store(owner._row(self), self.key, value)

    def _is_standard(self, owner):
        value, row = self.__get__(owner), owner._row(self)
        numbers = ffi.new("float[4]", list(value) if isinstance(value, tuple) else [value])
        return all(number == standard for number, standard in zip(numbers, ffi.new("float[4]", list(row.standard))))


def restored(cls, data, values, texts, pictures, size):
    """The Material, Light or Camera of a pickle."""
    made = cls()
    ffi.buffer(made.struct)[:] = data
    for key in ("name", "object"):
        if hasattr(made.struct, key):
            setattr(made.struct, key, ffi.NULL)
    for key, text in texts.items():
        made.kept.append(ffi.new("char[]", text.encode()))
        setattr(made.struct, key, made.kept[-1])
    if cls is Material:
        made.struct.maps = [ffi.NULL] * len(made.struct.maps)
        for number, (name, image) in pictures.items():
            made.set_map(name, image)
    if cls is not Material:
        made.values = values
    if size is not None:
        made.size = size
    return made


def fields_of(table):
    """The attributes for a table of fields."""
    rows = {}
    for row in every(table):
        rows.setdefault(text_of(row.key), []).append(row)
    return {key: Field(found) for key, found in rows.items()}


class Described:
    """A struct of the library. `help` of the class lists its attributes with meaning, range, unit and default."""

    def __setattr__(self, name, value):
        if not hasattr(type(self), name) and name not in ("struct", "values", "kept", "size", "pictures"):
            raise AttributeError("%s has no attribute %r; it has %s" % (type(self).__name__, name, ", ".join(self._keys())))
        super().__setattr__(name, value)

    @classmethod
    def _keys(cls):
        """The names of the attributes."""
        return [key for key in dir(cls) if isinstance(getattr(cls, key), (Field, Part))]

    def __copy__(self):
        made = type(self)()
        made.__dict__.update({name: list(item) if name == "kept" else dict(item) if name == "pictures" else item for name, item in self.__dict__.items()})
        made.struct = ffi.new(ffi.typeof(self.struct), self.struct[0])
        return made

    def __deepcopy__(self, memo):
        return self.__copy__()  # pictures never change, so copies share them

    def __reduce__(self):
        """Pickles contain the bytes of the struct, its names and its pictures."""
        texts = {key: text_of(getattr(self.struct, key)) for key in ("name", "object") if hasattr(self.struct, key) and getattr(self.struct, key) != ffi.NULL}
        pictures = getattr(self, "pictures", {})
        if isinstance(self, Material) and any(map_ != ffi.NULL and number not in pictures for number, map_ in enumerate(self.struct.maps)):
            raise Unsupported("the pictures of this material belong to its scene, so only the scene can be pickled")
        return restored, (type(self), bytes(ffi.buffer(self.struct)), self.values if hasattr(self, "values") else None, texts, pictures, getattr(self, "size", None))

    def __repr__(self):
        values = {}
        for key in self._keys():
            try:
                if not getattr(type(self), key)._is_standard(self):
                    values[key] = getattr(self, key)
            except AttributeError: # a light of another type has this attribute
                pass
        return "%s(%s)" % (type(self).__name__, ", ".join([repr(self.type) for _ in [0] if isinstance(self, Light)] + ["%s=%r" % item for item in values.items()]))


class Material(type("Fields", (Described,), fields_of(lib.lam_material_field))):
    """A material: `Material("ruby")`, `Material("gold,opacity=0.5")`, `Material(diffuse="#ff8800", shininess=80)`.

    The words follow the program's option --material: a name of the classic table, then keys with values. Colours are linear reflectances as three or
    four numbers or one number, or a string such as "#ff8800" or "orange", which is decoded from sRGB. Keywords may also be the keys color,
    specular_color, ka, kd, ks and kr."""

    def __init__(self, words="", **fields):
        self.kept, self.pictures = [], {}
        self.struct = ffi.new("lam_material *", words if isinstance(words, ffi.CData) else lib.lam_material_default())
        for key in set(fields).difference(every(lib.lam_material_key)):
            setattr(self, key, fields[key]) # raises AttributeError
        text = ["" if isinstance(words, ffi.CData) else text_bytes("Material", words).decode(), *("%s=%s" % (key, written(value)) for key, value in fields.items())]
        if any(text):
            call(lib.lam_material_parse, text_bytes("Material", ",".join(filter(None, text))), lib.LAM_COLOR_SRGB, self.struct)

    def _row(self, field):
        return field.rows[0]

    def set_map(self, name: str, image: "Array | object") -> None:
        """Applies a picture to the surface: `name` is a map such as "diffuse", "normal" or "roughness"; the picture is an array height × width × 3 or
        4 of uint8, or an object of Pillow. Texture coordinates have (0, 0) at its lower left corner."""
        maps = {text: number for number, text in enumerate(every(lib.lam_map_name))}
        try:
            number, pixels = choose("map", maps, name), np.asarray(image.convert("RGBA") if hasattr(image, "convert") else image)
        except (TypeError, ValueError) as error: # rows of different lengths
            raise error if isinstance(error, BadValue) else BadValue("map: found %s, expected a picture" % shown(image)) from None
        if pixels.dtype != np.uint8 or pixels.ndim != 3 or pixels.shape[2] not in (3, 4):
            raise BadValue("map: found the shape %s of %s, expected height x width x 3 or 4 of uint8" % (pixels.shape, pixels.dtype))
        colors = name in ("ambient", "diffuse", "specular", "emission") or name.endswith("color")
        pixels = np.ascontiguousarray(pixels)
        picture = ffi.new("lam_image *", {"width": pixels.shape[1], "height": pixels.shape[0], "pixels": ffi.from_buffer(pixels),
                                          "format": lib.LAM_RGBA8 if pixels.shape[2] == 4 else lib.LAM_RGB8})
        texture = ffi.gc(call(lib.lam_texture_make, picture, 0 if colors else 1, ffi.NULL), lib.lam_texture_free)
        made = ffi.new("lam_texture_map *", {"texture": texture, "transform": [[1, 0, 0], [0, -1, 1]]})
        self.struct.maps[number] = made  # the pointer does not keep the map alive
        self.kept += [texture, made]
        self.pictures[number] = name, pixels

    def _store(self, row, key, value):
        call(lib.lam_material_parse, text_bytes(key, "%s=%s" % (key, written(value))), lib.LAM_COLOR_SRGB, self.struct)

    @property
    def name(self) -> "str | None":
        """The name in the model's file, or None."""
        return text_of(self.struct.name)


def as_material(what, value):
    """Converts a Material or its words to a Material; None stays None."""
    if value is None or isinstance(value, Material):
        return value
    return Material(text_bytes(what, value).decode())


class Light(type("Fields", (Described,), fields_of(lib.lam_light_field))):
    """A light: `Light("point", position=(2, 3, 1), color="orange", intensity=2)`, `Light("spot:position=2r/3r/1r,cutoff=20")`.

    `type` is ambient, hemisphere, point, directional or spot; keywords follow the program's option --light, so also color, intensity,
    target, frame and name. Without a position, a point light or spot is at 1r/2r/3r, where r is the radius of the scene."""

    def __init__(self, type="point", **fields):
        self.values, self.struct, self.kept = None, ffi.new("lam_light *"), []
        if isinstance(type, ffi.CData):
            self.struct[0] = type
        else:
            self._parse({"type": type, **fields})

    def _parse(self, values):
        scene = ffi.gc(call(lib.lam_scene_make), lib.lam_scene_free)
        before, self.values = self.values, values
        try:
            self._add_to(scene, ffi.new("lam_light_text_params *", {"radius": 1}))
        except BaseException:
            self.values = before
            raise
        self.struct[0] = lib.lam_scene_light(scene, 0)[0]
        self.struct.name = self.struct.object = ffi.NULL # these depend on the scene, so the text contains them again

    def _add_to(self, scene, params):
        """Adds the light to a lam_scene."""
        if self.values is None:
            return call(lib.lam_scene_add_light, scene, self.struct)
        text_bytes("Light", self.values["type"])
        first, *rest = ["%s=%s" % (key, written(value)) if key != "type" else value for key, value in self.values.items()]
        text = first + (":" if ":" not in first and rest else "," if rest else "") + ",".join(rest)
        return call(lib.lam_scene_add_light_text, scene, text_bytes("Light", text), params)

    @property
    def type(self) -> str:
        """ambient, hemisphere, point, directional or spot."""
        return text_of(lib.lam_light_type_describe(self.struct.type).word)

    def _row(self, field):
        for row in field.rows:
            if row.light_types >> self.struct.type & 1:
                return row
        raise AttributeError("a light of the type %s has no %s" % (self.type, field.key))

    def _store(self, row, key, value):
        if self.values is not None:
            return self._parse({**self.values, key: value})
        numbers = [float(number) for number in written(value).split("/")] if not isinstance(value, str) and not isinstance(value, bool) else [value]
        if row.type in (lib.LAM_FIELD_RGB, lib.LAM_FIELD_RGBA):
            numbers = color(key, value)
        changed = ffi.new("lam_light *", self.struct[0])
        lib.lam_field_set(row, changed, [math.radians(number) if row.type == lib.LAM_FIELD_ANGLE else number for number in numbers][:4])
        call(lib.lam_light_check, changed)
        self.struct[0] = changed[0]


def views(wanted) -> "list[dict[str, float]]":
    """Directions as keyword arguments of `render`: for 24 (evenly distributed on a sphere), "ring:8@30", or "front,left"."""
    view, text = ffi.new("lam_view *"), text_bytes("views", str(wanted))
    count = call(lib.lam_views_parse, text, -1, ffi.NULL, ffi.NULL)
    return [{name: math.degrees(getattr(view, name + "_rad")) for name in ("azimuth", "elevation")}
            for index in range(count) if lib.lam_views_parse(text, index, view, ffi.NULL, ffi.NULL) > 0]


class Part:
    """An attribute of a camera: a key of lam_camera_parse, and the member of lam_camera that it sets."""

    def __init__(self, key):
        self.key, self.member = key, next(name for name, _ in ffi.typeof("lam_camera").fields if name.startswith(key))
        self.type = "Numbers" if dict(ffi.typeof("lam_camera").fields)[self.member].type.kind == "struct" else "float"
        self.__doc__ = MEMBERS["lam_camera"][self.member]

    def __get__(self, owner, cls=None):
        if owner is None:
            return self
        value = getattr(owner.struct, self.member)
        if self.member in ("cx", "cy") and owner.struct.fx > 0:
            return value - 0.5 # the convention of OpenCV
        if self.type == "Numbers":
            return value.x, value.y, value.z
        return math.degrees(value) if self.member.endswith("_rad") else value

    def _is_standard(self, owner):
        return not self.__get__(owner)

    def __set__(self, owner, value):
        known = owner.values if owner.values is not None else {key: getattr(owner, key) for key in owner._keys() if getattr(owner, key)}
        lenses = [{"ortho"}, {"fovy"}, {"fx", "fy", "cx", "cy"}] # a camera has one of these
        other = set().union(*(keys for keys in lenses if self.key not in keys)) if any(self.key in keys for keys in lenses) else set()
        owner._parse({**{key: value for key, value in known.items() if key not in other}, self.key: value})


class Camera(type("Parts", (Described,), {key: Part(key) for key in every(lib.lam_camera_key) if key not in ("K", "pose", "convention")})):
    """A camera: `Camera(eye=(2, 1, 4), fovy=40)`. Without a target it looks at the middle of the scene; `Picture.camera` is the camera of a
    picture.

    `Camera(K=K, pose=pose)` is a calibrated camera: K is the 3×3 matrix of fx, fy, cx and cy in pixels, pose the 4×4 matrix from the camera to the
    world. `convention` is "opencv" (x to the right, y down, z forward; cx and cy from the first pixel's centre) or "opengl" (y up, z backward; cx and
    cy from the picture's corner)."""

    def __init__(self, eye=None, **parts):
        self.struct, self.values, self.size = ffi.new("lam_camera *"), None, None
        if isinstance(eye, ffi.CData):
            self.struct[0] = eye
        else:
            self._parse({**({} if eye is None and "pose" in parts else {"eye": (0, 0, 4) if eye is None else eye}),
                         **{key: np.ravel(value) if key in ("K", "pose") else value for key, value in parts.items()}})

    @property
    def K(self) -> "Array | None":
        """The 3×3 matrix of fx, fy, cx and cy, as OpenCV defines them. None for parallel projection, and for a camera with `fovy` that has drawn no
        picture yet."""
        numbers, size = ffi.new("double[4]"), self.size or (1, 1)
        if not (self.size or self.struct.fx > 0) or not lib.lam_camera_intrinsics(self.struct, *size, lib.LAM_CONVENTION_OPENCV, numbers):
            return None
        return np.array([[numbers[0], 0, numbers[2]], [0, numbers[1], numbers[3]], [0, 0, 1]])

    @property
    def pose(self) -> "Array":
        """The 4×4 matrix from the camera to the world, with the axes of OpenCV: x to the right, y down, z forward."""
        found = lib.lam_camera_pose(self.struct, lib.LAM_CONVENTION_OPENCV)
        return np.array([list(row) for row in found.m])

    def _parse(self, values):
        self.struct[0] = self._text_in(ffi.NULL, values)[0]
        self.values = values

    @staticmethod
    def _text_in(scene, values):
        found, text = ffi.new("lam_camera *"), ",".join("%s=%s" % (key, written(value)) for key, value in values.items())
        call(lib.lam_camera_parse, text_bytes("Camera", text), scene, found)
        return found

    def _in_scene(self, scene):
        """The lam_camera for a lam_scene, whose middle is the default target."""
        return self.struct if self.values is None else self._text_in(scene, self.values)
