//! Plans that `triangulate` and `verify` refuse, each with one sentence that names the file and what is wrong.

use super::constraints::{made, refused, POLY};
use crate::common::Scratch;

#[test]
fn files_without_a_constraint_are_refused() {
    let with = |edges: &str, parts: &[&str]| {
        let scratch = Scratch::new();
        scratch.write("p.csv", "0,0\n4,0\n4,4\n0,4\n");
        scratch.write("e.csv", edges);
        for command in ["triangulate p.csv -o m.ele", "verify p.csv m.ele"] {
            scratch.run(&format!("{command} --constraints e.csv")).fails(3, &["e.csv: "]).fails(3, parts);
        }
        assert_eq!(scratch.files(), ["e.csv", "p.csv"]);
    };
    let due = "a constraint is a row of two point indices, counted from 0, such as '0,1'";
    for empty in ["", "\n\n", "# none\n", "\u{feff}"] {
        with(empty, &["the file has no constraint", due]);
    }
    with("from,to\n", &["row 1, 'from' and 'to', has no number, and no row follows", due]);
    with("junk", &["row 1 has 1 column", "a row of two point indices"]);
    with("junk\n0,1\n", &["row 1 has 1 column"]);
    with("a,b,c\n0,1\n", &["row 1 has 3 columns"]);
    with("from,to\njunk,junk\n0,1\n", &["row 2, column 1", "'junk' is not a point index"]);
    with("0,1\nfrom,to\n", &["row 2, column 1", "'from' is not a point index"]);
}

#[test]
fn verify_refuses_plans_without_a_mesh_with_the_words_of_triangulate() {
    let both = |name: &str, content: &str, options: &str, parts: &[&str]| {
        let scratch = Scratch::new();
        scratch.write(name, content);
        scratch.write("e.csv", "0,1\n1,2\n");
        scratch.write("one.csv", "0,1\n");
        scratch.run(&format!("triangulate {name} -o all.ele --domain all")).ok();
        let made = scratch.run(&format!("triangulate {name} -o m.ele {options}")).fails(3, parts);
        let checked = scratch.run(&format!("verify {name} all.ele {options}")).fails(3, parts);
        assert_eq!(made.stderr, checked.stderr);
    };
    let (one, way) = ("add the missing constraint, or take all triangles of the hull by --domain all", "run one way");
    let all = "close the rings around the domain, or give --domain all";
    let square = "0,0\n4,0\n4,4\n0,4\n";
    both(
        "p.csv",
        square,
        "--constraints e.csv --domain even-odd",
        &["e.csv: ", "not closed", "point 0 is odd (1)", one],
    );
    both("p.csv", square, "--constraints e.csv --domain non-zero", &["e.csv: ", "1 of its constraints begin", way]);
    both("p.csv", square, "--constraints one.csv --domain holes", &["is empty: none of the 2 triangles", all]);
    let open = "4 2 0 0\n1 0 0\n2 4 0\n3 4 4\n4 0 4\n1 0\n1 1 2\n0\n";
    both("p.poly", open, "", &["p.poly: the domain is empty: none of the 2 triangles", all]);
    both(
        "p.poly",
        &POLY.replace("1 4 4\n", "1 40 4\n"),
        "",
        &["hole 1, counted from 1, at (40, 4), lies outside the hull"],
    );
    both("p.poly", &POLY.replace("1 4 4\n", "1 4 2\n"), "", &["hole 1, counted from 1, at (4, 2), lies on"]);
    // The mesh of another domain is wrong, and the message says which domain was asked for.
    let scratch = Scratch::new();
    scratch.write("p.poly", POLY);
    scratch.run("triangulate p.poly -o all.ele --domain all").ok();
    let hint = "(the domain is 'holes', because --domain is not given: give the one with which the mesh was made)";
    scratch.run("verify p.poly all.ele").fails(1, &["the domain lies on", hint]);
    scratch.run("verify p.poly all.ele --domain all").ok();
    let other = scratch.run("verify p.poly all.ele --domain holes").fails(1, &["the domain lies on"]);
    assert!(!other.stderr.contains("--domain"), "{other:?}");
}

#[test]
fn holes_outside_their_ring_are_refused() {
    let square =
        |low: u32, high: u32| format!("[[{low},{low}],[{high},{low}],[{high},{high}],[{low},{high}],[{low},{low}]]");
    let polygon = |rings: &[String]| format!(r#"{{"type":"Polygon","coordinates":[{}]}}"#, rings.join(","));
    let told = |ring: u32, polygon: u32| {
        format!("ring {ring} of polygon {polygon}, both counted from 1, is a hole that begins at (")
    };
    let outside = [square(0, 9), square(2, 4), square(10, 12), square(5, 6)];
    refused("p.geojson", &polygon(&outside), "", &[&told(3, 1), "begins at (10, 10) and lies outside ring 1"]);
    refused("p.geojson", &polygon(&outside), "--domain non-zero --backend model", &[&told(3, 1)]);
    refused("p.geojson", &polygon(&outside), "--crossings snap", &[&told(3, 1)]);
    let (outer, inner) = (square(0, 9), "[[9,9],[12,9],[12,12],[9,12],[9,9]]".to_owned());
    refused("p.geojson", &polygon(&[outer, inner]), "", &[&told(2, 1)]);
    refused(
        "p.wkt",
        "MULTIPOLYGON (((0 0, 9 0, 9 9, 0 9, 0 0)), ((20 0, 29 0, 29 9, 20 0), (1 1, 3 1, 3 3, 1 1)))",
        "",
        &[&told(2, 2), "(1, 1)"],
    );
    // The hole has its corners on the ring, but lies in a notch of it.
    let notch = "POLYGON ((0 0, 8 0, 8 4, 4 4, 4 8, 0 8, 0 0), (8 4, 4 8, 4 4, 8 4))";
    refused("p.wkt", notch, "", &[&told(2, 1)]);
    // With decimals that are no doubles.
    refused("p.wkt", &notch.replace('4', "0.7").replace('8', "1.4"), "", &[&told(2, 1)]);
    // Verify says the same, and with all triangles such a ring does no harm.
    let scratch = Scratch::new();
    scratch.write("p.wkt", notch);
    scratch.run("triangulate p.wkt -o all.ele --domain all").ok();
    scratch.run("verify p.wkt all.ele --domain all").ok();
    scratch.run("verify p.wkt all.ele").fails(3, &["p.wkt: ", &told(2, 1)]);
    // Legal: a hole that touches the ring in points, along an edge, in a hole, or is an island of another polygon.
    for legal in [
        "POLYGON ((0 0, 8 0, 8 8, 0 8, 0 0), (0 0, 4 2, 2 4, 0 0))",
        "POLYGON ((0 0, 8 0, 8 8, 0 8, 0 0), (0 4, 8 4, 4 6, 0 4))",
        "POLYGON ((0 0, 8 0, 8 8, 0 8, 0 0), (2 0, 6 0, 4 2, 2 0))",
        "POLYGON ((0 0, 8 0, 8 8, 0 8, 0 0), (1 1, 7 1, 7 7, 1 7, 1 1), (2 2, 6 2, 6 6, 2 2))",
        "MULTIPOLYGON (((0 0, 8 0, 8 8, 0 8, 0 0), (1 1, 7 1, 7 7, 1 7, 1 1)), ((3 3, 5 3, 5 5, 3 3)))",
        "POLYGON ((0 0, 8 0, 8 8, 0 8, 0 0), (2 2, 2 2, 2 2, 2 2), EMPTY)",
        "POLYGON ((0 0, 9 7, 9 0, 0 8, 0 0), (8 2, 8 3, 8.5 3, 8 2))",
    ] {
        let snaps = if legal.contains("9 7") { "--crossings snap" } else { "" };
        let scratch = Scratch::new();
        scratch.write("p.wkt", legal);
        scratch.run(&format!("triangulate p.wkt -o m.obj {snaps}")).ok();
        scratch.run(&format!("verify p.wkt m.obj {snaps}")).ok();
    }
}

#[test]
fn attributes_of_regions_are_numbers() {
    let poly = |attribute: &str| {
        format!("4 2 0 0\n0 0 0\n1 4 0\n2 4 4\n3 0 4\n4 0\n0 0 1\n1 1 2\n2 2 3\n3 3 0\n0\n1\n0 2 1 {attribute}\n")
    };
    refused("p.poly", &poly("sand"), "", &["row 13, column 4", "'sand' is not a number"]);
    refused("p.poly", &poly("1e400 0.1"), "", &["row 13, column 4", "not a finite number"]);
    refused("p.poly", &poly("\u{1b}[2J"), "", &["row 13, column 4"]);
    let (scratch, _) = made("p.poly", &poly("-1e9 0.1"), "");
    assert_eq!(scratch.read("m.ele"), "2 3 1\n0 0 1 2 -1e9\n1 0 2 3 -1e9\n");
    made("p.poly", &poly(""), "");
}

#[test]
fn crossings_name_the_files_of_both_constraints() {
    let scratch = Scratch::new();
    scratch.write("p.wkt", "LINESTRING (0 0, 4 4)\nPOINT (0 4)\nPOINT (4 0)\nPOINT (1 4)");
    scratch.write("e.csv", "2,3\n");
    let command = "triangulate p.wkt -o m.ele --constraints e.csv";
    scratch.run(command).fails(3, &["p.wkt and e.csv: constraint 1", "crosses constraint 0", "(2, 2)"]);
    scratch.write("e.csv", "1,2\n0,2\n4,3\n0,1\n");
    scratch.run(command).fails(3, &["crosses constraint"]);
    scratch.write("p.wkt", "LINESTRING (0 0, 4 4, 0 4, 4 0)");
    scratch.write("e.csv", "0,1\n");
    scratch.run(command).fails(3, &["p.wkt: constraint 2", "crosses constraint 0"]);
    // Large numbers are told with exponents.
    scratch.write("q.csv", "0,0\n1e308,1e308\n0,9e307\n9.1e307,1\n");
    scratch.write("e.csv", "0,1\n2,3\n");
    let run = scratch.run("triangulate q.csv -o m.ele --constraints e.csv").fails(3, &["at about (4.5", "e307"]);
    assert!(run.stderr.len() < 250, "{run:?}");
}
