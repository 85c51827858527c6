"""Geometries of shapely and geopandas, in and out. Both packages are optional."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._errors import InputError


def coordinates(points: Any) -> NDArray[np.float64] | None:
    """The coordinates of geometries that are points; `None` for anything that is no geometry."""
    shapely = sys.modules.get("shapely")
    if shapely is None:
        return None
    if isinstance(points, shapely.Geometry):
        if points.geom_type != "MultiPoint":
            raise InputError(f"the geometry is a {points.geom_type}: give a MultiPoint, or a list of points")
        found: NDArray[np.float64] = shapely.get_coordinates(points)
        return found
    geometries = _geometries(points, shapely)
    if geometries is None:
        return None
    for place in np.flatnonzero((shapely.get_type_id(geometries) != 0) | shapely.is_empty(geometries)):
        geometry = geometries[place]
        kind = "missing" if geometry is None else "an empty point" if geometry.is_empty else f"a {geometry.geom_type}"
        raise InputError(f"geometry {place} is {kind}: give points with coordinates")
    found = shapely.get_coordinates(geometries)
    return found


def _geometries(points: Any, shapely: Any) -> NDArray[Any] | None:
    """The geometries of a list, an array or a table, as an array; `None` if there are none."""
    if type(points).__module__.startswith("geopandas"):
        return np.asarray(getattr(points, "geometry", points), dtype=object)
    is_list = isinstance(points, Sequence) and not isinstance(points, (str, bytes, memoryview))
    if not is_list and not (isinstance(points, np.ndarray) and points.dtype == object and points.ndim == 1):
        return None
    if len(points) == 0 or not any(isinstance(point, shapely.Geometry) for point in points[:2]):
        return None
    array = np.empty(len(points), dtype=object)
    array[:] = points
    return array


def rings(clip: Any) -> list[NDArray[np.float64]] | None:
    """The rings of a polygon of shapely, first the one around it; `None` for anything that is no geometry."""
    shapely = sys.modules.get("shapely")
    if shapely is None or not isinstance(clip, shapely.Geometry):
        return None
    if clip.geom_type != "Polygon" or clip.is_empty:
        kind = "an empty polygon" if clip.geom_type == "Polygon" else f"a {clip.geom_type}"
        raise InputError(f"the clip is {kind}: give a polygon with area")
    return [shapely.get_coordinates(ring) for ring in (clip.exterior, *clip.interiors)]


def crs_of(points: Any) -> Any:
    """The coordinate reference system of a table or series of geopandas."""
    return getattr(points, "crs", None) if type(points).__module__.startswith("geopandas") else None


def polygons(points: NDArray[Any], triangles: NDArray[Any]) -> NDArray[Any]:
    """The triangles as an array of polygons of shapely."""
    import shapely

    corners = points[triangles[:, [0, 1, 2, 0]]].astype(np.float64)
    found: NDArray[Any] = shapely.polygons(corners)
    return found


def frame(points: NDArray[Any], triangles: NDArray[Any], crs: Any) -> Any:
    """The triangles as a table of geopandas, with the indices of the corners."""
    import geopandas

    columns = dict(zip("abc", triangles.T))
    return geopandas.GeoDataFrame(columns, geometry=polygons(points, triangles), crs=crs)


def cells(pieces: list[list[list[NDArray[Any]]]]) -> NDArray[Any]:
    """Cells as an array of shapely: a polygon, a multipolygon of several pieces, or an empty polygon for none.

    A cell is a list of pieces, and a piece a list of rings.
    """
    import shapely

    shapes = [[shapely.Polygon(rings[0], rings[1:]) for rings in cell] for cell in pieces]
    return np.array(
        [one[0] if len(one) == 1 else shapely.MultiPolygon(one) if one else shapely.Polygon() for one in shapes],
        dtype=object,
    )
