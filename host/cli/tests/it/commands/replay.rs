//! Tests of `incircle replay`: answers, meshes by the numbers of insertions, formats, back ends, and the report.

mod brute;
mod constraints;
mod film;
mod made;
mod refusals;

use crate::common::Scratch;
use serde_json::Value;

/// Six insertions, of which two are deleted, one is moved, and one is a duplicate. A square of side 4 stays, by the
/// points 1, 2, 4 and 5, with the duplicate 6 of 2.
const SQUARE: &str = "\
# a square
insert 9 9
insert 0 0   # stays
insert 4 0

insert 1 1
insert 4 4
delete 0
insert 7 7
move 5 0 4
\tdelete   3
insert 4 0
";
/// The mesh of that square, whose four points lie on one circle: the diagonal starts at 0 0.
const SQUARE_ELE: &str = "2 3 0\n0 1 2 4\n1 1 4 5\n";

#[test]
fn answers_of_every_kind() {
    let scratch = Scratch::new();
    let script = "locate 1 1\nnearest 1 1\ninsert 0 0\nnearest 5 5\nlocate 0 0\nlocate 1 0\ninsert 4 0\nlocate 1 0\n\
                  insert 0 4\ninsert 4 0\nlocate 4 0\nlocate 1 1\nlocate 2 2\nlocate 5 5\nlocate -1 1\nnearest 2 0\n\
                  nearest 2 2\nnearest 9 9\nnearest 9 1\ndelete 1\nlocate 1 1\nnearest 9 1\ninsert 8 8\nlocate 4 4\n";
    scratch.write("s.txt", script);
    scratch.run("replay s.txt --answers a.txt -q").ok();
    let answers = "none\nnone\n0\nvertex 0\nnone\nedge 0 1\nvertex 1\ntriangle 0 1 2\nedge 1 2\noutside 1 2\n\
                   outside 2 0\n0\n0\n2\n1\ntriangle 0 3 2\n3\ntriangle 2 3 4\n";
    assert_eq!(scratch.read("a.txt"), answers);
    assert_eq!(scratch.run("replay s.txt --answers - -q").ok().stdout, answers);
    let run = scratch.run_with_input("replay - --answers - -q", script.as_bytes()).ok();
    assert_eq!(run.stdout, answers);
}

#[test]
fn meshes_name_points_by_their_insertions() {
    let scratch = Scratch::new();
    scratch.write("s.txt", SQUARE);
    scratch.run("replay s.txt -o m.ele -q").ok();
    assert_eq!(scratch.read("m.ele"), SQUARE_ELE);
    scratch.run("replay s.txt -o m.csv -q").ok();
    assert_eq!(scratch.read("m.csv"), "1,2,4\n1,4,5\n");
    // Deleted points keep their last places, so that rows are insertions.
    scratch.run("replay s.txt -o m.obj -q").ok();
    let points = "v 9 9 0\nv 0 0 0\nv 4 0 0\nv 1 1 0\nv 4 4 0\nv 0 4 0\nv 4 0 0\n";
    assert_eq!(scratch.read("m.obj"), format!("{points}f 2 3 5\nf 2 5 6\n"));
    scratch.run("replay s.txt -o m.json -q").ok();
    let mesh: Value = serde_json::from_str(&scratch.read("m.json")).expect("JSON");
    assert_eq!(mesh["triangles"], serde_json::json!([[1, 2, 4], [1, 4, 5]]));
    assert_eq!(mesh["hull"], serde_json::json!([1, 2, 4, 5]));
    assert_eq!(mesh["duplicates"], serde_json::json!([[6, 2]]));
    assert_eq!(mesh["points"].as_array().map(Vec::len), Some(7));
    // A picture has the living points alone: nine units wide it would show the deleted ones.
    scratch.run("replay s.txt -o m.svg -q").ok();
    let picture = scratch.read("m.svg");
    assert!(picture.contains("Delaunay triangulation: 5 points, 2 triangles"), "{picture}");
    for name in ["m.ele", "m.csv", "m.obj", "m.json"] {
        scratch.run(&format!("verify s.txt {name} --script")).ok();
    }
}

#[test]
fn every_format_is_written_and_verified() {
    let scratch = Scratch::new();
    for (name, script) in
        [("square", SQUARE), ("none", "#\n"), ("asked", "locate 1 2\n"), ("gone", "insert 1 2\ndelete 0\n")]
    {
        scratch.write("s.txt", script);
        for format in ["ele", "obj", "ply", "ply-binary", "vtk", "geojson", "json", "csv", "npy", "svg"] {
            scratch.run(&format!("replay s.txt -o m.{format} --format {format} -q")).ok();
            if !["vtk", "geojson", "svg"].contains(&format) {
                scratch.run(&format!("verify s.txt m.{format} --format {format} --script -q")).ok();
            }
        }
        assert!(name != "none" || scratch.read("m.obj").is_empty());
    }
    scratch.write("s.txt.gz", "");
    scratch.write("s.txt", SQUARE);
    scratch.run("replay s.txt -o m.obj.zst --answers a.txt.gz -q").ok();
    scratch.run("verify s.txt m.obj.zst --script -q").ok();
}

#[test]
fn wrong_meshes_of_scripts_are_rejected() {
    let scratch = Scratch::new();
    scratch.write("s.txt", SQUARE);
    for (mesh, part) in [
        ("1 3 0\n0 1 2 4\n", "the living points counted from 0"),
        ("2 3 0\n0 1 2 5\n1 2 4 5\n", "not the canonical"),
        ("2 3 0\n0 0 1 3\n1 0 3 4\n", "has the point 0, which does not live at the end"),
        ("2 3 0\n0 1 2 4\n1 1 4 99\n", "has the point 99"),
    ] {
        scratch.write("m.ele", mesh);
        scratch.run("verify s.txt m.ele --script").fails(1, &["m.ele", "s.txt", part]);
        let run = scratch.run("verify s.txt m.ele --script --json");
        assert_eq!(run.code, Some(1), "{run:?}");
        let told: Value = serde_json::from_str(&run.stdout).expect("JSON");
        assert_eq!(told["valid"], false);
    }
    let run = scratch.run("verify s.txt m.ele --script --quantize fit");
    assert_eq!(run.code, Some(2), "{run:?}");
}

#[test]
fn numbers_count_as_they_are_written() {
    let scratch = Scratch::new();
    let square = |far: &str| {
        format!("insert 0.1 0.1\ninsert 0.3 0.1\ninsert 0.3 0.3\ninsert 0.1 0.3\nlocate 0.2 0.2\nlocate {far}\n")
    };
    // As decimals, the four lie on one circle, and the middle lies on the diagonal.
    scratch.write("s.txt", square("1 1"));
    let run = scratch.run("replay s.txt --answers a.txt").ok();
    assert!(run.stderr.starts_with("lattice: decimals, steps of 1e-1, 4 bits\n"), "{run:?}");
    assert_eq!(scratch.read("a.txt"), "edge 0 2\noutside 1 2\n");
    // The lattice spans questions, too: a far one leaves doubles.
    scratch.write("s.txt", square("1e300 -1e300"));
    let run = scratch.run("replay s.txt --answers a.txt --json").ok();
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!(report["lattice"]["kind"], "doubles");
    assert_eq!(report["lattice"]["rounded"], 12);
    // Whole numbers of 64 bits stay exact.
    let last = i64::MAX;
    scratch.write(
        "s.txt",
        format!("insert {last} 0\ninsert {} 0\ninsert {} 9\nlocate {} 1\n", last - 2, last - 1, last - 1),
    );
    scratch.run("replay s.txt --answers a.txt -o m.obj -q").ok();
    assert_eq!(scratch.read("a.txt"), "triangle 0 2 1\n");
    assert!(scratch.read("m.obj").starts_with(&format!("v {last} 0 0\n")));
}

#[test]
fn devices_make_the_same_mesh() {
    let scratch = Scratch::new();
    scratch.run("generate churn -n 60 --commands 2000 --seed 5 -o s.txt").ok();
    for format in ["ele", "json", "ply", "svg"] {
        scratch.run(&format!("replay s.txt -o cpu.{format} --answers cpu.txt -q")).ok();
        for backend in ["model", "clock", "clock?config=dual"] {
            scratch.run(&format!("replay s.txt -o m.{format} --answers a.txt --backend {backend} -q")).ok();
            assert_eq!(scratch.read(&format!("m.{format}")), scratch.read(&format!("cpu.{format}")), "{backend}");
            assert_eq!(scratch.read("a.txt"), scratch.read("cpu.txt"));
        }
    }
    let run = scratch.run("replay s.txt -o m.ele --backend clock?config=dual").ok();
    assert!(run.stderr.contains("changes and answers by cpu, mesh by clock"), "{run:?}");
    let run = scratch.run("replay s.txt -o m.ele --backend clock").ok();
    assert!(!run.stderr.contains("by cpu"), "{run:?}");
    let full = "all 8 places that clock:tiny can hold have points";
    scratch.run("replay s.txt -o none.ele --backend clock?config=tiny").fails(7, &["s.txt: row", full]);
    assert!(!scratch.files().iter().any(|file| file.contains("none")));
}

#[test]
fn the_model_keeps_the_mesh() {
    let scratch = Scratch::new();
    scratch.run("generate tracks -n 100 --frames 20 --seed 9 -o s.txt").ok();
    scratch.run("replay s.txt -o cpu.ele --answers cpu.txt --film cpu.svg -q").ok();
    let run = scratch.run("replay s.txt -o m.ele --answers m.txt --film m.svg --backend model --json").ok();
    for (model, cpu) in [("m.ele", "cpu.ele"), ("m.txt", "cpu.txt"), ("m.svg", "cpu.svg")] {
        assert!(scratch.read(model) == scratch.read(cpu), "{model}");
    }
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!((&report["changes_by"], &report["mesh_by"]), (&"model".into(), &"model".into()));
    let run = scratch.run("replay s.txt -o m.ele --backend model").ok();
    assert!(run.stderr.contains(" on the hull; model, "), "{run:?}");
}

#[test]
fn a_full_memory_ends_the_run() {
    let scratch = Scratch::new();
    let square = "insert 0 0\ninsert 9 0\ninsert 9 9\ninsert 0 9\n";
    // A duplicate takes no room, and neither does a point in the place of a deleted one.
    scratch.write("s.txt", format!("{square}insert 9 9\ndelete 0\ninsert 1 1\nmove 4 5 5\n"));
    let full = "all 4 places that model can hold have points: delete some, or use a larger device";
    let run = "replay s.txt -o m.ele --backend model?capacity=4";
    scratch.run(run).fails(7, &["s.txt: row 8: ", full]);
    scratch.write("s.txt", format!("{square}insert 5 5\n"));
    scratch.run(run).fails(7, &["s.txt: row 5: ", full]);
    scratch.write("s.txt", format!("{square}insert 9 9\ndelete 0\ninsert 1 1\nmove 4 1 1\nmove 1 8 1\n"));
    scratch.run(run).ok();
    scratch.run("verify s.txt m.ele --script -q").ok();
}

#[test]
fn devices_refuse_what_they_cannot_hold() {
    let scratch = Scratch::new();
    // The question alone needs 17 bits.
    scratch.write("s.txt", "insert 0 0\ninsert 1 0\ninsert 0 1\nlocate 70000 0\n");
    let parts = ["s.txt", "need 17 bits, questions included", "clock has coordinates of 16 bits", "--backend cpu"];
    scratch.run("replay s.txt -o m.ele --backend clock").fails(3, &parts);
    scratch.run("replay s.txt -o m.ele --backend model?coord-bits=16").fails(3, &["need 17 bits"]);
    scratch.run("replay s.txt -o m.ele --backend model").ok();
    scratch.write("s.txt", "insert 0.1 1e30\n");
    scratch.run("replay s.txt -o n.ele --backend model").fails(3, &["no lattice of up to 32 bits"]);
    assert_eq!(scratch.files(), ["m.ele", "s.txt"]);
}

#[test]
fn the_report_counts_commands() {
    let scratch = Scratch::new();
    scratch.write("s.txt", format!("{SQUARE}locate 1 1\nnearest 1 1\nnearest 1 2\n"));
    let run = scratch.run("replay s.txt -o m.ele --film f.svg --json").ok();
    assert_eq!((run.stderr.as_str(), run.stdout.lines().count()), ("", 1));
    let report: Value = serde_json::from_str(&run.stdout).expect("JSON");
    let commands = serde_json::json!({ "insert": 7, "delete": 2, "move": 1, "locate": 1, "nearest": 2, "constrain": 0, "unconstrain": 0 });
    assert_eq!(report["commands"], commands);
    for (key, value) in
        [("points", 7), ("living", 5), ("most_living", 5), ("duplicates", 1), ("triangles", 2), ("hull", 4)]
    {
        assert_eq!(report[key], value, "{key}");
    }
    for (key, value) in [("changes_by", "cpu"), ("mesh_by", "cpu")] {
        assert_eq!(report[key], value, "{key}");
    }
    assert_eq!(report["film"], serde_json::json!({ "frames": 13, "commands_per_frame": 1 }));
    for stage in ["load", "quantise", "open", "replay", "triangulate", "write", "total"] {
        assert!(report["seconds"][stage].is_f64(), "{stage}");
    }
    let report = scratch.run("replay s.txt -o m.ele --backend clock --json").ok().stdout;
    let report: Value = serde_json::from_str(&report).expect("JSON");
    assert_eq!(
        (&report["changes_by"], &report["mesh_by"], &report["config"]),
        (&"clock".into(), &"clock".into(), &"tiny".into())
    );
    assert!(report["film"].is_null());
    let lines = scratch.run("replay s.txt -o m.ele").ok().stderr;
    assert!(
        lines.contains("13 commands: 7 insert, 2 delete, 1 move, 1 locate, 2 nearest, 0 constrain, 0 unconstrain\n"),
        "{lines}"
    );
    assert!(lines.contains("\n5 living points, 2 triangles, 4 points on the hull; cpu, "), "{lines}");
}
