#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How smooth and how whole surfaces of real bones are, beside those that viewers show.

    bench/looks_study.py FOLDER --scans DATA               bones of label maps
    bench/looks_study.py FOLDER --scans DATA --judging     those that were set aside
    bench/looks_study.py FOLDER --scans DATA --no-labels   whole scans, beside flying edges at the same level,
                                                           and at a level for each place (local_level.py)

Creases: the length of edges above 40 (25) degrees, times the voxel, over the area; flat faces at the box of the surface are
left out. Slope: how steep the image is at the surface in the median, over that at 3D Slicer's. Distances are those from and
to 3D Slicer's surface of the same label, voxels: the mean, and what 99 % do not exceed. Slicer's surface: flying edges of
the label, windowed sinc, smoothing 0.5, as its closed surface. Surface nets are VTK's (9.3 or later, else the row is left
out) with their own smoothing. `mesamis` is the one in build/release, or that of the variable MESAMIS.
"""
import argparse
import dataclasses
import functools
import pathlib

import nibabel
import numpy as np
import vtk
from scipy.ndimage import gaussian_gradient_magnitude, map_coordinates
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components
from vtk.util.numpy_support import numpy_to_vtk

from distances import SAMPLES, Target, area_samples, read_surface, triangles_of
from local_level import local_level
from mesamis_runs import once
from rivals import sinc
from volumes import read_nrrd, write_nrrd

LPS = np.diag([-1, -1, 1, 1])
PELVIS = ("pelvis_ts/ct.nii.gz", "pelvis_ts/labels_total.nii.gz")
SPINE = ("thoracic_spine_ts/ct.nii.gz", "thoracic_spine_ts/vertebra_T12.nii.gz")

# Name: scan, label map, number.
GUIDING = {"left hip": (*PELVIS, 77), "sacrum": (*PELVIS, 25), "L5": (*PELVIS, 27), "left femur": (*PELVIS, 75)}
JUDGING = {"right hip": (*PELVIS, 78), "right femur": (*PELVIS, 76), "L4": (*PELVIS, 28), "L3": (*PELVIS, 29),
           "L2": (*PELVIS, 30), "T12": (*SPINE, 1)}
# Name: scan, labels of its bones.
SCANS = {"head CT": ("cranium_inv/ct.nrrd", None), "pelvis CT": (PELVIS[0], "pelvis_ts/bone.nii.gz"),
         "thoracic spine CT": SPINE[:2], "trabecular bone": ("trabecular_microct/ct.nrrd", None),
         "mouse": ("mouse_skull/ct_A_J.nii.gz", None)}
CTS = ("head CT", "pelvis CT", "thoracic spine CT")


def edges_of(triangles):
    """Pairs of triangles that share an edge, the edge's ends, and whether all edges have two triangles."""
    ends = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    _, edge, count = np.unique(ends, axis=0, return_inverse=True, return_counts=True)
    order = np.argsort(edge.ravel(), kind="stable")
    order = order[count[edge.ravel()[order]] == 2].reshape(-1, 2)
    return order // 3, ends[order[:, 0]], bool((count == 2).all())


def looks(surface, voxel):
    """Creases and parts of a surface; its genus if it is closed."""
    points, triangles = triangles_of(surface)
    used, triangles = np.unique(triangles, return_inverse=True)
    points, triangles = points[used], triangles.reshape(-1, 3)
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    twice = np.linalg.norm(normals, axis=1)
    normals /= np.maximum(twice, 1e-30)[:, None]
    beside, ends, is_closed = edges_of(triangles)
    angle = np.degrees(np.arccos(np.clip((normals[beside[:, 0]] * normals[beside[:, 1]]).sum(1), -1, 1)))
    flat = np.zeros(len(triangles), bool)
    for axis in range(3):
        for face in (points[:, axis].min(), points[:, axis].max()):
            flat |= (np.abs(corners[:, :, axis] - face) < 1e-5 * np.ptp(points, axis=0).max()).all(1)
    angle[flat[beside].any(1)] = 0
    length = np.linalg.norm(points[ends[:, 0]] - points[ends[:, 1]], axis=1)
    area = twice.sum() / 2
    parts = connected_components(coo_matrix((np.ones(len(ends)), ends.T), (len(points),) * 2), False)[0]
    return {"triangles": len(triangles), "parts": parts,
            "genus": parts - (len(points) - len(ends) + len(triangles)) // 2 if is_closed else "open",
            "creases": voxel * length[angle > 40].sum() / area,
            "creases_25": voxel * length[angle > 25].sum() / area}


class Bone:
    """A label of a map, its scan, and how viewers show it; world frame, mm."""

    def __init__(self, data, scan, labels, number):
        self.scan, self.labels, self.number = data / scan, data / labels, number
        image = nibabel.load(self.labels)
        self.mask = np.asarray(image.dataobj) == number
        self.to_world = LPS @ image.affine
        self.spacing = np.linalg.norm(self.to_world[:3, :3], axis=0)
        self.voxel = np.prod(self.spacing) ** (1 / 3)

    def image(self):
        """The mask as VTK has it, a voxel larger on all sides."""
        padded = np.pad(self.mask.astype(np.uint8), 1)
        grid = vtk.vtkImageData()
        grid.SetDimensions(padded.shape)
        grid.SetSpacing(*self.spacing)
        grid.GetPointData().SetScalars(numpy_to_vtk(padded.ravel(order="F"), deep=1))
        return grid

    def in_world(self, surface):
        place = self.to_world @ np.diag([*1 / self.spacing, 1]) @ np.vstack(
            [np.column_stack([np.eye(3), -self.spacing]), [0, 0, 0, 1]])
        matrix = vtk.vtkTransform()
        matrix.SetMatrix(place.ravel())
        moved = vtk.vtkTransformPolyDataFilter()
        moved.SetInputData(surface)
        moved.SetTransform(matrix)
        moved.Update()
        return moved.GetOutput()

    @functools.cached_property
    def edges(self):
        edges = vtk.vtkDiscreteFlyingEdges3D()
        edges.SetInputData(self.image())
        edges.SetValue(0, 1)
        edges.Update()
        return edges.GetOutput()

    def slicer(self, smoothing=0.5):
        return self.in_world(sinc(self.edges, 10 ** (-4 * smoothing), 20 + int(40 * smoothing)))

    def away(self, surface):
        """From the label's surface to that of its scan and back, mm."""
        label = self.in_world(self.edges)
        points, back = triangles_of(label)[0], area_samples(surface, 4 * SAMPLES)
        reach = 3 * self.voxel
        inside = np.all((back > points.min(0) - reach) & (back < points.max(0) + reach), axis=1)
        to = Target(surface).distances(area_samples(label, SAMPLES))
        return to.mean(), (to > 2 * self.voxel).mean(), Target(label).distances(back[inside]).mean()

    def nets(self):
        """VTK's surface nets, or None."""
        if not hasattr(vtk, "vtkSurfaceNets3D"):
            return None
        nets = vtk.vtkSurfaceNets3D()
        nets.SetInputData(self.image())
        nets.SetValue(0, 1)
        nets.SetOutputMeshTypeToTriangles()
        nets.Update()
        return self.in_world(nets.GetOutput())

    @functools.cached_property
    def steepness(self):
        """Of the scan, and the way from the world to its voxels."""
        scan = nibabel.load(self.scan)
        return gaussian_gradient_magnitude(np.asarray(scan.dataobj, float), 0.7), np.linalg.inv(LPS @ scan.affine)

    def slope(self, surface):
        """Of the image at the surface, in the median."""
        steepness, to_voxels = self.steepness
        places = to_voxels @ np.c_[area_samples(surface, SAMPLES), np.ones(SAMPLES)].T
        return np.median(map_coordinates(steepness, places[:3], order=1))

    def ours(self, folder, name, with_scan=True):
        """The file of our surface."""
        path = folder / f"{name.replace(' ', '_')}.{'scan' if with_scan else 'alone'}.ply"
        once(path.with_suffix(".json"), "segment", *([self.scan] if with_scan else []), "--labels", self.labels,
             "--label", self.number, "-o", path)
        return path

    def among_all(self, folder):
        """The file of our surface from one run on all labels of the map, with the scan."""
        together = folder / f"{self.labels.name.split('.')[0]}.together"
        together.mkdir(exist_ok=True)
        report = once(together.with_suffix(".json"), "segment", self.scan, "--labels", self.labels,
                      "-o", together / "{label}.ply")
        return next(pathlib.Path(file["path"]) for found, file in zip(report["object"]["surfaces"], report["files"])
                    if found["label"] == self.number)

    def surfaces(self, folder, name):
        yield "with the scan", read_surface(self.ours(folder, name))
        yield "all labels in one run", read_surface(self.among_all(folder))
        yield "label alone", read_surface(self.ours(folder, name, with_scan=False))
        yield "3D Slicer", self.slicer()
        nets = self.nets()
        if nets:
            yield "surface nets", nets


def row(cells):
    print("| " + " | ".join(cells) + " |", flush=True)


def head(*cells):
    row(cells)
    print("|" + "---|" * len(cells))


def figures(found):
    return [str(found["triangles"]), str(found["parts"]), str(found["genus"]), f"{found['creases']:.3f}",
            f"{found['creases_25']:.3f}"]


def measured(name, bone, folder):
    """Each surface of a bone by its kind: looks(), distances to 3D Slicer's, slope over that."""
    theirs = bone.slicer()
    target, slope = Target(theirs), bone.slope(theirs)
    for kind, surface in bone.surfaces(folder, name):
        away = np.concatenate([target.distances(area_samples(surface, SAMPLES)),
                               Target(surface).distances(area_samples(theirs, SAMPLES))]) / bone.voxel
        yield kind, looks(surface, bone.voxel) | {"mean": away.mean(), "most": np.percentile(away, 99),
                                                  "slope": bone.slope(surface) / slope}


def study(name, bone, folder):
    for kind, found in measured(name, bone, folder):
        row([name, kind, *figures(found), *(f"{found[what]:.2f}" for what in ("mean", "most", "slope"))])


def surfaces_of_scan(name, scan, folder):
    """The kind and the file of each surface of a scan, and the voxel."""
    stem = folder / name.replace(" ", "_")
    ours, cubes, local = (stem.with_suffix(end) for end in (".ply", ".cubes.ply", ".local.ply"))
    report = once(ours.with_suffix(".json"), "segment", scan, "-o", ours)
    level, voxel = report["surface"]["level_native"], np.prod(report["input"]["spacing_mm"]) ** (1 / 3)
    once(cubes.with_suffix(".json"), "baseline", scan, "--level", level, "-o", cubes)
    found = {"ours": ours, "flying edges": cubes}
    if name in CTS:
        found["flying edges, local level"] = local
        less = less_local_level(scan, level, stem)
        once(local.with_suffix(".json"), "baseline", less, "--level", 0, "-o", local)
    return found, voxel


def less_local_level(scan, level, stem):
    """The file of a scan less its local levels, in the scan's frame. It is not made again."""
    less = stem.with_suffix(".less.nrrd" if scan.suffix == ".nrrd" else ".less.nii.gz")
    if less.exists():
        return less
    if scan.suffix == ".nrrd":
        volume = read_nrrd(scan)
        write_nrrd(less, dataclasses.replace(volume, values=volume.values - local_level(volume.values, level)))
    else:
        image = nibabel.load(scan)
        values = np.asarray(image.dataobj, np.float32)
        nibabel.save(nibabel.Nifti1Image(values - local_level(values, level), image.affine), less)
    return less


def study_scan(name, case, arguments):
    scan, labels = case
    found, voxel = surfaces_of_scan(name, arguments.scans / scan, arguments.folder)
    bone = Bone(arguments.scans, scan, labels, 1) if labels else None
    for kind, path in found.items():
        surface = read_surface(path)
        away = ("", "", "")
        if bone:
            to, far, back = bone.away(surface)
            away = f"{to:.2f}", f"{100 * far:.1f} %", f"{back:.2f}"
        row([name, kind, *figures(looks(surface, voxel)), *away])


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=pathlib.Path, help="where surfaces and reports stay")
    parser.add_argument("--scans", type=pathlib.Path, required=True, help="the tests' data folder")
    parser.add_argument("--judging", action="store_true")
    parser.add_argument("--no-labels", action="store_true")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    counts = ("triangles", "parts", "genus", "creases", "above 25°")
    if arguments.no_labels:
        head("scan", "surface", *counts, "label to it, mm", "over 2 voxels", "back, mm")
        for name, case in SCANS.items():
            study_scan(name, case, arguments)
        return
    head("bone", "surface", *counts, "to 3D Slicer's", "99 %", "slope")
    for name, case in (JUDGING if arguments.judging else GUIDING).items():
        study(name, Bone(arguments.scans, *case), arguments.folder)


if __name__ == "__main__":
    main()
