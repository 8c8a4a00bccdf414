# SPDX-License-Identifier: Apache-2.0
"""The pictures of README.md and docs/, each made by commands from scans and phantoms; tables.py --all calls this."""
import pathlib
import shutil
import subprocess
import sys

from mesamis_runs import once, run

BROWSERS = ("chromium-headless-shell", "chromium")
ELEMENTS = 5  # mm, of the body
TUTORIAL = pathlib.Path(__file__).resolve().parent.parent / "examples/tutorial"


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
    draw(out, filled, "--view", "oblique", "--clip", "x,97", "--edges", *small(560, 440))


def left_hip(runs):
    """The bone of the looks study that is one voxel thick in places."""
    from looks_study import GUIDING, Bone  # which needs VTK and nibabel
    return Bone(runs.scans, *GUIDING["left hip"])


def hip(runs, out):
    draw(out, left_hip(runs).ours(runs.folder, "left hip"), "--view", "front", *small(420, 450))


def hip_slicer(runs, out):
    from distances import write_surface
    surface = runs.folder / "left_hip.slicer.vtp"
    write_surface(surface, left_hip(runs).slicer())
    draw(out, surface, "--view", "front", *small(420, 450))


def example(name, *arguments):
    """A script of the tutorial; it needs what docs/tutorial.md says."""
    subprocess.run([sys.executable, TUTORIAL / name, *arguments], check=True, stdout=subprocess.DEVNULL)


def hip_in_dicom(runs):
    """Folder of slices and surface of the tutorial's hip bone."""
    scan = runs.folder / "tutorial_hip.nrrd"
    once(scan.with_suffix(".json"), "phantom", "hemipelvis", "--size", "102,122,152", "--spacing", "2,2,2",
         "--noise", "5", "--type", "short", "-o", scan)
    slices = runs.folder / "tutorial_dicom"
    example("make_dicom.py", scan, slices)
    hip = runs.folder / "tutorial_hip.stl"
    once(hip.with_suffix(".run.json"), "segment", slices, "--tissue", "bone", "--keep-largest", 1, "-o", hip)
    return slices, hip


def tutorial_hip(runs, out):
    draw(out, hip_in_dicom(runs)[1], "--view", "left", *small(420, 520))


def tutorial_slice(runs, out):
    slices, hip = hip_in_dicom(runs)
    draw(out, slices, "--clip", "z,200", "--outline", hip, *small(420, 520))


def femur_model(runs):
    """Body and report of the tutorial's femur."""
    scan = runs.folder / "tutorial_femur.nrrd"
    truth, labels, filled = (scan.with_suffix(end) for end in (".ply", ".nii.gz", ".vtu"))
    once(scan.with_suffix(".json"), "phantom", "femur", "--noise", 4, "-o", scan, "--truth", truth)
    run("label", truth, "--like", scan, "-o", labels)
    return filled, once(filled.with_suffix(".run.json"), "segment", scan, "--labels", labels, "--body", filled,
                        "--element-size", 4, "--material", "keyak-1994", "--calibration", "120:0,230:1.2")


def tutorial_stiffness(runs, out):
    draw(out, femur_model(runs)[0], "--color", "modulus", "--view", "front", "--clip", "y,32", "--edges", *small(420, 520))


def tutorial_thickness(runs, out):
    scan = runs.folder / "tutorial_wall.nrrd"
    wall, coloured = scan.with_suffix(".ply"), scan.with_suffix(".vtp")
    once(scan.with_suffix(".json"), "phantom", "wall", "--spacing", "0.05,0.05,0.05", "--noise", 5, "-o", scan)
    once(wall.with_suffix(".run.json"), "segment", scan, "--tolerance", "0.002", "-o", wall)
    example("thickness.py", wall, coloured)
    draw(out, coloured, "--color", "thickness", "--view", "front", *small(420, 520))


# Name of the file in docs/images: the page that shows it, the scans that it needs, and how it is made.
PICTURES = {
    "surface.png": ("README.md", ["head"], surface),
    "mesh.png": ("docs/gallery.md", ["head"], mesh),
    "slice.png": ("docs/gallery.md", ["head"], slice_of_scan),
    "report.png": ("docs/report.md", ["head"], page),
    "phantom.png": ("docs/results.md", ["skull"], skull),
    "phantom_cubes.png": ("docs/results.md", ["skull"], skull_cubes),
    "phantom_hemipelvis.png": ("docs/phantoms.md", [], hemipelvis),
    "phantom_femur.png": ("docs/phantoms.md", [], femur),
    "phantom_fracture.png": ("docs/phantoms.md", [], fracture),
    "hip.png": ("README.md", ["pelvis"], hip),
    "hip_slicer.png": ("README.md", ["pelvis"], hip_slicer),
    "body.png": ("docs/body.md", [], body),
    "tutorial_hip.png": ("docs/tutorial.md", [], tutorial_hip),
    "tutorial_slice.png": ("docs/tutorial.md", [], tutorial_slice),
    "tutorial_stiffness.png": ("docs/tutorial.md", [], tutorial_stiffness),
    "tutorial_thickness.png": ("docs/tutorial.md", [], tutorial_thickness),
}
