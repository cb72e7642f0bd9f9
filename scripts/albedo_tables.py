#!/usr/bin/env python3
"""albedo_tables.py [--check]: computes the tables of GGX's lobe for src/core/lighting/lobes.h, and the table of the sheen's lobe for layers.h.

For 32 roughnesses (rows, ROUGHNESS_MIN ... 1, evenly) and 32 cosines n.v (columns, their roots evenly from 0 to 1):
    albedo.table   E = the integral over all l of D V n.l: what mirrors of f0 = 1 return at once
    bias.table     B = the same with Schlick's weight (1 - v.h)^5
    sheen.table    the integral of Conty and Kulla's D V n.l (layers.h, sheen_lobe)
so that the integral with Schlick's Fresnel factor is f0 (E - B) + B: the scale and bias of the split sum (Karis 2013).
The integral is taken over half vectors h, drawn like Heitz's (2018) distribution of normals visible from v, on a grid. The remaining average is of G2
/ G1, which is at most 1 and smooth for every roughness. 1e-4 replaces n.v = 0.

--check writes nothing and reports the deviation of the files. Needs python3-numpy.
"""
import os
import sys

import numpy as np

SIZE, RINGS, SECTORS = 32, 400, 400
ROUGHNESS_MIN = 0.045
FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "src", "core", "lighting")


def integrals(n_dot_v, roughness):
    alpha = roughness * roughness
    v = np.array([np.sqrt(1 - n_dot_v * n_dot_v), 0, n_dot_v])
    # Heitz: the hemisphere visible from v, stretched by alpha, as a disc whose lower part is moved up
    s = np.array([alpha * v[0], 0, v[2]])
    s /= np.linalg.norm(s)
    # Rings are denser near the disc's edge, where mirrors have slopes far beyond alpha; evenly spaced rings have errors up to 5e-4
    rest = 1 - (np.arange(RINGS) + 0.5) / RINGS
    u, weight = 1 - rest**4, 4 * rest**3
    p = np.pi * (np.arange(SECTORS) + 0.5) / SECTORS  # half of the circle; the other half is its mirror image
    r, phi = np.meshgrid(np.sqrt(u), p)
    # `across` lies in the plane of v and the normal, `along` is perpendicular to it
    across, along = r * np.cos(phi), r * np.sin(phi)
    lift = 0.5 * (1 + s[2])
    across = (1 - lift) * np.sqrt(np.maximum(1 - along * along, 0)) + lift * across
    up = np.sqrt(np.maximum(1 - across * across - along * along, 0))
    x, y, z = across * -s[2] + up * s[0], along, across * s[0] + up * s[2]
    x, y, z = alpha * x, alpha * y, np.maximum(z, 1e-9)
    length = np.sqrt(x * x + y * y + z * z)
    x, z = x / length, z / length
    v_h = np.maximum(x * v[0] + z * v[2], 0)
    l_z = 2 * v_h * z - v[2]
    square = alpha * alpha
    g = lambda c: np.sqrt(c * c * (1 - square) + square)
    lit = np.maximum(l_z, 1e-12)
    share = np.where(l_z > 0, lit * (v[2] + g(v[2])) / (lit * g(v[2]) + v[2] * g(lit)), 0)  # G2 / G1
    share = share * weight
    return share.mean(), (share * (1 - v_h) ** 5).mean()


def sheen_shadow(c, alpha):
    part = (1 - alpha) ** 2
    p = [y + (x - y) * part for x, y in ((25.3245, 21.5473), (3.32435, 3.82987), (0.16801, 0.19823), (-1.27393, -1.97760),
                                         (-4.85967, -4.32054))]
    fit = lambda x: p[0] / (1 + p[1] * x ** p[2]) + p[3] * x + p[4]
    return np.exp(np.where(c < 0.5, fit(np.minimum(c, 0.5)), 2 * fit(0.5) - fit(np.minimum(1 - c, 0.5))))


def sheen_integral(n_dot_v, roughness):
    alpha = roughness * roughness
    nodes, weights = np.polynomial.legendre.leggauss(RINGS)
    t = (nodes + 1) / 2
    cosine, d_cosine = t * t, weights / 2 * 2 * t  # closer together at grazing angles
    # half of the circle; closer together at pi, where l is opposite to v
    u = (np.arange(4 * SECTORS) + 0.5) / (4 * SECTORS)
    phi, d_phi = np.pi * (1 - u * u), 2 * np.pi * u / (4 * SECTORS)
    c, p = np.meshgrid(cosine, phi)
    sine = np.sqrt(1 - c * c)
    x, y, z = sine * np.cos(p) + np.sqrt(1 - n_dot_v * n_dot_v), sine * np.sin(p), c + n_dot_v
    sine_h = np.sqrt((x * x + y * y) / (x * x + y * y + z * z))
    value = (2 + 1 / alpha) * sine_h ** (1 / alpha) / (8 * np.pi * n_dot_v)
    value /= 1 + sheen_shadow(np.float64(n_dot_v), alpha) + sheen_shadow(c, alpha)
    return 2 * (value * d_phi[:, None] * d_cosine[None, :]).sum()


def main():
    tables = np.zeros((3, SIZE, SIZE))
    for i in range(SIZE):
        for k in range(SIZE):
            root = max(k / (SIZE - 1), 0.01)
            roughness = ROUGHNESS_MIN + (1 - ROUGHNESS_MIN) * i / (SIZE - 1)
            tables[:2, i, k] = integrals(root * root, roughness)
            tables[2, i, k] = sheen_integral(root * root, roughness)
    for name, table in zip(("albedo.table", "bias.table", "sheen.table"), tables):
        path = os.path.join(FOLDER, name)
        if "--check" in sys.argv:
            with open(path) as f:
                kept = np.array([float(x) for x in f.read().replace("\n", " ").split(",") if x.strip()])
            off = np.abs(kept.reshape(SIZE, SIZE) - table)
            print("%s: at most %.2g off, %.2g in the mean" % (name, off.max(), off.mean()))
            continue
        with open(path, "w") as f:
            f.write(",\n".join(", ".join("%.5f" % x for x in row) for row in table) + "\n")


if __name__ == "__main__":
    main()
