"""The mesh of a set of points, and the report on the job that made it."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from . import _native, _picture, _shapely

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True)
class Share:
    """The share of one device in the work on a set: its name, and how many parts and points it did.

    `left_out` is the error for which the device was left out, or `None`.
    """

    device: str
    parts: int
    points: int
    left_out: str | None


@dataclass(frozen=True)
class Report:
    """A report on a job: counts of the mesh, times, and facts about the device."""

    points: int
    """Input points, duplicates included."""
    distinct: int
    """Distinct points among them."""
    duplicates: int
    """Points that fell onto an earlier one."""
    triangles: int
    """Triangles of the mesh."""
    hull: int
    """Points on the hull, those in the middle of a hull edge included."""
    collinear: bool
    """Whether there is no triangle, because all points lie on one line or there are fewer than three."""
    backend: str
    """The name of the back end."""
    order: str
    """The name of the order of insertion."""
    stages: dict[str, float]
    """The time of each stage in seconds."""
    counters: dict[str, int] | None
    """The counters of the device, where it has some."""
    clocks: int | None
    """Clocks of the device, where they are known."""
    step: str | None
    """The length of a step of the lattice of the points, such as `1` or `2^-20`; `None` without a lattice."""
    bits: int | None
    """The bits of the lattice."""
    contexts: int
    """Contexts that worked, or threads of the CPU triangulator."""
    parts: int
    """Parts into which the set was cut for devices; 0 if it was done at once."""
    shares: list[Share]
    """The share of each device, where several worked together."""

    @classmethod
    def of(cls, report: dict[str, Any]) -> Report:
        """The report of what the compiled half says."""
        counters = report["counters"] and dict(report["counters"])
        return cls(**{**report, "counters": counters, "shares": [Share(*share) for share in report["shares"]]})


@dataclass(frozen=True, eq=False, repr=False)
class Mesh:
    """The Delaunay triangulation of the distinct points of a set, in canonical form.

    >>> import incircle
    >>> mesh = incircle.triangulate([(0, 0), (4, 0), (4, 4), (0, 4)])
    >>> mesh
    Mesh(4 points, 2 triangles, 4 points on the hull, 0 duplicates)
    >>> mesh.neighbors.tolist()
    [[-1, 1, -1], [-1, -1, 0]]

    All indices are rows of `points`.
    """

    points: NDArray[Any]
    """The input points in their order, in the type of numbers in which they were taken."""
    triangles: NDArray[np.uint32]
    """Three indices a row, counter-clockwise, the smallest first, and the rows in sorted order."""
    hull: NDArray[np.uint32]
    """The points on the hull, counter-clockwise, those in the middle of a hull edge included. A mesh without triangles
    lists all distinct points here, in lexicographic order."""
    duplicates: NDArray[np.uint32]
    """For each point with the coordinates of an earlier one: its index, and the lowest index of that place."""
    report: Report | None = None
    """The report on the job, for a mesh of `triangulate`."""
    _crs: Any = field(default=None)

    @cached_property
    def halfedges(self) -> NDArray[Any]:
        """The half-edges as delaunator has them, computed once.

        Half-edge `3 t + k` runs from vertex `k` of triangle `t` to the next one. The item is the half-edge of the same
        edge in the other triangle, or -1 on the hull. The type is int32, and int64 beyond 715 million triangles.

        >>> import incircle
        >>> incircle.triangulate([(0, 0), (4, 0), (4, 4), (0, 4)]).halfedges.tolist()
        [-1, -1, 3, 2, -1, -1]
        """
        return _native.halfedges(self.triangles)

    @cached_property
    def neighbors(self) -> NDArray[np.int32]:
        """The neighbours of each triangle, computed once.

        Column `k` is the triangle across the edge opposite vertex `k`, or -1 on the hull.
        """
        return _native.neighbors(self.triangles)

    @cached_property
    def edges(self) -> NDArray[np.uint32]:
        """All edges, computed once: two indices a row, in the direction in which the edge's first triangle has it."""
        own = np.arange(len(self.halfedges))
        starts = (self.halfedges < 0) | (own < self.halfedges)
        ends = self.triangles[:, [1, 2, 0]]
        return np.column_stack([self.triangles.ravel()[starts], ends.ravel()[starts]])

    @property
    def is_collinear(self) -> bool:
        """Whether there is no triangle, because all points lie on one line or there are fewer than three."""
        return len(self.triangles) == 0

    def verify(self) -> None:
        """Proves with the independent validator that this is the canonical mesh of its points. O(n log n).

        Raises
        ------
        VerifyError
            The first defect, with its numbers.
        """
        _native.verify(self.points, self.triangles, self.hull.tolist(), self.duplicates.tolist())

    def plot(self, ax: Axes | None = None, **options: Any) -> list[Any]:
        """Draws the edges into axes of matplotlib, or into the current ones, and returns the lines.

        The options are those of `Axes.triplot`. Without triangles, the points are drawn.
        """
        return _picture.plot(self, ax, options)

    def to_shapely(self) -> NDArray[Any]:
        """The triangles as an array of polygons of shapely, in the order of `triangles`."""
        return _shapely.polygons(self.points, self.triangles)

    def to_geopandas(self, crs: Any = None) -> Any:
        """The triangles as a `geopandas.GeoDataFrame` with the indices of the corners in the columns a, b and c.

        The coordinate reference system is that of the points, if they came from geopandas, unless `crs` names one.
        """
        return _shapely.frame(self.points, self.triangles, self._crs if crs is None else crs)

    def _repr_svg_(self) -> str:
        return _picture.svg(self)

    def __repr__(self) -> str:
        return (
            f"Mesh({len(self.points)} points, {len(self.triangles)} triangles, {len(self.hull)} points on the hull, "
            f"{len(self.duplicates)} duplicates)"
        )
