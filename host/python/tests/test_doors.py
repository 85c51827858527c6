"""The doors to matplotlib, shapely and geopandas, and pictures for notebooks."""

import xml.dom.minidom

import numpy as np
import pytest

import incircle

POINTS = np.random.default_rng(4).random((50, 2))


def test_matplotlib_takes_the_triangles_and_finds_the_same_neighbours():
    pytest.importorskip("matplotlib")
    mesh, found = incircle.triangulate(POINTS), incircle.tri(POINTS)
    np.testing.assert_array_equal(found.triangles, mesh.triangles)
    # Matplotlib has the neighbour across the edge from corner j to corner j + 1, which is opposite corner j + 2.
    np.testing.assert_array_equal(found.neighbors, mesh.neighbors[:, [2, 0, 1]])
    from matplotlib.tri import LinearTriInterpolator

    values = POINTS @ [2.0, 3.0]
    inside = POINTS[mesh.triangles].mean(axis=1)
    np.testing.assert_allclose(LinearTriInterpolator(found, values)(*inside.T), inside @ [2.0, 3.0])
    with pytest.raises(incircle.InputError, match="the 2 distinct points have no triangle"):
        incircle.tri([(0, 0), (1, 1), (1, 1)])


def test_offsets_lose_no_triangle():
    pytest.importorskip("matplotlib")
    grid = np.stack(np.meshgrid(np.arange(40.0), np.arange(40.0)), axis=-1).reshape(-1, 2)
    assert len(incircle.tri(grid + 1e9).triangles) == 2 * 39 * 39


def test_plot_draws_into_axes():
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, ax = pyplot.subplots()
    lines = incircle.triangulate(POINTS).plot(ax, color="black")
    assert lines and all(line in ax.lines for line in lines)
    assert incircle.triangulate([(0, 0), (1, 1)]).plot(ax)
    assert incircle.triangulate(POINTS).plot()
    pyplot.close("all")


@pytest.mark.parametrize(
    "points",
    [
        POINTS,
        [],
        [(1, 1)],
        [(0, 0), (5, 5)],
        [(-1.7e308, 0), (1.7e308, 1), (0, 1.7e308)],
        np.array([(-(2**62), 0)] * 2),
    ],
)
def test_svg_is_well_formed(points):
    text = incircle.triangulate(points)._repr_svg_()
    document = xml.dom.minidom.parseString(text)
    assert document.documentElement.tagName == "svg" and "nan" not in text and "inf" not in text


def test_svg_of_a_large_mesh_says_that_only_the_hull_is_drawn():
    text = incircle.triangulate(np.random.default_rng(4).random((20_000, 2)))._repr_svg_()
    assert "of which the hull is drawn" in text and len(text) < 10_000
    small = incircle.triangulate([(0, 0), (4, 0), (4, 4), (0, 4)])._repr_svg_()
    assert small.count("M") == 5 and "2 triangles</title>" in small


def test_shapely_points_go_in_and_polygons_come_out():
    shapely = pytest.importorskip("shapely")
    expected = incircle.triangulate(POINTS)
    array = shapely.points(POINTS)
    for points in (array, list(array), tuple(array), shapely.MultiPoint(POINTS)):
        mesh = incircle.triangulate(points)
        np.testing.assert_array_equal(mesh.triangles, expected.triangles)
        np.testing.assert_array_equal(mesh.points, POINTS)
    polygons = expected.to_shapely()
    assert shapely.get_type_id(polygons).tolist() == [3] * len(expected.triangles)
    hull = shapely.MultiPoint(POINTS).convex_hull
    assert shapely.area(polygons).sum() == pytest.approx(hull.area)
    assert shapely.is_ccw(shapely.get_exterior_ring(polygons)).all()
    assert incircle.triangulate([(0, 0)]).to_shapely().shape == (0,)


def test_geometries_that_are_no_points_are_refused():
    shapely = pytest.importorskip("shapely")
    line, point = shapely.LineString([(0, 0), (1, 1)]), shapely.Point(0, 0)
    for points, sentence in [
        ([point, line], "geometry 1 is a LineString"),
        ([point, None], "geometry 1 is missing"),
        ([point, shapely.Point()], "geometry 1 is an empty point"),
        (line, "the geometry is a LineString"),
        (shapely.Point(0, 0), "the geometry is a Point: give a MultiPoint"),
        ([shapely.Point(0, 0), shapely.Point(float("nan"), 1)], "geometry 1 is an empty point|which is not a finite"),
    ]:
        with pytest.raises(incircle.InputError, match=sentence):
            incircle.triangulate(points)


def test_geopandas_comes_in_and_goes_out_with_its_reference_system():
    geopandas = pytest.importorskip("geopandas")
    series = geopandas.GeoSeries.from_xy(*POINTS.T, crs="EPSG:2056")
    expected = incircle.triangulate(POINTS)
    for points in (series, geopandas.GeoDataFrame(geometry=series), series.array):
        mesh = incircle.triangulate(points)
        np.testing.assert_array_equal(mesh.triangles, expected.triangles)
        frame = mesh.to_geopandas()
        assert frame.crs == series.crs and len(frame) == len(mesh.triangles)
        np.testing.assert_array_equal(frame[["a", "b", "c"]].to_numpy(), mesh.triangles)
        assert frame.geometry.area.sum() == pytest.approx(series.union_all().convex_hull.area)
    assert expected.to_geopandas().crs is None and expected.to_geopandas(crs="EPSG:4326").crs == "EPSG:4326"
    assert len(incircle.triangulate([(0, 0)]).to_geopandas()) == 0
    with pytest.raises(incircle.InputError, match="geometry 0 is a Polygon"):
        incircle.triangulate(frame)
