"""Values between points: exactness, places outside, contours, and values that are refused."""

import copy
import pickle

import numpy as np
import pytest

import incircle

POINTS = np.array([(0, 0), (4, 0), (4, 4), (0, 4)])
VALUES = [0, 4, 8, 4]
METHODS = ("linear", "laplace", "sibson")
NAN, INF = float("nan"), float("inf")


@pytest.mark.parametrize("method", METHODS)
def test_linear_functions_and_the_points_themselves_are_given_back(method):
    random = np.random.default_rng(1)
    points, at = random.random((300, 2)), random.random((500, 2)) * 0.8 + 0.1
    values = 3 * points[:, 0] - 2 * points[:, 1] + 1
    surface = incircle.Surface(points, values)
    np.testing.assert_array_equal(surface(points, method), values)
    np.testing.assert_allclose(surface(at, method), 3 * at[:, 0] - 2 * at[:, 1] + 1, atol=1e-9)


def test_linear_is_that_of_scipy():
    interpolate = pytest.importorskip("scipy.interpolate")
    random = np.random.default_rng(2)
    points, values, at = random.random((400, 2)), random.random(400), random.random((2000, 2)) * 1.2 - 0.1
    theirs = interpolate.LinearNDInterpolator(points, values)(at)
    ours = incircle.interpolate(points, values, at)
    np.testing.assert_array_equal(np.isnan(ours), np.isnan(theirs))
    np.testing.assert_allclose(ours, theirs, rtol=1e-9)


@pytest.mark.parametrize("method", METHODS)
def test_threads_and_orders_change_nothing(method):
    random = np.random.default_rng(3)
    points, values, at = random.random((3000, 2)), random.random(3000), random.random((40_000, 2))
    surface = incircle.Surface(points, values)
    one = surface(at, method, threads=1)
    np.testing.assert_array_equal(surface(at, method, threads=3), one)
    np.testing.assert_array_equal(surface(at[::-1], method)[::-1], one)


def test_places_outside_have_no_value_or_that_of_the_nearest_point():
    at = [(9, 9), (-1, -3), (2, 5), (NAN, 0), (0, INF)]
    assert np.isnan(incircle.interpolate(POINTS, VALUES, at)).all()
    nearest = incircle.interpolate(POINTS, VALUES, at, outside="nearest")
    assert nearest[:3].tolist() == [8, 0, 8] and np.isnan(nearest[3:]).all()


def test_of_duplicates_the_lowest_index_has_the_value():
    assert incircle.interpolate([*POINTS.tolist(), (4, 4)], [*VALUES, 99], [(4, 4), (2, 2)]).tolist() == [8, 4]


@pytest.mark.parametrize(
    "values",
    [
        np.array(VALUES, dtype=np.uint8),
        np.array(VALUES, dtype=">f4"),
        np.array([VALUES, VALUES]).T[:, 1],
        np.array(VALUES[::-1])[::-1],
        tuple(VALUES),
        np.broadcast_to(4.0, 4),
    ],
    ids=lambda values: type(values).__name__,
)
def test_any_order_and_type_of_values_is_taken(values):
    expected = np.asarray(values, dtype=float)[0]
    assert incircle.interpolate(POINTS, values, [(0, 0)]).tolist() == [expected]


def test_read_only_arrays_are_taken():
    arrays = [np.array(POINTS, dtype=float), np.array(VALUES, dtype=float), np.array([(3.0, 1.0)])]
    for array in arrays:
        array.flags.writeable = False
    assert incircle.interpolate(*arrays).tolist() == [4]


@pytest.mark.parametrize(
    ("values", "error", "sentence"),
    [
        ([1, 2, 3], incircle.InputError, r"4 points have values of the shape \(3,\): give one value for each point"),
        (np.zeros((4, 1)), incircle.InputError, r"the shape \(4, 1\)"),
        (5, incircle.InputError, r"the shape \(\)"),
        ([1, 2, NAN, 4], incircle.InputError, "the value of point 2 is nan, which is not a finite number"),
        ([1, -INF, 3, 4], incircle.InputError, "the value of point 1 is -inf"),
        (np.ma.masked_all(4), incircle.InputError, "the values are a masked array, with 4 of 4 values masked"),
        ([1, [2], 3, 4], incircle.InputError, "the values are no array"),
        (["1", "2", "3", "4"], incircle.NumberTypeError, "the values have the type <U1"),
        ([1j] * 4, incircle.NumberTypeError, "the values have the type complex128"),
        ([None] * 4, incircle.NumberTypeError, "the values have the type object"),
        ([True] * 4, incircle.NumberTypeError, "the values have the type bool"),
    ],
)
def test_bad_values_are_refused(values, error, sentence):
    with pytest.raises(error, match=sentence):
        incircle.Surface(POINTS, values)


@pytest.mark.parametrize(
    ("points", "sentence"),
    [
        ([], "triangle"),
        ([(0, 0), (1, 1), (2, 2)], "triangle"),
        ([(0, 0), (1, NAN), (2, 2)], "the y of point 1 is NaN"),
        (np.array([(0, 0), (1, 0), (0, 2**62 + 1)]), "the y of point 2 is 4611686018427387905, which float64 cannot"),
    ],
)
def test_points_without_a_surface_are_refused(points, sentence):
    with pytest.raises(incircle.InputError, match=f"(?i){sentence}"):
        incircle.Surface(points, np.zeros(len(points)))


@pytest.mark.parametrize(
    ("at", "sentence"),
    [
        ((1, 1), r"the places have the shape \(2,\)"),
        ([(1, 1, 1)], r"the places have the shape \(1, 3\)"),
        ([(1, 2), (3,)], "the places are no array of two columns"),
        (np.array([(0, 0), (0, 2**62 + 1)]), "the y of place 1 is 4611686018427387905, which float64 cannot hold"),
    ],
)
def test_bad_places_are_refused(at, sentence):
    with pytest.raises(incircle.InputError, match=sentence):
        incircle.interpolate(POINTS, VALUES, at)


def test_no_places_have_no_values():
    for none in ([], np.empty((0, 2), dtype=int)):
        values = incircle.interpolate(POINTS, VALUES, none)
        assert values.shape == (0,) and values.dtype == np.float64


@pytest.mark.parametrize(
    ("choices", "sentence"),
    [
        ({"method": "cubic"}, "the method is 'cubic': choose one of linear, laplace, sibson"),
        ({"outside": 0}, "outside is 0: choose one of nan, nearest"),
        ({"method": ["linear"]}, "the method is .'linear'.: choose one of"),
        ({"outside": np.array(["nan", "nearest"])}, "choose one of nan, nearest"),
        ({"threads": -1}, "-1 threads are not possible"),
        ({"threads": 2**64}, "18446744073709551616 threads are not possible: choose 1 to 256"),
    ],
)
def test_bad_choices_are_refused(choices, sentence):
    with pytest.raises(incircle.ChoiceError, match=sentence):
        incircle.interpolate(POINTS, VALUES, [(1, 1)], **choices)


def test_contours_are_lines_of_equal_value():
    x, y = np.meshgrid(np.arange(-20, 21), np.arange(-20, 21))
    points = np.column_stack([x.ravel(), y.ravel()])
    surface = incircle.Surface(points, np.hypot(*points.T))
    ((line, is_closed),) = surface.contours(9.5)
    assert is_closed and np.abs(np.hypot(*line.T) - 9.5).max() < 0.2
    np.testing.assert_allclose(surface(line), 9.5, atol=1e-9)
    # The cone is higher outside, so the line runs clockwise around its tip.
    assert (line[:, 0] * np.roll(line[:, 1], -1) - np.roll(line[:, 0], -1) * line[:, 1]).sum() < 0
    assert surface.contours(99) == [] and surface.contours(NAN) == []


def test_a_surface_is_its_own_copy_and_cannot_be_pickled():
    surface = incircle.Surface(POINTS, VALUES)
    assert copy.copy(surface) is surface and copy.deepcopy({"one": surface})["one"] is surface
    with pytest.raises(TypeError, match="a Surface cannot be pickled: pickle its points and values"):
        pickle.dumps(surface)


def test_many_places_have_the_values_of_few():
    surface = incircle.Surface(POINTS, VALUES)
    at = np.random.default_rng(5).random(((1 << 20) + 7, 2)) * 4
    values = surface(at)
    np.testing.assert_array_equal(values[-9:], surface(at[-9:]))
    np.testing.assert_allclose(values, at.sum(axis=1), atol=1e-12)
