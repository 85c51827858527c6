"""No call keeps memory: the memory of the process and the references to objects stay as they were."""

import gc
import os
import sys
import tracemalloc

import numpy as np
import pytest

import incircle

POINTS = np.random.default_rng(1).random((2_000, 2))
WHOLE = (POINTS * 2**20).astype(int)
ROUNDS = 300
MOST_GROWTH = 8 << 20
"""Every call makes at least 100 kB of arrays, so that 300 calls which kept them would take 30 MB."""


def resident():
    """The bytes of memory that the process has."""
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGESIZE")


class Refused(Exception):
    pass


def refuse(stage, done, total):
    if stage == "assemble":
        raise Refused(bytes(100_000))


def lives():
    mesh = incircle.Triangulation(POINTS)
    mesh.move_all(POINTS[::-1])
    mesh.locate_all(POINTS)
    mesh.nearest_all(POINTS)
    mesh.delete_all(mesh.indices[::2])
    mesh.mesh()


CALLS = {
    "mesh": lambda: incircle.triangulate(POINTS),
    "adjacency": lambda: (incircle.triangulate(POINTS).neighbors, incircle.triangulate(POINTS).halfedges),
    "call-back": lambda: incircle.triangulate(POINTS, progress=lambda *_: None),
    "call-back that raises": lambda: pytest.raises(Refused, incircle.triangulate, POINTS, progress=refuse),
    "cancelled": lambda: pytest.raises(incircle.Cancelled, incircle.triangulate, POINTS, progress=lambda *_: False),
    "refused": lambda: pytest.raises(incircle.InputError, incircle.triangulate, POINTS * np.nan),
    "fleet": lambda: incircle.triangulate(POINTS * 0 + [[1, 2]], backend=["cpu?threads=1", "cpu?threads=1"]),
    "lives": lives,
    "svg": lambda: incircle.triangulate(POINTS)._repr_svg_(),
    "constraints": lambda: incircle.triangulate(POINTS, constraints=[(0, 1)], regions=POINTS[5:6]),
    "cells": lambda: incircle.voronoi(WHOLE, clip="box"),
    "relaxation": lambda: incircle.lloyd(WHOLE, 1, threads=1),
    "surface": lambda: incircle.Surface(POINTS, POINTS[:, 0]).contours(0.5),
    "verify": lambda: incircle.triangulate(POINTS).verify(),
}


@pytest.mark.skipif(not os.path.exists("/proc/self/statm"), reason="the memory of the process is read from Linux")
@pytest.mark.parametrize("name", CALLS)
def test_memory_does_not_grow(name):
    call, rounds = CALLS[name], ROUNDS if name not in ("svg", "lives", "cells") else ROUNDS // 3
    for _ in range(30):
        call()
    gc.collect()
    before, objects = resident(), len(gc.get_objects())
    for _ in range(rounds):
        call()
    gc.collect()
    assert resident() - before < MOST_GROWTH
    assert len(gc.get_objects()) - objects < 50


def test_python_keeps_no_object():
    CALLS["call-back that raises"]()
    gc.collect()
    tracemalloc.start()
    before = tracemalloc.get_traced_memory()[0]
    for _ in range(100):
        CALLS["call-back that raises"]()
        CALLS["mesh"]()
    gc.collect()
    grown = tracemalloc.get_traced_memory()[0] - before
    tracemalloc.stop()
    assert grown < 100_000


def test_references_are_given_back():
    points, listener = POINTS.copy(), lambda *_: None
    before = sys.getrefcount(points), sys.getrefcount(listener), sys.getrefcount(refuse)
    for _ in range(20):
        incircle.triangulate(points, progress=listener)
        pytest.raises(Refused, incircle.triangulate, points, progress=refuse)
        incircle.Triangulation(points)
    gc.collect()
    assert (sys.getrefcount(points), sys.getrefcount(listener), sys.getrefcount(refuse)) == before


def test_arrays_outlive_their_mesh():
    triangles = incircle.triangulate(POINTS).triangles
    expected = triangles.copy()
    gc.collect()
    [incircle.triangulate(POINTS[::-1]) for _ in range(20)]
    np.testing.assert_array_equal(triangles, expected)
