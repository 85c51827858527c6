"""Measures the package beside the library itself and beside SciPy, in interleaved pairs, and compares the answers.

Run it with the Python of an environment that has the package and SciPy. For each row it prints the medians of the times
of the processor in milliseconds, and the medians of the ratios of neighbouring runs: of the processor's time, and of the
time on the clock. Other programs on the machine disturb the latter more.
"""

import argparse
import statistics
import time

import numpy as np
from scipy import spatial

import incircle
from incircle import _native


def seconds(call):
    """The seconds of a call on the clock and of the processor, and its answer."""
    start, began = time.perf_counter(), time.process_time()
    answer = call()
    return (time.perf_counter() - start, time.process_time() - began), answer


def by_python(points, threads):
    took, mesh = seconds(lambda: incircle.triangulate(points, threads=threads))
    return took, mesh.triangles


def sorted_triangles(simplices):
    rows = np.sort(simplices, axis=1)
    return rows[np.lexsort(rows.T)]


def by_class(kind, points):
    """The time of a class until the attributes that SciPy always computes are there."""
    took, mesh = seconds(lambda: kind(points))
    assert len(mesh.simplices) == len(mesh.neighbors) == len(mesh.equations)
    return took, mesh.simplices


def row(name, one, other, rounds, same):
    """Runs two calls by turns, the first one first in every second round, and prints a row."""
    pairs = []
    for turn in range(rounds + 1):
        calls = (one, other) if turn % 2 else (other, one)
        (first, answer), (second, reference) = calls[0](), calls[1]()
        assert same(answer, reference), "the answers differ"
        del answer, reference
        # The first round warms up.
        if turn:
            pairs.append((first, second) if turn % 2 else (second, first))
    ours, theirs = (statistics.median(processor for _, processor in times) * 1e3 for times in zip(*pairs))
    clock, processor = (statistics.median(one[kind] / other[kind] for one, other in pairs) for kind in (0, 1))
    print(f"| {name} | {ours:.0f} | {theirs:.0f} | {processor:.3f} | {clock:.3f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--rounds", type=int, default=15)
    parser.add_argument("--points", type=int, default=1_000_000, help="points for the library")
    parser.add_argument("--scipy-points", type=int, default=100_000, help="points for SciPy")
    given = parser.parse_args()
    generator = np.random.default_rng(1)
    doubles = generator.random((given.points, 2))
    grid = generator.integers(0, 1 << 24, (given.points, 2), dtype=np.uint32)
    print("| what | incircle in Python, ms | beside it, ms | ratio | ratio on the clock |\n|---|---:|---:|---:|---:|")
    for name, points in (("doubles", doubles), ("uint32 of 24 bits", grid)):
        for threads in (1, None):
            label = f"`triangulate`, {given.points:,} {name}, {'one thread' if threads else 'all threads'}: the library"
            ours = lambda: by_python(points, threads)  # noqa: E731
            row(label, ours, lambda: _native.library(points, threads), given.rounds, np.array_equal)
    points = generator.random((given.scipy_points, 2))
    row(
        f"`Delaunay`, {given.scipy_points:,} doubles: SciPy",
        lambda: by_class(incircle.Delaunay, points),
        lambda: by_class(spatial.Delaunay, points),
        given.rounds,
        lambda one, other: np.array_equal(sorted_triangles(one), sorted_triangles(other)),
    )


if __name__ == "__main__":
    main()
