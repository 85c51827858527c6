//! Sets larger than the memory: `triangulate --memory` in tiles over files gives the mesh of the run in memory, byte
//! for byte, or one sentence.

use crate::common::{Run, Scratch};
use incircle_cli::generate::Distribution;

/// A set that the least memory cannot hold as one tile, and its mesh.
fn large() -> Scratch {
    let scratch = Scratch::new();
    scratch.run("generate uniform -n 500000 --bits 31 -o p.npy").ok();
    scratch.run("triangulate p.npy -o right.npy -q").ok();
    scratch
}

#[test]
fn every_distribution_has_the_mesh_of_the_run_in_memory() {
    let scratch = Scratch::new();
    for set in Distribution::ALL {
        scratch.run(&format!("generate {} -n 250000 -o p.npy", set.name())).ok();
        scratch.run("triangulate p.npy -o right.npy -q").ok();
        let run = scratch.run("triangulate p.npy -o mesh.npy --memory 32M --threads 1").ok();
        assert!(scratch.bytes("mesh.npy") == scratch.bytes("right.npy"), "{}: {run:?}", set.name());
    }
    assert_eq!(scratch.files(), ["mesh.npy", "p.npy", "right.npy"]);
}

#[test]
fn a_large_set_takes_the_memory_that_it_is_given() {
    let scratch = large();
    for threads in [1, 3] {
        let run = scratch.run(&format!("triangulate p.npy -o m.npy --memory 32M --threads {threads} --json")).ok();
        let report: serde_json::Value = serde_json::from_str(&run.stdout).expect("an object");
        assert!(scratch.bytes("m.npy") == scratch.bytes("right.npy"), "{report}");
        assert!(report["tiles"].as_u64() > Some(2), "{report}");
        assert_eq!((&report["points"], &report["memory"]), (&500_000.into(), &(32 << 20).into()));
        if let Some(peak) = report["peak_memory"].as_u64() {
            assert!(peak < (32 << 20) * 105 / 100, "{report}");
        }
    }
}

/// With these numbers the tiles are nearly as large as they may be, and each of two threads does several.
#[cfg(target_os = "linux")]
#[test]
fn tiles_of_the_largest_size_take_the_memory_that_they_are_given() {
    let scratch = Scratch::new();
    for points in [2_130_000, 2_800_000] {
        scratch.run(&format!("generate uniform -n {points} --bits 31 -o p.npy")).ok();
        let run = scratch.run("triangulate p.npy -o m.npy --memory 64M --threads 2 --json").ok();
        let report: serde_json::Value = serde_json::from_str(&run.stdout).expect("an object");
        assert!(report["peak_memory"].as_u64() < Some((64 << 20) * 105 / 100), "{report}");
    }
}

/// Triangulates `p.npy` or another file within 32 MiB, and holds that the peak and the mesh are right.
fn check_within_least_memory(scratch: &Scratch, points: &str) {
    scratch.run(&format!("triangulate {points} -o right.npy -q")).ok();
    let run = scratch.run(&format!("triangulate {points} -o m.npy --memory 32M --threads 2 --json")).ok();
    let report: serde_json::Value = serde_json::from_str(&run.stdout).expect("an object");
    assert!(scratch.bytes("m.npy") == scratch.bytes("right.npy"), "{report}");
    if let Some(peak) = report["peak_memory"].as_u64() {
        assert!(peak < (32 << 20) * 105 / 100, "{report}");
    }
}

/// Nearly all large circles through three points of a curve have no other point inside, and reach beyond every tile.
#[test]
fn points_on_curves_take_the_memory_that_they_are_given() {
    let scratch = Scratch::new();
    for set in ["parabola", "circle", "two-chains"] {
        scratch.run(&format!("generate {set} -n 500000 --bits 26 -o p.npy")).ok();
        check_within_least_memory(&scratch, "p.npy");
    }
}

#[test]
fn points_at_one_place_or_on_one_line_take_the_memory_that_they_are_given() {
    let scratch = Scratch::new();
    let rows = |row: &dyn Fn(u32) -> String| (0..600_000).map(row).collect::<String>();
    scratch.write("place.csv", rows(&|_| "7,9\n".to_owned()));
    scratch.write("line.csv", rows(&|k| format!("{},{}\n", k % 599_000, 2 * (k % 599_000))));
    scratch.write("half.csv", rows(&|k| if k % 2 == 0 { "7,9\n".to_owned() } else { format!("{},{}\n", k % 997, k) }));
    for points in ["place.csv", "line.csv", "half.csv"] {
        check_within_least_memory(&scratch, points);
    }
}

/// A place may have more points than the memory holds.
#[test]
fn any_number_of_points_at_one_place_takes_the_memory_that_it_is_given() {
    let scratch = Scratch::new();
    let mut file = b"\x93NUMPY\x01\x00\x76\x00".to_vec();
    let head = "{'descr': '<i4', 'fortran_order': False, 'shape': (6000000, 2), }";
    file.extend(format!("{head:<117}\n").bytes());
    file.extend([7u32, 9].map(u32::to_le_bytes).as_flattened().repeat(6_000_000));
    scratch.write("p.npy", file);
    check_within_least_memory(&scratch, "p.npy");
}

/// The hull of a set is joined at once, so a set that has very many points there needs the memory for these.
#[test]
fn a_hull_that_does_not_fit_is_refused_and_goes_on_in_more_memory() {
    let scratch = Scratch::new();
    scratch.run("generate circle -n 600000 --bits 31 -o p.npy").ok();
    scratch.run("triangulate p.npy -o right.npy -q").ok();
    let refused = scratch.run("triangulate p.npy -o m.npy --memory 32M -q").fails(3, &["joined at once", "--resume"]);
    let mebibytes = refused.stderr.split("go on with --memory ").nth(1).and_then(|rest| rest.split('M').next());
    let mebibytes: u64 = mebibytes.and_then(|number| number.parse().ok()).expect("the memory that is needed");
    let run = format!("triangulate p.npy -o m.npy --resume --json --memory {mebibytes}M");
    let report: serde_json::Value = serde_json::from_str(&scratch.run(&run).ok().stdout).expect("an object");
    assert!(scratch.bytes("m.npy") == scratch.bytes("right.npy"), "{report}");
    assert!(report["peak_memory"].as_u64() < Some((mebibytes << 20) * 105 / 100), "{report}");
}

#[test]
fn unordered_triangles_are_those_of_the_mesh() {
    let scratch = large();
    scratch.run("triangulate p.npy -o m.npy --memory 32M --unordered").ok();
    assert!(scratch.bytes("m.npy") != scratch.bytes("right.npy"));
    scratch.run("verify p.npy m.npy").fails(1, &["not the canonical"]);
    scratch.run("verify p.npy m.npy --unordered -q").ok();
    scratch.run("triangulate p.npy -o m.csv --memory 32M").ok();
    scratch.run("triangulate p.npy -o right.csv -q").ok();
    assert!(scratch.bytes("m.csv") == scratch.bytes("right.csv"));
}

#[test]
fn several_inputs_are_one_set_with_tiles_and_without() {
    let scratch = Scratch::new();
    scratch.write("a.csv", "x,y\n0.5,0\n9,0.25\n0,9\n");
    scratch.write("b.csv", "x,y\n9,9\n4,5\n");
    scratch.write("all.csv", "x,y\n0.5,0\n9,0.25\n0,9\n9,9\n4,5\n");
    scratch.run("triangulate all.csv -o right.npy -q").ok();
    for options in ["", "--memory 32M", "--memory 32M --backend model"] {
        scratch.run(&format!("triangulate a.csv b.csv -o m.npy {options}")).ok();
        assert!(scratch.bytes("m.npy") == scratch.bytes("right.npy"), "{options}");
    }
    scratch.run("verify a.csv b.csv m.npy -q").ok();
    scratch.run("verify b.csv a.csv m.npy -q").fails(1, &["the set of 2 files"]);
    scratch.run("triangulate a.csv b.csv -o m.obj -q").ok();
    scratch.run("triangulate all.csv -o right.obj -q").ok();
    assert_eq!(scratch.read("m.obj"), scratch.read("right.obj"));
    // Numbers of several kinds in one set become doubles, and one height too few leaves all out.
    scratch.write("c.xyz", "1e-300 2 7\n3 1 8\n");
    let run = scratch.run("triangulate a.csv c.xyz -o m.obj").ok();
    assert!(run.stderr.contains("z is left out"), "{run:?}");
    scratch.run("verify a.csv c.xyz m.obj -q").ok();
    scratch.run("triangulate - - -o m.npy").fails(2, &["give '-' once"]);
    scratch.run("triangulate a.csv m.npy -o m.npy").fails(2, &["both the input and the output"]);
}

/// Runs the command under a limit of the size of a file, in blocks of 512 bytes. The first write beyond it kills the
/// process, without a chance to tidy up.
#[cfg(target_os = "linux")]
fn run_until_killed(scratch: &Scratch, arguments: &str, blocks: u32) {
    let program = env!("CARGO_BIN_EXE_incircle");
    let line = format!("ulimit -c 0 && ulimit -f {blocks} && exec '{program}' {arguments}");
    let run = std::process::Command::new("sh").args(["-c", &line]).current_dir(scratch.path("")).output();
    let run = run.expect("the shell starts");
    assert_eq!(run.status.code(), None, "not killed: {run:?}");
}

/// The files of tiles, which a run that was killed has left.
#[cfg(target_os = "linux")]
fn finished_tiles(scratch: &Scratch) -> Vec<(String, std::time::SystemTime)> {
    let files = std::fs::read_dir(scratch.path(".m.npy.tiles")).expect("the tiles are there");
    let mut found: Vec<_> = files
        .map(|file| file.expect("an entry"))
        .map(|file| (file.file_name().to_string_lossy().into_owned(), file.metadata().and_then(|meta| meta.modified())))
        .filter(|(name, _)| name.ends_with(".local") && !name.starts_with('.'))
        .map(|(name, time)| (name, time.expect("a time")))
        .collect();
    found.sort();
    found
}

#[test]
#[cfg(target_os = "linux")]
fn a_killed_run_goes_on() {
    let scratch = large();
    let command = "triangulate p.npy -o m.npy --memory 32M --threads 1";
    // A file of points has 0.75 MB, one of a tile 1.5 MB, and the mesh 12 MB.
    for (blocks, in_mesh) in [(2 << 10, false), (16 << 10, true)] {
        run_until_killed(&scratch, command, blocks);
        let parts = scratch.files().into_iter().filter(|name| name.ends_with(".part")).count();
        assert_eq!(parts, usize::from(in_mesh), "{:?}", scratch.files());
        let finished = finished_tiles(&scratch);
        assert_eq!(!finished.is_empty(), in_mesh, "{finished:?}");
        assert!(!scratch.path("m.npy").exists());
        scratch.run(command).fails(3, &[".m.npy.tiles", "give --resume"]);
        // Other points are found, and less memory makes no other tiles.
        scratch.run("generate uniform -n 500000 --bits 30 -o q.npy").ok();
        let other = "triangulate q.npy -o m.npy --memory 32M --resume";
        let refused =
            scratch.run(other).fails(3, &["tiles of another run", "choose another folder, or remove this one"]);
        assert!(!refused.stderr.contains("--resume goes on"), "{refused:?}");
        assert_eq!(finished_tiles(&scratch), finished);
        scratch.run("triangulate p.npy -o m.npy --memory 64M --resume").ok();
        assert!(scratch.bytes("m.npy") == scratch.bytes("right.npy"), "{blocks} blocks");
        assert_eq!(scratch.files(), ["m.npy", "p.npy", "q.npy", "right.npy"]);
        std::fs::remove_file(scratch.path("m.npy")).expect("it is there");
    }
    // With nothing to go on from, a run begins anew.
    scratch.run("triangulate p.npy -o m.npy --memory 32M --resume -q").ok();
}

/// Finished tiles are read, and not made again.
#[test]
#[cfg(target_os = "linux")]
fn finished_tiles_are_kept() {
    let scratch = large();
    run_until_killed(&scratch, "triangulate p.npy -o m.npy --memory 64M --threads 1", 16 << 10);
    let finished = finished_tiles(&scratch);
    run_until_killed(&scratch, "triangulate p.npy -o m.npy --memory 64M --threads 1 --resume", 16 << 10);
    assert_eq!(finished_tiles(&scratch), finished);
    // Tiles of the run with more memory do not fit less memory.
    let less = "triangulate p.npy -o m.npy --memory 32M --resume";
    scratch.run(less).fails(2, &["the 32 MiB of --memory do not hold a tile", "M or more"]);
    scratch.run("triangulate p.npy -o m.npy --memory 64M --resume").ok();
    assert!(scratch.bytes("m.npy") == scratch.bytes("right.npy"));
}

#[test]
fn what_cannot_be_done_in_tiles_is_refused() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n9,0\n0,9\n");
    let refused = |options: &str, code: i32, parts: &[&str]| {
        scratch.run(&format!("triangulate p.csv {options}")).fails(code, parts);
        assert_eq!(scratch.files(), ["p.csv"], "{options}");
    };
    refused("-o m.npy --memory 1M", 2, &["32M or more"]);
    refused("-o m.obj --memory 32M", 2, &["npy, csv or ele"]);
    refused("-o m.npy --memory 32M --quantize fit", 2, &["--quantize"]);
    refused("-o m.npy --memory 32M --backend cpu --backend model", 2, &["one --backend"]);
    refused("-o m.npy --unordered --scratch gone", 3, &["gone cannot be used"]);
    refused("-o m.npy --scratch p.csv", 3, &["p.csv is no folder"]);
    refused("-o - --format csv --memory 32M", 2, &["--scratch"]);
    refused("-o . --format npy --memory 32M", 3, &[". cannot be written", "a folder"]);
    refused("-o gone/ --format npy --memory 32M", 3, &["gone/ cannot be written", "a folder"]);
    refused("-o gone/. --format npy", 3, &["gone/. cannot be written", "a folder"]);
    // A back end that cannot do the work ends the run before the set is cut.
    refused("-o m.npy --memory 32M --backend model --contexts 3", 2, &["3 contexts"]);
    refused("-o m.npy --memory 32M --backend clock?config=quad --contexts 40", 2, &["40 contexts", "choose fewer"]);
    refused("-o m.npy --memory 32M --backend serial:/dev/gone", 4, &["/dev/gone"]);

    scratch.write("d.csv", "0,0\n0.1,1e-300\n3,1e300\n");
    scratch.run("triangulate d.csv -o m.npy --memory 32M").fails(3, &["lattice"]);
    assert_eq!(scratch.files(), ["d.csv", "p.csv"]);
}

#[test]
fn a_mesh_on_standard_output_needs_a_scratch_folder() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n9,0\n0,9\n9,9\n");
    let run = scratch.run("triangulate p.csv -o - --format csv --memory 32M --scratch . -q").ok();
    assert_eq!(run.stdout, "0,1,3\n0,3,2\n");
    assert_eq!(scratch.files(), ["p.csv"]);
}

/// Tiles do not lie beside a device, where no folder belongs.
#[cfg(target_os = "linux")]
#[test]
fn a_mesh_on_a_device_needs_a_scratch_folder() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n9,0\n0,9\n9,9\n");
    let command = "triangulate p.csv -o /dev/null --format csv --memory 32M -q";
    scratch.run(command).fails(2, &["/dev/null is no file", "give --scratch"]);
    scratch.run(&format!("{command} --scratch .")).ok();
    assert_eq!(scratch.files(), ["p.csv"]);
}

/// Only the files of the run are removed, also from a folder behind a link.
#[cfg(unix)]
#[test]
fn files_of_others_stay_in_the_folder_of_the_tiles() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n9,0\n0,9\n9,9\n");
    std::fs::create_dir(scratch.path("mine")).expect("a folder can be made");
    std::os::unix::fs::symlink("mine", scratch.path(".m.npy.tiles")).expect("a link can be made");
    let others = ["a.points", "letter.txt", ".hidden"];
    others.iter().for_each(|name| drop(scratch.write(&format!("mine/{name}"), "mine")));
    scratch.run("triangulate p.csv -o m.npy --memory 32M -q").ok();
    let left = std::fs::read_dir(scratch.path("mine")).expect("it is there").count();
    assert_eq!(left, others.len());
    assert!(others.iter().all(|name| scratch.read(&format!("mine/{name}")) == "mine"));
}

/// Another process that works in the folder is told, and not disturbed.
#[test]
fn two_runs_do_not_share_a_folder() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n9,0\n0,9\n");
    std::fs::create_dir(scratch.path(".m.npy.tiles")).expect("a folder");
    let lock = std::fs::File::create(scratch.path(".m.npy.tiles/lock")).expect("a file");
    lock.lock().expect("nobody else has it");
    scratch.run("triangulate p.csv -o m.npy --memory 32M").fails(3, &["another process works in"]);
    // Its tiles are no ones to go on with or to remove, either.
    scratch.write(".m.npy.tiles/manifest", "of a run");
    scratch.run("triangulate p.csv -o m.npy --memory 32M").fails(3, &["another process works in"]);
    std::fs::remove_file(scratch.path(".m.npy.tiles/manifest")).expect("it is there");
    assert!(scratch.path(".m.npy.tiles/lock").exists());
    drop(lock);
    let run: Run = scratch.run("triangulate p.csv -o m.npy --memory 32M -q").ok();
    assert_eq!(scratch.files(), ["m.npy", "p.csv"], "{run:?}");
}
