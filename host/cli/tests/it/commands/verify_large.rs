//! `verify --memory`: the check of a mesh that is larger than the memory says what the check in memory says.

use std::process::{Command, Stdio};

use crate::common::{Run, Scratch};

/// A set that the least memory cuts into strips, and its mesh.
fn large(points: u32) -> Scratch {
    let scratch = Scratch::new();
    scratch.run(&format!("generate uniform -n {points} --bits 31 -o p.npy")).ok();
    scratch.run("triangulate p.npy -o m.npy -q").ok();
    scratch
}

fn json(run: &Run) -> serde_json::Value {
    serde_json::from_str(&run.stdout).expect("an object")
}

/// Holds that both checks print the same, but for the memory, and leave nothing behind.
fn compare(scratch: &Scratch, arguments: &str) -> serde_json::Value {
    let right = scratch.run(&format!("verify {arguments} --json"));
    let found = scratch.run(&format!("verify {arguments} --json -q --memory 32M"));
    assert_eq!((found.code, &found.stderr), (right.code, &right.stderr), "{arguments}");
    let (mut report, right) = (json(&found), json(&right));
    if let Some(object) = report.as_object_mut() {
        let peak = object.remove("peak_memory").and_then(|peak| peak.as_u64());
        let memory = object.remove("memory").and_then(|memory| memory.as_u64());
        // The two are told of a mesh that is right.
        assert!(right["valid"] == false || memory == Some(32 << 20));
        assert!(peak.is_none_or(|peak| peak < (32 << 20) * 105 / 100), "{arguments}: {peak:?}");
    }
    assert_eq!(report, right, "{arguments}");
    assert!(!scratch.files().iter().any(|name| name.starts_with('.')), "{arguments}");
    report
}

#[test]
fn a_mesh_beyond_the_memory_is_proved_within_it() {
    let scratch = large(400_000);
    assert_eq!(compare(&scratch, "p.npy m.npy")["valid"], true);
    scratch.run("triangulate p.npy -o u.csv --memory 32M --unordered -q").ok();
    assert_eq!(compare(&scratch, "p.npy u.csv --unordered")["valid"], true);
    scratch.run("verify p.npy u.csv --memory 32M -q").fails(1, &["out of order"]);
    scratch.run("triangulate p.npy -o m.ele --memory 32M -q").ok();
    assert_eq!(
        compare(&scratch, "p.npy m.ele")["triangles"],
        json(&scratch.run("verify p.npy m.npy --json"))["triangles"]
    );
}

#[test]
fn kinds_of_sets_are_proved_within_the_memory() {
    let scratch = Scratch::new();
    for set in ["clusters", "circle", "lattice", "parabola", "line"] {
        scratch.run(&format!("generate {set} -n 150000 -o p.npy")).ok();
        scratch.run("triangulate p.npy -o m.npy -q").ok();
        assert_eq!(compare(&scratch, "p.npy m.npy")["valid"], true, "{set}");
    }
    let rows = |row: &dyn Fn(u32) -> String| (0..200_000).map(row).collect::<String>();
    scratch.write("place.csv", rows(&|_| "7,9\n".to_owned()));
    scratch.write("line.csv", rows(&|k| format!("{}.25,{}.5\n", k % 199_000, 2 * (k % 199_000))));
    // All triangles of this set have the centre as their first corner.
    scratch.run("generate circle -n 150000 --bits 26 -o circle.csv").ok();
    scratch.write("hub.csv", format!("{0},{0}\n{1}", 1 << 25, scratch.read("circle.csv")));
    for points in ["place.csv", "line.csv", "hub.csv"] {
        scratch.run(&format!("triangulate {points} -o m.csv -q")).ok();
        assert_eq!(compare(&scratch, &format!("{points} m.csv"))["valid"], true, "{points}");
    }
}

/// A change of the corners of a triangle, which also sees those of the next one.
type Change<'c> = &'c dyn Fn(&mut [u32; 3], [u32; 3]);

/// The mesh with the bytes of one triangle changed, as `w.npy`.
fn spoil(scratch: &Scratch, triangle: usize, change: impl Fn(&mut [u32; 3], [u32; 3])) {
    let mut bytes = scratch.bytes("m.npy");
    let head = 10 + usize::from(u16::from_le_bytes([bytes[8], bytes[9]]));
    let words = |bytes: &[u8]| [0, 4, 8].map(|at| u32::from_le_bytes(bytes[at..at + 4].try_into().expect("4 bytes")));
    let (at, next) = (head + 12 * triangle, head + 12 * triangle + 12);
    let (mut corners, following) = (words(&bytes[at..next]), words(&bytes[next..next + 12]));
    change(&mut corners, following);
    bytes[at..next].copy_from_slice(corners.map(u32::to_le_bytes).as_flattened());
    scratch.write("w.npy", bytes);
}

#[test]
fn a_wrong_mesh_has_the_same_first_defect() {
    let scratch = large(150_000);
    let defects: [(&str, Change<'_>); 5] = [
        ("names point 4000000000", &|corners, _| corners[2] = 4_000_000_000),
        ("is not counter-clockwise", &|corners, _| corners.swap(1, 2)),
        ("does not start with its smallest", &|corners, _| corners.rotate_left(1)),
        ("is there twice", &|corners, following| *corners = following),
        // What this breaks depends on the triangle.
        ("", &|corners, _| corners[2] ^= 1),
    ];
    for (words, change) in defects {
        for triangle in [3, 150_000, 290_000] {
            spoil(&scratch, triangle, change);
            let reason = compare(&scratch, "p.npy w.npy")["reason"].as_str().map(str::to_owned).unwrap_or_default();
            assert!(reason.contains(words), "{reason} instead of {words}");
        }
    }
    // A mesh of other points.
    scratch.run("generate uniform -n 150000 --bits 31 --seed 2 -o q.npy").ok();
    assert_eq!(compare(&scratch, "q.npy m.npy")["valid"], false);
}

#[test]
fn what_cannot_be_done_within_a_memory_is_said() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n4,0\n0,4\n");
    scratch.write("far.csv", "0,0\n1e10,0\n0,4.5\n");
    scratch.run("triangulate p.csv -o m.csv -q").ok();
    scratch.run("triangulate p.csv -o m.obj -q").ok();
    scratch.run("verify p.csv m.csv --memory 31M").fails(2, &["less than", "give 32M or more"]);
    scratch.run("verify p.csv m.obj --memory 32M").fails(2, &["read as a whole", "npy, csv or ele"]);
    scratch.run("verify p.csv - --format csv --memory 32M").fails(2, &["read more than once"]);
    scratch.run("verify - m.csv --memory 32M").fails(2, &["standard input"]);
    for (wrong, part) in [("--scratch .", "--memory"), ("--memory 32M --quantize fit", "--quantize")] {
        let run = scratch.run(&format!("verify p.csv m.csv {wrong}"));
        assert!(run.code == Some(2) && run.stderr.contains(part), "{run:?}");
    }
    scratch.run("verify p.csv m.csv --memory 32M --constraints m.csv").fails(2, &["constraints", "leave --memory out"]);
    scratch.run("verify far.csv m.csv --memory 32M -q").fails(3, &["37 bits", "work in one memory"]);
    scratch.run("verify p.csv none.csv --memory 32M -q").fails(3, &["none.csv", "No such file"]);
    scratch.run("verify p.csv m.csv --memory 32M --scratch none -q").fails(3, &["none"]);
    scratch.write("short.csv", "0,1,2\n3,4\n");
    scratch.run("verify p.csv short.csv --memory 32M -q").fails(3, &["short.csv", "row 2"]);
    scratch.write("short.ele", "2 3 0\n0 0 1 2\n");
    scratch.run("verify p.csv short.ele --memory 32M -q").fails(1, &["promises 2 triangles"]);
    scratch.write("one.ele", "1 3 0\n1 1 2 3\n");
    scratch.run("verify p.csv one.ele --memory 32M -q").ok();
    let run = scratch.run("verify p.csv m.csv --memory 32M").ok();
    assert!(run.stderr.contains("up to"), "the room on disk is said: {run:?}");
}

/// A run that is killed has no time to tidy up.
#[cfg(unix)]
#[test]
fn a_check_that_is_killed_leaves_nothing() {
    let scratch = large(600_000);
    for signal in ["-KILL", "-INT"] {
        let mut child = scratch.command(["verify", "p.npy", "m.npy", "--memory", "32M", "-q"]);
        let mut child = child.stderr(Stdio::null()).spawn().expect("the command starts");
        std::thread::sleep(std::time::Duration::from_millis(300));
        let _ = Command::new("kill").args([signal, &child.id().to_string()]).status();
        child.wait().expect("the command ends");
        assert_eq!(scratch.files(), ["m.npy", "p.npy"], "{signal}");
    }
}
