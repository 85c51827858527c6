//! Tests that each bad input leads to one clear sentence and the right exit code, and leaves no file behind.

use crate::common::{accept, refuse, Scratch};

#[test]
fn csv_values_that_are_no_finite_numbers() {
    refuse("p.csv", "0,0\n1,NaN\n", &["row 2, column 2", "'NaN'", "finite"]);
    refuse("p.csv", "0,0\ninf,1\n", &["row 2, column 1", "'inf'", "finite"]);
    refuse("p.csv", "0,0\n1,-Infinity\n", &["row 2, column 2", "finite"]);
    refuse("p.csv", "1e999,0\n", &["row 1, column 1", "'1e999'", "finite"]);
    refuse("p.csv", "0,0\n1,abc\n", &["row 2, column 2", "'abc'", "not a number"]);
    refuse("p.csv", "0,0\n1,0x10\n", &["row 2, column 2", "'0x10'"]);
    refuse("p.csv", "0,0\n1,\n", &["row 2, column 2", "missing"]);
    refuse("p.csv", "12a,0\n1,2\n", &["row 1, column 1", "'12a'"]);
    refuse("p.csv", "x,y\nx,y\n", &["row 2, column 1", "'x'"]);
}

#[test]
fn values_out_of_range() {
    let beyond = "9223372036854775808";
    refuse("p.csv", format!("x,y\n0,0\n{beyond},1\n"), &["row 3, column 1", beyond, "64 bits", "9223372036854775807"]);
    refuse("p.csv", format!("0,0\n\n5,-{beyond}0\n"), &["row 3, column 2", "beyond 64 bits"]);
    let rows = format!("# a\r\n\r\n0,0\r\n\r\n# b\r\n  \r\n5,{beyond}\r\n");
    refuse("p.csv", rows, &["row 7, column 2"]);
    refuse("p.csv", format!("lat,name,lon\n1,a,2\n3,b,{beyond}\n"), &["row 3, column 3", beyond]);
    refuse("p.node", format!("2 2 0 0\n1 0 0\n2 0 {beyond}\n"), &["row 3, column 3", beyond]);
    refuse("p.obj", format!("v 0 0 0\nvn 1 1 1\nv {beyond} 0 0\n"), &["row 3, column 2", beyond]);
    accept("p.csv", "0,0\n1e300,1\n-1e308,0.5\n5e-324,-0\n", 2);
    accept("p.csv", "-363,0\n70000,1\n5,-1\n", 1);
}

#[test]
fn csv_rows_of_wrong_form() {
    refuse("p.csv", "0,0\n1\n", &["row 2", "1 column"]);
    refuse("p.csv", "0,0\n1,2,3\n", &["row 2", "3 columns", "has 2"]);
    refuse("p.csv", "0 0\n1 2\n", &["row 1", "'0 0'", "--from xyz"]);
    refuse("p.csv", "7\n", &["row 1", "'7'"]);
}

#[test]
fn csv_quotes_that_are_not_closed() {
    refuse("p.csv", "x,y,name\n1,1,\"a\n2,2,b\n", &["row 2", "quote"]);
    refuse("p.csv", "1,\"1\n2,2\n", &["row 1", "quote"]);
}

#[test]
fn long_lines_and_wrong_encodings() {
    let long = "9".repeat(1_000_000);
    refuse("p.csv", format!("0,0\n1,{long}\n"), &["row 2, column 2", "bytes"]);
    refuse("p.csv", &long, &["row 1", "(1000000 bytes)"]);
    refuse("p.csv", format!("0,0\n{}\n", ",".repeat(1_000_000)), &["row 2", "1000001 columns"]);
    refuse("p.xyz", &long, &["row 1", "(1000000 bytes)"]);
    refuse("p.node", &long, &["row 1, column 1", "(1000000 bytes)"]);
    refuse("p.obj", format!("v 1 {long}x\n"), &["row 1, column 3", "bytes"]);
    refuse("p.ply", format!("ply\n{long}\n"), &["PLY"]);
    refuse("p.geojson", &long, &["GeoJSON"]);
    refuse("p.csv", b"0,0\n\xff\xfe\xfd,1\n", &["row 2, column 1", "UTF-8"]);
    refuse("p.csv", b"\xff\xfe0\0,\x001\0", &["UTF-16"]);
    refuse("p.xyz", b"0 0\n1 \xe9\n", &["row 2, column 2", "UTF-8"]);
    refuse("p.geojson", b"{\"type\":\"\xff\"}", &["UTF-8"]);
    accept("p.csv", b"\xef\xbb\xbfx,y\r\n0,0\r\n1,0\r\n0,1\r\n", 1);
    accept("p.xyz", b"\xef\xbb\xbf0 0\r\n1\t0\r\n0 1", 1);
}

#[test]
fn empty_files() {
    for name in ["p.csv", "p.tsv", "p.xyz", "p.node", "p.obj", "p.ply", "p.geojson", "p.json", "p.wkt"] {
        refuse(name, "", &["the file is empty", "'x,y'"]);
    }
    accept("p.csv", "\n\n", 0);
    accept("p.csv", "x,y\r\n", 0);
    accept("p.xyz", "x y z\n# nothing\n", 0);
    accept("p.obj", "# nothing\n", 0);
    accept("p.wkt", "POINT EMPTY\n", 0);
    accept("p.node", "0 2 0 0\n", 0);
    accept("p.geojson", r#"{"type":"FeatureCollection","features":[]}"#, 0);
    refuse("p.node", "\n", &["empty", "N 2"]);
    refuse("p.ply", "\n", &["PLY header"]);
    refuse("p.geojson", " ", &["empty"]);
}

#[test]
fn xyz_of_wrong_form() {
    refuse("p.xyz", "0 0 0\n1\n", &["row 2", "1 value"]);
    refuse("p.xyz", "0 0 0\n1 2\n", &["row 2", "2 values", "has 3"]);
    refuse("p.xyz", "0 0 0\n1 nan 3\n", &["row 2, column 2", "'nan'"]);
}

#[test]
fn node_counts_and_ids() {
    refuse("p.node", "3 2 0 0\n0 0 0\n1 1 1\n", &["promises 3 points", "holds 2"]);
    refuse("p.node", "1 2 0 0\n", &["promises 1 point,", "holds 0"]);
    refuse("p.node", "1 2 0 0\n0 0 0\n1 1 1\n", &["row 3", "one point more", "promises"]);
    refuse("p.node", "4294967295 2 0 0\n0 0 0\n", &["promises 4294967295", "holds 1"]);
    refuse("p.node", "2 3 0 0\n0 0 0\n1 1 1\n", &["row 1, column 2", "'3'"]);
    refuse("p.node", "2 2 0 0\n5 0 0\n6 1 1\n", &["row 2, column 1", "0 or 1"]);
    refuse("p.node", "2 2 0 0\n0 0 0\n2 1 1\n", &["row 3, column 1", "not 1"]);
    refuse("p.node", "2 2 0 0\n0 0 0\n1 1\n", &["row 3", "2 values"]);
    refuse("p.node", "-1 2 0 0\n", &["row 1, column 1", "'-1'"]);
    accept("p.node", "3 2 1 1\n# ids from 0\n0 0 0 0.5 1\n1 5 0 0.5 1\n\n2 0 5 0.5 0\n", 1);
    accept("p.node", "3 2 0 0\n1 0 0\n2 5 0\n3 0 5 # the last\n", 1);
}

#[test]
fn obj_of_wrong_form() {
    refuse("p.obj", "v 1\n", &["row 1, column 3", "missing"]);
    refuse("p.obj", "v 1 inf 0\n", &["row 1, column 3", "finite"]);
    // A file that is no OBJ must not pass for an OBJ without points.
    refuse("p.obj", "hello world\n", &["row 1", "'hello'", "not start a statement of OBJ"]);
    refuse("p.obj", "v 0 0 0\n\nV 1 0 0\n", &["row 3", "'V'"]);
    refuse("p.obj", b"v 0 0 0\nv 1 0 0\n\x8f\x01\xfe\n", &["row 3", "UTF-8"]);
    refuse("p.obj", b"# \0\n", &["row 1", "UTF-8"]);
    accept("p.obj", "# a\nmtllib a.mtl\no a\nv 0 0 0\nv 5 0 0\n\tv 0 5 0\nparm u 0 \\\n 1 2\ns off\nend\n", 1);
}

#[test]
fn heights_that_are_no_finite_numbers() {
    refuse("p.csv", "x,y,z\n0,0,1\n1,0,\n", &["row 3, column 3", "missing"]);
    refuse("p.csv", "z,x,y\n1,0,0\nnan,1,0\n", &["row 3, column 1", "'nan'", "finite"]);
    refuse("p.xyz", "0 0 1\n1 0 inf\n", &["row 2, column 3", "'inf'"]);
    refuse("p.xyz", "0 0 1\n1 0 a\n", &["row 2, column 3", "'a'", "not a number"]);
    refuse("p.obj", "v 0 0 0\nv 1 0 1e999\n", &["row 2, column 4", "finite"]);
    refuse("p.geojson", r#"{"type":"Point","coordinates":[1,2,1e999]}"#, &["point 1, z", "finite"]);
    let ply = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
    refuse("p.ply", format!("{ply}end_header\n1 2 nan\n"), &["vertex 1, z", "'nan'"]);
}

#[test]
fn heights_of_some_points_are_left_out_with_a_word() {
    let scratch = Scratch::new();
    let files = [
        ("p.obj", "v 0 0 7\nv 4 0\nv 0 4 1\n", "row 2"),
        ("p.wkt", "POINT (0 0) POINT (4 0 5) POINT (0 4)", "point 1"),
        ("p.geojson", r#"{"type":"MultiPoint","coordinates":[[0,0,1],[4,0,2],[0,4]]}"#, "point 3"),
    ];
    for (name, content, first) in files {
        scratch.write(name, content);
        let run = scratch.run(&format!("triangulate {name} -o m.obj")).ok();
        assert!(run.stderr.contains(&format!("z is left out: {first} has none\n")), "{run:?}");
        assert!(scratch.read("m.obj").starts_with("v 0 0 0\n"), "{name}");
    }
    for (name, content) in [("p.obj", "v 0 0\nv 4 0\nv 0 4\n"), ("p.wkt", "POINT M (0 0 1) POINT (4 0) POINT (0 4)")] {
        scratch.write(name, content);
        let run = scratch.run(&format!("triangulate {name} -o m.obj")).ok();
        assert!(!run.stderr.contains("left out"), "{run:?}");
    }
}

#[test]
fn files_that_are_not_there_or_cannot_be_read() {
    let scratch = Scratch::new();
    scratch.run("triangulate none.csv -o m.ele").fails(3, &["none.csv", "No such file"]);
    std::fs::create_dir(scratch.path("folder.csv")).expect("a folder can be made");
    scratch.run("triangulate folder.csv -o m.ele").fails(3, &["folder.csv", "directory"]);
    scratch.write("p.dat", "0,0\n");
    scratch.run("triangulate p.dat -o m.ele").fails(2, &["p.dat", "--from"]);
    scratch.run("triangulate p.dat --from csv -o m.ele").ok();
}
