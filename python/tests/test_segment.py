# SPDX-License-Identifier: Apache-2.0
"""How segment() behaves as a function of Python."""

import gc
import os
import signal
import threading
import time
import tracemalloc
import warnings

import numpy as np
import pytest

import mesamis


def test_what_a_result_holds(result):
    n, m = len(result.nodes), len(result.tets)
    assert result.points.dtype == np.float64 and result.points.shape[1] == 3
    assert result.triangles.dtype == np.int32 and result.triangles.max() == len(result.points) - 1
    assert result.tets.shape == (m, 4) and result.tets.max() == n - 1
    assert result.u.shape == result.v.shape == result.f.shape == (n,)
    assert result.metric.shape == (n, 6)
    assert 0 <= result.v.min() and result.v.max() <= 1
    assert result.expected_error.shape == (len(result.points),)
    assert result.report["mesh"]["tets"] == m
    assert result.report["surface"]["triangles"] == len(result.triangles)
    assert result.report["settings"]["max_tets"] == 8000
    assert "Result" in repr(result)
    mesh = mesamis.Mesh(result.nodes, result.tets)
    assert (mesh.volumes > 0).all() and mesh.volumes.sum() == pytest.approx(23**3)


def test_the_surface_is_that_of_the_ball(result):
    truth = mesamis.phantom_surface("sphere", size=(24, 24, 24))
    c = mesamis.compare(truth, result)
    assert c.mean < 0.1
    assert result.report["quality"]["expected_error_mm"]["mean"] < 0.3


def test_input_in_place(ball):
    """A float32 array whose first index runs fastest is not copied, nor is one with z, y, x."""
    from mesamis._volume import scan_of

    fortran = np.asfortranarray(ball.array)
    assert np.shares_memory(scan_of(fortran, affine=np.eye(4))[0].samples, fortran)
    zyx = np.ascontiguousarray(ball.array.T)
    assert np.shares_memory(scan_of(zyx, spacing=(1, 1, 1))[0].samples, zyx)
    before = zyx.copy()
    mesamis.segment(zyx, spacing=1, preview=True)
    assert np.array_equal(zyx, before)


def test_output_shares_and_outlives(ball):
    """Arrays keep what they lie in alive; each access is the same memory, not to be written to."""
    result = mesamis.segment(ball, preview=True)
    points = result.points
    assert np.shares_memory(points, result.points)
    assert not points.flags.writeable and not points.flags.owndata
    copy = points.copy()
    del result
    gc.collect()
    junk = [np.full(len(copy) * 3, 7.0) for _ in range(50)]
    assert np.array_equal(points, copy) and len(junk) == 50
    with pytest.raises(ValueError):
        points[0, 0] = 1


def test_no_copy_of_the_scan_stays_in_python():
    radius = np.linalg.norm(np.indices((60, 60, 60)) - 29.5, axis=0)
    big = (100 / (1 + np.exp(2 * (radius - 8)))).astype(np.float32)
    tracemalloc.start()
    result = mesamis.segment(big, spacing=1, preview=True)
    points = result.points
    used = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert used < big.nbytes / 2 and len(points)


def test_threads_do_not_change_the_bytes(ball, tmp_path):
    surfaces = [mesamis.segment(ball, preview=True, threads=n).points for n in (1, 2)]
    assert np.array_equal(*surfaces)
    assert mesamis.segment(ball, preview=True, threads=1).report["output"]["threads"] == 1


@pytest.mark.filterwarnings("ignore:not converged")
def test_progress_is_told(ball):
    stages = []
    caller = threading.get_ident()

    def progress(stage, fraction):
        assert threading.get_ident() == caller and 0 <= fraction <= 1
        stages.append(stage)

    mesamis.segment(ball, max_tets=4000, adaptations=1, progress=progress, tol_mesh=1, tol_energy=1)
    assert "preparation" in stages and "surface" in stages
    assert any(s.startswith("adaptation 1 of") for s in stages)


def test_progress_can_stop(ball):
    with pytest.raises(mesamis.Cancelled):
        mesamis.segment(ball, progress=lambda stage, fraction: not stage.startswith("adaptation"))


def test_exceptions_of_progress_come_through(ball):
    def progress(stage, fraction):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        mesamis.segment(ball, progress=progress)


def test_other_threads_run_meanwhile():
    """The interpreter's lock is released: another thread counts while a run goes on."""
    counted = []
    done = threading.Event()

    def count():
        while not done.is_set():
            counted.append(time.monotonic())
            time.sleep(0.005)

    scan = mesamis.phantom("sphere", size=(40, 40, 40), noise=5)
    thread = threading.Thread(target=count)
    thread.start()
    begin = time.monotonic()
    mesamis.segment(scan, preview=True)
    end = time.monotonic()
    done.set()
    thread.join()
    during = [t for t in counted if begin < t < end]
    assert len(during) > (end - begin) / 0.1


@pytest.mark.parametrize("no", [False, np.False_, 0, ""])
def test_whatever_is_false_stops(ball, no):
    with pytest.raises(mesamis.Cancelled):
        mesamis.segment(ball, preview=True, progress=lambda stage, fraction: no)


@pytest.mark.parametrize("yes", [None, True, np.True_, 1])
def test_none_and_what_is_true_go_on(ball, yes):
    mesamis.segment(ball, preview=True, progress=lambda stage, fraction: yes)


def test_what_is_neither_true_nor_false_comes_through(ball):
    with pytest.raises(ValueError, match="ambiguous"):
        mesamis.segment(ball, preview=True, progress=lambda stage, fraction: np.array([1, 2]))


def test_control_c_stops(ball):
    """The signal comes in the middle of a run that would take long, and no function of Python is called
    meanwhile: the library's door looks after signals itself."""
    sent = []

    def interrupt():
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    scan = mesamis.phantom("sphere", size=(64, 64, 64), noise=20)
    # A shell without job control starts what runs in its background with SIGINT ignored.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    timer = threading.Timer(1, interrupt)
    timer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            mesamis.segment(scan, max_tets=2_000_000)
    finally:
        timer.cancel()
        signal.signal(signal.SIGINT, before)
    assert time.monotonic() - sent[0] < 20
    assert mesamis.segment(ball, preview=True).closed, "and the library works on"


def test_warnings_are_warnings_of_python(ball):
    with pytest.warns(mesamis.MesamisWarning, match="not converged") as caught:
        result = mesamis.segment(ball, max_tets=3000, adaptations=1)
    assert caught[0].filename == __file__
    assert any("not converged" in w for w in result.warnings) and not result.converged
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        mesamis.segment(ball, preview=True)


def test_time_limit(ball):
    with pytest.warns(mesamis.MesamisWarning):
        result = mesamis.segment(ball, time_limit=1e-6)
    assert result.stopped and len(result.triangles)


@pytest.mark.parametrize(
    "arguments, message",
    [
        ({"affine": np.eye(3)}, "affine: expected a matrix of 4 x 4"),
        ({"affine": np.diag([0, 0, 0, 1])}, "expected a positive voxel spacing"),
        ({"affine": np.array([[1, 0, 0, 5], [0, 1, 0, 6], [0, 0, 1, 7], [0, 0, 0, 1]]).T}, "as the last row, found"),
        ({"affine": np.array([[1, 1, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])}, "orthogonal"),
        ({"affine": np.eye(4), "spacing": 1}, "without spacing"),
        ({}, "expected affine or spacing beside an array"),
        ({"spacing": (1, 0, 1)}, "spacing"),
        ({"spacing": 1, "order": "xyz"}, "expected 'ijk' or 'zyx'"),
        ({"spacing": 1, "frame": "ijk"}, "frame: expected 'lps' or 'ras'"),
        ({"spacing": 1, "level": "high"}, "level: expected"),
        ({"spacing": 1, "level": float("nan")}, "settings"),
        ({"spacing": 1, "max_tets": 2.5}, "max-tets: expected a whole number"),
        ({"spacing": 1, "preset": "none"}, "none"),
        ({"spacing": 1, "seeds": [1, 2]}, "seeds: expected points of three numbers"),
        ({"spacing": 1, "seeds": [900, 2, 3]}, "the scan"),
        ({"spacing": 1, "label": 3}, "label: expected labels beside it"),
        ({"spacing": 1, "labels": np.zeros((2, 2, 2))}, "labels: expected the shape of the scan"),
        ({"spacing": 1, "labels": np.full((24, 24, 24), 0.5)}, "labels: expected whole numbers"),
        ({"spacing": 1, "labels": np.ones((24, 24, 24)), "tissue": "bone"}, "without tissue"),
        ({"spacing": 1, "threads": -1}, "threads: expected 0 or more"),
        ({"spacing": 1, "remove": "body"}, "expected a patient's body"),
        ({"spacing": 1, "memory": 1e-6}, "memory"),
        ({"spacing": 1, "frame": "RAS"}, "frame: expected 'lps' or 'ras', found 'RAS'"),
        ({"spacing": 1, "frame": 3}, "frame: expected a text, found int"),
        ({"spacing": 1, "tissue": 3}, "tissue: expected a text, found int"),
        ({"spacing": 1, "time_limit": "1 h"}, "time_limit: expected a number, found str"),
    ],
)
def test_bad_arguments(ball, arguments, message):
    with pytest.raises(mesamis.InputError, match=message) as caught:
        mesamis.segment(np.array(ball.array), **arguments)
    assert "\n" not in str(caught.value)
    assert isinstance(caught.value, ValueError)


def test_bad_scans():
    with pytest.raises(mesamis.InputError, match="three axes"):
        mesamis.segment(np.zeros((4, 4)), spacing=1)
    with pytest.raises(mesamis.InputError, match="real numbers"):
        mesamis.segment(np.zeros((4, 4, 4), dtype=complex), spacing=1)
    with pytest.raises(mesamis.InputError, match="samples that differ"):
        mesamis.segment(np.zeros((4, 4, 4)), spacing=1)
    with pytest.raises(mesamis.InputError, match="finite"):
        mesamis.segment(np.full((4, 4, 4), np.nan), spacing=1)
    with pytest.raises(mesamis.InputError, match="expected a scan, or labels"):
        mesamis.segment()
    with pytest.raises(mesamis.InputError, match="without affine"):
        mesamis.segment("scan.nii", affine=np.eye(4))


def test_unknown_keywords_are_type_errors(ball):
    with pytest.raises(TypeError, match="did you mean 'max_tets'"):
        mesamis.segment(ball, max_tet=3)


def test_saving_refuses_what_is_not_there(ball, tmp_path):
    result = mesamis.segment(ball, preview=True)
    with pytest.raises(mesamis.InputError, match="found a preview"):
        result.save(tmp_path / "m.vtu")
    with pytest.raises(mesamis.InputError, match="x.abc"):
        result.save(tmp_path / "x.abc")
    with pytest.raises(mesamis.InputError, match="error: expected a .vtp or .ply"):
        result.save(tmp_path / "x.stl", error=True)
    assert not list(tmp_path.iterdir())
    result.save(tmp_path / "r.json")
    assert [p.name for p in tmp_path.iterdir()] == ["r.json"]


def test_settings_may_be_numpy_none_or_text(ball):
    a = mesamis.segment(ball, preview=True, level=np.float32(150), blur=np.array([0, 0, 0]), triangles=None)
    b = mesamis.segment(ball, preview=True, level="150", blur="0,0,0")
    assert np.array_equal(a.points, b.points) and a.report["settings"]["level"] == 150
    crop = mesamis.segment(ball, preview=True, crop=(slice(2, 22), None, (None, 22)), level=150)
    assert crop.report["settings"]["crop"] == [[2, 22], [0, -1], [0, 22]]


def test_objects_of_seeds_and_labels():
    array = np.zeros((20, 20, 40), dtype=np.float32)
    array[5:15, 5:15, 5:15] = array[5:15, 5:15, 22:34] = 100
    with pytest.warns(mesamis.MesamisWarning, match="likely a label map"):
        two = mesamis.segment(array, affine=np.eye(4), frame="ras", seeds=[(10, 10, 10), (10, 10, 28)], blur=0)
    assert len(two) == 2 and all(len(o.triangles) for o in two)
    labels = (array > 50).astype(int)
    labels[:, :, 20:] *= 7
    found = mesamis.segment(array, affine=np.eye(4), labels=labels, label=7, label_names={7: "upper"}, blur=0)
    assert [o.name for o in found] == ["upper"] and found["upper"].label == found[7].label == 7
    with pytest.raises(KeyError):
        found["lower"]
    alone = mesamis.segment(labels=mesamis.segment(array, affine=np.eye(4), labels=labels) and _labels_file(labels))
    assert len(alone) == 2


@pytest.mark.parametrize("how", [{"surface": "band"}, {"preset": "paper"}, {"settings_file": "band.json"}])
def test_several_objects_are_solids_whatever_sets_the_band(ball, tmp_path, how):
    if "settings_file" in how:
        (tmp_path / "band.json").write_text('{"surface": "band"}')
        how = {"settings_file": tmp_path / "band.json"}
    for objects in ({"labels": (ball.array > 128).astype(int)}, {"seeds": [(9, 12, 12), (15, 12, 12)]}):
        with pytest.raises(mesamis.InputError, match="^surface: expected solid for several objects, found band$"):
            mesamis.segment(ball, **objects, **how)


def _labels_file(labels):
    nibabel = pytest.importorskip("nibabel")
    return nibabel.Nifti1Image(labels.astype(np.uint8), np.eye(4))
