//! Several back ends for one set.

use crate::common::Scratch;
use serde_json::Value;

#[test]
fn several_back_ends_share_a_set() {
    let scratch = Scratch::new();
    scratch.run("generate clusters -n 12000 -o p.csv").ok();
    scratch.run("triangulate p.csv -o right.ele").ok();
    let backends = "--backend clock?config=quad --backend cpu?threads=1 --backend model?capacity=500";
    let run = scratch.run(&format!("triangulate p.csv -o m.ele --json {backends}")).ok();
    assert_eq!(scratch.read("m.ele"), scratch.read("right.ele"));
    let report: Value = serde_json::from_str(&run.stdout).expect("the report is JSON");
    let shares = report["shares"].as_array().expect("a list");
    let sum = |key: &str| shares.iter().filter_map(|share| share[key].as_u64()).sum::<u64>();
    assert_eq!((shares.len(), sum("parts")), (3, report["parts"].as_u64().expect("a count")));
    assert_eq!(Some(sum("points")), report["distinct"].as_u64());
    let run = scratch.run(&format!("triangulate p.csv -o m.ele {backends}")).ok();
    assert!(run.stderr.contains("\nclock:quad: ") && run.stderr.contains("\ncpu: "), "{run:?}");
}

#[test]
fn a_back_end_that_is_not_there_is_left_out_and_named() {
    let scratch = Scratch::new();
    scratch.run("generate uniform -n 3000 -o p.csv").ok();
    scratch.run("triangulate p.csv -o right.ele").ok();
    let run = scratch.run("triangulate p.csv -o m.ele --backend serial:/dev/absent --backend cpu").ok();
    assert_eq!(scratch.read("m.ele"), scratch.read("right.ele"));
    assert!(run.stderr.contains("serial:/dev/absent: 0 parts, 0 points; left out: "), "{run:?}");
    let run = scratch.run("triangulate p.csv -o n.ele --backend serial:/dev/absent --backend pcie:/absent");
    run.fails(4, &["cannot be opened"]);
    assert_eq!(scratch.files(), ["m.ele", "p.csv", "right.ele"]);
}

#[test]
fn choices_for_one_of_several_are_refused() {
    let scratch = Scratch::new();
    scratch.run("generate uniform -n 30 -o p.csv").ok();
    for choice in ["--threads 1", "--config quad", "--trace t.vcd"] {
        let run = scratch.run(&format!("triangulate p.csv -o m.ele --backend cpu --backend clock {choice}"));
        run.fails(2, &["put the choices into the addresses"]);
    }
    for command in ["bench uniform -n 10", "info"] {
        let run = scratch.run(&format!("{command} --backend cpu --backend clock"));
        run.fails(2, &["2 back ends are given, but this command takes one"]);
    }
    scratch.write("wide.csv", "0,0\n70000,1\n3,70000\n");
    scratch.run("triangulate wide.csv -o m.ele --backend cpu --backend clock").fails(3, &["16 bits"]);
    let run = scratch.run("triangulate p.csv -o m.ele --backend cpu --backend clock --quantize fit --coord-bits 17");
    run.fails(7, &["16 bits", "17"]);
    assert_eq!(scratch.files(), ["p.csv", "wide.csv"]);
}
