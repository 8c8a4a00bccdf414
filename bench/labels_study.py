#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Surfaces of labels against the truth: placed by the image, of the labels alone, and as viewers smooth them.

    bench/labels_study.py FOLDER                  two balls that touch: the case that guided the method
    bench/labels_study.py FOLDER --judging        three other bodies that touch, set aside

Bodies of known distance functions are blurred (0.7 voxels) and get noise (4 % of the contrast). Their labels are taken on
every n-th voxel, shifted, eroded, dilated, or wrong at a twentieth of the border's voxels. The distances are means over the
area of all bodies, in voxels of the image. The rival is each label's own isosurface, smoothed by a windowed sinc whose pass
band and iterations are chosen with knowledge of the truth, case by case. `mesamis` is the one in build/release, or that of
the variable MESAMIS.
"""
import argparse
import pathlib

import numpy
import vtk
from scipy import ndimage
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

from mesamis_runs import run
from rivals import PASS_BANDS, sinc
from volumes import Volume, write_nrrd

SIDE = 96
BLUR, NOISE, SUBSAMPLES = 0.7, 6.0, 3


def ball(centre, radius):
    return lambda p: numpy.linalg.norm(p - centre, axis=-1) - radius


def capsule(start, end, radius):
    start, along = numpy.array(start), numpy.subtract(end, start)

    def distance(p):
        share = numpy.clip((p - start) @ along / (along @ along), 0, 1)
        return numpy.linalg.norm(p - start - share[..., None] * along, axis=-1) - radius
    return distance


def rounded_box(centre, half, radius):
    def distance(p):
        q = numpy.abs(p - centre) - half
        return numpy.linalg.norm(numpy.maximum(q, 0), axis=-1) + numpy.minimum(q.max(axis=-1), 0) - radius
    return distance


# Distance functions, negative inside; where bodies overlap the first has the place. Grey values, the background's first.
GUIDING = ([ball((38.3, 47.6, 48.2), 22), ball((62.1, 48.3, 47.4), 19.5)], (50, 220, 140))
JUDGING = ([capsule((24.3, 30.2, 40.7), (66.8, 61.4, 52.9), 9.3), ball((64.2, 33.7, 45.1), 17.6),
            rounded_box((40.9, 68.3, 47.7), (17.2, 9.4, 13.1), 3.5)], (50, 230, 110, 170))


def distances(bodies, p):
    """To the surface of each body: where another comes first, that one's surface."""
    own = [body(p) for body in bodies]
    return [numpy.maximum.reduce([own[k], *(-other for other in own[:k])]) for k in range(len(own))]


def labels_at(bodies, p):
    label = numpy.zeros(p.shape[:-1], numpy.uint8)
    for k in reversed(range(len(bodies))):
        label[bodies[k](p) < 0] = k + 1
    return label


def nodes(count, step, first):
    axis = first + step * numpy.arange(count)
    return numpy.stack(numpy.meshgrid(axis, axis, axis, indexing="ij"), axis=-1)


def image_of(bodies, values, seed):
    total = numpy.zeros((SIDE,) * 3)
    shifts = (numpy.arange(SUBSAMPLES) - (SUBSAMPLES - 1) / 2) / SUBSAMPLES
    for shift in numpy.stack(numpy.meshgrid(shifts, shifts, shifts), axis=-1).reshape(-1, 3):
        total += numpy.take(numpy.array(values, float), labels_at(bodies, nodes(SIDE, 1, 0) + shift))
    image = ndimage.gaussian_filter(total / SUBSAMPLES**3, BLUR)
    return (image + numpy.random.default_rng(seed).normal(0, NOISE, image.shape)).astype(numpy.float32)


def at_borders(labels):
    return numpy.logical_or.reduce([numpy.roll(labels, s, axis) != labels for axis in range(3) for s in (1, -1)])


def with_wrong(labels, share, seed):
    """A share of the voxels at borders take the label of a neighbour."""
    random = numpy.random.default_rng(seed)
    chosen = at_borders(labels) & (random.random(labels.shape) < share)
    side = random.integers(0, 6, labels.shape)
    wrong = labels.copy()
    for n in range(6):
        here = chosen & (side == n)
        wrong[here] = numpy.roll(labels, 1 - 2 * (n % 2), n // 2)[here]
    return wrong


def eroded(labels):
    kept = numpy.zeros_like(labels)
    for label in range(1, labels.max() + 1):
        kept[ndimage.binary_erosion(labels == label)] = label
    return kept


def dilated(labels):
    grown = labels.copy()
    for label in range(1, labels.max() + 1):
        grown[ndimage.binary_dilation(labels == label) & (grown == 0)] = label
    return grown


def cases(bodies):
    """Names, labels, spacing, position of the first voxel."""
    for every in (1, 2, 3, 4):
        first = (every - 1) / 2
        labels = labels_at(bodies, nodes(SIDE // every, every, first))
        yield f"every {every}", labels, every, first
        yield f"every {every}, shifted by half of it", labels, every, first + every / 2
    labels = labels_at(bodies, nodes(SIDE, 1, 0))
    yield "eroded by a voxel", eroded(labels), 1, 0
    yield "dilated by a voxel", dilated(labels), 1, 0
    yield "5 % of the border wrong", with_wrong(labels, 0.05, 3), 1, 0
    coarse = labels_at(bodies, nodes(SIDE // 2, 2, 0.5))
    yield "every 2, 5 % of the border wrong", with_wrong(coarse, 0.05, 3), 2, 0.5


def write_cube(path, values, spacing, first):
    write_nrrd(path, Volume(values, numpy.full(3, spacing), numpy.full(3, first)))


def mean_distance(bodies, surfaces):
    """Over the area of all surfaces, a list of label and polygons."""
    total = area = 0
    for label, surface in surfaces:
        points = vtk_to_numpy(surface.GetPoints().GetData())
        corners = points[vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
        normal = numpy.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        weight = numpy.linalg.norm(normal, axis=1)
        off = numpy.abs(distances(bodies, corners.mean(axis=1))[label - 1])
        total += (weight * off).sum()
        area += weight.sum()
    return total / area


def read_surfaces(folder, count):
    for label in range(1, count + 1):
        reader = vtk.vtkPLYReader()
        reader.SetFileName(str(folder / f"found_label_{label}.ply"))
        reader.Update()
        yield label, reader.GetOutput()


def ours(folder, bodies, *inputs):
    run("segment", *inputs, "--labels", folder / "labels.nrrd", "-o", folder / "found_{label}.ply", "--quiet")
    return mean_distance(bodies, read_surfaces(folder, len(bodies)))


def own_isosurface(labels, label, spacing, first):
    image = vtk.vtkImageData()
    image.SetDimensions(*(n + 2 for n in labels.shape))
    image.SetSpacing(spacing, spacing, spacing)
    image.SetOrigin(*(3 * [first - spacing]))
    inside = numpy.pad((labels == label).astype(numpy.float32), 1)
    image.GetPointData().SetScalars(numpy_to_vtk(inside.ravel(order="F"), deep=True))
    cubes = vtk.vtkFlyingEdges3D()
    cubes.SetInputData(image)
    cubes.SetValue(0, 0.5)
    cubes.Update()
    return cubes.GetOutput()


def rival(bodies, labels, spacing, first):
    surfaces = [(n + 1, own_isosurface(labels, n + 1, spacing, first)) for n in range(len(bodies))]
    return min(mean_distance(bodies, [(n, sinc(surface, band, iterations)) for n, surface in surfaces])
               for band in (0.005, 0.01, *PASS_BANDS) for iterations in (10, 20, 40))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--judging", action="store_true", help="the bodies set aside")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    bodies, values = JUDGING if arguments.judging else GUIDING
    scan = arguments.folder / "scan.nrrd"
    write_cube(scan, image_of(bodies, values, 1), 1, 0)
    print("| labels | with the image | labels alone | windowed sinc, tuned | image / sinc |\n|---|---|---|---|---|")
    for name, labels, spacing, first in cases(bodies):
        write_cube(arguments.folder / "labels.nrrd", labels, spacing, first)
        placed, alone = ours(arguments.folder, bodies, scan), ours(arguments.folder, bodies)
        smoothed = rival(bodies, labels, spacing, first)
        print(f"| {name} | {placed:.3f} | {alone:.3f} | {smoothed:.3f} | {placed / smoothed:.2f} |", flush=True)


if __name__ == "__main__":
    main()
