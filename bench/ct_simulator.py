# SPDX-License-Identifier: Apache-2.0
"""A simulated scanner: parallel beams slice by slice, Poisson noise, filtered back projection.

The object lies in a cylinder of soft tissue with air around it. The detector averages over an aperture
wider than its step. What a slice shows is the mean of the object over the slice's thickness. Lengths
in mm, attenuation per mm, values in HU.
"""
import dataclasses

import numpy as np
from scipy import sparse

from volumes import Volume

WATER = 0.02
SOFT, BONE = 50.0, 1000.0
BODY = 55.0  # radius
VIEWS = 480
STEP = 0.5  # of the detector
APERTURE = 0.75
HALF_DETECTOR = 58.0
TRIAL_COUNTS = 1e5
FIELD = 27.0  # half of the side of the slices


@dataclasses.dataclass
class Scanner:
    kernel: str  # soft: a Hann window over the ramp; sharp: the ramp as it is
    noise: float  # HU, in the middle of the body; 0: none
    pixel: float
    slice_thickness: float


def bins(step):
    count = int(round(2 * HALF_DETECTOR / step))
    return (np.arange(count) + 0.5) * step - HALF_DETECTOR


def spread(coordinates, step):
    """Matrix, places by bins: the two bins next to each coordinate and their linear weights."""
    at = (coordinates + HALF_DETECTOR) / step - 0.5
    low = np.floor(at).astype(int)
    rows = np.arange(len(at))
    weights = np.concatenate([1 - (at - low), at - low])
    where = np.concatenate([rows, rows]), np.concatenate([low, low + 1])
    return sparse.csr_matrix((weights, where), (len(at), len(bins(step))))


def directions():
    angles = np.arange(VIEWS) * np.pi / VIEWS
    return zip(np.cos(angles), np.sin(angles))


def plane(line):
    x, y = np.meshgrid(line, line, indexing="ij")
    return x.ravel(), y.ravel()


def aperture_mean(fine, step):
    """Bins of the detector from fine ones: the mean over the aperture at each place."""
    ends = np.concatenate([np.zeros((1, fine.shape[1])), np.cumsum(fine, axis=0)])

    def primitive(t):
        at = np.clip((t + HALF_DETECTOR) / step, 0, len(fine) - 1e-9)
        low = at.astype(int)
        return ends[low] + (at - low)[:, None] * (ends[low + 1] - ends[low])
    t = bins(STEP)
    return (primitive(t + APERTURE / 2) - primitive(t - APERTURE / 2)) * step / APERTURE


def projections(object_slices, line):
    """Line integrals, views x bins x slices. `object_slices`: what the object adds, x, y, slice."""
    fine = line[1] - line[0]
    x, y = plane(line)
    values = object_slices.reshape(len(x), -1)
    used = np.any(values != 0, axis=1)
    x, y, values = x[used], y[used], values[used]
    t = bins(STEP)[:, None] + np.linspace(-0.5, 0.5, 9) * APERTURE
    body = 2 * np.sqrt(np.maximum(BODY**2 - t**2, 0)).mean(1) * WATER * (1 + SOFT / 1000)
    found = np.empty((VIEWS, len(t), values.shape[1]))
    for view, (c, s) in enumerate(directions()):
        sums = spread(c * x + s * y, fine).T @ values * fine
        found[view] = aperture_mean(sums, fine) + body[:, None]
    return found


def ramp(kernel, size):
    """The band-limited ramp of Ramachandran and Lakshminarayanan in the frequency domain."""
    n = np.minimum(np.arange(size), size - np.arange(size))
    taps = np.where(n % 2 == 1, -1 / (np.pi * np.maximum(n, 1) * STEP) ** 2, 0)
    taps[0] = 1 / (4 * STEP**2)
    response = np.fft.rfft(taps).real * STEP
    window = np.cos(np.pi * np.fft.rfftfreq(size)) ** 2  # Hann, zero at the Nyquist frequency
    return response * (window if kernel == "soft" else 1)


def reconstruction(lines, scanner):
    """Slices in HU from line integrals."""
    size = 2 ** int(np.ceil(np.log2(2 * lines.shape[1])))
    response = ramp(scanner.kernel, size)[:, None]
    line = pixel_line(scanner)
    x, y = plane(line)
    image = np.zeros((len(x), lines.shape[2]))
    for view, (c, s) in enumerate(directions()):
        filtered = np.fft.irfft(np.fft.rfft(lines[view], size, axis=0) * response, size, axis=0)
        image += spread(c * x + s * y, STEP) @ filtered[:lines.shape[1]]
    hounsfield = (image * np.pi / VIEWS / WATER - 1) * 1000
    return hounsfield.reshape(len(line), len(line), -1)


def pixel_line(scanner):
    count = int(2 * FIELD / scanner.pixel)
    return (np.arange(count) + 0.5) * scanner.pixel - count * scanner.pixel / 2


def counted(lines, counts, seed):
    """Line integrals as `counts` photons per ray without an object measure them."""
    found = np.random.default_rng(seed).poisson(counts * np.exp(-lines))
    return -np.log(np.maximum(found, 1) / counts)


def counts_for_noise(scanner):
    """Photons per ray for the wanted noise: from a trial on four slices of the body alone."""
    empty = projections(np.zeros((2, 2, 4)), np.array([-1.0, 1.0]))
    trial = reconstruction(counted(empty, TRIAL_COUNTS, 2), scanner)
    middle = trial[12:-12, 12:-12]
    return TRIAL_COUNTS * (middle.std() / scanner.noise) ** 2


def scan(grey, scanner, seed=1):
    """The scan of an object; `grey`: 1 for dense bone, 0 around it, on a fine grid."""
    fine = grey.spacing[2]
    layers = int(round(scanner.slice_thickness / fine))
    count = grey.values.shape[2] // layers
    start = (grey.values.shape[2] - count * layers) // 2
    part = grey.values[..., start:start + count * layers]
    slices = part.reshape(*part.shape[:2], count, layers).mean(3) * (BONE - SOFT) / 1000 * WATER
    line = grey.origin[0] + fine * np.arange(grey.values.shape[0])
    lines = projections(slices, line)
    if scanner.noise:
        lines = counted(lines, counts_for_noise(scanner), seed)
    middle = grey.origin[2] + fine * (start + (layers - 1) / 2)
    first = pixel_line(scanner)[0]
    return Volume(reconstruction(lines, scanner).astype(np.float32),
                  np.array([scanner.pixel, scanner.pixel, scanner.slice_thickness]),
                  np.array([first, first, middle]))
