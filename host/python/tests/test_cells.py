"""Voronoi cells, clips, and points that are spread evenly."""

from fractions import Fraction

import numpy as np
import pytest

import incircle

SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4), (2, 2)]
BOX = (0, 0, 4, 4)
NAN, INF = float("nan"), float("inf")


def area(ring):
    x, y = ring[:, 0], ring[:, 1]
    return (x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2


def centroid(ring):
    x, y = (ring - ring[0]).T
    cross = x * np.roll(y, -1) - np.roll(x, -1) * y
    middle = [((axis + np.roll(axis, -1)) * cross).sum() / (3 * cross.sum()) for axis in (x, y)]
    return ring[0] + middle


def center(a, b, c):
    """The centre of the circle through three points, in fractions, as the nearest doubles."""
    (bx, by), (cx, cy) = ((int(p[0]) - int(a[0]), int(p[1]) - int(a[1])) for p in (b, c))
    d, b2, c2 = 2 * (bx * cy - by * cx), bx * bx + by * by, cx * cx + cy * cy
    return [float(int(a[0]) + Fraction(cy * b2 - by * c2, d)), float(int(a[1]) + Fraction(bx * c2 - cx * b2, d))]


@pytest.mark.parametrize("dtype", ["float64", "float32", "int64", "int32", "uint32", "int8", ">f8"])
def test_a_square_has_its_cells_in_every_type(dtype):
    diagram = incircle.voronoi(np.array(SQUARE, dtype=dtype), clip=BOX)
    assert diagram.vertices[diagram.cell(4)].tolist() == [[0, 2], [2, 0], [4, 2], [2, 4]]
    assert diagram.neighbors_of(4).tolist() == [0, 1, 2, 3]
    assert -1 in diagram.cell(0).tolist()
    assert diagram.cells.areas.tolist() == [2, 2, 2, 2, 8]
    assert [len(diagram.cells.pieces(point)) for point in range(5)] == [1] * 5
    assert diagram.largest_error is None and diagram.duplicates.shape == (0, 2)


def test_vertices_are_the_centres_of_triangles_rounded_once():
    points = np.random.default_rng(1).integers(0, 2**20, (60, 2))
    diagram, mesh = incircle.voronoi(points), incircle.triangulate(points)
    expected = sorted(center(*points[corners]) for corners in mesh.triangles)
    assert sorted(diagram.vertices.tolist()) == expected and diagram.cells is None
    edges = {tuple(sorted(edge)) for edge in mesh.edges.tolist()}
    assert edges == {
        tuple(sorted((point, other))) for point in range(60) for other in diagram.neighbors_of(point).tolist()
    }


def test_one_circle_has_one_vertex():
    diagram = incircle.voronoi([(0, 0), (2, 0), (2, 2), (0, 2)])
    assert diagram.vertices.tolist() == [[1, 1]]
    assert [diagram.neighbors_of(point).tolist() for point in range(4)] == [[1, 3], [2, 0], [3, 1], [0, 2]]


def test_cells_in_a_clip_cover_it_and_hold_the_nearest_places():
    random = np.random.default_rng(2)
    for clip, whole in ((BOX, 16), ([(0, 0), (4, 0), (4, 4), (2, 1), (0, 4)], 10), ([(0, 0), (0, 4), (4, 0)], 8)):
        points = random.integers(0, 64, (25, 2)) / 16
        cells = incircle.voronoi(points, clip=clip).cells
        assert cells.areas.sum() == pytest.approx(whole, abs=1e-12)
        for point in range(25):
            pieces = cells.pieces(point)
            assert sum(map(area, pieces)) == pytest.approx(cells.areas[point], abs=1e-12)
            for corners in pieces:
                away = ((corners[:, None] - points) ** 2).sum(axis=2)
                assert (away[:, point] <= away.min(axis=1) + 1e-9).all()


def test_neighbours_inside_the_clip_are_mutual_and_fewer():
    points = np.random.default_rng(3).integers(0, 1000, (50, 2))
    diagram = incircle.voronoi(points, clip="box")
    cells = diagram.cells
    inside = [
        set(cells.neighbors[cells.neighbor_starts[k] : cells.neighbor_starts[k + 1]].tolist()) for k in range(50)
    ]
    for point, others in enumerate(inside):
        assert others <= set(diagram.neighbors_of(point).tolist())
        assert all(point in inside[other] for other in others)
    assert sum(map(len, inside)) < len(diagram.neighbors)


def test_the_edges_are_those_of_scipy():
    spatial = pytest.importorskip("scipy.spatial")
    points = np.random.default_rng(4).integers(0, 2**30, (500, 2))
    diagram, other = incircle.voronoi(points), spatial.Voronoi(points)
    ours = {tuple(sorted((p, int(q)))) for p in range(500) for q in diagram.neighbors_of(p)}
    assert ours == {tuple(sorted(pair)) for pair in other.ridge_points.tolist()}
    mine, theirs = (places[np.lexsort(places.T)] for places in (diagram.vertices, other.vertices))
    np.testing.assert_allclose(mine, theirs, rtol=1e-6)


def test_duplicates_and_few_points():
    diagram = incircle.voronoi([(1, 1), (3, 1), (1, 1)], clip=BOX)
    assert diagram.duplicates.tolist() == [[2, 0]] and diagram.cells.areas.tolist() == [8, 8, 0]
    assert diagram.cell(2).tolist() == [] and diagram.cells.pieces(2) == []
    for empty in ([], np.empty((0, 2), dtype=np.float32)):
        diagram = incircle.voronoi(empty, clip=BOX)
        assert diagram.vertices.shape == (0, 2) and diagram.starts.tolist() == [0] and len(diagram.cells.areas) == 0
    assert incircle.voronoi([(1, 1)], clip=BOX).cells.areas.tolist() == [16]
    assert len(incircle.voronoi([(0, 0), (1, 1), (2, 2)]).vertices) == 0


def test_doubles_need_a_grid_and_its_error_is_told():
    points = np.random.default_rng(5).random((100, 2))
    with pytest.raises(incircle.InputError, match="on no lattice of up to 32 bits, but 31 bits are possible: quantise"):
        incircle.voronoi(points)
    diagram = incircle.voronoi(points, clip=(0, 0, 1, 1), quantize="fit")
    assert 0 < diagram.largest_error < 1e-9
    assert diagram.cells.areas.sum() == pytest.approx(1, abs=1e-8)
    np.testing.assert_array_equal(diagram.points, points)


def test_to_shapely_makes_one_geometry_for_each_point():
    pytest.importorskip("shapely")
    ring = [(0, 0), (20, 0), (20, 10), (15, 10), (15, 2), (5, 2), (5, 10), (0, 10)]
    shapes = incircle.voronoi([(10, 9), (10, 1), (10, 9)], clip=ring).to_shapely()
    assert [shape.geom_type for shape in shapes] == ["MultiPolygon", "Polygon", "Polygon"]
    assert (shapes[0].area, shapes[1].area) == (50, 70) and shapes[2].is_empty
    with pytest.raises(incircle.ChoiceError, match="give voronoi a clip"):
        incircle.voronoi(SQUARE).to_shapely()


@pytest.mark.parametrize(
    ("clip", "sentence"),
    [
        ((0, 0, 0, 4), "clip"),
        ([(0, 0), (4, 4), (4, 0), (0, 4)], "cross"),
        ([(0, 0), (1, 1), (2, 2)], "clip"),
        ((0, 0, 4), r"the clip has the shape \(3,\)"),
        ([(0, 0), (4, 4)], r"the clip has the shape \(2, 2\)"),
        (np.zeros((4, 3)), r"the clip has the shape \(4, 3\)"),
        ("all", r"the clip has the shape \(\)"),
        (4, r"the clip has the shape \(\)"),
        ([(0, 0), (1,), (2, 2)], "the clip is no array of two columns"),
        ((0, 0, 4.5, 4), "the x of corner 1 is 4.5, which int64 cannot hold"),
        (np.array((0, 0, 2**63, 4), dtype=np.uint64), "the x of corner 1 is 9223372036854775808, which int64"),
        (np.ma.masked_all(4), "the corners of the clip are a masked array"),
    ],
)
def test_bad_clips_are_refused(clip, sentence):
    for call in (incircle.voronoi, lambda points, clip: incircle.lloyd(points, 1, clip=clip)):
        with pytest.raises(incircle.InputError, match=sentence):
            call(SQUARE, clip=clip)


@pytest.mark.parametrize("value", [NAN, INF, -INF])
def test_values_that_are_not_finite_are_refused(value):
    for call in (incircle.voronoi, lambda points, clip=None: incircle.lloyd(points, 1, clip=clip)):
        with pytest.raises(incircle.InputError, match="the y of point 1 is .*, which is not a finite number"):
            call([(0.0, 0.0), (1.0, value), (3.0, 3.0)])
        with pytest.raises(incircle.InputError, match="the x of corner 0 is .*, which is not a finite number"):
            call([(0.0, 0.0), (3.0, 3.0)], clip=(value, 0.0, 4.0, 4.0))


@pytest.mark.parametrize("points", [np.zeros((3, 3)), [1, 2], 5, [(1, 2), (3,)], np.ma.masked_all((3, 2))])
def test_bad_shapes_are_refused(points):
    for call in (incircle.voronoi, lambda points: incircle.lloyd(points, 1)):
        with pytest.raises(incircle.InputError):
            call(points)


@pytest.mark.parametrize("points", [np.zeros((3, 2), complex), np.array([("1", "2")]), np.zeros((2, 2), bool)])
def test_types_that_are_no_numbers_are_refused(points):
    for call in (incircle.voronoi, lambda points: incircle.lloyd(points, 1)):
        with pytest.raises(incircle.NumberTypeError):
            call(points)


def test_read_only_and_strided_points_are_taken():
    wide = np.zeros((10, 4), dtype=np.int32)
    wide[::2, ::2] = SQUARE
    wide.flags.writeable = False
    assert incircle.voronoi(wide[::2, ::2], clip=BOX).cells.areas.tolist() == [2, 2, 2, 2, 8]
    assert incircle.lloyd(wide[::2, ::2], 1).points.shape == (5, 2)


def test_a_step_moves_points_to_the_centroids_of_their_cells():
    points = np.random.default_rng(6).integers(0, 2**12, (200, 2))
    box = (0, 0, 2**12, 2**12)
    cells = incircle.voronoi(points, clip=box).cells
    moved = incircle.lloyd(points, 1, clip=box)
    assert (moved.iterations, moved.end) == (1, "iterations") and moved.moved > 190
    for point in range(200):
        (piece,) = cells.pieces(point)
        np.testing.assert_allclose(moved.points[point], centroid(piece), atol=2.0**-7)


def test_threads_and_steps_in_parts_change_nothing():
    points = np.random.default_rng(7).integers(0, 2**20, (10_000, 2))
    one = incircle.lloyd(points, 3, threads=1)
    np.testing.assert_array_equal(incircle.lloyd(points, 3, threads=3).points, one.points)
    np.testing.assert_array_equal(incircle.lloyd(points[::-1], 3).points[::-1], one.points)


def test_a_relaxation_ends_when_no_point_moves():
    still = incircle.lloyd([(1, 1), (2, 9), (9, 5)], until_still=True, clip=(0, 0, 10, 10))
    assert still.end == "still" and still.moved == 0
    again = incircle.lloyd([(5, 5), (5, 5)], 9, until_still=True, clip=(0, 0, 10, 10))
    assert again.points.tolist() == [[5, 5], [5, 5]] and again.iterations == 1
    assert incircle.lloyd([], 5, clip=BOX).points.shape == (0, 2)


@pytest.mark.parametrize(
    ("choices", "sentence"),
    [
        ({}, "a relaxation needs an end"),
        ({"iterations": 0}, "0 iterations are not possible: choose 1 to 4294967295"),
        ({"iterations": 2**32}, "4294967296 iterations"),
        ({"iterations": 1, "threads": 0}, "0 threads are not possible"),
        ({"iterations": 1, "quantize": "yes"}, "quantize is 'yes': give 'fit', or leave it out"),
    ],
)
def test_bad_choices_of_a_relaxation_are_refused(choices, sentence):
    with pytest.raises(incircle.ChoiceError, match=sentence):
        incircle.lloyd(SQUARE, **choices)
    with pytest.raises(TypeError):
        incircle.lloyd(SQUARE, 1.5)


def test_a_relaxation_needs_spare_bits_and_a_region():
    with pytest.raises(incircle.InputError, match="need 24 bits on their lattice, but 23 are possible: quantise"):
        incircle.lloyd([(0, 0), (2**24 - 1, 5)], 1)
    relaxed = incircle.lloyd([(0, 0), (2**24 - 1, 5)], 1, quantize="fit")
    assert relaxed.largest_error > 0
    with pytest.raises(incircle.InputError, match="has no area: give a clip"):
        incircle.lloyd([(0, 0), (5, 0)], 1)
    with pytest.raises(incircle.InputError, match="has no area: give a clip"):
        incircle.voronoi([(0, 0), (5, 0)], clip="box")
