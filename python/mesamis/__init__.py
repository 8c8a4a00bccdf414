# SPDX-License-Identifier: Apache-2.0
"""From a 3D scan to a printable surface and a mesh that follows the image.

>>> import mesamis
>>> ball = mesamis.phantom("sphere", size=(24, 24, 24), noise=5)
>>> result = mesamis.segment(ball, preview=True)
>>> result.points.shape[1], result.triangles.shape[1], result.closed
(3, 3, True)

`segment` is the door; `remesh`, `decimate`, `compare`, `make_body` and `phantom` are the tools
around it. Lengths are mm, coordinates LPS unless `frame="ras"` is asked for.
"""

from ._core import Cancelled, InputError, NumericalError
from ._core import version as __version__
from ._body import Body, make_body
from ._files import read_mesh, read_surface, write_mesh, write_surface
from ._geometry import Mesh, Surface
from ._result import LabelResult, Object, Result
from ._segment import segment
from ._settings import Setting, presets, settings
from ._tools import Comparison, box_mesh, compare, decimate, label, phantom, phantom_surface, phantoms, remesh
from ._volume import Volume, from_sitk, read_volume, write_volume
from ._warnings import MesamisWarning

__all__ = [
    "Body", "Cancelled", "Comparison", "InputError", "LabelResult", "MesamisWarning", "Mesh",
    "NumericalError", "Object", "Result", "Setting", "Surface", "Volume", "box_mesh", "compare",
    "decimate", "from_sitk", "label", "make_body", "phantom", "phantom_surface", "phantoms", "presets", "read_mesh",
    "read_surface", "read_volume", "remesh", "segment", "settings", "write_mesh", "write_surface",
    "write_volume",
]
