//! Tests of LAS, LAZ and COPC files: the stored integers are the coordinates, points are selected by class and place,
//! and meshes have the heights.

use incircle_cli::formats::{PointFormat, Selection};
use incircle_cli::{Coordinates, Input, Unit};
use incircle_testkit::SplitMix64;
use serde_json::{json, Value};

use crate::common::lidar::{copc, write, Axis, Stored};
use crate::common::Scratch;

/// Axes as surveys have them: millimetres in x and y, centimetres in z.
pub const AXES: [Axis; 3] = [(0.001, 500_000.0), (0.001, -4_100_000.5), (0.01, 100.0)];

/// Every minor version and point format that is written here.
const FORMATS: [(u8, u8); 7] = [(2, 0), (2, 1), (2, 2), (2, 3), (4, 6), (4, 7), (4, 8)];

/// Whether a point is to be selected.
type IsTaken = fn(&Stored) -> bool;

/// Random points of the classes 0 to 9.
pub fn points(count: u64, seed: u64) -> Vec<Stored> {
    let mut random = SplitMix64::new(seed);
    let mut integer = |below| random.below(below) as i32;
    (0..count).map(|_| ([integer(100_000) - 50_000, integer(80_000), integer(5000) - 500], integer(10) as u8)).collect()
}

fn read(file: &[u8]) -> (Coordinates, Vec<f64>) {
    let table = PointFormat::Las.read(Input::of_bytes(file), &Selection::default());
    let table = table.unwrap_or_else(|failure| panic!("{failure}"));
    (table.coordinates().clone(), table.heights().to_vec())
}

/// The points as a CSV file has them, with the decimals written out.
fn csv(points: &[Stored]) -> String {
    let row = |&([x, y, z], _): &Stored| {
        let (x, y, z) = (500_000_000 + i64::from(x), -4_100_000_500 + i64::from(y), 10_000 + i64::from(z));
        format!("{x}e-3,{y}e-3,{z}e-2\n")
    };
    "x,y,z\n".to_owned() + &points.iter().map(row).collect::<String>()
}

#[test]
fn the_stored_integers_are_the_steps() {
    let points = points(3000, 1);
    let steps: Vec<_> = points.iter().map(|&([x, y, _], _)| [i64::from(x), i64::from(y)]).collect();
    let unit = Unit { digits: 3, factor: 1, offset: [500_000_000, -4_100_000_500], is_stored: true };
    let heights: Vec<f64> = points.iter().map(|&([_, _, z], _)| (10_000.0 + f64::from(z)) / 100.0).collect();
    for (minor, format) in FORMATS {
        for is_packed in [false, true] {
            let found = read(&write(minor, format, is_packed, AXES, &points));
            assert!(found.0 == Coordinates::Steps { steps: steps.clone(), unit }, "{minor} {format} {is_packed}");
            assert!(found.1 == heights, "{minor} {format} {is_packed}");
        }
    }
    // A COPC file has chunks of any length, among them chunks of one point.
    for format in 6..=8 {
        let file = copc(&write(4, format, false, AXES, &points), &[1700, 1, 299, 1000]);
        let found = read(&file);
        assert!(found.0 == Coordinates::Steps { steps: steps.clone(), unit } && found.1 == heights, "{format}");
    }
}

#[test]
fn files_of_many_chunks_and_of_no_points_are_read() {
    for (minor, format) in [(2, 1), (4, 6)] {
        for count in [0, 1, 50_000, 100_001] {
            let points = points(count, 2);
            let plain = read(&write(minor, format, false, AXES, &points));
            assert_eq!(plain.1.len() as u64, count);
            assert!(read(&write(minor, format, true, AXES, &points)) == plain, "{format} {count}");
        }
    }
}

#[test]
fn scales_that_are_no_common_decimals_give_doubles() {
    let stored: [Stored; 2] = [([3, -7, 5], 2), ([i32::MAX, i32::MIN, 0], 2)];
    let (x, y) = ((1e-30, 5.0), (0.1, 0.0));
    let found = read(&write(2, 0, false, [x, y, (0.1, 0.0)], &stored));
    let by_formula = |axis: Axis, integer: i32| f64::from(integer) * axis.0 + axis.1;
    let doubles = stored.map(|([i, j, _], _)| [by_formula(x, i), by_formula(y, j)]);
    assert_eq!(found, (Coordinates::Doubles(doubles.to_vec()), vec![0.5, 0.0]));
    // Two decimals are brought to one length of step.
    let found = read(&write(2, 0, false, [(0.01, 0.0), (0.025, 1.0), (1.0, 0.0)], &stored));
    let unit = Unit { digits: 3, factor: 5, offset: [0, 1000], is_stored: true };
    let steps = stored.map(|([i, j, _], _)| [i64::from(i) * 2, i64::from(j) * 5]);
    assert_eq!(found.0, Coordinates::Steps { steps: steps.to_vec(), unit });
}

#[test]
fn the_mesh_is_that_of_the_decimals_and_has_the_heights() {
    let scratch = Scratch::new();
    let points = points(400, 3);
    scratch.write("p.csv", csv(&points));
    scratch.write("p.las", write(2, 3, false, AXES, &points));
    scratch.write("p.laz", write(4, 6, true, AXES, &points));
    scratch.write("p.copc.laz", copc(&write(4, 6, false, AXES, &points), &[150, 250]));
    scratch.write("q.laz.zst", zstd::encode_all(&write(4, 7, true, AXES, &points)[..], 0).expect("memory"));
    for mesh in ["m.ply", "m.obj", "m.vtk", "m.ele"] {
        scratch.run(&format!("triangulate p.csv -o {mesh}")).ok();
        let expected = scratch.read(mesh);
        for name in ["p.las", "p.laz", "p.copc.laz", "q.laz.zst"] {
            scratch.run(&format!("triangulate {name} -o {mesh}")).ok();
            assert!(scratch.read(mesh) == expected, "{name} {mesh}");
        }
    }
    scratch.run("verify p.copc.laz m.ele").ok();
    let las = std::fs::read(scratch.path("p.las")).expect("the file was written");
    let run = scratch.run_with_input("triangulate - --from las -o - --format ele", &las).ok();
    assert_eq!(run.stdout, scratch.read("m.ele"));
}

#[test]
fn the_report_names_the_lattice() {
    let scratch = Scratch::new();
    let stored: [Stored; 4] = [([0, 0, 0], 0), ([7, 0, 0], 0), ([0, 7, 0], 0), ([9, 9, 0], 0)];
    let lattice = |x: Axis, y: Axis| -> Value {
        scratch.write("p.las", write(2, 0, false, [x, y, (1.0, 0.0)], &stored));
        let run = scratch.run("triangulate p.las -o m.ele --json").ok();
        serde_json::from_str::<Value>(&run.stdout).expect("JSON")["lattice"].clone()
    };
    let found = lattice((0.25, 10.0), (0.25, -1.5));
    assert_eq!(found, json!({ "kind": "decimal", "scale": 0.25, "offset": [10.0, -1.5], "bits": 4, "rounded": 0 }));
    let found = lattice((1.0, 400_000.0), (1.0, -3.0));
    assert_eq!(found, json!({ "kind": "whole", "scale": 1, "offset": [400_000, -3], "bits": 4, "rounded": 0 }));
    // Two scales widen the span to 2^33 steps and more, and the steps stay integers.
    let ends: [Stored; 3] = [([0, 0, 0], 0), ([0, i32::MAX, 0], 0), ([1, i32::MIN, 0], 0)];
    scratch.write("p.las", write(2, 0, false, [(0.001, 0.0), (0.002, 0.0), (1.0, 0.0)], &ends));
    let run = scratch.run("triangulate p.las -o m.ele --json").ok();
    let found = &serde_json::from_str::<Value>(&run.stdout).expect("JSON")["lattice"];
    assert_eq!((&found["kind"], &found["bits"]), (&"decimal".into(), &33.into()), "{found}");
    let found = lattice((1e-25, 0.0), (0.1, 0.0));
    assert_eq!(found, json!({ "kind": "doubles", "scale": null, "offset": null, "bits": null, "rounded": 0 }));
}

#[test]
fn points_are_selected_by_class_and_place() {
    let scratch = Scratch::new();
    let points = points(2000, 4);
    scratch.write("old.las", write(2, 1, false, AXES, &points));
    scratch.write("new.laz", write(4, 6, true, AXES, &points));
    let is_within: IsTaken = |&([x, y, _], _)| (-30_000..=9999).contains(&x) && (0..=50_500).contains(&y);
    let bounds = "--bounds 499970,-4100000.5,500009.999,-4099950";
    let choices: [(&str, IsTaken); 4] = [
        ("--class 2,9", |(_, class)| [2, 9].contains(class)),
        ("--class 255 --class 0", |&(_, class)| class == 0),
        (bounds, is_within),
        ("--class 77", |_| false),
    ];
    for (options, is_taken) in choices {
        let taken: Vec<Stored> = points.iter().copied().filter(is_taken).collect();
        scratch.write("p.csv", csv(&taken));
        scratch.run("triangulate p.csv -o m.ply").ok();
        let expected = scratch.read("m.ply");
        for name in ["old.las", "new.laz"] {
            scratch.run(&format!("triangulate {name} {options} -o m.ply")).ok();
            assert!(scratch.read("m.ply") == expected, "{name} {options}");
            scratch.run(&format!("verify {name} m.ply {options}")).ok();
        }
    }
}

#[test]
fn edges_of_bounds_are_exact() {
    let scratch = Scratch::new();
    let stored: Vec<Stored> = (0..10).map(|x| ([x, 0, 0], 0)).collect();
    let count = |bounds: &str| {
        let run = scratch.run(&format!("triangulate p.las -o m.ele --json --bounds {bounds}")).ok();
        serde_json::from_str::<Value>(&run.stdout).expect("JSON")["points"].clone()
    };
    scratch.write("p.las", write(2, 0, false, [(0.1, 0.0), (0.1, 0.0), (1.0, 0.0)], &stored));
    assert_eq!(count("0.3,-1,0.6,1"), 4);
    assert_eq!(count("0.300000000000000001,-1,0.599999999999999999,0"), 2);
    assert_eq!(count("-9e18,-9e18,9e18,9e18"), 10);
    // These coordinates are doubles. The integer 3 gives 0.30000000000000004, which is above the decimal 0.3.
    scratch.write("p.las", write(2, 0, false, [(0.1, 0.0), (1e-30, 0.0), (1.0, 0.0)], &stored));
    assert_eq!(count("0.3,-1,0.30000000000000004,1"), 0);
    assert_eq!(count("0.3,-1,0.300000000000000045,1"), 1);
    assert_eq!(count("0.5,-1,0.5,1"), 1);
}

#[test]
fn selections_that_make_no_sense_are_usage_errors() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n4,0\n0,4\n");
    scratch.run("triangulate p.csv -o m.ele --class 2").fails(2, &["--class", "LAS"]);
    scratch.run("verify p.csv m.ele --bounds 0,0,1,1").fails(2, &["--bounds", "LAS"]);
    for (options, part) in [
        ("--class 256", "0 to 255"),
        ("--class -1", "'-1'"),
        ("--bounds 0,0,1", "X0,Y0,X1,Y1"),
        ("--bounds 2,0,1,1", "lowest"),
        ("--bounds 0,0,nan,1", "X0,Y0,X1,Y1"),
        ("--bounds 0,0,1,1e-19", "18 digits"),
    ] {
        let run = scratch.run(&format!("triangulate p.las -o m.ele {options}"));
        assert_eq!(run.code, Some(2), "{options}");
        assert!(run.stderr.contains(part), "{run:?}");
    }
    assert_eq!(scratch.files(), ["p.csv"]);
}
