# SPDX-License-Identifier: Apache-2.0
"""The table of settings, as the library has it."""

import difflib
import json
from typing import NamedTuple

import numpy as np

from . import _core


class Setting(NamedTuple):
    """A row of the table of settings."""

    name: str
    group: str  # Image, Functional, Mesh or Surface
    form: str  # what a value looks like, "N|auto"
    default: str
    unit: str  # empty: none
    help: str
    automatic: str  # how "auto" is found; empty: there is no "auto"
    paper: str  # in the preset "paper"; empty: the default
    numbers: int  # in a value; 0: a switch or a word
    whole: bool  # the numbers are integers
    ranges: bool  # the numbers come in pairs, begin and end
    words: tuple  # that are accepted
    switch: bool


def settings():
    """Returns the table of settings: every keyword of `segment` that tunes the method.

    >>> {s.name: s.default for s in settings()}["max_tets"]
    'auto'
    """
    return [Setting(**{**row, "words": tuple(row["words"])}) for row in _core.setting_table()]


def presets():
    """Returns the names of the presets.

    >>> presets()
    ['default', 'paper']
    """
    return list(_core.preset_names())


def table_text(indent="    "):
    """The table as text for a docstring."""
    lines = []
    for s in settings():
        unit = f"{s.unit}; " if s.unit else ""
        lines.append(f"{indent}{s.name} : {s.form}\n{indent}    {s.help} ({unit}default {s.default})")
    return "\n".join(lines)


def _plain(value):
    """A value of NumPy or Python as JSON has it."""
    if isinstance(value, (np.ndarray, np.generic)):
        return value.tolist()
    if isinstance(value, (tuple, list)):
        return [_plain(v) for v in value]
    if isinstance(value, slice):
        return [value.start, value.stop]
    return value


def to_json(given):
    """The settings given as keywords, those that are None left out.

    Raises TypeError for a name that is none of the table's, InputError for a value that no setting
    can have.
    """
    names = [row["name"] for row in _core.setting_table()]
    for name in given:
        if name not in names:
            near = difflib.get_close_matches(name, names, 1)
            hint = f"; did you mean '{near[0]}'?" if near else ""
            raise TypeError(f"segment() got an unexpected keyword argument '{name}'{hint}")
    plain = {name: _plain(value) for name, value in given.items() if value is not None}
    try:
        return json.dumps(plain, allow_nan=False)
    except (TypeError, ValueError) as error:
        raise _core.InputError(f"settings: {error}") from None
