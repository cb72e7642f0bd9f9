"""_object.py: the objects of a scene, and the surface under a pixel."""
import numpy as np

from ._core import BadValue, call, matrix_of, shown, text_bytes, text_of
from ._native import ffi, lib


class Object:
    """An object of a scene (`Scene.objects`): it places a mesh. Assign to `name`, `transform`, `material` and `hidden` to change the scene."""

    def __init__(self, scene, index):
        self._scene, self._index, self._order = scene, index, scene._order

    def __repr__(self):
        return "Object(%r, %d triangles)" % (self.name or "", len(self.faces))

    def _item(self):
        if self._order != self._scene._order:
            raise BadValue("objects: this object was read before objects were removed or split; read scene.objects again")
        return lib.lam_scene_object(self._scene._handle, self._index)

    def _mesh(self):
        return lib.lam_scene_mesh(self._scene._handle, self._item().mesh)

    @property
    def name(self) -> "str | None":
        """The name, or None."""
        return text_of(self._item().name)

    @name.setter
    def name(self, value: "str"):
        text_bytes("name", value)
        self._change("name", value)

    @property
    def transform(self) -> "Array":
        """The 4×4 matrix from the mesh to the world, for column vectors."""
        return np.array([list(row) for row in self._item().transform.m])

    @transform.setter
    def transform(self, value: "Array"):
        self._change("transform", matrix_of("transform", value).tolist())

    @property
    def material(self) -> "int | None":
        """The number of the material in `Scene.materials`. None: the materials of the mesh's parts."""
        number = self._item().material
        return None if number < 0 else number

    @material.setter
    def material(self, value: "int | None"):
        count = lib.lam_scene_material_count(self._scene._handle)
        if value is not None and not (isinstance(value, (int, np.integer)) and 0 <= value < count):
            raise BadValue("material: found %s, expected None or a number from 0 to %d" % (shown(value), count - 1))
        self._change("material", -1 if value is None else int(value))

    @property
    def hidden(self) -> bool:
        """Whether pictures omit the object."""
        return self._item().hidden

    @hidden.setter
    def hidden(self, value: bool):
        self._change("hidden", bool(value))

    @property
    def vertices(self) -> "Array":
        """The positions of the mesh, n×3, before `transform`."""
        mesh = self._mesh()
        return self._rows(mesh.positions, mesh.vertex_count, 3, np.float32) + np.array(list(mesh.origin))

    @property
    def faces(self) -> "Array":
        """The triangles of the mesh, m×3: numbers of vertices."""
        mesh = self._mesh()
        if mesh.indices == ffi.NULL:  # triangles of consecutive vertices
            return np.arange(3 * mesh.triangle_count, dtype=np.uint32).reshape(-1, 3)
        return self._rows(mesh.indices, mesh.triangle_count, 3, np.uint32)

    @staticmethod
    def _rows(pointer, count, columns, kind):
        """A copy of an array of the library."""
        if not count or pointer == ffi.NULL:
            return np.zeros((0, columns), kind)
        return np.frombuffer(ffi.buffer(pointer, count * columns * 4), kind).reshape(-1, columns).copy()

    def _change(self, key, value):
        self._item()
        self._scene._change_object(self._index, key, value)

    def remove(self) -> None:
        """Removes the object from its scene. Objects that were read before are then out of date."""
        self._item()
        self._scene._remove_object(self._index)


class Picked:
    """The surface under a pixel (`Scene.pick`).

    object    the Object
    triangle  the number of the triangle in the mesh
    position  three numbers, in world space
    distance  from the eye, in model units
    back      whether the triangle's back is visible
    """

    def __init__(self, scene, found):
        self.object, self.triangle, self.back = Object(scene, found.object), found.triangle, bool(found.back)
        self.position, self.distance = (found.position.x, found.position.y, found.position.z), found.distance

    def __repr__(self):
        return "Picked(%r, triangle=%d, position=%s)" % (self.object.name or "", self.triangle, "(%.6g, %.6g, %.6g)" % self.position)
