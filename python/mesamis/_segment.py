# SPDX-License-Identifier: Apache-2.0
"""The door of the method."""

import os

import numpy as np

from . import _core
from ._progress import Follow
from ._result import result_of
from ._settings import table_text, to_json
from ._volume import is_path, labels_on, read_scan, refuse, scan_of, spacing_list
from ._warnings import warn


def _marks(image, scan, order):
    """A path, or a scan whose samples are labels; None stays None."""
    if image is None or is_path(image):
        return None if image is None else os.fspath(image)
    if isinstance(image, np.ndarray):
        if scan is None:
            raise _core.InputError("labels: expected a scan beside an array of labels, found none")
        return labels_on(scan, image, order)
    return scan_of(image)[0]


def _labels_alone(labels, affine, spacing, resample, place):
    """Arguments: a path and how it is read, or a scan whose samples are labels; None stays None."""
    if labels is None:
        return {}
    if is_path(labels):
        refuse("labels of a path", {"affine": affine, **place})
        return {"labels": os.fspath(labels), "spacing": spacing_list(spacing), "resample": bool(resample)}
    refuse("labels of an array or an image", {"resample": resample or None})
    if isinstance(labels, np.ndarray) and affine is None and spacing is None:
        raise _core.InputError("labels: expected a scan, affine or spacing beside an array, found none")
    return {"labels": scan_of(labels, affine, spacing, **place)[0]}


def _box_text(box):
    """((X0, X1), (Y0, Y1), (Z0, Z1)) as text; an end of None is open."""
    if box is None or isinstance(box, str):
        return box
    end = lambda x: "" if x is None else repr(float(x))  # noqa: E731
    return ",".join("" if axis is None else f"{end(axis[0])}:{end(axis[1])}" for axis in box)


def _seed_list(seeds):
    if seeds is None:
        return None
    points = np.atleast_2d(np.asarray(seeds, dtype=float))
    if points.ndim != 2 or points.shape[1] != 3:
        raise _core.InputError(f"seeds: expected points of three numbers, found shape {points.shape}")
    return points.tolist()


def _label_list(label):
    if label is None:
        return None
    several = not isinstance(label, (str, int, np.integer))
    return [str(one) for one in (label if several else [label])]


def _label_names(names):
    if names is None or is_path(names):
        return None if names is None else os.fspath(names)
    return [(int(label), str(name)) for label, name in names.items()]


def segment(
    volume=None, *, affine=None, spacing=None, origin=None, direction=None, order=None, modality=None,
    labels=None, label=None, label_names=None, margin=None, mesh=False, tissue=None, mask=None, seeds=None,
    box=None, remove=None, keep_surroundings=False, frame="lps", preset="default", settings_file=None,
    series=None, resample=False, volume_number=None, channel=None, padding=None, progress=None, threads=0, memory=0, time_limit=None, **settings,
):
    marks_scan, ours = None, False
    place = {"origin": origin, "direction": direction, "order": order}
    numbers = {"volume_number": volume_number, "channel": channel}
    of_paths = {"series": series or None, "resample": resample or None, **numbers}
    if is_path(volume):
        refuse("a path", {"affine": affine, **place})
        marks_scan = read_scan(volume, series=series, spacing=spacing, resample=resample, modality=modality,
                               memory=memory, **numbers)
        axes, ours = "ijk", labels is None and mask is None and remove is None
    elif volume is not None:
        refuse("an array or an image", of_paths)
        marks_scan, axes = scan_of(volume, affine, spacing, origin, direction, order, modality)
    else:
        refuse("labels alone", {"modality": modality, "series": series or None, **numbers})
        axes = "ijk"
    if volume is None:
        of_labels = _labels_alone(labels, affine, spacing, resample, place)
    else:
        of_labels = {"labels": _marks(labels, marks_scan, axes)}
    arguments = {
        **of_labels,
        "settings": to_json(settings),
        "preset": preset,
        "settings_file": None if settings_file is None else os.fspath(settings_file),
        "frame": frame,
        "tissue": tissue,
        "box": _box_text(box),
        "seeds": _seed_list(seeds),
        "mask": _marks(mask, marks_scan, axes),
        "remove": remove if remove == "body" else _marks(remove, marks_scan, axes),
        "label": _label_list(label),
        "label_names": _label_names(label_names),
        "margin": margin,
        "mesh": bool(mesh),
        "keep_surroundings": bool(keep_surroundings),
        "padding": None if padding is None else str(padding),
        "memory": float(memory),
        "time_limit": time_limit,
    }
    share = _core.RunShare(labels is not None or len(arguments["seeds"] or []) > 1, volume is not None,
                           settings.get("preview") is True, bool(mesh))
    with Follow(progress, share) as tell:
        result = result_of(_core.segment(marks_scan, ours, arguments, tell, int(threads)), frame)
    warn(result.warnings)
    result._run.require_surface()
    return result


segment.__doc__ = f"""Segments a scan: a closed surface and a mesh that follows the image.

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
    which of them, by name or number; their names, {{number: name}} or a path; how far they may be
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

Settings
--------
{table_text()}

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
