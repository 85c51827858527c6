//! Tests that PLY, GeoJSON and mesh files with a wrong structure lead to one clear sentence each and
//! leave no file behind.

use crate::common::{accept, refuse, Scratch};

fn ply_header(format: &str, count: &str) -> String {
    format!("ply\nformat {format} 1.0\nelement vertex {count}\nproperty float x\nproperty float y\nend_header\n")
}

#[test]
fn ply_that_is_cut_or_lies() {
    let ascii = |count| ply_header("ascii", count);
    refuse("p.ply", ascii("3") + "0 0\n1 0\n", &["promises 3", "vertex", "2"]);
    refuse("p.ply", ascii("3") + "0 0\n1 0\n1", &["vertex 3, y", "missing"]);
    refuse("p.ply", ascii("2") + "0 0\n1 nan\n", &["vertex 2, y", "finite"]);
    refuse("p.ply", ascii("2") + "0 0\n1 a\n", &["vertex 2, y", "'a'"]);
    refuse("p.ply", ascii("18446744073709551615") + "0 0\n", &["promises 18446744073709551615"]);
    refuse("p.ply", ascii("99999999999999999999") + "0 0\n", &["PLY header"]);
    refuse("p.ply", "ply\nformat ascii 1.0\n", &["PLY header"]);
    refuse("p.ply", "solid\n", &["PLY header", "Expected magic number 'ply'"]);
    refuse("p.ply", "ply\nformat ascii 1.0\nelement face 0\nend_header\n", &["no element 'vertex'"]);
    refuse("p.ply", "ply\n\u{1b}[31m\n", &["PLY header", r"'\u{1b}[31m"]);
    let named = "ply\nformat ascii 1.0\nelement \u{1b}x 9\nproperty float x\nelement vertex 0\nend_header\n";
    refuse("p.ply", named, &[r"\u{1b}x"]);
    let no_y = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n";
    refuse("p.ply", no_y, &["vertex 1, y", "missing"]);
    let no_properties = "ply\nformat binary_little_endian 1.0\nelement vertex 9999999999999\nend_header\n";
    refuse("p.ply", no_properties, &["no properties"]);
    let list = "ply\nformat ascii 1.0\nelement vertex 1\nproperty list int float x\nend_header\n4294967295 1\n";
    refuse("p.ply", list, &["vertex 1, x", "missing"]);

    let mut binary = ply_header("binary_little_endian", "3").into_bytes();
    binary.extend([0; 20]);
    refuse("p.ply", &binary, &["promises 3", "number 3"]);
    let mut binary = ply_header("binary_big_endian", "4294967295").into_bytes();
    binary.extend([0; 8]);
    refuse("p.ply", &binary, &["promises 4294967295"]);
    let mut binary = ply_header("binary_big_endian", "1").into_bytes();
    binary.extend([0x7f, 0xc0, 0, 0, 0, 0, 0, 0]);
    refuse("p.ply", &binary, &["vertex 1, x", "NaN"]);
}

#[test]
fn ply_that_holds_more_than_it_promises() {
    let ascii = |count| ply_header("ascii", count);
    refuse("p.ply", ascii("3") + "0 0\n1 0\n0 1\n5 5\n", &["more than its header promises", "1 row after"]);
    refuse("p.ply", ascii("2") + "0 0\n1 0 7\n", &["vertex 2", "more values"]);
    accept("p.ply", ascii("3") + "0 0\n1 0\n0 1\n\n \n", 1);
    let faces = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nelement face 1\n\
                 property list uchar int vertex_indices\nend_header\n0 0\n1 0\n0 1\n3 0 1 2\n";
    accept("p.ply", faces, 1);
    refuse("p.ply", format!("{faces}3 0 1 2\n"), &["1 row after"]);
    for format in ["binary_little_endian", "binary_big_endian"] {
        let mut binary = ply_header(format, "1").into_bytes();
        binary.extend([0; 24]);
        refuse("p.ply", &binary, &["more than its header promises", "16 bytes"]);
    }
}

#[test]
fn geojson_of_wrong_form() {
    refuse("p.geojson", "{", &["GeoJSON"]);
    refuse("p.geojson", r#"{"type":"Point","coordinates":[1]}"#, &["p.geojson"]);
    refuse("p.geojson", r#"{"type":"Point","coordinates":[1,1e999]}"#, &["point 1, y", "'1e999'", "finite"]);
    refuse("p.geojson", r#"{"type":"Point","coordinates":[1,"2"]}"#, &["the geometry", "list of numbers"]);
    refuse("p.geojson", r#"{"type":"Point","coordinates":[1,2],}"#, &["GeoJSON", "line 1 column 37"]);
    refuse("p.geojson", r#"{"type":"Circle","coordinates":[1,2]}"#, &["GeoJSON", "'Circle'"]);
    refuse("p.geojson", r#"{"coordinates":[1,2]}"#, &["GeoJSON", "no 'type'"]);
    refuse("p.geojson", r#"{"type":"MultiPoint","coordinates":[[1,2],[3]]}"#, &["position 2", "1 coordinate"]);
    let second = r#"{"type":"FeatureCollection","features":[
        {"type":"Feature","geometry":{"type":"Point","coordinates":[1,2]}},
        {"type":"Feature","geometry":{"type":"MultiPoint","coordinates":[[1,2],[3,null]]}}]}"#;
    refuse("p.geojson", second, &["feature 2, position 2", "'[3,null]'"]);
    let nested = |depth| {
        let open = r#"{"type":"GeometryCollection","geometries":["#.repeat(depth);
        format!("{open}{{\"type\":\"Point\",\"coordinates\":[1,2]}}{}", "]}".repeat(depth))
    };
    accept("p.geojson", nested(32), 0);
    refuse("p.geojson", nested(33), &["32 collections"]);
    accept("p.geojson", r#"{"type":"LineString","coordinates":[[1,2],[3,4],[0,9]]}"#, 1);
    let no_geometry =
        r#"{"type":"FeatureCollection","features":[{"type":"Feature","geometry":null,"properties":null}]}"#;
    refuse("p.geojson", no_geometry, &["feature 1", "no geometry"]);
    let deep = format!("{}{}", "[".repeat(100_000), "]".repeat(100_000));
    refuse("p.geojson", &deep, &["GeoJSON"]);
    accept("p.geojson", r#"{"type":"MultiPoint","coordinates":[[1,2],[3,1e300],[-0.5,7,12]]}"#, 1);
}

#[test]
fn json_points_of_wrong_form() {
    refuse("p.json", r#"{"points":[[0,0],[1,2,3]]}"#, &["points[1]", "'[1,2,3]'"]);
    refuse("p.json", r#"{"points":[[0,null]]}"#, &["points[0]"]);
    refuse("p.json", r#"{"points":[[0,1e999]]}"#, &["point 1, y", "'1e999'", "finite"]);
    refuse("p.json", r#"{"points":[[0,1]}"#, &["not JSON", "line 1 column 17"]);
    refuse("p.json", r#"{"points":[[0,0],[1,9223372036854775808]]}"#, &["point 2, y", "beyond 64 bits"]);
    // An object with a `type` is read as GeoJSON.
    let named = r#"{"type":"LineString","coordinates":[[1,2]],"points":[[0,0]]}"#;
    refuse("p.json", named, &["the geometry has a line of 1 point"]);
    refuse("p.json", r#"{"triangles":[]}"#, &["GeoJSON"]);
    refuse("p.json", "[1,2]", &["GeoJSON"]);
}

#[test]
fn meshes_that_cannot_be_read() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n4,0\n0,4\n");
    let meshes = [
        ("m.ele", "", "empty"),
        ("m.ele", "1 3 0\n0 0 1\n", "row 2 has 3 values"),
        ("m.ele", "1 3 0\n0 0 1 -2\n", "row 2, column 4"),
        ("m.ele", "1 6 0\n0 0 1 2\n", "row 1, column 2"),
        ("m.obj", "f 0 1 2\n", "row 1, column 2"),
        ("m.obj", "f 1 2 3 4\n", "4 corners"),
        ("m.csv", "0,1\n", "2 columns"),
        ("m.csv", "0,1,b\n", "row 1, column 3"),
        ("m.json", "[", "not JSON"),
        ("m.json", "{}", "'triangles'"),
        ("m.json", r#"{"triangles":[[0,1,2],[0,1]]}"#, "triangles[1]"),
        ("m.ply", "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n", "no element 'face'"),
    ];
    for (name, content, part) in meshes {
        scratch.write(name, content);
        scratch.run(&format!("verify p.csv {name}")).fails(3, &[name, part]);
    }
}
