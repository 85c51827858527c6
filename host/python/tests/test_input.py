"""Points in all shapes, orders and types: taken exactly, or refused with the numbers."""

import numpy as np
import pytest

import incircle

NAN, INF = float("nan"), float("inf")
POINTS = np.array([(0, 0), (4, 0), (4, 4), (0, 4), (1, 2)])
EXPECTED = incircle.triangulate(POINTS).triangles


def same(points):
    mesh = incircle.triangulate(points)
    np.testing.assert_array_equal(mesh.triangles, EXPECTED)
    np.testing.assert_array_equal(mesh.points, POINTS)
    return mesh


def read_only(array):
    array = array.copy()
    array.flags.writeable = False
    return array


def misaligned(array):
    data = np.zeros(array.nbytes + 1, dtype=np.uint8)
    view = data[1:].view(array.dtype).reshape(array.shape)
    view[:] = array
    assert not view.flags.aligned
    return view


WIDE = np.zeros((10, 6))
WIDE[::2, 1::3] = POINTS


@pytest.mark.parametrize(
    "points",
    [
        np.asfortranarray(POINTS),
        np.asfortranarray(POINTS.astype(float)),
        WIDE[::2, 1::3],
        POINTS[::-1][::-1],
        POINTS[:, ::-1][:, ::-1],
        np.ascontiguousarray(POINTS[::-1])[::-1],
        read_only(POINTS),
        misaligned(POINTS.astype(float)),
        misaligned(POINTS.astype(np.float32)[:, ::-1].copy())[:, ::-1],
        POINTS.astype(">f8"),
        POINTS.astype(">i4"),
        POINTS.astype("<u4"),
        POINTS.tolist(),
        [tuple(point) for point in POINTS.tolist()],
        list(POINTS),
        memoryview(POINTS),
        POINTS.view(np.matrix) if hasattr(np, "matrix") else POINTS,
    ],
    ids=lambda points: type(points).__name__,
)
def test_any_order_and_container_is_taken(points):
    same(points)


@pytest.mark.parametrize(
    ("given", "taken"),
    [
        ("float16", "float32"),
        ("int8", "int32"),
        ("int16", "int32"),
        ("uint8", "uint32"),
        ("uint16", "uint32"),
        ("uint64", "int64"),
        ("longlong", "int64"),
        ("longdouble", "float64"),
    ],
)
def test_other_types_become_one_that_holds_all_their_numbers(given, taken):
    assert same(POINTS.astype(given)).points.dtype == taken


@pytest.mark.parametrize(
    ("points", "sentence"),
    [
        (5, r"have the shape \(\)"),
        (np.array(5.0), r"have the shape \(\)"),
        ([1, 2], r"have the shape \(2,\)"),
        (np.zeros((3, 3)), r"have the shape \(3, 3\)"),
        (np.zeros((0, 3)), r"have the shape \(0, 3\)"),
        (np.zeros((2, 2, 2)), r"have the shape \(2, 2, 2\)"),
        (np.zeros((4, 1)), r"have the shape \(4, 1\)"),
        ([(1, 2), (3,)], "no array of two columns"),
        (np.ma.masked_all((3, 2)), "with 6 of 6 coordinates masked"),
        (np.ma.array(np.zeros((3, 2)), mask=[[0, 1]] * 3), "with 3 of 6 coordinates masked"),
        ([(0.0, 0.0), (NAN, 1.0)], "the x of point 1 is NaN"),
        ([(0.0, 0.0), (2.0, INF)], "the y of point 1 is inf"),
        (np.array([(0, 0), (1, -INF)], dtype=np.float32), "the y of point 1 is -inf"),
        (np.array([(0, 0), (1, NAN)], dtype=np.float16), "the y of point 1 is NaN"),
        (np.array([(0, 0), (2**63, 1)], dtype=np.uint64), "the x of point 1 is 9223372036854775808, which int64"),
    ],
)
def test_bad_points_are_refused_with_the_numbers(points, sentence):
    with pytest.raises(incircle.InputError, match=sentence):
        incircle.triangulate(points)
    with pytest.raises(ValueError):
        incircle.triangulate(points)


def test_a_long_double_that_no_double_holds_is_refused():
    value = np.longdouble(1) + np.finfo(np.longdouble).eps
    if np.finfo(np.longdouble).eps == np.finfo(float).eps:
        pytest.skip("long doubles are doubles here")
    with pytest.raises(incircle.InputError, match="the y of point 1 is .*, which float64 cannot hold"):
        incircle.triangulate(np.array([(0, 0), (0, value)], dtype=np.longdouble))


@pytest.mark.parametrize(
    "points",
    [
        np.array([(1, 2), (3, 4)], dtype=object),
        np.array([(1, None), (3, 4)]),
        np.zeros((3, 2), dtype=complex),
        np.zeros((3, 2), dtype=bool),
        np.array([("1", "2")]),
        np.zeros((3, 2), dtype="M8[s]"),
        np.zeros((3, 2), dtype="m8[s]"),
        np.zeros((3, 2), dtype=[("x", "f8")]),
        [(2**70, 1)],
    ],
)
def test_types_that_are_no_exact_numbers_are_refused(points):
    with pytest.raises(incircle.NumberTypeError, match="the points have the type"):
        incircle.triangulate(points)
    with pytest.raises(TypeError):
        incircle.triangulate(points)


@pytest.mark.parametrize("count", [10**13])
@pytest.mark.parametrize("dtype", ["float64", "uint32", "float16", ">f8"])
def test_more_points_than_memory_holds_are_an_error_at_once(count, dtype):
    points = np.broadcast_to(np.zeros(2, dtype=dtype), (count, 2))
    for call in (incircle.triangulate, incircle.Triangulation, incircle.voronoi, incircle.Delaunay):
        # Where numpy must convert first, the exception is numpy's.
        with pytest.raises(MemoryError):
            call(points)


def test_tables_of_pandas_are_taken_or_refused():
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(POINTS, columns=["x", "y"])
    same(frame)
    same(frame.astype("uint16"))
    same(frame[["x", "y"]].set_index(frame["x"]))
    with pytest.raises(incircle.InputError, match=r"have the shape \(5, 3\)"):
        incircle.triangulate(frame.assign(z=1))
    with pytest.raises(incircle.InputError, match="the y of point 2 is NaN"):
        incircle.triangulate(frame.astype(float).replace({"y": {4: NAN}}))
    # A type with missing values of its own becomes objects.
    with pytest.raises(incircle.NumberTypeError, match="the points have the type object"):
        incircle.triangulate(frame.astype("Int64"))


def test_subclasses_and_containers_of_others_are_arrays():
    class Own(np.ndarray):
        pass

    assert type(same(POINTS.view(Own)).points) is np.ndarray
    same(type("Wrapped", (), {"__array__": lambda self, dtype=None, copy=None: POINTS})())

    class Refused(Exception):
        pass

    def refuse(*_, **__):
        raise Refused

    with pytest.raises(Refused):
        incircle.triangulate(type("Broken", (), {"__array__": refuse})())


def test_text_and_nothing_are_refused():
    for points in ("text", b"bytes", None, {}, object()):
        with pytest.raises(incircle.Error):
            incircle.triangulate(points)


def test_the_compiled_half_refuses_what_the_python_half_would_never_give():
    from incircle import _native

    for points in (np.zeros((3, 3)), np.zeros(4), np.zeros((2, 2), dtype=np.int16), misaligned(np.zeros((2, 2))), 5):
        with pytest.raises(TypeError):
            _native.triangulate(points, [], None, None)
    for triangles in (np.zeros((3, 2), dtype=np.uint32), np.zeros((3, 3)), None):
        with pytest.raises(TypeError):
            _native.halfedges(triangles)
    assert _native.halfedges(np.full((2, 3), 2**32 - 1, dtype=np.uint32)).tolist() == [-1] * 6
