"""Constraints, domains, holes and regions: edges that must be there, and the triangles that they bound."""

import pickle

import numpy as np
import pytest

import incircle

NOTCH = np.array([(0, 0), (8, 0), (8, 8), (0, 8), (4, 3)])
OUTLINE = np.array([(0, 1), (1, 2), (2, 4), (4, 3), (3, 0)])
FRAME = np.array([(0, 0), (9, 0), (9, 9), (0, 9), (3, 3), (6, 3), (6, 6), (3, 6)])
RINGS = [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4)]


def area(mesh):
    a, b, c = (mesh.points[mesh.triangles[:, corner]].astype(float) for corner in range(3))
    one, other = b - a, c - a
    return (one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]).sum() / 2


@pytest.mark.parametrize("dtype", ["float64", "float32", "int64", "int32", "uint32", ">f8", "uint16"])
def test_a_notch_is_cut_out_in_every_type(dtype):
    mesh = incircle.triangulate(NOTCH.astype(dtype), constraints=OUTLINE.astype(np.uint8), domain="even-odd")
    assert isinstance(mesh, incircle.ConstrainedMesh)
    assert mesh.triangles.tolist() == [[0, 1, 4], [0, 4, 3], [1, 2, 4]]
    assert area(mesh) == 44
    assert mesh.pieces.tolist() == [[0, 1], [0, 3], [1, 2], [2, 4], [3, 4]]
    assert mesh.constraints_of(3, 0).tolist() == [4] and mesh.constraints_of(0, 4).tolist() == []
    assert mesh.neighbors.shape == (3, 3) and mesh.report.triangles == 4
    mesh.verify()


def test_holes_are_left_out_and_regions_are_numbered():
    mesh = incircle.triangulate(FRAME, constraints=RINGS, holes=[(4, 4)])
    assert area(mesh) == 81 - 9
    assert area(incircle.triangulate(FRAME, constraints=RINGS, domain="even-odd")) == 72
    both = incircle.triangulate(FRAME, constraints=RINGS, domain="holes", regions=[(4, 5), (1, 1)])
    assert area(both) == 81 and len(set(both.marked.tolist())) == 2
    inner = both.triangles[both.regions == both.marked[0]]
    assert sorted(set(inner.ravel().tolist())) == [4, 5, 6, 7]
    for one in (mesh, both):
        one.verify()


def test_lines_bound_nothing_and_are_edges():
    lines = [*RINGS[:4], (4, 6)]
    mesh = incircle.triangulate(FRAME, constraints=lines, domain="even-odd", lines=1)
    assert mesh.constraints_of(4, 6).tolist() == [4] and area(mesh) == 81
    with pytest.raises(incircle.InputError, match="the boundary of the domain is not closed"):
        incircle.triangulate(FRAME, constraints=lines, domain="even-odd")


def test_overlapping_constraints_share_pieces():
    points = [(0, 0), (2, 0), (4, 0), (6, 0), (3, 5), (3, -5)]
    mesh = incircle.triangulate(points, constraints=[(0, 2), (3, 1), (2, 2), (0, 2)])
    assert mesh.pieces.tolist() == [[0, 1], [1, 2], [2, 3]]
    assert [mesh.constraints_of(k, k + 1).tolist() for k in range(3)] == [[0, 3], [0, 1, 3], [1]]
    mesh.verify()


def test_random_constraints_are_edges_of_a_mesh_that_the_validator_proves():
    random = np.random.default_rng(27)
    for _ in range(40):
        points = random.integers(0, 12, (30, 2))
        found = []
        for pair in random.integers(0, 30, (12, 2)).tolist():
            try:
                mesh = incircle.triangulate(points, constraints=[*found, pair])
            except incircle.InputError as error:
                assert "crosses constraint" in str(error)
                continue
            found.append(pair)
        mesh = incircle.triangulate(points, constraints=found)
        edges = {tuple(sorted(edge)) for edge in mesh.edges.tolist()}
        assert {tuple(piece) for piece in mesh.pieces.tolist()} <= edges
        assert set(mesh.piece_constraints.tolist()) <= set(range(len(found)))
        mesh.verify()
        same = incircle.triangulate(points, constraints=found[::-1], backend="model")
        np.testing.assert_array_equal(same.triangles, mesh.triangles)


@pytest.mark.parametrize("dtype", ["float64", "float32", "int64", "int32", "uint32"])
def test_one_job_gives_the_bytes_of_both_steps(dtype):
    # Two addresses share the triangulation, and the constraints are forced afterwards.
    both = ["cpu?threads=1", "cpu?threads=1"]
    random = np.random.default_rng(28)
    rings = {"constraints": RINGS, "regions": [(1, 1)]}
    plans = [{"domain": "even-odd"}, {"holes": [(4, 4)]}, {"domain": "all"}]
    sets = [(FRAME, {**rings, **plan}) for plan in plans]
    sets += [(random.integers(0, 50, (400, 2)), {"constraints": [pair]}) for pair in random.integers(0, 400, (6, 2))]
    for points, plan in sets:
        alone = incircle.triangulate(points.astype(dtype), **plan)
        shared = incircle.triangulate(points.astype(dtype), **plan, backend=both)
        names = ["points", "triangles", "hull", "duplicates", "pieces", "piece_starts", "piece_constraints", "regions"]
        for name in [*names, "marked"]:
            one, other = getattr(alone, name), getattr(shared, name)
            assert (one.dtype, one.tobytes()) == (other.dtype, other.tobytes()), name
        for name in ("points", "distinct", "duplicates", "triangles", "hull", "collinear", "step", "bits"):
            assert getattr(alone.report, name) == getattr(shared.report, name), name
    crossing, unknown = {"constraints": [(0, 2), (1, 3)]}, {"constraints": [(0, 99)]}
    for wrong in (crossing, unknown, {"constraints": RINGS, "holes": [(20, 20)]}):
        sentences = set()
        for backend in (None, both):
            with pytest.raises(incircle.InputError) as raised:
                incircle.triangulate(FRAME.astype(dtype), **wrong, backend=backend)
            sentences.add(str(raised.value))
        assert len(sentences) == 1, sentences


def test_progress_and_exceptions_are_those_without_constraints():
    points = np.random.default_rng(1).integers(0, 65536, (30_000, 2))
    heard = []
    incircle.triangulate(points, constraints=[(0, 1)], progress=lambda stage, done, total: heard.append(stage))
    assert list(dict.fromkeys(heard)) == ["order", "insert", "assemble"]

    def refuse(stage, done, total):
        if stage == "assemble":
            raise KeyError(stage)

    with pytest.raises(KeyError, match="assemble"):
        incircle.triangulate(points, constraints=[(0, 1)], progress=refuse)
    with pytest.raises(incircle.Cancelled):
        incircle.triangulate(points, constraints=[(0, 1)], progress=lambda *_: False)


def test_no_constraints_give_the_mesh_without_them():
    plain = incircle.triangulate(FRAME)
    for none in ([], np.empty((0, 2), dtype=int), np.empty((0, 2))):
        mesh = incircle.triangulate(FRAME, constraints=none)
        assert isinstance(mesh, incircle.ConstrainedMesh) and len(mesh.pieces) == 0
        np.testing.assert_array_equal(mesh.triangles, plain.triangles)
        assert set(mesh.regions.tolist()) == {0}
    assert not isinstance(plain, incircle.ConstrainedMesh)


def test_few_points_have_no_triangles_and_no_pieces():
    for points in ([], [(1, 2)], [(1, 2), (1, 2)]):
        mesh = incircle.triangulate(points, constraints=[])
        assert mesh.triangles.shape == (0, 3) and mesh.pieces.shape == (0, 2)
    mesh = incircle.triangulate([(0, 0), (4, 0), (2, 0)], constraints=[(0, 1)])
    assert mesh.triangles.shape == (0, 3)


def read_only(array):
    array = np.array(array)
    array.flags.writeable = False
    return array


@pytest.mark.parametrize(
    "constraints",
    [
        np.asfortranarray(OUTLINE),
        read_only(OUTLINE),
        OUTLINE.astype(">i8"),
        np.repeat(OUTLINE, 2, axis=1)[:, ::2],
        OUTLINE.astype(np.uint64),
        [list(pair) for pair in OUTLINE.tolist()],
    ],
    ids=lambda constraints: type(constraints).__name__,
)
def test_any_order_and_container_of_constraints_is_taken(constraints):
    mesh = incircle.triangulate(read_only(NOTCH), constraints=constraints, domain="non-zero")
    assert area(mesh) == 44


@pytest.mark.parametrize(
    ("constraints", "sentence"),
    [
        ([(0, 5)], "constraint 0 names point 5, but the number of points is 5"),
        ([(0, 1), (2, -1)], "constraint 1 names point -1, which cannot be: count points from 0"),
        ([(0, 2**40)], "constraint 0 names point 1099511627776, which cannot be"),
        ([(0, 2), (1, 3)], "crosses constraint"),
        ([0, 1], r"the constraints have the shape \(2,\)"),
        ([(0, 1, 2)], r"the constraints have the shape \(1, 3\)"),
        ([(0.0, 1.0)], "the type float64"),
        ([(True, False)], "the type bool"),
        (np.array([(0, None)]), "the type object"),
        ([(0, 1), (2,)], "the constraints are no array of two columns"),
        (np.ma.masked_all((2, 2), dtype=int), "the constraints are a masked array, with 4 of 4 indices masked"),
        ("text", r"the constraints have the shape \(\)"),
        (7, r"the constraints have the shape \(\)"),
    ],
)
def test_bad_constraints_are_refused_with_the_numbers(constraints, sentence):
    with pytest.raises(incircle.InputError, match=sentence):
        incircle.triangulate(NOTCH, constraints=constraints)


@pytest.mark.parametrize(
    ("choices", "sentence"),
    [
        ({"domain": "inside"}, "the domain is 'inside': choose one of all, holes, even-odd, non-zero"),
        ({"domain": 3}, "the domain is 3"),
        ({"domain": "all", "holes": [(4, 4)]}, "the domain is 'all': leave one of them out"),
        ({"lines": 9}, "9 of 8 constraints cannot be lines: give 0 to 8"),
        ({"lines": -1}, "-1 of 8 constraints"),
    ],
)
def test_bad_choices_are_refused(choices, sentence):
    with pytest.raises(incircle.ChoiceError, match=sentence):
        incircle.triangulate(FRAME, constraints=RINGS, **choices)


@pytest.mark.parametrize(
    ("choices", "sentence"),
    [
        ({"holes": [(20, 20)]}, "hole 0, counted from 0, lies outside the hull of the points"),
        ({"holes": [(4, 4), (9, 1)]}, "hole 1, counted from 0, lies on the constraint from point 1 to point 2"),
        ({"holes": [(1, 1), (4, 4)]}, "the domain is empty"),
        ({"holes": [(4.5, 4)]}, "the x of hole 0 is 4.5, which int64 cannot hold"),
        ({"holes": [4, 4]}, r"the holes have the shape \(2,\)"),
        ({"regions": [(float("nan"), 1)]}, "the x of region 0 is NaN, which int64 cannot hold"),
        ({"domain": "even-odd", "regions": [(4, 4)]}, "region 0, counted from 0, lies in a part of the hull"),
    ],
)
def test_bad_places_are_refused(choices, sentence):
    with pytest.raises(incircle.InputError, match=f"(?i){sentence}"):
        incircle.triangulate(FRAME, constraints=RINGS, **choices)


def test_places_that_are_not_finite_are_refused():
    with pytest.raises(incircle.InputError, match="the y of hole 0 is inf, which is not a finite number: remove or"):
        incircle.triangulate(FRAME.astype(float), constraints=RINGS, holes=[(4, float("inf"))])


def test_verify_finds_a_wrong_mesh():
    mesh = incircle.triangulate(NOTCH, constraints=OUTLINE, domain="even-odd")
    mesh.triangles[2] = [0, 1, 2]
    with pytest.raises(incircle.VerifyError):
        mesh.verify()


def test_a_constrained_mesh_can_be_pickled():
    mesh = pickle.loads(pickle.dumps(incircle.triangulate(FRAME, constraints=RINGS, holes=[(5, 5)])))
    assert area(mesh) == 72 and mesh.constraints_of(5, 4).tolist() == [4]
    mesh.verify()


def test_the_compiled_half_refuses_what_the_python_half_would_never_give():
    from incircle import _native
    from incircle._constraints import Asked

    none, pairs = np.empty((0, 2)), np.empty((0, 2), dtype=np.uint32)
    triangles = np.array([(0, 1, 2)], dtype=np.uint32)
    for asked in (
        Asked(pairs.astype(int), 0, "all", none, none),
        Asked(pairs, 0, "inside", none, none),
        Asked(pairs, 0, "all", none.astype(int), none),
        (pairs, 0, "all"),
        None,
    ):
        with pytest.raises((TypeError, AttributeError)):
            _native.constrained(np.eye(3, 2), triangles, [0, 1, 2], [], asked)
    # Triangles that name no points are no mesh, and no reason to end the program.
    with pytest.raises(incircle.Error):
        _native.constrained(np.eye(3, 2), triangles + 7, [0, 1, 9], [], Asked(pairs, 0, "all", none, none))
