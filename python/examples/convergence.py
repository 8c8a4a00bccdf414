# SPDX-License-Identifier: Apache-2.0
"""How the error falls with the size of the voxels, on a phantom whose surface is known.

    python convergence.py [FOLDER]

The same ball in the same box is scanned with finer and finer voxels. The table goes to
convergence.csv: the distance from the truth, and the error that the run expected.
"""

import csv
import math
import sys
from pathlib import Path

import mesamis

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "convergence-output")
folder.mkdir(parents=True, exist_ok=True)

BOX = 64.0  # mm
NAME = "sphere"

# %% One run for each size of voxels.
rows: list[dict[str, float]] = []
for count in (16, 24, 36):
    spacing = BOX / count
    scan = mesamis.phantom(NAME, size=count, spacing=spacing, blur=0.7, noise=3, seed=count)
    truth = mesamis.phantom_surface(NAME, size=count, spacing=spacing)
    result = mesamis.segment(scan, max_tets=30_000)
    distances = mesamis.compare(truth, result)
    rows.append({
        "voxel_mm": spacing,
        "tets": len(result.tets),
        "triangles": len(result.triangles),
        "mean_mm": distances.mean,
        "max_mm": distances.max,
        "expected_mm": result.report["quality"]["expected_error_mm"]["mean"],
    })
    print("  ".join(f"{key} {value:.4g}" for key, value in rows[-1].items()))

# %% The order: how the error goes with the voxel.
first, last = rows[0], rows[-1]
order = math.log(first["mean_mm"] / last["mean_mm"]) / math.log(first["voxel_mm"] / last["voxel_mm"])
print(f"the mean distance falls with order {order:.2f}")
assert order > 0.8

# %% The table.
with open(folder / "convergence.csv", "w", newline="", encoding="utf-8") as file:
    writer = csv.DictWriter(file, fieldnames=list(rows[0]))
    writer.writeheader()
    writer.writerows(rows)
print("written:", folder / "convergence.csv")
