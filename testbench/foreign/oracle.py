"""The right mesh of a small set of points, by brute force from docs/answer.md, and by no code of incircle."""

from itertools import combinations

Point = tuple[int, int]
Triangle = tuple[int, int, int]


def orient2d(a: Point, b: Point, c: Point) -> int:
    """Twice the area of the triangle: positive if its corners are counter-clockwise."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def incircle(a: Point, b: Point, c: Point, d: Point) -> int:
    """Positive if d lies in the circle of the counter-clockwise a, b, c; 0 if it lies on the circle."""
    rows = [(p[0] - d[0], p[1] - d[1], (p[0] - d[0]) ** 2 + (p[1] - d[1]) ** 2) for p in (a, b, c)]
    (ax, ay, az), (bx, by, bz), (cx, cy, cz) = rows
    return ax * (by * cz - bz * cy) - ay * (bx * cz - bz * cx) + az * (bx * cy - by * cx)


def canonical(triangle: Triangle) -> Triangle:
    """The same triangle with its smallest corner first."""
    a, b, c = triangle
    return min((a, b, c), (b, c, a), (c, a, b))


def is_in_fan(triangle: Triangle, cocircular: list[int], points: list[Point]) -> bool:
    """True if the tie rule takes this triangle of points on one empty circle.

    Its diagonals start at the smallest point of the circle. So the triangle has that corner, and no point of the circle
    lies between the two others, which would then be on the outer side of their edge.
    """
    apex = min(cocircular, key=lambda i: points[i])
    if apex not in triangle:
        return False
    place = triangle.index(apex)
    left, right = triangle[(place + 1) % 3], triangle[(place + 2) % 3]
    return not any(orient2d(points[left], points[right], points[i]) < 0 for i in cocircular)


def delaunay(points: list[Point]) -> list[Triangle]:
    """The triangles of the canonical Delaunay mesh, sorted; of equal points the first one counts. O(n^4)."""
    distinct = [i for i, point in enumerate(points) if point not in points[:i]]
    mesh: list[Triangle] = []
    for i, j, k in combinations(distinct, 3):
        area = orient2d(points[i], points[j], points[k])
        if area == 0:
            continue
        triangle = (i, j, k) if area > 0 else (i, k, j)
        a, b, c = (points[corner] for corner in triangle)
        sides = [(incircle(a, b, c, points[m]), m) for m in distinct]
        cocircular = [m for side, m in sides if side == 0]
        if all(side <= 0 for side, _ in sides) and is_in_fan(triangle, cocircular, points):
            mesh.append(canonical(triangle))
    return sorted(mesh)
