//! Texts and files of laser scanners that are read piece by piece: the mesh of the run in memory, byte for byte, or its
//! sentence.

use super::same_mesh;
use crate::common::lidar::{word, write};
use crate::common::Scratch;
use crate::formats::lidar::{points, AXES};
use incircle_testkit::SplitMix64;

/// Points of each set: more than one piece of each format has.
const POINTS: u64 = 70_000;

/// Rows of random numbers of few digits behind the point, some of them at one place.
fn rows(seed: u64, row: impl Fn(usize, [String; 2]) -> String) -> String {
    let mut random = SplitMix64::new(seed);
    let mut number = || format!("{}.{:02}", random.below(3000) as i64 - 1500, random.below(100));
    (0..POINTS as usize).map(|index| row(index, [number(), number()])).collect()
}

/// Compares the mesh of tiles of several sizes with that of the run in memory.
fn compare(scratch: &Scratch, name: &str) {
    scratch.run(&format!("triangulate {name} -o right.npy -q")).ok();
    for most in [9_000, 80_000] {
        let count = same_mesh(scratch, name, most, "right.npy");
        assert!(count > 7 || most > 9_000, "{name}: {count}");
    }
}

#[test]
fn texts_in_pieces_have_the_mesh_of_the_run_in_memory() {
    let scratch = Scratch::new();
    let plain = rows(1, |_, [x, y]| format!("{x},{y}\n"));
    let texts = [
        ("plain.csv", plain.clone()),
        ("feeds.csv", format!("\u{feff}x;y;note\r\n{}", rows(2, |_, [x, y]| format!("{x};{y};\"a\"\r\n")))),
        ("returns.csv", rows(3, |_, [x, y]| format!("{x},{y}\r"))),
        ("named.csv", format!("# a\nid,lat,lon\n{}", rows(4, |index, [x, y]| format!("{index},{y},{x}\n\n")))),
        ("late.csv", "# nothing yet\n".repeat(40_000) + &rows(5, |_, [x, y]| format!("{x}\t{y}\n"))),
        ("plain.xyz", rows(6, |index, [x, y]| format!(" {x}\t{y} {index} 255 # b\r\n"))),
        ("head.xyz", format!("x y\n{}", rows(7, |_, [x, y]| format!("{x} {y}\n")))),
    ];
    for (name, text) in texts {
        scratch.write(name, text);
        compare(&scratch, name);
    }
    scratch.write("packed.csv.zst", zstd::encode_all(plain.as_bytes(), 0).expect("memory takes all bytes"));
    compare(&scratch, "packed.csv.zst");
    scratch.run("triangulate plain.csv -o plain.npy -q").ok();
    assert!(scratch.bytes("plain.npy") == scratch.bytes("right.npy"));
}

#[test]
fn scans_in_pieces_have_the_mesh_of_the_run_in_memory() {
    let scratch = Scratch::new();
    for (minor, format, is_packed) in [(2, 0, false), (2, 1, true), (4, 6, false), (4, 6, true)] {
        scratch.write("p.las", write(minor, format, is_packed, AXES, &points(POINTS, 8)));
        compare(&scratch, "p.las");
    }
    scratch.run("triangulate p.las -o right.npy -q --class 2,9").ok();
    scratch.run("triangulate p.las -o m.npy -q --class 2,9 --memory 32M").ok();
    assert!(scratch.bytes("m.npy") == scratch.bytes("right.npy"));
}

/// The last rows have more digits than all before them. Numbers with very many digits are doubles in their piece, and
/// decimals stand in all others.
#[test]
fn a_lattice_that_shows_late_is_that_of_all_points() {
    let scratch = Scratch::new();
    let mut random = SplitMix64::new(9);
    let mut number = || random.below(192) as f64 / 64.0;
    let coarse: String = (0..POINTS).map(|_| format!("{},{}\n", number(), number())).collect();
    let finest = "0.000000000931322574615478515625";
    for last in ["0.0001,1.0003\n".to_owned(), format!("{finest},1\n2,{finest}\n"), format!("{finest},1e0\n")] {
        scratch.write("p.csv", coarse.clone() + &last);
        compare(&scratch, "p.csv");
        scratch.write("p.csv", last + &coarse);
        compare(&scratch, "p.csv");
    }
    scratch.write("p.csv", format!("{coarse}0.1,1\n{finest},1\n"));
    scratch.run("triangulate p.csv -o m.npy --memory 32M").fails(3, &["p.csv", "lattice"]);
}

/// Asserts that a file is refused with one sentence, which is the same in memory and in pieces.
fn refused(scratch: &Scratch, name: &str, content: impl AsRef<[u8]>, parts: &[&str]) {
    scratch.write(name, content);
    let whole = scratch.run(&format!("triangulate {name} -o m.npy")).fails(3, parts);
    let pieces = scratch.run(&format!("triangulate {name} -o m.npy --memory 32M")).fails(3, parts);
    assert_eq!(pieces.stderr, whole.stderr, "{name}");
    assert_eq!(scratch.files(), [name]);
    std::fs::remove_file(scratch.path(name)).expect("the file is there");
}

#[test]
fn a_wrong_row_in_the_middle_is_named() {
    let scratch = Scratch::new();
    let with = |row: &str, separator: &str| {
        rows(10, |index, [x, y]| if index == 40_000 { row.to_owned() } else { format!("{x}{separator}{y}\n") })
    };
    for (row, why) in [
        ("1,b\n", "column 2: 'b' is not a number"),
        ("1\n", "has 1 column, the first row has 2"),
        ("1,2,3\n", "has 3 columns, the first row has 2"),
        ("nan,2\n", "is not a finite number"),
        ("1,\"2\n", "a quoted value runs over the end of its row"),
        ("1,1e400\n", "is not a finite number"),
    ] {
        refused(&scratch, "p.csv", with(row, ","), &["p.csv: row 40001", why]);
    }
    for (row, why) in [("1 b\n", "'b' is not a number"), ("1 # 2\n", "has 1 value"), ("1 2 3\n", "has 3 values")] {
        refused(&scratch, "p.xyz", with(row, " "), &["p.xyz: row 40001", why]);
    }
    let whole =
        rows(11, |_, [x, y]| [x, y].map(|text| text.split('.').next().unwrap_or_default().to_owned()).join(",") + "\n");
    refused(&scratch, "p.csv", whole.clone() + "9223372036854775808,1\n", &["row 70001", "beyond 64 bits"]);
    refused(&scratch, "p.csv", whole + "12", &["row 70001", "has 1 column"]);
    refused(&scratch, "p.csv", "", &["the file is empty"]);
    refused(&scratch, "p.csv", b"\xff\xfe1\x00", &["UTF-16"]);
    refused(&scratch, "p.xyz", "", &["the file is empty"]);
}

#[test]
fn damaged_scans_are_refused_as_in_memory() {
    let scratch = Scratch::new();
    let points = points(POINTS, 12);
    let plain = write(2, 0, false, AXES, &points);
    refused(&scratch, "p.las", &plain[..plain.len() - 7], &["p.las", "has room for 69999"]);
    let mut many = plain;
    many[107..111].copy_from_slice(&u32::MAX.to_le_bytes());
    refused(&scratch, "p.las", &many, &["4294967295 points"]);
    for (minor, format) in [(2, 1), (4, 6)] {
        let packed = write(minor, format, true, AXES, &points);
        refused(&scratch, "p.laz", &packed[..packed.len() / 2], &["p.laz", "cut off"]);
        if format == 6 {
            // The second chunk begins beyond the middle of the file, so a piece is taken before the damage is found.
            let (mut other, middle) = (packed.clone(), packed.len() * 3 / 4);
            other[middle..middle + 4000].fill(0xff);
            refused(&scratch, "p.laz", &other, &["p.laz: chunk 2 of 2"]);
        }
        let mut less = packed;
        let place = if minor == 4 { 247 } else { 107 };
        assert_eq!(word(&less, place) as u64, POINTS);
        less[place] -= 1;
        refused(&scratch, "p.laz", &less, &["p.laz: ", "9999 points"]);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_text_and_a_scan_take_the_memory_that_they_are_given() {
    let scratch = Scratch::new();
    scratch.run("generate uniform -n 600000 --bits 31 -o p.csv").ok();
    scratch.write("p.laz", write(4, 6, true, AXES, &points(600_000, 13)));
    for name in ["p.csv", "p.laz"] {
        scratch.run(&format!("triangulate {name} -o right.npy -q")).ok();
        let run = scratch.run(&format!("triangulate {name} -o m.npy --memory 32M --threads 2 --json")).ok();
        assert!(scratch.bytes("m.npy") == scratch.bytes("right.npy"), "{name}");
        let report: serde_json::Value = serde_json::from_str(&run.stdout).expect("an object");
        println!("{name}: {report}");
        assert!(report["tiles"].as_u64() > Some(2), "{report}");
        assert!(report["peak_memory"].as_u64() < Some((32 << 20) * 105 / 100), "{report}");
    }
}

/// The limit of addresses is what is free, whatever the machine has.
#[cfg(target_os = "linux")]
#[test]
fn a_text_or_a_scan_that_does_not_fit_is_done_in_tiles() {
    let scratch = Scratch::new();
    scratch.run("generate uniform -n 1200000 --bits 31 -o p.csv").ok();
    scratch.write("p.las", write(2, 0, false, AXES, &points(1_200_000, 14)));
    for name in ["p.csv", "p.las"] {
        scratch.run(&format!("triangulate {name} -o right.npy -q --threads 1")).ok();
        let program = env!("CARGO_BIN_EXE_incircle");
        let line = format!("ulimit -v 350000 && exec '{program}' triangulate {name} -o m.npy --threads 1");
        let mut command = std::process::Command::new("sh");
        command.args(["-c", &line]).current_dir(scratch.path(""));
        let run = crate::common::Run::of(command.output().expect("the shell starts")).ok();
        assert!(run.stderr.contains("points do not fit") && run.stderr.contains("in tiles"), "{run:?}");
        assert!(scratch.bytes("m.npy") == scratch.bytes("right.npy"), "{name}");
    }
}
