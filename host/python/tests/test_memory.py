"""Too little memory is an exception, and the package goes on working."""

import subprocess
import sys

import pytest

PROGRAM = """
import resource
import numpy as np
import incircle

points = np.random.default_rng(1).random((2_000_000, 2))
whole = (points[:1_000_000] * 2**20).astype(np.int64)
small = incircle.triangulate(points[:100_000])
living = incircle.Triangulation(points[:1000])
surface = incircle.Surface(points[:1000], points[:1000, 0])
with open("/proc/self/statm") as file:
    used = int(file.read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (used + 150_000_000, resource.RLIM_INFINITY))

def insert_one_by_one():
    mesh = incircle.Triangulation()
    for point in points:
        mesh.insert(point)

CALLS = {
    "triangulate": lambda: incircle.triangulate(points),
    "living": lambda: incircle.Triangulation(points),
    "insert": insert_one_by_one,
    "insert_all": lambda: living.insert_all(points),
    "nearest_all": lambda: living.nearest_all(np.repeat(points, 2, axis=0)),
    "constraints": lambda: incircle.triangulate(points, constraints=[(0, 1)]),
    "voronoi": lambda: incircle.voronoi(whole),
    "lloyd": lambda: incircle.lloyd(whole, 1),
    "surface": lambda: incircle.Surface(points, points[:, 0]),
    "values": lambda: surface(np.repeat(points, 2, axis=0)),
}
for name, call in CALLS.items():
    try:
        call()
    except incircle.OutOfMemoryError as error:
        assert isinstance(error, MemoryError) and "there is no memory for " in str(error), (name, error)
    except MemoryError:
        # numpy itself had no memory.
        assert name in ("nearest_all", "values"), name
    else:
        raise AssertionError(f"{name} found memory")
assert incircle.triangulate(points[:1000]).report.points == 1000
assert small.neighbors.shape == small.triangles.shape
assert len(living) == 1000
print("done")
"""


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the memory of a process is limited as on Linux")
def test_too_little_memory_is_an_exception():
    done = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True)
    assert done.stdout == "done\n", done.stderr
