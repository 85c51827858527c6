"""`incircle.triangulate`: the mesh, its types, its back ends and its errors."""

import itertools
import os
import pickle
import threading

import numpy as np
import pytest

import incircle

SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4), (4, 0)]
TYPES = ("float64", "float32", "int64", "int32", "uint32")


def determinant(a, b, c, d):
    """The sign of the determinant of four points, in integers of Python: positive if `d` lies inside."""
    rows = [(int(x) - int(d[0]), int(y) - int(d[1])) for x, y in (a, b, c)]
    (ax, ay), (bx, by), (cx, cy) = rows
    a2, b2, c2 = (x * x + y * y for x, y in rows)
    return ax * (by * c2 - cy * b2) - ay * (bx * c2 - cx * b2) + a2 * (bx * cy - cx * by)


@pytest.mark.parametrize("dtype", TYPES)
def test_a_square_has_its_lists_in_every_type(dtype):
    mesh = incircle.triangulate(np.array(SQUARE, dtype=dtype))
    assert mesh.points.dtype == dtype and mesh.points.tolist() == [list(point) for point in SQUARE]
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3]] and mesh.triangles.dtype == np.uint32
    assert mesh.hull.tolist() == [0, 1, 2, 3] and mesh.hull.dtype == np.uint32
    assert mesh.duplicates.tolist() == [[4, 1]]
    assert mesh.neighbors.tolist() == [[-1, 1, -1], [-1, -1, 0]] and mesh.neighbors.dtype == np.int32
    assert mesh.halfedges.tolist() == [-1, -1, 3, 2, -1, -1] and mesh.halfedges.dtype == np.int32
    assert sorted(map(sorted, mesh.edges.tolist())) == [[0, 1], [0, 2], [0, 3], [1, 2], [2, 3]]
    assert (mesh.report.distinct, mesh.report.triangles, mesh.report.backend) == (4, 2, "cpu")
    mesh.verify()


def test_no_triangle_has_a_point_inside_its_circle():
    points = np.random.default_rng(7).integers(-50, 50, (40, 2))
    mesh = incircle.triangulate(points)
    for corners in mesh.triangles:
        signs = [determinant(*points[corners], point) for point in points]
        assert max(signs) == 0


@pytest.mark.parametrize("points", [[], np.empty((0, 2)), [(1, 2)], [(1, 2), (1, 2)], [(0, 0), (2, 2), (1, 1)]])
def test_few_points_and_points_on_a_line_have_no_triangle(points):
    mesh = incircle.triangulate(points)
    assert mesh.is_collinear and mesh.triangles.shape == (0, 3) and mesh.neighbors.shape == (0, 3)
    assert mesh.edges.shape == (0, 2) and mesh.report.collinear
    assert len(mesh.hull) == mesh.report.distinct


def test_doubles_and_long_integers_are_exact():
    tiny = np.nextafter(0.5, 1.0)
    mesh = incircle.triangulate([(0.0, 0.0), (1.0, 1.0), (0.5, tiny)])
    assert mesh.triangles.tolist() == [[0, 1, 2]]
    big = 2**62
    mesh = incircle.triangulate(np.array([(-big, -big), (big, big), (0, 1)]))
    assert mesh.triangles.tolist() == [[0, 1, 2]]


@pytest.mark.parametrize("backend", ["cpu", "cpu?threads=1", "model", "clock?config=small", ["clock", "cpu"]])
def test_all_back_ends_give_the_same_mesh(backend):
    points = np.random.default_rng(3).integers(0, 200, (3000, 2))
    mesh, expected = incircle.triangulate(points, backend=backend), incircle.triangulate(points, threads=1)
    for name in ("triangles", "hull", "duplicates"):
        np.testing.assert_array_equal(getattr(mesh, name), getattr(expected, name))
    if backend == ["clock", "cpu"]:
        assert sum(share.parts for share in mesh.report.shares) == mesh.report.parts > 0


def test_the_report_has_the_counters_of_a_core():
    points = np.random.default_rng(3).integers(0, 2000, (300, 2))
    report = incircle.triangulate(points, backend="clock?config=small").report
    assert report.counters["insertions"] > 0 and report.step == "1" and report.bits == 11
    assert set(report.stages) == {"order", "insert", "read", "assemble"}


def test_the_library_says_what_is_wrong_with_a_back_end():
    with pytest.raises(incircle.DeviceNotFoundError, match="\"modem\" is not a device address"):
        incircle.triangulate(SQUARE, backend="modem")
    with pytest.raises(OSError, match="/nowhere"):
        incircle.triangulate(SQUARE, backend="serial:/nowhere")
    with pytest.raises(incircle.InputError, match="point 1 is .65536, 5., but coordinates of 16 bits end at 65535"):
        incircle.triangulate(np.array([(0, 0), (65536, 5), (3, 9)], dtype=np.uint32), backend="model")
    for backend in ([], [3], ["cpu", None]):
        with pytest.raises(incircle.ChoiceError, match="give the address of one"):
            incircle.triangulate(SQUARE, backend=backend)
    with pytest.raises(incircle.DeviceNotFoundError, match="modem"):
        incircle.triangulate(SQUARE, backend=["cpu", "modem"])


def test_threads_are_checked():
    for threads in (0, -1, 257, 2**70):
        with pytest.raises(incircle.ChoiceError, match=f"{threads} threads are not possible: choose 1 to 256"):
            incircle.triangulate(SQUARE, threads=threads)
    with pytest.raises(incircle.ChoiceError, match="the back end is model"):
        incircle.triangulate(SQUARE, backend="model", threads=2)
    with pytest.raises(TypeError):
        incircle.triangulate(SQUARE, threads=1.5)
    points = np.random.default_rng(0).random((40_000, 2))
    assert incircle.triangulate(points, threads=2).report.contexts <= 2


def test_later_writes_to_the_points_change_nothing():
    points = np.array(SQUARE, dtype=float)
    mesh = incircle.triangulate(points)
    points[:] = 0
    assert mesh.points.tolist() == [list(point) for point in SQUARE]
    mesh.verify()


def test_writes_while_the_job_runs_change_nothing():
    points = np.random.default_rng(5).random((200_000, 2))
    expected = incircle.triangulate(points)
    own = points.copy()

    def scribble(*_):
        own[:] = np.nan

    mesh = incircle.triangulate(own, progress=scribble)
    np.testing.assert_array_equal(mesh.triangles, expected.triangles)
    np.testing.assert_array_equal(mesh.points, points)


def test_results_are_arrays_over_the_lists_of_the_library():
    mesh = incircle.triangulate(np.random.default_rng(2).random((1000, 2)))
    for array in (mesh.points, mesh.triangles, mesh.hull, mesh.halfedges, mesh.neighbors):
        root = array
        while isinstance(root.base, np.ndarray):
            root = root.base
        # Memory that numpy did not allocate has another object as its base.
        assert not root.flags.owndata and type(root.base).__name__ == "PySliceContainer"
        assert array.flags.writeable and array.flags.c_contiguous


def test_verify_finds_a_wrong_mesh():
    mesh = incircle.triangulate(SQUARE)
    mesh.triangles[0] = [0, 1, 3]
    with pytest.raises(incircle.VerifyError):
        mesh.verify()
    mesh = incircle.triangulate(SQUARE)
    mesh.hull[0] = 3
    with pytest.raises(incircle.VerifyError):
        mesh.verify()


def test_a_mesh_can_be_pickled():
    mesh = pickle.loads(pickle.dumps(incircle.triangulate(SQUARE)))
    assert mesh.triangles.tolist() == [[0, 1, 2], [0, 2, 3]] and mesh.report.points == 5
    mesh.verify()


def test_threads_of_python_triangulate_side_by_side():
    sets = [np.random.default_rng(seed).random((20_000, 2)) for seed in range(4)]
    found = [None] * 4

    def work(place):
        found[place] = incircle.triangulate(sets[place]).triangles

    threads = [threading.Thread(target=work, args=(place,)) for place in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for points, triangles in zip(sets, found):
        np.testing.assert_array_equal(triangles, incircle.triangulate(points).triangles)


def test_the_order_of_the_points_does_not_matter():
    points = np.array(list(itertools.product(range(4), range(3))))
    expected = {frozenset(map(tuple, points[corners].tolist())) for corners in incircle.triangulate(points).triangles}
    for seed in range(10):
        mixed = np.random.default_rng(seed).permutation(points)
        found = {frozenset(map(tuple, mixed[corners].tolist())) for corners in incircle.triangulate(mixed).triangles}
        assert found == expected


def test_the_version_is_that_of_the_package():
    from importlib.metadata import PackageNotFoundError, version

    try:
        assert version("incircle") == incircle.__version__
    except PackageNotFoundError:
        pytest.skip("the package is not installed")


def test_the_installed_wheel_is_what_is_tested():
    if "INCIRCLE_WHEEL" in os.environ:
        assert "site-packages" in incircle.__file__
