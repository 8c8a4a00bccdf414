# SPDX-License-Identifier: Apache-2.0
"""Bodies of finite elements."""

import json
import os

import numpy as np

from . import _core
from ._progress import Follow
from ._result import LabelResult, Result
from ._warnings import warn


class Body:
    """Elements for a solver: `nodes` (n, 3) in mm, `elements` (m, 4) or (m, 10), `part` and `material` of
    each element (from 0; empty without materials), `materials` (name, modulus in MPa, Poisson's ratio,
    density in g/cm^3), `sets` (name: nodes of its faces), `report`."""

    def __init__(self, body, frame):
        self._body = body
        self.frame = frame
        self.report = json.loads(body.report())

    @property
    def nodes(self):
        nodes = self._body.nodes
        return nodes if self.frame == "lps" else nodes * np.array([-1.0, -1.0, 1.0])

    @property
    def elements(self):
        middles = self._body.mid_nodes
        return np.hstack([self._body.corners, middles]) if len(middles) else self._body.corners

    @property
    def warnings(self):
        """What was warned of, a line each: promises that it misses."""
        return [text for text in self._body.warnings if text]

    @property
    def part(self):
        return self._body.part

    @property
    def material(self):
        return self._body.material

    @property
    def materials(self):
        return list(self._body.materials)

    @property
    def sets(self):
        return dict(self._body.sets)

    def save(self, path):
        """Writes .inp (Abaqus, CalculiX), .feb (FEBio), .msh (Gmsh), .vtu or Medit's .mesh."""
        self._body.save(os.fspath(path))

    def __repr__(self):
        return f"<mesamis.Body {len(self.nodes)} nodes, {len(self._body.corners)} elements>"


def _calibration_text(given):
    """What --calibration takes, of its text or of a and b."""
    return ",".join(repr(float(x)) for x in given) if isinstance(given, (tuple, list)) else given


def make_body(result, *, element_size=None, least_size=None, tolerance=None, gradation=None, wall_elements=None,
              quadratic=False, sets=None, material=None, calibration=None, ash=None, material_gap=None,
              material_rim=None, poisson=None, progress=None, threads=0, memory=0):
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
    if not isinstance(result, (Result, LabelResult)):
        raise _core.InputError(f"result: expected what segment() returns, found {type(result).__name__}")
    wanted = {"element_size": element_size, "least_size": least_size, "tolerance": tolerance,
              "gradation": gradation, "wall_elements": wall_elements, "quadratic": bool(quadratic),
              "sets": sets if sets is None or isinstance(sets, str) else list(sets), "material": material,
              "calibration": _calibration_text(calibration), "ash": ash, "material_gap": material_gap,
              "material_rim": material_rim, "poisson": poisson, "memory": float(memory)}
    with Follow(progress) as tell:
        body = Body(_core.make_body(result._run, wanted, tell, int(threads)), result.frame)
    warn(body.warnings)
    return body
