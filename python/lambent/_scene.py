"""_scene.py: scenes, and the call that turns a model into a picture."""
import base64
import copy
import functools
import html
import json
import math
import os
import pathlib
import sys

import numpy as np

from ._core import Access, BadModel, BadValue, OutOfMemory, Unsupported, call, every, matrix_of, path_bytes, run, shown, text_bytes, text_of
from ._fields import Camera, Light, Material, as_material, choose, color, words_of, written
from ._mesh import meshes_of
from ._native import ffi, lib
from ._object import Object, Picked
from ._options import CHANGES, KEYWORDS, OTHERS, STRUCTS, Options, describe_keywords
from ._picture import Picture


def pair_of(size):
    """Width and height in pixels, from one number or two."""
    pair = list(size) if hasattr(size, "__iter__") else [size] * 2
    if len(pair) != 2 or not all(isinstance(side, (int, np.integer)) and 1 <= side <= 65535 for side in pair):
        raise BadValue("size: found %s, expected one or two whole numbers from 1 to 65535" % shown(size))
    return int(pair[0]), int(pair[1])


AXES = {"x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1)}


def listed(value):
    """The texts of a keyword that takes one or several."""
    return list(value) if isinstance(value, (list, tuple)) else [value]


def turns_of(options):
    """The rotations of the keyword `rotate`: pairs of an axis and degrees."""
    turns = [str(text).partition(":") for text in listed(options.get("rotate", []))]
    for axis, colon, _ in turns:
        if axis not in AXES or not colon:
            raise BadValue("rotate: found %s, expected an axis and degrees, such as y:30" % shown(options.get("rotate")))
    return [(axis, degrees) for axis, _, degrees in turns]


def angle_of(what, degrees):
    """An angle in radians."""
    try:
        found = math.radians(float(degrees))
    except (TypeError, ValueError, OverflowError):
        found = math.nan
    if not math.isfinite(found):
        raise BadValue("%s: found %s, expected an angle in degrees" % (what, shown(degrees)))
    return found


def step(method):
    """Records the calls of a method that changes a scene, so that a copy of the scene can repeat them."""
    @functools.wraps(method)
    def recorded(self, *args, **options):
        outer, kept = self._steps, None
        if outer is not None:
            kept = copy.deepcopy((args, {name: value for name, value in options.items() if not name.startswith("_")}))
        self._steps = None  # the methods that this one calls are part of it
        try:
            result = method(self, *args, **options)
        finally:
            self._steps = outer
        if outer is not None:
            outer.append((method.__name__, *kept))
        return result
    return recorded


def repeated(steps):
    """A scene that was made by these calls."""
    scene = Scene()
    for name, args, options in steps:
        scene = load(*args, **options) if name == "load" else scene
        if name != "load":
            getattr(scene, name)(*args, **options)
    return scene


class Scene:
    """Meshes, materials, objects and lights together; `Scene()` is empty, and `lambent.load(path)` reads a file.

    While no thread changes it, any number of threads may draw it."""

    def __init__(self, _handle=None):
        self._handle = ffi.gc(_handle or call(lib.lam_scene_make), lib.lam_scene_free)
        self._access, self._path = Access(), None
        self._steps, self._order = [], 0  # the calls that made the scene; how often its objects were renumbered

    def __reduce__(self):
        return repeated, (self._steps,)

    def __repr__(self):
        file = ", %r" % os.path.basename(self._path) if self._path else ""
        return "Scene(%d objects, %d triangles%s)" % (lib.lam_scene_object_count(self._handle), self.triangles, file)

    @step
    def add(self, model: "Model", material: "Material | str | None" = None, transform: "Array | None" = None, name: "str | None" = None) -> "Scene":
        """Adds an object: a Mesh or an object of meshio, trimesh …, arrays (vertices, faces), the name of a built-in shape, or the path of a model file,
        whose objects keep their materials and names; the first file also sets the up axis. `transform` is a 4×4 matrix for column vectors. Returns the scene."""
        if isinstance(model, (str, os.PathLike)) and lib.lam_shape_find(path_bytes(model)) < 0:
            if material is not None or name is not None:
                raise BadValue("Scene.add: a file keeps its own materials and names")
            other = call(lib.lam_scene_load, path_bytes(model), ffi.NULL, ffi.NULL, path=os.fspath(model))
            if transform is not None:
                call(lib.lam_scene_transform, other, ffi.new("lam_mat4 *", {"m": matrix_of("transform", transform).tolist()}))
            if not lib.lam_scene_object_count(self._handle):
                lib.lam_scene_set_up(self._handle, lib.lam_scene_up(other))
            call(lib.lam_scene_add_scene, self._handle, other)
            return self
        meshes = [(model, None)] if isinstance(model, str) else meshes_of(model)
        placed = np.eye(4) if transform is None else matrix_of("transform", transform)
        if meshes is None:
            raise BadValue("Scene.add: found %s, expected a Mesh, an object with vertices and faces, arrays, or a shape's name" % type(model).__name__)
        for mesh, own in meshes:
            item = ffi.new("lam_object *", lib.lam_object_default())
            used = material if material is not None else getattr(mesh, "material", None)
            used = as_material("material", used)
            item.mesh = call(lib.lam_scene_add_shape, self._handle, text_bytes("shape", mesh), ffi.NULL) if isinstance(mesh, str) else mesh._add_to(self._handle)
            if used is not None:
                item.material = call(lib.lam_scene_add_material, self._handle, used.struct)
            item.transform.m = (placed if own is None else placed @ np.asarray(own, float)).tolist()
            label = ffi.new("char[]", text_bytes("name", next((text for text in (name, getattr(mesh, "name", None)) if text is not None), mesh if isinstance(mesh, str) else "")))
            item.name = label
            call(lib.lam_scene_add_object, self._handle, item)
        return self

    @property
    def materials(self) -> "list[Material]":
        """Copies of the materials; `set_material` changes one."""
        return [self._copy(Material, lib.lam_scene_material, index) for index in range(lib.lam_scene_material_count(self._handle))]

    def _copy(self, cls, item, index):
        """A copy of an item; its names and maps belong to the scene, which is kept alive."""
        made = cls(item(self._handle, index)[0])
        made.kept.append(self._handle)
        return made

    @step
    def set_material(self, material: "Material | str", index: "int | None" = None, _mode=lib.LAM_COLOR_SRGB) -> None:
        """Replaces the material with this number. None means all materials, and the default material of surfaces without one; a string such as
        "shininess=9" changes them."""
        count = lib.lam_scene_material_count(self._handle)
        if index is not None and not (isinstance(index, (int, np.integer)) and 0 <= index < count):
            raise BadValue("set_material: found the number %s, expected 0 to %d" % (shown(index), count - 1))
        indices = range(count) if index is None else [index]
        for at in indices:
            old = lib.lam_scene_material(self._handle, at)
            call(lib.lam_scene_set_material, self._handle, at, changed(old, material, _mode))
        if index is None:
            call(lib.lam_scene_set_default_material, self._handle, changed(lib.lam_scene_default_material(self._handle), material, _mode))

    @property
    def lights(self) -> "list[Light]":
        """Copies of the lights. Assign a list to replace them: a list of Light objects or of strings as for the program's option --light."""
        return [self._copy(Light, lib.lam_scene_light, index) for index in range(lib.lam_scene_light_count(self._handle))]

    @lights.setter
    def lights(self, lights: "Light | str | Sequence[Light | str]"):
        self._set_lights(lights)

    @step
    def _set_lights(self, lights):
        self._light(lights)

    def _light(self, lights, camera=ffi.NULL, mode=lib.LAM_COLOR_SRGB):
        found = [lights] if isinstance(lights, (str, Light)) or not hasattr(lights, "__iter__") else lights
        made = [light if isinstance(light, Light) else Light(light) for light in found]
        lib.lam_scene_clear_lights(self._handle)
        for light in made:
            light._add_to(self._handle, ffi.new("lam_light_text_params *", {"camera": camera, "color": mode}))

    @property
    def ambient(self) -> "tuple[float, float, float]":
        """Light from everywhere, in addition to the lights: a linear colour, default 0."""
        found = lib.lam_scene_ambient(self._handle)
        return found.r, found.g, found.b

    @ambient.setter
    def ambient(self, value: "Color"):
        self._set_ambient(value)

    @step
    def _set_ambient(self, value):
        lib.lam_scene_set_ambient(self._handle, color("ambient", value)[:3])

    @property
    def up(self) -> str:
        """The up axis: "x", "y", "z", "-x", "-y" or "-z". It rotates the view, not the coordinates."""
        return text_of(lib.lam_up_name(lib.lam_scene_up(self._handle)))

    @up.setter
    def up(self, value: str):
        self._set_up(value)

    @step
    def _set_up(self, value):
        lib.lam_scene_set_up(self._handle, choose("up", words_of("lam_up"), value))

    @step
    def set_environment(self, name: str, rotation: float = 0.0, _control=ffi.NULL, _mode=lib.LAM_COLOR_SRGB) -> None:
        """Lights the scene with a built-in environment ("studio", "soft", "outdoor", "night", "cyclorama", "sky") or with a picture (2:1 or a cross), turned by degrees about the up axis."""
        self._surround(lib.lam_scene_set_environment, name, rotation, _control, _mode)

    @step
    def set_reflection_map(self, name: str, rotation: float = 0.0, _control=ffi.NULL, _mode=lib.LAM_COLOR_SRGB) -> None:
        """Sets an environment that classic materials only reflect, by their reflectivity; it replaces the one of set_environment."""
        self._surround(lib.lam_scene_set_reflection_map, name, rotation, _control, _mode)

    def _surround(self, setter, name, rotation, control, mode):
        angle = angle_of("rotation", rotation)
        if isinstance(name, str) and name in every(lib.lam_environment_built_in_name):
            made = call(lib.lam_environment_built_in, name.encode())
        else:
            made = call(lib.lam_environment_load, path_bytes(name), mode, control, path=name)
        try:
            call(setter, self._handle, made, angle)
        finally:
            lib.lam_environment_free(made)

    @step
    def set_sections(self, *sections: str, _mode=lib.LAM_COLOR_SRGB) -> "list[float]":
        """Cuts the scene by planes such as "x=0" and "z=40%,color=orange", in place of earlier ones; without planes, the scene is whole again. Returns the
        area of each cut surface."""
        made = ffi.new("lam_section[]", len(sections) + 1)
        for index, text in enumerate(sections):
            call(lib.lam_section_parse, text_bytes("section", text), _mode, made + index)
        call(lib.lam_scene_set_sections, self._handle, made, len(sections), ffi.NULL)
        return [lib.lam_scene_section_area(self._handle, index) for index in range(len(sections))]

    @step
    def hide(self, *names: str) -> "Scene":
        """Hides the objects, parts and materials with these names. Returns the scene."""
        return self._show(names, True)

    @step
    def only(self, *names: str) -> "Scene":
        """Hides all but the objects, parts and materials with these names. Returns the scene."""
        return self._show(names, False)

    def _show(self, names, hides):
        call(lib.lam_scene_split_parts, self._handle)
        self._order += 1
        known, found = {}, set()
        for index in range(lib.lam_scene_object_count(self._handle)):
            item = lib.lam_scene_object(self._handle, index)
            mesh = lib.lam_scene_mesh(self._handle, item.mesh)
            number = item.material if item.material >= 0 or not mesh.part_count else mesh.parts[0].material
            material = lib.lam_scene_material(self._handle, number) if number >= 0 else None
            known[index] = {text_of(item.name), text_of(material.name) if material else None} - {None, ""}
        for name in map(str, names):
            if not any(name in own for own in known.values()):
                all_names = sorted(set().union(*known.values())) if known else []
                raise BadValue("%s: found %s, expected the name of an object, a part or a material: %s" % (
                    "hide" if hides else "only", shown(name), ", ".join(all_names[:8]) + ", …" * (len(all_names) > 8) or "the model has no names"))
            found |= {index for index, own in known.items() if name in own}
        for index in known:
            if (index in found) == hides:
                call(lib.lam_scene_hide_object, self._handle, index, True)
        return self

    @step
    def rotate(self, axis: str, degrees: float) -> "Scene":
        """Turns all objects about an axis ("x", "y" or "z") through the centre of the scene's sphere. Returns the scene."""
        return self._rotate(self._sphere(), axis, degrees)

    def _rotate(self, centre, axis, degrees):
        call(lib.lam_scene_rotate, self._handle, centre, choose("axis", AXES, axis), angle_of("rotate", degrees))
        return self

    def _sphere(self):
        centre, radius = ffi.new("lam_vec3 *"), ffi.new("double *")
        lib.lam_scene_sphere(self._handle, -1, centre, radius)
        return centre[0]

    @property
    def objects(self) -> "list[Object]":
        """The objects: their names, meshes, places and materials, which you can change."""
        return [Object(self, index) for index in range(lib.lam_scene_object_count(self._handle))]

    @step
    def _change_object(self, index, key, value):
        item = ffi.new("lam_object *", lib.lam_scene_object(self._handle, index)[0])
        label = ffi.new("char[]", value.encode()) if key == "name" else None
        if key == "transform":
            item.transform.m = value
        else:
            setattr(item, key, label if key == "name" else value)
        with self._access.alone():
            call(lib.lam_scene_set_object, self._handle, index, item)

    @step
    def _remove_object(self, index):
        with self._access.alone():
            call(lib.lam_scene_remove_object, self._handle, index)
        self._order += 1

    def pick(self, x: int, y: int, size: "int | tuple[int, int]" = 1024, **options) -> "Picked | None":
        """The surface under pixel x, y of the picture that `render(size, …)` draws, with the keywords of `render` that place the camera. None: the
        background."""
        chosen, (width, height) = Options(options, STRUCTS, OTHERS), pair_of(size)
        settings, params = settings_of(self, chosen)
        found = ffi.new("lam_picked *")
        camera = camera_of(self, chosen, settings, params, (width, height))
        with self._access.shared():
            call(lib.lam_pick, self._handle, camera, params, ffi.new("lam_pick_pixel *", {"width": width, "height": height, "x": x, "y": y}), chosen.control, found)
        return None if found.object < 0 else Picked(self, found)

    def save(self, path: "str | os.PathLike[str]") -> "tuple[str, ...]":
        """Writes the scene as a model file, in the format of the extension: glb, obj, stl, ply or 3mf. An OBJ file comes with its materials and textures.
        Returns the sentences about data that the format does not support."""
        folder, name = os.path.split(os.path.abspath(os.fspath(path)))
        kept = ffi.new("char[]", path_bytes(name))
        made = ffi.gc(call(lib.lam_scene_export, self._handle, text_bytes("format", os.path.splitext(name)[1].lstrip(".").lower()),
                           ffi.new("lam_export_params *", {"name": kept})), lib.lam_export_free)
        files = list(every(lib.lam_export_file_name, made))
        for index in reversed(range(len(files))):  # the model last, so that it is never there without its files
            data = lib.lam_export_file(made, index)
            call(lib.lam_bytes_save, ffi.new("lam_bytes *", data), path_bytes(os.path.join(folder, files[index])))
        return tuple(every(lib.lam_export_loss, made))

    @property
    def bounds(self) -> "tuple[tuple[float, float, float], tuple[float, float, float]]":
        """Two corners of the box around the triangles, in world space."""
        low, high = ffi.new("lam_vec3 *"), ffi.new("lam_vec3 *")
        lib.lam_scene_bounds(self._handle, low, high)
        return (low.x, low.y, low.z), (high.x, high.y, high.z)

    @property
    def triangles(self) -> int:
        """The number of triangles of all objects."""
        return lib.lam_scene_triangle_count(self._handle)

    @property
    def warnings(self) -> "tuple[str, ...]":
        """Warnings about problems of the model."""
        return tuple(every(lib.lam_scene_warning, self._handle))

    def render(self, size=None, *, progress=None, **options):
        """Draws the scene without changing it. `rig` adds lights to the scene's own; "none" and "default" omit the scene's own. `size` and `progress`
        work as in `lambent.render`.

    Keyword arguments:
"""
        chosen, wanted = Options(options, STRUCTS, OTHERS), None if size is None else pair_of(size)
        return run(lambda task: draw(self, chosen, wanted, task), chosen.control, progress)

    def page(self) -> str:
        """Returns the interactive page with the model: one HTML file, as a string. `make web` builds the page and `make install` installs it;
        LAMBENT_PAGE sets its path. Raises Unsupported if the page is missing, if the scene was not loaded from a file, or if the scene uses files of
        other folders."""
        places = [os.environ.get("LAMBENT_PAGE"), *(prefix + "/share/lambent/lambent.html" for prefix in (sys.prefix, "/usr/local", "/usr"))]
        place = next((place for place in places if place and os.path.exists(place)), None)
        if not place or not self._path:
            raise Unsupported("page: %s" % ("the scene was not loaded from a file" if place else "lambent.html is not installed (docs/python.md)"))
        folder, inside = os.path.dirname(os.path.abspath(self._path)), ""
        for path in filter(os.path.isfile, every(lib.lam_scene_file, self._handle)):
            name = os.path.relpath(os.path.realpath(path), os.path.realpath(folder))
            if name.startswith(".."):
                raise Unsupported("page: %s lies outside of the folder of %s" % (path, self._path))
            inside += '<script type="text/plain" class="inside-file" data-path="/%s">%s</script>\n' % (
                html.escape(name), base64.b64encode(pathlib.Path(path).read_bytes()).decode())
        words = json.dumps(["/" + os.path.basename(self._path)]).replace("<", "\\u003c")
        before, end, after = pathlib.Path(place).read_text().rpartition("</body>")
        return '%s%s<script type="application/json" id="inside-words">%s</script>\n%s%s' % (before, inside, words, end, after)

    def _repr_html_(self):
        """The page in a frame of a notebook. Shows a picture if the page is not installed, or if the scene was not loaded from a file."""
        try:
            return '<iframe style="width: 100%%; height: 600px; border: 0" srcdoc="%s"></iframe>' % html.escape(self.page())
        except Unsupported:
            return '<img src="data:image/png;base64,%s">' % base64.b64encode(self.render(512).png()).decode()


def changed(old, material, mode):
    """A lam_material: another one, or the old one changed by a string."""
    if isinstance(material, Material):
        return material.struct
    made = ffi.new("lam_material *", old[0])
    call(lib.lam_material_parse, text_bytes("material", material), mode, made)
    return made


def unrecorded():
    """A scene that does not record the calls that change it."""
    scene = Scene()
    scene._steps = None
    return scene


def load_scene(model, options, name, task, once=False):
    """Returns a Scene for any kind of model."""
    path = os.fspath(model) if isinstance(model, (str, os.PathLike)) else None
    params = ffi.new("lam_load_params *", options.load[0])
    params.threads = options.get("threads", 0)
    params.models_anywhere = options.get("models_anywhere", True)
    params.override_color = "color_mode" in options
    params.polygon_edges |= bool(options.get("wireframe") or options.get("edges"))
    params.normals_when_drawn = once and not tangents_of(options.filled("lam_draw_params"))
    if path is not None and lib.lam_shape_find(path_bytes(path)) >= 0:
        scene = unrecorded().add(path)
    elif path is not None:
        scene = Scene(call(lib.lam_scene_load, path_bytes(path), params, task.control, path=path))
        scene._path = path
    elif isinstance(model, (bytes, bytearray, memoryview)):
        data = ffi.from_buffer(model)
        scene = Scene(call(lib.lam_scene_load_memory, data, len(data), path_bytes(name) if name is not None else ffi.NULL, params, task.control))
    else:
        scene = unrecorded().add(model)
    if scene._path is None and not isinstance(model, (bytes, bytearray, memoryview)): # the loader has already done this for files
        lib.lam_scene_set_up(scene._handle, options.load.up)
        if "normals" in options or "crease_angle" in options:
            call(lib.lam_scene_make_normals, scene._handle, params.normals, params.crease_angle_rad, params.threads, task.control)
    if not any(count(scene._handle) for count in (lib.lam_scene_triangle_count, lib.lam_scene_line_count, lib.lam_scene_point_count)):
        raise BadModel("%s: found no triangles, lines or points, expected at least one to draw" % (path or name or "the model"))
    return scene


def tangents_of(params):
    return lib.lam_reflection_describe(params.reflection).tangents


def settings_of(scene, options):
    """The settings of the scene file (zero for other models), and the drawing parameters from these settings and the keywords."""
    settings, params = ffi.new("lam_picture_settings *"), ffi.new("lam_draw_params *")
    lib.lam_scene_picture_settings(scene._handle, settings)
    params[0] = settings.draw
    if "shading" in options:
        params.stage = lib.LAM_STAGE_AUTO
    if "ground" in options:
        params.ground_color = (0, 0, 0)
    given = options.filled("lam_draw_params", params[0])
    if "stage" in options and "shading" not in options and given.stage in (lib.LAM_STAGE_APPLICATION, lib.LAM_STAGE_VERTEX):
        given.shading = lib.LAM_SHADING_GOURAUD
    return settings, given


def camera_of(scene, options, settings, params, size):
    """The camera of the keywords, of the scene file, or the fitted one."""
    wanted, handle = options.get("camera"), scene._handle
    if isinstance(wanted, str):
        found, number = ffi.new("lam_camera *"), lib.lam_scene_find_camera(handle, text_bytes("camera", wanted))
        call(lib.lam_camera_parse, text_bytes("camera", wanted), handle, found) if "=" in wanted else None
        if "=" not in wanted and not lib.lam_scene_camera(handle, number, found):
            raise BadValue("camera: found %s, expected keys such as eye=2/1/4, or a camera of the file, which has %d" % (shown(wanted), lib.lam_scene_camera_count(handle)))
        return found
    if wanted is not None and not isinstance(wanted, Camera):
        raise BadValue("camera: found %s, expected a Camera or a string" % shown(wanted))
    if wanted is not None:
        return wanted._in_scene(handle)
    views = [name for name, keyword in KEYWORDS.items() if keyword.struct == "lam_view"] + ["view"]
    if settings.present & lib.LAM_SETTING_CAMERA and not any(name in options for name in views):
        return ffi.new("lam_camera *", settings.camera)
    axes = {axis for axis, _ in turns_of(options)}
    axis = ffi.new("lam_vec3 *", AXES[axes.pop()] if len(axes) == 1 else (0, 0, 0)) if axes else ffi.NULL
    return ffi.new("lam_camera *", lib.lam_camera_fit_ground(handle, params, *size, options.view, scene._sphere() if axis else (0, 0, 0), axis))


def lit_by_file(scene, settings):
    """Whether the scene is lit by lights of a glTF file, in candela and lux."""
    kind = text_of(lib.lam_scene_format(scene._handle))
    return lib.lam_scene_light_count(scene._handle) > 0 and (kind == "gltf" or kind == "scene" and not settings.present & lib.LAM_SETTING_LIGHTS)


def change(scene, options, task, params):
    """Applies the keywords that change a scene loaded by this call, before the camera is placed."""
    if "material" in options:
        scene.set_material(options.get("material"), _mode=params.color)
    if "color" in options:
        wanted = options.get("color")
        if max(color("color", wanted, params.color)) > 1:
            raise BadValue("color: found %s, expected numbers from 0 to 1; a colour of numbers from 0 to 255 is written '#rrggbb'" % shown(wanted))
        scene.set_material("color=" + written(wanted), _mode=params.color)
    if "hide" in options:
        scene.hide(*listed(options.get("hide")))
    if "only" in options:
        scene.only(*listed(options.get("only")))
    if "rig" in options and (params.rig > lib.LAM_RIG_NONE or options.no_lights) or "light" in options:
        lib.lam_scene_clear_lights(scene._handle)
    if "light" in options and "rig" not in options:
        params.rig = lib.LAM_RIG_NONE
    for name, setter in (("environment", scene.set_environment), ("reflection_map", scene.set_reflection_map)):
        if name in options:
            setter(options.get(name), options.get("environment_rotation", 0), _control=task.control, _mode=params.color)
    if "rig" not in options:
        call(lib.lam_scene_mirror_metals, scene._handle, params)


def place_rig(scene, params, task):
    """Adds the rig's lights to the scene before the model turns, so that they stay in place."""
    handle, lights = scene._handle, ffi.new("lam_light[]", lib.LAM_RIG_LIGHTS_MAX)
    count = lib.lam_scene_rig_lights(handle, params.rig, params.ground != lib.LAM_GROUND_NONE, lights)
    own = lib.lam_scene_light_count(handle) > 0 or lib.lam_scene_environment(handle) != ffi.NULL
    if params.rig == lib.LAM_RIG_AUTO and not own and not lib.lam_scene_rig_lights(handle, params.rig, False, lights):
        scene.set_environment("studio", _control=task.control)
    params.tone = lib.lam_draw_tone(handle, params)
    for light in lights[0:count]:
        call(lib.lam_scene_add_light, handle, ffi.new("lam_light *", light))
    params.rig = lib.LAM_RIG_NONE


def draw(scene, options, size, task, changes=False):
    """The picture of a scene, as `lambent MODEL` draws it."""
    if changes or not options.no_lights:
        return draw_lit(scene, options, size, task, changes)
    with scene._access.alone(): # this picture does not use the scene's own lights
        kept = [ffi.new("lam_light *", lib.lam_scene_light(scene._handle, index)[0]) for index in range(lib.lam_scene_light_count(scene._handle))]
        lib.lam_scene_clear_lights(scene._handle)
        try:
            return draw_lit(scene, options, size, task, changes)
        finally:
            for light in kept:
                call(lib.lam_scene_add_light, scene._handle, light)


def draw_lit(scene, options, size, task, changes):
    """Draws the picture of a scene with its current lights."""
    handle = scene._handle
    settings, params = settings_of(scene, options)
    by_file = lit_by_file(scene, settings) and "light" not in options
    if changes:
        change(scene, options, task, params)
        by_file = by_file and lib.lam_scene_light_count(handle) > 0
    model = lib.lam_reflection_describe(params.reflection)
    if params.rig == lib.LAM_RIG_AUTO and params.reflection and not model.microfacet and lib.lam_scene_light_count(handle) == 0:
        params.rig = lib.LAM_RIG_STUDIO
    if changes and "rotate" in options and params.rig != lib.LAM_RIG_NONE:
        place_rig(scene, params, task)
    if size is None:
        size = (settings.width, settings.height) if settings.present & lib.LAM_SETTING_SIZE else (lib.LAM_RENDER_SIZE,) * 2
    if model.tangents:
        with scene._access.alone():
            call(lib.lam_scene_make_tangents, handle, task.control)
    camera = camera_of(scene, options, settings, params, size)
    centre = scene._sphere()
    for axis, degrees in turns_of(options):
        scene._rotate(centre, axis, degrees)
    if "section" in options:
        scene.set_sections(*listed(options.get("section")), _mode=params.color)
    if changes and "light" in options:
        scene._light(options.get("light"), camera, params.color)
    if changes and "ambient" in options:
        lib.lam_scene_set_ambient(handle, color("ambient", options.get("ambient"), params.color)[:3])
    fitted = by_file and "exposure" not in options and not options.fit_exposure and not settings.present & lib.LAM_SETTING_EXPOSURE
    fitted = fitted and lib.lam_output_is_light(params.output)
    with scene._access.alone() if fitted else scene._access.shared(): # a dim studio may be added to a file's lights for this picture
        return paint(scene, options, camera, params, size, task, fitted)


def paint(scene, options, camera, params, size, task, fitted):
    """Draws the picture that `draw` has prepared. `fitted` means that the lights come from a file, in its units."""
    handle, light, lights = scene._handle, lib.lam_output_is_light(params.output), []
    device = ffi.gc(call(lib.lam_device_cpu, ffi.new("lam_cpu_params *", {"threads": options.get("threads", 0)})), lib.lam_device_free)
    floats = options.get("floats", False)
    needed = size[0] * size[1] * (16 if floats else 4)
    if needed > (options.control.memory_limit_bytes or lib.lam_memory_available()):
        raise OutOfMemory("size: a picture of %dx%d pixels needs %.1f MB, more than the memory limit or the machine's memory" % (*size, needed / 1e6))
    picture = np.empty((size[1], size[0], 4), np.float32 if floats else np.uint8).view(Picture)
    image = ffi.new("lam_image *", {"width": size[0], "height": size[1], "format": lib.LAM_RGBA32F if floats else lib.LAM_RGBA8,
                                    "pixels": ffi.from_buffer(picture, require_writable=True)})
    if fitted or options.fit_exposure and light:
        params.light_cutoff, params.exposure, number = params.light_cutoff or -1, 0, ffi.new("double *")
        call(lib.lam_exposure_fit, device, handle, camera, params, *size, task.control, number)
        params.exposure = number[0]
    try:
        if fitted and options.get("rig", "auto") == "auto":
            before = [ffi.new("lam_light *", lib.lam_scene_light(handle, index)[0]) for index in range(lib.lam_scene_light_count(handle))]
            call(lib.lam_studio_fill, device, handle, camera, params, *size, task.control, number)
            lights = before if number[0] > 0 else []
        call(lib.lam_draw, device, handle, camera, params, image, task.control)
    finally:
        if lights: # as before the fill light
            call(lib.lam_scene_set_environment, handle, ffi.NULL, 0)
        for index, old in enumerate(lights):
            call(lib.lam_scene_set_light, handle, index, old)
    comment = ffi.new("char[]", lib.LAM_COMMENT_SIZE)
    lib.lam_device_comment(device, comment)
    picture.comment = ffi.string(comment).decode()
    picture.raw = bool(params.color == lib.LAM_COLOR_RAW or not light and params.output != lib.LAM_OUTPUT_BASE_COLOR)
    picture.camera, picture.warnings = Camera(camera[0]), scene.warnings
    picture.camera.size = size
    picture.flags.writeable = False
    return picture


def load(model, *, name=None, progress=None, **options):
    """Reads a model into a Scene; `model`, `name` and `progress` work as in `render`.

    Keyword arguments:
"""
    chosen = Options(options, {"lam_load_params", "lam_control"})
    scene = run(lambda task: load_scene(model, chosen, name, task), chosen.control, progress)
    kept = os.path.abspath(model) if scene._path else copy.deepcopy(bytes(model) if isinstance(model, (bytearray, memoryview)) else model)
    scene._steps = [("load", (kept,), {"name": name, **options})]
    return scene


def render(model, size=None, *, name=None, progress=None, **options):
    """Turns a model into a Picture, the one that `lambent MODEL` draws.

    model     the path of a model or scene file, the name of a built-in shape, the bytes of a file, a Scene, a Mesh, arrays (vertices, faces), or an
              object with vertices and faces, such as the meshes of trimesh, meshio and Open3D
    size      pixels: one number or (width, height); None: the size in a scene file, or 1024
    name      of bytes: stands for the file in errors, and its ending helps to find the format
    progress  is called with the share done, 0 to 1, and the name of the step; if it returns False, the call raises Cancelled

    Raises Error: BadValue, FileNotFound, BadModel, Unsupported, LimitReached (OutOfMemory, TimeLimit), Cancelled. Other threads run meanwhile, and
    Ctrl-C stops the call.

    Keyword arguments; None is the default:
"""
    if isinstance(model, Scene):
        return model.render(size, progress=progress, **options)
    chosen, wanted = Options(options, None, {**OTHERS, **CHANGES}), None if size is None else pair_of(size)
    return run(lambda task: draw(load_scene(model, chosen, name, task, once=True), chosen, wanted, task, changes=True), chosen.control, progress)


render.__doc__ += describe_keywords((OTHERS, CHANGES))
load.__doc__ += describe_keywords((), {"lam_load_params", "lam_control"})
Scene.render.__doc__ += describe_keywords((OTHERS,), STRUCTS)
