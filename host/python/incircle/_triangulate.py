"""The mesh of a set of points, in one call."""

from __future__ import annotations

import operator
from collections.abc import Sequence
from typing import Any

from . import _native
from ._constraints import asked, constrained
from ._errors import ChoiceError
from ._input import as_points
from ._mesh import Mesh, Report
from ._progress import Progress, listener
from ._shapely import crs_of

MAX_THREADS = 256


def triangulate(
    points: Any,
    backend: str | Sequence[str] | None = None,
    threads: int | None = None,
    progress: Progress | None = None,
    *,
    constraints: Any = None,
    domain: str | None = None,
    lines: int = 0,
    holes: Any = None,
    regions: Any = None,
) -> Mesh:
    """Triangulates a set of points: the Delaunay triangulation of its distinct points, in canonical form.

    With `constraints`, a `domain`, `holes` or `regions`, the mesh is a `ConstrainedMesh`.

    >>> import numpy as np, incircle
    >>> mesh = incircle.triangulate(np.array([[-0.1, 0.1], [0.2, 0.1], [0.2, 0.4], [-0.1, 0.4]]))
    >>> mesh.triangles.tolist()
    [[0, 1, 2], [0, 2, 3]]

    Where four or more points lie on one empty circle, all diagonals start at the lexicographically smallest of them.
    Fewer than three points, or points on one line, are no error: the mesh then has no triangles.

    Parameters
    ----------
    points
        An array, or what numpy makes an array of, with the two columns x and y. The type of numbers decides how they
        are taken: float64, float32, int64, int32 and uint32 as the exact numbers that they are; smaller types become
        one of these. Points of shapely and geopandas are taken as float64. The points are read once, before other
        threads of Python go on, so later writes to the array change nothing.
    backend
        The address of what does the job, such as `"cpu"`, `"model"`, `"clock"`, `"serial:/dev/ttyUSB0"` or
        `"udp:192.168.1.50"`, as for `--backend` of the command `incircle`; several addresses share the work. `None`
        stands for `"cpu"`, the CPU triangulator. The mesh is the same for all.
    threads
        The most threads of the CPU triangulator, 1 to 256. `None` allows one for each processor.
    progress
        A function that is called with the stage, the items done and the items of the stage in all, or a bar of tqdm. An
        exception from the function ends the job and reaches the caller. If the function returns `False`, the job ends
        with `Cancelled`.
    constraints
        Edges that must be in the mesh: an array of whole numbers with two columns, the rows of both ends. They may
        overlap, touch and pass through points, but not cross elsewhere.
    domain
        Which triangles are wanted: `"all"` of the hull; `"even-odd"` or `"non-zero"` for those inside the rings of the
        constraints; `"holes"` for those that constraints separate from the outside and from all holes. `None` stands
        for `"holes"` if there are holes, else for `"all"`.
    lines
        How many constraints at the end bound nothing: they are edges, but no parts of rings.
    holes, regions
        A place in each hole of the domain `"holes"`, and in each region whose number is wanted; points in numbers that
        the type of the points holds.

    Raises
    ------
    InputError
        A shape without two columns, a masked array, a value that is NaN or infinite, or points that the device cannot
        take. Constraints that cross or name points that do not exist, a boundary that is not closed, a domain without
        triangles, or a hole or region outside the hull or on a constraint.
    NumberTypeError
        A type of numbers that cannot be taken exactly, such as object or complex.
    ChoiceError
        An impossible number of threads, threads for another back end than `"cpu"`, an unknown domain, holes in another
        domain than `"holes"`, or more lines than constraints.
    Error
        `DeviceNotFoundError`, `LinkError`, `DeviceError` and `DeviceTimeoutError` of a device, `CapacityError` beyond
        536,870,911 points, `OutOfMemoryError`, and `Cancelled`.
    KeyboardInterrupt
        Ctrl-C ends the job.
    """
    addresses = _addresses(backend)
    if threads is not None:
        threads = operator.index(threads)
        if not 1 <= threads <= MAX_THREADS:
            raise ChoiceError(f"{threads} threads are not possible: choose 1 to {MAX_THREADS}")
        if addresses not in ([], ["cpu"]):
            raise ChoiceError(f"threads are for the CPU triangulator, but the back end is {', '.join(addresses)}")
    array = as_points(points)
    is_plain = all(choice is None for choice in (constraints, domain, holes, regions)) and lines == 0
    plan = None if is_plain else asked(constraints, domain, lines, holes, regions, array.dtype)
    found, triangles, hull, duplicates, report = _native.triangulate(array, addresses, threads, listener(progress))
    mesh = Mesh(found, triangles, hull, duplicates, Report.of(report), crs_of(points))
    return mesh if plan is None else constrained(mesh, plan)


def _addresses(backend: str | Sequence[str] | None) -> list[str]:
    if backend is None:
        return []
    addresses = [backend] if isinstance(backend, str) else list(backend)
    if not addresses or not all(isinstance(address, str) for address in addresses):
        raise ChoiceError(f"the back end is {backend!r}: give the address of one, or a list of addresses")
    return addresses
