"""The examples in docstrings and pages run, and the types are those of the compiled half."""

import doctest
import importlib
import pathlib
import pkgutil
import subprocess
import sys

import pytest

import incircle

PACKAGE = pathlib.Path(__file__).parents[1]
MODULES = ["incircle"] + [f"incircle.{module.name}" for module in pkgutil.iter_modules(incircle.__path__)]
NEEDS = {"incircle._scipy": "scipy", "incircle._matplotlib": "matplotlib"}


@pytest.mark.parametrize("name", [name for name in MODULES if name != "incircle._native"])
def test_the_examples_of_docstrings_run(name):
    if name in NEEDS:
        pytest.importorskip(NEEDS[name])
    assert doctest.testmod(importlib.import_module(name)).failed == 0


@pytest.mark.parametrize("page", ["README.md", "../../docs/python.md"])
def test_the_examples_of_pages_run(page):
    for needed in ("scipy", "matplotlib", "geopandas"):
        pytest.importorskip(needed)
    result = doctest.testfile(str(PACKAGE / page), module_relative=False)
    assert result.failed == 0 and result.attempted > 0


def test_every_public_name_has_a_text():
    for name in incircle.__all__:
        if name in ("Delaunay", "FlatError"):
            pytest.importorskip("scipy")
        assert getattr(incircle, name).__doc__, name


@pytest.mark.parametrize("command", [["mypy", str(PACKAGE / "incircle")], ["mypy.stubtest", "incircle._native"]])
def test_the_types_are_right(command):
    pytest.importorskip("mypy")
    option = "--config-file" if command[0] == "mypy" else "--mypy-config-file"
    arguments = [sys.executable, "-m", command[0], option, str(PACKAGE / "pyproject.toml"), *command[1:]]
    done = subprocess.run(arguments, capture_output=True, text=True, cwd=PACKAGE / "tests", check=False)
    assert done.returncode == 0, done.stdout + done.stderr
