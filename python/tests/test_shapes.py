# SPDX-License-Identifier: Apache-2.0
"""Results for people and for other packages: notebooks, pickles, pages, PyVista, trimesh, meshio, SimpleITK."""

import io
import pickle
import re
import sys
import types

import numpy as np
import pytest

import mesamis

from conftest import FakeSitkImage


@pytest.fixture(scope="module")
def scan():
    return mesamis.phantom("sphere", size=(24, 24, 24), noise=5)


@pytest.fixture(scope="module")
def result(scan):
    return mesamis.segment(scan, max_tets=4000, adaptations=2)


@pytest.fixture(scope="module")
def objects(scan):
    i, j, k = np.mgrid[:24, :24, :24]
    ball = np.hypot(np.hypot(i - 11.5, j - 11.5), k - 11.5) < 8
    labels = np.where(ball, np.where(i < 12, 1, 2), 0)
    return mesamis.segment(scan, labels=labels, label_names={1: "left <b>", 2: "right"})


def test_tables_show_what_people_ask_for(scan, result, objects):
    text = result._repr_html_()
    for words in ("size", " mm", "volume", "cm³", "expected error, mean", "closed", "yes"):
        assert words in text
    assert "left &lt;b&gt;" in objects._repr_html_() and "<b>right" not in objects._repr_html_()
    assert "24 x 24 x 24" in scan._repr_html_()
    for one in (objects["right"], mesamis.Surface([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]),
                mesamis.box_mesh((0, 0, 0), (1, 1, 1), 2)):
        assert one._repr_html_().startswith("<table>")


@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
def test_a_pickle_keeps_arrays_and_report(result, protocol, tmp_path):
    again = pickle.loads(pickle.dumps(result, protocol))
    for name in ("points", "triangles", "expected_error", "nodes", "tets", "u", "v", "f", "metric"):
        assert np.array_equal(getattr(again, name), getattr(result, name)), name
    assert again.report == result.report and again.warnings == result.warnings
    assert (again.level, again.closed, again.converged) == (result.level, result.closed, result.converged)
    assert again._repr_html_() == result._repr_html_()
    again.save(tmp_path / "a.stl")
    result.save(tmp_path / "b.stl")
    assert (tmp_path / "a.stl").read_bytes() == (tmp_path / "b.stl").read_bytes()
    with pytest.raises(mesamis.InputError, match="found one that was pickled"):
        again.save(tmp_path / "a.vtu")


def test_pickles_of_the_others(scan, objects):
    again = pickle.loads(pickle.dumps(objects))
    assert [o.name for o in again] == [o.name for o in objects]
    assert np.array_equal(again["right"].points, objects["right"].points)
    volume = pickle.loads(pickle.dumps(scan))
    assert np.array_equal(volume.array, scan.array)
    assert np.array_equal(volume.affine, scan.affine) and volume.modality == scan.modality
    assert pickle.loads(pickle.dumps(objects["right"])).name == "right"


def test_a_page_is_one_file(result, objects, tmp_path):
    for shape in (result, objects):
        shape.save(tmp_path / "page.html")
        page = (tmp_path / "page.html").read_text(encoding="utf-8")
        assert page.startswith("<!DOCTYPE html>") and 'id="axial"' in page and 'id="scan-copy"' in page
    with pytest.raises(mesamis.InputError):
        result.save(tmp_path / "none" / "page.html")


def test_one_object_has_a_file_of_its_own(objects, tmp_path):
    objects["right"].save(tmp_path / "one.ply", error=True)
    objects.save(tmp_path / "all_{label}.ply")
    read = mesamis.read_surface(tmp_path / "one.ply")
    assert np.allclose(read.points, objects["right"].points)
    assert b"expected_error" in (tmp_path / "one.ply").read_bytes()


def bar_of(monkeypatch, with_tqdm):
    """What progress=True shows."""
    shown = []

    class Bar:
        def __init__(self, total, bar_format):
            self.n = 0

        def set_description_str(self, text, refresh):
            shown.append([text, 0])

        def refresh(self):
            shown[-1][1] = self.n

        def close(self):
            shown.append("closed")

    module = types.ModuleType("tqdm.auto")
    module.tqdm = Bar
    monkeypatch.setitem(sys.modules, "tqdm", types.ModuleType("tqdm") if with_tqdm else None)
    monkeypatch.setitem(sys.modules, "tqdm.auto", module if with_tqdm else None)
    return shown


def test_progress_is_one_bar_of_the_whole(scan, monkeypatch):
    shown = bar_of(monkeypatch, True)
    mesamis.segment(scan, max_tets=4000, adaptations=2, progress=True)
    assert shown[-1] == "closed" and shown[-2] == ["done", 100]
    shares = [share for _, share in shown[:-1]]
    assert shares == sorted(shares) and len(set(shares)) > 3
    assert {"preparation", "final minimisation"} <= {stage for stage, _ in shown[:-1]}


def test_progress_is_lines_without_tqdm(scan, monkeypatch, capsys):
    bar_of(monkeypatch, False)
    mesamis.segment(scan, preview=True, progress=True)
    assert re.search(r"^mesamis: preparation \( *\d+ %\)$", capsys.readouterr().err, re.M)


def test_a_failure_closes_the_bar(monkeypatch):
    shown = bar_of(monkeypatch, True)
    with pytest.raises(mesamis.InputError):
        mesamis.segment(np.zeros((8, 8, 8)), spacing=1.0, progress=True)
    assert shown == ["closed"]


def test_plot_is_the_page_without_pyvista(result, monkeypatch):
    opened = []
    monkeypatch.setitem(sys.modules, "pyvista", None)
    monkeypatch.setattr("webbrowser.open", opened.append)
    path = result.plot()
    assert opened == ["file://" + path]
    with open(path, encoding="utf-8") as file:
        assert file.read(15) == "<!DOCTYPE html>"


def test_pyvista(result, objects):
    pytest.importorskip("pyvista")
    data = result.to_pyvista()
    assert data.n_points == len(result.points) and data.n_cells == len(result.triangles)
    assert np.array_equal(data.point_data["expected_error"], result.expected_error)
    assert set(objects.to_pyvista().keys()) == {"left <b>", "right"}
    mesh = mesamis.Mesh(result.nodes, result.tets, {"u": result.u}).to_pyvista()
    assert mesh.n_cells == len(result.tets)


def test_trimesh(result, objects):
    pytest.importorskip("trimesh")
    assert result.to_trimesh().is_watertight
    assert result.to_trimesh().volume == pytest.approx(result.report["surface"]["volume_mm3"])
    assert len(objects.to_trimesh().geometry) == 2


def test_meshio(result, objects):
    pytest.importorskip("meshio")
    mesh = result.to_meshio()
    assert np.array_equal(mesh.cells_dict["triangle"], result.triangles)
    both = objects.to_meshio()
    assert set(both.cell_data["label"][0]) == {1, 2}
    assert both.cells_dict["triangle"].max() < len(both.points)
    assert mesamis.box_mesh((0, 0, 0), (1, 1, 1), 2).to_meshio().cells_dict["tetra"].shape[1] == 4


def test_a_missing_package_is_named(result, monkeypatch):
    monkeypatch.setitem(sys.modules, "trimesh", None)
    with pytest.raises(ImportError, match="pip install trimesh"):
        result.to_trimesh()


def test_from_sitk():
    image = FakeSitkImage(np.arange(24, dtype=np.float32).reshape(2, 3, 4), (1, 2, 3), (4, 5, 6), np.eye(3))
    scan = mesamis.from_sitk(image, modality="MR")
    assert scan.array.shape == (4, 3, 2) and scan.spacing == (1, 2, 3) and scan.origin == (4, 5, 6)
    assert scan.modality == "MR"
    with pytest.raises(mesamis.InputError, match="expected one of SimpleITK"):
        mesamis.from_sitk(io.BytesIO())
