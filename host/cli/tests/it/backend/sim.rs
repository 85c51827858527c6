//! Tests that the back end `sim` gives the files of the back end `model`, byte for byte, and the cycles of the back end
//! `clock`. The sequence of a core's records depends on its contexts, but the files do not.

use crate::common::Scratch;
use serde_json::Value;

/// Triangulates `p.csv` with both back ends, the core with these options, and returns the report of the simulation.
#[track_caller]
fn compare(scratch: &Scratch, grid: &str, core: &str) -> Value {
    scratch.run(&format!("triangulate p.csv -o model.ele {grid}")).ok();
    let run = scratch.run(&format!("triangulate p.csv -o sim.ele --backend sim --json {grid} {core}")).ok();
    assert_eq!(scratch.read("model.ele"), scratch.read("sim.ele"), "{core}");
    scratch.run(&format!("verify p.csv sim.ele {grid}")).ok();
    serde_json::from_str(&run.stdout).expect("the report is JSON")
}

#[test]
fn named_sets_of_a_thousand_points() {
    let scratch = Scratch::new();
    for distribution in incircle_testkit::Distribution::all() {
        scratch.run(&format!("generate {distribution} -n 1000 --bits 16 --seed 1 -o p.csv")).ok();
        let report = compare(&scratch, "", "");
        assert_eq!(report["backend"], "sim");
        assert_eq!(report["config"], "small", "{distribution}");
        let cycles = report["cycles"].as_f64().expect("cycles are counted");
        let distinct = report["distinct"].as_f64().expect("a count");
        assert_eq!(report["cycles_per_insertion"], cycles / distinct);
        // The wait cycles are part of the insertion cycles and are counted once more by themselves. The read-out is no
        // part of the insertion cycles.
        let wait = report["wait_cycles"].as_f64().expect("cycles are counted");
        assert!(wait < cycles, "{report}");
        assert!(report["read_cycles"].as_u64() > Some(0), "{report}");
    }
}

#[test]
fn any_number_of_contexts() {
    let scratch = Scratch::new();
    for distribution in incircle_testkit::Distribution::all() {
        scratch.run(&format!("generate {distribution} -n 1000 --bits 16 --seed 2 -o p.csv")).ok();
        for (config, has) in [("small", 16), ("full", 16), ("large", 24)] {
            for contexts in [1, 2, 4, 8, 16, 24].into_iter().filter(|&contexts| contexts <= has) {
                let report = compare(&scratch, "", &format!("--config {config} --contexts {contexts}"));
                assert_eq!(report["contexts"], contexts, "{distribution}, {config}");
            }
        }
    }
    scratch.run("triangulate p.csv -o m.ele --backend sim --contexts 17").fails(2, &["the 16 of the core small"]);
}

#[test]
fn any_order_with_all_contexts() {
    let scratch = Scratch::new();
    for distribution in incircle_testkit::Distribution::all() {
        scratch.run(&format!("generate {distribution} -n 1000 --bits 16 --seed 3 -o p.csv")).ok();
        for order in ["brio-hilbert", "hilbert", "input"] {
            compare(&scratch, "", &format!("--config full --order {order}"));
        }
    }
}

#[test]
fn the_clock_model_counts_what_the_core_counts() {
    let scratch = Scratch::new();
    scratch.run("generate kuzmin -n 1000 -o p.csv").ok();
    for contexts in [1, 7, 16] {
        let [sim, clock] = ["sim", "clock"].map(|backend| {
            let options = format!("--backend {backend} --config full --contexts {contexts} --json");
            let run = scratch.run(&format!("triangulate p.csv -o m.ele {options}")).ok();
            serde_json::from_str::<Value>(&run.stdout).expect("the report is JSON")
        });
        for key in ["counters", "latency", "cycles", "wait_cycles", "read_cycles"] {
            assert_eq!(sim[key], clock[key], "{contexts} contexts");
        }
    }
}

/// The time of the longest job is measured from the last word of the previous mesh to the last word of its own. There
/// is none if the batch has a group.
#[test]
fn a_batch_and_its_longest_job_take_the_same_clocks() {
    let scratch = Scratch::new();
    for (config, n, jobs, has_group) in [("small", 900, 3, false), ("full", 5000, 2, false), ("full", 1000, 9, true)] {
        let [sim, clock] = ["sim", "clock"].map(|backend| {
            let options = format!("--backend {backend} --config {config} --seed 4 --json");
            let run = scratch.run(&format!("bench uniform kuzmin --batch {jobs} -n {n} {options}")).ok();
            serde_json::from_str::<Value>(&run.stdout).expect("an object")
        });
        for set in 0..2 {
            let longest = sim["sets"][set]["longest_job_cycles"].as_u64();
            assert_eq!(longest.is_none(), has_group, "{sim}");
            assert!(longest.is_none_or(|cycles| cycles > 14 * n), "{sim}");
            assert!(sim["sets"][set]["cycles"].as_u64() > Some(14 * n * jobs), "{sim}");
            for key in ["longest_job_cycles", "cycles", "engine_cycles_per_point"] {
                assert_eq!(sim["sets"][set][key], clock["sets"][set][key], "{config}, {key}");
            }
        }
    }
}

#[test]
fn chips_of_several_engines_take_the_clocks_of_their_model() {
    let scratch = Scratch::new();
    scratch.run("generate kuzmin -n 900 -o p.csv").ok();
    for (config, engines) in [("dual", 2), ("quad", 4)] {
        let report = compare(&scratch, "", &format!("--config {config}"));
        assert_eq!(report["engines"], engines, "{config}");
        let [sim, clock] = ["sim", "clock"].map(|backend| {
            let options = format!("--backend {backend} --config {config} --seed 4 --json");
            let run = scratch.run(&format!("bench uniform clusters --batch 60 -n 120 {options}")).ok();
            serde_json::from_str::<Value>(&run.stdout).expect("an object")
        });
        assert_eq!((&sim["engines"], &clock["engines"]), (&engines.into(), &engines.into()));
        for set in 0..2 {
            assert!(sim["sets"][set]["cycles"].as_u64() > Some(1000), "{sim}");
            for key in ["cycles", "engine_cycles_per_point", "stuck_engines"] {
                assert_eq!(sim["sets"][set][key], clock["sets"][set][key], "{config}, {key}");
            }
        }
    }
}

#[test]
fn the_report_says_the_bits_of_the_grid() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n255,0\n0,255\n");
    let report = compare(&scratch, "--quantize fit --coord-bits 8", "");
    assert_eq!(report["quantisation"]["coord_bits"], 8);
    assert_eq!(report["coord_bits"], 16, "the bits of the core");
}

#[test]
fn sets_without_triangles() {
    let scratch = Scratch::new();
    for points in ["x,y\n", "3,4\n", "3,4\n5,6\n", "3,4\n3,4\n", "0,0\n2,2\n1,1\n7,7\n"] {
        scratch.write("p.csv", points);
        let report = compare(&scratch, "", "");
        assert_eq!(report["cycles"], 0);
        assert_eq!(report["cycles_per_insertion"], Value::Null);
    }
}

#[test]
fn the_smallest_core_that_holds_the_points_is_taken() {
    let scratch = Scratch::new();
    for (n, config) in [(3, "tiny"), (8, "tiny"), (9, "small"), (1024, "small")] {
        // All points are distinct, because they are evenly spaced on a parabola.
        scratch.run(&format!("generate parabola -n {n} -o p.csv")).ok();
        assert_eq!(compare(&scratch, "", "")["config"], config, "{n}");
    }
    // Duplicates take no room in the core.
    scratch.write("p.csv", "0,0\n9,0\n0,9\n".repeat(100));
    assert_eq!(compare(&scratch, "", "")["config"], "tiny");
}

#[test]
fn what_no_core_holds_is_done_in_parts() {
    let scratch = Scratch::new();
    scratch.run("generate uniform -n 200 -o p.csv").ok();
    let report = compare(&scratch, "", "--config tiny");
    assert_eq!(report["config"], "tiny");
    assert!(report["parts"].as_u64() > Some(20), "{report}");
    let before = scratch.files();
    scratch.run("triangulate p.csv -o m.ele --backend sim --quantize fit --coord-bits 17").fails(7, &["16 bits", "17"]);
    assert_eq!(scratch.files(), before);
}

#[test]
fn a_core_says_what_it_is() {
    let scratch = Scratch::new();
    let run = scratch.run("info --backend sim --config full").ok();
    assert!(run.stdout.contains("coordinates of 16 bits\n8192 points\n"), "{run:?}");
}

#[test]
fn a_job_out_of_time_ends_with_six() {
    let scratch = Scratch::new();
    scratch.run("generate uniform -n 1000 -o p.csv").ok();
    scratch.run("triangulate p.csv -o m.ele --backend sim --timeout 0.001").fails(6, &["sim:small", "0.001 s"]);
    assert_eq!(scratch.files(), ["p.csv"]);
}

#[test]
fn a_trace_is_a_waveform_of_the_whole_job() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n9,0\n0,9\n4,3\n");
    let run = scratch.run("triangulate p.csv -o m.ele --backend sim --trace t.vcd --json").ok();
    let report: Value = serde_json::from_str(&run.stdout).expect("the report is JSON");
    assert_eq!(scratch.files(), ["m.ele", "p.csv", "t.vcd"]);
    let trace = scratch.read("t.vcd");
    for part in ["$timescale", "$enddefinitions", "command_valid", "response_data"] {
        assert!(trace.contains(part), "{part}");
    }
    // The waveform covers insertion and read-out, clock by clock.
    let clocks = trace.lines().filter(|line| line.starts_with('#')).count() as u64;
    let job = report["cycles"].as_u64().zip(report["read_cycles"].as_u64());
    let (insert, read) = job.expect("cycles are counted");
    assert!(clocks > insert + read, "{clocks} {report}");
}

#[test]
fn a_trace_of_one_job_has_no_other_jobs() {
    let scratch = Scratch::new();
    scratch.run("generate uniform -n 20 --bits 16 -o p.csv").ok();
    let run = "triangulate p.csv -o m.ele --backend sim --config tiny --trace t.vcd";
    let clocks = |options: &str| {
        scratch.run(&format!("{run} {options}")).ok();
        scratch.read("t.vcd").lines().filter(|line| line.starts_with('#')).count()
    };
    let [all, first, second] = ["", "--trace-job 1", "--trace-job 2"].map(clocks);
    assert!(first > 300 && second > 300 && first + second < all, "{all} {first} {second}");
    scratch.run(&format!("{run} --trace-job 1000")).fails(2, &["fewer jobs"]);
    for options in ["--trace t.vcd --trace-job 0", "--trace-job 1"] {
        let refused = scratch.run(&format!("triangulate p.csv -o m.ele --backend sim {options}"));
        assert_eq!(refused.code, Some(2), "{refused:?}");
        assert!(refused.stderr.contains("--trace"), "{refused:?}");
    }
}

#[test]
fn a_run_that_fails_leaves_no_trace() {
    let scratch = Scratch::new();
    scratch.run("generate uniform -n 1000 -o p.csv").ok();
    scratch.run("triangulate p.csv -o m.ele --backend sim --trace t.vcd --timeout 0.001").fails(6, &["sim:small"]);
    scratch
        .run("triangulate p.csv -o m.ele --backend sim --trace ./m.ele")
        .fails(2, &["both the mesh and the waveform"]);
    scratch.run("triangulate p.csv -o m.ele --backend sim --trace p.csv").fails(2, &["both the input"]);
    scratch.run("triangulate p.csv -o m.ele --backend sim --trace -").fails(2, &["ordinary file"]);
    assert_eq!(scratch.files(), ["p.csv"]);
}
