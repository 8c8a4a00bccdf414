#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Thickness of an object at each point of its surface, mm: the diameter of the largest ball inside that touches there.

    examples/tutorial/thickness.py SURFACE.ply OUT.vtp    then: mesamis picture OUT.vtp --color thickness -o out.png

Needs the package mesamis, NumPy and SciPy. The ball is found by shrinking: it starts large, and each point of the
surface inside it makes it smaller, until none is left. Triangles may be larger than the wall is thick: points are
scattered over them.
"""
import sys

import mesamis
import numpy as np
from scipy.spatial import cKDTree


def vertex_normals(points, triangles):
    """Outward unit normals, the mean of those around a vertex, weighted by area."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    normals = np.zeros_like(points)
    for k in range(3):
        np.add.at(normals, triangles[:, k], np.cross(b - a, c - a))
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)


def scattered(points, triangles, count):
    """Points on the triangles, as many per area everywhere, and the normals there."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    cross = np.cross(b - a, c - a)
    area = np.linalg.norm(cross, axis=1)
    random = np.random.default_rng(0)
    t = random.choice(len(triangles), count, p=area / area.sum())
    u, v = random.random((2, count, 1))
    u, v = np.where(u + v > 1, (1 - u, 1 - v), (u, v))
    return a[t] + u * (b - a)[t] + v * (c - a)[t], cross[t] / area[t, None]


def thickness(points, triangles, rounds=40, count=100_000):
    """A point whose normal turns by less than about 70 degrees does not count: it is not on the other side."""
    normals, (others, beyond) = vertex_normals(points, triangles), scattered(points, triangles, count)
    tree = cKDTree(others)
    radius = np.full(len(points), np.ptp(points, axis=0).max())
    for _ in range(rounds):
        near = tree.query(points - radius[:, None] * normals)[1]
        way = points - others[near]
        depth = (way * normals).sum(axis=1)
        smaller = np.divide((way**2).sum(axis=1), 2 * depth, out=radius.copy(), where=depth > 1e-9)
        shrinks = (smaller < 0.999 * radius) & ((normals * beyond[near]).sum(axis=1) < 0.3)
        if not shrinks.any():
            break
        radius = np.where(shrinks, smaller, radius)
    centres = points - radius[:, None] * normals
    for p in np.flatnonzero(tree.query(centres)[0] < 0.97 * radius):  # the nearest does not count: all that do
        inside = np.array(tree.query_ball_point(centres[p], radius[p]))
        way = points[p] - others[inside[beyond[inside] @ normals[p] < 0.3]]
        depth = way @ normals[p]
        counts = depth > 1e-9
        radius[p] = min(radius[p], np.min((way[counts]**2).sum(axis=1) / (2 * depth[counts]), initial=np.inf))
    return 2 * radius


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    surface = mesamis.read_surface(sys.argv[1])
    values = thickness(np.array(surface.points), np.array(surface.triangles))
    mesamis.write_surface(sys.argv[2], surface, arrays={"thickness": values})
    print(f"median {np.median(values):.3f} mm, nine tenths between {np.quantile(values, 0.05):.3f} and "
          f"{np.quantile(values, 0.95):.3f} mm")


if __name__ == "__main__":
    main()
