"""The examples run on the data of the repository, and their answers are those of slower definitions."""

import importlib.util
import pathlib

import numpy as np
import pytest

PACKAGE = pathlib.Path(__file__).parents[1]
AIRPORTS = PACKAGE / "../../testbench/data/airports.csv"


def example(name):
    spec = importlib.util.spec_from_file_location(name, PACKAGE / "examples" / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_groups_are_those_of_all_pairs():
    clusters = example("clusters")
    points = np.random.default_rng(8).integers(0, 90, (120, 2)) / 8
    found, shape = clusters.clusters(points)
    expected = np.arange(120)
    near = ((points[:, None] - points) ** 2).sum(axis=2) < clusters.LENGTH**2
    for _ in range(120):
        expected = np.array([expected[row].min() for row in near])
    # A point at the place of an earlier one has no edges, and stays alone.
    first = [points[:k].tolist().count(points[k].tolist()) == 0 for k in range(120)]
    np.testing.assert_array_equal(found[first], expected[first])
    assert len(shape) > 0 and (found[shape] == found[shape[:, :1]]).all()


def test_airports_are_drawn(tmp_path, capsys):
    pytest.importorskip("matplotlib")
    picture = tmp_path / "islands.svg"
    example("clusters").main(str(AIRPORTS), str(picture))
    assert capsys.readouterr().out.startswith("106 airports, ") and picture.stat().st_size > 10_000
