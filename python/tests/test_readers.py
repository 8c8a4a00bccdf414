# SPDX-License-Identifier: Apache-2.0
"""Other libraries read the meshes."""

import numpy as np
import pytest

import mesamis

# Runs are kept short: that they have not converged is no matter here.
pytestmark = pytest.mark.filterwarnings("ignore:not converged")


@pytest.fixture(scope="module")
def files(result, tmp_path_factory):
    """Every kind of .vtu: the box, the object, the band, bodies with and without materials."""
    tmp_path = tmp_path_factory.mktemp("meshes")
    result.save(tmp_path / "box.vtu")
    result.save(tmp_path / "object.vtu", region="object")
    result.save(tmp_path / "band.vtu", band=True)
    mesamis.make_body(result, element_size=4).save(tmp_path / "tet4.vtu")
    mesamis.make_body(result, element_size=4, quadratic=True, material="keyak-1994",
                      calibration="0,0.001").save(tmp_path / "tet10.vtu")
    return {p.stem: p for p in tmp_path.glob("*.vtu")}


def text(array):
    return bytes(np.asarray(array, dtype=np.uint8)).decode()


def test_meshio_reads_every_mesh(files, result):
    meshio = pytest.importorskip("meshio")
    meshes = {name: meshio.read(path) for name, path in files.items()}
    assert set(meshes) == {"box", "object", "band", "tet4", "tet10"}
    for name, mesh in meshes.items():
        kind = "tetra10" if name == "tet10" else "tetra"
        assert list(mesh.cells_dict) == [kind] and len(mesh.cells_dict[kind])
        assert text(mesh.field_data["SPACE"]) == "LPS"
        assert text(mesh.field_data["LengthUnit"]) == "mm"
    box = meshes["box"]
    assert np.array_equal(box.points, result.nodes)
    assert np.array_equal(box.cells_dict["tetra"], result.tets)
    assert np.array_equal(box.point_data["u"], result.u)
    assert text(meshes["tet10"].field_data["PartNames"]).split("\0") == ["PART_1_object"]
    materials = text(meshes["tet10"].field_data["MaterialNames"]).split("\0")
    assert len(materials) == int(meshes["tet10"].cell_data["material"][0].max())


def test_vtk_reads_every_mesh(files, result):
    pytest.importorskip("vtkmodules")
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

    for name, path in files.items():
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(str(path))
        reader.Update()
        grid = reader.GetOutput()
        assert reader.GetErrorCode() == 0 and grid.GetNumberOfCells() > 0, name
        assert grid.GetCellType(0) == (24 if name == "tet10" else 10)
        assert text(vtk_to_numpy(grid.GetFieldData().GetArray("SPACE"))) == "LPS"
        if name == "box":
            assert np.array_equal(vtk_to_numpy(grid.GetPoints().GetData()), result.nodes)
            assert np.array_equal(vtk_to_numpy(grid.GetPointData().GetArray("v")), result.v)


def test_the_frame_is_read_back(ball, tmp_path):
    """A file in RAS states it, and our reader turns it to LPS."""
    meshio = pytest.importorskip("meshio")
    settings = {"max_tets": 3000, "adaptations": 1, "tol_mesh": 1, "tol_energy": 1, "until": "either"}
    ras = mesamis.segment(ball, frame="ras", **settings)
    ras.save(tmp_path / "ras.vtu")
    there = meshio.read(tmp_path / "ras.vtu")
    assert text(there.field_data["SPACE"]) == "RAS"
    assert np.array_equal(there.points, ras.nodes)
    back = mesamis.read_mesh(tmp_path / "ras.vtu")
    assert np.array_equal(back.nodes, ras.nodes * [-1, -1, 1])
    assert back.nodes.min() > -1, "LPS again"


def test_meshes_of_meshio_can_be_remeshed(result, tmp_path):
    meshio = pytest.importorskip("meshio")
    result.save(tmp_path / "box.vtu")
    mesh = meshio.read(tmp_path / "box.vtu")
    coarse = mesamis.remesh(mesh, np.full(len(mesh.points), 6.0))
    assert 0 < len(coarse.tets) < len(result.tets)
