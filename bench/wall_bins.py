# SPDX-License-Identifier: Apache-2.0
"""Thin walls: which thickness is found, and how wrong it is; and objects that must not be invented.

A tilted wall whose thickness falls from 3 to 0.3 voxels stands beside a ball of the same grey value
(230 in 120). Lines across the wall are cut with a surface. Lengths in voxels of 1 mm.
"""
import numpy as np
import vtk
from scipy.ndimage import gaussian_filter

from volumes import Volume

SIDE = 72
OUTSIDE, INSIDE = 120.0, 230.0
BALL, BALL_CENTER = 12.0, np.array([0, -16, 0]) + SIDE / 2
MIDDLE = np.array([0, 9, 0]) + SIDE / 2
LONG, HIGH = 26, 24  # half sides of the wall
BINS = (0.5, 0.7, 0.9, 1.1, 1.4, 1.8, 2.3)
FAR = 3.0  # what is further from the ball has been invented


def turn():
    a, b = np.deg2rad(17), np.deg2rad(11)
    about_z = np.array([[np.cos(a), -np.sin(a), 0], [np.sin(a), np.cos(a), 0], [0, 0, 1]])
    about_y = np.array([[np.cos(b), 0, np.sin(b)], [0, 1, 0], [-np.sin(b), 0, np.cos(b)]])
    return about_z @ about_y


def thickness(x):
    return 0.3 + (x + LONG) / (2 * LONG) * 2.7


def ball(p):
    return BALL - np.linalg.norm(p - BALL_CENTER, axis=-1)


def wall_and_ball(p):
    x, y, z = np.moveaxis((p - MIDDLE) @ turn(), -1, 0)
    wall = np.minimum(thickness(x) / 2 - np.abs(y), np.minimum(LONG - np.abs(x), HIGH - np.abs(z)))
    return np.maximum(wall, ball(p))


def scan(inside, blur, noise, seed, samples=6):
    """Means over the voxels, then the blur, then the noise."""
    lines = [np.arange(SIDE) + 0.5] * 3
    depth = inside(np.stack(np.meshgrid(*lines, indexing="ij"), -1))
    share, near = (depth > 0).astype(float), np.abs(depth) < 1.8
    corner, o = np.argwhere(near), (np.arange(samples) + 0.5) / samples
    share[near] = np.mean([inside(corner + [a, b, c]) > 0 for a in o for b in o for c in o], axis=0)
    image = gaussian_filter(OUTSIDE + (INSIDE - OUTSIDE) * share, blur, truncate=5, mode="nearest")
    image += np.random.default_rng(seed).normal(0, noise, image.shape)
    return Volume(image.astype(np.float32), np.ones(3), np.full(3, 0.5))


def noise_alone(noise, seed):
    image = OUTSIDE + np.random.default_rng(seed).normal(0, noise, (64,) * 3)
    return Volume(image.astype(np.float32), np.ones(3), np.full(3, 0.5))


def crossings(surface):
    """By line across the wall: its thickness, the number of cuts, the way from first to last."""
    tree, cuts, rows = vtk.vtkOBBTree(), vtk.vtkPoints(), []
    tree.SetDataSet(surface)
    tree.BuildLocator()
    for x in np.linspace(-25, 25, 101):
        for z in np.linspace(-18, 18, 25):
            a, b = (turn() @ [x, y, z] + MIDDLE for y in (-4, 4))
            cuts.Reset()
            tree.IntersectWithLine(a, b, cuts, None)
            count = cuts.GetNumberOfPoints()
            at = [np.dot(np.array(cuts.GetPoint(i)) - a, b - a) / 8 for i in range(count)]
            rows.append((thickness(x), count, max(at) - min(at) if count > 1 else 0))
    return np.array(rows)


def judged(surface):
    """By bin of the thickness: the share found and the mean error of what is found, or None."""
    if surface is None or not surface.GetNumberOfPolys():
        return [(0.0, None)] * (len(BINS) - 1)
    rows, found = crossings(surface), []
    for low, high in zip(BINS, BINS[1:]):
        part = rows[(rows[:, 0] >= low) & (rows[:, 0] < high)]
        hit = part[part[:, 1] >= 2]
        error = float((hit[:, 2] - hit[:, 0]).mean()) if len(hit) else None
        found.append((len(hit) / len(part), error))
    return found


def invented_area(points, triangles, has_ball):
    """Area of the triangles whose middle is far from the ball, square voxels."""
    a, b, c = (points[triangles[:, i]] for i in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    far = np.abs(ball((a + b + c) / 3)) > FAR if has_ball else np.full(len(areas), True)
    return float(areas[far].sum())
