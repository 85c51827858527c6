"""Pictures of meshes: SVG for notebooks, and lines of matplotlib."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from ._mesh import Mesh

MOST_EDGES = 30_000
"""A larger mesh is drawn as its hull, because browsers are slow with longer paths."""
SIDE = 480.0
"""The longer side of a picture in pixels."""
BORDER = 10.0


def plot(mesh: Mesh, ax: Any, options: dict[str, Any]) -> list[Any]:
    """Draws the edges of a mesh into axes of matplotlib."""
    if ax is None:
        from matplotlib import pyplot

        ax = pyplot.gca()
    x, y = mesh.points.T.astype(np.float64)
    if mesh.is_collinear:
        lines: list[Any] = ax.plot(x, y, **{"linestyle": "none", "marker": ".", **options})
        return lines
    return list(ax.triplot(x, y, mesh.triangles.astype(np.int32), **options))


def svg(mesh: Mesh) -> str:
    """A picture of a mesh, with y upwards: the edges, and the hull in red."""
    places, width, height = _on_paper(mesh.points)
    has_edges = not mesh.is_collinear
    draws_edges = has_edges and 3 * len(mesh.triangles) <= 2 * MOST_EDGES
    drawn = "" if draws_edges or not has_edges else ", of which the hull is drawn"
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:.0f}" height="{height:.0f}" '
        f'viewBox="0 0 {width:.1f} {height:.1f}">',
        f"<title>{len(mesh.points)} points, {len(mesh.triangles)} triangles{drawn}</title>",
    ]
    if draws_edges:
        lines = places[mesh.edges].reshape(-1, 4)
        path = "".join(f"M{a:.1f} {b:.1f}L{c:.1f} {d:.1f}" for a, b, c, d in lines.tolist())
        parts.append(f'<path d="{path}" fill="none" stroke="#456" stroke-width="0.7"/>')
    if has_edges:
        corners = " ".join(f"{x:.1f},{y:.1f}" for x, y in places[mesh.hull].tolist())
        parts.append(f'<polygon points="{corners}" fill="none" stroke="#c22" stroke-width="1"/>')
    else:
        dots = "".join(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="2"/>' for x, y in places[mesh.hull[:MOST_EDGES]].tolist())
        parts.append(dots)
    return "".join([*parts, "</svg>"])


def _on_paper(points: NDArray[Any]) -> tuple[NDArray[np.float64], float, float]:
    """The places of points in a picture, and the width and height of the picture."""
    if len(points) == 0:
        return np.empty((0, 2)), 2 * BORDER, 2 * BORDER
    # Halves, because the difference of two large doubles may be no double.
    halves = points.astype(np.float64) / 2
    low, high = halves.min(axis=0), halves.max(axis=0)
    extent = float((high - low).max())
    places = (halves - low) / (extent or 1.0) * SIDE
    width, height = places.max(axis=0).tolist()
    places[:, 1] = height - places[:, 1]
    return places + BORDER, width + 2 * BORDER, height + 2 * BORDER
