"""Clips with holes, and densities over a clip."""

import numpy as np
import pytest

import incircle

SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4), (2, 2)]
BOX = (0, 0, 4, 4)
NAN = float("nan")
OUTER = [(0, 0), (20, 0), (20, 10), (0, 10)]
HOLES = [[(2, 2), (4, 2), (4, 4), (2, 4)], [(8, 5), (12, 5), (12, 7), (8, 7)]]


def area(ring):
    x, y = ring[:, 0], ring[:, 1]
    return (x * np.roll(y, -1) - np.roll(x, -1) * y).sum() / 2


@pytest.mark.parametrize("dtype", ["float64", "float32", "int64", "int32", "uint32"])
def test_no_cell_reaches_into_a_hole(dtype):
    points = np.array([(5, 5), (15, 5)], dtype=dtype)
    for clip in (OUTER, OUTER[::-1], (0, 0, 20, 10), np.array(OUTER, dtype=np.int8)):
        diagram = incircle.voronoi(points, clip, holes=HOLES)
        cells = diagram.cells
        assert cells.areas.tolist() == [92, 96] and cells.is_hole.tolist() == [False, True, False]
        assert repr(cells) == "Cells(2 points, 2 pieces)"
        ((piece, hole),), ((other,),) = cells.rings(0), cells.rings(1)
        assert (area(piece), area(hole), area(other)) == (96, -4, 96)
        assert sorted(hole.tolist()) == sorted(map(list, HOLES[0]))
        assert [ring.tolist() for ring in cells.pieces(0)] == [piece.tolist()]
    boxed = incircle.voronoi(np.array([(5, 5), (15, 5), (0, 0), (20, 10)], dtype=dtype), "box", holes=np.array(HOLES))
    assert boxed.cells.areas.sum() == 188


def test_cells_in_a_clip_with_holes_cover_it():
    random = np.random.default_rng(9)
    for _ in range(50):
        points = random.integers(0, 64, (25, 2)) / 16
        x, y, z = (random.integers(8, 24, 3) / 16).tolist()
        holes = [[(x, y), (x + z, y), (x, y + z)], [(3.5, 3), (3.75, 3.5), (3.25, 3.75)]]
        cells = incircle.voronoi(points, BOX, holes=holes).cells
        free = 16 - z * z / 2 - abs(area(np.array(holes[1])))
        assert cells.areas.sum() == pytest.approx(free, abs=1e-12)
        for point in range(25):
            rings = [ring for piece in cells.rings(point) for ring in piece]
            assert sum(map(area, rings)) == pytest.approx(cells.areas[point], abs=1e-12)
            for corners in rings:
                away = ((corners[:, None] - points) ** 2).sum(axis=2)
                assert (away[:, point] <= away.min(axis=1) + 1e-9).all()


def test_polygons_of_shapely_are_clips_with_holes():
    shapely = pytest.importorskip("shapely")
    polygon = shapely.Polygon(OUTER, HOLES)
    diagram = incircle.voronoi([(5, 5), (15, 5)], clip=polygon)
    shapes = diagram.to_shapely()
    assert [shape.area for shape in shapes] == [92, 96] and len(shapes[0].interiors) == 1
    assert shapely.union_all(shapes).equals(polygon)
    moved = incircle.lloyd([(5, 5), (15, 5)], 3, clip=polygon)
    again = incircle.lloyd([(5, 5), (15, 5)], 3, clip=OUTER, holes=HOLES)
    np.testing.assert_array_equal(moved.points, again.points)
    for clip, sentence in (
        (shapely.Point(1, 2), "the clip is a Point: give a polygon with area"),
        (shapely.Polygon(), "the clip is an empty polygon"),
    ):
        with pytest.raises(incircle.InputError, match=sentence):
            incircle.voronoi(SQUARE, clip=clip)


def test_a_relaxation_keeps_out_of_holes():
    hole = [(2, 2), (8, 2), (8, 8), (2, 8)]
    alone = incircle.lloyd([(1, 1), (9, 9)], 1, clip=(0, 0, 10, 10), holes=[hole])
    # Both halves of the frame, seen along the diagonal.
    assert alone.points[0].sum() + alone.points[1].sum() == pytest.approx(20, abs=0.02)
    assert alone.points[0].sum() < incircle.lloyd([(1, 1), (9, 9)], 1, clip=(0, 0, 10, 10)).points[0].sum()


@pytest.mark.parametrize(
    ("holes", "sentence"),
    [
        ([[(30, 30), (40, 30), (30, 40)]], "hole"),
        ([HOLES[0], HOLES[0]], "cross|meet|common|hole"),
        ([[(2, 2), (30, 2), (2, 4)]], "cross|meet"),
        ([[(2, 2), (3, 2)]], r"hole 0 has the shape \(2, 2\): give three or more corners"),
        ([HOLES[0], [(2, 5), (3, 5), (NAN, 6)]], "hole 1's corner 2 is nan|the x of hole 1's corner 2"),
        ([[(2, 5), (3.5, 5), (2, 6)]], "the x of hole 0's corner 1 is 3.5, which int64 cannot hold"),
        ([[(2, 5), (3,), (2, 6)]], "the hole 0 is no array of two columns"),
        ([np.ma.masked_all((3, 2))], "the corners of the hole 0 are a masked array"),
        (7, "the holes are 7: give a list"),
        ({"first": HOLES[0]}, "the holes are {'first'"),
        (np.array(5), "the holes are array"),
    ],
)
def test_bad_holes_are_refused(holes, sentence):
    for call in (incircle.voronoi, lambda points, clip, holes: incircle.lloyd(points, 1, clip=clip, holes=holes)):
        with pytest.raises(incircle.InputError, match=sentence):
            call(SQUARE, OUTER, holes=holes)
    with pytest.raises(incircle.ChoiceError, match="there are holes, but no clip"):
        incircle.voronoi(SQUARE, holes=HOLES)


@pytest.mark.parametrize("dtype", [np.uint8, np.int64, np.uint16, bool])
def test_points_gather_where_the_density_is_high(dtype):
    box = (0, 0, 100, 100)
    # Row 0 is the uppermost one.
    upper = np.array([[1], [0]], dtype=dtype)
    assert incircle.lloyd([(10, 10)], 1, clip=box, density=upper).points.tolist() == [[50, 75]]
    assert incircle.lloyd([(10, 10)], 1, clip=box, density=upper.T).points.tolist() == [[25, 50]]


def test_a_density_counts_only_by_its_ratios_and_not_by_threads():
    random = np.random.default_rng(10)
    points = random.integers(0, 2**16, (3_000, 2))
    weights = random.integers(0, 2**8, (40, 30))
    one = incircle.lloyd(points, 4, density=weights, threads=1)
    wide = np.zeros((80, 60), dtype=np.int32)
    wide[::2, ::2] = weights
    for same in (weights.astype(np.uint16), wide[::2, ::2], weights * 257):
        np.testing.assert_array_equal(incircle.lloyd(points, 4, density=same, threads=3).points, one.points)
    plain, even = incircle.lloyd(points, 4), incircle.lloyd(points, 4, density=np.full((9, 5), 3))
    np.testing.assert_allclose(even.points, plain.points, atol=1)
    assert not np.array_equal(one.points, plain.points)


def test_a_step_with_a_density_is_the_centre_of_mass():
    density = np.random.default_rng(11).integers(0, 65536, (6, 8))
    (place,) = incircle.lloyd([(3, 3)], 1, clip=(0, 0, 80, 60), density=density).points
    columns, rows = np.arange(8) * 10 + 5, 60 - (np.arange(6) * 10 + 5)
    expected = [(density.sum(axis=0) * columns).sum(), (density.sum(axis=1) * rows).sum()] / density.sum()
    np.testing.assert_allclose(place, expected, atol=2.0**-16)


@pytest.mark.parametrize(
    ("density", "error", "sentence"),
    [
        ([1, 2], "InputError", r"the density has the shape \(2,\): give an array of two dimensions"),
        (np.zeros((0, 4), dtype=int), "InputError", r"the density has the shape \(0, 4\)"),
        (np.zeros((2, 3, 4), dtype=int), "InputError", r"the density has the shape \(2, 3, 4\)"),
        ([[1, 2], [3]], "InputError", "the density is no array"),
        ([[0, 0], [0, 0]], "InputError", "all pixels of the image weigh nothing"),
        ([[1, 2], [3, -1]], "InputError", "the weight in row 1 and column 1 of the density is -1: give 0 to 65535"),
        ([[1, 65536]], "InputError", "the weight in row 0 and column 1 of the density is 65536"),
        ([[0.5, 1.0]], "NumberTypeError", "the density has the type float64: give whole numbers"),
        (np.ma.masked_all((2, 2), dtype=int), "InputError", "the density is a masked array"),
    ],
)
def test_bad_densities_are_refused(density, error, sentence):
    with pytest.raises(getattr(incircle, error), match=sentence):
        incircle.lloyd(SQUARE, 1, density=density)
