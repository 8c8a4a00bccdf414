# SPDX-License-Identifier: Apache-2.0
"""Uses the installed wheel as others do: images of nibabel and SimpleITK in, meshes of PyVista,
trimesh and meshio out. Each of the five is the real one, from PyPI."""

import subprocess
import sys
import tempfile
from pathlib import Path

import meshio
import nibabel
import numpy as np
import pyvista
import SimpleITK
import trimesh

import mesamis

GRID = {"size": (28, 28, 28), "spacing": (2.0, 2.0, 2.0)}


def same(a, b):
    assert np.array_equal(a.points, b.points) and np.array_equal(a.triangles, b.triangles)


def main():
    scan = mesamis.phantom("sphere", **GRID)
    found = mesamis.segment(scan, preview=True)
    assert found.closed
    truth = mesamis.phantom_surface("sphere", **GRID)
    volume = trimesh.Trimesh(truth.points, truth.triangles).volume

    # In: the same scan as an image of nibabel and of SimpleITK gives the same surface.
    nifti = nibabel.Nifti1Image(scan.array, scan.affine)
    same(found, mesamis.segment(nifti, preview=True))
    image = SimpleITK.GetImageFromArray(np.ascontiguousarray(scan.array.T))
    image.SetSpacing(tuple(scan.spacing))
    image.SetOrigin(tuple(scan.origin))
    same(found, mesamis.segment(image, preview=True))

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder)
        # Files of theirs.
        nibabel.save(nifti, path / "scan.nii.gz")
        SimpleITK.WriteImage(image, str(path / "scan.mha"))
        same(found, mesamis.segment(path / "scan.nii.gz", preview=True))
        same(found, mesamis.segment(path / "scan.mha", preview=True))

        # Out: what they read of ours is closed and as large as the ball.
        found.save(path / "ball.stl")
        found.save(path / "ball.ply")
        solid = trimesh.load(path / "ball.stl")
        assert solid.is_watertight and abs(solid.volume / volume - 1) < 0.05, solid.volume
        read = pyvista.read(path / "ball.ply")
        assert read.is_manifold and abs(read.volume / volume - 1) < 0.05, read.volume
        made = pyvista.PolyData.from_regular_faces(found.points, found.triangles)
        assert made.n_open_edges == 0
        whole = mesamis.segment(scan, max_tets=20_000)
        whole.save(path / "ball.vtu")
        mesh = meshio.read(path / "ball.vtu")
        assert len(mesh.cells_dict["tetra"]) == len(whole.tets) and "u" in mesh.point_data
        assert pyvista.read(path / "ball.vtu").n_cells == len(whole.tets)

        # Back: their surfaces are ours.
        assert mesamis.compare(found, (solid.vertices, solid.faces)).max < 1e-4
        assert mesamis.compare(found, meshio.read(path / "ball.ply")).max < 1e-4

        # The command gives the bytes of the module.
        command = Path(sys.executable).with_name("mesamis")
        subprocess.run([command, "--quiet", "segment", path / "scan.nii.gz", "--preview", "-o", path / "same.stl"],
                       check=True)
        assert (path / "same.stl").read_bytes() == (path / "ball.stl").read_bytes()
        subprocess.run([command, "picture", path / "ball.stl", "-o", path / "ball.png"], check=True, env={})
        assert (path / "ball.png").read_bytes()[:4] == b"\x89PNG"
    print("numpy", np.__version__, "nibabel", nibabel.__version__, "SimpleITK", SimpleITK.__version__,
          "pyvista", pyvista.__version__, "trimesh", trimesh.__version__, "meshio", meshio.__version__)


if __name__ == "__main__":
    main()
