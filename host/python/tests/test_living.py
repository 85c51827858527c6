"""`incircle.Triangulation`: the mesh that lives, its answers, and its errors."""

import copy
import pickle
import threading

import numpy as np
import pytest

import incircle

SQUARE = [(0, 0), (4, 0), (4, 4), (0, 4)]
TYPES = ("float64", "float32", "int64", "int32", "uint32")


def assert_same_as_a_new_mesh(mesh):
    found, expected = mesh.mesh(), incircle.triangulate(mesh.points)
    for name in ("points", "triangles", "hull", "duplicates"):
        np.testing.assert_array_equal(getattr(found, name), getattr(expected, name))
    found.verify()


@pytest.mark.parametrize("dtype", TYPES)
def test_changes_give_the_mesh_of_the_living_points(dtype):
    generator = np.random.default_rng(11)
    mesh = incircle.Triangulation(dtype=dtype)
    assert mesh.dtype == dtype and len(mesh) == 0 and mesh.mesh().is_collinear
    indices = mesh.insert_all(generator.integers(0, 30, (300, 2)))
    assert indices.tolist() == list(range(300)) and mesh.next_index == 300
    assert_same_as_a_new_mesh(mesh)
    for index in generator.permutation(300)[:100]:
        mesh.delete(index)
        assert index not in mesh
    assert_same_as_a_new_mesh(mesh)
    for index in mesh.indices[:50]:
        place = tuple(generator.integers(0, 30, 2).tolist())
        mesh.move(index, place)
        assert mesh.point(index) == place
    assert_same_as_a_new_mesh(mesh)
    mesh.move_all(generator.integers(0, 9, (200, 2)))
    assert_same_as_a_new_mesh(mesh)
    old = mesh.indices
    assert mesh.renumber().tolist() == old.tolist() and mesh.indices.tolist() == list(range(200))
    assert_same_as_a_new_mesh(mesh)


def test_questions_about_places_have_exact_answers():
    mesh = incircle.Triangulation([(x, y) for y in range(5) for x in range(5)])
    assert mesh.locate((2, 2)) == ("vertex", (12,))
    assert mesh.locate((-1, 2)).kind == "outside" and mesh.locate((-1, 2)).vertices == (20, 15)
    assert mesh.k_nearest((2, 2), 5).tolist() == [12, 11, 7, 17, 13]
    assert mesh.k_nearest((2, 2), 10**30).size == 25 and mesh.k_nearest((2, 2), 0).size == 0
    assert mesh.within_circle((2, 2), 1.0).tolist() == [7, 11, 12, 13, 17]
    assert mesh.within_circle((2, 2), -1).size == 0
    assert mesh.within_rectangle((3, 2), (2, 3)).tolist() == [12, 13, 17, 18]
    assert mesh.nearest_all([(0, 0), (9, 9)]).tolist() == [0, 24]
    square = incircle.Triangulation(SQUARE)
    assert square.segment((-1, 2), (5, 2)).tolist() == [[0, 2, 3], [0, 1, 2]]
    assert square.locate((2, 2)) == incircle.Location("edge", (0, 2))
    assert square.star(2).tolist() == [[2, 3, 0], [2, 0, 1]]
    assert square.hull.tolist() == [0, 1, 2, 3] and sorted(square.vertices.tolist()) == [0, 1, 2, 3]
    assert sorted(square.edges.tolist()) == [[0, 1], [0, 2], [0, 3], [1, 2], [2, 3]]
    assert sorted(square.triangles.tolist()) == [[0, 1, 2], [0, 2, 3]] and square.nbytes > 0


def test_an_empty_triangulation_answers():
    mesh = incircle.Triangulation()
    assert mesh.nearest((0, 0)) is None and mesh.locate((0, 0)) == ("none", ())
    assert mesh.nearest_all([(1, 2)]).tolist() == [-1] and mesh.points.shape == (0, 2)
    kinds, vertices = mesh.locate_all(np.empty((0, 2)))
    assert kinds.shape == (0,) and vertices.shape == (0, 3)
    mesh.move_all(np.empty((0, 2)))
    assert mesh.renumber().size == 0


def test_duplicates_name_their_place():
    mesh = incircle.Triangulation([(0.1, 0.2), (0.1, 0.2), (1, 1), (2, 0)])
    assert mesh.place_of(1) == 0 and mesh.locate((0.1, 0.2)) == ("vertex", (0,))
    mesh.delete(0)
    assert mesh.place_of(1) == 1 and 0 not in mesh and 1 in mesh and "1" not in mesh and -1 not in mesh


@pytest.mark.parametrize("call", ["delete", "point", "place_of", "neighbors", "star", "move", "delete_all"])
def test_indices_that_are_not_living_are_refused(call):
    mesh = incircle.Triangulation(SQUARE)
    mesh.delete(1)
    before = mesh.points

    def ask(index):
        if call == "move":
            return mesh.move(index, (1, 1))
        return getattr(mesh, call)([0, index] if call == "delete_all" else index)

    with pytest.raises(incircle.UnknownPointError, match="point 1 was deleted: its index is never used again"):
        ask(1)
    for index in (4, -1, 2**32 - 1, 2**32, 2**70):
        with pytest.raises(IndexError, match=f"there is no point {index}: so far the indices are those below 4"):
            ask(index)
    with pytest.raises(TypeError):
        ask("1")
    np.testing.assert_array_equal(mesh.points, before)


@pytest.mark.parametrize(
    ("dtype", "value", "shown"),
    [
        ("int32", 0.5, "0.5"),
        ("int32", 2**31, "2147483648"),
        ("int64", 2**63, "9223372036854775808"),
        ("int64", float(2**63), "9.223372036854775808e.18"),
        ("uint32", -1, "-1"),
        ("uint32", -0.5, "-0.5"),
        ("float32", 0.1, "0.1"),
        ("float64", 2**53 + 1, "9007199254740993"),
        ("float64", np.longdouble(1) + np.finfo(np.longdouble).eps, "1.0000"),
    ],
)
def test_numbers_that_the_type_cannot_hold_are_refused(dtype, value, shown):
    mesh = incircle.Triangulation(dtype=dtype)
    with pytest.raises(incircle.InputError, match=f"the y of the place is .*, which {dtype} cannot hold"):
        mesh.insert((0, value))
    with pytest.raises(incircle.Error):
        mesh.insert_all([(0, value)])
    with pytest.raises(incircle.Error):
        mesh.within_rectangle((0, 0), (0, value))
    assert len(mesh) == 0 and mesh.next_index == 0


def test_any_number_that_fits_is_taken():
    for dtype in TYPES:
        mesh = incircle.Triangulation(dtype=dtype)
        for one in (1, 1.0, np.float32(1), np.float64(1), np.int8(1), np.uint64(1), np.longdouble(1), True):
            mesh.insert((one, 2))
        assert mesh.points.tolist() == [[1, 2]] * 8 and mesh.points.dtype == dtype
    mesh = incircle.Triangulation(np.zeros((1, 2), dtype=np.float32))
    assert mesh.insert((np.float32(0.1), 0.5)) == 1
    assert mesh.insert_all(np.array([(0.1, 3)], dtype=np.float32)).tolist() == [2]


def test_places_that_are_no_numbers_are_refused():
    mesh = incircle.Triangulation([(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)])
    for value in (float("nan"), float("inf")):
        with pytest.raises(incircle.InputError, match="infinite or not a number"):
            mesh.insert((0.0, value))
        with pytest.raises(incircle.InputError, match="infinite or not a number"):
            mesh.move(0, (value, 0.0))
        with pytest.raises(incircle.InputError, match="the y of point 1 is (nan|inf), which is not a finite number"):
            mesh.insert_all([(0.0, 5.0), (0.0, value)])
        with pytest.raises(incircle.InputError, match="which is not a finite number"):
            incircle.Triangulation([(0.0, value)])
        assert mesh.locate((0.0, value)).kind == "none" and mesh.nearest((value, 0)) is None
    for place in (5, None, (1,), (1, 2, 3)):
        with pytest.raises(incircle.InputError, match="give two coordinates"):
            mesh.insert(place)
    for place in (("a", 1), (1j, 1), (None, 1)):
        with pytest.raises(TypeError):
            mesh.insert(place)
    with pytest.raises(incircle.InputError, match="2 new places for 3 living points"):
        mesh.move_all([(0, 0), (1, 1)])
    with pytest.raises(incircle.InputError, match="of the 2 indices only 1 differ"):
        mesh.delete_all([0, 0])
    with pytest.raises(incircle.ChoiceError, match="the type int8 is not one of"):
        incircle.Triangulation(dtype="int8")
    with pytest.raises(incircle.ChoiceError, match="-1 points cannot be the nearest"):
        mesh.k_nearest((0, 0), -1)
    assert len(mesh) == 3


@pytest.mark.parametrize(
    ("indices", "error", "sentence"),
    [
        (np.array([True, False, False, False]), incircle.NumberTypeError, "the indices have the type bool"),
        ([0.0, 1.0], incircle.NumberTypeError, "the indices have the type float64: give whole numbers"),
        ("12", incircle.NumberTypeError, "the indices have the type <U2"),
        (None, TypeError, "NoneType"),
        ([[0], [1, 2]], incircle.InputError, "the indices are no array"),
        (np.ma.array([0, 1], mask=[0, 1]), incircle.InputError, "a masked array, with 1 of 2 indices masked"),
    ],
)
def test_lists_that_name_no_indices_are_refused(indices, error, sentence):
    mesh = incircle.Triangulation(SQUARE)
    with pytest.raises(error, match=sentence):
        mesh.delete_all(indices)
    assert len(mesh) == 4
    mesh.delete_all([])
    mesh.delete_all(np.array([[0, 1]], dtype=np.uint8))
    assert mesh.indices.tolist() == [2, 3]


def test_a_coordinate_that_changes_the_triangulation_is_an_error():
    mesh = incircle.Triangulation(np.array(SQUARE, dtype=float))

    class Changing:
        def __float__(self):
            mesh.delete(0)
            return 1.0

    with pytest.raises(RuntimeError, match="borrowed"):
        mesh.insert((Changing(), 1))
    assert len(mesh) == 4
    assert_same_as_a_new_mesh(mesh)


def test_a_second_thread_cannot_change_a_triangulation_meanwhile():
    mesh = incircle.Triangulation(np.random.default_rng(0).random((200_000, 2)))
    refused = []

    def ask():
        while not refused and thread.is_alive():
            try:
                len(mesh)
            except RuntimeError as error:
                refused.append(str(error))

    places = mesh.points[::-1].copy()
    thread = threading.Thread(target=mesh.move_all, args=(places,))
    thread.start()
    ask()
    thread.join()
    assert len(mesh) == 200_000
    np.testing.assert_array_equal(mesh.points, places)
    assert all("borrowed" in text for text in refused)


def test_a_copy_has_a_life_of_its_own():
    mesh = incircle.Triangulation(SQUARE)
    for other in (mesh.copy(), copy.copy(mesh), copy.deepcopy(mesh)):
        other.delete(0)
        assert len(mesh) == 4 and len(other) == 3 and other.dtype == mesh.dtype
    assert repr(mesh) == "Triangulation(4 points of int64)"
    with pytest.raises(TypeError, match="a Triangulation cannot be pickled: pickle its points"):
        pickle.dumps(mesh)
