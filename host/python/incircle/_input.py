"""Points as callers give them, as arrays in one of the five types of numbers that the library takes."""

from __future__ import annotations

from typing import Any, NoReturn

import numpy as np
from numpy.typing import NDArray

from . import _shapely
from ._errors import InputError, NumberTypeError

Points = NDArray[Any]

NATIVE = tuple(np.dtype(name) for name in ("float64", "float32", "int64", "int32", "uint32"))
"""The types that the library takes as they are."""

_WIDER = {"float16": "float32", "int8": "int32", "int16": "int32", "uint8": "uint32", "uint16": "uint32"}
"""Smaller types, and the type that holds all their numbers."""


def as_points(points: Any, item: str = "point") -> Points:
    """An array of two columns in a type that the library takes, with the same numbers. Copies only what it must.

    `item` is what the sentences of errors call a row.
    """
    if isinstance(points, np.ma.MaskedArray):
        refuse_mask(f"{item}s", points, "coordinates")
    coordinates = _shapely.coordinates(points)
    array = _array(points, item) if coordinates is None else coordinates
    if array.shape == (0,):
        array = array.reshape(0, 2)
    if array.ndim != 2 or array.shape[1] != 2:
        raise InputError(f"the {item}s have the shape {array.shape}: give an array of two columns, x and y")
    return np.require(exact(array, item), requirements="A")


def refuse_mask(name: str, array: np.ma.MaskedArray[Any, Any], items: str) -> NoReturn:
    """Raises the error for a masked array, which names what is given and what its items are."""
    masked = int(np.ma.getmaskarray(array).sum())
    raise InputError(
        f"the {name} are a masked array, with {masked} of {array.size} {items} masked: leave masked points out, and "
        "give the rest as a plain array"
    )


def as_values(values: Any, count: int) -> NDArray[np.float64]:
    """A finite value for each of `count` points, as doubles. Numbers that no double holds are rounded."""
    if isinstance(values, np.ma.MaskedArray):
        refuse_mask("values", values, "values")
    try:
        array = np.asarray(values)
    except ValueError as error:
        raise InputError(f"the values are no array, because numpy says: {error}") from error
    if array.shape != (count,):
        raise InputError(f"{count} points have values of the shape {array.shape}: give one value for each point")
    if array.dtype.kind not in "iuf" and count:
        raise NumberTypeError(f"the values have the type {array.dtype}: give floats or whole numbers")
    heights = np.require(array, np.float64, ["C", "A"])
    wrong = np.flatnonzero(~np.isfinite(heights))
    if len(wrong):
        raise InputError(
            f"the value of point {wrong[0]} is {heights[wrong[0]]}, which is not a finite number: remove or correct "
            "the point"
        )
    return heights


def as_weights(density: Any) -> NDArray[np.uint16]:
    """The weights of a density: rows of whole numbers of 16 bits."""
    if isinstance(density, np.ma.MaskedArray):
        raise InputError("the density is a masked array: give a plain array, in which hidden places weigh 0")
    try:
        array = np.asarray(density)
    except ValueError as error:
        raise InputError(f"the density is no array, because numpy says: {error}") from error
    if array.ndim != 2 or array.size == 0:
        raise InputError(f"the density has the shape {array.shape}: give an array of two dimensions, row by row")
    if array.dtype.kind not in "biu":
        raise NumberTypeError(
            f"the density has the type {array.dtype}: give whole numbers from 0 to 65535, such as "
            "numpy.rint(density * (65535 / density.max())).astype(numpy.uint16)"
        )
    wrong = np.argwhere((array < 0) | (array > np.iinfo(np.uint16).max))
    if len(wrong):
        row, column = (int(place) for place in wrong[0])
        raise InputError(
            f"the weight in row {row} and column {column} of the density is {array[row, column]}: give 0 to 65535"
        )
    return np.ascontiguousarray(array, dtype=np.uint16)


def _array(points: Any, item: str) -> NDArray[Any]:
    try:
        return np.asarray(points)
    except ValueError as error:
        raise InputError(f"the {item}s are no array of two columns, because numpy says: {error}") from error


def exact(array: NDArray[Any], item: str = "point") -> NDArray[Any]:
    """The array in a type that the library takes, with the same numbers."""
    dtype = array.dtype.newbyteorder("=")
    if dtype in NATIVE:
        return array.astype(dtype, copy=False)
    if dtype.name in _WIDER:
        return array.astype(_WIDER[dtype.name])
    if dtype.kind == "u":
        return _converted(array, np.dtype("int64"), item)
    if dtype.kind == "f":
        return _converted(array, np.dtype("float64"), item)
    if dtype.kind == "i":
        return array.astype(np.int64, copy=False)
    raise NumberTypeError(
        f"the {item}s have the type {array.dtype}: give float64, float32, int64, int32 or uint32, "
        "which are taken exactly"
    )


def as_type(points: Any, dtype: np.dtype[Any], item: str = "point") -> Points:
    """Points as an array of a given type, which must hold all their numbers."""
    return _converted(as_points(points, item), dtype, item)


def _converted(array: NDArray[Any], dtype: np.dtype[Any], item: str) -> NDArray[Any]:
    """The array in another type. The first number that the type cannot hold is an error."""
    if array.dtype == dtype:
        return array
    with np.errstate(all="ignore"):
        converted = array.astype(dtype)
        back = converted.astype(array.dtype)
    same = back == array
    # A number at the end of a range of integers rounds on both ways, and is equal though it is not the same number.
    if dtype.kind in "iu" and array.dtype.kind == "f":
        same &= (array <= np.iinfo(dtype).max) & (array < 2.0**63)
    # Where a double is too large for integers, processors differ in what comes back.
    if dtype.kind == "f" and array.dtype.kind in "iu":
        same &= converted < float(2 ** np.iinfo(array.dtype).max.bit_length())
    # Of the same sign: an unsigned number beyond the range of a signed one comes back from below zero.
    same &= (converted < 0) == (array < 0)
    if array.dtype.kind == "f" and dtype.kind == "f":
        same |= np.isnan(array)
    if not same.all():
        row, column = (int(place) for place in np.argwhere(~same)[0])
        value = array[row, column]
        raise InputError(f"the {'xy'[column]} of {item} {row} is {value}, which {dtype} cannot hold")
    return converted


def check_finite(points: Points, item: str = "point") -> Points:
    """The points, all of which must be finite."""
    finite = np.isfinite(points)
    if not finite.all():
        row, column = (int(place) for place in np.argwhere(~finite)[0])
        value = points[row, column]
        raise InputError(
            f"the {'xy'[column]} of {item} {row} is {value}, which is not a finite number: remove or correct the {item}"
        )
    return points
