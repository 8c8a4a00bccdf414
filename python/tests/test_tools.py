# SPDX-License-Identifier: Apache-2.0
"""Remeshing, distances, decimation, bodies, files."""

import pickle
import warnings

import numpy as np
import pytest

import mesamis


def test_remesh_follows_an_own_metric():
    start = mesamis.box_mesh((0, 0, 0), (10, 10, 10), 6)
    z = start.nodes[:, 2]
    sizes = 0.6 + 0.3 * np.abs(z - 5)
    adapted = mesamis.remesh(start, sizes)
    assert (adapted.volumes > 0).all() and adapted.volumes.sum() == pytest.approx(1000)
    middle = adapted.nodes[adapted.tets].mean(axis=1)[:, 2]
    near, far = np.abs(middle - 5) < 1, np.abs(middle - 5) > 4
    assert adapted.volumes[near].mean() < adapted.volumes[far].mean() / 5
    assert adapted.report["mesh"]["edge_unit_fraction"] > 0.9


def test_a_metric_may_be_sizes_matrices_or_six_numbers():
    start = mesamis.box_mesh((0, 0, 0), (1, 1, 1), 3)
    n = len(start.nodes)
    sizes = np.full(n, 0.3)
    matrices = np.tile(np.eye(3) / 0.09, (n, 1, 1))
    six = np.tile(np.array([1, 0, 0, 1, 0, 1]) / 0.09, (n, 1))
    a, b, c = (mesamis.remesh(start, m) for m in (sizes, matrices, six))
    assert np.allclose(a.nodes, b.nodes) and np.allclose(b.nodes, c.nodes)
    for bad, message in [
        (sizes[1:], "expected 64 metrics"), (-sizes, "sizes above 0"), (six[:, :5], r"shape \(n, 6\)"),
        (-six, "positive definite"), (np.tile(np.triu(np.ones((3, 3))), (n, 1, 1)), "symmetric"),
    ]:
        with pytest.raises(mesamis.InputError, match=message):
            mesamis.remesh(start, bad)
    with pytest.raises(mesamis.InputError, match="not a mesh of its bounding box"):
        mesamis.remesh((start.nodes, start.tets[1:]), sizes)
    with pytest.raises(mesamis.InputError, match="tets"):
        mesamis.remesh((start.nodes, -start.tets), sizes)


def test_remesh_of_a_result(result):
    coarse = mesamis.remesh(result, 0.5 * result.metric, max_tets=3000)
    assert len(coarse.tets) < len(result.tets)


def test_decimate_keeps_its_promise():
    truth = mesamis.phantom_surface("femur", size=(24, 24, 36), spacing=2)
    fewer = mesamis.decimate(truth, tolerance=0.3)
    assert len(fewer.triangles) < len(truth.triangles) / 3
    c = mesamis.compare(truth, fewer)
    assert c.max <= 0.3
    assert np.array_equal(fewer.points, np.float32(fewer.points)), "values of single precision"
    for arguments, message in [
        ({}, "expected tolerance or triangles"), ({"tolerance": -1}, "tolerance: expected 0"),
        ({"tolerance": 1, "min_volume": 1e9}, "expected a part of at least min_volume"),
    ]:
        with pytest.raises(mesamis.InputError, match=message):
            mesamis.decimate(truth, **arguments)
    with pytest.raises(mesamis.InputError, match="closed"):
        mesamis.decimate((truth.points, truth.triangles[1:]), tolerance=1)
    with pytest.raises(mesamis.InputError, match="triangle 0 names point"):
        mesamis.decimate((truth.points[:5], truth.triangles), tolerance=1)

def two_cubes():
    """Surfaces of two cubes of many triangles, the upper one on the lower: they share a face."""
    corners = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)], dtype=float)
    faces = np.array([[0, 2, 3], [0, 3, 1], [4, 5, 7], [4, 7, 6], [0, 1, 5], [0, 5, 4], [2, 6, 7], [2, 7, 3],
                      [0, 4, 6], [0, 6, 2], [1, 3, 7], [1, 7, 5]])
    for _ in range(2):  # each triangle becomes four
        edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
        ends, number = np.unique(edges, axis=0, return_inverse=True)
        ab, bc, ca = number.reshape(3, -1) + len(corners)
        (a, b, c), corners = faces.T, np.concatenate([corners, corners[ends].mean(axis=1)])
        faces = np.concatenate([np.stack(t, axis=1) for t in ((a, ab, ca), (ab, b, bc), (ca, bc, c), (ab, bc, ca))])
    return {"lower": (4 * corners, faces), "upper": (4 * corners + [0, 0, 4], faces)}


def write_cubes(path, frame="lps", names=("lower", "upper")):
    """A file of both, as many programs write them: labels 7 and 3, colours."""
    objects = [{"name": name, "label": label, "colour": colour, "points": points, "triangles": triangles}
               for name, label, colour, (points, triangles)
               in zip(names, (7, 3), ((10, 20, 30), (40, 50, 60)), two_cubes().values())]
    mesamis._core.write_objects(str(path), objects, frame, "cubes")


@pytest.mark.parametrize("extension", [".3mf", ".vtp", ".obj", ".amf"])
def test_decimate_keeps_each_object_of_a_file(tmp_path, program, extension):
    write_cubes(tmp_path / f"a{extension}")
    fewer = mesamis.decimate(tmp_path / f"a{extension}", tolerance=0.05)
    assert isinstance(fewer, mesamis.LabelResult) and fewer.frame == "lps"
    assert [(o.name, o.label) for o in fewer] == [("lower", 7), ("upper", 3)]
    assert [tuple(o.colour) for o in fewer] == [(10, 20, 30), (40, 50, 60)]
    assert [(r["name"], r["label"]) for r in fewer.report["surfaces"]] == [("lower", 7), ("upper", 3)]
    assert all(r["closed"] for r in fewer.report["surfaces"]) and fewer.nodes is None
    shared = [{tuple(p) for p in o.points if p[2] == 4} for o in fewer]
    assert shared[0] == shared[1] and len(shared[0]) >= 4
    for o in fewer:
        assert len(o.triangles) == 12 and mesamis.compare(two_cubes()[o.name], o).max < 0.05
    fewer.save(tmp_path / "python.3mf")
    assert program("decimate", f"a{extension}", "-o", "program.3mf", "--tolerance", "0.05").returncode == 0
    assert (tmp_path / "python.3mf").read_bytes() == (tmp_path / "program.3mf").read_bytes()
    fewer.save(tmp_path / "{label}.stl")
    assert len(mesamis.read_surface(tmp_path / "upper.stl").triangles) == 12


def test_decimate_counts_shared_triangles_once(tmp_path):
    write_cubes(tmp_path / "a.vtp")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert sum(len(o.triangles) for o in mesamis.decimate(tmp_path / "a.vtp", triangles=22)) == 24
    with pytest.warns(mesamis.MesamisWarning, match="triangles: expected 10 at most, found 22: "):
        mesamis.decimate(tmp_path / "a.vtp", triangles=10, tolerance=0.01)


@pytest.mark.parametrize("frame", ["lps", "ras", None])
def test_decimated_objects_stay_in_the_frame_of_their_file(tmp_path, frame):
    write_cubes(tmp_path / "a.vtp", frame or "")
    fewer = mesamis.decimate(tmp_path / "a.vtp", tolerance=0.05)
    assert fewer.frame == frame and fewer.nodes is None
    before = mesamis.read_surface(tmp_path / "a.vtp")
    assert np.array_equal(np.concatenate([o.points for o in fewer]).max(axis=0), before.points.max(axis=0))
    for again in (fewer, pickle.loads(pickle.dumps(fewer)), mesamis.decimate(fewer, tolerance=0.05)):
        again.save(tmp_path / "b.vtp")
        after = mesamis.read_surface(tmp_path / "b.vtp")
        assert after.frame == frame and np.array_equal(after.points.max(axis=0), before.points.max(axis=0))


def test_decimate_of_a_result_with_several_objects(ball):
    i = np.arange(24)[:, None, None]
    labels = np.where(ball.array > 128, np.where(i < 12, 1, 2), 0)
    found = mesamis.segment(ball, labels=labels, label_names={1: "left", 2: "right"}, preview=True)
    fewer = mesamis.decimate(found, tolerance=0.5)
    assert [o.name for o in fewer] == ["left", "right"] and fewer["left"].colour == found["left"].colour
    assert sum(len(o.triangles) for o in fewer) < sum(len(o.triangles) for o in found) / 2
    assert mesamis.compare(found, fewer).objects["left"].mean < 1


def test_decimate_says_which_objects_went_or_are_open(tmp_path):
    write_cubes(tmp_path / "a.vtp")
    with pytest.raises(mesamis.InputError, match="expected a part of at least min_volume, found none"):
        mesamis.decimate(tmp_path / "a.vtp", tolerance=1, min_volume=100)
    crumb = two_cubes()["lower"]
    objects = [{"name": "big", "label": 1, "colour": (1, 2, 3), "points": crumb[0], "triangles": crumb[1]},
               {"name": "crumb", "label": 2, "colour": (1, 2, 3), "points": 0.1 * crumb[0] + 9, "triangles": crumb[1]}]
    mesamis._core.write_objects(str(tmp_path / "c.vtp"), objects, "lps", "")
    with pytest.warns(mesamis.MesamisWarning, match="crumb: no part of at least min_volume"):
        assert [o.name for o in mesamis.decimate(tmp_path / "c.vtp", tolerance=0.05, min_volume=1)] == ["big"]
    (tmp_path / "d.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                    "g a\nf 1 3 2\nf 1 2 4\ng b\nf 2 3 4\nf 1 4 3\n")
    with pytest.warns(mesamis.MesamisWarning, match="taken as one surface without names"):
        assert isinstance(mesamis.decimate(tmp_path / "d.obj", tolerance=0.2), mesamis.Surface)
    fewer = mesamis.decimate(tmp_path / "a.vtp", tolerance=0.05)
    with pytest.raises(mesamis.InputError, match="found decimated objects"):
        fewer.save(tmp_path / "a.html")


def test_compare_measures_objects_of_one_name(tmp_path):
    write_cubes(tmp_path / "a.3mf")
    write_cubes(tmp_path / "b.vtp", "ras")
    with pytest.warns(mesamis.MesamisWarning, match="turned from RAS to LPS"):
        own = mesamis.compare(tmp_path / "a.3mf", tmp_path / "b.vtp")
    assert list(own.objects) == ["lower", "upper"] and own.max < 1e-6
    swapped = tmp_path / "swapped.vtp"
    write_cubes(swapped, names=("upper", "lower"))
    found = mesamis.compare(tmp_path / "a.3mf", swapped)
    assert found.max < 1e-6, "together they are the same"
    assert found.objects["lower"].max == pytest.approx(4) and len(found.objects["lower"].surface_to_reference)
    assert [o["name"] for o in found.report["objects"]] == ["lower", "upper"]
    boxed = mesamis.compare(tmp_path / "a.3mf", tmp_path / "a.3mf", box=(-9, -9, -1, 9, 9, 3.5))
    assert list(boxed.objects) == ["lower"]


def test_compare_says_what_it_measures_together(tmp_path):
    write_cubes(tmp_path / "a.vtp")
    write_cubes(tmp_path / "b.vtp", names=("lower", "top"))
    write_cubes(tmp_path / "c.vtp", names=("one", "two"))
    one = mesamis.Surface(*two_cubes()["lower"])
    with pytest.warns(mesamis.MesamisWarning, match="a.vtp: 2 objects, measured together as one surface"):
        assert not mesamis.compare(tmp_path / "a.vtp", one).objects
    with pytest.warns(mesamis.MesamisWarning, match="c.vtp: 2 objects, measured together as one surface"):
        assert not mesamis.compare(tmp_path / "a.vtp", tmp_path / "c.vtp").objects
    with pytest.warns(mesamis.MesamisWarning, match='b.vtp: objects that no name pairs.*: "top"'):
        assert list(mesamis.compare(tmp_path / "a.vtp", tmp_path / "b.vtp").objects) == ["lower"]


def test_compare_knows_frames(tmp_path):
    lps = mesamis.phantom_surface("femur", size=(16, 16, 24), spacing=3)
    ras = mesamis.Surface(lps.points * [-1, -1, 1], lps.triangles, "ras")
    with pytest.warns(mesamis.MesamisWarning):
        assert mesamis.compare(lps, ras).max < 1e-9
    with pytest.raises(mesamis.InputError):
        mesamis.compare(lps, mesamis.Surface(ras.points, ras.triangles, None))
    shifted = mesamis.Surface(lps.points + [0.25, 0, 0], lps.triangles)
    assert mesamis.compare(lps, shifted).max == pytest.approx(0.25, rel=0.2)


def test_unknown_frames_are_refused(tmp_path):
    s = mesamis.phantom_surface("sphere", size=(12, 12, 12))
    upper = mesamis.Surface(s.points, s.triangles, "RAS")
    mesh = mesamis.box_mesh((0, 0, 0), (1, 1, 1), 2)
    mesh.frame = "RAS"
    for call in (lambda: mesamis.compare(s, upper), lambda: mesamis.compare(upper, s),
                 lambda: mesamis.decimate(upper, tolerance=1), lambda: upper.save(tmp_path / "a.ply"),
                 lambda: mesamis.write_surface(tmp_path / "a.ply", s, frame="RAS"),
                 lambda: mesh.save(tmp_path / "a.vtu"), lambda: mesamis.remesh(mesh, np.ones(27))):
        with pytest.raises(mesamis.InputError, match="frame: expected 'lps' or 'ras', found 'RAS'"):
            call()
    assert not list(tmp_path.iterdir())


def test_wrong_types_are_named():
    s = mesamis.phantom_surface("sphere", size=(12, 12, 12))
    with pytest.raises(mesamis.InputError, match="triangles: expected a whole number, found float"):
        mesamis.decimate(s, triangles=10.5)
    with pytest.raises(mesamis.InputError, match="noise: expected a number, found str"):
        mesamis.phantom("sphere", size=12, noise="much")


def test_surfaces_come_back_from_files(tmp_path):
    s = mesamis.phantom_surface("sphere", size=(12, 12, 12))
    height = s.points[:, 2]
    for name in ("a.ply", "a.vtp", "a.obj"):
        for frame in ("lps", "ras", None):
            mesamis.Surface(s.points, s.triangles, frame).save(
                tmp_path / name, arrays=None if name == "a.obj" else {"height": height})
            back = mesamis.read_surface(tmp_path / name)
            assert back.frame == frame
            assert np.allclose(back.points, s.points, rtol=0, atol=1e-12)
            assert np.array_equal(back.triangles, s.triangles)
    with pytest.raises(mesamis.InputError, match="none.stl"):
        mesamis.read_surface(tmp_path / "none.stl")


def test_meshes_come_back_from_files(tmp_path):
    mesh = mesamis.box_mesh((0, 0, 0), (1, 2, 3), 2)
    mesh.point_arrays = {"z": mesh.nodes[:, 2], "place": mesh.nodes}
    mesh.cell_arrays = {"volume": mesh.volumes}
    mesh.save(tmp_path / "m.vtu")
    back = mesamis.read_mesh(tmp_path / "m.vtu")
    assert np.array_equal(back.nodes, mesh.nodes) and np.array_equal(back.tets, mesh.tets)
    assert np.array_equal(back.point_arrays["place"], mesh.nodes)
    assert np.array_equal(back.cell_arrays["volume"], mesh.volumes)
    mesh.save(tmp_path / "m.mesh")
    assert np.array_equal(mesamis.read_mesh(tmp_path / "m.mesh").nodes, mesh.nodes)
    with pytest.raises(mesamis.InputError, match="expected .vtu or .mesh"):
        mesh.save(tmp_path / "m.stl")
    with pytest.raises(mesamis.InputError, match="expected indices of 27 nodes"):
        mesamis.write_mesh(tmp_path / "n.vtu", (mesh.nodes, mesh.tets + 20))


def test_meshes_in_ras_state_it(ball, tmp_path):
    """Nodes, vectors and tensors are written as they are, with the frame that they are in."""
    meshio = pytest.importorskip("meshio")
    with pytest.warns(mesamis.MesamisWarning):
        ras = mesamis.segment(ball, frame="ras", max_tets=3000, adaptations=1)
    arrays = {"place": ras.nodes, "stress": np.tile(np.arange(6.0), (len(ras.nodes), 1)), "u": ras.u}
    mesamis.write_mesh(tmp_path / "r.vtu", ras, point_arrays=arrays)
    there = meshio.read(tmp_path / "r.vtu")
    assert bytes(np.asarray(there.field_data["SPACE"], dtype=np.uint8)) == b"RAS"
    assert np.array_equal(there.points, ras.nodes)
    for name, values in arrays.items():
        assert np.array_equal(there.point_data[name], values)
    lps = ras.nodes * [-1, -1, 1]
    assert np.array_equal(mesamis.read_mesh(tmp_path / "r.vtu").nodes, lps)
    mesamis.write_mesh(tmp_path / "again.vtu", there)
    assert np.array_equal(mesamis.read_mesh(tmp_path / "again.vtu").nodes, lps)
    coarse = mesamis.remesh(ras, 0.5 * ras.metric, max_tets=2000)
    coarse.save(tmp_path / "c.vtu")
    assert coarse.frame == "ras"
    assert np.array_equal(mesamis.read_mesh(tmp_path / "c.vtu").nodes, coarse.nodes * [-1, -1, 1])


def test_volumes_come_back_from_files(ball, tmp_path):
    mesamis.write_volume(tmp_path / "v.nrrd", ball, gzip=True)
    back = mesamis.read_volume(tmp_path / "v.nrrd")
    assert np.array_equal(back.array, ball.array) and np.array_equal(back.affine, ball.affine)


def test_phantoms_are_listed_and_refused():
    assert set(mesamis.phantoms()) >= {"sphere", "femur", "hemipelvis"}
    with pytest.raises(mesamis.InputError):
        mesamis.phantom("unicorn")
    with pytest.raises(mesamis.InputError):
        mesamis.phantom("sphere", size=2)


def test_label_takes_a_result_of_several_objects(tmp_path):
    labels = np.zeros((20, 20, 20), np.uint8)
    labels[4:10, 4:16, 4:16], labels[10:16, 4:16, 4:16] = 1, 2
    found = mesamis.segment(labels=labels, spacing=(1, 1, 1))
    scan = mesamis.phantom("sphere", size=(20, 20, 20))
    rows = mesamis.label(found, scan, tmp_path / "mask.nii.gz")
    assert [row[:2] for row in rows] == [(1, "label 1"), (2, "label 2")]
    with pytest.raises(mesamis.InputError, match="expected a dict of names and surfaces"):
        mesamis.label(found["label 1"], scan, tmp_path / "mask.nii.gz")


def test_a_body_with_materials(result):
    body = mesamis.make_body(result, element_size=3, quadratic=True, sets=["TOP=top:z,2mm"],
                             material="keyak-1994", calibration="0,0.001")
    assert body.elements.shape[1] == 10 and body.elements.max() < len(body.nodes)
    assert len(body.material) == len(body.part) == len(body.elements)
    assert body.materials[0][1] > 0 and len(body.sets["TOP"]) > 3
    pair = mesamis.make_body(result, element_size=3, material="keyak-1994", calibration=(0, 0.001))
    assert pair.materials == mesamis.make_body(result, element_size=3, material="keyak-1994",
                                               calibration="0,0.001").materials
    with pytest.raises(mesamis.InputError, match="calibration"):
        mesamis.make_body(result, material="keyak-1994")
    with pytest.raises(mesamis.InputError, match="what segment"):
        mesamis.make_body(3)


def test_the_sets_of_a_body_are_in_the_frame_of_its_result(ball):
    for frame, sign in [("lps", 1), ("ras", -1)]:
        result = mesamis.segment(ball, frame=frame, preview=True)
        middle = result.points.mean(axis=0)
        low, high = [-99, -99, -99], [99, 99, 99]
        low[0] = middle[0] + 2
        text = ",".join(map(str, [*low, *high]))
        body = mesamis.make_body(result, element_size=4, sets=["SIDE=top:x,2mm", f"BOX=box:{text}"])
        for name in ("SIDE", "BOX"):
            x = body.nodes[body.sets[name]][:, 0]
            assert len(x) and (x > middle[0]).all(), (frame, name, sign)


def test_what_a_body_misses_is_a_warning(ball):
    result = mesamis.segment(ball, preview=True)
    with pytest.warns(mesamis.MesamisWarning, match="set 'HOLE' has no face") as caught:
        body = mesamis.make_body(result, element_size=4, sets=["HOLE=inner"])
    assert caught[0].filename == __file__
    assert any("HOLE" in line for line in body.warnings)


@pytest.mark.parametrize(
    "arguments, message",
    [
        ({"element_size": 0}, "element_size: expected a number above 0, found 0"),
        ({"element_size": float("inf")}, "element size: expected a finite number"),
        ({"element_size": "3"}, "element_size: expected a number, found str"),
        ({"element_size": 2, "least_size": 3}, "least size: expected at most"),
        ({"tolerance": 0}, "tolerance: expected a finite number above 0"),
        ({"tolerance": float("inf")}, "tolerance: expected a finite number above 0"),
        ({"gradation": 0.01}, "gradation: expected 0.05 to 5, found 0.01"),
        ({"wall_elements": 11}, "wall elements: expected 0 to 10, found 11"),
        ({"wall_elements": 1.5}, "wall_elements: expected a whole number, found float"),
        ({"sets": "A=top:z,1"}, "sets: expected a list of texts, found str"),
        ({"sets": ["A=left:z,1"]}, "set: expected NAME="),
        ({"sets": ["A=top:z,1", "a=top:z,2"]}, "set: expected names that differ"),
        ({"sets": ["A=between:1,2"]}, "set A: expected two of the objects 1 'object', found 2"),
        ({"ash": "equal"}, "ash: expected material beside it"),
        ({"material": "keyak-1994", "calibration": "0,0.001", "ash": "none"}, "ash"),
        ({"material": "keyak-1994", "calibration": "0,0.001", "poisson": 0.5}, "poisson: expected -0.99 to 0.499"),
        ({"material": "keyak-1994", "calibration": "0,0.001", "material_rim": -1}, "material rim: expected"),
        ({"material": "keyak-1994", "calibration": "0,0.001", "material_gap": -1}, "material gap: expected"),
        ({"element_size": 0.5, "memory": 1e-5}, "elements"),
    ],
)
def test_bad_arguments_of_bodies(result, arguments, message):
    with pytest.raises(mesamis.InputError, match=message) as caught:
        mesamis.make_body(result, **arguments)
    assert "\n" not in str(caught.value)


def test_a_body_needs_a_solid_and_a_tolerance(ball):
    preview = mesamis.segment(ball, preview=True)  # whose tolerance of 0 nobody chose
    assert len(mesamis.make_body(preview, element_size=4).nodes)
    raw = mesamis.segment(ball, max_tets=20_000, tolerance=0)
    with pytest.raises(mesamis.InputError, match="tolerance: expected one above 0 for the skin"):
        mesamis.make_body(raw, element_size=4)
    assert len(mesamis.make_body(raw, element_size=4, tolerance=0.3).nodes)


def write_dicom_scan(folder, scan):
    """A scan as DICOM slices of a patient."""
    pydicom = pytest.importorskip("pydicom")
    from pydicom.uid import ExplicitVRLittleEndian

    folder.mkdir()
    for k in range(scan.array.shape[2]):
        slice_ = pydicom.Dataset()
        slice_.SOPClassUID, slice_.SOPInstanceUID = "1.2.840.10008.5.1.4.1.1.2", f"1.2.3.{k + 1}"
        slice_.StudyInstanceUID, slice_.SeriesInstanceUID = "1.2.4", "1.2.5"
        slice_.FrameOfReferenceUID, slice_.Modality = "1.2.6", "CT"
        slice_.PatientName, slice_.PatientID = "Doe^Jane", "77"
        slice_.Rows, slice_.Columns = scan.array.shape[1], scan.array.shape[0]
        slice_.SamplesPerPixel, slice_.PhotometricInterpretation = 1, "MONOCHROME2"
        slice_.BitsAllocated = slice_.BitsStored = 16
        slice_.HighBit, slice_.PixelRepresentation = 15, 1
        slice_.PixelSpacing, slice_.ImageOrientationPatient = [1, 1], [1, 0, 0, 0, 1, 0]
        slice_.ImagePositionPatient = [0, 0, k]
        slice_.PixelData = scan.array[:, :, k].T.astype("<i2").tobytes()
        slice_.file_meta = pydicom.dataset.FileMetaDataset()
        slice_.file_meta.TransferSyntaxUID = ExplicitVRLittleEndian
        slice_.file_meta.MediaStorageSOPClassUID = slice_.SOPClassUID
        slice_.file_meta.MediaStorageSOPInstanceUID = slice_.SOPInstanceUID
        slice_.preamble = bytes(128)
        pydicom.dcmwrite(folder / f"{k}.dcm", slice_)


def test_surfaces_in_dicom_belong_to_the_patient_that_is_asked_for(tmp_path):
    pydicom = pytest.importorskip("pydicom")
    phantom = mesamis.phantom("sphere", size=(16, 16, 16))
    write_dicom_scan(tmp_path / "scan", phantom)
    scan = mesamis.read_volume(tmp_path / "scan")
    found = mesamis.segment(scan, preview=True)
    found.save(tmp_path / "with.dcm", patient=True)
    found.save(tmp_path / "without.dcm")
    mesamis.write_surface(tmp_path / "written.dcm", found, patient=scan)
    for name in ("with.dcm", "written.dcm"):
        file = pydicom.dcmread(tmp_path / name)
        assert (file.PatientName, file.PatientID, file.StudyInstanceUID) == ("Doe^Jane", "77", "1.2.4")
        assert file.FrameOfReferenceUID == "1.2.6"
    assert not pydicom.dcmread(tmp_path / "without.dcm").PatientName
    with pytest.raises(mesamis.InputError, match="patient: expected a .dcm, found .*a.stl"):
        found.save(tmp_path / "a.stl", patient=True)
    with pytest.raises(mesamis.InputError, match="patient: expected a scan read from DICOM"):
        mesamis.write_surface(tmp_path / "a.dcm", found, patient=phantom)
    assert not list(tmp_path.glob("a.*"))
