# SPDX-License-Identifier: Apache-2.0
"""The package writes the bytes that the program writes."""

import json
import warnings

import numpy as np
import pytest
from conftest import AFFINES

import mesamis

# Runs are kept short: that they have not converged is no matter here.
pytestmark = pytest.mark.filterwarnings("ignore:not converged")

SETTINGS = {"max_tets": 6000, "adaptations": 2, "beta": 2.5, "tol_mesh": 0.2}
OPTIONS = ["--max-tets", "6000", "--adaptations", "2", "--beta", "2.5", "--tol-mesh", "0.2"]


def same(tmp_path, name):
    return (tmp_path / name).read_bytes() == (tmp_path / ("python-" + name)).read_bytes()


def test_surfaces_meshes_and_reports_are_the_same(program, nifti, tmp_path):
    path = nifti(AFFINES["oblique"])
    names = ["a.stl", "a.vtp", "a.ply", "a.obj", "a.3mf"]
    done = program("segment", path, *[x for n in names for x in ("-o", n)], "--mesh", "a.vtu", "--mesh", "a.inp",
                   "--band-mesh", "band.vtu", "--report", "a.json", *OPTIONS)
    assert done.returncode in (0, 4), done.stderr
    result = mesamis.segment(path, **SETTINGS)
    for name in ["a.stl", "a.ply", "a.obj", "a.3mf", "a.vtu", "a.inp"]:
        result.save(tmp_path / ("python-" + name))
        assert same(tmp_path, name), name
    result.save(tmp_path / "python-band.vtu", band=True)
    assert same(tmp_path, "band.vtu")
    report = json.loads((tmp_path / "a.json").read_text())
    for key in ["program", "settings", "chosen", "given", "quality", "grey", "surface", "object", "input",
                "converged", "stopped"]:
        assert result.report[key] == report[key], key
    assert result.level == report["surface"]["level_native"]


def test_a_vtp_alone_with_the_error(program, nifti, tmp_path):
    path = nifti(AFFINES["plain"])
    assert program("segment", path, "-o", "e.vtp", "--error", "--preview", "--name", "hip",
                   "--frame", "ras").returncode == 0
    mesamis.segment(path, preview=True, frame="ras").save(tmp_path / "python-e.vtp", error=True, name="hip")
    assert same(tmp_path, "e.vtp")


def ct_with_table(tmp_path):
    """A body of soft tissue with a bone, a table under it, and padding around the field of view."""
    nibabel = pytest.importorskip("nibabel")
    i, j, k = np.meshgrid(np.arange(60), np.arange(60), np.arange(12), indexing="ij")
    ct = np.full(i.shape, -1000.0)
    ct[np.hypot(i - 29.5, j - 26) < 17] = 40
    ct[np.hypot(i - 29.5, j - 30) < 5] = 900
    ct[(j >= 49) & (j < 53) & (abs(i - 29.5) < 14)] = 200
    ct += np.random.default_rng(5).normal(0, 6, ct.shape)
    ct[np.hypot(i - 29.5, j - 29.5) > 29.4] = -3024
    nibabel.save(nibabel.Nifti1Image(np.round(ct).astype(np.int16), np.diag([4.0, 4, 4, 1])),
                 tmp_path / "ct.nii.gz")
    return tmp_path / "ct.nii.gz"


def test_padding_and_table_go_as_in_the_program(program, tmp_path):
    path = ct_with_table(tmp_path)
    args = ["--tissue", "bone", "--preview"]
    assert program("segment", path, "-o", "c.stl", "--report", "c.json", *args).returncode == 0
    report = json.loads((tmp_path / "c.json").read_text())
    assert report["object"]["padding"] and report["object"]["removed"], "the scan has both"
    volume = mesamis.read_volume(path)
    for scan, place in [(path, {}), (volume, {}), (volume.array, {"affine": volume.affine})]:
        result = mesamis.segment(scan, **place, tissue="bone", preview=True)
        result.save(tmp_path / "python-c.stl")
        assert same(tmp_path, "c.stl")
        assert result.report["object"] == report["object"]
        assert any("padding" in note for note in result.notes)


def test_labels_are_the_same(program, nifti, samples, tmp_path):
    import nibabel

    path = nifti(AFFINES["oblique"])
    labels = (samples > 500).astype(np.uint8)
    labels[:12] *= 2
    nibabel.save(nibabel.Nifti1Image(labels, AFFINES["oblique"]), tmp_path / "labels.nii")
    assert program("segment", path, "--labels", "labels.nii", "-o", "{label}.stl", "-o", "all.vtp", "--mesh",
                   "l.vtu", "--labelmap", "found.nrrd", "--report", "l.json", "--max-tets", "4000").returncode == 0
    report = json.loads((tmp_path / "l.json").read_text())
    for given in [tmp_path / "labels.nii", labels, nibabel.load(tmp_path / "labels.nii")]:
        mesh = given is labels
        result = mesamis.segment(path, labels=given, mesh=mesh, max_tets=4000)
        assert [o.name for o in result] == ["label 1", "label 2"]
        result.save(tmp_path / "python-{label}.stl")
        result.save(tmp_path / "python-all.vtp")
        if mesh:
            result.save(tmp_path / "python-l.vtu")
        result.save_labelmap(tmp_path / "python-found.nrrd")
        for name in ["label_1.stl", "label_2.stl", "all.vtp", "found.nrrd", *(["l.vtu"] if mesh else [])]:
            assert same(tmp_path, name), name
        assert result.report["settings"] == report["settings"]
        assert result.report["object"] == report["object"]


@pytest.mark.parametrize("given", [False, True])
def test_bodies_are_the_same(given, program, nifti, tmp_path):
    """With all defaults, and with all that can be asked for."""
    path = nifti(AFFINES["mirrored"])
    options, keywords, settings = [], {}, {}
    if given:
        options = ["--element-size", "2.5", "--least-size", "0.7", "--element-gradation", "0.8", "--wall-elements",
                   "2", "--element", "tet10", "--ash", "equal", "--material-gap", "80", "--material-rim", "0.5",
                   "--poisson", "0.35", "--tolerance", "0.15", "--frame", "ras", "--set", "SIDE=normal:1,0,0,30"]
        keywords = {"element_size": 2.5, "least_size": 0.7, "gradation": 0.8, "wall_elements": 2, "quadratic": True,
                    "ash": "equal", "material_gap": 80, "material_rim": 0.5, "poisson": 0.35,
                    "sets": ["SIDE=normal:1,0,0,30"]}
        settings = {"tolerance": 0.15, "frame": "ras"}
    material = ["--material", "keyak-1994", "--calibration", "0,0.001"]
    done = program("segment", path, "--preview", "--body", "b.inp", *material, *options)
    assert done.returncode in (0, 4), done.stderr
    result = mesamis.segment(path, preview=True, **settings)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", mesamis.MesamisWarning)  # a promise that the program misses, too
        body = mesamis.make_body(result, material="keyak-1994", calibration="0,0.001", **keywords)
    body.save(tmp_path / "python-b.inp")
    assert same(tmp_path, "b.inp")
    assert (done.returncode == 4) == bool(body.warnings)


def test_places_are_the_same(program, nifti, tmp_path):
    path = nifti(AFFINES["mirrored"])
    seed = [9.7, -21.85, 20.0]  # RAS
    assert program("segment", path, "-o", "p.stl", "--preview", "--frame", "ras", "--seed",
                   ",".join(map(str, seed)), "--box=:30,-40:,", "--level", "400").returncode == 0
    result = mesamis.segment(path, preview=True, frame="ras", seeds=seed, box=((None, 30), (-40, None), None),
                             level=400)
    result.save(tmp_path / "python-p.stl")
    assert same(tmp_path, "p.stl")


def test_the_error_is_the_programs_line(program, nifti, tmp_path):
    path = nifti(AFFINES["plain"])
    for arguments, settings in [
        (["--level", "99999"], {"level": 99999}),
        (["--tissue", "dragon"], {"tissue": "dragon"}),
        (["--crop", "0:1,,", "--preview"], {"crop": ((0, 1), None, None)}),
    ]:
        done = program("segment", path, "-o", "x.stl", *arguments)
        with pytest.raises(mesamis.InputError) as caught:
            mesamis.segment(path, **settings)
        assert done.returncode in (2, 3)
        message = str(caught.value)
        assert "\n" not in message
        assert message.split(": ", 1)[-1].split(", found")[0] in done.stderr
    done = program("segment", tmp_path / "none.nii", "-o", "x.stl")
    with pytest.raises(mesamis.InputError) as caught:
        mesamis.segment(tmp_path / "none.nii")
    assert str(caught.value) in done.stderr


def test_phantoms_distances_and_decimation_are_the_same(program, tmp_path):
    assert program("phantom", "sphere", "-o", "f.nrrd", "--truth", "f.ply", "--size", "16,16,18", "--spacing",
                   "4,4,3", "--noise", "3", "--seed", "9").returncode == 0
    scan = mesamis.phantom("sphere", size=(16, 16, 18), spacing=(4, 4, 3), noise=3, seed=9)
    mesamis.write_volume(tmp_path / "python-f.nrrd", scan)
    truth = mesamis.phantom_surface("sphere", size=(16, 16, 18), spacing=(4, 4, 3))
    truth.save(tmp_path / "python-f.ply", name="sphere")
    assert same(tmp_path, "f.nrrd") and same(tmp_path, "f.ply")

    assert program("decimate", "f.ply", "-o", "d.ply", "--tolerance", "0.5").returncode == 0
    fewer = mesamis.decimate(tmp_path / "f.ply", tolerance=0.5)
    fewer.save(tmp_path / "python-d.ply")
    assert same(tmp_path, "d.ply")
    ras = mesamis.decimate(mesamis.Surface(truth.points * [-1, -1, 1], truth.triangles, "ras"), tolerance=0.5)
    assert ras.frame == "ras" and np.array_equal(ras.points, fewer.points * [-1, -1, 1])

    assert program("compare", "f.ply", "d.ply", "--report", "c.json").returncode == 0
    report = json.loads((tmp_path / "c.json").read_text())
    found = mesamis.compare(tmp_path / "f.ply", fewer).report
    assert all(report[key] == value for key, value in found.items())


def test_remeshing_is_the_same(program, tmp_path):
    start = mesamis.box_mesh((0, 0, 0), (2, 1, 1), (4, 2, 2))
    sizes = 0.15 + 0.2 * start.nodes[:, 0]
    start.save(tmp_path / "start.mesh")
    rows = "\n".join(f"{1 / s**2!r} 0 {1 / s**2!r} 0 0 {1 / s**2!r}" for s in sizes.tolist())
    (tmp_path / "m.sol").write_text(
        f"MeshVersionFormatted 2\nDimension 3\nSolAtVertices\n{len(sizes)}\n1 3\n{rows}\nEnd\n")
    done = program("remesh", "start.mesh", "--metric", "m.sol", "-o", "new.mesh", "--report", "r.json")
    assert done.returncode == 0, done.stderr
    adapted = mesamis.remesh(start, sizes)
    adapted.save(tmp_path / "python-new.mesh")
    assert same(tmp_path, "new.mesh")
    report = json.loads((tmp_path / "r.json").read_text())
    assert adapted.report["mesh"] == report["mesh"] and adapted.report["converged"] == report["converged"]
