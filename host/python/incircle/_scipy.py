"""The stand-in for `scipy.spatial.Delaunay` in two dimensions. SciPy is optional."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ._errors import ChoiceError, Error, InputError
from ._input import as_type
from ._mesh import Mesh
from ._triangulate import triangulate

try:
    from scipy import spatial
except ImportError as error:
    raise ImportError("incircle.Delaunay needs SciPy: install it with `pip install scipy`") from error

HARMLESS = frozenset("d Qbb Qc Qt Qx Qz Qs Q0 Q3 Q5 Q9 Q11 Q12 Q14 Pp".split())
"""Options of Qhull that ask for no other mesh: they scale, report, or work against rounding."""


class FlatError(Error, spatial.QhullError):  # type: ignore[misc]
    """The points have no triangle: all lie on one line, or there are fewer than three."""


class Delaunay(spatial.Delaunay):  # type: ignore[misc]
    """The Delaunay triangulation of points in the plane, with the attributes of `scipy.spatial.Delaunay`.

    >>> import numpy as np, incircle
    >>> from scipy.interpolate import LinearNDInterpolator
    >>> mesh = incircle.Delaunay([(0, 0), (4, 0), (4, 4), (0, 4), (2, 1)])
    >>> mesh.simplices.tolist()
    [[0, 1, 4], [0, 4, 3], [1, 2, 4], [2, 3, 4]]
    >>> mesh.find_simplex([(2, 0.5), (9, 9)]).tolist()
    [0, -1]
    >>> float(LinearNDInterpolator(mesh, [0, 4, 8, 4, 3])(1, 1))
    2.0

    It is a subclass, so SciPy's interpolators take it, but Qhull is never called. The triangles are those of
    `incircle.triangulate`: exact, and always the same. Their order, their first corners, and the diagonals of points on
    one empty circle differ from those of SciPy. The coordinates are doubles, and integers that doubles cannot hold are
    refused.

    Parameters
    ----------
    points
        Points in the plane, as for `incircle.triangulate`.
    furthest_site
        Must be `False`.
    incremental
        Whether `add_points` may be called.
    qhull_options
        Options of Qhull. Those that ask for no other mesh are accepted, and change nothing. `QJ` is refused if there
        are duplicates, because it would move them apart.

    Raises
    ------
    InputError
        The points have another number of dimensions, or a value that is NaN or infinite.
    FlatError
        The points have no triangle. It is also a `scipy.spatial.QhullError`.
    ChoiceError
        `furthest_site`, or an option that would ask for another mesh.
    """

    def __init__(
        self,
        points: Any,
        furthest_site: bool = False,
        incremental: bool = False,
        qhull_options: str | bytes | None = None,
    ) -> None:
        if furthest_site:
            raise ChoiceError("incircle has no furthest-site triangulation: use scipy.spatial.Delaunay for that")
        self._joggled = _joggles(qhull_options)
        self._incremental = bool(incremental)
        self.furthest_site = False
        self._build(as_type(points, np.dtype("float64")))

    def _build(self, points: NDArray[np.float64]) -> None:
        """Fills the attributes with the mesh of points."""
        if len(points) == 0:
            raise InputError("there are no points: give three that are not on one line")
        mesh = triangulate(points)
        if mesh.is_collinear:
            raise FlatError(
                f"the {len(mesh.hull)} distinct points have no triangle: give three that are not on one line"
            )
        if self._joggled and len(mesh.duplicates):
            first, other = mesh.duplicates[0].tolist()
            raise ChoiceError(
                f"the option QJ of Qhull would move duplicates apart, such as point {first}, which lies on point "
                f"{other}: leave out the option or the duplicates"
            )
        self._points = mesh.points
        self.ndim = 2
        self.npoints = len(mesh.points)
        self.min_bound, self.max_bound = mesh.points.min(axis=0), mesh.points.max(axis=0)
        # All arrays are made now, as in SciPy: its compiled code keeps pointers into them while other threads run. The
        # caller may write to them, so they are not those of the mesh.
        self.simplices = self.vertices = mesh.triangles.astype(np.intc)
        self.neighbors: NDArray[np.intc] = mesh.neighbors
        self.nsimplex = len(self.simplices)
        self.good = np.ones(self.nsimplex, dtype=np.intc)
        # The paraboloid z = x² + y², neither scaled nor shifted.
        self.paraboloid_scale, self.paraboloid_shift = 1.0, 0.0
        self.equations = _planes(mesh.points, self.simplices)
        # SciPy's property `vertex_to_simplex` gives what it finds here.
        self._vertex_to_simplex = _triangle_at_each(mesh)
        places, vertices = mesh.duplicates.T
        self.coplanar = np.column_stack([places, self._vertex_to_simplex[vertices], vertices]).astype(np.intc)
        # SciPy computes these when they are asked for, and keeps them here.
        self._transform = None
        self._vertex_neighbor_vertices = None

    def add_points(self, points: Any, restart: bool = False) -> None:
        """Adds points, if the triangulation was made with `incremental`. The mesh is made anew, in O(n) time."""
        if not self._incremental:
            raise RuntimeError("incremental mode not enabled or already closed")
        self._build(np.concatenate([self._points, as_type(points, np.dtype("float64"))]))

    def close(self) -> None:
        """Ends the incremental mode."""
        self._incremental = False


def _joggles(options: str | bytes | None) -> bool:
    """Whether options of Qhull ask for joggled input. An option that asks for another mesh is an error."""
    text = options.decode(errors="replace") if isinstance(options, bytes) else options or ""
    if not isinstance(text, str):
        raise ChoiceError(f"the options of Qhull are {options!r}: give a text, such as 'Qbb Qc'")
    asked = set(text.split())
    others = sorted(asked - HARMLESS - {"QJ"})
    if others:
        raise ChoiceError(f"the option {others[0]} of Qhull has no meaning here: leave it out")
    return "QJ" in asked


def _triangle_at_each(mesh: Mesh) -> NDArray[np.intc]:
    """A triangle at each point of a mesh; at a duplicate, a triangle of its place."""
    found = np.full(len(mesh.points), -1, dtype=np.intc)
    found[mesh.triangles.ravel()] = np.repeat(np.arange(len(mesh.triangles), dtype=np.intc), 3)
    found[mesh.duplicates[:, 0]] = found[mesh.duplicates[:, 1]]
    return found


def _planes(points: NDArray[np.float64], triangles: NDArray[Any]) -> NDArray[np.float64]:
    """The planes through the lifted corners of triangles: normals of length 1 that point down, and offsets."""
    # Very large or very small coordinates leave the range of doubles, as they do in SciPy.
    with np.errstate(all="ignore"):
        (ax, ay), (bx, by), (cx, cy) = (points[triangles[:, corner]].T for corner in range(3))
        ux, uy, vx, vy = bx - ax, by - ay, cx - ax, cy - ay
        # Differences of squares lose fewer bits as products.
        uz, vz = ux * (bx + ax) + uy * (by + ay), vx * (cx + ax) + vy * (cy + ay)
        normal = np.column_stack([uz * vy - uy * vz, ux * vz - uz * vx, uy * vx - ux * vy])
        normal /= np.sqrt((normal**2).sum(axis=1))[:, None]
        offset = -(normal[:, 0] * ax + normal[:, 1] * ay + normal[:, 2] * (ax * ax + ay * ay))
        return np.column_stack([normal, offset])
