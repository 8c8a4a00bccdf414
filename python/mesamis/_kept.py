# SPDX-License-Identifier: Apache-2.0
"""Results without a run: those that were pickled, and objects that were decimated."""

import json

import numpy as np

from . import _core

_FIELDS = ("nodes", "tets", "u", "v", "f", "metric", "level", "converged", "stopped", "closed", "several",
           "warnings", "notes", "flaw")


def state_of(run, report):
    """What a pickle has of a run."""
    state = {"report": report, "objects": [{key: _own(value) for key, value in o.items()} for o in run.objects]}
    for name in _FIELDS:
        try:
            state[name] = _own(getattr(run, name))
        except (_core.InputError, AttributeError, RuntimeError):
            state[name] = None  # labels without a mesh have no fields
    return state


def _own(value):
    return np.array(value) if isinstance(value, np.ndarray) else value


class KeptRun:
    """Answers for a run that is gone, or that there never was."""

    _found = "one that was pickled"

    def __init__(self, state):
        self._report = state["report"]
        self.__dict__.update({key: value for key, value in state.items() if key != "report"})

    @classmethod
    def of_objects(cls, objects, report, frame):
        """Objects that no run made, points in LPS where a frame is known."""
        return cls({**dict.fromkeys(_FIELDS), "several": True, "warnings": [], "notes": [], "objects": objects,
                    "report": report, "frame": frame, "_found": "decimated objects"})

    def report(self):
        return json.dumps(self._report)

    def require_surface(self):
        pass

    def save_surface(self, path, name, error, patient):
        if patient or (self.several and error):
            self._refuse(path)
        if self.several:
            _core.write_objects(path, self.objects, self.frame or "", name)
            return
        one = self.objects[0]
        arrays = {"expected_error": np.asarray(one["expected_error"], dtype=float)} if error else {}
        turn = np.array([1.0, 1, 1]) if self.frame == "lps" else np.array([-1.0, -1, 1])
        _core.write_surface(path, (one["points"] * turn, one["triangles"]), self.frame, (name, arrays), None)

    def save_mesh(self, path, *_):
        self._refuse(path)

    save_band = save_labelmap = save_page = save_mesh

    def _refuse(self, path):
        raise _core.InputError(
            f"{path}: expected a result of segment() in this session, found {self._found}, arrays and report alone")
