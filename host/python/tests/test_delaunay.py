"""`incircle.Delaunay` beside SciPy's, on points without ties, and what only one of them does."""

import pickle

import numpy as np
import pytest

import incircle

spatial = pytest.importorskip("scipy.spatial")
interpolate = pytest.importorskip("scipy.interpolate")

POINTS = np.random.default_rng(6).random((500, 2))
PLACES = np.random.default_rng(7).random((4000, 2)) * 1.2 - 0.1


@pytest.fixture(scope="module")
def both():
    return incircle.Delaunay(POINTS), spatial.Delaunay(POINTS)


def as_sets(triangles):
    return sorted(map(sorted, triangles.tolist()))


def test_all_attributes_of_scipy_are_there_with_their_types(both):
    ours, theirs = both
    for name in dir(theirs):
        if name.startswith("_") or callable(getattr(theirs, name)):
            continue
        own, other = getattr(ours, name), getattr(theirs, name)
        if isinstance(other, np.ndarray):
            assert own.dtype == other.dtype and own.shape == other.shape, name
            assert own.flags.c_contiguous == other.flags.c_contiguous and own.flags.writeable, name
        else:
            assert type(own) is type(other), name


def test_triangles_and_what_follows_from_them_are_those_of_scipy(both):
    ours, theirs = both
    assert as_sets(ours.simplices) == as_sets(theirs.simplices)
    assert as_sets(ours.convex_hull) == as_sets(theirs.convex_hull)
    np.testing.assert_array_equal(ours.min_bound, theirs.min_bound)
    for vertex in range(len(POINTS)):
        own, other = (
            set(indices[starts[vertex] : starts[vertex + 1]].tolist())
            for starts, indices in (ours.vertex_neighbor_vertices, theirs.vertex_neighbor_vertices)
        )
        assert own == other
        assert vertex in ours.simplices[ours.vertex_to_simplex[vertex]]


def test_neighbours_are_opposite_their_corners_and_triangles_counter_clockwise(both):
    ours, _ = both
    for triangle, (corners, beside) in enumerate(zip(ours.simplices, ours.neighbors)):
        a, b, c = POINTS[corners]
        assert np.cross([*(b - a), 0], [*(c - a), 0])[2] > 0
        for place, other in enumerate(beside):
            if other >= 0:
                assert corners[place] not in ours.simplices[other] and triangle in ours.neighbors[other]


def test_find_simplex_finds_the_same_triangles(both):
    ours, theirs = both
    for options in ({}, {"bruteforce": True}, {"tol": 1e-9}):
        own, other = ours.find_simplex(PLACES, **options), theirs.find_simplex(PLACES, **options)
        np.testing.assert_array_equal(own < 0, other < 0)
        found = own >= 0
        assert found.any() and not found.all()
        np.testing.assert_array_equal(
            np.sort(ours.simplices[own[found]], axis=1), np.sort(theirs.simplices[other[found]], axis=1)
        )
    np.testing.assert_allclose(ours.lift_points(POINTS)[:, 2], (POINTS**2).sum(axis=1))
    assert ours.plane_distance(PLACES[:3]).shape == (3, ours.nsimplex)


@pytest.mark.parametrize("name", ["LinearNDInterpolator", "CloughTocher2DInterpolator"])
def test_the_interpolators_of_scipy_give_the_same_values(both, name):
    ours, theirs = both
    values = np.sin(POINTS[:, 0] * 5) + POINTS[:, 1]
    interpolator = getattr(interpolate, name)
    own, other = interpolator(ours, values)(PLACES), interpolator(theirs, values)(PLACES)
    np.testing.assert_array_equal(np.isnan(own), np.isnan(other))
    np.testing.assert_allclose(own, other, rtol=1e-9, atol=1e-9, equal_nan=True)


def test_duplicates_are_coplanar_and_have_a_triangle():
    mesh = incircle.Delaunay([(0, 0), (4, 0), (4, 4), (0, 4), (4, 0)])
    assert mesh.coplanar.tolist() == [[4, mesh.vertex_to_simplex[1], 1]]
    assert 1 in mesh.simplices[mesh.vertex_to_simplex[4]]


def test_points_can_be_added():
    mesh = incircle.Delaunay(POINTS[:100], incremental=True)
    for some in np.array_split(POINTS[100:], 7):
        mesh.add_points(some)
    whole = incircle.Delaunay(POINTS)
    np.testing.assert_array_equal(mesh.simplices, whole.simplices)
    np.testing.assert_array_equal(mesh.vertex_neighbor_vertices[1], whole.vertex_neighbor_vertices[1])
    mesh.add_points([(5, 5)], restart=True)
    assert mesh.npoints == 501
    mesh.close()
    for closed in (mesh, whole):
        with pytest.raises(RuntimeError, match="incremental mode not enabled or already closed"):
            closed.add_points([(7, 7)])


def test_what_cannot_be_is_refused():
    for points in ([(0, 0), (1, 1)], [(0, 0), (1, 1), (2, 2)], [(0, 0)] * 5):
        with pytest.raises(spatial.QhullError, match="distinct points have no triangle"):
            incircle.Delaunay(points)
        with pytest.raises(incircle.FlatError):
            incircle.Delaunay(points)
    for points in (np.empty((0, 2)), np.zeros((4, 3)), np.zeros(4), np.array([(0, 0), (1, np.nan), (1, 2)])):
        with pytest.raises(ValueError):
            incircle.Delaunay(points)
    with pytest.raises(incircle.InputError, match="the x of point 1 is 9007199254740993, which float64 cannot hold"):
        incircle.Delaunay([(0, 0), (2**53 + 1, 0), (5, 5)])
    with pytest.raises(incircle.ChoiceError, match="no furthest-site"):
        incircle.Delaunay(POINTS, furthest_site=True)
    with pytest.raises(incircle.ChoiceError, match="the option Qu of Qhull"):
        incircle.Delaunay(POINTS, qhull_options="Qbb Qu")
    for options in (5, ["Qbb"], b"\xff"):
        with pytest.raises(incircle.ChoiceError, match="of Qhull"):
            incircle.Delaunay(POINTS, qhull_options=options)
    incircle.Delaunay(POINTS, qhull_options="QJ Pp")
    with pytest.raises(incircle.ChoiceError, match="such as point 500, which lies on point 0"):
        incircle.Delaunay(np.concatenate([POINTS, POINTS]), qhull_options=b"QJ Pp")


def test_points_that_are_refused_leave_the_triangulation_as_it_was():
    mesh = incircle.Delaunay(POINTS, incremental=True)
    before = mesh.simplices.copy()
    for points in ([(np.nan, 1)], np.zeros((2, 3)), "text", [(2**53 + 1, 0)]):
        with pytest.raises(ValueError):
            mesh.add_points(points)
    mesh.add_points(np.empty((0, 2)))
    assert mesh.npoints == len(POINTS)
    np.testing.assert_array_equal(mesh.simplices, before)


def test_a_triangulation_can_be_pickled(both):
    found = pickle.loads(pickle.dumps(both[0]))
    assert isinstance(found, incircle.Delaunay)
    np.testing.assert_array_equal(found.find_simplex(PLACES), both[0].find_simplex(PLACES))


def test_the_caller_may_write_to_the_arrays():
    points = POINTS.copy()
    mesh = incircle.Delaunay(points)
    points[:] = 0
    np.testing.assert_array_equal(mesh.points, POINTS)
    mesh.simplices.sort()
    mesh.neighbors[:] = 0


def test_nearly_flat_points_keep_all_their_triangles():
    x = np.linspace(0, 1, 50)
    points = np.concatenate([np.column_stack([x, x * 0]), np.column_stack([x, x * 0 + 5e-324])])
    assert incircle.Delaunay(points).nsimplex == 98
