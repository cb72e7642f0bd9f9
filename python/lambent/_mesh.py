"""_mesh.py: meshes from NumPy arrays, and from objects of meshio, trimesh, Open3D and the like."""
import numpy as np

from ._core import BadValue, call, text_bytes
from ._fields import Material, as_material
from ._native import ffi, lib


def array_of(what, values, columns, kind=np.float32):
    """An array of rows with this number of columns."""
    expected = "n x %s numbers" % (" or ".join(map(str, columns)) if isinstance(columns, tuple) else "2 or more")
    try:
        found = np.asarray(values)
    except ValueError:
        raise BadValue("%s: found rows of different lengths, expected %s" % (what, expected)) from None
    if found.ndim < 3 and found.size == 0:
        found = np.zeros((0, columns[0]), kind)
    if found.ndim != 2 or found.shape[1] not in columns or found.dtype.kind not in "iuf":
        raise BadValue("%s: found an array of the shape %s and the type %s, expected %s" % (
            what, "x".join(map(str, found.shape)) or "()", found.dtype, expected))
    if kind == np.uint32 and found.size and (found.dtype.kind == "f" or found.min() < 0 or found.max() > 0xffffffff):
        raise BadValue("%s: found %s to %s, expected whole numbers from 0" % (what, found.min(), found.max()))
    return found if kind is None else np.ascontiguousarray(found, dtype=kind)


class Mesh:
    """Triangles, polygons, lines or points from arrays, which are copied when the mesh is added to a scene.

    vertices   n×3 positions in model units
    faces      m×3 indices of triangles, m×4 or more of convex polygons, m×2 of lines; None: the vertices are points
    normals    n×3; None: smooth ones, creased at 40 degrees
    texcoords  n×2, (0, 0) at the lower left corner of the picture
    colors     n×3 or n×4, or one row for each face: 0 to 255 (whole numbers, sRGB) or 0 to 1 (floats, linear)
    material   a Material or its words
    """

    def __init__(self, vertices: "Array", faces: "Array | None" = None, *, normals: "Array | None" = None, texcoords: "Array | None" = None,
                 colors: "Array | None" = None, material: "Material | str | None" = None, name: "str | None" = None):
        vertices = np.asarray(array_of("vertices", vertices, (3,), None))
        self.origin = np.zeros(3)
        if vertices.dtype == np.float64 and vertices.ndim == 2 and vertices.size:
            low, high = vertices.min(axis=0), vertices.max(axis=0)
            if np.abs(vertices).max() > 16 * (high - low).max() > 0: # floats would lose precision
                self.origin = (low + high) / 2
                vertices = vertices - self.origin
        self.vertices = array_of("vertices", vertices, (3,))
        self.faces, self.inner, per_face = None, None, 0
        if faces is not None:
            faces = array_of("faces", faces, range(2, 1 << 16), None)
            columns = faces.shape[1]
            polygons, per_face = array_of("faces", faces, (max(columns, 2),), np.uint32), len(faces)
            self.faces = polygons
            if columns > 3: # fans; wireframes omit their inner edges
                self.faces = np.concatenate([polygons[:, [0, k, k + 1]] for k in range(1, columns - 1)], axis=1).reshape(-1, 3)
                edges = [(1 if k > 1 else 0) | (4 if k < columns - 2 else 0) for k in range(1, columns - 1)]
                self.inner = np.tile(np.array(edges, np.uint8), per_face)
        self.normals = None if normals is None else array_of("normals", normals, (3,))
        self.texcoords = None if texcoords is None else array_of("texcoords", texcoords, (2,))
        self.colors, self.by_face = None, False
        if colors is not None:
            colors = array_of("colors", colors, (3, 4), None)
            whole = colors.dtype.kind in "iu"
            rows = array_of("colors", colors, (3, 4), np.uint8 if whole else np.float32)
            opaque = np.full((len(rows), 4), 255 if whole else 1, rows.dtype)
            opaque[:, :rows.shape[1]] = rows
            self.by_face = len(rows) == per_face and len(rows) != len(self.vertices)
            self.colors = np.repeat(opaque, columns - 2, axis=0) if self.by_face and columns > 3 else opaque
        self.material, self.name = as_material("material", material), None if name is None else text_bytes("name", name).decode()

    def _add_to(self, scene):
        """Adds the mesh to a lam_scene and returns its number."""
        kept = [ffi.new("char[]", self.name.encode())] if self.name else []
        mesh = ffi.new("lam_mesh *", {"name": kept[0] if kept else ffi.NULL, "origin": list(self.origin)})
        rows = (("positions", "vertex_count", self.vertices, "float *"), ("normals", "normal_count", self.normals, "float *"),
                ("texcoords", "texcoord_count", self.texcoords, "float *"), ("colors", "color_count", self.colors, "void *"),
                ("inner_edges", None, self.inner, "uint8_t *"), ("indices", None, self.faces, "uint32_t *"))
        for member, count, values, kind in rows:
            if values is not None:
                kept.append(ffi.from_buffer(values))
                setattr(mesh, member, ffi.cast(kind, kept[-1]))
                if count:
                    setattr(mesh, count, len(values))
        lines = self.faces is not None and self.faces.shape[1] == 2
        setattr(mesh, "point_count" if self.faces is None else "line_count" if lines else "triangle_count",
                len(self.vertices if self.faces is None else self.faces))
        if self.colors is not None:
            mesh.colors_format = lib.LAM_COLORS_SRGB8 if self.colors.dtype == np.uint8 else lib.LAM_COLORS_LINEAR_F32
            mesh.colors_rate = lib.LAM_PER_TRIANGLE if self.by_face else lib.LAM_PER_VERTEX
        return call(lib.lam_scene_add_mesh, scene, mesh)


def material_of(visual):
    """The material of a textured trimesh object."""
    source = getattr(visual, "material", None)
    image = getattr(source, "baseColorTexture", None)
    image = getattr(source, "image", None) if image is None else image
    material = Material()
    factor = getattr(source, "baseColorFactor", None)
    if hasattr(source, "baseColorTexture"):
        numbers = np.ones(4) if factor is None else np.asarray(factor, float) / (255 if np.asarray(factor).dtype.kind in "iu" else 1)
        material.diffuse, material.physical = tuple(numbers), True
        for key, value in (("metallic", source.metallicFactor), ("roughness", source.roughnessFactor)):
            setattr(material, key, 1 if value is None else value)
    if image is not None:
        material.set_map("diffuse", image)
    return material


def meshes_of(model):
    """The meshes of an object, each with a 4×4 transform or None; None if the object has no known kind of vertices."""
    def found(name, *others):
        return next((value for value in (getattr(model, each, None) for each in (name, *others)) if value is not None), None)

    if isinstance(model, Mesh):
        return [(model, None)]
    if hasattr(model, "graph") and hasattr(model, "geometry"): # a trimesh scene
        nodes = [model.graph[node] for node in model.graph.nodes_geometry]
        return [(mesh, transform) for transform, name in nodes for mesh, _ in meshes_of(model.geometry[name])]
    if hasattr(model, "points") and hasattr(model, "cells"): # meshio
        kinds = ("triangle", "quad", "polygon", "line")
        cells = [block for block in model.cells if block.type.rstrip("0123456789") in kinds]
        return [(Mesh(points3(model.points), np.asarray(block.data)), None) for block in cells] or [(Mesh(points3(model.points)), None)]
    vertices, faces = found("vertices"), found("faces", "triangles")
    if vertices is not None:
        visual, colors, uv = getattr(model, "visual", None), found("vertex_colors"), None
        kind = getattr(visual, "kind", None)
        if kind in ("vertex", "face"):
            colors = visual.vertex_colors if kind == "vertex" else visual.face_colors
        elif kind == "texture":
            uv = visual.uv
        colors = None if colors is None or not len(colors) else np.asarray(colors)
        if colors is not None and colors.dtype.kind == "f": # Open3D: sRGB-encoded
            colors = np.rint(colors * 255).astype(np.uint8)
        return [(Mesh(np.asarray(vertices), None if faces is None else np.asarray(faces), texcoords=uv, colors=colors,
                      material=material_of(visual) if kind == "texture" else None), None)]
    if isinstance(model, np.ndarray):
        soup = model.ndim == 3 and model.shape[1:] == (3, 3)
        return [(Mesh(model.reshape(-1, 3), np.arange(model.size // 3).reshape(-1, 3)) if soup else Mesh(model), None)]
    if isinstance(model, (tuple, list)) and len(model) == 2 and all(hasattr(part, "__len__") and not isinstance(part, str) for part in model):
        return [(Mesh(*model), None)]
    return None


def points3(points):
    """Adds a third coordinate of 0 to points in a plane."""
    points = np.asarray(points)
    return np.pad(points, ((0, 0), (0, 1))) if points.ndim == 2 and points.shape[1] == 2 else points
