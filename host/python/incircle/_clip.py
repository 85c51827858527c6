"""The clip of Voronoi cells and of a relaxation, with its holes, as the compiled half takes it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _shapely
from ._errors import InputError
from ._input import as_type, check_finite, refuse_mask

Border = tuple[NDArray[Any], list[int]]
"""The corners of all rings in the type of the points, and how many each ring has. Without counts there is one ring, or
two corners of a rectangle, or none."""


def border(clip: Any, holes: Any, points: NDArray[Any]) -> Border:
    """A clip and its holes, checked. All corners have the type of the points."""
    polygon = _shapely.rings(clip)
    outer = clip if polygon is None else polygon[0]
    inner = ([] if polygon is None else polygon[1:]) + ([] if holes is None else _holes(holes))
    if not inner:
        return _corners(outer, points.dtype), []
    rings = [_outer(outer, points)] + [_ring(hole, points.dtype, f"hole {k}") for k, hole in enumerate(inner)]
    return np.concatenate(rings), [len(ring) for ring in rings]


def _holes(holes: Any) -> list[Any]:
    """The rings of holes; one array of numbers with three dimensions is a list of rings, too."""
    rings: list[Any] | None = None
    if not isinstance(holes, (str, bytes, dict)):
        try:
            rings = list(holes)
        except TypeError:
            pass
    if rings is None:
        raise InputError(f"the holes are {holes!r}: give a list with the corners of each hole")
    return rings


def _outer(clip: Any, points: NDArray[Any]) -> NDArray[Any]:
    """The ring around a clip with holes."""
    corners = _corners(clip, points.dtype)
    if len(corners) == 0 and len(points) > 0:
        corners = np.stack([points.min(axis=0), points.max(axis=0)])
    if len(corners) == 0:
        raise InputError("the rectangle around the points has no area: give a clip")
    if len(corners) == 2:
        (x0, y0), (x1, y1) = corners
        corners = np.array([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], dtype=points.dtype)
    return corners


def _corners(clip: Any, dtype: np.dtype[Any]) -> NDArray[Any]:
    """The corners of a clip in the type of the points: two of a rectangle, three or more of a ring, or none."""
    if clip is None or (isinstance(clip, str) and clip == "box"):
        return np.empty((0, 2), dtype)
    array = _array(clip, "clip")
    if array.shape == (4,):
        return check_finite(as_type(array.reshape(2, 2), dtype, "corner"), "corner")
    if array.ndim != 2 or array.shape[1] != 2 or len(array) < 3:
        raise InputError(
            f"the clip has the shape {array.shape}: give x0, y0, x1 and y1, 'box', or three or more corners of a "
            "polygon"
        )
    return check_finite(as_type(array, dtype, "corner"), "corner")


def _ring(corners: Any, dtype: np.dtype[Any], name: str) -> NDArray[Any]:
    """The corners of a ring in the type of the points."""
    array = _array(corners, name)
    if array.ndim != 2 or array.shape[1] != 2 or len(array) < 3:
        raise InputError(f"{name} has the shape {array.shape}: give three or more corners")
    item = f"{name}'s corner"
    return check_finite(as_type(array, dtype, item), item)


def _array(corners: Any, name: str) -> NDArray[Any]:
    if isinstance(corners, np.ma.MaskedArray):
        refuse_mask(f"corners of the {name}", corners, "coordinates")
    try:
        return np.asarray(corners)
    except ValueError as error:
        raise InputError(f"the {name} is no array of two columns, because numpy says: {error}") from error
