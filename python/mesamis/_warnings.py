# SPDX-License-Identifier: Apache-2.0
"""Warnings of the library as warnings of Python."""

import warnings


class MesamisWarning(UserWarning):
    """What may not be what was meant, or a promise that a run did not keep."""


def warn(texts, level=3):
    """Warns of each text, as from the caller of the function that calls this one."""
    for text in texts:
        if text:
            warnings.warn(text, MesamisWarning, stacklevel=level)
