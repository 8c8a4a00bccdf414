# SPDX-License-Identifier: Apache-2.0
"""Files of surfaces and meshes."""

import os

import numpy as np

from . import _core
from ._geometry import Mesh, Surface, mesh_parts, surface_parts


def read_surface(path):
    """Reads .stl .ply .obj .vtp .3mf .amf .vtk, or STL and OBJ in DICOM; coordinates as in the file, with the frame it states."""
    points, triangles, frame = _core.read_surface(os.fspath(path))
    return Surface(points, triangles, frame)


def write_surface(path, surface, *, frame=None, name="mesamis surface", arrays=None, patient=None):
    """Writes a surface: .stl .ply .obj .vtp .3mf .amf .glb, .dcm (STL in DICOM).

    `surface` is a Surface, a result or (points, triangles). Its points are written as they are;
    `frame` is what the file states instead of the surface's own. `arrays` is a dict of values per
    point, for .vtp and .ply. A .dcm names no patient unless `patient`, a Volume read from DICOM, gives
    patient, study and frame of reference. The file appears whole or not at all.
    """
    points, triangles, own = surface_parts(surface)
    values = {key: np.asarray(v, dtype=float) for key, v in (arrays or {}).items()}
    scan = None if patient is None else patient._scan
    _core.write_surface(os.fspath(path), (points, triangles), own if frame is None else frame,
                        (name, values), scan)


_TURNS = {3: np.array([-1.0, -1, 1]), 6: np.array([1.0, 1, 1, 1, -1, -1])}


def _in_lps(values, frame):
    """Vectors, and tensors xx yy zz xy yz xz, of a frame in LPS, from which the writer turns them back."""
    values = np.asarray(values, dtype=float)
    turns = frame == "ras" and values.ndim == 2 and values.shape[1] in _TURNS
    return values * _TURNS[values.shape[1]] if turns else values


def read_mesh(path):
    """Reads the tetrahedra and the arrays of a .vtu, or Medit's .mesh."""
    nodes, tets, point_arrays, cell_arrays = _core.read_mesh(os.fspath(path))
    return Mesh(nodes, tets, point_arrays, cell_arrays)


def write_mesh(path, mesh, *, point_arrays=None, cell_arrays=None):
    """Writes tetrahedra: .vtu, with arrays, or Medit's .mesh, without.

    `mesh` is a Mesh, whose arrays are written too, a result or (nodes, tets). Nodes and arrays are written
    as they are, and a .vtu states their frame.
    """
    nodes, tets, frame = mesh_parts(mesh)
    points = {**getattr(mesh, "point_arrays", {}), **(point_arrays or {})}
    cells = {**getattr(mesh, "cell_arrays", {}), **(cell_arrays or {})}
    arrays = [{key: _in_lps(v, frame) for key, v in of.items()} for of in (points, cells)]
    _core.write_mesh(os.fspath(path), _in_lps(nodes, frame), tets, frame, arrays)
