//! Tests that the back end `clock` gives the meshes of the back end `model`, for any set, order and number of contexts.

use crate::common::Scratch;
use incircle::{Device, Options, Order, Point, Session, Solution};
use incircle_protocol::{Config, LARGE};
use incircle_testkit::{generate, Distribution};
use serde_json::Value;

/// The numbers of contexts that are tested.
const CONTEXTS: [u32; 6] = [1, 2, 4, 8, 16, 24];

fn triangulate(session: &mut Session<'_>, points: &[Point], order: Order, contexts: Option<u32>) -> Solution {
    let options = Options::default().order(order).contexts(contexts);
    session.triangulate_with(points, &options).expect("a mesh")
}

/// Triangulates every set in every order with every number of contexts on this core. The sequence of the records
/// depends on all three, but the mesh does not.
fn compare(config: Config, count: usize) {
    let mut clock = Device::clock_model(config).expect("the clock model");
    let mut clock = clock.session().expect("a session");
    let mut model = Device::open("model").expect("the model");
    let mut model = model.session().expect("a session");
    for &set in Distribution::all() {
        let points = generate(set, count, 16, 2).expect("the bits are possible");
        let points: Vec<Point> = points.into_iter().map(Point::from).collect();
        let expected = triangulate(&mut model, &points, Order::default(), None);
        expected.mesh.verify().unwrap_or_else(|error| panic!("{set}: {error}"));
        for order in Order::BASIC {
            for contexts in CONTEXTS {
                let solution = triangulate(&mut clock, &points, order, Some(contexts));
                let what = format!("{set}, {order:?}, {contexts} contexts");
                assert!(solution.mesh.triangles == expected.mesh.triangles, "{what}");
                assert_eq!(solution.mesh.hull, expected.mesh.hull, "{what}");
                assert_eq!(solution.mesh.duplicates, expected.mesh.duplicates, "{what}");
                let counters = solution.report.counters.expect("the device was asked");
                assert_eq!(counters.insertions as usize, solution.report.distinct, "{what}");
                assert!(counters.insert_cycles > 0, "{what}");
            }
        }
    }
}

#[test]
fn all_sets_in_all_orders_with_all_contexts() {
    // The set has thirty points for every context of the largest core.
    compare(LARGE, 800);
}

#[test]
fn short_boundary_lists_change_nothing() {
    compare(Config { ring: 7, ..LARGE }, 400);
}

/// Triangulates `p.csv` with both back ends and returns the report of the back end `clock`.
#[track_caller]
fn files(scratch: &Scratch, options: &str) -> Value {
    scratch.run("triangulate p.csv -o model.ele").ok();
    let run = scratch.run(&format!("triangulate p.csv -o clock.ele --backend clock --json {options}")).ok();
    assert_eq!(scratch.read("model.ele"), scratch.read("clock.ele"));
    serde_json::from_str(&run.stdout).expect("the report is JSON")
}

#[test]
fn files_are_equal_and_the_report_says_cycles() {
    let scratch = Scratch::new();
    for set in ["kuzmin", "lattice", "box"] {
        scratch.run(&format!("generate {set} -n 1000 -o p.csv")).ok();
        for (options, config, contexts) in
            [("", "small", 16), ("--contexts 3", "small", 3), ("--config large --contexts 17", "large", 17)]
        {
            let report = files(&scratch, options);
            assert_eq!((&report["backend"], &report["config"]), (&"clock".into(), &config.into()));
            assert_eq!(report["contexts"], contexts);
            let cycles = report["cycles"].as_f64().expect("cycles are counted");
            let distinct = report["distinct"].as_f64().expect("a count");
            assert_eq!(report["cycles_per_insertion"], cycles / distinct);
            let counters = report["counters"].as_object().expect("an object");
            assert_eq!(counters.len(), 22);
            assert_eq!(report["latency"]["max"], counters["latency_max"]);
            let histogram = report["latency"]["histogram"].as_array().expect("a list");
            let timed: u64 = histogram.iter().filter_map(|bucket| bucket[1].as_u64()).sum();
            assert_eq!(report["latency"]["insertions"], timed);
        }
    }
}

#[test]
fn sets_without_triangles_take_no_cycles() {
    let scratch = Scratch::new();
    for points in ["x,y\n", "3,4\n", "3,4\n5,6\n", "0,0\n2,2\n1,1\n7,7\n"] {
        scratch.write("p.csv", points);
        let report = files(&scratch, "");
        assert_eq!((&report["cycles"], &report["cycles_per_insertion"]), (&0.into(), &Value::Null));
        assert_eq!(report["latency"], Value::Null);
    }
}

#[test]
fn the_smallest_core_that_holds_the_points_is_taken() {
    let scratch = Scratch::new();
    for (n, config) in [(3, "tiny"), (8, "tiny"), (9, "small"), (1024, "small"), (1025, "full")] {
        // All points are distinct, because they are evenly spaced on a parabola.
        scratch.run(&format!("generate parabola -n {n} -o p.csv")).ok();
        assert_eq!(files(&scratch, "")["config"], config, "{n}");
    }
    // Duplicates take no room in the core.
    scratch.write("p.csv", "0,0\n9,0\n0,9\n".repeat(100));
    assert_eq!(files(&scratch, "")["config"], "tiny");
}

#[test]
fn what_no_core_holds_is_done_in_parts() {
    let scratch = Scratch::new();
    for (n, choice, config) in [(17_000, "", "large"), (300, "--config tiny", "tiny"), (9_000, "--config quad", "quad")]
    {
        scratch.run(&format!("generate uniform -n {n} -o p.csv")).ok();
        let report = files(&scratch, choice);
        assert_eq!(report["config"], config);
        assert!(report["parts"].as_u64() > Some(1) && report["clocks_per_point"].as_f64() > Some(2.0), "{report}");
        let run = scratch.run(&format!("triangulate p.csv -o m.ele --backend clock {choice}")).ok();
        assert!(run.stderr.contains(" parts, on a device of ") && run.stderr.contains("clocks a point"), "{run:?}");
    }
    let run = scratch.run("bench uniform -n 9000 --backend clock --config quad").ok();
    assert!(run.stdout.contains(" parts, on a device of 2048 points, "), "{run:?}");
}

#[test]
fn bits_that_no_core_has_end_with_seven_and_contexts_it_lacks_with_two() {
    let scratch = Scratch::new();
    scratch.run("generate parabola -n 9 -o p.csv").ok();
    scratch
        .run("triangulate p.csv -o m.ele --backend clock --quantize fit --coord-bits 17")
        .fails(7, &["16 bits", "17"]);
    let all = "tiny 2, small 16, full 16, large 24";
    let run = scratch.run("triangulate p.csv -o m.ele --backend clock --contexts 17");
    run.fails(2, &["17 contexts", "the 16 of the core small", all, "choose fewer or --config large"]);
    let run = scratch.run("triangulate p.csv -o m.ele --backend clock --contexts 25");
    run.fails(2, &["25 contexts", all, "choose fewer\n"]);
    assert_eq!(scratch.files(), ["p.csv"]);
}

#[test]
fn a_job_out_of_time_ends_with_six() {
    let scratch = Scratch::new();
    scratch.run("generate uniform -n 8000 -o p.csv").ok();
    let run = scratch.run("triangulate p.csv -o m.ele --backend clock --contexts 1 --timeout 0.01");
    run.fails(6, &["clock:full", "0.01 s"]);
    scratch.run("bench uniform -n 8000 --backend clock --timeout 0.01").fails(6, &["clock:full", "0.01 s"]);
    // The time of a job of a batch is the one that the user chose, whatever is sent ahead.
    let run = scratch.run("bench uniform -n 2000 --batch 100 --backend clock?config=quad --timeout 0.01");
    run.fails(6, &["job 1 of the batch, counted from 1: clock:quad did not finish ", " within 0.01 s"]);
    assert_eq!(scratch.files(), ["p.csv"]);
}

#[test]
fn it_says_what_it_is() {
    let scratch = Scratch::new();
    let run = scratch.run("info --backend clock --config full").ok();
    assert!(run.stdout.contains("back end clock\n"), "{run:?}");
    assert!(run.stdout.contains("coordinates of 16 bits\n8192 points\n16 insertions at once\n"), "{run:?}");
    let commands = "\na mesh that lives: locate, interpolate, nearest, insert, delete, move\n";
    assert!(run.stdout.contains(commands), "{run:?}");
    let run = scratch.run("info --backend clock --config quad").ok();
    assert!(run.stdout.contains("\na mesh that lives: kept by the processor\n"), "{run:?}");
}

#[test]
fn an_address_chooses_what_an_argument_chooses() {
    let scratch = Scratch::new();
    scratch.run("generate parabola -n 9 -o p.csv").ok();
    let config = |backend: &str| {
        let run = scratch.run(&format!("triangulate p.csv -o m.ele --json --backend {backend}")).ok();
        let report: Value = serde_json::from_str(&run.stdout).expect("the report is JSON");
        report["config"].clone()
    };
    assert_eq!((config("clock"), config("clock?config=full")), ("small".into(), "full".into()));
    let run = scratch.run("info --backend cpu?threads=1").ok();
    assert!(run.stdout.contains("\n1 thread\n"), "{run:?}");
    let run = scratch.run("info --backend model?coord-bits=20&capacity=99").ok();
    assert!(run.stdout.contains("coordinates of 20 bits\n99 points\n"), "{run:?}");
    for (bad, sentence) in [
        ("clock?config=full --config full", "both choose"),
        ("cpu?threads=1 --threads 1", "both choose"),
        ("clock?config=huge", "choose one of tiny, small, full, large, dual, quad"),
        ("clock?threads=2", "\"config\" is known"),
        ("model --config full", "it needs --backend clock"),
    ] {
        // clap refuses some of the values before the command begins, and its messages have another form.
        let run = scratch.run(&format!("info --backend {bad}"));
        assert!(run.code == Some(2) && run.stdout.is_empty() && run.stderr.contains(sentence), "{bad}: {run:?}");
    }
}

#[test]
fn an_address_chooses_the_bits_of_the_grid() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n70000,0\n0,70000\n70000,70000\n3,5\n");
    let report = |arguments: &str| -> Value {
        let run = scratch.run(arguments).ok();
        serde_json::from_str(&run.stdout).expect("the report is JSON")
    };
    let about = report("triangulate p.csv -o m.obj --json --backend model?coord-bits=20");
    assert_eq!((&about["coord_bits"], &about["quantisation"]), (&20.into(), &Value::Null));
    assert!(scratch.read("m.obj").contains("70000"), "integers of the grid stay as they are");
    let run = scratch.run("triangulate p.csv -o m.obj --backend model?coord-bits=8");
    run.fails(3, &["17 bits", "8 bits", "--backend cpu", "--quantize fit"]);
    scratch.write("half.csv", "0,0\n0.5,0\n0,0.5\n");
    let about = report("triangulate half.csv -o m.ele --quantize fit --json --backend model?coord-bits=10");
    assert_eq!((&about["coord_bits"], &about["quantisation"]["scale"]), (&10.into(), &2046.0.into()));

    // A grid of 8 bits has only 256 times 256 places, so there are fewer distinct points than on a grid of 16 bits.
    let distinct = |arguments: &str| report(&format!("bench uniform -n 5000 --json {arguments}"));
    let (by_address, by_argument) = (distinct("--backend model?coord-bits=8"), distinct("--coord-bits 8"));
    assert_eq!(by_address["coord_bits"], 8);
    assert_eq!(by_address["sets"][0]["distinct"], by_argument["sets"][0]["distinct"]);
    assert_ne!(by_address["sets"][0]["distinct"], distinct("")["sets"][0]["distinct"]);
    let batch = report("bench uniform -n 50 --batch 3 --json --backend model?coord-bits=8");
    assert_eq!(batch["coord_bits"], 8);
    let run = scratch.run("bench uniform -n 50 --backend model?coord-bits=8").ok();
    assert!(run.stdout.contains("sets of 50 points, 8 bits"), "{run:?}");

    for command in ["triangulate p.csv -o n.ele --quantize fit", "bench uniform -n 50", "bench uniform -n 50 --batch 2"]
    {
        let run = scratch.run(&format!("{command} --backend model?coord-bits=20 --coord-bits 20"));
        run.fails(2, &["the address of the back end and --coord-bits both choose: leave one out"]);
        scratch.run(&format!("{command} --backend model?coord-bits=32")).fails(2, &["32"]);
    }
    assert_eq!(scratch.files(), ["half.csv", "m.ele", "m.obj", "p.csv"]);
}

#[test]
fn verbose_is_a_table_with_latencies() {
    let scratch = Scratch::new();
    scratch.run("generate uniform -n 500 -o p.csv").ok();
    let run = scratch.run("triangulate p.csv -o m.ele --backend clock -v").ok();
    for part in
        ["  insert cycles  ", "  aborts  ", "  release cycles  ", " per insertion\n", "cycles of an insertion: least "]
    {
        assert!(run.stderr.contains(part), "{part}: {run:?}");
    }
    assert!(!run.stderr.contains("latency"), "{run:?}");
}

#[test]
fn chips_of_several_engines_are_named_and_used() {
    let scratch = Scratch::new();
    scratch.run("generate kuzmin -n 900 -o p.csv").ok();
    for (config, engines, points) in [("dual", 2, 4096), ("quad", 4, 2048)] {
        let info = scratch.run(&format!("info --backend clock --config {config}")).ok();
        let expected = format!(
            "back end clock\nversion 0.3.0, protocol 2.0\n{engines} engines, each with the points and insertions \
             below\ncoordinates of 16 bits\n{points} points\n16 insertions at once\n"
        );
        assert!(info.stdout.starts_with(&expected), "{}", info.stdout);
        let report = files(&scratch, &format!("--config {config}"));
        assert_eq!((&report["engines"], &report["stuck_engines"]), (&engines.into(), &serde_json::json!([])));
        let run =
            scratch.run(&format!("bench uniform -n 100 --batch 90 --backend clock --config {config} --json")).ok();
        let batch: Value = serde_json::from_str(&run.stdout).expect("the report is JSON");
        assert_eq!(batch["engines"], engines);
        assert_eq!(batch["sets"][0]["stuck_engines"], serde_json::json!([]));
        scratch.run(&format!("generate parabola -n {} -o many.csv", points + 1)).ok();
        let run = scratch.run(&format!("triangulate many.csv -o m.ele --backend clock --config {config}")).ok();
        assert!(run.stderr.contains(&format!(" parts, on a device of {points} points")), "{run:?}");
    }
}
