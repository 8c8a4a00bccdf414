# SPDX-License-Identifier: Apache-2.0
"""Decimation, distances, remeshing, phantoms."""

import json
import os

import numpy as np

from . import _core
from ._geometry import Mesh, Surface, joined_parts, mesh_parts, object_parts, surface_parts
from ._kept import KeptRun
from ._progress import Follow
from ._result import LabelResult
from ._volume import Volume, is_path, read_scan, scan_of
from ._warnings import warn


def decimate(surface, *, tolerance=None, triangles=None, min_volume=0, keep_largest=0, fill_cavities=False,
             progress=None, threads=0):
    """Removes triangles of a closed surface while it stays within `tolerance` (mm), down to `triangles`.

    `surface` is a path, a result, a Surface or (points, triangles). Islands and cavities below
    `min_volume` (mm^3) go, all but the `keep_largest` islands, and with `fill_cavities` every cavity.

    Returns a Surface. Of several objects, which a LabelResult or the file of a path has, a LabelResult
    without a mesh: each object keeps name, label and colour, and shares triangles as before; `triangles` is
    the number of all, shared ones counted once. `report["surfaces"]` has an entry for each. An object of
    which no part is left goes, with a warning. Raises InputError for surfaces that are not closed.

    >>> import mesamis
    >>> ball = mesamis.phantom_surface("sphere", size=(20, 20, 20))
    >>> fewer = mesamis.decimate(ball, tolerance=0.1)
    >>> len(fewer.triangles) < len(ball.triangles) / 4
    True
    >>> fewer.report["closed"]
    True
    """
    if tolerance is None and triangles is None:
        raise _core.InputError("decimate: expected tolerance or triangles, found neither")
    for name, value in (("tolerance", tolerance), ("triangles", triangles)):
        if value is not None and not value >= 0:
            raise _core.InputError(f"{name}: expected 0 or more, found {value}")
    wanted = {"tolerance": tolerance, "triangles": triangles, "min_volume": min_volume,
              "keep_largest": keep_largest, "fill_cavities": bool(fill_cavities)}
    objects, frame, several, warnings = _closed_objects(surface)
    numbered = [{**o, "label": n} for n, o in enumerate(objects)]
    with Follow(progress) as tell:
        left, reports, more = _core.decimate(numbered, wanted, tell, threads)
    warn([*warnings, *more])
    reports = [json.loads(report) for report in reports]
    if not several:
        return Surface(left[0]["points"] * _turn(frame), left[0]["triangles"], frame, reports[0])
    known = ("name", "label", "layer", "colour")
    left = [{**o, **{key: objects[o["label"]][key] for key in known}} for o in left]
    named = [{"name": o["name"], "label": o["label"], **r} for o, r in zip(left, reports)]
    return LabelResult(KeptRun.of_objects(left, {"surfaces": named}, frame), frame)


def _turn(frame):
    """From a frame to LPS and back."""
    return np.array([-1.0, -1.0, 1.0]) if frame == "ras" else 1.0


def _closed_objects(surface):
    """The objects of whatever is a surface, in LPS as far as is known; its frame; whether they are several;
    warnings."""
    if is_path(surface):
        objects, frame, warnings = _core.read_closed_objects(os.fspath(surface))
        return objects, frame, len(objects) > 1, warnings
    if isinstance(surface, LabelResult):
        objects, frame = object_parts(surface), surface.frame
        return [{**o, "points": o["points"] * _turn(frame)} for o in objects], frame, True, []
    points, triangles, frame = surface_parts(surface)
    one = {"name": "", "label": 1, "colour": (0, 0, 0), "points": np.asarray(points) * _turn(frame),
           "triangles": triangles}
    return [one], frame or None, False, []


def label(surfaces, like, path):
    """Writes closed surfaces as a label map (.nii .nii.gz .nrrd .seg.nrrd) on the grid of a scan.

    `surfaces` is a result of several objects, or a dict of names and surfaces, each a path, a result, a
    Surface or (points, triangles); `like` is the scan: a path or an image. A surface whose frame is not
    known is taken as LPS. Returns label, name and voxels of each.

    >>> import mesamis, os, tempfile
    >>> scan = mesamis.phantom("sphere", size=(20, 20, 20))
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     [row[:2] for row in mesamis.label({"ball": mesamis.phantom_surface("sphere", size=(20, 20, 20))}, scan,
    ...                                       os.path.join(folder, "mask.nii.gz"))]
    [(1, 'ball')]
    """
    if isinstance(surfaces, LabelResult):
        surfaces = {o.name: o for o in surfaces}
    if not isinstance(surfaces, dict):
        raise _core.InputError("surfaces: expected a dict of names and surfaces or a result of several objects, "
                               f"found {type(surfaces).__name__}")
    parts = []
    for name, surface in surfaces.items():
        points, corners, frame = surface_parts(surface)
        turn = np.array([-1.0, -1.0, 1.0]) if frame == "ras" else 1.0
        parts.append((name, np.asarray(points, dtype=float) * turn, corners))
    scan = read_scan(like) if is_path(like) else scan_of(like)[0]
    rows, warnings = _core.label(parts, scan, os.fspath(path))
    warn(warnings)
    return rows


class Comparison:
    """Distances between two surfaces, mm.

    `report` has mean, rms, p95, p99 and max for both directions, of the vertices and by area;
    `surface_to_reference` and `reference_to_surface` are the distances of the vertices. `objects` is a dict
    of names and comparisons: of each object that both surfaces have under this name, with itself.
    """

    def __init__(self, report, to_reference, to_surface, objects=None):
        self.report = report
        self.surface_to_reference = to_reference
        self.reference_to_surface = to_surface
        self.objects = objects or {}

    @property
    def mean(self):
        """By area, the mean of both directions."""
        return sum(self.report[d]["by_area"]["mean"] for d in _DIRECTIONS) / 2

    @property
    def max(self):
        """The greatest of both directions, by area and of the vertices."""
        return max(max(self.report[d]["max"], self.report[d]["by_area"]["max"]) for d in _DIRECTIONS)

    def __repr__(self):
        return f"<mesamis.Comparison mean {self.mean:.4g} mm, max {self.max:.4g} mm>"


_DIRECTIONS = ("surface_to_reference", "reference_to_surface")


def compare(reference, surface, *, frames="auto", box=None, threads=0):
    """Measures the distances between two surfaces, both directions.

    Each is a path, a result, a Surface or (points, triangles). Points of files that state no frame are
    taken as they are; `frames` is "auto", "as-is" or "turned". `box` is (x0, y0, z0, x1, y1, z1): only
    points inside count.

    Several objects, which a LabelResult or the file of a path has, are measured together as one surface,
    and those of one name also on their own: `objects` of the Comparison. A warning names the others.

    >>> import mesamis
    >>> ball = mesamis.phantom_surface("sphere", size=(20, 20, 20))
    >>> c = mesamis.compare(ball, mesamis.decimate(ball, tolerance=0.1))
    >>> 0 < c.mean < c.max < 0.11
    True
    """
    box = None if box is None else np.asarray(box, dtype=float).ravel().tolist()
    if box is not None and (len(box) != 6 or not all(box[a] < box[a + 3] for a in range(3))):
        raise _core.InputError("box: expected x0, y0, z0, x1, y1, z1 with each first below its second")
    report, warnings, whole, parts = _core.compare((_compared(reference, "reference"), _compared(surface, "surface")),
                                                   frames, box, threads)
    warn(warnings)
    report = json.loads(report)
    own = {one["name"]: Comparison(one, *distances) for one, distances in zip(report.get("objects", []), parts)}
    return Comparison(report, *whole, own)


def _compared(surface, name):
    """A surface and its objects, as the module in C++ compares them."""
    objects = object_parts(surface) or []
    if isinstance(surface, LabelResult):
        (points, triangles), frame = joined_parts(objects), surface.frame or ""
    else:
        points, triangles, frame = surface_parts(surface)
    return {"points": points, "triangles": triangles, "frame": frame, "objects": objects,
            "name": os.fspath(surface) if is_path(surface) else name}


def _tensors(metric):
    """A metric as rows xx xy xz yy yz zz."""
    metric = np.asarray(metric, dtype=float)
    if metric.ndim == 1:
        if not (metric > 0).all():
            raise _core.InputError("metric: expected sizes above 0, found others")
        size = 1 / metric**2
        zero = np.zeros_like(size)
        return np.stack([size, zero, zero, size, zero, size], axis=1)
    if metric.ndim == 3 and metric.shape[1:] == (3, 3):
        if not np.allclose(metric, metric.transpose(0, 2, 1), rtol=1e-9, atol=0):
            raise _core.InputError("metric: expected symmetric matrices, found others")
        rows, columns = np.triu_indices(3)
        return metric[:, rows, columns]
    return metric


def remesh(mesh, metric, *, max_tets=None, progress=None, threads=0):
    """Adapts a mesh of a box to a metric at its nodes: edges of the new mesh have length one in it.

    `mesh` is a Mesh, a result or (nodes, tets) that fills its bounding box. `metric` is one size per node
    (mm), one 3 x 3 matrix (1/mm^2), or its six numbers xx xy xz yy yz zz. `max_tets` coarsens the metric
    until about so many are enough.

    >>> import mesamis, numpy as np
    >>> start = mesamis.box_mesh((0, 0, 0), (1, 1, 1), 4)
    >>> fine = mesamis.remesh(start, np.full(len(start.nodes), 0.15))
    >>> bool(len(fine.tets) > 1000 and np.isclose(fine.volumes.sum(), 1))
    True
    """
    nodes, tets, frame = mesh_parts(mesh)
    if max_tets is not None and not max_tets >= 1:
        raise _core.InputError(f"max_tets: expected 1 or more, found {max_tets}")
    with Follow(progress) as tell:
        nodes, tets, report = _core.remesh(nodes, tets, _tensors(metric), int(max_tets or 0), tell, threads)
    report = json.loads(report)
    if not report["converged"]:
        warn([f"remesh: not converged after {report['remesh']['rounds']} rounds; the mesh is valid"])
    return Mesh(nodes, tets, report=report, frame=frame)


def box_mesh(low, high, cells):
    """Fills a box with cubes of six tetrahedra each: `cells` along each axis, one number or three.

    >>> len(box_mesh((0, 0, 0), (1, 1, 1), (1, 2, 3)).tets)
    36
    """
    cells = np.broadcast_to(np.asarray(cells, dtype=int), (3,)).tolist()
    return Mesh(*_core.box_mesh([float(x) for x in low], [float(x) for x in high], cells))


def phantoms():
    """Returns the phantoms: {name: (description, size in voxels of 1 mm)}."""
    return {name: (text, tuple(size)) for name, text, size in _core.phantoms()}


def _grid(size, spacing):
    size = (0, 0, 0) if size is None else np.broadcast_to(np.asarray(size, dtype=int), (3,))
    spacing = np.broadcast_to(np.asarray(spacing, dtype=float), (3,))
    return [int(n) for n in size], spacing.tolist()


def phantom(name, *, size=None, spacing=1.0, blur=1.0, noise=0.0, speckle=0.0, salt_pepper=0.0, pepper=0.0,
            salt=255.0, seed=1, samples=4):
    """Makes a synthetic scan whose surface is known, see `phantom_surface`.

    `size` in voxels and `spacing` in mm along x, y, z; `blur` in voxels; `noise` in grey values; `speckle`
    as a share; `salt_pepper` as a share of voxels. `phantoms()` lists the names.

    >>> phantom("femur", size=(16, 16, 24), spacing=4, noise=10)
    <mesamis.Volume 16 x 16 x 24 voxels of 4 x 4 x 4 mm, LPS>
    """
    wanted = {"blur": blur, "noise": noise, "speckle": speckle, "salt_pepper": salt_pepper, "pepper": pepper,
              "salt": salt, "seed": seed}
    return Volume(_core.phantom(name, *_grid(size, spacing), wanted, samples))


def phantom_surface(name, *, size=None, spacing=1.0):
    """Makes the true surface of a phantom; report["error_max_mm"] bounds its own error."""
    points, triangles, error = _core.phantom_surface(name, *_grid(size, spacing))
    return Surface(points, triangles, "lps", {"error_max_mm": error})
