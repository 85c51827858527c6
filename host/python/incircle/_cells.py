"""Voronoi cells of a set of points, and points spread evenly by Lloyd's relaxation."""

from __future__ import annotations

import operator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _native, _shapely
from ._errors import ChoiceError, InputError, UnknownPointError
from ._input import as_points, as_type, check_finite, refuse_mask
from ._triangulate import MAX_THREADS

MOST_STEPS = 100_000
"""The most steps of a relaxation that goes on until no point moves."""


@dataclass(frozen=True, eq=False, repr=False)
class Cells:
    """The cells of a set of points inside a clip, as flat arrays.

    A cell may have no piece, one, or several if the clip is not convex.
    """

    corners: NDArray[np.float64]
    """The corners of all pieces, counter-clockwise, one piece behind the other. Each coordinate is exact up to one
    rounding."""
    starts: NDArray[np.uint64]
    """The corners of piece `k` are `corners[starts[k]:starts[k + 1]]`."""
    points: NDArray[np.uint32]
    """The point to which each piece belongs, in rising order."""
    areas: NDArray[np.float64]
    """The area of the cell of each point inside the clip; 0 for a duplicate."""
    neighbors: NDArray[np.uint32]
    """The points whose cells share an edge inside the clip, one cell behind the other, each in rising order."""
    neighbor_starts: NDArray[np.uint64]
    """The neighbours of point `i` are `neighbors[neighbor_starts[i]:neighbor_starts[i + 1]]`."""

    def pieces(self, point: int) -> list[NDArray[np.float64]]:
        """The pieces of the cell of a point: their corners, counter-clockwise.

        Raises
        ------
        UnknownPointError
            There is no point of the index.
        """
        number = _index(point, len(self.areas))
        first, end = np.searchsorted(self.points, [number, number + 1])
        return [self.corners[self.starts[piece] : self.starts[piece + 1]] for piece in range(first, end)]

    def __repr__(self) -> str:
        return f"Cells({len(self.areas)} points, {len(self.points)} pieces)"


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
            There is no point of the index; so in `neighbors_of`.
        """
        return self.corners[self._edges(point)]

    def neighbors_of(self, point: int) -> NDArray[np.uint32]:
        """The points whose cells share an edge with that of a point, counter-clockwise."""
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
        return _shapely.cells([self.cells.pieces(point) for point in range(len(self.points))])

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


def voronoi(points: Any, clip: Any = None, *, quantize: str | None = None) -> Voronoi:
    """Makes the Voronoi diagram of a set of points, and clips its cells exactly.

    O(n log n). The answer depends on the points alone: where four or more points lie on one empty circle, its centre is
    one vertex, and no edge has length zero.

    Parameters
    ----------
    points
        Points as for `triangulate`. Together with the clip they must lie on a lattice of up to 31 bits, as whole
        numbers, float32 of similar size, and decimals times a power of ten do. Most doubles do not: see `quantize`.
    clip
        `None` for the diagram alone; x0, y0, x1 and y1 of a rectangle; `"box"` for the rectangle around the points; or
        an array of the corners of a simple polygon. Its numbers must fit the type of the points.
    quantize
        `"fit"` rounds points and clip onto a grid of 31 bits, and `largest_error` says by how much.

    Raises
    ------
    InputError
        Points as for `triangulate`, points on no lattice of 31 bits, or a clip without area or that crosses itself.
    ChoiceError
        Another value of `quantize`.
    """
    array = as_points(points)
    corners = _corners(clip, array.dtype)
    made = _native.voronoi(check_finite(array), corners, clip is not None, _is_fitted(quantize))
    clipped = made.pop("clipped")
    return Voronoi(points=array, cells=None if clipped is None else Cells(**clipped), **made)


def lloyd(
    points: Any,
    iterations: int | None = None,
    *,
    until_still: bool = False,
    clip: Any = None,
    threads: int | None = None,
    quantize: str | None = None,
) -> Relaxed:
    """Spreads points evenly: each step moves every point to the centroid of its Voronoi cell inside the clip.

    The places are the same bytes on every machine and with any number of threads.

    >>> import incircle
    >>> relaxed = incircle.lloyd([(1, 1), (2, 9), (9, 5)], until_still=True, clip=(0, 0, 10, 10))
    >>> relaxed.end, relaxed.points.round(3).tolist()
    ('still', [[3.173, 2.316], [3.173, 7.684], [8.038, 5.0]])

    Parameters
    ----------
    points
        Points as for `triangulate`. Together with the clip they must lie on a lattice of up to 23 bits; see `quantize`.
    iterations
        The most steps: 1 to 4,294,967,295. `None` needs `until_still`, and stands for 100,000.
    until_still
        Ends also when no point moves, or when a state comes again.
    clip
        The region to fill, as for `voronoi`; `None` stands for the rectangle around the points.
    threads
        The most threads, 1 to 256. `None` allows one for each processor.
    quantize
        `"fit"` rounds points and clip onto a grid of 23 bits first.

    Raises
    ------
    InputError
        As for `voronoi`.
    ChoiceError
        Neither `iterations` nor `until_still`, an impossible number, or another value of `quantize`.
    """
    steps = MOST_STEPS if iterations is None else operator.index(iterations)
    if iterations is None and not until_still:
        raise ChoiceError("a relaxation needs an end: give iterations, until_still=True, or both")
    if not 1 <= steps < 2**32:
        raise ChoiceError(f"{steps} iterations are not possible: choose 1 to {2**32 - 1}")
    array = as_points(points)
    corners = _corners("box" if clip is None else clip, array.dtype)
    stop = (steps, bool(until_still))
    return Relaxed(*_native.spread(check_finite(array), corners, stop, check_threads(threads), _is_fitted(quantize)))


def _index(point: int, count: int) -> int:
    """The index of one of `count` points, checked. A negative one counts from no end."""
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


def _corners(clip: Any, dtype: np.dtype[Any]) -> NDArray[Any]:
    """The corners of a clip in the type of the points: two of a rectangle, three or more of a ring, or none."""
    if clip is None or (isinstance(clip, str) and clip == "box"):
        return np.empty((0, 2), dtype)
    if isinstance(clip, np.ma.MaskedArray):
        refuse_mask("corners of the clip", clip, "coordinates")
    try:
        array = np.asarray(clip)
    except ValueError as error:
        raise InputError(f"the clip is no array of two columns, because numpy says: {error}") from error
    if array.shape == (4,):
        array = array.reshape(2, 2)
    elif array.ndim != 2 or array.shape[1] != 2 or len(array) < 3:
        raise InputError(
            f"the clip has the shape {array.shape}: give x0, y0, x1 and y1, 'box', or three or more corners of a "
            "polygon"
        )
    return check_finite(as_type(array, dtype, "corner"), "corner")
