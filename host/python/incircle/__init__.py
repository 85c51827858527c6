"""Exact canonical Delaunay triangulation of points in the plane.

No coordinate is rounded, and a set of points has exactly one mesh, on every machine and every back end.

>>> import incircle
>>> mesh = incircle.triangulate([(0, 0), (4, 0), (4, 4), (0, 4), (4, 0)])
>>> mesh.triangles.tolist()
[[0, 1, 2], [0, 2, 3]]
>>> mesh.hull.tolist()
[0, 1, 2, 3]
>>> mesh.duplicates.tolist()
[[4, 1]]

`triangulate` makes the mesh of a set, and `Triangulation` is a mesh whose points come, go and move. `Delaunay` stands
in for `scipy.spatial.Delaunay` in two dimensions and needs SciPy, and `tri` makes a `matplotlib.tri.Triangulation`.
`voronoi` makes the cells of a set, `lloyd` spreads points evenly, and `interpolate` gives values between points.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ._cells import Cells, Relaxed, Voronoi, lloyd, voronoi
from ._constraints import ConstrainedMesh
from ._errors import (
    CapacityError,
    Cancelled,
    ChoiceError,
    DeviceError,
    DeviceNotFoundError,
    DeviceTimeoutError,
    Error,
    InputError,
    LinkError,
    NumberTypeError,
    OutOfMemoryError,
    UnknownPointError,
    VerifyError,
)
from ._living import Location, Triangulation
from ._matplotlib import tri
from ._mesh import Mesh, Report, Share
from ._surface import Surface, interpolate
from ._triangulate import triangulate

if TYPE_CHECKING:
    from ._scipy import Delaunay, FlatError

__version__ = "0.1.0"

__all__ = [
    "CapacityError",
    "Cancelled",
    "Cells",
    "ChoiceError",
    "ConstrainedMesh",
    "Delaunay",
    "DeviceError",
    "DeviceNotFoundError",
    "DeviceTimeoutError",
    "Error",
    "FlatError",
    "InputError",
    "LinkError",
    "Location",
    "Mesh",
    "NumberTypeError",
    "OutOfMemoryError",
    "Relaxed",
    "Report",
    "Share",
    "Surface",
    "Triangulation",
    "UnknownPointError",
    "VerifyError",
    "Voronoi",
    "interpolate",
    "lloyd",
    "tri",
    "triangulate",
    "voronoi",
]


def __getattr__(name: str) -> Any:
    # SciPy is optional, and takes longer to import than all the rest.
    if name in ("Delaunay", "FlatError"):
        from . import _scipy

        return getattr(_scipy, name)
    raise AttributeError(f"module 'incircle' has no attribute {name!r}")
