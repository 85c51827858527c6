//! `incircle lloyd`: places on fine lattices, any threads, and refusals.

use serde_json::Value;

use crate::common::Scratch;

#[test]
fn two_points_end_in_the_middles_of_halves() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n1,0\n");
    let run = scratch.run("lloyd p.csv -o q.csv --until-still --clip 0,0,1,3 --json").ok();
    let report: Value = serde_json::from_str(&run.stdout).expect("a report");
    assert_eq!((report["end"].as_str(), report["moved"].as_u64()), (Some("still"), Some(0)));
    assert_eq!(scratch.read("q.csv"), "0.25,1.5\n0.75,1.5\n");
    // Steps of a tenth become finer by powers of two.
    scratch.write("t.csv", "-0.1,0.2\n0.1,0.2\n");
    scratch.run("lloyd t.csv -o q.csv --iterations 1 --clip=-0.1,0,0.1,0.4 --quiet").ok();
    assert_eq!(scratch.read("q.csv"), "-0.05,0.2\n0.05,0.2\n");
}

#[test]
fn threads_orders_and_formats_change_nothing() {
    let scratch = Scratch::new();
    scratch.run("generate uniform -n 9000 --bits 16 --seed 3 -o p.csv").ok();
    for (name, threads) in [("one", 1), ("three", 3)] {
        scratch.run(&format!("lloyd p.csv -o {name}.csv --iterations 3 --threads {threads} --quiet")).ok();
    }
    let one = scratch.read("one.csv");
    assert_eq!(one, scratch.read("three.csv"));
    let reversed: Vec<String> = scratch.read("p.csv").lines().rev().map(str::to_owned).collect();
    scratch.write("r.csv", reversed.join("\n"));
    scratch.run("lloyd r.csv -o r-out.csv --iterations 3 --quiet").ok();
    let back: Vec<String> = scratch.read("r-out.csv").lines().rev().map(str::to_owned).collect();
    assert_eq!(back, one.lines().collect::<Vec<_>>());
    assert_ne!(one, scratch.read("p.csv"));
    scratch.run("lloyd p.csv -o q.npy --iterations 1 --quantize fit --quiet").ok();
    assert_eq!(scratch.bytes("q.npy").len(), 128 + 9000 * 16);
}

#[test]
fn wrong_input_is_one_sentence_and_no_file() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n4,0\n4,4\n");
    scratch.write("line.csv", "0,0\n4,0\n");
    scratch.write("wide.csv", "0,0\n16777216,1\n3,9\n");
    scratch.write("tenths.csv", "0.1,1e300\n3,9\n");
    let files = scratch.files();
    for (arguments, code, parts) in [
        (
            "wide.csv --iterations 1 -o q.csv",
            3,
            &["wide.csv: ", "need 25 bits", "8 spare bits of 31: give --quantize fit"][..],
        ),
        ("wide.csv --iterations 1 -o q.csv --quantize fit --coord-bits 24", 3, &["give --coord-bits 23 or fewer"]),
        ("tenths.csv --iterations 1 -o q.csv", 3, &["lie on no lattice", "--quantize fit"]),
        ("line.csv --iterations 1 -o q.csv", 3, &["has no area: give --clip"]),
        ("p.csv --iterations 1 -o q.csv --clip 1,1,1,2", 3, &["the clip has no area"]),
        ("p.csv --iterations 1 -o q.txt", 2, &["the name tells no format of points"]),
    ] {
        scratch.run(&format!("lloyd {arguments}")).fails(code, parts);
        assert_eq!(scratch.files(), files, "{arguments}");
    }
    assert_eq!(scratch.run("lloyd p.csv -o q.csv").code, Some(2));
}
