"""Files of points from other programs into incircle, and meshes of incircle into other programs.

The points are decimals of six digits. Every file holds the same points, so every mesh must have the triangles of the
mesh of the CSV file. Prints a table in Markdown, and fails if any file differs.
"""

import gzip
import json
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import laspy
import meshio
import numpy
import shapely
import zstandard

PROGRAM = Path(sys.argv[1]).resolve()
FOLDER = Path(tempfile.mkdtemp())
COUNT = 2000
DIGITS = 6
rows = []


def incircle(*arguments):
    """Runs the command in the scratch folder and returns what it prints."""
    run = subprocess.run([PROGRAM, *map(str, arguments)], cwd=FOLDER, capture_output=True, text=True)
    if run.returncode != 0:
        sys.exit(f"incircle {' '.join(map(str, arguments))}: {run.stderr}")
    return run.stdout


def report(direction, form, program, is_right, note=""):
    rows.append(is_right)
    print(f"| {direction} | {form} | {program} | {'the same' if is_right else 'DIFFERENT'}{note} |")


def triangles(name, *options):
    """The triangles of a file of points, and the kind of its lattice."""
    said = incircle("triangulate", name, "-o", "found.npy", "--json", *options)
    return numpy.load(FOLDER / "found.npy"), json.loads(said)["lattice"]["kind"]


def comes_in(form, name, program, expected, *options):
    found, kind = triangles(name, *options)
    report("in", form, program, numpy.array_equal(found, expected), f", lattice `{kind}`")


def points_from_text(texts, expected):
    """Formats of text, whose numbers count as they are written."""
    for form, separator in [("csv", ","), ("tsv", "\t"), ("xyz", " ")]:
        lines = "".join(separator.join(pair) + "\n" for pair in texts)
        (FOLDER / f"p.{form}").write_text(lines)
        comes_in(form.upper(), f"p.{form}", "Python", expected)
    (FOLDER / "p.csv.gz").write_bytes(gzip.compress((FOLDER / "p.csv").read_bytes()))
    comes_in("CSV, gzip", "p.csv.gz", "Python's gzip", expected)
    (FOLDER / "p.csv.zst").write_bytes(zstandard.compress((FOLDER / "p.csv").read_bytes()))
    comes_in("CSV, zstd", "p.csv.zst", "zstandard", expected)
    node = f"{COUNT} 2 0 0\n" + "".join(f"{k} {x} {y}\n" for k, (x, y) in enumerate(texts))
    (FOLDER / "p.node").write_text(node)
    comes_in("Triangle's `.node`", "p.node", "Python", expected)
    pairs = [[float(x), float(y)] for x, y in texts]
    (FOLDER / "p.json").write_text(json.dumps({"points": pairs}))
    comes_in("JSON", "p.json", "Python's json", expected)
    points = shapely.MultiPoint(pairs)
    (FOLDER / "p.geojson").write_text(shapely.to_geojson(points))
    comes_in("GeoJSON", "p.geojson", "shapely", expected)
    (FOLDER / "p.wkt").write_text(shapely.to_wkt(points, rounding_precision=DIGITS, trim=True))
    comes_in("WKT", "p.wkt", "shapely", expected)
    if shutil.which("ogr2ogr"):
        points_from_gdal(expected)


def points_from_gdal(expected):
    columns = ["-oo", "X_POSSIBLE_NAMES=x", "-oo", "Y_POSSIBLE_NAMES=y", "-nlt", "POINT"]
    (FOLDER / "named.csv").write_text("x,y\n" + (FOLDER / "p.csv").read_text())
    options = ["-lco", "COORDINATE_PRECISION=6", "-lco", "RFC7946=NO"]
    files = ["gdal.geojson", "named.csv"]
    subprocess.run(["ogr2ogr", "-f", "GeoJSON", *files, *columns, *options], cwd=FOLDER, check=True)
    comes_in("GeoJSON", "gdal.geojson", "GDAL", expected)


def points_from_arrays(steps, expected):
    """Arrays: integers of every type that holds the steps, and doubles, which have a mesh of their own."""
    for kind in ["<i4", ">i4", "<i8", ">i8"]:
        numpy.save(FOLDER / "p.npy", steps.astype(kind))
        comes_in(f"`.npy` of `{kind}`", "p.npy", "numpy", expected)
    numpy.save(FOLDER / "p.npy", numpy.asfortranarray(steps.astype("<i8")))
    comes_in("`.npy` in Fortran order", "p.npy", "numpy", expected)
    numpy.save(FOLDER / "p.npy", (steps - steps.min(axis=0)).astype("<u4"))
    comes_in("`.npy` of `<u4`", "p.npy", "numpy", expected)
    numpy.savez_compressed(FOLDER / "p.npz", other=numpy.zeros(3), points=steps)
    comes_in("`.npz`", "p.npz", "numpy", expected, "--array", "points")
    for kind in ["<f4", ">f8"]:
        values = (steps / 2**20).astype(kind)
        exact = numpy.rint(values.astype("f8") * 2**40).astype("i8")
        numpy.save(FOLDER / "p.npy", exact)
        doubles, _ = triangles("p.npy")
        numpy.save(FOLDER / "p.npy", values)
        comes_in(f"`.npy` of `{kind}`", "p.npy", "numpy", doubles)


def points_from_meshes(steps, expected):
    corners = numpy.column_stack([steps, numpy.arange(COUNT)]).astype("f8")
    mesh = meshio.Mesh(corners, [("triangle", expected)])
    for form, name, binary in [("OBJ", "p.obj", None), ("PLY, ascii", "p.ply", False), ("PLY, binary", "p.ply", True)]:
        mesh.write(FOLDER / name, **({} if binary is None else {"binary": binary}))
        comes_in(form, name, "meshio", expected)
    header = f"ply\nformat binary_big_endian 1.0\nelement vertex {COUNT}\n"
    header += "".join(f"property double {axis}\n" for axis in "xyz") + "end_header\n"
    (FOLDER / "p.ply").write_bytes(header.encode() + corners.astype(">f8").tobytes())
    comes_in("PLY, binary, big endian", "p.ply", "numpy", expected)


def points_from_scanners(steps, expected):
    for version, form in [("1.2", 3), ("1.4", 6)]:
        header = laspy.LasHeader(point_format=form, version=version)
        header.scales, header.offsets = [1e-6, 1e-6, 0.01], [0.0, 0.0, 0.0]
        las = laspy.LasData(header)
        las.X, las.Y, las.Z = steps[:, 0], steps[:, 1], numpy.arange(COUNT)
        for name in ["p.las", "p.laz"]:
            las.write(FOLDER / name)
            comes_in(f"{name[2:].upper()}, version {version}, format {form}", name, "laspy", expected)


def meshes(pairs, expected):
    """Every format of meshes, read by another program: the triangles, and the points where the format has them."""
    points = numpy.array([[float(x), float(y)] for x, y in pairs])

    def goes_out(form, name, program, read, *options):
        incircle("triangulate", "p.csv", "-o", name, *options)
        found, at = read(FOLDER / name)
        is_right = numpy.array_equal(found, expected) and (at is None or numpy.array_equal(at, points))
        report("out", form, program, is_right)

    def of_meshio(path):
        mesh = meshio.read(path)
        return mesh.cells_dict["triangle"], mesh.points[:, :2]

    def of_json(path):
        mesh = json.loads(path.read_text())
        return numpy.array(mesh["triangles"]), numpy.array(mesh["points"])

    def of_geojson(path):
        features = json.loads(path.read_text())["features"]
        polygons = shapely.polygons([feature["geometry"]["coordinates"][0] for feature in features])
        corners = shapely.get_coordinates(polygons).reshape(-1, 4, 2)[:, :3]
        found = numpy.array([feature["properties"]["vertices"] for feature in features])
        assert shapely.is_ccw(shapely.get_exterior_ring(polygons)).all()
        return found if numpy.array_equal(corners, points[found]) else None, None

    goes_out("OBJ", "m.obj", "meshio", of_meshio)
    goes_out("PLY", "m.ply", "meshio", of_meshio)
    goes_out("PLY, binary", "b.ply", "meshio", of_meshio, "--format", "ply-binary")
    goes_out("VTK", "m.vtk", "meshio", of_meshio)
    goes_out("`.npy`", "m.npy", "numpy", lambda path: (numpy.load(path), None))
    goes_out("CSV", "m.csv", "numpy", lambda path: (numpy.loadtxt(path, delimiter=",", dtype="u4"), None))
    goes_out("`.ele`", "m.ele", "numpy", lambda path: (numpy.loadtxt(path, skiprows=1, dtype="u4")[:, 1:], None))
    goes_out("JSON", "m.json", "Python's json", of_json)
    goes_out("GeoJSON", "m.geojson", "shapely", of_geojson)
    if shutil.which("ogr2ogr"):
        said = subprocess.check_output(["ogrinfo", "-so", "-al", FOLDER / "m.geojson"], text=True)
        report("out", "GeoJSON", "GDAL", f"Feature Count: {len(expected)}\n" in said)


def text_of(step):
    """The decimal of a whole number of steps, with all its digits."""
    whole, fraction = divmod(abs(int(step)), 10**DIGITS)
    return f"{'-' if step < 0 else ''}{whole}.{fraction:0{DIGITS}}"


def main():
    steps = numpy.random.default_rng(1).integers(-180 * 10**DIGITS, 180 * 10**DIGITS, (COUNT, 2))
    texts = [[text_of(step) for step in pair] for pair in steps]
    numpy.save(FOLDER / "p.npy", steps)
    expected, _ = triangles("p.npy")
    print(f"{COUNT} points, {len(expected)} triangles\n")
    print("| direction | format | other program | mesh |\n|---|---|---|---|")
    points_from_text(texts, expected)
    points_from_arrays(steps, expected)
    points_from_meshes(steps, expected)
    points_from_scanners(steps, expected)
    meshes(texts, expected)
    shutil.rmtree(FOLDER)
    if not all(rows):
        sys.exit(f"{rows.count(False)} of {len(rows)} files differ")


main()
