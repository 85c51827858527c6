"""Progress, exceptions from call-backs, and Ctrl-C."""

import os
import signal
import threading
import time

import numpy as np
import pytest

import incircle

POINTS = np.random.default_rng(1).random((100_000, 2))


@pytest.mark.parametrize("backend", [None, "model", ["cpu?threads=1", "cpu?threads=1"]])
def test_a_function_hears_of_all_stages(backend):
    heard = []
    points = np.random.default_rng(1).integers(0, 65536, (30_000, 2))
    incircle.triangulate(points, backend=backend, progress=lambda *progress: heard.append(progress))
    stages = list(dict.fromkeys(stage for stage, _, _ in heard))
    assert stages == [stage for stage in ("order", "insert", "read", "assemble") if stage in stages]
    assert {"order", "insert", "assemble"} <= set(stages)
    assert all(0 <= done <= total for _, done, total in heard)


def test_a_bar_of_tqdm_is_taken_as_it_is(capsys):
    tqdm = pytest.importorskip("tqdm")
    with tqdm.tqdm() as bar:
        mesh = incircle.triangulate(POINTS, progress=bar)
        assert bar.total == len(POINTS) and 0 <= bar.n <= bar.total
    assert "assemble" in capsys.readouterr().err
    np.testing.assert_array_equal(mesh.triangles, incircle.triangulate(POINTS).triangles)


@pytest.mark.parametrize("backend", [None, "model", ["cpu?threads=1", "cpu?threads=1"]])
@pytest.mark.parametrize("last_stage", ["order", "insert", "assemble"])
def test_an_exception_from_the_function_arrives(backend, last_stage):
    points = np.random.default_rng(1).integers(0, 65536, (5_000, 2))

    class Own(Exception):
        pass

    def refuse(stage, done, total):
        if stage == last_stage:
            raise Own(stage, done, total)

    with pytest.raises(Own) as raised:
        incircle.triangulate(points, backend=backend, progress=refuse)
    assert raised.value.args[0] == last_stage
    assert incircle.triangulate(points, backend=backend).report.points == 5_000


def test_a_function_that_returns_false_cancels():
    with pytest.raises(incircle.Cancelled, match="the job was cancelled after .* in the stage \"insert\""):
        incircle.triangulate(POINTS, progress=lambda stage, done, total: stage != "insert")
    for answer in (None, 0, "", True):
        incircle.triangulate(POINTS[:100], progress=lambda *_: answer)


def test_a_function_of_the_wrong_shape_is_an_error():
    with pytest.raises(TypeError):
        incircle.triangulate(POINTS, progress=lambda: None)
    with pytest.raises(incircle.ChoiceError, match="progress is a int: give a function"):
        incircle.triangulate(POINTS, progress=5)


def test_a_function_may_triangulate_itself():
    found = []
    incircle.triangulate(POINTS, progress=lambda *_: found.append(incircle.triangulate(POINTS[:50]).report.triangles))
    assert found and len(set(found)) == 1


@pytest.fixture
def handler():
    """Python's own handler of Ctrl-C, which is not there in a process that a shell started in the background."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def interrupted(call, after):
    """The seconds until a call ends that gets a signal after some seconds."""
    timer = threading.Timer(after, lambda: os.kill(os.getpid(), signal.SIGINT))
    start = time.monotonic()
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        call()
        # The call may have been too quick for the signal.
        time.sleep(30)
    timer.join()
    return time.monotonic() - start


def test_ctrl_c_ends_a_job(handler):
    points = np.random.default_rng(1).random((2_000_000, 2))
    start = time.monotonic()
    incircle.triangulate(points, threads=1)
    whole = time.monotonic() - start
    assert interrupted(lambda: incircle.triangulate(points, threads=1), 0.3 * whole) < whole + 5
    slow = np.random.default_rng(1).integers(0, 65536, (14_000, 2))
    assert interrupted(lambda: incircle.triangulate(slow, backend="clock"), 0.2) < 20


def test_ctrl_c_ends_a_relaxation(handler):
    points = np.random.default_rng(1).integers(0, 2**20, (2_000, 2))
    # All steps would take an hour.
    assert interrupted(lambda: incircle.lloyd(points, 2**32 - 1), 0.3) < 20
    few = np.array([(1, 1), (2, 9), (9, 5)])
    assert interrupted(lambda: incircle.lloyd(few, 2**32 - 1, clip=(0, 0, 10, 10)), 0.3) < 20


def test_ctrl_c_ends_questions(handler):
    mesh = incircle.Triangulation(POINTS[:1000])
    at = np.tile(POINTS, (60, 1))
    for ask in (mesh.locate_all, mesh.nearest_all, incircle.Surface(POINTS, POINTS[:, 0])):
        start = time.monotonic()
        ask(at[: len(POINTS)])
        whole = 60 * (time.monotonic() - start)
        assert interrupted(lambda: ask(at), 0.1 * whole) < 0.8 * whole + 5


def test_ctrl_c_ends_changes_of_a_mesh_that_lives(handler):
    mesh = incircle.Triangulation()
    points = np.random.default_rng(1).random((3_000_000, 2))
    interrupted(lambda: mesh.insert_all(points), 0.5)
    assert 0 < len(mesh) < len(points) and mesh.next_index == len(mesh)
    np.testing.assert_array_equal(mesh.points, points[: len(mesh)])
