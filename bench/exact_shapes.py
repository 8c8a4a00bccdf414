# SPDX-License-Identifier: Apache-2.0
"""Shapes known exactly, for the simulated scanner: functions of points in mm that are positive inside.

A shape is about 56 mm across, its middle at the origin; its values near the surface are about the
distance to it. The femur, the fracture and the wing follow tools/mesamis/phantom. `relative_grey` is 1
for dense bone and 0 for what surrounds the object.
"""
import numpy as np
from vtk.util.numpy_support import numpy_to_vtk

from distances import triangles_of
from volumes import Volume, isosurface

FINE = 0.25  # mm, of the grid that carries the truth and the simulated object
HALF = 30.0  # mm, half of its side
SLAB = 16  # layers that are computed at once


def norm(p):
    return np.sqrt((p * p).sum(-1))


def turned(p, about_z, about_y):
    """The points in a frame that is turned about z, then about its own y."""
    x, y, z = np.moveaxis(p, -1, 0)
    x, y = np.cos(about_z) * x + np.sin(about_z) * y, np.cos(about_z) * y - np.sin(about_z) * x
    x, z = np.cos(about_y) * x - np.sin(about_y) * z, np.cos(about_y) * z + np.sin(about_y) * x
    return np.stack([x, y, z], -1)


def round_box(p, half, radius):
    q = np.abs(p) - half + radius
    return radius - norm(np.maximum(q, 0)) - np.minimum(q.max(-1), 0)


def tapered(across, along, discs):
    """Two discs in a plane and their common tangents; `discs`: two radii and the way between."""
    first, second, way = discs
    sine = (first - second) / way
    cosine = np.sqrt(1 - sine * sine)
    k = cosine * along - sine * across
    between = first - cosine * across - sine * along
    ends = np.where(k < 0, first - np.hypot(across, along), second - np.hypot(across, along - way))
    return np.where((k < 0) | (k > cosine * way), ends, between)


def capsule(p, a, b, first, second=None):
    d = np.subtract(b, a)
    way = np.linalg.norm(d)
    v = p - a
    along = v @ d / way
    across = np.sqrt(np.maximum(0, (v * v).sum(-1) - along**2))
    return tapered(across, along, (first, first if second is None else second, way))


def fillet(a, b, width):
    return np.maximum(width - np.abs(a - b), 0) ** 2 / (4 * width)


def union(a, b, width):
    return np.maximum(a, b) + fillet(a, b, width)


def intersection(a, b, width):
    return np.minimum(a, b) - fillet(a, b, width)


def smooth_step(x, low, high):
    t = np.clip((x - low) / (high - low), 0, 1)
    return t * t * (3 - 2 * t)


def fracture(p):
    q = turned(p, 0, 0.12)
    gap = tapered(np.abs(q[..., 2]), q[..., 0] + 5, (0.25, 2.5, 27))
    return intersection(round_box(turned(p, 0.2, 0), np.array([17, 13, 25]), 7), -gap, 0.6)


def femur(p):
    """Head, neck, greater trochanter and the beginning of the shaft, sawn off."""
    q = (p + [-9, 0, 14]) * [1, 1 / 1.1, 1]
    shaft = capsule(q, [0, 0, -60], [1, 0, 14], 7.5, 9)
    neck = capsule(q, [1, 0, 14], [-18, -1, 28], 6.5)
    trochanter = capsule(q, [3, 1, 14], [6, 2, 25], 8.5, 6)
    head = 11 - norm(q - [-19, -1, 29])
    whole = union(union(union(shaft, trochanter, 5), neck, 6), head, 3)
    return intersection(whole / 1.1, q[..., 2] + 12, 1)


def plates(p):
    """Of 0.6, 1 and 1.5 mm, each 36 x 28 mm, askew."""
    q = turned(p, 0.35, 0.25)
    found = [round_box(q - [0, y, 0], np.array([18, half, 14]), half)
             for y, half in ((-10, 0.3), (0, 0.5), (10, 0.75))]
    return np.max(found, axis=0)


def shell(p):
    """Between two balls, their middles apart: 0.8 mm thick at one end and 3 mm at the other."""
    axis = np.array([0.64, 0.48, 0.6])
    return np.minimum(22 - norm(p), norm(p - 1.1 * axis) - 20.1)


def wing(p, scale=0.34, radius=120):
    """A sheet of 1.5 mm, bent like an S, with a bead along its edge and thicker below."""
    q = turned(p - [8, 3, 1.3], 0.5, -0.1) / scale
    v = q + [radius, 0, 0]
    far = norm(v)
    stretch = radius / np.maximum(far, 0.85 * radius)
    a, b = stretch * v[..., 1], stretch * v[..., 2] - 10
    off = far - radius - 6 * np.sin(a / 38) * smooth_step(b, -60, 50)
    fan = intersection(80 - np.hypot(a, b + 15), 0.907 * (a + 76) + 0.42 * (b - 15), 20)
    fan = intersection(fan, -0.88 * (a - 78) + 0.476 * (b - 5), 20)
    fan = intersection(fan, b + 78, 10)
    outline = np.clip(intersection(fan, np.hypot(a - 70, b + 48) - 25, 10), -15, 15)
    outline = np.where(v[..., 0] < 0, -15, outline)
    half = 2 + 5 * (1 - smooth_step(b, -85, -25)) + 3 * smooth_step(a, 25, 75)
    sheet = intersection(half - np.abs(off), outline, 3)
    return scale * union(sheet, 4.5 - np.hypot(off, outline - 3.5), 5) / 1.35


SHAPES = {f.__name__: f for f in (fracture, femur, plates, shell, wing)}


def relative_grey(name, p, depth):
    """Of the matter `depth` mm below the surface: the femur has a dense shell and a spongy core."""
    if name != "femur":
        return np.ones(depth.shape)
    k = 2 * np.pi / 7
    x, y, z = (k * p[..., a] for a in range(3))
    gyroid = (np.sin(x) * np.cos(y) + np.sin(y) * np.cos(z) + np.sin(z) * np.cos(x)) / 1.5
    spongy = 0.73 + 0.14 * np.clip(2 * gyroid, -1, 1)
    thickness = 3.5 - 2 * smooth_step(p[..., 2], -24, 4)
    return 1 + (spongy - 1) * smooth_step(depth, thickness - 0.5, thickness + 0.5)


def fine_grid(name):
    """The function, and the share of the dense bone's grey value, both on the fine grid."""
    line = np.arange(-HALF + FINE / 2, HALF, FINE)
    depth = np.empty((len(line),) * 3, np.float32)
    grey = np.empty_like(depth)
    for k in range(0, len(line), SLAB):
        p = np.stack(np.meshgrid(line, line, line[k:k + SLAB], indexing="ij"), -1)
        d = SHAPES[name](p)
        depth[..., k:k + SLAB] = d
        grey[..., k:k + SLAB] = np.clip(d / FINE + 0.5, 0, 1) * relative_grey(name, p, d)
    return (Volume(a, np.full(3, FINE), np.full(3, line[0])) for a in (depth, grey))


def exact_surface(name, depth, steps=3, h=1e-4):
    """The surface of the fine grid, its points put on the shape by Newton's steps."""
    surface = isosurface(depth, 0, specks=0)
    points, f = triangles_of(surface)[0], SHAPES[name]
    for _ in range(steps):
        value = f(points)
        g = np.stack([(f(points + e) - f(points - e)) / (2 * h) for e in h * np.eye(3)], -1)
        step = value / np.maximum((g * g).sum(-1), 0.04)
        points -= np.clip(step, -FINE, FINE)[:, None] * g
    surface.GetPoints().SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=1))
    return surface
