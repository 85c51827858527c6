"""The door to `matplotlib.tri`. Matplotlib is optional."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ._errors import InputError
from ._triangulate import triangulate

if TYPE_CHECKING:
    from matplotlib.tri import Triangulation


def tri(points: Any) -> Triangulation:
    """Triangulates points for the functions of `matplotlib.tri`, such as `tripcolor` and the interpolators.

    >>> import incircle
    >>> incircle.tri([(0, 0), (4, 0), (4, 4), (0, 4)]).triangles.tolist()
    [[0, 1, 2], [0, 2, 3]]

    The points are those of `triangulate`. Column `j` of `neighbors` is across the edge from corner `j` to corner
    `j + 1`, as matplotlib has it, while `Mesh.neighbors` has it opposite corner `j`.

    Raises
    ------
    InputError
        The points have no triangle, because all lie on one line.
    """
    from matplotlib.tri import Triangulation

    mesh = triangulate(points)
    if mesh.is_collinear:
        raise InputError(f"the {len(mesh.hull)} distinct points have no triangle: give three that are not on one line")
    x, y = mesh.points.T.astype(np.float64)
    return Triangulation(x, y, mesh.triangles.astype(np.int32))
