"""Voronoi cells of a set of points, and points spread evenly by Lloyd's relaxation."""

from __future__ import annotations

import operator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _native, _shapely
from ._clip import border
from ._errors import ChoiceError, UnknownPointError
from ._input import as_points, as_weights, check_finite
from ._triangulate import MAX_THREADS

MOST_STEPS = 100_000
"""The most steps of a relaxation that goes on until no point moves."""


@dataclass(frozen=True, eq=False, repr=False)
class Cells:
    """The cells of a set of points inside a clip, as flat arrays of rings.

    A cell may have no piece, one, or several if the clip is not convex. Each piece is one ring around it, and a ring
    for each hole of the clip that lies inside it.
    """

    corners: NDArray[np.float64]
    """The corners of all rings, one ring behind the other: counter-clockwise around a piece, clockwise around a hole.
    Each coordinate is exact up to one rounding."""
    starts: NDArray[np.uint64]
    """The corners of ring `k` are `corners[starts[k]:starts[k + 1]]`."""
    points: NDArray[np.uint32]
    """The point to which each ring belongs, in rising order."""
    is_hole: NDArray[np.bool_]
    """Whether each ring bounds a hole of the last piece before it."""
    areas: NDArray[np.float64]
    """The area of the cell of each point inside the clip; 0 for a duplicate."""
    neighbors: NDArray[np.uint32]
    """The points whose cells share an edge inside the clip, one cell behind the other, each in rising order."""
    neighbor_starts: NDArray[np.uint64]
    """The neighbours of point `i` are `neighbors[neighbor_starts[i]:neighbor_starts[i + 1]]`."""

    def pieces(self, point: int) -> list[NDArray[np.float64]]:
        """The pieces of the cell of a point: the corners of the ring around each, counter-clockwise.

        Raises
        ------
        UnknownPointError
            There is no point of the index.
        """
        return [rings[0] for rings in self.rings(point)]

    def rings(self, point: int) -> list[list[NDArray[np.float64]]]:
        """The pieces of the cell of a point with their holes, in the form of the coordinates of GeoJSON.

        Each piece is a list of rings: that around it, counter-clockwise, and those of its holes, clockwise. The first
        corner of a ring is not repeated at its end.

        >>> import incircle
        >>> clip, hole = [(0, 0), (9, 0), (9, 9), (0, 9)], [(1, 1), (3, 1), (1, 3)]
        >>> cells = incircle.voronoi([(5, 5)], clip, holes=[hole]).cells
        >>> [ring.tolist() for ring in cells.rings(0)[0]]
        [[[0.0, 0.0], [9.0, 0.0], [9.0, 9.0], [0.0, 9.0]], [[1.0, 3.0], [3.0, 1.0], [1.0, 1.0]]]
        >>> cells.areas.tolist()
        [79.0]

        Raises
        ------
        UnknownPointError
            There is no point of the index.
        """
        number = _index(point, len(self.areas))
        first, end = np.searchsorted(self.points, [number, number + 1])
        pieces: list[list[NDArray[np.float64]]] = []
        for ring in range(first, end):
            corners = self.corners[self.starts[ring] : self.starts[ring + 1]]
            if self.is_hole[ring]:
                pieces[-1].append(corners)
            else:
                pieces.append([corners])
        return pieces

    def __repr__(self) -> str:
        pieces = len(self.points) - np.count_nonzero(self.is_hole)
        return f"Cells({len(self.areas)} points, {pieces} pieces)"


@dataclass(frozen=True, eq=False, repr=False)
class Voronoi:
    """The Voronoi diagram of the distinct points of a set, as flat arrays.

    >>> import incircle
    >>> diagram = incircle.voronoi([(0, 0), (4, 0), (4, 4), (0, 4), (2, 2)], clip=(0, 0, 4, 4))
    >>> diagram.vertices[diagram.cell(4)].tolist()
    [[0.0, 2.0], [2.0, 0.0], [4.0, 2.0], [2.0, 4.0]]
    >>> diagram.neighbors_of(4).tolist()
    [0, 1, 2, 3]
    >>> diagram.cells.areas.tolist()
    [2.0, 2.0, 2.0, 2.0, 8.0]
    """

    points: NDArray[Any]
    """The input points in their order, in the type of numbers in which they were taken."""
    vertices: NDArray[np.float64]
    """The Voronoi vertices, all at different places: each coordinate is the double nearest to the exact one."""
    starts: NDArray[np.uint64]
    """The edges of the cell of point `i` are those from `starts[i]` to `starts[i + 1]`; a duplicate has none."""
    neighbors: NDArray[np.uint32]
    """The point on the other side of each edge, counter-clockwise around each cell."""
    corners: NDArray[np.int64]
    """The Voronoi vertex at which each edge begins; -1 if it comes from infinity."""
    duplicates: NDArray[np.uint32]
    """For each point with the coordinates of an earlier one: its index, and the lowest index of that place."""
    largest_error: float | None
    """The farthest that `quantize` moved a point along an axis; `None` if nothing was rounded."""
    cells: Cells | None
    """The cells inside the clip, if one was given."""

    def cell(self, point: int) -> NDArray[np.int64]:
        """The Voronoi vertices of a cell, counter-clockwise; -1 stands for infinity.

        Raises
        ------
        UnknownPointError
            There is no point of the index.
        """
        return self.corners[self._edges(point)]

    def neighbors_of(self, point: int) -> NDArray[np.uint32]:
        """The points whose cells share an edge with that of a point, counter-clockwise.

        Raises
        ------
        UnknownPointError
            There is no point of the index.
        """
        return self.neighbors[self._edges(point)]

    def _edges(self, point: int) -> slice:
        number = _index(point, len(self.points))
        return slice(int(self.starts[number]), int(self.starts[number + 1]))

    def to_shapely(self) -> NDArray[Any]:
        """The cells inside the clip as an array of polygons of shapely, one for each point. Needs a clip.

        A cell of several pieces is a multipolygon, and a cell without a piece an empty polygon.
        """
        if self.cells is None:
            raise ChoiceError("cells without an end are no polygons: give voronoi a clip")
        return _shapely.cells([self.cells.rings(point) for point in range(len(self.points))])

    def __repr__(self) -> str:
        return (
            f"Voronoi({len(self.points)} points, {len(self.vertices)} vertices, {len(self.duplicates)} duplicates)"
        )


@dataclass(frozen=True, eq=False)
class Relaxed:
    """The result of a relaxation."""

    points: NDArray[np.float64]
    """The places of the points, in the order in which they were given."""
    iterations: int
    """The steps that were done."""
    moved: int
    """The number of points that moved in the last step."""
    end: str
    """The reason why the relaxation ended: `"iterations"`, `"still"`, or `"cycle"` if a state came again."""
    largest_error: float | None
    """The farthest that `quantize` moved a point along an axis at the beginning; `None` if nothing was rounded."""


def voronoi(points: Any, clip: Any = None, *, holes: Any = None, quantize: str | None = None) -> Voronoi:
    """Makes the Voronoi diagram of a set of points, and clips its cells exactly.

    O(n log n). The answer depends on the points alone: where four or more points lie on one empty circle, its centre is
    one vertex, and no edge has length zero.

    Parameters
    ----------
    points
        Points as for `triangulate`. Together with the clip they must lie on a lattice of up to 31 bits, as whole
        numbers, float32 of similar size, and decimals times a power of ten do. Most doubles do not: see `quantize`.
    clip
        `None` for the diagram alone; x0, y0, x1 and y1 of a rectangle; `"box"` for the rectangle around the points; an
        array of the corners of a simple polygon; or a polygon of shapely, which may have holes. Its numbers must fit
        the type of the points.
    holes
        Holes of the clip, into which no cell reaches: a list with an array of three or more corners for each. They lie
        side by side inside the clip, and touch neither it nor one another.
    quantize
        `"fit"` rounds points and clip onto a grid of 31 bits, and `largest_error` says by how much.

    Raises
    ------
    InputError
        Points as for `triangulate`, points on no lattice of 31 bits, a clip without area or that crosses itself, or a
        hole that meets another ring or lies outside the clip.
    ChoiceError
        Another value of `quantize`, or holes without a clip.
    """
    array = as_points(points)
    if clip is None and holes is not None:
        raise ChoiceError("there are holes, but no clip: give a clip around them, or leave them out")
    edge = border(clip, holes, check_finite(array))
    made = _native.voronoi(array, edge, clip is not None, _is_fitted(quantize))
    clipped = made.pop("clipped")
    return Voronoi(points=array, cells=None if clipped is None else Cells(**clipped), **made)


def lloyd(
    points: Any,
    iterations: int | None = None,
    *,
    until_still: bool = False,
    clip: Any = None,
    holes: Any = None,
    density: Any = None,
    threads: int | None = None,
    quantize: str | None = None,
) -> Relaxed:
    """Spreads points evenly: each step moves every point to the centroid of its Voronoi cell inside the clip.

    The places are the same bytes on every machine and with any number of threads.

    >>> import incircle
    >>> relaxed = incircle.lloyd([(1, 1), (2, 9), (9, 5)], until_still=True, clip=(0, 0, 10, 10))
    >>> relaxed.end, relaxed.points.round(3).tolist()
    ('still', [[3.173, 2.316], [3.173, 7.684], [8.038, 5.0]])

    With a `density`, every point moves to the centre of mass of its cell, so points gather where the density is high.
    Here the left half of a rectangle weighs three times as much as the right one:

    >>> incircle.lloyd([(7, 7)], 1, clip=(0, 0, 400, 100), density=[[3, 1]]).points.tolist()
    [[150.0, 50.0]]

    Parameters
    ----------
    points
        Points as for `triangulate`. Together with the clip they must lie on a lattice of up to 23 bits; see `quantize`.
    iterations
        The most steps: 1 to 4,294,967,295. `None` needs `until_still`, and stands for 100,000. A relaxation ends
        earlier if no point moves.
    until_still
        Ends also when a state comes again.
    clip
        The region to fill, as for `voronoi`; `None` stands for the rectangle around the points.
    holes
        Holes of the region, as for `voronoi`.
    density
        The weight of each place: an array of two dimensions with whole numbers from 0 to 65,535, such as the grey
        values of an image. It is stretched over the smallest rectangle around the clip, with row 0 at the largest y as
        in images. For an image in which points are to gather where it is dark, give `255 - image`.
    threads
        The most threads, 1 to 256. `None` allows one for each processor.
    quantize
        `"fit"` rounds points and clip onto a grid of 23 bits first.

    Raises
    ------
    InputError
        As for `voronoi`; a density of another shape, with a weight that is not possible, or without any weight.
    NumberTypeError
        A density of other numbers than whole ones.
    ChoiceError
        Neither `iterations` nor `until_still`, an impossible number, or another value of `quantize`.
    """
    steps = MOST_STEPS if iterations is None else operator.index(iterations)
    if iterations is None and not until_still:
        raise ChoiceError("a relaxation needs an end: give iterations, until_still=True, or both")
    if not 1 <= steps < 2**32:
        raise ChoiceError(f"{steps} iterations are not possible: choose 1 to {2**32 - 1}")
    array = as_points(points)
    edge = border("box" if clip is None else clip, holes, check_finite(array))
    weights = None if density is None else as_weights(density)
    stop = (steps, bool(until_still))
    return Relaxed(*_native.spread(array, edge, stop, check_threads(threads), _is_fitted(quantize), weights))


def _index(point: int, count: int) -> int:
    """The index of one of `count` points, checked. Negative indices are refused: they do not count from the end."""
    number = operator.index(point)
    if not 0 <= number < count:
        raise UnknownPointError(f"there is no point {number}: the set has {count}, which are counted from 0")
    return number


def check_threads(threads: int | None) -> int | None:
    """A number of threads, checked."""
    if threads is None:
        return None
    threads = operator.index(threads)
    if not 1 <= threads <= MAX_THREADS:
        raise ChoiceError(f"{threads} threads are not possible: choose 1 to {MAX_THREADS}")
    return threads


def _is_fitted(quantize: str | None) -> bool:
    if quantize not in (None, "fit"):
        raise ChoiceError(f"quantize is {quantize!r}: give 'fit', or leave it out")
    return quantize is not None
