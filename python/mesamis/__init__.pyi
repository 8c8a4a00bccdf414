# SPDX-License-Identifier: Apache-2.0
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, Literal, NamedTuple

import numpy as np
import numpy.typing as npt

__version__: str

_Path = str | os.PathLike[str]
_Doubles = npt.NDArray[np.float64]
_Indices = npt.NDArray[np.int32]
_Frame = Literal["lps", "ras"]
_Progress = Callable[[str, float], object] | bool
_Triple = float | Sequence[float]
_Box = str | Sequence[tuple[float | None, float | None] | None]
_Surface = Any  # a path, a result, a Surface, an object with points and triangles, or (points, triangles)
_Mesh = Any  # a Mesh, a result, a mesh of meshio, or (nodes, tets)

class InputError(ValueError):
    """An argument or a file that cannot be used; one line says what, where, expected and found."""
class NumericalError(RuntimeError):
    """A promise that could not be kept: a solve that broke down, an invalid mesh."""
class Cancelled(RuntimeError):
    """The progress function returned False."""
class MesamisWarning(UserWarning):
    """What may not be what was meant, or a promise that a run did not keep."""

class Setting(NamedTuple):
    """A row of the table of settings."""
    name: str
    group: str
    form: str
    default: str
    unit: str
    help: str
    automatic: str
    paper: str
    numbers: int
    whole: bool
    ranges: bool
    words: tuple[str, ...]
    switch: bool

class _Shape:
    """What everything with `points` and `triangles` can become."""
    def to_pyvista(self) -> Any:
        """The surface as PyVista's PolyData, mm; with the expected error at its points, where it is known."""
    def to_trimesh(self) -> Any:
        """The surface as a Trimesh of trimesh, mm: its points and triangles, in their order."""
    def to_meshio(self) -> Any:
        """The surface as a Mesh of meshio, mm; with the expected error at its points, where it is known."""
    def plot(self, **options: Any) -> Any:
        """Shows the surface with PyVista; `options` go to its function `plot`."""

class Volume:
    """A scan in memory: what `read_volume` and `phantom` return, and `segment` takes.

    >>> import mesamis
    >>> v = mesamis.phantom("sphere", size=(20, 21, 22), spacing=(1, 1, 2))
    >>> v.array.shape, v.spacing, v.orientation
    ((20, 21, 22), (1.0, 1.0, 2.0), 'LPS')
    """
    @property
    def array(self) -> npt.NDArray[np.float32]:
        """The samples with axes i, j, k (i runs fastest in memory); shared, not to be written to."""
    @property
    def spacing(self) -> tuple[float, float, float]:
        """Distances of voxels along i, j, k, mm."""
    @property
    def origin(self) -> tuple[float, float, float]:
        """The centre of voxel (0, 0, 0), LPS, mm."""
    @property
    def direction(self) -> _Doubles:
        """Column k is the direction of axis k, LPS."""
    @property
    def affine(self) -> _Doubles:
        """The matrix from voxel indices to RAS, mm, as nibabel has it."""
    @property
    def modality(self) -> str:
        """"CT", "MR", ... as the file says; empty: unknown."""
    @property
    def orientation(self) -> str:
        """The sides of the body that the axes run towards, "RAS"."""
    @property
    def format(self) -> str:
        """The format of its file, or what made it."""
    @property
    def warnings(self) -> list[str]:
        """What the reader had to say, a line each."""

class Surface(_Shape):
    """Triangles: `points` (n, 3) in mm and `triangles` (m, 3), indices of points.

    `frame` is "lps", "ras" or None where it is not known; `report` tells how it was made.

    >>> s = Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> len(s.points), len(s.triangles), s.frame
    (3, 1, 'lps')
    """
    points: _Doubles
    triangles: npt.NDArray[Any]
    frame: _Frame | None
    report: dict[str, Any]
    def __init__(
        self,
        points: npt.ArrayLike,
        triangles: npt.ArrayLike,
        frame: _Frame | None = ...,
        report: dict[str, Any] | None = ...,
    ) -> None: ...
    def save(
        self, path: _Path, *, name: str = ..., arrays: Mapping[str, npt.ArrayLike] | None = ...
    ) -> None:
        """Writes .stl .ply .obj .vtp .3mf .amf; `arrays` are values per point, for .vtp and .ply."""

class Mesh:
    """Tetrahedra: `nodes` (n, 3) in mm and `tets` (m, 4), indices of nodes.

    `point_arrays` and `cell_arrays` are dicts of values per node and per tetrahedron. `frame` is "lps"
    or "ras".
    """
    nodes: _Doubles
    tets: npt.NDArray[Any]
    point_arrays: dict[str, Any]
    cell_arrays: dict[str, Any]
    report: dict[str, Any]
    frame: _Frame
    def __init__(
        self,
        nodes: npt.ArrayLike,
        tets: npt.ArrayLike,
        point_arrays: Mapping[str, npt.ArrayLike] | None = ...,
        cell_arrays: Mapping[str, npt.ArrayLike] | None = ...,
        report: dict[str, Any] | None = ...,
        frame: _Frame = ...,
    ) -> None: ...
    @property
    def volumes(self) -> _Doubles:
        """The volume of each tetrahedron, mm^3.

        >>> import mesamis
        >>> float(mesamis.box_mesh((0, 0, 0), (2, 3, 4), 2).volumes.sum())
        24.0
        """
    def to_meshio(self) -> Any:
        """The mesh as a Mesh of meshio, with its arrays."""
    def to_pyvista(self) -> Any:
        """The mesh as PyVista's UnstructuredGrid, with its arrays."""
    def save(self, path: _Path) -> None:
        """Writes .vtu, with the arrays, or Medit's .mesh."""

class _AnyResult:
    """What results of one object and of several have in common."""
    frame: _Frame | None
    @property
    def report(self) -> dict[str, Any]:
        """The run's report, as the program writes it with --report."""
    @property
    def warnings(self) -> list[str]:
        """What was warned of, a line each."""
    @property
    def notes(self) -> list[str]:
        """What was done to the scan unasked, a line each: padding filled, a table removed."""
    def save_labelmap(self, path: _Path) -> None:
        """Writes what was found, voxel by voxel: .nii .nii.gz .nrrd .seg.nrrd."""
    @property
    def nodes(self) -> _Doubles:
        """The mesh's nodes, (n, 3), mm; none for a preview, nor of labels without mesh=True. The
        same is true of the tetrahedra and fields.
        """
    @property
    def tets(self) -> _Indices:
        """The mesh's tetrahedra, (m, 4) indices of nodes."""
    @property
    def u(self) -> _Doubles:
        """The denoised image at the nodes, grey values."""
    @property
    def v(self) -> _Doubles:
        """The edge indicator at the nodes: 0 at edges, 1 elsewhere."""

class Result(_AnyResult, _Shape):
    """The result of `segment` for one object. Arrays share the library's memory and cannot be
    written to; with `frame="ras"` points and metric are turned copies.
    """
    @property
    def points(self) -> _Doubles:
        """The surface's points, (n, 3), mm."""
    @property
    def triangles(self) -> _Indices:
        """The surface's triangles, (m, 3) indices of points, outward."""
    @property
    def expected_error(self) -> _Doubles:
        """How far each point is expected to lie from the truth, mm; empty for a band."""
    @property
    def f(self) -> _Doubles:
        """The scan at the nodes, grey values."""
    @property
    def metric(self) -> _Doubles:
        """The metric that the mesh was made for, at the nodes, 1/mm^2: xx xy xz yy yz zz."""
    @property
    def level(self) -> float | None:
        """The level of the surface, native units of the scan: of the object as a whole, also where places of a
        CT have levels of their own (report['surface']['level_range_native']); None of a range of values.
        """
    @property
    def converged(self) -> bool: ...
    @property
    def stopped(self) -> bool:
        """The time limit came first."""
    @property
    def closed(self) -> bool: ...
    def save(
        self,
        path: _Path,
        *,
        name: str = ...,
        error: bool = ...,
        region: Literal["box", "object"] = ...,
        bins: int = ...,
        band: bool = ...,
        patient: bool = ...,
    ) -> None:
        """Writes the surface (.stl .ply .obj .vtp .3mf .amf .glb .dcm), the mesh (.vtu .mesh .msh .inp), the
        page to look at in a browser (.html) or the report (.json): the extension decides. Surfaces and meshes
        have the bytes of the program.

        `error` adds the expected error to a .vtp or .ply. Of the mesh, `region` is "box" or "object",
        `bins` the number of sets of cells; `band` writes the cells near edges with v alone (.vtu).
        `patient` copies patient, study and frame of reference of a scan in DICOM into a .dcm.
        """

class Object(_Shape):
    """One object of a label map: `name`, `label`, `layer`, `colour` (red, green, blue), `points`,
    `triangles`, `expected_error`.
    """
    name: str
    label: int
    layer: int
    colour: tuple[int, int, int]
    points: _Doubles
    triangles: _Indices
    expected_error: _Doubles
    frame: _Frame | None
    def save(self, path: _Path, *, name: str | None = ..., error: bool = ...) -> None:
        """Writes the object's surface alone: .stl .ply .obj .vtp .3mf .amf .glb .dcm. `name` is what the file
        calls it (default: its own name); `error` adds the expected error to a .vtp or .ply.
        """

class LabelResult(_AnyResult):
    """The result of `segment` or `decimate` for several objects: iterate over it, or ask for one by
    name or label. Of `decimate` it has surfaces and report alone; `frame` is None where a file states none.
    """
    def to_pyvista(self) -> Any:
        """The surfaces as PyVista's MultiBlock, a PolyData for each object under its name."""
    def to_trimesh(self) -> Any:
        """The surfaces as a Scene of trimesh, a Trimesh for each object under its name."""
    def to_meshio(self) -> Any:
        """The surfaces as one Mesh of meshio; the cell data "label" says which object a triangle belongs to."""
    def plot(self, **options: Any) -> Any:
        """Shows the surfaces in their colours: with PyVista, whose Plotter takes the options, or, where that
        is not installed, the page of the run in a browser; its path is then returned.
        """
    @property
    def objects(self) -> list[Object]:
        """The objects, in the order chosen."""
    def __iter__(self) -> Iterator[Object]: ...
    def __len__(self) -> int: ...
    def __getitem__(self, key: str | int) -> Object: ...
    def save(
        self,
        path: _Path,
        *,
        name: str = ...,
        error: bool = ...,
        region: Literal["box", "object"] = ...,
        bins: int = ...,
        patient: bool = ...,
    ) -> None:
        """Writes all objects into one file (.3mf .vtp .obj .amf .glb), one file per object ({label} in
        the name, or a format of one object), the mesh, the page (.html), or the report. `patient` is as for
        Result. One object alone: `result["hip"].save("hip.stl")`.
        """

class Body:
    """Elements for a solver: `nodes` (n, 3) in mm, `elements` (m, 4) or (m, 10), `part` and `material` of
    each element (from 0; empty without materials), `materials` (name, modulus in MPa, Poisson's ratio,
    density in g/cm^3), `sets` (name: nodes of its faces), `report`.
    """
    frame: _Frame
    report: dict[str, Any]
    @property
    def nodes(self) -> _Doubles: ...
    @property
    def elements(self) -> _Indices: ...
    @property
    def part(self) -> _Indices: ...
    @property
    def material(self) -> _Indices: ...
    @property
    def materials(self) -> list[tuple[str, float, float, float]]: ...
    @property
    def sets(self) -> dict[str, _Indices]: ...
    @property
    def warnings(self) -> list[str]:
        """What was warned of, a line each: promises that it misses."""
    def save(self, path: _Path) -> None:
        """Writes .inp (Abaqus, CalculiX), .feb (FEBio), .msh (Gmsh), .vtu or Medit's .mesh."""

class Comparison:
    """Distances between two surfaces, mm.

    `report` has mean, rms, p95, p99 and max for both directions, of the vertices and by area;
    `surface_to_reference` and `reference_to_surface` are the distances of the vertices. `objects` is a dict
    of names and comparisons: of each object that both surfaces have under this name, with itself.
    """
    report: dict[str, Any]
    surface_to_reference: _Doubles
    reference_to_surface: _Doubles
    objects: dict[str, Comparison]
    @property
    def mean(self) -> float:
        """By area, the mean of both directions."""
    @property
    def max(self) -> float:
        """The greatest of both directions, by area and of the vertices."""

def segment(
    volume: Any = ...,
    *,
    affine: npt.ArrayLike | None = ...,
    spacing: _Triple | None = ...,
    origin: Sequence[float] | None = ...,
    direction: npt.ArrayLike | None = ...,
    order: Literal["ijk", "zyx"] | None = ...,
    modality: str | None = ...,
    labels: Any = ...,
    label: str | int | Sequence[str | int] | None = ...,
    label_names: _Path | Mapping[int, str] | None = ...,
    margin: float | None = ...,
    mesh: bool = ...,
    tissue: str | None = ...,
    mask: Any = ...,
    seeds: npt.ArrayLike | None = ...,
    box: _Box | None = ...,
    remove: Any = ...,
    keep_surroundings: bool = ...,
    frame: _Frame = ...,
    preset: str = ...,
    settings_file: _Path | None = ...,
    series: str | None = ...,
    resample: bool = ...,
    volume_number: int | None = ...,
    channel: int | None = ...,
    padding: Literal["auto", "none"] | float | None = ...,
    progress: _Progress | None = ...,
    threads: int = ...,
    memory: float = ...,
    time_limit: float | None = ...,
    # settings, by write_stubs.py
    crop: str | Sequence[tuple[int | None, int | None] | None] | None = ...,
    stride: Literal["auto"] | int | Sequence[int] | None = ...,
    window: Literal["auto"] | Sequence[float] | None = ...,
    threshold: Literal["auto", "none", "paper"] | float | None = ...,
    restore: bool | None = ...,
    noise: Literal["auto"] | float | None = ...,
    blur: Literal["auto", "none"] | float | Sequence[float] | None = ...,
    length_unit: Literal["voxel", "mm"] | None = ...,
    epsilon: float | None = ...,
    eta: Literal["auto"] | float | None = ...,
    beta: float | None = ...,
    gamma: Literal["auto"] | float | None = ...,
    amis_iterations: int | None = ...,
    tol_v: float | None = ...,
    solver_tolerance: float | None = ...,
    max_tets: Literal["auto"] | int | None = ...,
    tau: float | None = ...,
    adaptations: int | None = ...,
    tol_mesh: float | None = ...,
    tol_energy: float | None = ...,
    until: Literal["surface", "energy", "either"] | None = ...,
    drafts: bool | None = ...,
    max_stretch: float | None = ...,
    gradation: float | None = ...,
    h_min: float | None = ...,
    h_max: Literal["auto"] | float | None = ...,
    surface: Literal["solid", "band"] | None = ...,
    level: Literal["auto", "local"] | float | None = ...,
    follow: bool | None = ...,
    fit: bool | None = ...,
    keep_topology: bool | None = ...,
    band_threshold: float | None = ...,
    min_volume: Literal["auto"] | float | None = ...,
    keep_largest: int | None = ...,
    fill_cavities: bool | None = ...,
    accuracy: Literal["auto"] | float | None = ...,
    tolerance: Literal["auto", "none"] | float | None = ...,
    preview: bool | None = ...,
    triangles: Literal["auto"] | int | None = ...,
    # end of settings
) -> Any:
    """Segments a scan: a closed surface and a mesh that follows the image.

    The same scan gives the same bytes, whatever it is given as, and those of the program.

    Parameters
    ----------
    volume
        A path; a `Volume`; an image of nibabel (its axes i, j, k, its affine RAS) or SimpleITK (its
        axes z, y, x, its frame LPS); or an array with `affine` or `spacing`. None: labels alone.
    affine
        The 4 x 4 matrix from voxel indices to RAS, mm, as of nibabel. The array's axes are i, j, k.
    spacing, origin, direction
        As of SimpleITK: along x, y, z, LPS, mm. The array's axes are z, y, x. Of a path, `spacing`
        is taken instead of the file's.
    order
        "ijk" or "zyx": the order of the array's axes, where it is not the one above.
    modality
        "CT", "MR": what an array is; CT is also recognised by its values. Of a path also "other"; it is
        taken instead of the file's.
    series, resample, volume_number, channel
        Of a path, as `read_volume` has them.
    padding
        What the scanner did not measure, which is filled: "auto" (found by its signs), "none", or a value.
    labels, label, label_names, margin, mesh
        A label map (path, image, or array of the scan's shape) that says which objects are meant;
        which of them, by name or number; their names, {number: name} or a path; how far they may be
        wrong, mm; whether to make a mesh too. The result is then a `LabelResult`. Without `volume`, an
        array needs `affine` or `spacing`, and of a path `spacing` and `resample` are as of a scan's.
    tissue, mask, seeds, box, remove, keep_surroundings
        Which object is meant: a tissue ("bone", "airway", ..., "LO:HI"); a label map around it; points
        (mm, in the frame) of its islands; the part of the scan, ((x0, x1), (y0, y1), (z0, z1)), mm;
        "body" or a label map of what goes; whether the table stays.
    frame
        "lps" or "ras": of points, seeds, boxes and files.
    preset, settings_file
        What the settings start from.
    progress
        True: a bar of the whole run with the time left, of tqdm where that is installed, else a line for each
        stage. Or a function, called as progress(stage, fraction); if it returns False, `Cancelled` is raised.
    threads, memory, time_limit
        At most so many threads, GB and seconds.

    Returns
    -------
    Result, or LabelResult for labels and for several seeds.

    Raises
    ------
    InputError (a ValueError), NumericalError (a RuntimeError), Cancelled, KeyboardInterrupt.

    >>> import mesamis, numpy as np
    >>> k, j, i = np.mgrid[:20, :22, :24]
    >>> ball = 100 / (1 + np.exp(3 * (np.hypot(np.hypot(i - 11, j - 10), k - 9) - 6)))
    >>> result = mesamis.segment(ball, spacing=(1, 1, 1), preview=True)
    >>> bool(abs(np.ptp(result.points, axis=0) - 12).max() < 1)
    True
    """
def settings() -> list[Setting]:
    """Returns the table of settings: every keyword of `segment` that tunes the method.

    >>> {s.name: s.default for s in settings()}["max_tets"]
    'auto'
    """
def presets() -> list[str]:
    """Returns the names of the presets.

    >>> presets()
    ['default', 'paper']
    """
def read_volume(
    path: _Path,
    *,
    series: str | None = ...,
    spacing: Sequence[float] | None = ...,
    resample: bool = ...,
    volume_number: int | None = ...,
    channel: int | None = ...,
    modality: Literal["CT", "MR", "other"] | None = ...,
    memory: float = ...,
) -> Volume:
    """Reads a scan: NIfTI, NRRD, MetaImage, TIFF, InVesalius, DICOM, a folder of slices.

    `series` is the UID of a DICOM series, `spacing` (x, y, z in mm) is taken instead of the file's,
    `resample` brings uneven DICOM slices and sheared grids onto a regular grid. `volume_number` and
    `channel`, both from 0, take one of several values per voxel: of a 4-D file, a hyperstack, a series
    of phases. `modality` ("CT", "MR", "other") is taken instead of the file's. `memory` limits it (GB).
    """
def from_sitk(image: Any, *, modality: Literal["CT", "MR"] | None = ...) -> Volume:
    """A Volume of an image of SimpleITK, with its place; samples are shared where they are in single
    precision. `modality` ("CT", "MR") is what the image is; CT is also recognised by its values.
    """
def write_volume(path: _Path, volume: Volume, *, gzip: bool = ...) -> None:
    """Writes a Volume as .nrrd, samples in single precision."""
def read_surface(path: _Path) -> Surface:
    """Reads .stl .ply .obj .vtp .3mf .amf .vtk, or STL and OBJ in DICOM; coordinates as in the file, with the frame it states."""
def write_surface(
    path: _Path,
    surface: _Surface,
    *,
    frame: _Frame | None = ...,
    name: str = ...,
    arrays: Mapping[str, npt.ArrayLike] | None = ...,
    patient: Volume | None = ...,
) -> None:
    """Writes a surface: .stl .ply .obj .vtp .3mf .amf .glb, .dcm (STL in DICOM).

    `surface` is a Surface, a result or (points, triangles). Its points are written as they are;
    `frame` is what the file states instead of the surface's own. `arrays` is a dict of values per
    point, for .vtp and .ply. A .dcm names no patient unless `patient`, a Volume read from DICOM, gives
    patient, study and frame of reference. The file appears whole or not at all.
    """
def read_mesh(path: _Path) -> Mesh:
    """Reads the tetrahedra and the arrays of a .vtu, or Medit's .mesh."""
def write_mesh(
    path: _Path,
    mesh: _Mesh,
    *,
    point_arrays: Mapping[str, npt.ArrayLike] | None = ...,
    cell_arrays: Mapping[str, npt.ArrayLike] | None = ...,
) -> None:
    """Writes tetrahedra: .vtu, with arrays, or Medit's .mesh, without.

    `mesh` is a Mesh, whose arrays are written too, a result or (nodes, tets). Nodes and arrays are written
    as they are, and a .vtu states their frame.
    """
def decimate(
    surface: _Surface,
    *,
    tolerance: float | None = ...,
    triangles: int | None = ...,
    min_volume: float = ...,
    keep_largest: int = ...,
    fill_cavities: bool = ...,
    progress: _Progress | None = ...,
    threads: int = ...,
) -> Any:
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
def label(
    surfaces: Mapping[str, _Surface], like: Any, path: _Path
) -> list[tuple[int, str, int]]:
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
def compare(
    reference: _Surface,
    surface: _Surface,
    *,
    frames: Literal["auto", "as-is", "turned"] = ...,
    box: npt.ArrayLike | None = ...,
    threads: int = ...,
) -> Comparison:
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
def remesh(
    mesh: _Mesh,
    metric: npt.ArrayLike,
    *,
    max_tets: int | None = ...,
    progress: _Progress | None = ...,
    threads: int = ...,
) -> Mesh:
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
def box_mesh(low: Sequence[float], high: Sequence[float], cells: int | Sequence[int]) -> Mesh:
    """Fills a box with cubes of six tetrahedra each: `cells` along each axis, one number or three.

    >>> len(box_mesh((0, 0, 0), (1, 1, 1), (1, 2, 3)).tets)
    36
    """
def phantoms() -> dict[str, tuple[str, tuple[int, int, int]]]:
    """Returns the phantoms: {name: (description, size in voxels of 1 mm)}."""
def phantom(
    name: str,
    *,
    size: int | Sequence[int] | None = ...,
    spacing: _Triple = ...,
    blur: float = ...,
    noise: float = ...,
    speckle: float = ...,
    salt_pepper: float = ...,
    pepper: float = ...,
    salt: float = ...,
    seed: int = ...,
    samples: int = ...,
) -> Volume:
    """Makes a synthetic scan whose surface is known, see `phantom_surface`.

    `size` in voxels and `spacing` in mm along x, y, z; `blur` in voxels; `noise` in grey values; `speckle`
    as a share; `salt_pepper` as a share of voxels. `phantoms()` lists the names.

    >>> phantom("femur", size=(16, 16, 24), spacing=4, noise=10)
    <mesamis.Volume 16 x 16 x 24 voxels of 4 x 4 x 4 mm, LPS>
    """
def phantom_surface(
    name: str, *, size: int | Sequence[int] | None = ..., spacing: _Triple = ...
) -> Surface:
    """Makes the true surface of a phantom; report["error_max_mm"] bounds its own error."""
def make_body(
    result: Result | LabelResult,
    *,
    element_size: float | None = ...,
    least_size: float | None = ...,
    tolerance: float | None = ...,
    gradation: float | None = ...,
    wall_elements: int | None = ...,
    quadratic: bool = ...,
    sets: Sequence[str] | None = ...,
    material: str | None = ...,
    calibration: str | None = ...,
    ash: str | None = ...,
    material_gap: float | None = ...,
    material_rim: float | None = ...,
    poisson: float | None = ...,
    progress: _Progress | None = ...,
    threads: int = ...,
    memory: float = ...,
) -> Body:
    """Fills the surface of a result, or all of them, with tetrahedra for a finite element solver.

    `element_size` in mm (default three voxels), `tolerance` of the skin in mm (default that of the
    settings if given, else a tenth of the element size), `gradation` 0.05 to 5 and `wall_elements` 0 to
    10 as of the program, `quadratic` adds mid-side nodes. `sets` are texts as --set takes,
    "LOAD=top:z,2mm", in the frame of the result. `material` is a law ("keyak-1994"), `calibration` and
    `ash` what --calibration and --ash take, the first also as (a, b), `material_gap` MPa between the ends
    of a bin, `material_rim` the depth that the surroundings dim, mm (default: from the scan's blur),
    `poisson` a ratio (default: the law's). `memory` limits the elements (GB). A promise that is missed is
    a MesamisWarning; the same arguments give the bytes of the program's --body.

    >>> import mesamis
    >>> ball = mesamis.segment(mesamis.phantom("sphere", size=(24, 24, 24)), preview=True)
    >>> body = mesamis.make_body(ball, element_size=4, sets=["TOP=top:z,2mm"])
    >>> body.elements.shape[1], list(body.sets), body.report["least_angle_deg"] > 5
    (4, ['TOP'], True)
    """
