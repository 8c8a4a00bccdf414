# SPDX-License-Identifier: Apache-2.0
"""Distances between two surfaces in process, by points spread evenly over the area of each."""
import numpy as np
import vtk
from scipy.spatial import cKDTree
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

READERS = {".ply": vtk.vtkPLYReader, ".vtp": vtk.vtkXMLPolyDataReader}
SAMPLES = 20000  # per direction


def read_surface(path):
    reader = READERS[path.suffix]()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def write_surface(path, surface):
    writer = vtk.vtkXMLPolyDataWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(surface)
    writer.Write()


def triangles_of(surface):
    """Points, and three of them per triangle."""
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    return points, vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def area_samples(surface, count, seed=1):
    """Points of a surface, as many per area everywhere."""
    points, triangles = triangles_of(surface)
    a, b, c = (points[triangles[:, i]] for i in range(3))
    ends = np.cumsum(np.linalg.norm(np.cross(b - a, c - a), axis=1))
    random = np.random.default_rng(seed)
    at = np.searchsorted(ends, (np.arange(count) + random.random(count)) / count * ends[-1])
    at = np.minimum(at, len(ends) - 1)
    u, v = random.random((2, count, 1))
    root = np.sqrt(u)
    return (1 - root) * a[at] + root * (1 - v) * b[at] + root * v * c[at]


class Target:
    """A surface to measure distances to."""

    def __init__(self, surface):
        self.surface = surface
        self.function = vtk.vtkImplicitPolyDataDistance()
        self.function.SetInput(surface)

    def distances(self, points):
        found = vtk.vtkDoubleArray()
        self.function.FunctionValue(numpy_to_vtk(np.ascontiguousarray(points)), found)
        return np.abs(vtk_to_numpy(found))


class Judge:
    """Measures surfaces against the truth of a scan; distances in voxels.

    `margin`: voxels per axis next to the edges of the box where nothing is measured.
    """

    def __init__(self, truth, scan, margin=0):
        self.truth, self.voxel = Target(truth), scan.voxel
        low, high = scan.bounds
        self.box = low + margin * scan.spacing, high - margin * scan.spacing

    def samples(self, surface, count):
        points = area_samples(surface, count)
        return points[np.all((points > self.box[0]) & (points < self.box[1]), axis=1)]

    def expected_and_real(self, surface, name, count=SAMPLES):
        """Mean distances by tenths of the area, voxels: as an array of the surface's points tells
        them, by which the area is sorted, and to the truth."""
        if not surface.GetNumberOfPolys():
            return np.full((2, 10), np.nan)
        points = self.samples(surface, count)
        nearest = cKDTree(triangles_of(surface)[0]).query(points)[1]
        expected = vtk_to_numpy(surface.GetPointData().GetArray(name))[nearest] / self.voxel
        real, order = self.truth.distances(points) / self.voxel, np.argsort(expected, kind="stable")
        return np.array([[part.mean() for part in np.array_split(d[order], 10)]
                         for d in (expected, real)])

    def measure(self, surface, count=SAMPLES):
        """Mean distances truth to surface and back, and the shares further than a voxel."""
        if surface is None or not surface.GetNumberOfPolys():
            return {"sum": np.inf, "to": np.inf, "from": np.inf, "missed": 1.0, "invented": 0.0}
        to = Target(surface).distances(self.samples(self.truth.surface, count)) / self.voxel
        back = self.truth.distances(self.samples(surface, count)) / self.voxel
        means = [float(d.mean()) if d.size else np.inf for d in (to, back)]
        shares = [float((d > 1).mean()) if d.size else 0.0 for d in (to, back)]
        return {"sum": sum(means), "to": means[0], "from": means[1], "missed": shares[0],
                "invented": shares[1], "triangles": surface.GetNumberOfPolys()}
