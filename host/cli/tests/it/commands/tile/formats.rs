//! Tests of what is read and written beside arrays of integers.

use super::{array, same_mesh, split_and_solve};
use crate::common::Scratch;

#[test]
fn every_format_of_a_mesh_is_that_of_triangulate() {
    let scratch = Scratch::new();
    let points: Vec<[i64; 2]> = (0..300).map(|k| [k * k % 101, k * 37 % 41]).collect();
    scratch.write("p.npy", array(&points));
    split_and_solve(&scratch, "p.npy", 50, "t");
    for format in ["npy", "csv", "ele", "obj", "ply", "json", "vtk", "geojson", "svg", "npy.gz", "csv.zst"] {
        scratch.run(&format!("triangulate p.npy -o right.{format} -q")).ok();
        scratch.run(&format!("tile join t -o m.{format} -q")).ok();
        let bytes = |name: &str| std::fs::read(scratch.path(&format!("{name}.{format}"))).expect("it is there");
        assert!(bytes("m") == bytes("right"), "{format}");
    }
    let csv = scratch.run("tile join t -o - --format csv -q").ok();
    assert_eq!(csv.stdout, scratch.read("right.csv"));
    scratch.run("tile join t -o mesh").fails(2, &["add --format"]);
    scratch.run("tile join t -o - --format npy --json").fails(2, &["--json"]);
    // Points that changed since are no points of this mesh.
    scratch.write("p.npy", array(&points[1..]));
    scratch.run("tile join t -o m.obj").fails(3, &["p.npy has changed"]);
}

#[test]
fn unordered_triangles_are_the_same_ones() {
    let scratch = Scratch::new();
    scratch.run("generate kuzmin -n 3000 -o p.npy").ok();
    scratch.run("triangulate p.npy -o right.csv -q").ok();
    split_and_solve(&scratch, "p.npy", 200, "t");
    scratch.run("tile join t -o m.csv --unordered -q").ok();
    let (right, found) = (scratch.read("right.csv"), scratch.read("m.csv"));
    let rows = |text: &str| {
        let mut rows: Vec<[u32; 3]> = Vec::new();
        for row in text.lines() {
            let corners: Vec<u32> = row.split(',').map(|corner| corner.parse().expect("a number")).collect();
            rows.push(corners.try_into().expect("three corners"));
        }
        rows.sort_unstable();
        rows
    };
    assert_ne!(right, found);
    assert_eq!(rows(&right), rows(&found));
    scratch.run("tile join t -o m.npy --unordered -q").ok();
    scratch.run("triangulate p.npy -o right.npy -q").ok();
    let length = |name: &str| std::fs::metadata(scratch.path(name)).expect("it is there").len();
    assert_eq!(length("m.npy"), length("right.npy"));
    scratch.run("tile join t -o m.obj --unordered").fails(2, &["--unordered"]);
}

#[test]
fn decimals_and_doubles_on_a_lattice_are_taken() {
    let scratch = Scratch::new();
    for numbers in ["signed", "decimal", "f32"] {
        for extension in ["npy", "csv"] {
            if numbers == "decimal" && extension == "npy" {
                continue;
            }
            scratch.run(&format!("generate kuzmin -n 900 --numbers {numbers} -o p.{extension}")).ok();
            scratch.run(&format!("triangulate p.{extension} -o right.npy -q")).ok();
            let count = same_mesh(&scratch, &format!("p.{extension}"), 100, "right.npy");
            assert!(count > 8, "{numbers}.{extension}");
        }
    }
}

#[test]
fn points_without_a_lattice_are_refused() {
    let scratch = Scratch::new();
    scratch.run("generate uniform -n 100 --numbers double -o p.npy").ok();
    scratch.run("tile split p.npy --points 10 -o t").fails(3, &["p.npy", "no common lattice", "work in one memory"]);
    scratch.write("wide.npy", array(&[[0, 0], [1 << 32, 5]]));
    scratch.run("tile split wide.npy --points 10 -o t").fails(3, &["33 bits"]);
    scratch.write("a.npy", array(&[[0, 0], [3, 5]]));
    scratch.write("b.npy", array(&[[1 << 32, 5]]));
    scratch.run("tile split a.npy b.npy --points 10 -o t").fails(3, &["33 bits"]);
    scratch.write("bad.csv", "1,2\nx,4\n");
    scratch.run("tile split a.npy bad.csv --points 10 -o t").fails(3, &["bad.csv: row 2"]);
    scratch.run("tile split a.npy gone.npy --points 10 -o t").fails(3, &["gone.npy"]);
    scratch.run("tile split - --points 10 -o t").fails(2, &["standard input", "read twice"]);
    scratch.run("tile split a.npy --points 10 -o t --class 2").fails(2, &["--class"]);
    assert_eq!(scratch.files(), ["a.npy", "b.npy", "bad.csv", "p.npy", "wide.npy"]);
}

#[test]
fn wrong_numbers_of_a_large_array_are_named_by_their_place() {
    let scratch = Scratch::new();
    let mut bytes = array(&vec![[1, 2]; 200_000]);
    let header = bytes.len() - 200_000 * 16;
    // As unsigned numbers, one of them is beyond 64 bits.
    let at = bytes.windows(3).position(|window| window == b"<i8").expect("the type") + 1;
    bytes[at] = b'u';
    bytes[header + 150_000 * 16 + 7] = 0xff;
    scratch.write("p.npy", &bytes);
    let places = ["point 150001", "x"];
    scratch.run("triangulate p.npy -o m.npy").fails(3, &places);
    scratch.run("tile split p.npy --points 1000 -o t").fails(3, &places);
    assert_eq!(scratch.files(), ["p.npy"]);
}
