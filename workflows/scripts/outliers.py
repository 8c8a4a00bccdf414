# SPDX-License-Identifier: Apache-2.0
"""Figures that lie far from those of the other runs: robust z-scores."""
import math
from collections import namedtuple
from statistics import median

# is_ratio: compared as logarithms, since twice and half of a volume are equally far from it.
# floor: a spread below it counts as it, so that tiny differences between equal runs do not count;
# with is_ratio a share, else in the figure's unit, or with is_share a share of the median.
Figure = namedtuple("Figure", "key title unit is_ratio floor is_share")
FIGURES = (Figure("volume", "volume", "cm³", True, 0.02, False),
           Figure("area", "area", "cm²", True, 0.02, False),
           Figure("parts", "parts", "", False, 0.25, False),
           Figure("level", "level", "native", False, 0.01, True),
           Figure("error", "expected error", "mm", True, 0.05, False),
           Figure("seconds", "time", "s", True, 0.1, False))
FEWEST = 5             # runs that say what is usual
MAD_TO_SIGMA = 1.4826  # of a normal distribution

Score = namedtuple("Score", "z middle")


def _scaled(figure, value):
    if not figure.is_ratio:
        return value
    return math.log(value) if value > 0 else None


def scores_of(figure, values):
    """One Score for each value, None where there is no value or fewer than FEWEST of them.
    z = (x - median) / max(1.4826 MAD, floor); x is the logarithm where figure.is_ratio."""
    scaled = [None if v is None or not math.isfinite(v) else _scaled(figure, v) for v in values]
    known = [x for x in scaled if x is not None]
    if len(known) < FEWEST:
        return [None] * len(values)
    middle = median(known)
    floor = figure.floor * (abs(middle) if figure.is_share else 1)
    spread = max(MAD_TO_SIGMA * median(abs(x - middle) for x in known), floor)
    shown = math.exp(middle) if figure.is_ratio else middle
    if spread == 0:  # a median of 0 and more than half of the values there
        return [None if x is None else Score(0.0, shown) for x in scaled]
    return [None if x is None else Score((x - middle) / spread, shown) for x in scaled]


def mark_outliers(rows, limit):
    """Adds "scores" {key: Score} and "outliers" [key] to each row, which has "figures" {key: value
    or None}. Rows are compared with those of the same "kind"."""
    for row in rows:
        row["scores"], row["outliers"] = {}, []
    for kind in dict.fromkeys(row["kind"] for row in rows):
        alike = [row for row in rows if row["kind"] == kind]
        for figure in FIGURES:
            scores = scores_of(figure, [row["figures"].get(figure.key) for row in alike])
            for row, score in zip(alike, scores):
                if score is None:
                    continue
                row["scores"][figure.key] = score
                if abs(score.z) > limit:
                    row["outliers"].append(figure.key)
