# SPDX-License-Identifier: Apache-2.0
"""Surfaces that a user gets from common tools, tuned with knowledge of the truth.

The widths of a Gaussian (voxels) and the levels (shares of the contrast) that give the smallest sum of
both mean distances are sought: first over a grid, then along the level alone.
"""
import vtk
from scipy.optimize import minimize_scalar

from volumes import SPECK, isosurface, smoothed, upsampled

WIDTHS = (0, 0.5, 0.7, 0.9, 1.1, 1.4)
SHARES = (0.35, 0.425, 0.5, 0.575, 0.65)
PASS_BANDS = (0.02, 0.05, 0.1, 0.2, 0.4)
QUICK = 4000  # samples per direction while tuning
LEVEL_STEPS = 8


def sinc(surface, pass_band, iterations=20):
    """The windowed sinc of Taubin over the triangles of a surface."""
    smoother = vtk.vtkWindowedSincPolyDataFilter()
    smoother.SetInputData(surface)
    smoother.SetPassBand(pass_band)
    smoother.SetNumberOfIterations(iterations)
    smoother.NormalizeCoordinatesOn()
    smoother.BoundarySmoothingOff()
    smoother.Update()
    return smoother.GetOutput()


def decimated(surface, triangles):
    """By quadrics to that many triangles."""
    share = 1 - triangles / max(surface.GetNumberOfPolys(), 1)
    if share <= 0:
        return surface
    decimation = vtk.vtkQuadricDecimation()
    decimation.SetInputData(surface)
    decimation.SetTargetReduction(share)
    decimation.Update()
    return decimation.GetOutput()


class Tuner:
    """One scan, its truth, and the surfaces that were tried."""

    def __init__(self, scan, values, judge):
        self.scan, self.values, self.judge = scan, values, judge
        self.grids = {}

    def level(self, share):
        outside, inside = self.values
        return outside + share * (inside - outside)

    def surface(self, width, level, doubled=False):
        if (width, doubled) not in self.grids:
            grid = smoothed(self.scan, width)
            self.grids[width, doubled] = upsampled(grid) if doubled else grid
        return isosurface(self.grids[width, doubled], level, SPECK * (8 if doubled else 1))

    def score(self, width, share, doubled=False):
        return self.judge.measure(self.surface(width, self.level(share), doubled), QUICK)["sum"]

    def isosurface(self, widths, shares, doubled=False):
        """Width and share of the best one."""
        _, width, share = min((self.score(w, s, doubled), w, s) for w in widths for s in shares)
        reach = shares[1] - shares[0]
        low = share - (2 if share == min(shares) else 1) * reach
        high = share + (2 if share == max(shares) else 1) * reach
        found = minimize_scalar(lambda s: self.score(width, s, doubled), bounds=(low, high),
                                method="bounded", options={"maxiter": LEVEL_STEPS, "xatol": 1e-3})
        return width, float(found.x)

    def finished(self, surface, **settings):
        return self.judge.measure(surface) | settings

    def all(self):
        """The best of each kind, measured in full, by its name."""
        width, share = self.isosurface(WIDTHS, SHARES)
        at = WIDTHS.index(width)
        near = WIDTHS[max(at - 1, 0):at + 2]
        width2, share2 = self.isosurface(near, (share - 0.05, share, share + 0.05), True)
        tried = [(self.judge.measure(sinc(self.surface(w, self.level(share)), b), QUICK)["sum"], w, b)
                 for w in {0, width} for b in PASS_BANDS]
        _, rough, band = min(tried)
        smooth = sinc(self.surface(rough, self.level(share)), band)
        middle = self.level(0.5)
        return {"cubes": self.finished(self.surface(width, self.level(share)), width=width,
                                       share=share),
                "doubled": self.finished(self.surface(width2, self.level(share2), True),
                                         width=width2, share=share2),
                "sinc": self.finished(smooth, width=rough, share=share, band=band),
                "untuned": self.finished(sinc(self.surface(0, middle), 0.1))}

    def at_level(self, level):
        """The smallest sum at a given level."""
        return min(self.judge.measure(self.surface(w, level))["sum"] for w in WIDTHS)


def best_of(found):
    """Name and measures of the best tuned rival."""
    return min(((name, m) for name, m in found.items() if name != "untuned"),
               key=lambda pair: pair[1]["sum"])


def label(name, found):
    """What a rival's settings were."""
    band = f", {found['band']}" if "band" in found else ""
    return f"{name} {found['width']}, {100 * found['share']:.0f} %{band}"
