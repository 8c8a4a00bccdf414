# SPDX-License-Identifier: Apache-2.0
"""What a call of segment returns."""

import json
import os
import tempfile
import webbrowser

import numpy as np

from ._kept import KeptRun, state_of
from ._shapes import Shape, significant, table

PAGE_FORMATS = (".html", ".htm")
MESH_FORMATS = (".vtu", ".mesh", ".msh", ".inp")


def _extension(path):
    return os.path.splitext(os.fspath(path))[1].lower()


def _write_json(path, value):
    """The file appears whole or not at all."""
    folder = os.path.dirname(os.fspath(path)) or "."
    handle, temporary = tempfile.mkstemp(dir=folder, prefix=".mesamis-")
    try:
        with os.fdopen(handle, "w", encoding="utf-8") as file:
            json.dump(value, file, indent=2, ensure_ascii=False)
            file.write("\n")
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException:
        os.unlink(temporary)
        raise


class _AnyResult:
    """What results of one object and of several have in common."""

    def __init__(self, run, frame):
        self._run = run
        self._report = None
        self.frame = frame

    def _turned(self, points):
        turns = self.frame == "ras" and points is not None
        return points * np.array([-1.0, -1.0, 1.0]) if turns else points

    @property
    def report(self):
        """The run's report, as the program writes it with --report."""
        if self._report is None:
            self._report = json.loads(self._run.report())
        return self._report

    @property
    def warnings(self):
        """What was warned of, a line each."""
        return [*self._run.warnings, *([self._run.flaw] if self._run.flaw else [])]

    @property
    def notes(self):
        """What was done to the scan unasked, a line each: padding filled, a table removed."""
        return list(self._run.notes)

    def __getstate__(self):
        return {"frame": self.frame, "run": state_of(self._run, self.report)}

    def __setstate__(self, state):
        self.frame, self._report = state["frame"], state["run"]["report"]
        self._run = KeptRun({**state["run"], "frame": self.frame})

    def _plot_page(self):
        """Opens the page of the run in a browser."""
        folder = tempfile.mkdtemp(prefix="mesamis-")
        path = os.path.join(folder, "result.html")
        self.save(path)
        webbrowser.open("file://" + path)
        return path

    def _save(self, path, name, error, region, bins, patient):
        """Writes what the extension decides: report, page, mesh or surface."""
        extension = _extension(path)
        if extension == ".json":
            _write_json(path, self.report)
        elif extension in PAGE_FORMATS:
            self._run.save_page(path)
        elif extension in MESH_FORMATS:
            self._run.save_mesh(path, region, int(bins))
        else:
            self._run.save_surface(path, name, bool(error), bool(patient))

    def save_labelmap(self, path):
        """Writes what was found, voxel by voxel: .nii .nii.gz .nrrd .seg.nrrd."""
        self._run.save_labelmap(os.fspath(path))

    @property
    def nodes(self):
        """The mesh's nodes, (n, 3), mm; none for a preview, nor of labels without mesh=True. The
        same is true of the tetrahedra and fields."""
        return self._turned(self._run.nodes)

    @property
    def tets(self):
        """The mesh's tetrahedra, (m, 4) indices of nodes."""
        return self._run.tets

    @property
    def u(self):
        """The denoised image at the nodes, grey values."""
        return self._run.u

    @property
    def v(self):
        """The edge indicator at the nodes: 0 at edges, 1 elsewhere."""
        return self._run.v


class Result(_AnyResult, Shape):
    """The result of `segment` for one object. Arrays share the library's memory and cannot be
    written to; with `frame="ras"` points and metric are turned copies."""

    @property
    def points(self):
        """The surface's points, (n, 3), mm."""
        return self._turned(self._run.objects[0]["points"])

    @property
    def triangles(self):
        """The surface's triangles, (m, 3) indices of points, outward."""
        return self._run.objects[0]["triangles"]

    @property
    def expected_error(self):
        """How far each point is expected to lie from the truth, mm; empty for a band."""
        return self._run.objects[0]["expected_error"]

    @property
    def f(self):
        """The scan at the nodes, grey values."""
        return self._run.f

    @property
    def metric(self):
        """The metric that the mesh was made for, at the nodes, 1/mm^2: xx xy xz yy yz zz."""
        metric = self._run.metric
        return metric if self.frame == "lps" else metric * np.array([1.0, 1, -1, 1, -1, 1])

    @property
    def level(self):
        """The level of the surface, native units of the scan: of the object as a whole, also where places of a
        CT have levels of their own (report['surface']['level_range_native']); None of a range of values."""
        return self._run.level

    @property
    def converged(self):
        return self._run.converged

    @property
    def stopped(self):
        """The time limit came first."""
        return self._run.stopped

    @property
    def closed(self):
        return self._run.closed

    def save(self, path, *, name="mesamis surface", error=False, region="box", bins=10, band=False,
             patient=False):
        """Writes the surface (.stl .ply .obj .vtp .3mf .amf .glb .dcm), the mesh (.vtu .mesh .msh .inp), the
        page to look at in a browser (.html) or the report (.json): the extension decides. Surfaces and meshes
        have the bytes of the program.

        `error` adds the expected error to a .vtp or .ply. Of the mesh, `region` is "box" or "object",
        `bins` the number of sets of cells; `band` writes the cells near edges with v alone (.vtu).
        `patient` copies patient, study and frame of reference of a scan in DICOM into a .dcm.
        """
        path = os.fspath(path)
        if band and _extension(path) not in (".json", *PAGE_FORMATS):
            self._run.save_band(path)
        else:
            self._save(path, name, error, region, bins, patient)

    def plot(self, **options):
        """Shows the surface: with PyVista, whose function `plot` takes the options, or, where that is not
        installed, the page of the run in a browser; its path is then returned."""
        try:
            import pyvista  # noqa: F401
        except ImportError:
            return self._plot_page()
        return super().plot(**options)

    def _rows(self):
        rows = [row for row in super()._rows() if not row[0].startswith("expected")]
        error = (self.report.get("quality") or {}).get("expected_error_mm") or {}
        if error.get("mean"):
            rows.append(("expected error, mean", significant(error["mean"], 2) + " mm"))
        level = [] if self.level is None else [("level", significant(self.level, 4))]
        return [*rows, ("closed", "yes" if self.closed else "no"), *level, ("tetrahedra", len(self._run.tets))]

    def __repr__(self):
        level = "" if self.level is None else f", level {self.level:.6g}"
        return f"<mesamis.Result {len(self.triangles)} triangles, {len(self._run.tets)} tetrahedra{level}>"


class Object(Shape):
    """One object of a label map: `name`, `label`, `layer`, `colour` (red, green, blue), `points`,
    `triangles`, `expected_error`."""

    def __init__(self, values, turned, frame):
        self.name = values["name"]
        self.label = values["label"]
        self.layer = values["layer"]
        self.colour = values["colour"]
        self.points = turned(values["points"])
        self.triangles = values["triangles"]
        self.expected_error = values["expected_error"]
        self.frame = frame

    def save(self, path, *, name=None, error=False):
        """Writes the object's surface alone: .stl .ply .obj .vtp .3mf .amf .glb .dcm. `name` is what the file
        calls it (default: its own name); `error` adds the expected error to a .vtp or .ply."""
        from ._files import write_surface

        arrays = self._point_arrays() if error else None
        write_surface(path, self, name=self.name if name is None else name, arrays=arrays)

    def __repr__(self):
        return f"<mesamis.Object {self.name!r}, label {self.label}, {len(self.triangles)} triangles>"


class LabelResult(_AnyResult):
    """The result of `segment` or `decimate` for several objects: iterate over it, or ask for one by
    name or label. Of `decimate` it has surfaces and report alone; `frame` is None where a file states none."""

    @property
    def objects(self):
        """The objects, in the order chosen."""
        return [Object(values, self._turned, self.frame) for values in self._run.objects]

    def __iter__(self):
        return iter(self.objects)

    def __len__(self):
        return len(self._run.objects)

    def __getitem__(self, key):
        for o in self.objects:
            if key in (o.name, o.label):
                return o
        raise KeyError(key)

    def save(self, path, *, name="mesamis surface", error=False, region="box", bins=10, patient=False):
        """Writes all objects into one file (.3mf .vtp .obj .amf .glb), one file per object ({label} in
        the name, or a format of one object), the mesh, the page (.html), or the report. `patient` is as for
        Result. One object alone: `result["hip"].save("hip.stl")`."""
        self._save(os.fspath(path), name, error, region, bins, patient)

    def to_pyvista(self):
        """The surfaces as PyVista's MultiBlock, a PolyData for each object under its name."""
        import pyvista

        return pyvista.MultiBlock({o.name: o.to_pyvista() for o in self.objects})

    def to_trimesh(self):
        """The surfaces as a Scene of trimesh, a Trimesh for each object under its name."""
        import trimesh

        return trimesh.Scene({o.name: o.to_trimesh() for o in self.objects})

    def to_meshio(self):
        """The surfaces as one Mesh of meshio; the cell data "label" says which object a triangle belongs to."""
        import meshio

        objects = self.objects
        starts = np.cumsum([0, *(len(o.points) for o in objects)])
        triangles = np.concatenate([o.triangles + s for o, s in zip(objects, starts)])
        labels = np.concatenate([np.full(len(o.triangles), o.label) for o in objects])
        return meshio.Mesh(np.concatenate([o.points for o in objects]), [("triangle", triangles)],
                           cell_data={"label": [labels]})

    def plot(self, **options):
        """Shows the surfaces in their colours: with PyVista, whose Plotter takes the options, or, where that
        is not installed, the page of the run in a browser; its path is then returned."""
        try:
            import pyvista
        except ImportError:
            return self._plot_page()
        plotter = pyvista.Plotter(**options)
        for o in self.objects:
            plotter.add_mesh(o.to_pyvista(), color=[c / 255 for c in o.colour], label=o.name, smooth_shading=True)
        return plotter.show()

    def _repr_html_(self):
        rows = [(o.name, ", ".join(str(value) for _, value in o._rows()[1:])) for o in self.objects]
        return table(f"{len(rows)} objects: size, volume, expected error", rows)

    def __repr__(self):
        return f"<mesamis.LabelResult {', '.join(o.name for o in self.objects)}>"


def result_of(run, frame):
    return (LabelResult if run.several else Result)(run, frame)
