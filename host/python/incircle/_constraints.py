"""Meshes with edges that must be there, and the domains that these edges bound."""

from __future__ import annotations

import operator
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from . import _native
from ._errors import ChoiceError, InputError
from ._input import as_type, check_finite, refuse_mask
from ._mesh import Mesh, Report

DOMAINS = ("all", "holes", "even-odd", "non-zero")


class Asked(NamedTuple):
    """What the compiled half reads: constraints, the domain, and places in holes and regions."""

    constraints: NDArray[np.uint32]
    lines: int
    domain: str
    holes: NDArray[Any]
    regions: NDArray[Any]


@dataclass(frozen=True, eq=False, repr=False)
class ConstrainedMesh(Mesh):
    """The canonical mesh of a set of points in which constraints are edges: the triangles of a domain.

    >>> import incircle
    >>> points = [(0, 0), (8, 0), (8, 8), (0, 8), (4, 3)]
    >>> outline = [(0, 1), (1, 2), (2, 4), (4, 3), (3, 0)]
    >>> mesh = incircle.triangulate(points, constraints=outline, domain="even-odd")
    >>> mesh.triangles.tolist()
    [[0, 1, 4], [0, 4, 3], [1, 2, 4]]
    >>> mesh.constraints_of(4, 3).tolist()
    [3]

    `hull` and `duplicates` are those of the mesh without constraints; `neighbors`, `halfedges` and `edges` are those of
    the triangles of the domain.
    """

    pieces: NDArray[np.uint32] = field(default_factory=lambda: np.empty((0, 2), dtype=np.uint32))
    """The edges that constraints fix, also those outside the domain: two points a row, in sorted order."""
    piece_starts: NDArray[np.uint32] = field(default_factory=lambda: np.zeros(1, dtype=np.uint32))
    """The constraints of piece `k` are `piece_constraints[piece_starts[k]:piece_starts[k + 1]]`."""
    piece_constraints: NDArray[np.uint32] = field(default_factory=lambda: np.empty(0, dtype=np.uint32))
    """The rows of the constraints that each piece belongs to, one piece behind the other."""
    regions: NDArray[np.uint32] = field(default_factory=lambda: np.empty(0, dtype=np.uint32))
    """The region of each triangle: a part of the domain that no constraint cuts. With the domain `"all"` and without
    places of regions, every triangle is in region 0."""
    marked: NDArray[np.uint32] = field(default_factory=lambda: np.empty(0, dtype=np.uint32))
    """The region around each place that was given as `regions`."""
    _asked: Asked | None = None

    def constraints_of(self, a: int, b: int) -> NDArray[np.uint32]:
        """The rows of the constraints that the edge between two points belongs to; none if it is no piece."""
        low, high = sorted((operator.index(a), operator.index(b)))
        found = np.flatnonzero((self.pieces[:, 0] == low) & (self.pieces[:, 1] == high))
        if len(found) == 0:
            return self.piece_constraints[:0]
        start, end = self.piece_starts[found[0] : found[0] + 2]
        return self.piece_constraints[start:end]

    def verify(self) -> None:
        """Proves with the independent validator that these are the triangles of the domain in the canonical mesh.

        Raises
        ------
        VerifyError
            The first defect, with its numbers.
        """
        _native.verify_plan(self.points, self.triangles, self._asked)

    def __repr__(self) -> str:
        return (
            f"ConstrainedMesh({len(self.points)} points, {len(self.triangles)} triangles, {len(self.pieces)} pieces, "
            f"{len(self.duplicates)} duplicates)"
        )


def asked(
    constraints: Any, domain: str | None, lines: int, holes: Any, regions: Any, dtype: np.dtype[Any]
) -> Asked:
    """What is asked of a mesh, checked. Places become the type of numbers of the points."""
    if domain is None:
        domain = "all" if holes is None else "holes"
    if domain not in DOMAINS:
        raise ChoiceError(f"the domain is {domain!r}: choose one of {', '.join(DOMAINS)}")
    if holes is not None and domain != "holes":
        raise ChoiceError(f"holes belong to the domain 'holes', but the domain is {domain!r}: leave one of them out")
    pairs = _pairs(constraints)
    lines = operator.index(lines)
    if not 0 <= lines <= len(pairs):
        raise ChoiceError(f"{lines} of {len(pairs)} constraints cannot be lines: give 0 to {len(pairs)}")
    return Asked(pairs, lines, domain, _places(holes, dtype, "hole"), _places(regions, dtype, "region"))


def _places(places: Any, dtype: np.dtype[Any], item: str) -> NDArray[Any]:
    if places is None:
        return np.empty((0, 2), dtype)
    return check_finite(as_type(places, dtype, item), item)


def constrained(mesh: Mesh, asked: Asked) -> ConstrainedMesh:
    """Forces constraints into a mesh."""
    made = _native.constrained(
        mesh.points, mesh.triangles, mesh.hull.tolist(), mesh.duplicates.tolist(), asked
    )
    triangles = made.pop("triangles")
    return ConstrainedMesh(
        mesh.points, triangles, mesh.hull, mesh.duplicates, mesh.report, mesh._crs, _asked=asked, **made
    )


def constrained_of(parts: Any, asked: Asked, crs: Any) -> ConstrainedMesh:
    """The mesh of what the compiled half made of points and constraints in one job."""
    points, hull, duplicates, report, made = parts
    triangles = made.pop("triangles")
    return ConstrainedMesh(points, triangles, hull, duplicates, Report.of(report), crs, _asked=asked, **made)


def _pairs(constraints: Any) -> NDArray[np.uint32]:
    if isinstance(constraints, np.ma.MaskedArray):
        refuse_mask("constraints", constraints, "indices")
    try:
        pairs = np.asarray([] if constraints is None else constraints)
    except ValueError as error:
        raise InputError(f"the constraints are no array of two columns, because numpy says: {error}") from error
    if pairs.size == 0:
        return np.empty((0, 2), dtype=np.uint32)
    if pairs.ndim != 2 or pairs.shape[1] != 2 or pairs.dtype.kind not in "iu":
        raise InputError(
            f"the constraints have the shape {pairs.shape} and the type {pairs.dtype}: give an array of whole numbers "
            "with two columns, the indices of both ends"
        )
    wrong = np.argwhere((pairs < 0) | (pairs > np.iinfo(np.uint32).max))
    if len(wrong):
        row, column = (int(place) for place in wrong[0])
        raise InputError(f"constraint {row} names point {pairs[row, column]}, which cannot be: count points from 0")
    return np.ascontiguousarray(pairs, dtype=np.uint32)
