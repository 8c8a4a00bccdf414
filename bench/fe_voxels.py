# SPDX-License-Identifier: Apache-2.0
"""A voxel model for CalculiX: one brick (C3D8) per voxel of the object. Needs numpy and scipy."""
import numpy as np
from scipy import ndimage

CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]


def spanning(inside):
    """The part, connected by faces, that joins the lowest with the highest layer."""
    parts, _ = ndimage.label(inside)
    both = np.intersect1d(parts[:, :, 0], parts[:, :, -1])
    both = both[both > 0]
    if not len(both):
        raise SystemExit("fe_voxels: expected a part from bottom to top, found none")
    return parts == both[np.argmax(np.bincount(parts.ravel())[both])]


def planes(count, spacing):
    """Between the voxels; the outermost at the centres of the outermost voxels, as a body has it."""
    return spacing * np.clip(np.arange(count + 1) - 0.5, 0, count - 1)


def write_voxel_model(path, inside, spacing):
    """Writes the nodes, the elements ALL, and the nodes TOP and BOTTOM; returns the number of nodes."""
    size = np.array(inside.shape) + 1
    voxels = np.argwhere(inside)
    ids = np.stack([np.ravel_multi_index((voxels + c).T, size) for c in CORNERS], axis=1)
    used, elements = np.unique(ids, return_inverse=True)
    elements = elements.reshape(ids.shape) + 1
    at = np.stack(np.unravel_index(used, size), axis=1)
    points = np.stack([planes(n - 1, s)[at[:, a]] for a, (n, s) in enumerate(zip(size, spacing))], axis=1)
    with path.open("w") as out:
        out.write("*NODE, NSET=NALL\n")
        np.savetxt(out, np.column_stack([np.arange(1, len(points) + 1), points]), "%d, %.9g, %.9g, %.9g")
        out.write("*ELEMENT, TYPE=C3D8, ELSET=ALL\n")
        numbered = np.column_stack([np.arange(1, len(elements) + 1), elements])
        np.savetxt(out, numbered, ", ".join(["%d"] * 9))
        for name, layer in (("BOTTOM", 0), ("TOP", size[2] - 1)):
            out.write(f"*NSET, NSET={name}\n")
            np.savetxt(out, np.flatnonzero(at[:, 2] == layer) + 1, "%d,")
    return len(points)
