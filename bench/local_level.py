# SPDX-License-Identifier: Apache-2.0
"""A level for each place of a CT, found on its voxels: what is left of the grey values is an image whose
isosurface at 0 is the rival of ours.

Where the gradient is greatest along itself there is an edge; its level is midway between the values within
two voxels on either side. Elsewhere it is the mean of the edges around (Gaussian of three voxels, weighted
by their contrast), and that of the scan far from all of them. Skin against air is no edge here.
"""
import numpy as np
from scipy import ndimage

GRADIENT, AROUND = 0.8, 3.0  # voxels, of Gaussians
SIDES = (0.5, 1.0, 1.5, 2.0)  # voxels from an edge
LEAST, MOST = 100.0, 600.0  # contrast of an edge, and what of it counts
LEAST_BRIGHT, LEAST_DARK = 150.0, -250.0
FAR = 0.02  # of the usual weight of an edge: the level of the scan


def along(values, way, step):
    """The values at a step from each voxel."""
    return ndimage.map_coordinates(values, np.indices(values.shape) + step * way, order=1, mode="nearest")


def local_level(values, level):
    values = np.clip(values, -200, 1500).astype(np.float32)
    way = np.stack(np.gradient(ndimage.gaussian_filter(values, GRADIENT)))
    steep = np.linalg.norm(way, axis=0)
    way /= np.maximum(steep, 1e-6)
    bright = np.max([along(values, way, t) for t in SIDES], axis=0)
    dark = np.min([along(values, way, -t) for t in SIDES], axis=0)
    is_edge = (steep >= along(steep, way, 1)) & (steep >= along(steep, way, -1))
    is_edge &= (bright - dark > LEAST) & (bright > LEAST_BRIGHT) & (dark > LEAST_DARK)
    weight = np.where(is_edge, np.minimum(bright - dark, MOST), 0)
    far = FAR * np.median(weight[is_edge])
    sums = ndimage.gaussian_filter(weight * (bright + dark) / 2, AROUND) + far * level
    return sums / (ndimage.gaussian_filter(weight, AROUND) + far)
