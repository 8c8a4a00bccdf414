# SPDX-License-Identifier: Apache-2.0
"""A mesh for a function of one's own: the remesher alone.

    python own_metric.py [FOLDER]

The function has a thin curved layer. A metric from its second derivatives makes cells that are thin
across the layer and long along it. As many equal cells approximate it far worse.
"""

import sys
from pathlib import Path

import numpy as np
import numpy.typing as npt

import mesamis

Array = npt.NDArray[np.float64]

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "own-metric-output")
folder.mkdir(parents=True, exist_ok=True)

WIDTH = 0.04  # of the layer, in a box of side 1


def depth(p: Array) -> Array:
    """Distance from the layer: a part of a sphere around a corner of the box."""
    distance: Array = np.linalg.norm(p, axis=-1) - 0.8
    return distance


def function(p: Array) -> Array:
    values: Array = np.tanh(depth(p) / WIDTH)
    return values


def metric(p: Array, error: float) -> Array:
    """Across the layer, edges whose linear interpolation errs by `error`; along it, far longer ones."""
    t = function(p)
    second = np.abs(2 * t * (1 - t**2)) / WIDTH**2 + 1e-9  # d^2/dr^2
    across = np.clip(np.sqrt(8 * error / second), 0.01, 0.25)
    along = np.minimum(8 * across, 0.25)
    radius = np.maximum(np.linalg.norm(p, axis=1), 1e-9)
    normal = p / radius[:, None]
    outer = normal[:, :, None] * normal[:, None, :]
    eye = np.eye(3)[None]
    matrices: Array = outer / across[:, None, None] ** 2 + (eye - outer) / along[:, None, None] ** 2
    return matrices


def mean_error(mesh: mesamis.Mesh) -> float:
    """Of the linear interpolation, at points spread over each cell."""
    corners = function(mesh.nodes)[mesh.tets]
    random = np.random.default_rng(1)
    total = 0.0
    for _ in range(8):
        weights = random.dirichlet(np.ones(4), len(mesh.tets))
        points = np.einsum("cn,cnx->cx", weights, mesh.nodes[mesh.tets])
        error = np.abs((weights * corners).sum(axis=1) - function(points))
        total += float((error * mesh.volumes).sum())
    return total / 8


# %% From a coarse mesh, in a few steps: each mesh sees more of the layer than the one before.
mesh = mesamis.box_mesh((0, 0, 0), (1, 1, 1), 8)
for step in range(4):
    mesh = mesamis.remesh(mesh, metric(mesh.nodes, error=0.02))
    print(f"step {step}: {len(mesh.tets)} tetrahedra, mean error {mean_error(mesh):.5f}, "
          f"{100 * mesh.report['mesh']['edge_unit_fraction']:.0f} % of the edges fit")

# %% As many equal cells.
per_side = round((len(mesh.tets) / 6) ** (1 / 3))
equal = mesamis.box_mesh((0, 0, 0), (1, 1, 1), per_side)
print(f"equal cells: {len(equal.tets)} tetrahedra, mean error {mean_error(equal):.5f}")
assert mean_error(mesh) < mean_error(equal) / 2

# %% For ParaView, with the function and the cells' volumes.
mesh.point_arrays["function"] = function(mesh.nodes)
mesh.cell_arrays["volume"] = mesh.volumes
mesh.save(folder / "layer.vtu")
print("written:", folder / "layer.vtu")
