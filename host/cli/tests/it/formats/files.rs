//! Tests that every format of points gives the same mesh, and that every format of meshes can be read back or viewed.

use crate::common::Scratch;
use serde_json::Value;

/// The same six points in every format, one of them twice.
const POINTS: [[f64; 2]; 6] = [[0.0, 0.0], [10.0, 0.0], [0.0, 10.0], [10.0, 10.0], [5.0, 3.0], [10.0, 0.0]];
const ELE: &str = "4 3 0\n0 0 1 4\n1 0 4 2\n2 1 3 4\n3 2 4 3\n";

fn rows(row: impl Fn(usize, f64, f64) -> String) -> String {
    let all = POINTS.iter().enumerate().map(|(index, &[x, y])| row(index, x, y));
    all.collect::<Vec<_>>().join("\n") + "\n"
}

fn binary_ply(format: &str, bytes: fn(f64) -> Vec<u8>) -> Vec<u8> {
    // The file has a list before the properties that are read, and an element before the one that is read.
    let header = format!(
        "ply\r\nformat {format} 1.0\r\ncomment test\r\nelement extra 1\r\nproperty uchar a\r\nelement vertex 6\r\n\
         property uchar flag\r\nproperty double x\r\nproperty double y\r\nproperty list uchar uchar more\r\n\
         end_header\r\n"
    );
    let mut file = header.into_bytes();
    file.push(9);
    for [x, y] in POINTS {
        file.push(7);
        file.extend(bytes(x));
        file.extend(bytes(y));
        file.extend([2, 1, 1]);
    }
    file
}

#[test]
fn every_point_format_gives_the_same_mesh() {
    let scratch = Scratch::new();
    let collection = |items: String| format!("{{\"type\":\"FeatureCollection\",\"features\":[{items}]}}");
    let feature = |x, y| {
        format!(
            "{{\"type\":\"Feature\",\"properties\":{{\"a\":1}},\
             \"geometry\":{{\"type\":\"Point\",\"coordinates\":[{x},{y}]}}}}"
        )
    };
    let features = POINTS.map(|[x, y]| feature(x, y)).join(",");
    let list = POINTS.map(|[x, y]| format!("[{x},{y},7]")).join(",");
    let files: Vec<(&str, Vec<u8>)> = vec![
        ("plain.csv", rows(|_, x, y| format!("{x},{y}")).into()),
        ("header.csv", format!("id,Lat,Lon\n{}", rows(|i, x, y| format!("{i},{y},{x}"))).into()),
        ("extra.csv", rows(|i, x, y| format!("{x}.0 , {y}e0,{i},name")).into()),
        ("semicolon.csv", rows(|_, x, y| format!("{x};{y}")).into()),
        ("quoted.csv", format!("\"x\",\"y\"\n{}", rows(|_, x, y| format!("\"{x}\",\"{y}\""))).into()),
        ("tabs.tsv", rows(|_, x, y| format!("{x}\t{y}")).into()),
        ("plain.xyz", rows(|_, x, y| format!("  {x} \t {y} 1.5 # note")).into()),
        ("zero.node", format!("6 2 0 0\n{}", rows(|i, x, y| format!("{i} {x} {y}"))).into()),
        ("one.node", format!("# head\n6 2 1 1\n{}", rows(|i, x, y| format!("{} {x} {y} 3 1", i + 1))).into()),
        ("vertices.obj", format!("o thing\n{}f 1 2 3\n", rows(|_, x, y| format!("v {x} {y} 0.5"))).into()),
        (
            "ascii.ply",
            format!(
                "ply\nformat ascii 1.0\nelement vertex 6\nproperty list uchar int more\nproperty int x\n\
                 property float y\n\
                 end_header\n{}",
                rows(|_, x, y| format!("2 8 9 {x} {y}"))
            )
            .into(),
        ),
        ("little.ply", binary_ply("binary_little_endian", |value| value.to_le_bytes().to_vec())),
        ("big.ply", binary_ply("binary_big_endian", |value| value.to_be_bytes().to_vec())),
        ("points.wkt", rows(|_, x, y| format!("Point ({x} {y})")).into()),
        ("many.wkt", format!("MULTIPOINT ({})", POINTS.map(|[x, y]| format!("({x} {y})")).join(", ")).into()),
        ("features.geojson", collection(features).into()),
        ("multi.json", format!("{{\"type\":\"MultiPoint\",\"coordinates\":[{list}]}}").into()),
    ];
    for (name, content) in files {
        scratch.write(name, content);
        scratch.run(&format!("triangulate {name} -o {name}.ele")).ok();
        assert_eq!(scratch.read(&format!("{name}.ele")), ELE, "{name}");
    }
}

#[test]
fn standard_input_and_output_work() {
    let scratch = Scratch::new();
    let csv = rows(|_, x, y| format!("{x},{y}"));
    let run = scratch.run_with_input("triangulate - -o - --format ele", csv.as_bytes()).ok();
    assert_eq!(run.stdout, ELE);
    let xyz = rows(|_, x, y| format!("{x} {y}"));
    let run = scratch.run_with_input("triangulate - --from xyz -o - --format csv -q", xyz.as_bytes()).ok();
    assert_eq!(run.stdout, "0,1,4\n0,4,2\n1,3,4\n2,4,3\n");
    scratch.write("m.ele", ELE);
    scratch.run_with_input("verify - m.ele", csv.as_bytes()).ok();
    assert_eq!(scratch.files(), ["m.ele"]);
}

#[test]
fn meshes_can_be_read_back() {
    let scratch = Scratch::new();
    scratch.run("generate clusters -n 300 --bits 10 --seed 5 -o p.csv").ok();
    for format in ["ele", "obj", "ply", "json", "csv"] {
        scratch.run(&format!("triangulate p.csv -o m.{format}")).ok();
        scratch.run(&format!("verify p.csv m.{format}")).ok();
        // An option can name the format as well.
        scratch.run(&format!("triangulate p.csv -o m.bin --format {format}")).ok();
        assert_eq!(scratch.read("m.bin"), scratch.read(&format!("m.{format}")), "{format}");
        scratch.run(&format!("verify p.csv m.bin --format {format}")).ok();
    }
}

#[test]
fn points_are_read_back_from_json() {
    let scratch = Scratch::new();
    for points in [rows(|_, x, y| format!("{x},{y}")), "0.1,1e300\n-3e299,0\n7,0\n".to_owned(), "x,y\n".to_owned()] {
        scratch.write("p.csv", points);
        scratch.run("triangulate p.csv -o m.json").ok();
        scratch.run("triangulate m.json -o again.json").ok();
        assert_eq!(scratch.read("again.json"), scratch.read("m.json"));
        scratch.run("verify m.json m.json").ok();
    }
    let run =
        scratch.run_with_input("triangulate - --from json -o - --format csv", br#"{"points":[[0,0],[1,0],[0,1]]}"#);
    assert_eq!(run.ok().stdout, "0,1,2\n");
}

#[test]
fn numbers_of_json_are_those_that_are_written() {
    let scratch = Scratch::new();
    // Doubles would make one point of the first two, and 9007199254740992 of the others.
    let points = ["0.123456789012345678", "0.123456789012345679", "1.5", "2"].map(|x| format!("[{x}, 1.50]")).join(",");
    let whole = ["9007199254740993", "9007199254740992", "-9223372036854775808"].map(|x| format!("[{x},7]")).join(",");
    for list in [points, whole] {
        scratch.write("p.json", format!("{{\"points\":[{list}]}}"));
        scratch.write("p.geojson", format!("{{\"coordinates\":[{list}],\"type\":\"MultiPoint\"}}"));
        scratch.write("p.csv", list.replace("],[", "\n").replace(['[', ']'], "") + "\n");
        scratch.run("triangulate p.csv -o csv.json").ok();
        for name in ["p.json", "p.geojson"] {
            scratch.run(&format!("triangulate {name} -o m.json")).ok();
            assert_eq!(scratch.read("m.json"), scratch.read("csv.json"), "{name}");
            // What the command writes reads back to the same.
            scratch.run("triangulate m.json -o again.json").ok();
            assert_eq!(scratch.read("again.json"), scratch.read("m.json"), "{name}");
        }
    }
    let beyond = r#"{"type":"MultiPoint","coordinates":[[0,0],[1,9223372036854775808]]}"#;
    crate::common::refuse("p.geojson", beyond, &["point 2, y", "beyond 64 bits"]);
}

#[test]
fn triangles_own_files_count_from_one() {
    let scratch = Scratch::new();
    scratch.write("p.node", format!("6 2 0 0\n{}", rows(|i, x, y| format!("{} {x} {y}", i + 1))));
    scratch.write("m.ele", "4 3 0\n1 1 2 5\n2 1 5 3\n3 2 4 5\n4 3 5 4\n# Generated by triangle\n");
    scratch.run("verify p.node m.ele").ok();
}

#[test]
fn text_formats_say_what_they_should() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0.5,0\n4,0\n0,4\n4,0\n");
    let mesh = |format: &str| {
        scratch.run(&format!("triangulate p.csv -o m.{format}")).ok();
        scratch.read(&format!("m.{format}"))
    };
    assert_eq!(mesh("ele"), "1 3 0\n0 0 1 2\n");
    assert_eq!(mesh("csv"), "0,1,2\n");
    assert_eq!(mesh("obj"), "v 0.5 0 0\nv 4 0 0\nv 0 4 0\nv 4 0 0\nf 1 2 3\n");
    assert!(mesh("ply").ends_with("end_header\n0.5 0 0\n4 0 0\n0 4 0\n4 0 0\n3 0 1 2\n"));
    let vtk = mesh("vtk");
    assert!(vtk.starts_with("# vtk DataFile Version 3.0\n"), "{vtk}");
    assert!(
        vtk.ends_with("POINTS 4 double\n0.5 0 0\n4 0 0\n0 4 0\n4 0 0\nCELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n5\n"),
        "{vtk}"
    );
}

#[test]
fn heights_are_written_like_coordinates() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "x,y,z\n0,0,1e300\n4,0,-2.5e-9\n0,4,7\n");
    for (format, start) in [("obj", "v "), ("ply", ""), ("vtk", "")] {
        scratch.run(&format!("triangulate p.csv -o m.{format}")).ok();
        let mesh = scratch.read(&format!("m.{format}"));
        let rows = format!("{start}0 0 1e300\n{start}4 0 -2.5e-9\n{start}0 4 7\n");
        assert!(mesh.contains(&rows), "{mesh}");
    }
}

#[test]
fn json_formats_are_json() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0.5,0\n4,0\n0,4\n4,0\n");
    let mesh = |format: &str| -> Value {
        scratch.run(&format!("triangulate p.csv -o m.{format}")).ok();
        serde_json::from_str(&scratch.read(&format!("m.{format}"))).expect("it is JSON")
    };
    let json = mesh("json");
    assert_eq!(json["points"][0], serde_json::json!([0.5, 0]));
    assert_eq!(json["triangles"], serde_json::json!([[0, 1, 2]]));
    assert_eq!(json["hull"], serde_json::json!([0, 1, 2]));
    assert_eq!(json["duplicates"], serde_json::json!([[3, 1]]));
    let geojson = mesh("geojson");
    assert_eq!(geojson["type"], "FeatureCollection");
    let ring = &geojson["features"][0]["geometry"]["coordinates"][0];
    assert_eq!(*ring, serde_json::json!([[0.5, 0], [4, 0], [0, 4], [0.5, 0]]));
}

#[test]
fn svg_shows_every_triangle_the_hull_and_the_points() {
    let scratch = Scratch::new();
    scratch.run("generate uniform -n 400 --seed 2 -o p.csv").ok();
    let run = scratch.run("triangulate p.csv -o m.svg --json").ok();
    let report: Value = serde_json::from_str(&run.stdout).expect("the report is JSON");
    let svg = scratch.read("m.svg");
    assert!(svg.starts_with("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=") && svg.ends_with("</svg>\n"));
    let corners = svg.matches('z').count() as u64;
    assert_eq!(corners, report["triangles"].as_u64().expect("a number") + 1, "triangles and the hull");
    assert_eq!(svg.matches("h0").count(), 400);
    assert!(svg.len() < 40_000, "{} bytes", svg.len());
}

#[test]
fn svg_fits_any_extent() {
    let scratch = Scratch::new();
    let sets = [
        "1e308,1e308\n-1e307,0\n0,1e308\n",
        "1e-300,0\n0,1e-300\n0.5e-300,1e-300\n",
        "0,0\n65535,0\n65535,1\n0,1\n",
        "5,5\n5,5\n",
        "0,0.5\n0,1\n",
    ];
    for points in sets {
        scratch.write("p.csv", points);
        scratch.run("triangulate p.csv -o m.svg --quantize fit --coord-bits 16").ok();
        let svg = scratch.read("m.svg");
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "{points}: {svg}");
    }
    scratch.write("p.csv", "0,0\n1e-310,0\n0,1e-310\n");
    scratch.run("triangulate p.csv -o m.svg --quantize 1").ok();
    let svg = scratch.read("m.svg");
    assert!(svg.contains("viewBox=\"0 0 1000 1000\""), "{svg}");
    assert_eq!(svg.matches("M500 500h0").count(), 3, "{svg}");
}

#[test]
fn the_airports_of_the_world_become_a_picture() {
    let scratch = Scratch::new();
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/../../testbench/data/airports.csv");
    let run = scratch.run(&format!("triangulate {data} -o world.svg --json")).ok();
    let report: Value = serde_json::from_str(&run.stdout).expect("the report is JSON");
    assert_eq!(report["points"], 28_298);
    assert_eq!(report["distinct"], 28_293);
    // Five airports share a place with another, and six decimals tell all others apart.
    let lattice = &report["lattice"];
    assert_eq!((&lattice["kind"], &lattice["scale"], &lattice["bits"]), (&"decimal".into(), &1e-6.into(), &29.into()));
    assert!(scratch.read("world.svg").len() < 1_500_000);
    let run = scratch.run(&format!("triangulate {data} -o world.ele --quantize fit --coord-bits 16 --json")).ok();
    let report: Value = serde_json::from_str(&run.stdout).expect("the report is JSON");
    // On a grid of 16 bits, 27 more airports fall onto others.
    assert_eq!((&report["distinct"], &report["quantisation"]["merged"]), (&28_266.into(), &27.into()));
    scratch.run(&format!("verify {data} world.ele --quantize fit --coord-bits 16")).ok();
}
