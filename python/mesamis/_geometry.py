# SPDX-License-Identifier: Apache-2.0
"""Surfaces and meshes as values."""

import os

import numpy as np

from . import _core
from ._shapes import Shape, table


class Surface(Shape):
    """Triangles: `points` (n, 3) in mm and `triangles` (m, 3), indices of points.

    `frame` is "lps", "ras" or None where it is not known; `report` tells how it was made.

    >>> s = Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> len(s.points), len(s.triangles), s.frame
    (3, 1, 'lps')
    """

    def __init__(self, points, triangles, frame="lps", report=None):
        self.points = np.asarray(points, dtype=float)
        self.triangles = np.asarray(triangles)
        self.frame = frame
        self.report = report or {}

    def save(self, path, *, name="mesamis surface", arrays=None):
        """Writes .stl .ply .obj .vtp .3mf .amf; `arrays` are values per point, for .vtp and .ply."""
        from ._files import write_surface

        write_surface(path, self, name=name, arrays=arrays)

    def __repr__(self):
        return f"<mesamis.Surface {len(self.points)} points, {len(self.triangles)} triangles>"


class Mesh:
    """Tetrahedra: `nodes` (n, 3) in mm and `tets` (m, 4), indices of nodes.

    `point_arrays` and `cell_arrays` are dicts of values per node and per tetrahedron. `frame` is "lps"
    or "ras".
    """

    def __init__(self, nodes, tets, point_arrays=None, cell_arrays=None, report=None, frame="lps"):
        self.nodes = np.asarray(nodes, dtype=float)
        self.tets = np.asarray(tets)
        self.point_arrays = dict(point_arrays or {})
        self.cell_arrays = dict(cell_arrays or {})
        self.report = report or {}
        self.frame = frame

    @property
    def volumes(self):
        """The volume of each tetrahedron, mm^3.

        >>> import mesamis
        >>> float(mesamis.box_mesh((0, 0, 0), (2, 3, 4), 2).volumes.sum())
        24.0
        """
        a, b, c, d = (self.nodes[self.tets[:, corner]] for corner in range(4))
        return np.einsum("ij,ij->i", np.cross(b - a, c - a), d - a) / 6

    def to_meshio(self):
        """The mesh as a Mesh of meshio, with its arrays."""
        import meshio

        cells = {name: [np.asarray(values)] for name, values in self.cell_arrays.items()}
        return meshio.Mesh(np.array(self.nodes), [("tetra", np.array(self.tets))],
                           point_data={name: np.asarray(v) for name, v in self.point_arrays.items()},
                           cell_data=cells)

    def to_pyvista(self):
        """The mesh as PyVista's UnstructuredGrid, with its arrays."""
        import pyvista

        data = pyvista.UnstructuredGrid({pyvista.CellType.TETRA: np.array(self.tets)}, np.array(self.nodes))
        data.point_data.update({name: np.asarray(v) for name, v in self.point_arrays.items()})
        data.cell_data.update({name: np.asarray(v) for name, v in self.cell_arrays.items()})
        return data

    def _repr_html_(self):
        return table("Mesh", [("nodes", len(self.nodes)), ("tetrahedra", len(self.tets))])

    def save(self, path):
        """Writes .vtu, with the arrays, or Medit's .mesh."""
        from ._files import write_mesh

        write_mesh(path, self)

    def __repr__(self):
        return f"<mesamis.Mesh {len(self.nodes)} nodes, {len(self.tets)} tetrahedra>"


def _frame_of(shape):
    """"lps", "ras" or None, as segment() takes them; refuses other texts."""
    frame = getattr(shape, "frame", "lps")
    if frame is not None:
        _core.require_frame(frame)
    return frame


def surface_parts(surface):
    """Points, triangles and frame ("": not known) of whatever is a surface."""
    if isinstance(surface, (str, os.PathLike)):
        points, triangles, frame = _core.read_surface(os.fspath(surface))
        return points, triangles, frame or ""
    if isinstance(surface, tuple) and len(surface) == 2:
        return surface[0], surface[1], "lps"
    if hasattr(surface, "triangles") and hasattr(surface, "points"):
        return surface.points, surface.triangles, _frame_of(surface) or ""
    if hasattr(surface, "cells_dict") and "triangle" in surface.cells_dict:  # meshio
        return surface.points, surface.cells_dict["triangle"], ""
    raise _core.InputError(
        f"surface: expected a path, a result, a Surface or (points, triangles), found {type(surface).__name__}")


def object_parts(surface):
    """What is several objects: dicts of them as the module in C++ takes them, their points in the frame of
    the surface. None of what is one."""
    if isinstance(surface, (str, os.PathLike)):
        objects, _ = _core.read_objects(os.fspath(surface))
        return objects if len(objects) > 1 else None
    if isinstance(getattr(surface, "objects", None), list):  # a LabelResult
        return [vars(o) for o in surface.objects]
    return None


def joined_parts(objects):
    """Points and triangles of several objects as of one surface."""
    starts = np.cumsum([0, *(len(o["points"]) for o in objects)])
    return (np.concatenate([o["points"] for o in objects]),
            np.concatenate([o["triangles"] + s for o, s in zip(objects, starts)]))


def mesh_parts(mesh):
    """Nodes, tetrahedra and frame of whatever is a mesh."""
    if isinstance(mesh, tuple) and len(mesh) == 2:
        return *mesh, "lps"
    if hasattr(mesh, "nodes") and hasattr(mesh, "tets"):
        return mesh.nodes, mesh.tets, _frame_of(mesh) or "lps"
    if hasattr(mesh, "cells_dict") and "tetra" in mesh.cells_dict:  # meshio
        space = bytes(np.asarray(mesh.field_data.get("SPACE", ()), dtype=np.uint8))
        return mesh.points, mesh.cells_dict["tetra"], "ras" if space == b"RAS" else "lps"
    raise _core.InputError(
        f"mesh: expected a Mesh, a result or (nodes, tets), found {type(mesh).__name__}")
