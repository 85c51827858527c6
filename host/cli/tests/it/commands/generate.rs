//! Tests of `incircle generate`: the same points on every machine, in every format.

use crate::common::Scratch;
use incircle_testkit::{generate, Distribution};

#[test]
fn files_hold_exactly_the_points_of_the_library() {
    let scratch = Scratch::new();
    for &distribution in Distribution::all() {
        scratch.run(&format!("generate {distribution} -n 200 --bits 12 --seed 9 -o p.csv")).ok();
        let points = generate(distribution, 200, 12, 9).expect("the bits are possible");
        let expected: String = points.iter().map(|[x, y]| format!("{x},{y}\n")).collect();
        assert_eq!(scratch.read("p.csv"), expected, "{distribution}");
    }
}

#[test]
fn first_points_are_known() {
    let scratch = Scratch::new();
    let run = scratch.run("generate uniform -n 3 --bits 16 --seed 1234567 -o -").ok();
    // The top 16 bits of the published sequence of SplitMix64 for this seed.
    assert_eq!(run.stdout.lines().next(), Some("22942,11379"));
}

#[test]
fn every_set_is_triangulated_and_verified() {
    let scratch = Scratch::new();
    for &distribution in Distribution::all() {
        scratch.run(&format!("generate {distribution} -n 700 --bits 16 --seed 4 -o p.csv")).ok();
        scratch.run("triangulate p.csv -o m.ele").ok();
        scratch.run("verify p.csv m.ele").ok();
    }
}

#[test]
fn other_formats_hold_the_same_points() {
    let scratch = Scratch::new();
    let meshes = ["csv", "xyz", "node"].map(|format| {
        scratch.run(&format!("generate normal -n 100 --seed 2 -o p.{format}")).ok();
        scratch.run(&format!("triangulate p.{format} -o {format}.ele")).ok();
        scratch.read(&format!("{format}.ele"))
    });
    assert!(meshes.iter().all(|mesh| *mesh == meshes[0]));
}

#[test]
fn no_points_are_possible() {
    let scratch = Scratch::new();
    scratch.run("generate lattice -n 0 -o p.csv").ok();
    assert_eq!(scratch.read("p.csv"), "");
    for name in ["p.node", "p.npy"] {
        scratch.run(&format!("generate lattice -n 0 -o {name}")).ok();
        scratch.run(&format!("triangulate {name} -o m.ele")).ok();
    }
}

#[test]
fn more_points_than_an_order_may_have_are_refused() {
    let scratch = Scratch::new();
    for n in ["536870912", "4294967294"] {
        let command = format!("generate uniform -n {n} --order hilbert -o p.csv");
        scratch.run(&command).fails(2, &[n, "536870911"]);
    }
    assert!(scratch.files().is_empty());
}

#[cfg(target_os = "linux")]
#[test]
fn more_points_than_memory_end_with_seven() {
    let scratch = Scratch::new();
    let program = env!("CARGO_BIN_EXE_incircle");
    // These sets are shuffled, so all of their points are in memory.
    for distribution in ["lattice", "parabola", "spiral"] {
        // A quarter of a gigabyte of addresses, where four fifths of one are wanted.
        let line = format!("ulimit -v 262144 && '{program}' generate {distribution} -n 100000000 -o p.csv");
        let output = std::process::Command::new("sh").args(["-c", &line]).current_dir(scratch.path("")).output();
        crate::common::Run::of(output.expect("the shell starts")).fails(7, &["no memory for 100000000 points"]);
    }
    assert!(scratch.files().is_empty());
}

#[test]
fn orders_are_drawn_and_points_written_in_them() {
    let scratch = Scratch::new();
    scratch.run("generate lattice -n 64 --order hilbert -o order.svg").ok();
    let drawing = scratch.read("order.svg");
    assert!(drawing.starts_with("<svg ") && drawing.contains("64 points, lattice, in the order hilbert"), "{drawing}");
    scratch.run("generate lattice -n 64 -o order2.svg").fails(2, &["--order", ".csv"]);
    scratch.run("generate uniform -n 500 -o p.csv").ok();
    scratch.run("generate uniform -n 500 --order brio-hilbert -o q.csv").ok();
    let lines = |name: &str| {
        let mut lines: Vec<String> = scratch.read(name).lines().map(str::to_owned).collect();
        let in_file = lines.clone();
        lines.sort();
        (lines, in_file)
    };
    let ((sorted, plain), (sorted_too, ordered)) = (lines("p.csv"), lines("q.csv"));
    assert_eq!(sorted, sorted_too);
    assert_ne!(plain, ordered);
}

/// The refusal of another name lists the orders and says where the other ones are.
#[test]
fn orders_of_other_names_are_refused_with_the_names_that_there_are() {
    let scratch = Scratch::new();
    for name in ["zigzag", "briodc-linear", "brio-squarified-peano"] {
        for call in [format!("generate uniform -n 5 --order {name} -o p.csv"), format!("bench --order {name}")] {
            let run = scratch.run(&call);
            assert_eq!(run.code, Some(2), "{run:?}");
            for part in [name, "'brio-hilbert'", "'hilbert'", "'input'", "'random'", "incircle-research"] {
                assert!(run.stderr.contains(part), "no {part:?} in {run:?}");
            }
        }
    }
}
