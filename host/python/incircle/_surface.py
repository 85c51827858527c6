"""Values between points: linear on the triangles, or by natural neighbours."""

from __future__ import annotations

from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._cells import check_threads
from ._errors import ChoiceError
from ._input import as_type, as_values, check_finite

METHODS = ("linear", "laplace", "sibson")
OUTSIDE = ("nan", "nearest")


class Surface:
    """Points with a value each, made ready for values elsewhere.

    >>> import incircle
    >>> surface = incircle.Surface([(0, 0), (4, 0), (4, 4), (0, 4)], [0, 4, 8, 4])
    >>> surface([(3, 1), (9, 9)]).tolist()
    [4.0, nan]
    >>> surface([(9, 9)], outside="nearest").tolist()
    [8.0]
    >>> [(line.tolist(), closed) for line, closed in surface.contours(2)]
    [([[0.0, 2.0], [1.0, 1.0], [2.0, 0.0]], False)]

    Places are found exactly. A value comes from a fixed sequence of operations on doubles, so it is the same on every
    machine, for any order of the places and any number of threads. At a point of the set every method gives its value,
    and values of a linear function are given back except for rounding.

    Parameters
    ----------
    points
        Points as for `triangulate`, taken as float64; integers that float64 cannot hold are refused. Of duplicates, the
        lowest index has the value.
    values
        A finite number for each point, taken as float64.

    Raises
    ------
    InputError
        Points as for `triangulate`, no triangle between them, or values that are missing, too many or not finite.
    NumberTypeError
        Points or values that are no real numbers.
    """

    def __init__(self, points: Any, values: Any) -> None:
        array = check_finite(as_type(points, np.dtype("float64")))
        heights = as_values(values, len(array))
        self._surface = _native.Surface(array, heights)

    def __call__(
        self, at: Any, method: str = "linear", outside: str = "nan", threads: int | None = None
    ) -> NDArray[np.float64]:
        """The values at places, in their order.

        Parameters
        ----------
        at
            The places: an array of the two columns x and y.
        method
            `"linear"`: the plane through the corners of the triangle. `"laplace"` and `"sibson"`: the mean of the
            natural neighbours, weighted by lengths of edges over distances, or by areas.
        outside
            What is outside the hull: `"nan"`, or `"nearest"` for the value of the nearest point.
        threads
            The most threads, 1 to 256. `None` allows one for each processor.

        Raises
        ------
        InputError
            Places of another shape.
        ChoiceError
            An unknown method or value of `outside`, or an impossible number of threads.
        """
        for name, choice, choices in (("the method", method, METHODS), ("outside", outside, OUTSIDE)):
            if not isinstance(choice, str) or choice not in choices:
                raise ChoiceError(f"{name} is {choice!r}: choose one of {', '.join(choices)}")
        places = as_type(at, np.dtype("float64"), "place")
        return self._surface.values(places, method, outside, check_threads(threads))

    def __copy__(self) -> Surface:
        # A surface never changes, so a copy would be the same.
        return self

    def __deepcopy__(self, memo: Any) -> Surface:
        return self

    def __reduce__(self) -> NoReturn:
        raise TypeError("a Surface cannot be pickled: pickle its points and values, and make it anew")

    def contours(self, level: float) -> list[tuple[NDArray[np.float64], bool]]:
        """The lines of a level on the surface of `"linear"`, with higher ground on their left.

        For each line: the places at which it crosses edges, and whether it is closed. A closed line does not repeat its
        first place. O(n).
        """
        return self._surface.contours(float(level))


def interpolate(
    points: Any,
    values: Any,
    at: Any,
    method: str = "linear",
    outside: str = "nan",
    threads: int | None = None,
) -> NDArray[np.float64]:
    """The values at places between points that have a value each. The call for many sets of places is `Surface`.

    >>> import incircle
    >>> incircle.interpolate([(0, 0), (4, 0), (0, 4)], [0, 8, 0], [(1, 1), (3, 0.5)]).tolist()
    [2.0, 6.0]

    Parameters and exceptions are those of `Surface` and of its call.
    """
    return Surface(points, values)(at, method, outside, threads)
