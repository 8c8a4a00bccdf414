# SPDX-License-Identifier: Apache-2.0
"""Scans of the studies: read, write, degrade, and the isosurfaces of their grids. Needs numpy, scipy, vtk.

A volume lies along the axes of its file: arrays are indexed x, y, z; millimetres; the origin is the
middle of the first voxel.
"""
import dataclasses
import gzip
import re
import struct

import numpy as np
import vtk
from scipy import ndimage
from vtk.util.numpy_support import numpy_to_vtk

NRRD_TYPES = {"uchar": "u1", "short": "i2", "ushort": "u2", "float": "f4"}
NIFTI_TYPES = {2: "u1", 4: "i2", 8: "i4", 16: "f4", 512: "u2"}
SPECK = 4  # voxels; ours drops what is smaller, so the rivals do


@dataclasses.dataclass
class Volume:
    values: np.ndarray
    spacing: np.ndarray
    origin: np.ndarray

    @property
    def voxel(self):
        """The geometric mean of the spacing, mm."""
        return float(np.prod(self.spacing) ** (1 / 3))

    @property
    def bounds(self):
        """Outer corners of the box of voxels, mm."""
        low = self.origin - self.spacing / 2
        return low, low + self.spacing * self.values.shape


def read_nrrd(path):
    head, data = path.read_bytes().split(b"\n\n", 1)
    fields = dict(line.split(": ", 1) for line in head.decode().splitlines()[1:] if ": " in line)
    if fields["encoding"] == "gzip":
        data = gzip.decompress(data)
    size = [int(n) for n in fields["sizes"].split()]
    values = np.frombuffer(data, "<" + NRRD_TYPES[fields["type"]], np.prod(size))
    number = r"[-+.\deE]+"
    axes = np.array(re.findall(number, fields["space directions"]), float).reshape(3, 3)
    origin = np.array(re.findall(number, fields["space origin"]), float)
    return Volume(values.reshape(size, order="F").astype(np.float32),
                  np.linalg.norm(axes, axis=1), origin)


def read_nifti(path):
    """Values and spacing of a packed NIfTI-1 file; the origin is set to zero."""
    data = gzip.decompress(path.read_bytes())
    size, kind = struct.unpack_from("<8h", data, 40)[1:4], struct.unpack_from("<h", data, 70)[0]
    spacing = np.array(struct.unpack_from("<8f", data, 76)[1:4], float)
    start = int(struct.unpack_from("<f", data, 108)[0])
    values = np.frombuffer(data, "<" + NIFTI_TYPES[kind], np.prod(size), start)
    return Volume(values.reshape(size, order="F").astype(np.float32), spacing, np.zeros(3))


def write_nrrd(path, volume):
    """Bytes and short integers stay what they are; other values are written in single precision."""
    kind = {"uint8": "uchar", "int16": "short"}.get(volume.values.dtype.name, "float")
    directions = " ".join("(" + ",".join(f"{s:.9g}" if a == b else "0" for b in range(3)) + ")"
                          for a, s in enumerate(volume.spacing))
    head = ["NRRD0004", f"type: {kind}", "dimension: 3", "space: left-posterior-superior",
            "sizes: %d %d %d" % volume.values.shape, f"space directions: {directions}",
            "kinds: domain domain domain", "endian: little", "encoding: raw",
            "space origin: (" + ",".join(f"{x:.9g}" for x in volume.origin) + ")"]
    data = volume.values.astype("<" + NRRD_TYPES[kind]).tobytes(order="F")
    path.write_bytes("\n".join(head).encode() + b"\n\n" + data)


def cropped(volume, box):
    """`box`: three pairs of voxels, ends excluded; the part lies at the origin with its first voxel."""
    part = volume.values[tuple(slice(*pair) for pair in box)]
    return Volume(np.ascontiguousarray(part), volume.spacing, np.zeros(3))


def thinned(volume, factors):
    """Every k-th voxel of the low-passed scan, in the same frame."""
    sigma = [0.5 * k if k > 1 else 0 for k in factors]
    smooth = ndimage.gaussian_filter(volume.values, sigma, mode="nearest")
    starts = [(k - 1) // 2 for k in factors]
    values = smooth[tuple(slice(s, None, k) for s, k in zip(starts, factors))]
    return Volume(values, volume.spacing * factors, volume.origin + volume.spacing * starts)


def noisy(volume, sigma, seed=1):
    noise = np.random.default_rng(seed).normal(0, sigma, volume.values.shape)
    return dataclasses.replace(volume, values=(volume.values + noise).astype(np.float32))


def smoothed(volume, width):
    values = ndimage.gaussian_filter(volume.values, width, mode="nearest") if width else volume.values
    return dataclasses.replace(volume, values=values)


def upsampled(volume):
    """Cubic splines on half the spacing; the given voxels are among the new ones."""
    size = [2 * n - 1 for n in volume.values.shape]
    zoom = [m / n for m, n in zip(size, volume.values.shape)]
    values = ndimage.zoom(volume.values, zoom, order=3, mode="nearest", grid_mode=False)
    return Volume(values, volume.spacing / 2, volume.origin)


def without_specks(values, level, least):
    """Islands and holes of fewer voxels get values on the other side of the level."""
    values, step = values.copy(), 1e-3 * float(np.ptp(values))
    for inside, other in ((values > level, level - step), (values <= level, level + step)):
        labels, _ = ndimage.label(inside)
        counts = np.bincount(labels.ravel())
        values[(counts < least)[labels] & inside] = other
    return values


def isosurface(volume, level, specks=SPECK):
    """Flying edges; without the islands and holes of fewer than `specks` voxels."""
    values = without_specks(volume.values, level, specks) if specks else volume.values
    image = vtk.vtkImageData()
    image.SetDimensions(*values.shape)
    image.SetSpacing(*volume.spacing)
    image.SetOrigin(*volume.origin)
    flat = np.ascontiguousarray(values.ravel(order="F"), dtype=np.float32)
    image.GetPointData().SetScalars(numpy_to_vtk(flat, deep=1))
    cubes = vtk.vtkFlyingEdges3D()
    cubes.SetInputData(image)
    cubes.SetValue(0, level)
    cubes.ComputeNormalsOff()
    cubes.ComputeScalarsOff()
    cubes.Update()
    return cubes.GetOutput()
