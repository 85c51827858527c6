//! Tests of `--crossings snap`.

use crate::common::Scratch;

/// Two streets that cross at (4/3, 4/3), and a third that crosses both.
const STREETS: &str = "0,0\n3,3\n0,2\n4,0\n1,3\n2,0\n";
const EDGES: &str = "0,1\n2,3\n4,5\n";

fn streets() -> Scratch {
    let scratch = Scratch::new();
    scratch.write("p.csv", STREETS);
    scratch.write("e.csv", EDGES);
    scratch
}

#[test]
fn crossings_become_points_and_verify_takes_the_mesh() {
    let scratch = streets();
    scratch
        .run("triangulate p.csv -o m.ele --constraints e.csv")
        .fails(3, &["crosses constraint 0", "or let --crossings snap make points of crossings"]);
    let told = scratch.run("triangulate p.csv -o m.ele --constraints e.csv --crossings snap --json").ok();
    let report: serde_json::Value = serde_json::from_str(&told.stdout).expect("JSON");
    assert_eq!((&report["plan"]["snapping"]["new_points"], &report["plan"]["constraints"]), (&3.into(), &3.into()));
    let moved = report["plan"]["snapping"]["largest_displacement"].as_f64().expect("a number");
    assert!(moved > 0.0 && moved < 0.708 / 256.0, "{moved}");
    let node = scratch.read("m.node");
    // (4/3, 4/3) is (341.33, 341.33) in steps of 1/256.
    assert!(node.starts_with("9 2 0 0\n0 0 0\n1 3 3\n") && node.contains(" 1.33203125 1.33203125\n"), "{node}");
    assert!(scratch.read("m.poly").starts_with("0 2 0 0\n9 1\n0 0 "), "{}", scratch.read("m.poly"));
    scratch.run("verify m.poly m.ele --domain all").ok();
    scratch.run("verify p.csv m.ele --constraints e.csv --crossings snap").ok();
    // The snapped plan has no crossing left, and snapping it again changes nothing.
    scratch.run("triangulate m.poly -o again.ele --domain all --crossings snap").ok();
    assert_eq!(scratch.read("again.ele"), scratch.read("m.ele"));
    assert!(!scratch.files().contains(&"again.node".to_owned()));
}

#[test]
fn rings_that_cross_themselves_have_a_domain() {
    let scratch = Scratch::new();
    // A bow tie, whose two wings are the domain.
    scratch.write("tie.wkt", "POLYGON ((0 0, 9 7, 9 0, 0 8, 0 0))");
    scratch.run("triangulate tie.wkt -o m.obj --crossings snap").ok();
    scratch.run("verify tie.wkt m.obj --crossings snap").ok();
    scratch.run("verify tie.wkt m.obj").fails(1, &["are not the canonical constrained Delaunay"]);
    let mesh = scratch.read("m.obj");
    assert_eq!((mesh.matches("\nf ").count(), mesh.matches("v ").count()), (2, 6), "{mesh}");
}

#[test]
fn decimals_and_doubles_keep_their_places() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "4500000.25,0.5\n4500003.25,3.5\n4500000.25,2.5\n4500004.25,0.5\n");
    scratch.write("e.csv", "0,1\n2,3\n");
    scratch.run("triangulate p.csv -o m.obj --constraints e.csv --crossings snap").ok();
    let mesh = scratch.read("m.obj");
    assert!(mesh.starts_with("v 4500000.25 0.5 0\n") && mesh.matches("v ").count() == 5, "{mesh}");
    scratch.run("verify p.csv m.obj --constraints e.csv --crossings snap").ok();
}

#[test]
fn sets_without_room_are_told_to_quantize() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n99999999,99999999\n0,77777777\n88888888,0\n");
    scratch.write("e.csv", "0,1\n2,3\n");
    let command = "triangulate p.csv -o m.ele --constraints e.csv --crossings snap";
    scratch.run(command).fails(
        3,
        &["the points need 27 of 32 bits, which leaves 5 spare where", "(--quantize), such as --quantize fit"],
    );
    scratch.run(&format!("{command} --quantize fit --coord-bits 24")).ok();
    scratch.run("verify m.poly m.ele --domain all").ok();
    scratch.run("verify p.csv m.ele --constraints e.csv --crossings snap --quantize fit --coord-bits 24").ok();
    scratch.run(&command.replace("m.ele", "m.csv")).fails(3, &["need 27 of 32 bits"]);
    scratch.run(&format!("{} --quantize fit --coord-bits 16", command.replace("m.ele", "m.csv"))).fails(2, &[".node"]);
    scratch.write("q.csv", "0.1,0.7\n0.9,1e-9\n0.123456789012345678,0.1\n1e6,0.9\n");
    let none = command.replace("p.csv", "q.csv");
    scratch.run(&none).fails(3, &["crosses constraint 0"]);
}

#[test]
fn crossings_of_points_without_a_grid_name_the_option_that_makes_one() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0.1,0\n1.7e-9,1\n0,1.3e-14\n2e9,0.123456789012\n");
    scratch.write("e.csv", "0,1\n2,3\n");
    let command = "triangulate p.csv -o m.ele --constraints e.csv --crossings snap";
    scratch.run(command).fails(3, &["crosses constraint 0", "--quantize fit --coord-bits 24", "no grid"]);
    assert!(!scratch.files().contains(&"m.ele".to_owned()));
    scratch.run(&format!("{command} --quantize fit --coord-bits 24")).ok();
}

#[test]
fn packed_meshes_have_packed_files_beside_them() {
    let scratch = streets();
    scratch.run("triangulate p.csv -o j.ele.gz --constraints e.csv --crossings snap").ok();
    assert_eq!(scratch.files(), ["e.csv", "j.ele.gz", "j.node.gz", "j.poly.gz", "p.csv"]);
    scratch.run("verify j.poly.gz j.ele.gz --domain all").ok();
    scratch.run("triangulate p.csv -o j.ele --constraints e.csv --crossings snap").ok();
    // A packed plan may have its points in a file that is not packed.
    std::fs::remove_file(scratch.path("j.node.gz")).expect("the file was written");
    scratch.run("verify j.poly.gz j.ele --domain all").ok();
}
