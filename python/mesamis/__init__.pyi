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
_Progress = Callable[[str, float], object]
_Triple = float | Sequence[float]
_Box = str | Sequence[tuple[float | None, float | None] | None]
_Surface = Any  # a path, a result, a Surface, an object with points and triangles, or (points, triangles)
_Mesh = Any  # a Mesh, a result, a mesh of meshio, or (nodes, tets)

class InputError(ValueError): ...
class NumericalError(RuntimeError): ...
class Cancelled(RuntimeError): ...
class MesamisWarning(UserWarning): ...

class Setting(NamedTuple):
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

class Volume:
    @property
    def array(self) -> npt.NDArray[np.float32]: ...
    @property
    def spacing(self) -> tuple[float, float, float]: ...
    @property
    def origin(self) -> tuple[float, float, float]: ...
    @property
    def direction(self) -> _Doubles: ...
    @property
    def affine(self) -> _Doubles: ...
    @property
    def modality(self) -> str: ...
    @property
    def orientation(self) -> str: ...
    @property
    def format(self) -> str: ...
    @property
    def warnings(self) -> list[str]: ...

class Surface:
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
    ) -> None: ...

class Mesh:
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
    def volumes(self) -> _Doubles: ...
    def save(self, path: _Path) -> None: ...

class _AnyResult:
    frame: _Frame
    @property
    def report(self) -> dict[str, Any]: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def notes(self) -> list[str]: ...
    def save_labelmap(self, path: _Path) -> None: ...
    @property
    def nodes(self) -> _Doubles: ...
    @property
    def tets(self) -> _Indices: ...
    @property
    def u(self) -> _Doubles: ...
    @property
    def v(self) -> _Doubles: ...

class Result(_AnyResult):
    @property
    def points(self) -> _Doubles: ...
    @property
    def triangles(self) -> _Indices: ...
    @property
    def expected_error(self) -> _Doubles: ...
    @property
    def f(self) -> _Doubles: ...
    @property
    def metric(self) -> _Doubles: ...
    @property
    def level(self) -> float: ...
    @property
    def converged(self) -> bool: ...
    @property
    def stopped(self) -> bool: ...
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
    ) -> None: ...

class Object:
    name: str
    label: int
    layer: int
    colour: tuple[int, int, int]
    points: _Doubles
    triangles: _Indices
    expected_error: _Doubles
    frame: _Frame

class LabelResult(_AnyResult):
    @property
    def objects(self) -> list[Object]: ...
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
    ) -> None: ...

class Body:
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
    def warnings(self) -> list[str]: ...
    def save(self, path: _Path) -> None: ...

class Comparison:
    report: dict[str, Any]
    surface_to_reference: _Doubles
    reference_to_surface: _Doubles
    @property
    def mean(self) -> float: ...
    @property
    def max(self) -> float: ...

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
    band_threshold: float | None = ...,
    min_volume: Literal["auto"] | float | None = ...,
    keep_largest: int | None = ...,
    fill_cavities: bool | None = ...,
    accuracy: Literal["auto"] | float | None = ...,
    tolerance: Literal["auto", "none"] | float | None = ...,
    preview: bool | None = ...,
    triangles: Literal["auto"] | int | None = ...,
    # end of settings
) -> Any: ...
def settings() -> list[Setting]: ...
def presets() -> list[str]: ...
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
) -> Volume: ...
def write_volume(path: _Path, volume: Volume, *, gzip: bool = ...) -> None: ...
def read_surface(path: _Path) -> Surface: ...
def write_surface(
    path: _Path,
    surface: _Surface,
    *,
    frame: _Frame | None = ...,
    name: str = ...,
    arrays: Mapping[str, npt.ArrayLike] | None = ...,
    patient: Volume | None = ...,
) -> None: ...
def read_mesh(path: _Path) -> Mesh: ...
def write_mesh(
    path: _Path,
    mesh: _Mesh,
    *,
    point_arrays: Mapping[str, npt.ArrayLike] | None = ...,
    cell_arrays: Mapping[str, npt.ArrayLike] | None = ...,
) -> None: ...
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
) -> Surface: ...
def label(
    surfaces: Mapping[str, _Surface], like: Any, path: _Path
) -> list[tuple[int, str, int]]: ...
def compare(
    reference: _Surface,
    surface: _Surface,
    *,
    frames: Literal["auto", "as-is", "turned"] = ...,
    box: npt.ArrayLike | None = ...,
    threads: int = ...,
) -> Comparison: ...
def remesh(
    mesh: _Mesh,
    metric: npt.ArrayLike,
    *,
    max_tets: int | None = ...,
    progress: _Progress | None = ...,
    threads: int = ...,
) -> Mesh: ...
def box_mesh(low: Sequence[float], high: Sequence[float], cells: int | Sequence[int]) -> Mesh: ...
def phantoms() -> dict[str, tuple[str, tuple[int, int, int]]]: ...
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
) -> Volume: ...
def phantom_surface(
    name: str, *, size: int | Sequence[int] | None = ..., spacing: _Triple = ...
) -> Surface: ...
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
) -> Body: ...
