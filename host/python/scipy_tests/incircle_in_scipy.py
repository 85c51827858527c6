"""A plug-in of pytest that runs SciPy's own tests with `incircle.Delaunay` in the place of `scipy.spatial.Delaunay`.

SciPy's tests make triangulations through the module `scipy.spatial._qhull`, and so do the interpolators, so the class
is exchanged there. Tests of other classes and of other dimensions are left out. The tests that cannot pass are listed
with their reasons; one of them that passes is a failure, too.
"""

import re

import numpy as np
import pytest
from scipy.spatial import _qhull

import incircle

SCIPY = _qhull.Delaunay

CLASSES = ("TestUtilities", "TestVertexNeighborVertices", "TestDelaunay")
"""The classes of `test_qhull.py` that test `Delaunay`. Of `test_interpnd.py` all are run."""

OTHERS = ("test_volume_area", "test_random_volume_area", "test_incremental_volume_area_random_input")
"""Tests in these classes that test `ConvexHull` in three dimensions."""

NUMBERING = "expects Qhull's order of triangles, first corners and edges, and its diagonal of a square"
CANNOT_PASS = {
    "TestUtilities::test_find_simplex": NUMBERING,
    "TestUtilities::test_convex_hull": NUMBERING,
    "TestDelaunay::test_2d_square": NUMBERING,
    "TestLinearNDInterpolation::test_square": "expects the other diagonal of a square, whose corners lie on one circle",
    "TestUtilities::test_degenerate_barycentric_transforms":
        "expects fewer than 23 triangles that are too thin for SciPy's doubles: of the exact mesh there are 31, and "
        "Qhull's mesh has 22, some of them with negative area",
    "TestDelaunay::test_joggle": "expects each of two equal points to be a corner: QJ is refused with duplicates",
    "TestDelaunay::test_furthest_site": "needs the furthest-site triangulation, which incircle refuses",
}


LEAST = 50
"""Fewer tests would mean that SciPy's files have changed."""


class Delaunay(incircle.Delaunay):
    """incircle's class for two dimensions. Where a test also uses others, SciPy's own class does these."""

    def __new__(cls, points=None, *args, **options):
        shape = np.shape(points)
        if len(shape) == 2 and shape[1] > 2:
            return SCIPY(points, *args, **options)
        return super().__new__(cls)


_qhull.Delaunay = Delaunay


def is_of_this_class(item):
    """Whether a test is one of `Delaunay`, or of an interpolator on it, in two dimensions."""
    name = item.nodeid.split("::", 1)[1]
    if "test_qhull" in item.nodeid and not name.startswith(CLASSES):
        return False
    dimensions = re.search(r"random-(\d)d", name)
    return item.originalname not in OTHERS and (dimensions is None or dimensions[1] == "2")


def pytest_collection_modifyitems(config, items):
    chosen = [item for item in items if is_of_this_class(item)]
    config.hook.pytest_deselected(items=[item for item in items if item not in chosen])
    items[:] = chosen
    by_name = {item.nodeid.split("::", 1)[1]: item for item in items}
    if len(items) < LEAST:
        raise pytest.UsageError(f"only {len(items)} tests of SciPy were found, where there should be {LEAST} or more")
    for name, reason in CANNOT_PASS.items():
        if name not in by_name:
            raise pytest.UsageError(f"SciPy has no test {name} any more: strike it off the list")
        by_name[name].add_marker(pytest.mark.xfail(reason=reason, strict=True))
