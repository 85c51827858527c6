"""Groups airports by the lengths of edges, and draws the alpha shape of each group.

Two airports are of one group if a chain of edges, each shorter than LENGTH, leads from one to the other. The alpha
shape of a group consists of its triangles whose circumcircle has a radius below LENGTH. The Delaunay triangulation has the nearest
neighbour of every point among its edges, so both need no other pairs.

Run it with the file of airports and the name of a picture: clusters.py ../../testbench/data/airports.csv islands.svg
"""

import sys

import numpy as np

import incircle

BOX = (115.0, 5.0, 127.5, 19.5)
"""The Philippines: the lowest and highest longitude and latitude."""
LENGTH = 0.95
"""In degrees, some 105 km there."""


def groups(count, edges):
    """The lowest index of the group of each point."""
    lowest = np.arange(count)
    while True:
        near = lowest.copy()
        np.minimum.at(near, edges[:, 0], lowest[edges[:, 1]])
        np.minimum.at(near, edges[:, 1], lowest[edges[:, 0]])
        near = near[near]
        if (near == lowest).all():
            return lowest
        lowest = near


def radii(corners):
    """The circumradius of each triangle."""
    a, b, c = (corners[:, k] - corners[:, k - 1] for k in range(3))
    twice = np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])
    return np.prod([np.hypot(*side.T) for side in (a, b, c)], axis=0) / (2 * twice)


def clusters(points):
    """The group of each point, and the triangles of the alpha shape."""
    mesh = incircle.triangulate(points)
    lengths = np.hypot(*(points[mesh.edges[:, 0]] - points[mesh.edges[:, 1]]).T)
    found = groups(len(points), mesh.edges[lengths < LENGTH])
    is_one = (found[mesh.triangles] == found[mesh.triangles[:, :1]]).all(axis=1)
    return found, mesh.triangles[is_one & (radii(points[mesh.triangles]) < LENGTH)]


def main(file, picture):
    points = np.loadtxt(file, delimiter=",", skiprows=1, usecols=(0, 1))
    inside = (points >= BOX[:2]).all(axis=1) & (points <= BOX[2:]).all(axis=1)
    points = np.unique(points[inside], axis=0)
    found, shape = clusters(points)
    names, sizes = np.unique(found, return_counts=True)
    print(f"{len(points)} airports, {len(names)} groups, the largest of {sizes.max()}; {len(shape)} triangles")
    draw(points, np.searchsorted(names, found), shape, picture)


def draw(points, colours, shape, picture):
    import matplotlib

    matplotlib.use("Agg")
    matplotlib.rcParams["svg.hashsalt"] = "incircle"
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(figsize=(5, 6))
    axes.tripcolor(*points.T, colours[shape[:, 0]], triangles=shape, cmap="tab10", vmin=0, vmax=9, alpha=0.5)
    axes.scatter(*points.T, c=colours, cmap="tab10", vmin=0, vmax=9, s=8)
    axes.set_aspect("equal")
    axes.axis("off")
    figure.savefig(picture, metadata={"Date": None} if picture.endswith("svg") else None, bbox_inches="tight")


if __name__ == "__main__":
    main(*sys.argv[1:])
