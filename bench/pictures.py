# SPDX-License-Identifier: Apache-2.0
"""The pictures of README.md and docs/, each made by commands from scans and phantoms; tables.py --all calls this."""
import shutil
import subprocess
import sys

from mesamis_runs import once, run

BROWSERS = ("chromium-headless-shell", "chromium")
ELEMENTS = 2  # mm, of the body


def small(*size):
    """Options of `mesamis picture` for a picture of so many pixels."""
    return "--size", ",".join(map(str, size))


def draw(out, shape, *options):
    run("picture", shape, "-o", out, *options)


def phantom(runs, name, *options):
    """Scan and true surface of a phantom."""
    scan = runs.folder / f"{name}.nrrd"
    truth = scan.with_suffix(".truth.ply")
    once(scan.with_suffix(".json"), "phantom", name, "-o", scan, "--truth", truth, *options)
    return scan, truth


def surface(runs, out):
    draw(out, runs.segment("head")[1], "--view", "oblique", *small(560, 450))


def mesh(runs, out):
    draw(out, runs.segment("head")[1].with_suffix(".vtu"), "--view", "top", "--clip", "z,60", "--color", "u",
         "--edges", *small(560, 450))


def slice_of_scan(runs, out):
    draw(out, runs.scan("head"), "--clip", "z,60", "--outline", runs.segment("head")[1], *small(560, 450))


def page(runs, out):
    """The top of the page of a run, in a browser without a window."""
    browser = next((name for name in BROWSERS if shutil.which(name)), None)
    if not browser:
        sys.exit(f"pictures: expected {' or '.join(BROWSERS)} in PATH, found none")
    ours = runs.segment("head")[1]
    html = ours.with_suffix(".html")
    run("report", ours.with_suffix(".json"), "--html", html)
    subprocess.run([browser, "--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
                    "--enable-unsafe-swiftshader", "--virtual-time-budget=60000", "--no-first-run",
                    "--disable-background-networking", "--disable-component-update", "--disable-sync",
                    f"--user-data-dir={runs.folder / 'profile'}", "--hide-scrollbars", "--window-size=1100,1400",
                    f"--screenshot={out}", f"file://{html.resolve()}"],
                   check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=300)


def skull(runs, out):
    draw(out, runs.segment("skull")[1], "--view", "front", *small(460, 400))


def skull_cubes(runs, out):
    level = runs.segment("skull")[0]["surface"]["level_native"]
    draw(out, runs.cubes("skull", level)[1], "--view", "front", *small(460, 400))


def hemipelvis(runs, out):
    draw(out, phantom(runs, "hemipelvis")[1], "--view", "oblique", *small(420, 520))


def femur(runs, out):
    scan, truth = phantom(runs, "femur")
    draw(out, scan, "--clip", "y,32", "--outline", truth, *small(420, 520))


def fracture(runs, out):
    draw(out, phantom(runs, "fracture")[1], "--view", "oblique", *small(420, 520))


def body(runs, out):
    scan, _ = phantom(runs, "hemipelvis")
    filled = runs.folder / "hemipelvis.body.vtu"
    once(filled.with_suffix(".json"), "segment", scan, "--body", filled, "--element-size", ELEMENTS)
    draw(out, filled, "--view", "oblique", "--clip", "x,0", "--edges", *small(560, 440))


# Name of the file in docs/images: the page that shows it, the scans that it needs, and how it is made.
PICTURES = {
    "surface.png": ("README.md", ["head"], surface),
    "mesh.png": ("README.md", ["head"], mesh),
    "slice.png": ("README.md", ["head"], slice_of_scan),
    "report.png": ("README.md", ["head"], page),
    "phantom.png": ("docs/results.md", ["skull"], skull),
    "phantom_cubes.png": ("docs/results.md", ["skull"], skull_cubes),
    "phantom_hemipelvis.png": ("docs/phantoms.md", [], hemipelvis),
    "phantom_femur.png": ("docs/phantoms.md", [], femur),
    "phantom_fracture.png": ("docs/phantoms.md", [], fracture),
    "body.png": ("docs/body.md", [], body),
}
