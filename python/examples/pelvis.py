# SPDX-License-Identifier: Apache-2.0
"""A hip bone, from a scan to a surface for the printer and a body for a solver.

    python pelvis.py [FOLDER] [SCAN]

Without a scan the phantom of a fractured hip bone is taken, whose true surface is known. The cells
of this script are marked by "# %%", so that editors run it like a notebook.
"""

import sys
from pathlib import Path

import numpy as np

import mesamis

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "pelvis-output")
folder.mkdir(parents=True, exist_ok=True)

# %% The scan: an array with its spacing, z, y, x, as scanners and SimpleITK have it.
if len(sys.argv) > 2:
    volume = mesamis.read_volume(sys.argv[2])
    truth = None
else:
    size, spacing = (41, 49, 61), 5.0
    volume = mesamis.phantom("hemipelvis", size=size, spacing=spacing, noise=8)
    truth = mesamis.phantom_surface("hemipelvis", size=size, spacing=spacing)
print(volume)


# %% The run. Stages are told as they go by.
told: list[str] = []


def tell(stage: str, fraction: float) -> None:
    if told[-1:] != [stage]:
        told.append(stage)
        print(" ", stage)


result = mesamis.segment(volume, progress=tell)
quality = result.report["quality"]
print(f"level {result.level:.1f}, {len(result.triangles)} triangles, {len(result.tets)} tetrahedra")
print(f"expected error: {quality['expected_error_mm']['mean']:.2f} mm in the mean")

# %% What one does with arrays: the volume of the bone, and where the surface is least certain.
a, b, c = (result.points[result.triangles[:, corner]] for corner in range(3))
bone_cm3 = float(np.einsum("ij,ij->", a, np.cross(b, c)) / 6000)
worst = result.points[int(np.argmax(result.expected_error))]
print(f"bone: {bone_cm3:.1f} cm^3; least certain at {np.round(worst, 1)}")
assert abs(1000 * bone_cm3 / result.report["surface"]["volume_mm3"] - 1) < 1e-9

# %% Against the truth, where it is known.
if truth is not None:
    distances = mesamis.compare(truth, result)
    print(f"to the truth: {distances.mean:.2f} mm in the mean, {distances.max:.2f} mm at most")
    assert 0.5 < distances.mean / quality["expected_error_mm"]["mean"] < 2

# %% Files: for the printer, for ParaView, the record of the run.
result.save(folder / "bone.stl")
result.save(folder / "bone.vtp", error=True)
result.save(folder / "bone.vtu", region="object")
result.save(folder / "report.json")
print("written:", *sorted(p.name for p in folder.iterdir()))
