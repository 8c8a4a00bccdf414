# SPDX-License-Identifier: Apache-2.0
"""Surfaces for other packages: PyVista, trimesh, meshio."""

import html

import numpy as np


def _optional(name, use):
    """Imports a package that is not needed otherwise."""
    try:
        return __import__(name)
    except ImportError as error:
        raise ImportError(f"{use} needs the package {name}: pip install {name}") from error


def significant(value, digits):
    """Decimals with so many significant digits: 0.30, 98.4, 803.

    >>> significant(0.3004, 2), significant(802.71, 3), significant(9.96, 2)
    ('0.30', '803', '10')
    """
    if value == 0 or not np.isfinite(value):
        return f"{value:.{digits - 1}f}"
    rounded = float(f"{value:.{digits - 1}e}")
    return f"{rounded:.{max(0, digits - 1 - int(np.floor(np.log10(abs(rounded)))))}f}"


def size_text(points):
    """The sides of the box around points: "320 x 219 x 98.4 mm"."""
    if not len(points):
        return "empty"
    return " x ".join(significant(side, 3) for side in np.ptp(points, axis=0)) + " mm"


def volume_of(points, triangles):
    """The volume that triangles enclose, mm^3; positive when they face outward."""
    a, b, c = (points[triangles[:, corner]] for corner in range(3))
    return float(np.einsum("ij,ij->", np.cross(a, b), c)) / 6


def table(title, rows):
    """A table for notebooks."""
    escaped = "".join(f"<tr><th style='text-align:left'>{html.escape(name)}</th>"
                      f"<td style='text-align:left'>{html.escape(str(value))}</td></tr>" for name, value in rows)
    return f"<table><caption style='text-align:left'><b>{html.escape(title)}</b></caption>{escaped}</table>"


class Shape:
    """What everything with `points` and `triangles` can become."""

    def _point_arrays(self):
        error = getattr(self, "expected_error", None)
        return {} if error is None or not len(error) else {"expected_error": np.array(error)}

    def to_pyvista(self):
        """The surface as PyVista's PolyData, mm; with the expected error at its points, where it is known."""
        pyvista = _optional("pyvista", "to_pyvista()")
        triangles = np.asarray(self.triangles)
        faces = np.column_stack([np.full(len(triangles), 3), triangles]).ravel()
        data = pyvista.PolyData(np.array(self.points), faces)
        for name, values in self._point_arrays().items():
            data.point_data[name] = values
        return data

    def to_trimesh(self):
        """The surface as a Trimesh of trimesh, mm: its points and triangles, in their order."""
        trimesh = _optional("trimesh", "to_trimesh()")
        return trimesh.Trimesh(np.array(self.points), np.array(self.triangles), process=False,
                               vertex_attributes=self._point_arrays())

    def to_meshio(self):
        """The surface as a Mesh of meshio, mm; with the expected error at its points, where it is known."""
        meshio = _optional("meshio", "to_meshio()")
        return meshio.Mesh(np.array(self.points), [("triangle", np.array(self.triangles))],
                           point_data=self._point_arrays())

    def plot(self, **options):
        """Shows the surface with PyVista; `options` go to its function `plot`."""
        data = self.to_pyvista()
        if "expected_error" in data.point_data:
            options = {"scalars": "expected_error", "cmap": "viridis",
                       "scalar_bar_args": {"title": "expected error, mm"}, **options}
        return data.plot(**{"color": "ivory", "smooth_shading": True, **options})

    def _rows(self):
        points, triangles = np.asarray(self.points), np.asarray(self.triangles)
        rows = [("triangles", f"{len(triangles):,}".replace(",", " ")), ("size", size_text(points)),
                ("volume", significant(volume_of(points, triangles) / 1000, 3) + " cm³")]
        error = self._point_arrays().get("expected_error")
        if error is not None:
            rows.append(("expected error, mean of the points", significant(float(error.mean()), 2) + " mm"))
        return rows

    def _repr_html_(self):
        return table(type(self).__name__, self._rows())
