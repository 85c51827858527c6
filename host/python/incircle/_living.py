"""The mesh that lives: points come, go and move."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from typing import Any, NamedTuple, NoReturn, Union

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from . import _native
from ._errors import ChoiceError, InputError, NumberTypeError, UnknownPointError
from ._input import NATIVE, as_points, as_type, check_finite, refuse_mask
from ._mesh import Mesh

Place = Union[Sequence[Any], NDArray[Any]]
"""The two coordinates of a place."""

KINDS = ("none", "vertex", "edge", "triangle", "outside")
"""What a place can be, by the numbers of `Triangulation.locate_all`."""


class Location(NamedTuple):
    """The kind of a place, and the vertices there.

    `kind` is `"vertex"`, `"edge"`, `"triangle"`, `"outside"` or `"none"`. The vertices of a triangle are
    counter-clockwise, the smallest index first. Outside the hull they are the first hull edge, counter-clockwise, that
    is visible from the place. The kind is `"none"` if there are no triangles and the place lies on no edge.
    """

    kind: str
    vertices: tuple[int, ...]


def _two(place: Place) -> tuple[Any, Any]:
    """The coordinates of one place."""
    try:
        x, y = place
    except (TypeError, ValueError):
        raise InputError(f"the place is {place!r}: give two coordinates, x and y") from None
    return x, y


def _listed(indices: Any) -> list[Any]:
    """Indices of any container as a list. Whether each is one of a point is not checked."""
    if isinstance(indices, np.ma.MaskedArray):
        refuse_mask("indices", indices, "indices")
    try:
        array = np.asarray(indices)
    except ValueError as error:
        raise InputError(f"the indices are no array, because numpy says: {error}") from error
    # Integers that are too long for numpy are objects, and each is checked by itself.
    if array.size and array.dtype.kind not in "iuO":
        raise NumberTypeError(f"the indices have the type {array.dtype}: give whole numbers")
    listed: list[Any] = array.ravel().tolist()
    return listed


class Triangulation:
    """A Delaunay triangulation that can be asked and changed, and stays canonical.

    >>> import incircle
    >>> mesh = incircle.Triangulation([(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)])
    >>> mesh.locate((3.0, 1.0))
    Location(kind='triangle', vertices=(0, 1, 2))
    >>> middle = mesh.insert((2.0, 1.0))
    >>> mesh.neighbors(middle).tolist()
    [0, 1, 2, 3]
    >>> mesh.move(middle, (2.5, 1.5))
    >>> mesh.nearest((3.0, 3.0))
    2
    >>> mesh.delete(middle)
    >>> mesh.mesh().triangles.tolist()
    [[0, 1, 2], [0, 2, 3]]

    Each point that is inserted gets an index: 0, 1, 2 and so on. The index stays that of its point until the point is
    deleted, and is never used again. Answers name a place with several points by the lowest of their indices.

    The coordinates have one type of numbers: float64 if the triangulation begins empty, else the type of the first
    points, unless `dtype` names one of float64, float32, int64, int32 and uint32. Every number must be one that the
    type holds exactly, so a triangulation of float32 refuses the double 0.1. A change that is refused changes nothing.
    """

    __slots__ = ("_living", "_dtype")

    def __init__(self, points: Any = None, *, dtype: DTypeLike | None = None) -> None:
        if dtype is not None and np.dtype(dtype) not in NATIVE:
            raise ChoiceError(f"the type {np.dtype(dtype)} is not one of float64, float32, int64, int32 and uint32")
        if points is None:
            array = np.empty((0, 2), dtype=dtype)
        else:
            array = as_points(points) if dtype is None else as_type(points, np.dtype(dtype))
        self._dtype = array.dtype
        self._living = _native.Living(check_finite(array))

    @property
    def dtype(self) -> np.dtype[Any]:
        """The type of numbers of the coordinates."""
        return self._dtype

    def copy(self) -> Triangulation:
        """A triangulation of its own with the same points and indices."""
        copy = object.__new__(type(self))
        copy._dtype = self._dtype
        copy._living = self._living.copy()
        return copy

    __copy__ = copy

    def __deepcopy__(self, memo: Any) -> Triangulation:
        return self.copy()

    def __reduce__(self) -> NoReturn:
        raise TypeError("a Triangulation cannot be pickled: pickle its points, and its indices if they matter")

    def _array(self, points: Any) -> NDArray[Any]:
        return as_type(points, self._dtype)

    def _index(self, index: Any) -> int:
        number = operator.index(index)
        if not 0 <= number < 2**32:
            raise UnknownPointError(
                f"there is no point {number}: so far the indices are those below {self._living.next_index}"
            )
        return number

    # Changes

    def insert(self, point: Place) -> int:
        """Inserts a point and returns its index. A point at the place of a living one is a duplicate, and no error.

        Raises
        ------
        InputError
            A coordinate is NaN or infinite, or a number that the type does not hold.
        CapacityError
            There are as many points or indices as there can be.
        """
        return self._living.insert(*_two(point))

    def insert_all(self, points: Any) -> NDArray[np.uint32]:
        """Inserts many points, one after the other, and returns their indices.

        Points along a curve are the quickest. If Ctrl-C comes, the points that were inserted stay.
        """
        return self._living.insert_all(check_finite(self._array(points)))

    def delete(self, index: int) -> None:
        """Deletes a point. Other points at its place stay.

        Raises
        ------
        UnknownPointError
            No living point has the index.
        """
        self._living.delete(self._index(index))

    def delete_all(self, indices: ArrayLike) -> None:
        """Deletes many points, one after the other. All indices must be living, and none may be there twice.

        Raises
        ------
        UnknownPointError
            No living point has one of the indices.
        InputError
            An index is there twice, or the indices are no array or a masked one.
        NumberTypeError
            The indices are no whole numbers. So a mask of booleans, which names no indices, is refused.
        """
        numbers = [self._index(index) for index in _listed(indices)]
        for number in numbers:
            if self._living.place_of(number) is None:
                self._living.delete(number)
        if len(set(numbers)) < len(numbers):
            raise InputError(f"of the {len(numbers)} indices only {len(set(numbers))} differ: name each point once")
        self._living.delete_all(numbers)

    def move(self, index: int, place: Place) -> None:
        """Moves a point to another place. The point keeps its index.

        Raises
        ------
        UnknownPointError
            No living point has the index.
        InputError
            A coordinate is NaN or infinite, or a number that the type does not hold.
        """
        self._living.move_to(self._index(index), *_two(place))

    def move_all(self, places: Any) -> None:
        """Moves all living points, given a place for each in the order of their indices. Short moves are quick.

        Raises
        ------
        InputError
            There is not one place for each living point, or a coordinate is NaN, infinite or not held by the type.
        """
        self._living.move_all(check_finite(self._array(places)))

    def renumber(self) -> NDArray[np.uint32]:
        """Gives the living points new indices from 0 on, in the same order, and returns the old ones."""
        return self._living.renumber()

    # Questions about places

    def locate(self, place: Place) -> Location:
        """Says what a place is: a vertex, in an edge, in a triangle, or outside the hull."""
        kind, vertices = self._living.locate(*_two(place))
        return Location(KINDS[kind], tuple(vertex for vertex in vertices if vertex >= 0))

    def locate_all(self, places: Any) -> tuple[NDArray[np.uint8], NDArray[np.int64]]:
        """Says what many places are: the kinds as numbers, and three vertices a row, -1 where there are fewer.

        The kinds are 0 for none, 1 for a vertex, 2 for an edge, 3 for a triangle, and 4 for outside.

        >>> import incircle
        >>> mesh = incircle.Triangulation([(0, 0), (4, 0), (0, 4)])
        >>> kinds, vertices = mesh.locate_all([(1, 1), (2, 2), (9, 9)])
        >>> kinds.tolist(), vertices.tolist()
        ([3, 2, 4], [[0, 1, 2], [1, 2, -1], [1, 2, -1]])
        """
        return self._living.locate_all(self._array(places))

    def nearest(self, place: Place) -> int | None:
        """The index of the point nearest to a place; of points at the same distance the one with the smaller x, then y.

        `None` if there are no points.
        """
        return self._living.nearest(*_two(place))

    def nearest_all(self, places: Any) -> NDArray[np.int64]:
        """The index of the point nearest to each of many places; -1 if there are no points."""
        return self._living.nearest_all(self._array(places))

    def k_nearest(self, place: Place, count: int) -> NDArray[np.uint32]:
        """The indices of the `count` places nearest to a place, the nearest first."""
        number = operator.index(count)
        if number < 0:
            raise ChoiceError(f"{number} points cannot be the nearest: choose 0 or more")
        return self._living.k_nearest(*_two(place), min(number, len(self)))

    def within_circle(self, center: Place, radius: float) -> NDArray[np.uint32]:
        """The indices of the places at most `radius` from a place, in rising order. No distance is rounded."""
        return self._living.within_circle(*_two(center), float(radius))

    def within_rectangle(self, corner: Place, opposite: Place) -> NDArray[np.uint32]:
        """The indices of the places in a rectangle or on its border, in rising order."""
        return self._living.within_rectangle(self._array([_two(corner), _two(opposite)]))

    def segment(self, start: Place, end: Place) -> NDArray[np.uint32]:
        """The triangles whose inside the straight line between two places crosses, in that order."""
        return self._living.segment(self._array([_two(start), _two(end)]))

    # Questions about points

    def point(self, index: int) -> tuple[Any, Any]:
        """The coordinates of a point.

        Raises
        ------
        UnknownPointError
            No living point has the index.
        """
        number = self._index(index)
        point = self._living.point(number)
        if point is None:
            # The same sentence as everywhere: the neighbours of such a point are an error.
            self._living.neighbors(number)
            raise UnknownPointError(f"there is no point {number}")
        return point

    def place_of(self, index: int) -> int:
        """The lowest living index at the place of a point. A point is a duplicate if this is not its own index.

        Raises
        ------
        UnknownPointError
            No living point has the index.
        """
        self.point(index)
        name = self._living.place_of(operator.index(index))
        return operator.index(index) if name is None else name

    def neighbors(self, index: int) -> NDArray[np.uint32]:
        """The vertices that have an edge to the place of a point, counter-clockwise.

        Raises
        ------
        UnknownPointError
            No living point has the index.
        """
        return self._living.neighbors(self._index(index))

    def star(self, index: int) -> NDArray[np.uint32]:
        """The triangles around the place of a point, counter-clockwise, each with the place first.

        Raises
        ------
        UnknownPointError
            No living point has the index.
        """
        return self._living.star(self._index(index))

    def __contains__(self, index: object) -> bool:
        """Whether a living point has the index."""
        if not isinstance(index, (int, np.integer)):
            return False
        number = int(index)
        return 0 <= number < 2**32 and self._living.place_of(number) is not None

    # The whole

    def __len__(self) -> int:
        """The number of living points, duplicates included."""
        return len(self._living)

    @property
    def points(self) -> NDArray[Any]:
        """The coordinates of the living points, in the order of their indices. A new array each time."""
        return self._living.points()

    @property
    def indices(self) -> NDArray[np.uint32]:
        """The indices of the living points, duplicates included, in rising order."""
        return self._living.indices()

    @property
    def vertices(self) -> NDArray[np.uint32]:
        """The places that have points, each by the lowest index there, in no order that is promised."""
        return self._living.vertices()

    @property
    def triangles(self) -> NDArray[np.uint32]:
        """All triangles, counter-clockwise with the smallest index first, in no order that is promised."""
        return self._living.triangles()

    @property
    def edges(self) -> NDArray[np.uint32]:
        """All edges, each with its smaller index first, in no order that is promised."""
        return self._living.edges()

    @property
    def hull(self) -> NDArray[np.uint32]:
        """The vertices of the hull, counter-clockwise, the smallest index first."""
        return self._living.hull()

    @property
    def next_index(self) -> int:
        """The index that the next point will have."""
        return self._living.next_index

    @property
    def nbytes(self) -> int:
        """The bytes of memory that the triangulation takes, without the few that duplicates take."""
        return self._living.bytes

    def mesh(self) -> Mesh:
        """The canonical mesh of the living points, the same as `triangulate` gives for `points`.

        Indices in the mesh count the living points: row `k` of the mesh's points has the index `indices[k]`.
        """
        points, triangles, hull, duplicates = self._living.mesh()
        return Mesh(points, triangles, hull, duplicates)

    def __repr__(self) -> str:
        return f"Triangulation({len(self)} points of {self._dtype})"
