//! Tests with damaged files, files of other runs, and full disks.

#[cfg(unix)]
use std::io::Write;

use super::{array, split_and_solve, tiles};
use crate::common::Scratch;
use incircle_cli::generate::SplitMix64;

/// A small set in a few tiles, all triangulated, and its mesh.
fn small() -> (Scratch, Vec<u8>) {
    let scratch = Scratch::new();
    let points: Vec<[i64; 2]> = (0..24).map(|k| [k * k % 13, k * 5 % 11]).collect();
    scratch.write("p.npy", array(&points));
    scratch.run("triangulate p.npy -o right.npy -q").ok();
    split_and_solve(&scratch, "p.npy", 10, "t");
    let right = std::fs::read(scratch.path("right.npy")).expect("the mesh is there");
    (scratch, right)
}

/// Runs a verb with a damaged file, which must fail with one sentence or do no harm.
fn try_damaged(scratch: &Scratch, verb: &str, what: &str, right: &[u8]) {
    let run = scratch.run(verb);
    match run.code {
        Some(0) => {
            let mesh = std::fs::read(scratch.path("m.npy")).expect("the mesh is there");
            assert!(mesh == right, "{what}: a wrong mesh");
        }
        _ => drop(run.fails(3, &["t"])),
    }
}

#[test]
fn every_damaged_byte_is_found() {
    let (scratch, right) = small();
    for (name, verb) in
        [("t/manifest", "join t -o m.npy"), ("t/1.local", "join t -o m.npy"), ("t/1.points", "local t/1")]
    {
        let sound = std::fs::read(scratch.path(name)).expect("the file is there");
        let local = std::fs::read(scratch.path("t/1.local")).expect("the file is there");
        let verb = format!("tile {verb}");
        for at in 0..sound.len() {
            if name == "t/1.points" {
                let _ = std::fs::remove_file(scratch.path("t/1.local"));
            }
            let mut wrong = sound.clone();
            wrong[at] ^= 1 << (at % 8);
            scratch.write(name, &wrong);
            scratch.run(&verb).fails(3, &["t/"]);
        }
        for length in (0..sound.len()).step_by(7) {
            scratch.write(name, &sound[..length]);
            scratch.run(&verb).fails(3, &["t/"]);
        }
        scratch.write(name, [&sound[..], &[0]].concat());
        scratch.run(&verb).fails(3, &["t/"]);
        scratch.write(name, &sound);
        scratch.write("t/1.local", &local);
        try_damaged(&scratch, "tile join t -o m.npy", name, &right);
    }
    // No damaged file left anything behind.
    assert!(scratch.files().iter().all(|name| ["m.npy", "p.npy", "right.npy", "t"].contains(&name.as_str())));
    scratch.run("tile join t -o m.npy -q").ok();
}

#[test]
fn files_of_another_run_or_tile_are_refused() {
    let (scratch, _) = small();
    split_and_solve(&scratch, "p.npy", 9, "other");
    let copy = |from: &str, to: &str| std::fs::copy(scratch.path(from), scratch.path(to)).expect("a copy can be made");
    copy("other/0.local", "t/0.local");
    scratch.run("tile join t -o m.npy").fails(3, &["t/0.local", "belongs to run", "remove the file"]);
    scratch.run("tile local t/0").fails(3, &["t/0.local", "belongs to run"]);
    std::fs::remove_file(scratch.path("t/0.local")).expect("it is there");
    copy("other/0.points", "t/0.points");
    scratch.run("tile local t/0").fails(3, &["t/0.points", "belongs to run"]);
    copy("t/1.local", "t/0.local");
    scratch.run("tile join t -o m.npy").fails(3, &["t/0.local", "belongs to tile 1, not to tile 0"]);
    copy("t/1.points", "t/0.local");
    scratch.run("tile join t -o m.npy").fails(3, &["is not the triangulation of a tile"]);
    scratch.run("tile split p.npy --points 9 -o t").fails(3, &["tiles of another run", "another folder"]);
    scratch.run("tile local t/99").fails(3, &["no tile 99"]);
    scratch.run("tile local t").fails(2, &["names no tile", "tiles/0"]);
    scratch.run("tile local empty/0").fails(3, &["no manifest", "tile split"]);
    // The points are needed until the tile is triangulated.
    std::fs::remove_file(scratch.path("other/1.points")).expect("it is there");
    assert!(scratch.run("tile split p.npy --points 9 -o other").ok().stderr.contains("there already"));
    std::fs::remove_file(scratch.path("other/1.local")).expect("it is there");
    scratch.run("tile split p.npy --points 9 -o other").fails(3, &["1.points is missing"]);
}

/// A head whose check sums are right, but whose counts are not those of the file.
#[test]
fn a_file_that_promises_too_much_takes_no_memory() {
    let (scratch, _) = small();
    let mut bytes = std::fs::read(scratch.path("t/0.local")).expect("it is there");
    bytes[32..40].copy_from_slice(&(u64::MAX / 13).to_le_bytes());
    let check = crc(&bytes[..72]);
    bytes[72..76].copy_from_slice(&check.to_le_bytes());
    scratch.write("t/0.local", bytes);
    scratch.run("tile join t -o m.npy").fails(3, &["t/0.local", "damaged or cut off"]);
}

/// Files whose check sums were made to fit. Only an attacker makes such files, and nothing may panic over them.
#[test]
fn forged_files_never_panic() {
    let (scratch, _) = small();
    let mut random = SplitMix64::new(11);
    for (name, verb) in [
        ("t/manifest", "join t -o m.npy"),
        ("t/1.local", "join t -o m.npy"),
        ("t/1.points", "local t/1"),
        ("t/manifest", "local t/1"),
    ] {
        let sound = std::fs::read(scratch.path(name)).expect("the file is there");
        for _ in 0..150 {
            if verb == "local t/1" {
                let _ = std::fs::remove_file(scratch.path("t/1.local"));
            }
            let mut forged = sound.clone();
            // The five counts of the head, and all behind the head.
            let at = 32 + 4 * random.below((forged.len() as u64 - 32) / 4) as usize;
            let word = [0, 1, 5, u32::MAX, 1 << 31, 1 << 20][random.below(6) as usize];
            forged[at..at + 4].copy_from_slice(&u32::to_le_bytes(word));
            make_sums_fit(&mut forged, name.ends_with(".local"));
            scratch.write(name, &forged);
            let run = scratch.run(&format!("tile {verb}"));
            assert!(matches!(run.code, Some(0 | 3)), "{name}, {word:#x} at {at}: {run:?}");
        }
        scratch.write(name, &sound);
        let _ = std::fs::remove_file(scratch.path("t/1.local"));
        scratch.run("tile local t/1 -q").ok();
    }
}

/// Five duplicates in a set of one point.
#[test]
fn more_duplicates_than_points_are_refused() {
    let scratch = Scratch::new();
    scratch.write("p.npy", array(&[[3, 4]]));
    split_and_solve(&scratch, "p.npy", 10, "t");
    let mut forged = std::fs::read(scratch.path("t/0.local")).expect("it is there");
    let end = forged.len() - 4;
    forged.splice(end..end, [0; 5 * 8]);
    forged[64..72].copy_from_slice(&5u64.to_le_bytes());
    make_sums_fit(&mut forged, true);
    scratch.write("t/0.local", forged);
    scratch.run("tile join t -o m.npy").fails(3, &["contradict each other", "5 duplicates"]);
}

/// Puts the check sums of its content into a file. The file of a triangulation has one more at its end, that of its
/// final triangles.
fn make_sums_fit(bytes: &mut [u8], is_local: bool) {
    let mut end = bytes.len();
    if is_local {
        let finals = u64::from_le_bytes(bytes[32..40].try_into().expect("eight bytes"));
        let last = end - 4;
        end = last.saturating_sub(usize::try_from(finals).unwrap_or(0).saturating_mul(12)).max(76);
        let check = crc(&bytes[end..last]);
        bytes[last..].copy_from_slice(&check.to_le_bytes());
    }
    let check = crc(&bytes[76..end]);
    bytes[28..32].copy_from_slice(&check.to_le_bytes());
    let check = crc(&bytes[..72]);
    bytes[72..76].copy_from_slice(&check.to_le_bytes());
}

/// The check sum CRC-32 of ISO 3309, bit by bit.
fn crc(bytes: &[u8]) -> u32 {
    !bytes.iter().fold(u32::MAX, |sum, &byte| {
        (0..8).fold(sum ^ u32::from(byte), |sum, _| (sum >> 1) ^ (0xedb8_8320 & (sum & 1).wrapping_neg()))
    })
}

#[cfg(unix)]
#[test]
fn folders_without_rights_are_told() {
    use std::os::unix::fs::PermissionsExt;
    let (scratch, _) = small();
    scratch.write("file", "no folder");
    scratch.run("tile split p.npy --points 9 -o file").fails(3, &["file", "cannot be made"]);
    scratch.run("tile split p.npy --points 9 -o /proc/none").fails(3, &["/proc/none", "cannot be made"]);
    scratch.run("tile join t -o gone/m.npy").fails(3, &["gone/m.npy cannot be written"]);
    std::os::unix::fs::symlink("loop", scratch.path("loop")).expect("a link can be made");
    scratch.run("tile join loop -o m.npy").fails(3, &["loop/manifest", "cannot be read"]);
    // Root may write everywhere, so the test holds for other users alone.
    let folder = scratch.path("locked");
    std::fs::create_dir(&folder).expect("a folder can be made");
    std::fs::set_permissions(&folder, std::fs::Permissions::from_mode(0o555)).expect("the folder is ours");
    let run = scratch.run("tile split p.npy --points 9 -o locked");
    if run.code != Some(0) {
        run.fails(3, &["cannot be written"]);
        assert_eq!(tiles(&scratch, "locked"), 0);
    }
    std::fs::set_permissions(&folder, std::fs::Permissions::from_mode(0o755)).expect("the folder is ours");
}

#[cfg(unix)]
#[test]
fn an_input_that_changes_between_the_passes_is_found() {
    let scratch = Scratch::new();
    let gate = scratch.path("gate.csv");
    let made = std::process::Command::new("mkfifo").arg(&gate).status();
    assert!(made.expect("mkfifo is there").success());
    for second in ["0,0\n5,0\n0,6\n", "0,0\n5,0\n", "0,0\n5,0\n0,5\n1,1\n", "0,0\n5,0\n0,99\n", "0,0\n5,0\n0,0.5\n"] {
        scratch.write("p.csv", "0,0\n5,0\n0,5\n");
        let mut command = scratch.command(["tile", "split", "p.csv", "gate.csv", "--points", "2", "-o", "t"]);
        command.stdout(std::process::Stdio::piped()).stderr(std::process::Stdio::piped());
        let child = command.spawn().expect("the command starts");
        // The pipe opens when the first pass has read the points and comes to the pipe. The pass ends with the pipe.
        let mut pipe = std::fs::File::options().write(true).open(&gate).expect("the command reads");
        scratch.write("p.csv", second);
        pipe.write_all(b"1,0\n").expect("the command reads");
        drop(pipe);
        let run = crate::common::Run::of(child.wait_with_output().expect("it ends"));
        run.fails(3, &["incircle: p.csv has changed since it was first read", "split the inputs again"]);
        assert_eq!(scratch.files(), ["gate.csv", "p.csv"]);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told_in_a_sentence() {
    let (scratch, _) = small();
    for format in ["npy", "csv", "ele", "obj"] {
        scratch.run(&format!("tile join t -o /dev/full --format {format}")).fails(3, &["/dev/full", "No space left"]);
    }
    assert_eq!(scratch.files(), ["p.npy", "right.npy", "t"]);
    let left = std::fs::read_dir(scratch.path("t")).expect("it is there").filter_map(Result::ok);
    assert!(left.into_iter().all(|entry| !entry.file_name().to_string_lossy().starts_with('.')));
}
