"""models.py: the benchmark's files: one bumpy sphere, in any number of triangles, as binary PLY, binary STL and OBJ."""
import array
import math
import os
import struct


def sphere(triangles):
    """Positions (flat list of floats) and triangles (flat list of indices) of a bumpy sphere with about that many triangles."""
    rings = max(4, int(round(math.sqrt(triangles / 4))))
    around = 2 * rings
    positions = array.array("f")
    wave = [math.cos(9 * 2 * math.pi * i / around) for i in range(around)]
    circle = [(math.cos(2 * math.pi * i / around), math.sin(2 * math.pi * i / around)) for i in range(around)]
    for j in range(rings + 1):
        theta = math.pi * j / rings
        s, c = math.sin(theta), math.cos(theta)
        for i in range(around):
            r = 1 + 0.06 * wave[i] * math.sin(7 * theta) * s
            positions.extend((r * s * circle[i][0], r * c, r * s * circle[i][1]))
    indices = array.array("I")
    for j in range(rings):
        for i in range(around):
            a, b = j * around + i, j * around + (i + 1) % around
            c, d = a + around, b + around
            if j > 0:
                indices.extend((a, b, d))
            if j < rings - 1:
                indices.extend((a, d, c))
    return positions, indices


def write_ply(path, positions, indices):
    with open(path, "wb") as file:
        file.write(("ply\nformat binary_little_endian 1.0\nelement vertex %d\nproperty float x\nproperty float y\n"
                    "property float z\nelement face %d\nproperty list uchar int vertex_indices\nend_header\n"
                    % (len(positions) // 3, len(indices) // 3)).encode())
        file.write(positions.tobytes())
        pack = struct.Struct("<BIII").pack
        it = iter(indices)
        file.write(b"".join(pack(3, a, b, c) for a, b, c in zip(it, it, it)))


def write_stl(path, positions, indices):
    with open(path, "wb") as file:
        file.write(b"benchmark".ljust(80) + struct.pack("<I", len(indices) // 3))
        raw = positions.tobytes()
        corner = [raw[12 * i:12 * i + 12] for i in range(len(positions) // 3)]
        it = iter(indices)
        zero, end = bytes(12), bytes(2)
        file.write(b"".join(zero + corner[a] + corner[b] + corner[c] + end for a, b, c in zip(it, it, it)))


def write_obj(path, positions, indices):
    with open(path, "w") as file:
        it = iter(positions)
        file.writelines("v %.6f %.6f %.6f\n" % p for p in zip(it, it, it))
        it = iter(indices)
        file.writelines("f %d %d %d\n" % (a + 1, b + 1, c + 1) for a, b, c in zip(it, it, it))


def make(folder, triangles):
    """The three files of a size, made where they are missing: {"ply": path, …}."""
    os.makedirs(folder, exist_ok=True)
    writers = {"ply": write_ply, "stl": write_stl, "obj": write_obj}
    paths = {kind: os.path.join(folder, "sphere_%d.%s" % (triangles, kind)) for kind in writers}
    if not all(os.path.exists(p) for p in paths.values()):
        positions, indices = sphere(triangles)
        for kind, write in writers.items():
            write(paths[kind], positions, indices)
    return paths
