//! Tests of `incircle generate --numbers`: the same points in every kind of numbers and every format.

use crate::common::Scratch;
use incircle_testkit::{generate, Distribution};
use npyz::{Deserialize, NpyFile};
use serde_json::{json, Value};

/// The values of `--numbers`, each with the kind of lattice that its points have in a text file.
const KINDS: [(&str, &str); 5] =
    [("whole", "whole"), ("signed", "whole"), ("decimal", "decimal"), ("double", "doubles"), ("f32", "binary")];

/// The lattice that `triangulate --json` reports for a file.
fn lattice_of(scratch: &Scratch, file: &str) -> Value {
    let run = scratch.run(&format!("triangulate {file} -o {file}.ele --json")).ok();
    let report: Value = serde_json::from_str(&run.stdout).expect("one object");
    report["lattice"].clone()
}

/// The numbers of a text, row by row.
fn numbers_of(text: &str) -> Vec<f64> {
    let number = |word: &str| word.parse().expect("a number");
    text.lines().flat_map(|row| row.split([',', ' ']).map(number)).collect()
}

/// The values of an array with n rows and two columns as doubles, and the name of their type.
fn doubles_of<T: Deserialize + Into<f64>>(scratch: &Scratch, file: &str, n: u64) -> (Vec<f64>, String) {
    let bytes = std::fs::read(scratch.path(file)).expect("the file is there");
    let array = NpyFile::new(&bytes[..]).expect("a header");
    assert_eq!(array.shape(), [n, 2]);
    let name = array.dtype().descr();
    let values: Vec<T> = array.into_vec().expect("the values are there");
    (values.into_iter().map(T::into).collect(), name)
}

#[test]
fn whole_numbers_are_the_default() {
    let scratch = Scratch::new();
    let points = generate(Distribution::Normal, 50, 9, 1).expect("the bits are possible");
    let rows = |row: &dyn Fn(usize, [u32; 2]) -> String| {
        points.iter().enumerate().map(|(id, &point)| row(id, point)).collect::<String>()
    };
    for (format, expected) in [
        ("csv", rows(&|_, [x, y]| format!("{x},{y}\n"))),
        ("xyz", rows(&|_, [x, y]| format!("{x} {y}\n"))),
        ("node", format!("50 2 0 0\n{}", rows(&|id, [x, y]| format!("{id} {x} {y}\n")))),
    ] {
        for options in ["", "--numbers whole"] {
            scratch.run(&format!("generate normal -n 50 --bits 9 {options} -o p.{format}")).ok();
            assert_eq!(scratch.read(&format!("p.{format}")), expected, "{format} {options}");
        }
    }
}

#[test]
fn every_kind_has_its_lattice() {
    let scratch = Scratch::new();
    for &distribution in Distribution::all() {
        for (kind, lattice) in KINDS {
            for format in ["csv", "xyz", "node"] {
                let file = format!("{kind}.{format}");
                scratch.run(&format!("generate {distribution} -n 300 --numbers {kind} -o {file}")).ok();
                let found = lattice_of(&scratch, &file);
                assert_eq!(found["kind"], lattice, "{distribution} {file}");
            }
        }
    }
}

#[test]
fn steps_are_those_of_the_grid() {
    let scratch = Scratch::new();
    // The corners of the lattice are those of the grid.
    let lattice = |options: &str| {
        scratch.run(&format!("generate lattice -n 25 {options} -o p.csv")).ok();
        lattice_of(&scratch, "p.csv")
    };
    let whole =
        |offset: i64| json!({ "kind": "whole", "scale": 1, "offset": [offset, offset], "bits": 9, "rounded": 0 });
    assert_eq!(lattice("--bits 9"), whole(0));
    assert_eq!(lattice("--bits 9 --numbers signed"), whole(-256));
    let low = -134.217728;
    let decimal = json!({ "kind": "decimal", "scale": 1e-6, "offset": [low, low], "bits": 28, "rounded": 0 });
    assert_eq!(lattice("--numbers decimal"), decimal);
    let binary = lattice("--numbers f32");
    assert_eq!((&binary["kind"], &binary["offset"]), (&json!("binary"), &json!([-1.0, -1.0])));
    // With few bits the numbers are also short decimals, and the command looks for decimals first.
    assert_eq!(lattice("--numbers f32 --bits 5")["kind"], "decimal");
}

#[test]
fn all_kinds_are_the_same_points() {
    let scratch = Scratch::new();
    let points = generate(Distribution::Clusters, 200, 24, 6).expect("the bits are possible");
    let decimal = |steps: i64| {
        let sign = if steps < 0 { "-" } else { "" };
        format!("{sign}{}.{:06}", steps.abs() / 1_000_000, steps.abs() % 1_000_000)
    };
    // The standard library writes all digits of a double.
    let binary = |steps: i64| format!("{:.23}", steps as f64 / f64::from(1 << 23));
    let texts: [(&str, &dyn Fn(i64) -> String); 3] =
        [("signed", &|steps| steps.to_string()), ("decimal", &decimal), ("f32", &binary)];
    for (kind, text_of) in texts {
        scratch.run(&format!("generate clusters -n 200 --bits 24 --seed 6 --numbers {kind} -o p.csv")).ok();
        let text = |value: u32| text_of(i64::from(value) - (1 << 23));
        let expected: String = points.iter().map(|&[x, y]| format!("{},{}\n", text(x), text(y))).collect();
        assert_eq!(scratch.read("p.csv"), expected, "{kind}");
    }
}

#[test]
fn one_seed_gives_the_same_bytes_in_every_order() {
    let scratch = Scratch::new();
    for (kind, _) in KINDS {
        for format in ["csv", "npy"] {
            let bytes = |options: &str| {
                scratch.run(&format!("generate uniform -n 99 --numbers {kind} {options} -o p.{format}")).ok();
                std::fs::read(scratch.path(&format!("p.{format}"))).expect("the file is there")
            };
            assert_eq!(bytes("--seed 8"), bytes("--seed 8"), "{kind}");
            assert_ne!(bytes("--seed 8"), bytes("--seed 9"), "{kind}");
        }
        let rows = |options: &str| {
            let run = scratch.run(&format!("generate uniform -n 99 --numbers {kind} {options} -o -")).ok();
            let mut rows: Vec<String> = run.stdout.lines().map(str::to_owned).collect();
            rows.sort();
            rows
        };
        assert_eq!(rows(""), rows("--order hilbert"), "{kind}");
    }
}

#[test]
fn doubles_are_known_and_take_all_their_bits() {
    let scratch = Scratch::new();
    let run = scratch.run("generate uniform -n 2000 --numbers double --seed 1234567 -o -").ok();
    assert_eq!(run.stdout.lines().next(), Some("-0.2998409163457431,-0.6527118062207219"));
    let numbers = numbers_of(&run.stdout);
    assert!(numbers.iter().all(|number| (-1.0..=1.0).contains(number)));
    // The last bit of a mantissa is 0 or 1 with equal chance.
    let odd = numbers.iter().filter(|number| number.to_bits() % 2 == 1).count();
    assert!((1800..2200).contains(&odd), "{odd}");
}

/// The rounded columns and rows of doubles cross in rectangles, and the corners of a rectangle are on one circle. So
/// the tie rule decides every cell, and all kinds have the same mesh.
#[test]
fn lattices_keep_their_ties() {
    let scratch = Scratch::new();
    let meshes = KINDS.map(|(kind, _)| {
        scratch.run(&format!("generate lattice -n 400 --numbers {kind} -o p.csv")).ok();
        scratch.run("triangulate p.csv -o m.ele").ok();
        scratch.run("verify p.csv m.ele").ok();
        scratch.read("m.ele")
    });
    assert_eq!(meshes[0].lines().next(), Some("722 3 0"));
    for (mesh, (kind, _)) in meshes.iter().zip(KINDS) {
        assert_eq!(*mesh, meshes[0], "{kind}");
    }
}

#[test]
fn arrays_hold_the_numbers_of_the_text() {
    let scratch = Scratch::new();
    let array = |kind: &str| {
        scratch.run(&format!("generate kuzmin -n 300 --numbers {kind} -o p.csv")).ok();
        scratch.run(&format!("generate kuzmin -n 300 --numbers {kind} -o p.npy")).ok();
        match kind {
            "whole" => doubles_of::<u32>(&scratch, "p.npy", 300),
            "signed" => doubles_of::<i32>(&scratch, "p.npy", 300),
            "f32" => doubles_of::<f32>(&scratch, "p.npy", 300),
            _ => doubles_of::<f64>(&scratch, "p.npy", 300),
        }
    };
    for (kind, name) in
        [("whole", "'<u4'"), ("signed", "'<i4'"), ("decimal", "'<f8'"), ("double", "'<f8'"), ("f32", "'<f4'")]
    {
        assert_eq!(array(kind), (numbers_of(&scratch.read("p.csv")), name.to_owned()), "{kind}");
    }
}

#[test]
fn the_format_is_chosen_by_name_or_extension() {
    let scratch = Scratch::new();
    for format in ["csv", "xyz", "node", "npy"] {
        scratch.run(&format!("generate box -n 40 -o by.{format}")).ok();
        scratch.run(&format!("generate box -n 40 --format {format} -o by-name")).ok();
        let bytes = |name: &str| std::fs::read(scratch.path(name)).expect("the file is there");
        assert_eq!(bytes(&format!("by.{format}")), bytes("by-name"), "{format}");
    }
    scratch.run("generate uniform -n 0 --numbers double -o p.npy").ok();
    assert!(doubles_of::<f64>(&scratch, "p.npy", 0).0.is_empty());
    assert_eq!(scratch.run("generate uniform -n 3 --format svg -o p").code, Some(2));
}

#[test]
fn combinations_without_meaning_are_refused() {
    let scratch = Scratch::new();
    for (call, parts) in [
        ("--numbers double --bits 16 -o p.csv", ["--bits 16", "no steps"]),
        ("--numbers f32 --bits 25 -o p.npy", ["--bits 25", "24 bits of an f32"]),
        ("--numbers decimal --order hilbert -o p.svg", ["--numbers", ".npy"]),
        ("--numbers double -o p.obj", ["p.obj", ".npy"]),
    ] {
        scratch.run(&format!("generate uniform -n 5 {call}")).fails(2, &parts);
    }
    assert_eq!(scratch.run("generate uniform -n 5 --numbers complex -o p.csv").code, Some(2));
    assert!(scratch.files().is_empty());
}
