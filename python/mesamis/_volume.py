# SPDX-License-Identifier: Apache-2.0
"""Scans: arrays, images of nibabel and SimpleITK, files."""

import os
import sys

import numpy as np

from . import _core
from ._shapes import significant, table
from ._warnings import warn

_LPS = np.diag([-1.0, -1.0, 1.0])


class Volume:
    """A scan in memory: what `read_volume` and `phantom` return, and `segment` takes.

    >>> import mesamis
    >>> v = mesamis.phantom("sphere", size=(20, 21, 22), spacing=(1, 1, 2))
    >>> v.array.shape, v.spacing, v.orientation
    ((20, 21, 22), (1.0, 1.0, 2.0), 'LPS')
    """

    def __init__(self, scan, order="ijk"):
        self._scan = scan
        self._order = order

    @property
    def array(self):
        """The samples with axes i, j, k (i runs fastest in memory); shared, not to be written to."""
        return self._scan.samples

    @property
    def spacing(self):
        """Distances of voxels along i, j, k, mm."""
        return tuple(self._scan.spacing)

    @property
    def origin(self):
        """The centre of voxel (0, 0, 0), LPS, mm."""
        return tuple(self._scan.origin)

    @property
    def direction(self):
        """Column k is the direction of axis k, LPS."""
        return np.array(self._scan.direction).reshape(3, 3)

    @property
    def affine(self):
        """The matrix from voxel indices to RAS, mm, as nibabel has it."""
        matrix = np.eye(4)
        matrix[:3, :3] = _LPS @ self.direction * np.array(self.spacing)
        matrix[:3, 3] = _LPS @ np.array(self.origin)
        return matrix

    @property
    def modality(self):
        """"CT", "MR", ... as the file says; empty: unknown."""
        return self._scan.modality

    @property
    def orientation(self):
        """The sides of the body that the axes run towards, "RAS"."""
        return self._scan.orientation

    @property
    def format(self):
        """The format of its file, or what made it."""
        return self._scan.format

    @property
    def warnings(self):
        """What the reader had to say, a line each."""
        return list(self._scan.warnings)

    def __reduce__(self):
        direction = np.asarray(self._scan.direction, dtype=float).ravel().tolist()
        return _volume_of, (np.array(self.array, order="F"), list(self.spacing), list(self.origin), direction,
                            self.modality)

    def _repr_html_(self):
        low, high = (significant(float(x), 3) for x in (self.array.min(), self.array.max()))
        return table("Volume", [
            ("voxels", " x ".join(str(n) for n in self._scan.size)),
            ("voxel", " x ".join(significant(s, 3) for s in self.spacing) + " mm"),
            ("values", f"{low} to {high}" + (" HU" if self.modality == "CT" else "")),
            ("modality", self.modality or "unknown"), ("orientation", self.orientation)])

    def __repr__(self):
        size = " x ".join(str(n) for n in self._scan.size)
        spacing = " x ".join(f"{s:.4g}" for s in self.spacing)
        return f"<mesamis.Volume {size} voxels of {spacing} mm, {self.orientation}>"


def _volume_of(array, spacing, origin, direction, modality):
    """A Volume that was pickled."""
    return Volume(_core.scan_with_axes(array, spacing, origin, direction, modality))


def from_sitk(image, *, modality=None):
    """A Volume of an image of SimpleITK, with its place; samples are shared where they are in single
    precision. `modality` ("CT", "MR") is what the image is; CT is also recognised by its values."""
    if not _is_itk(image):
        raise _core.InputError(f"image: expected one of SimpleITK, found {type(image).__name__}")
    return Volume(_of_itk(image, modality or ""))


def is_path(value):
    """Whether a value names a file."""
    return isinstance(value, (str, os.PathLike))


def spacing_list(spacing):
    """Along x, y, z; None stays None."""
    return None if spacing is None else [float(s) for s in spacing]


def read_scan(path, *, spacing=None, resample=False, memory=0, **others):
    """`others`: series, volume_number, channel, modality."""
    return _core.read_scan(os.fspath(path), {"spacing": spacing_list(spacing), "resample": bool(resample),
                                             "memory": float(memory), **others})


def read_volume(path, *, series=None, spacing=None, resample=False, volume_number=None, channel=None,
                modality=None, memory=0):
    """Reads a scan: NIfTI, NRRD, MetaImage, TIFF, InVesalius, DICOM, a folder of slices.

    `series` is the UID of a DICOM series, `spacing` (x, y, z in mm) is taken instead of the file's,
    `resample` brings uneven DICOM slices and sheared grids onto a regular grid. `volume_number` and
    `channel`, both from 0, take one of several values per voxel: of a 4-D file, a hyperstack, a series
    of phases. `modality` ("CT", "MR", "other") is taken instead of the file's. `memory` limits it (GB).
    """
    scan = read_scan(path, series=series, spacing=spacing, resample=resample, volume_number=volume_number,
                     channel=channel, modality=modality, memory=memory)
    warn(scan.warnings)
    return Volume(scan)


def write_volume(path, volume, *, gzip=False):
    """Writes a Volume as .nrrd, samples in single precision."""
    _core.write_scan(os.fspath(path), volume._scan, bool(gzip))


def _samples(array, order):
    """Axes i, j, k, i running fastest, single precision: a view of the array where it is so."""
    array = np.asarray(array)
    if array.ndim != 3:
        raise _core.InputError(f"volume: expected an array of three axes, found {array.ndim}")
    if array.dtype.kind not in "biuf":
        raise _core.InputError(f"volume: expected real numbers, found {array.dtype}")
    if order == "zyx":
        array = array.T
    elif order != "ijk":
        raise _core.InputError(f"order: expected 'ijk' or 'zyx', found {order!r}")
    return np.asfortranarray(array, dtype=np.float32)


def _with_affine(array, affine, order="ijk", unit_mm=1.0, modality=""):
    matrix = np.asarray(affine, dtype=float)
    if matrix.shape != (4, 4):
        raise _core.InputError(f"affine: expected a matrix of 4 x 4, found shape {matrix.shape}")
    if not np.array_equal(matrix[3], (0, 0, 0, 1)):
        raise _core.InputError(f"affine: expected 0, 0, 0, 1 as the last row, found {matrix[3].tolist()}")
    return _core.scan_with_affine(_samples(array, order), matrix.ravel().tolist(), unit_mm, modality)


def _with_axes(array, spacing, origin=None, direction=None, order="zyx", modality=""):
    spacing = np.broadcast_to(np.asarray(spacing, dtype=float), (3,)).tolist()
    origin = [0.0, 0.0, 0.0] if origin is None else np.asarray(origin, dtype=float).ravel().tolist()
    matrix = np.eye(3) if direction is None else np.asarray(direction, dtype=float)
    if len(origin) != 3:
        raise _core.InputError(f"origin: expected three numbers, found {len(origin)}")
    return _core.scan_with_axes(_samples(array, order), spacing, origin, matrix.ravel().tolist(),
                                modality)


def _is_nibabel(image):
    return hasattr(image, "affine") and hasattr(image, "dataobj")


def _is_itk(image):
    return all(hasattr(image, name) for name in ("GetSpacing", "GetOrigin", "GetDirection"))


def _of_nibabel(image, modality):
    """As the reader of NIfTI files does it: the unit of length counts, and an image without a place
    lies at the origin."""
    header = image.header
    unit = 1.0
    if hasattr(header, "get_xyzt_units"):
        unit = {"meter": 1000.0, "micron": 0.001}.get(header.get_xyzt_units()[0], 1.0)
    affine = image.affine
    if hasattr(header, "get_sform") and not (int(header["sform_code"]) or int(header["qform_code"])):
        affine = np.diag([*np.abs(header["pixdim"][1:4].astype(float)), 1.0])
    array = np.asanyarray(image.dataobj)
    while array.ndim > 3 and array.shape[-1] == 1:
        array = array[..., 0]
    return _with_affine(array, affine, "ijk", unit, modality)


def _of_itk(image, modality):
    """Images of SimpleITK and ITK: the array's axes are z, y, x, the frame is LPS. A view does not hold
    the image that it lies in, so the scan does. Images of SimpleITK share their memory until one of them
    is changed: the scan's own image keeps the samples as they are."""
    sitk = sys.modules.get("SimpleITK")
    if sitk is not None and isinstance(image, getattr(sitk, "Image", ())):
        image = sitk.Image(image)
        array = sitk.GetArrayViewFromImage(image)
    elif hasattr(image, "GetArrayViewFromImage"):
        array = image.GetArrayViewFromImage()
    else:
        array = np.asarray(image)
    scan = _with_axes(array, tuple(image.GetSpacing()), tuple(image.GetOrigin()),
                      np.asarray(image.GetDirection(), dtype=float), "zyx", modality)
    scan.keep(image)
    return scan


def refuse(kind, arguments):
    """Arguments that mean nothing beside a kind of scan."""
    for name, value in arguments.items():
        if value is not None:
            raise _core.InputError(f"volume: expected {kind} without {name}, found both")


def scan_of(image, affine=None, spacing=None, origin=None, direction=None, order=None, modality=None):
    """The scan that an image is, and the order of its axes. Not for paths."""
    place = {"affine": affine, "spacing": spacing, "origin": origin, "direction": direction, "order": order}
    if isinstance(image, Volume):
        refuse("a Volume", {**place, "modality": modality})
        return image._scan, "ijk"
    modality = modality or ""
    if _is_nibabel(image):
        refuse("an image of nibabel", place)
        return _of_nibabel(image, modality), "ijk"
    if _is_itk(image):
        refuse("an image of ITK", place)
        return _of_itk(image, modality), "zyx"
    if affine is not None and spacing is not None:
        raise _core.InputError("affine: expected it without spacing, found both")
    if affine is not None:
        if origin is not None or direction is not None:
            raise _core.InputError("affine: expected it without origin and direction, found both")
        order = order or "ijk"
        return _with_affine(image, affine, order, 1.0, modality), order
    if spacing is None:
        raise _core.InputError(
            f"volume: expected affine or spacing beside an array, found neither ({type(image).__name__})")
    order = order or "zyx"
    return _with_axes(image, spacing, origin, direction, order, modality), order


def labels_on(scan, array, order):
    """An array of labels on the grid of a scan."""
    samples = _samples(array, order)
    if list(samples.shape) != list(scan.size):
        raise _core.InputError(
            f"labels: expected the shape of the scan, {tuple(scan.size)}, found {samples.shape}")
    return _core.scan_with_axes(samples, scan.spacing, scan.origin, scan.direction, "")
