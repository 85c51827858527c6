//! Sets in tiles over files: the mesh of `triangulate`, byte for byte, or one sentence.

mod damage;
mod formats;
mod many;
mod pieces;

use crate::common::Scratch;
use incircle_cli::generate::Distribution;

/// An array of NumPy with these points, as integers of 64 bits.
fn array(points: &[[i64; 2]]) -> Vec<u8> {
    let text = format!("{{'descr': '<i8', 'fortran_order': False, 'shape': ({}, 2), }}", points.len());
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    let length = (text.len() + 1).next_multiple_of(64) + 54;
    bytes.extend((length as u16).to_le_bytes());
    bytes.extend(format!("{text:<width$}\n", width = length - 1).bytes());
    bytes.extend(points.iter().flatten().flat_map(|value| value.to_le_bytes()));
    bytes
}

/// The number of tiles in a folder.
fn tiles(scratch: &Scratch, folder: &str) -> usize {
    let names = std::fs::read_dir(scratch.path(folder)).expect("the folder is there");
    names
        .filter(|name| name.as_ref().is_ok_and(|name| name.path().extension().is_some_and(|kind| kind == "points")))
        .count()
}

/// Splits inputs, and triangulates all tiles.
fn split_and_solve(scratch: &Scratch, inputs: &str, points: u32, folder: &str) -> usize {
    scratch.run(&format!("tile split {inputs} --points {points} -o {folder} -q")).ok();
    let count = tiles(scratch, folder);
    (0..count).for_each(|tile| drop(scratch.run(&format!("tile local {folder}/{tile} -q")).ok()));
    count
}

/// Asserts that the tiles of inputs give the mesh of `right`, and returns the number of tiles.
#[track_caller]
fn same_mesh(scratch: &Scratch, inputs: &str, points: u32, right: &str) -> usize {
    let count = split_and_solve(scratch, inputs, points, "tiles");
    let run = scratch.run("tile join tiles -o mesh.npy --memory 64K").ok();
    let bytes = |name: &str| std::fs::read(scratch.path(name)).expect("the mesh is there");
    assert!(bytes("mesh.npy") == bytes(right), "{inputs} in {count} tiles: {run:?}");
    std::fs::remove_dir_all(scratch.path("tiles")).expect("the folder is there");
    count
}

#[test]
fn tiles_of_every_distribution_give_the_mesh_of_triangulate() {
    let scratch = Scratch::new();
    for set in Distribution::ALL {
        scratch.run(&format!("generate {} -n 3000 -o p.npy", set.name())).ok();
        scratch.run("triangulate p.npy -o right.npy -q").ok();
        let counts = [4000, 700, 250].map(|points| same_mesh(&scratch, "p.npy", points, "right.npy"));
        assert_eq!(counts[0], 1, "{}", set.name());
    }
    assert_eq!(scratch.files(), ["mesh.npy", "p.npy", "right.npy"]);
}

#[test]
fn a_large_set_is_joined_in_little_memory() {
    let scratch = Scratch::new();
    for set in ["uniform", "clusters"] {
        scratch.run(&format!("generate {set} -n 600000 --bits 31 -o p.npy")).ok();
        scratch.run("triangulate p.npy -o right.npy -q").ok();
        // A sample chooses the cuts of a set of this size.
        assert!(same_mesh(&scratch, "p.npy", 100_000, "right.npy") > 5);
    }
}

#[test]
fn small_and_degenerate_sets_are_right() {
    let scratch = Scratch::new();
    let sets: Vec<(&str, Vec<[i64; 2]>)> = vec![
        ("none", vec![]),
        ("one", vec![[-5, 7]]),
        ("two", vec![[0, 0], [3, 4]]),
        ("three", vec![[0, 0], [3, 4], [-1, 9]]),
        ("four", vec![[4, 4], [4, 0], [0, 4], [0, 0]]),
        ("five", vec![[0, 0], [10, 0], [0, 10], [10, 10], [5, 3]]),
        ("equal", vec![[3, 4]; 50]),
        ("two places", (0..50).map(|k| [k % 2, 0]).collect()),
        ("row", (0..60).map(|k| [k * 7 % 60, 5]).collect()),
        ("column", (0..60).map(|k| [-3, k * 7 % 60]).collect()),
        ("diagonal", (0..60).map(|k| [k * 7 % 60, k * 7 % 60]).collect()),
        ("lattice", (0..400).map(|k| [k * 7 % 400 / 20, k * 7 % 20]).collect()),
        ("twice", (0..400).map(|k| [k % 200 / 20, k % 20]).collect()),
        ("wide", (0..100).map(|k| [k * 42_949_672, (k * k) % 97 * 44_000_000]).collect()),
        ("far", (0..100).map(|k| [(1 << 50) + k * k % 101, -(1 << 51) + k]).collect()),
    ];
    for (name, points) in sets {
        scratch.write("p.npy", array(&points));
        scratch.run("triangulate p.npy -o right.npy -q").ok();
        for most in [1, 3, 8, 100] {
            let count = same_mesh(&scratch, "p.npy", most, "right.npy");
            assert!(count == 1 || points.len() as u32 > most, "{name}: {count} tiles of {most}");
        }
    }
}

#[test]
fn several_inputs_are_one_set() {
    let scratch = Scratch::new();
    let points: Vec<[i64; 2]> = (0..900).map(|k| [k * k % 1009 - 500, k * 7919 % 1013]).collect();
    scratch.write("all.npy", array(&points));
    for (name, part) in [("a.npy", 0..300), ("b.npy", 300..300), ("c.npy", 300..900)] {
        scratch.write(name, array(&points[part]));
    }
    scratch.run("triangulate all.npy -o right.npy -q").ok();
    assert!(same_mesh(&scratch, "a.npy b.npy c.npy", 100, "right.npy") > 8);
    assert_eq!(same_mesh(&scratch, "a.npy b.npy c.npy", 900, "right.npy"), 1);
    // A set that is read as text has the same points.
    let rows: String = points[300..].iter().map(|[x, y]| format!("{x},{y}\n")).collect();
    scratch.write("c.csv", rows);
    same_mesh(&scratch, "a.npy c.csv", 100, "right.npy");
}

#[test]
fn finished_files_are_skipped_and_missing_ones_are_named() {
    let scratch = Scratch::new();
    scratch.run("generate clusters -n 2000 -o p.npy").ok();
    scratch.run("triangulate p.npy -o right.npy -q").ok();
    let split = "tile split p.npy --points 200 -o t --json";
    // A run that was killed leaves working files, and the next run removes them.
    std::fs::create_dir(scratch.path("t")).expect("a folder can be made");
    scratch.write("t/.3.1.points.part", "half");
    let first = scratch.run(split).ok();
    assert!(!scratch.path("t/.3.1.points.part").exists());
    let count = tiles(&scratch, "t");
    assert!(first.stdout.contains(&format!("\"tiles\":{count}}}")) && first.stdout.contains("\"skipped\":false"));
    assert!(scratch.run(split).ok().stdout.contains("\"skipped\":true"));
    scratch
        .run("tile join t -o m.npy")
        .fails(3, &[&format!("{count} of the {count} tiles"), "tile local t/K", "0, 1, 2"]);
    for tile in (0..count).filter(|&tile| tile != 2) {
        scratch.run(&format!("tile local t/{tile}.points")).ok();
    }
    scratch.run("tile join t -o m.npy").fails(3, &[&format!("1 of the {count} tiles"), "K = 2"]);
    assert!(scratch.run("tile local t/2 --json").ok().stdout.contains("\"skipped\":false"));
    let before = std::fs::metadata(scratch.path("t/2.local")).and_then(|file| file.modified()).expect("it is there");
    let again = scratch.run("tile local t/2 --json").ok();
    assert!(again.stdout.contains("\"skipped\":true"), "{again:?}");
    let after = std::fs::metadata(scratch.path("t/2.local")).and_then(|file| file.modified()).expect("it is there");
    assert_eq!(before, after);
    let report = scratch.run("tile join t -o m.npy --json").ok();
    let report: serde_json::Value = serde_json::from_str(&report.stdout).expect("the report is JSON");
    assert_eq!((&report["points"], &report["tiles"]), (&2000.into(), &count.into()));
    assert_eq!(std::fs::read(scratch.path("m.npy")).ok(), std::fs::read(scratch.path("right.npy")).ok());
}

#[test]
fn tiles_may_be_done_side_by_side() {
    let scratch = Scratch::new();
    scratch.run("generate uniform -n 40000 -o p.npy").ok();
    scratch.run("triangulate p.npy -o right.npy -q").ok();
    scratch.run("tile split p.npy --points 3000 -o t -q").ok();
    let count = tiles(&scratch, "t");
    for pair in (0..count).collect::<Vec<_>>().chunks(2) {
        // Two runs may even do the same tile.
        let both = pair.iter().chain(pair).map(|tile| {
            let mut command = scratch.command(["tile", "local", &format!("t/{tile}"), "-q", "--threads", "1"]);
            command.spawn().expect("the command starts")
        });
        let both: Vec<_> = both.collect();
        both.into_iter().for_each(|mut child| assert!(child.wait().expect("it ends").success()));
    }
    scratch.run("tile join t -o m.npy -q").ok();
    assert_eq!(std::fs::read(scratch.path("m.npy")).ok(), std::fs::read(scratch.path("right.npy")).ok());
}

#[test]
fn any_back_end_does_a_tile() {
    let scratch = Scratch::new();
    // The set needs 20 bits and each tile of it 16, which the core has.
    let points: Vec<[i64; 2]> = (0..600).map(|k| [k % 300 * 3491 + k * k % 17, k * 7919 % 9973]).collect();
    scratch.write("p.npy", array(&points));
    scratch.run("triangulate p.npy -o right.npy -q").ok();
    scratch.run("tile split p.npy --points 30 -o t -q").ok();
    for tile in 0..tiles(&scratch, "t") {
        let backend = ["clock", "model", "cpu?threads=1"][tile % 3];
        scratch.run(&format!("tile local t/{tile} -q --backend {backend}")).ok();
    }
    scratch.run("tile join t -o m.npy -q").ok();
    assert_eq!(std::fs::read(scratch.path("m.npy")).ok(), std::fs::read(scratch.path("right.npy")).ok());
    scratch.run("tile split p.npy --points 3000 -o whole -q").ok();
    scratch.run("tile local whole/0 --backend clock").fails(3, &["whole/0", "20 bits", "16", "--backend cpu"]);
}

/// Most systems let a process have 256 or 1,024 open files, which is less than a large set has tiles.
#[cfg(unix)]
#[test]
fn more_tiles_than_files_that_may_be_open_are_joined() {
    let scratch = Scratch::new();
    // The triangles of the circle come from the joins, and lie in runs in files.
    for (set, points, most) in [("uniform", 4_000, 80), ("circle", 40_000, 1_500)] {
        scratch.run(&format!("generate {set} -n {points} --bits 24 -o p.npy")).ok();
        let count = split_and_solve(&scratch, "p.npy", most, "t");
        assert!(count > 24, "{count} tiles");
        for order in ["", " --unordered"] {
            let program = env!("CARGO_BIN_EXE_incircle");
            let line = format!("ulimit -n 24 && exec '{program}' tile join t -o m.npy --memory 64K -q{order}");
            let run = std::process::Command::new("sh").args(["-c", &line]).current_dir(scratch.path("")).output();
            crate::common::Run::of(run.expect("the shell starts")).ok();
            scratch.run(&format!("verify p.npy m.npy -q{order}")).ok();
        }
        std::fs::remove_dir_all(scratch.path("t")).expect("the folder is there");
    }
}

#[test]
fn a_mesh_replaces_neither_tiles_nor_points() {
    let scratch = Scratch::new();
    scratch.run("generate uniform -n 50 -o p.npy").ok();
    split_and_solve(&scratch, "p.npy", 20, "t");
    for file in ["p.npy", "t/0.local", "t/0.points", "t/manifest"] {
        let before = scratch.bytes(file);
        scratch.run(&format!("tile join t -o {file} --format npy")).fails(2, &[file, "choose another output"]);
        assert!(scratch.bytes(file) == before, "{file}");
    }
    scratch.run("tile split p.npy --points 20 -o -").fails(2, &["give -o a folder"]);
    assert_eq!(scratch.files(), ["p.npy", "t"]);
}
