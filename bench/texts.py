# SPDX-License-Identifier: Apache-2.0
"""The figures in the prose of pages, made by runs of mesamis: for tables.py."""
import re

from mesamis_runs import run
from pictures import femur_model, hip_in_dicom


def fenced(text):
    return f"\n```\n{text.strip()}\n```\n"


def tutorial_hip(runs):
    _, hip = hip_in_dicom(runs)
    return fenced(run("info", hip).stdout.replace(hip.name, "hip.stl"))


def tutorial_femur(runs):
    body = femur_model(runs)[1]["body"]
    elements = f"{body['elements']:,}".replace(",", " ")
    return f"{elements} elements, angles from {body['least_angle_deg']:.1f} degrees"


def report_summary(runs):
    names = "pelvis.stl", "pelvis.vtu", "report.html", "report.json"
    files = [runs.folder / name for name in names]
    options = zip(("-o", "--mesh", "--html", "--report"), files)
    done = run("segment", runs.scan("pelvis"), *(word for option in options for word in option))
    lines = [line for line in done.stderr.splitlines()
             if re.match(r"mesamis: (object|size|surface|error|files)  ", line)]
    return fenced("\n".join(lines).replace(f"{runs.folder}: ", ""))


# Name of the place in the page: the page, the scans that it needs, and how it is made.
TEXTS = {
    "tutorial-hip": ("docs/tutorial.md", [], tutorial_hip),
    "tutorial-femur": ("docs/tutorial.md", [], tutorial_femur),
    "report-summary": ("docs/report.md", ["pelvis"], report_summary),
}
