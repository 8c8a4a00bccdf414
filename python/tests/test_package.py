# SPDX-License-Identifier: Apache-2.0
"""The package itself: settings, stubs, documentation, examples."""

import doctest
import importlib
import inspect
import os
import pkgutil
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

import mesamis

PYTHON = Path(__file__).parents[1]
MODULES = [m.name for m in pkgutil.iter_modules(mesamis.__path__) if m.name != "_core"]


def test_settings_are_the_table_of_the_program(program):
    page = program("settings", "--markdown").stdout
    rows = [line for line in page.splitlines() if line.startswith("| `--")]
    assert {"--" + s.name.replace("_", "-") for s in mesamis.settings()} == {
        re.match(r"\| `(--[a-z-]+)", row).group(1) for row in rows}


def test_help_lists_every_setting():
    text = inspect.getdoc(mesamis.segment)
    for s in mesamis.settings():
        assert f"{s.name} : {s.form}" in text and s.help in text


def test_no_setting_is_hidden_by_another_keyword():
    others = set(inspect.signature(mesamis.segment).parameters) - {"settings"}
    assert not others & {s.name for s in mesamis.settings()}


def test_presets():
    assert mesamis.presets() == ["default", "paper"]


@pytest.mark.parametrize("name", ["__init__", *MODULES])
def test_documentation_is_right(name):
    module = mesamis if name == "__init__" else importlib.import_module(f"mesamis.{name}")
    assert doctest.testmod(module).failed == 0


def test_page_is_right(tmp_path, monkeypatch):
    """The examples of docs/python.md run, one after another, in a folder with the files they name."""
    page = PYTHON.parent / "docs" / "python.md"
    blocks = re.findall(r"```python\n(.*?)```", page.read_text(encoding="utf-8"), re.S)
    assert len(blocks) > 3
    monkeypatch.chdir(tmp_path)
    nibabel = pytest.importorskip("nibabel")
    pytest.importorskip("meshio")
    scan = mesamis.phantom("sphere", size=(24, 24, 24), noise=5)
    mesamis.write_volume("scan.nrrd", scan)
    nibabel.save(nibabel.Nifti1Image(scan.array, scan.affine), "scan.nii.gz")
    names = {}
    for block in blocks:
        exec(compile(block, str(page), "exec"), names)  # noqa: S102


def test_stubs_are_up_to_date():
    run([PYTHON / "write_stubs.py", "--check"])


def test_wheel_is_whole_and_the_same_every_time(tmp_path):
    """pip's back end, with the library that is built already; the wheel is then used by itself."""
    build = Path(os.environ.get("MESAMIS_PROGRAM", "none/none")).parent
    if not (build / "CMakeCache.txt").exists():
        pytest.skip("MESAMIS_PROGRAM lies in no build folder")
    code = "import build_backend, sys; print(build_backend.build_wheel(sys.argv[1]))"
    wheels = []
    for n in "12":
        (tmp_path / n).mkdir()
        done = subprocess.run([sys.executable, "-c", code, tmp_path / n], check=True, capture_output=True, text=True,
                              env={**os.environ, "PYTHONPATH": str(PYTHON), "MESAMIS_BUILD_FOLDER": str(build)})
        wheels.append(tmp_path / n / done.stdout.strip())
    assert wheels[0].read_bytes() == wheels[1].read_bytes()
    with zipfile.ZipFile(wheels[0]) as wheel:
        names = wheel.namelist()
        metadata = wheel.read(next(n for n in names if n.endswith("/METADATA"))).decode()
        assert ("Requires-Dist: numpy>=1.20,<2\n" in metadata) is not mesamis._core.knows_numpy_2
        wheel.extractall(tmp_path / "installed")
    assert {"mesamis/__init__.py", "mesamis/__init__.pyi", "mesamis/py.typed"} <= set(names)
    text = "import mesamis; print(mesamis.__file__, mesamis.phantom('sphere', size=(8, 8, 8)))"
    done = subprocess.run([sys.executable, "-c", text], check=True, capture_output=True, text=True, cwd=tmp_path,
                          env={**os.environ, "PYTHONPATH": str(tmp_path / "installed")})
    assert str(tmp_path / "installed") in done.stdout and "8 x 8 x 8" in done.stdout


def test_numpy_that_the_module_would_misread_is_refused():
    code = "import numpy; numpy.__version__ = '{}'; import mesamis; print('imported')"
    environment = {**os.environ, "PYTHONPATH": str(Path(mesamis.__path__[0]).parent)}
    for version, known in [("1.26.4", True), ("2.1.0", mesamis._core.knows_numpy_2)]:
        done = subprocess.run([sys.executable, "-c", code.format(version)], capture_output=True, text=True, check=False,
                              env=environment)
        if known:
            assert done.stdout == "imported\n", done.stderr
        else:
            assert done.stdout == "" and "ImportError: mesamis: expected NumPy 1" in done.stderr.splitlines()[-1]
            assert "found NumPy 2.1.0" in done.stderr.splitlines()[-1]


def run(command, **more):
    environment = {**os.environ, "PYTHONPATH": str(Path(mesamis.__path__[0]).parent)}
    done = subprocess.run([sys.executable, *map(str, command)], capture_output=True, text=True, check=False,
                          env=environment, **more)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


def test_stubs_fit_the_package(tmp_path):
    pytest.importorskip("mypy")
    # Values that functions return are not made by users; modules with an underscore are no door.
    (tmp_path / "allowed").write_text("mesamis\\.(Body|Comparison|Object|Volume)\\.__init__\nmesamis\\._.*\n")
    optional = "tqdm", "pyvista", "trimesh", "meshio", "nibabel", "SimpleITK", "IPython"
    sections = [f"[mypy-{name}.*]\nignore_missing_imports = True\n" for name in optional]
    (tmp_path / "mypy.ini").write_text("[mypy]\n" + "".join(sections), encoding="utf-8")
    run(["-m", "mypy.stubtest", "mesamis", "--ignore-missing-stub", "--concise", "--mypy-config-file", "mypy.ini",
         "--allowlist", "allowed", "--ignore-unused-allowlist"], cwd=tmp_path)


def test_examples_fit_the_stubs(tmp_path):
    pytest.importorskip("mypy")
    run(["-m", "mypy", "--strict", "--cache-dir", tmp_path / "cache", *sorted((PYTHON / "examples").glob("*.py"))],
        cwd=tmp_path)


@pytest.mark.parametrize("example", sorted(p.stem for p in (PYTHON / "examples").glob("*.py")))
def test_examples_run(example, tmp_path):
    run([PYTHON / "examples" / f"{example}.py", tmp_path])
    assert any(tmp_path.iterdir())
