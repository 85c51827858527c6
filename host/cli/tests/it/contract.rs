//! Tests of the command's contract, which scripts rely on.

use crate::common::Scratch;
use serde_json::Value;

/// Five points: a square and a point inside, nearer to the lower side.
const FIVE: &str = "0,0\n10,0\n0,10\n10,10\n5,3\n";
/// The mesh of these five points.
const FIVE_ELE: &str = "4 3 0\n0 0 1 4\n1 0 4 2\n2 1 3 4\n3 2 4 3\n";

fn report(stdout: &str) -> Value {
    assert_eq!(stdout.lines().count(), 1, "one object on one line: {stdout}");
    serde_json::from_str(stdout).expect("the report is JSON")
}

#[test]
fn ele_is_triangles_form_from_zero() {
    let scratch = Scratch::new();
    scratch.write("p.csv", FIVE);
    let run = scratch.run("triangulate p.csv -o m.ele").ok();
    assert_eq!(run.stdout, "");
    assert_eq!(scratch.read("m.ele"), FIVE_ELE);
    assert_eq!(scratch.files(), ["m.ele", "p.csv"]);
}

#[test]
fn ties_take_the_smallest_of_the_four() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "4,4\n4,0\n0,4\n0,0\n");
    scratch.run("triangulate p.csv -o m.ele").ok();
    assert_eq!(scratch.read("m.ele"), "2 3 0\n0 0 2 3\n1 0 3 1\n");
}

#[test]
fn sets_without_triangles_are_answers() {
    let scratch = Scratch::new();
    let sets = [
        ("header", "x,y\n"),
        ("one", "3,4\n"),
        ("two", "3,4\n5,6\n"),
        ("equal", "3,4\n3,4\n3,4\n3,4\n"),
        ("collinear", "0,0\n2,2\n1,1\n7,7\n"),
    ];
    for (name, points) in sets {
        scratch.write(&format!("{name}.csv"), points);
        scratch.run(&format!("triangulate {name}.csv -o {name}.ele")).ok();
        assert_eq!(scratch.read(&format!("{name}.ele")), "0 3 0\n", "{name}");
        for format in ["obj", "ply", "vtk", "geojson", "json", "csv", "npy", "svg"] {
            scratch.run(&format!("triangulate {name}.csv -o {name}-mesh.{format}")).ok();
        }
        scratch.run(&format!("verify {name}.csv {name}.ele")).ok();
    }
}

#[test]
fn json_report_has_all_keys() {
    let scratch = Scratch::new();
    scratch.write("p.csv", format!("{FIVE}10,0\n"));
    let run = scratch.run("triangulate p.csv -o m.ele --backend model --json").ok();
    assert_eq!(run.stderr, "");
    let report = report(&run.stdout);
    for (key, count) in [("points", 6), ("distinct", 5), ("duplicates", 1), ("triangles", 4), ("hull", 4)] {
        assert_eq!(report[key], count, "{key}");
    }
    assert_eq!(report["backend"], "model");
    assert_eq!(report["order"], "brio-hilbert");
    assert_eq!(report["quantisation"], Value::Null);
    assert_eq!(report["counters"]["insertions"], 5);
    assert_eq!(report["coord_bits"], 31);
    let lattice = serde_json::json!({ "kind": "whole", "scale": 1, "offset": [0, 0], "bits": 4, "rounded": 0 });
    assert_eq!(report["lattice"], lattice);
    assert_eq!((&report["contexts"], &report["latency"]), (&Value::from(1), &Value::Null));
    // The software model has no clock, and one context: these are there, and 0.
    for counter in ["insert_cycles", "root_visits", "aborts", "priorities_taken", "issue_cycles", "latency_max"] {
        assert_eq!(report["counters"][counter], 0, "{counter}");
    }
    for stage in ["load", "quantise", "order", "insert", "read", "assemble", "write", "total"] {
        assert!(report["seconds"][stage].is_f64(), "{stage}: {report}");
    }
}

#[test]
fn the_processor_is_the_default() {
    let scratch = Scratch::new();
    scratch.write("p.csv", format!("{FIVE}10,0\n"));
    scratch.run("triangulate p.csv -o model.ele --backend model").ok();
    for (choice, order) in [("", "z-curve"), ("--backend cpu --threads 3", "z-curve"), ("--order input", "input")] {
        let run = scratch.run(&format!("triangulate p.csv -o m.ele {choice} --json")).ok();
        let report = report(&run.stdout);
        assert_eq!(report["backend"], if order == "z-curve" { "cpu" } else { "model" });
        assert_eq!((&report["order"], &report["distinct"]), (&Value::from(order), &Value::from(5)));
        assert_eq!(report["counters"].is_null(), order == "z-curve");
        for stage in ["order", "insert", "assemble", "total"] {
            assert!(report["seconds"][stage].is_f64(), "{stage}: {report}");
        }
        assert_eq!(scratch.read("m.ele"), scratch.read("model.ele"));
    }
    let info = scratch.run("info --backend cpu --threads 3").ok();
    assert!(info.stdout.contains("32 bits") && info.stdout.contains("3 threads"), "{info:?}");
    scratch.run("triangulate p.csv -o m.ele --backend cpu --order hilbert").fails(2, &["--order", "--backend model"]);
    scratch.run("triangulate p.csv -o m.ele --backend model --threads 2").fails(2, &["--threads", "--backend cpu"]);
    scratch.run("triangulate p.csv -o m.ele --backend cpu --config tiny").fails(2, &["--config", "--backend clock"]);
    let none = scratch.run("triangulate p.csv -o m.ele --threads 0");
    assert_eq!(none.code, Some(2));
    assert!(
        none.stderr.contains("from 1 to 4294967295, or leave the option out for one thread on each processor"),
        "{none:?}"
    );
}

#[test]
fn numbers_are_taken_as_they_are_written() {
    let scratch = Scratch::new();
    let sets = [
        ("0,0\n-65536,0\n0,65535\n", "whole", 17),
        ("0,0\n4294967295,0\n0,7\n", "whole", 32),
        ("0,0\n4294967296,0\n0,7\n", "whole", 33),
        ("9223372036854775807,0\n-9223372036854775808,1\n0,7\n", "whole", 64),
        ("-101.473911,0\n1,0.1\n0,7\n", "decimal", 27),
    ];
    for (points, kind, bits) in sets {
        scratch.write("i.csv", points);
        let run = scratch.run("triangulate i.csv -o m.ele --json").ok();
        let report = report(&run.stdout);
        assert_eq!((&report["lattice"]["kind"], &report["lattice"]["bits"]), (&kind.into(), &bits.into()), "{points}");
        assert_eq!((&report["quantisation"], &report["triangles"]), (&Value::Null, &1.into()), "{points}");
        scratch.run("verify i.csv m.ele").ok();
    }

    scratch.write("f.csv", "-1.5,0\n1.5,0\n0,1\n0,0.5\n");
    let run = scratch.run("triangulate f.csv -o f.obj --json").ok();
    let lattice =
        serde_json::json!({ "kind": "decimal", "scale": 0.1, "offset": [-1.5, 0.0], "bits": 5, "rounded": 0 });
    assert_eq!(report(&run.stdout)["lattice"], lattice);
    // The mesh has the coordinates of the file.
    assert!(scratch.read("f.obj").starts_with("v -1.5 0 0\nv 1.5 0 0\nv 0 1 0\nv 0 0.5 0\nf "));
    scratch.run("verify f.csv f.obj").ok();
}

#[test]
fn quantisation_can_be_asked_for() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "-70000,0\n70000,0\n0,140000\n3,5\n");
    let run = scratch.run("triangulate p.csv -o m.ele --quantize fit --json").ok();
    assert_eq!(report(&run.stdout)["quantisation"]["scale"], 2_147_483_647.0 / 140_000.0);
    scratch.run("verify p.csv m.ele --quantize fit").ok();
    let run = scratch.run("triangulate p.csv -o m.ele --quantize fit --coord-bits 16 --json").ok();
    let about = report(&run.stdout);
    assert_eq!(about["quantisation"]["scale"], 65535.0 / 140_000.0);
    assert_eq!((&about["lattice"]["kind"], &about["lattice"]["bits"]), (&"quantized".into(), &16.into()));
    scratch.run("verify p.csv m.ele --quantize fit --coord-bits 16").ok();
    scratch.run("triangulate p.csv -o m.ele --quantize 0.25,-70000,0").ok();
    scratch.run("verify p.csv m.ele --quantize 0.25,-70000,0").ok();
    scratch
        .run("triangulate p.csv -o m.ele --quantize 1,-70000,0 --coord-bits 16")
        .fails(3, &["row 2, column 1", "140000"]);
}

#[test]
fn coordinate_bits_bound_what_a_back_end_takes() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n2147483647,0\n0,2147483647\n2147483646,2147483646\n");
    scratch.run("triangulate p.csv -o m.ele").ok();
    scratch.run("triangulate p.csv -o model.ele --backend model").ok();
    assert_eq!(scratch.read("m.ele"), scratch.read("model.ele"));
    let both_ways_out = ["--backend cpu", "--quantize fit"];
    let run = scratch.run("triangulate p.csv -o c.ele --backend clock");
    run.fails(3, &["p.csv: ", "31 bits", "16 bits", "clock", both_ways_out[0], both_ways_out[1]]);
    scratch.write("wide.csv", "0,0\n2147483648,0\n0,7\n");
    scratch.run("triangulate wide.csv -o c.ele --backend model").fails(3, &["32 bits", "31 bits", both_ways_out[0]]);
    scratch.write("doubles.csv", "0,0\n0.12345678901234567,0\n0,7\n");
    let run = scratch.run("triangulate doubles.csv -o c.ele --backend model");
    run.fails(3, &["no lattice", both_ways_out[0], both_ways_out[1]]);
    for command in ["triangulate p.csv -o c.ele", "verify p.csv m.ele"] {
        scratch.run(&format!("{command} --coord-bits 16")).fails(2, &["--coord-bits", "--quantize fit"]);
    }
    assert_eq!(scratch.files(), ["doubles.csv", "m.ele", "model.ele", "p.csv", "wide.csv"]);
}

#[test]
fn verification_tells_right_from_wrong() {
    let scratch = Scratch::new();
    scratch.write("p.csv", FIVE);
    scratch.write("right.ele", FIVE_ELE);
    let run = scratch.run("verify p.csv right.ele").ok();
    assert_eq!(run.stderr, "");
    let counts = "5 points, 4 triangles, 4 points on the hull, 0 ties\n";
    let sentence = "the triangles of right.ele are the canonical Delaunay triangulation of p.csv: ";
    assert_eq!(run.stdout, format!("{sentence}{counts}"));
    let run = scratch.run("verify p.csv right.ele --json").ok();
    assert_eq!(report(&run.stdout)["valid"], true);

    let wrong = [
        ("flipped", "4 3 0\n0 0 1 2\n1 1 3 2\n2 1 4 2\n3 0 4 1\n"),
        ("missing", "3 3 0\n0 0 1 4\n1 0 4 2\n2 1 3 4\n"),
        ("miscounted", "4 3 0\n0 0 1 4\n1 0 4 2\n2 1 3 4\n"),
        ("doubled", "5 3 0\n0 0 1 4\n1 0 4 2\n2 1 3 4\n3 2 4 3\n4 2 4 3\n"),
        ("beyond", "4 3 0\n0 0 1 4\n1 0 4 2\n2 1 3 4\n3 2 4 5\n"),
        ("empty", "0 3 0\n"),
    ];
    for (name, mesh) in wrong {
        scratch.write(&format!("{name}.ele"), mesh);
        scratch.run(&format!("verify p.csv {name}.ele")).fails(1, &[name]);
        let run = scratch.run(&format!("verify p.csv {name}.ele --json"));
        assert_eq!(run.code, Some(1), "{name}");
        assert_eq!(report(&run.stdout)["valid"], false, "{name}");
    }
    // The other diagonal of a square is Delaunay as well, but not canonical.
    scratch.write("square.csv", "0,0\n4,0\n4,4\n0,4\n");
    scratch.write("square.ele", "2 3 0\n0 0 1 3\n1 1 2 3\n");
    scratch.run("verify square.csv square.ele").fails(1, &["square.ele"]);
}

#[test]
fn wrong_use_ends_with_two() {
    let scratch = Scratch::new();
    scratch.write("p.csv", FIVE);
    for arguments in [
        "",
        "flatten p.csv",
        "triangulate p.csv",
        "triangulate p.csv -o m.ele --coord-bits 7",
        "triangulate p.csv -o m.ele --coord-bits 32",
        "triangulate p.csv -o m.ele --quantize never",
        "triangulate p.csv -o m.ele --timeout 0",
        "triangulate p.csv -o m.ele --order alphabetic",
        "triangulate p.csv -o m.ele --contexts 0",
        "triangulate p.csv -o m.ele --contexts many",
        "bench everything",
        "bench --mhz 0",
        "bench -n 0",
        "bench --coord-bits 32",
        "triangulate p.csv -o m.ele --backend abacus",
        "verify p.csv m.svg --format svg",
        "generate uniform -n 5 --bits 32 -o x.csv",
        "generate uniform -n -5 -o x.csv",
    ] {
        let run = scratch.run(arguments);
        assert_eq!(run.code, Some(2), "{arguments}: {run:?}");
    }
    let one_sentence = [
        ("triangulate p.csv -o m.xls", "m.xls"),
        ("triangulate p.csv -o m", "--format"),
        ("triangulate p.csv -o -", "standard output: a mesh that has no file name needs a format: add --format"),
        ("verify p.csv -", "standard input: a mesh that has no file name needs a format: add --format ele"),
        ("triangulate p.csv -o - --format ele --json", "--json"),
        ("triangulate p.csv -o m.ele --config tiny", "--backend sim"),
        ("triangulate p.csv -o m.ele --trace t.vcd", "--backend sim"),
        ("triangulate p.csv -o m.ele --trace t.vcd --backend clock", "--backend sim"),
        ("triangulate p.csv -o m.ele --contexts 2", "model cannot work with 2 contexts: choose 1,"),
        ("bench --contexts 2", "model cannot work with 2 contexts: choose 1,"),
        ("bench --config tiny", "--backend clock"),
        ("bench -n 600000000", "536870911"),
        ("generate uniform -n 5 -o x.ply", "x.ply"),
        ("verify p.csv m.svg", "m.svg"),
        ("verify - - --format csv", "points and mesh cannot both come from standard input"),
        ("verify - m.csv --constraints -", "standard input can be read only once, but 2 files of this command"),
        ("triangulate - -o m.ele --constraints -", "standard input can be read only once, but 2 files of this command"),
        ("interpolate - --at - -o v.csv", "standard input can be read only once, but 2 files of this command"),
        ("voronoi - --clip-to - -o c.geojson", "standard input can be read only once, but 2 files of this command"),
    ];
    scratch.write("m.svg", "<svg/>");
    for (arguments, part) in one_sentence {
        scratch.run(arguments).fails(2, &[part]);
    }
    assert_eq!(scratch.files(), ["m.svg", "p.csv"]);
}

#[cfg(not(feature = "sim"))]
#[test]
fn a_build_without_the_core_says_how_to_build_it() {
    let scratch = Scratch::new();
    scratch.write("p.csv", FIVE);
    for command in ["triangulate p.csv -o m.ele", "bench", "info"] {
        let run = scratch.run(&format!("{command} --backend sim"));
        run.fails(2, &["--features sim", "--backend clock"]);
    }
    assert_eq!(scratch.files(), ["p.csv"]);
}

#[test]
fn help_version_and_completions_go_to_standard_output() {
    let scratch = Scratch::new();
    for arguments in ["--help", "triangulate --help", "--version"] {
        let run = scratch.run(arguments).ok();
        assert!(run.stdout.contains("incircle") && run.stderr.is_empty(), "{run:?}");
    }
    let about = scratch.run("--help").ok().stdout;
    assert!(about.starts_with("Exact Delaunay triangulation"), "{about}");
    // The help offers the formats that can be read, and says what is not checked.
    let help = scratch.run("verify --help").ok().stdout;
    for (part, there) in [("- ele:", true), ("- vtk:", false), ("svg", false), ("Only the triangles are checked", true)]
    {
        assert_eq!(help.contains(part), there, "{part}: {help}");
    }
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let run = scratch.run(&format!("completions {shell}")).ok();
        assert!(run.stdout.contains("triangulate"), "{shell}");
    }
    let run = scratch.run("info").ok();
    assert!(run.stdout.contains("back end model\n"), "{run:?}");
}

#[test]
fn orders_and_formats_do_not_change_the_mesh() {
    let scratch = Scratch::new();
    scratch.run("generate checkers -n 500 --seed 3 -o p.csv").ok();
    scratch.run("triangulate p.csv -o m.ele").ok();
    for order in ["hilbert", "input"] {
        scratch.run(&format!("triangulate p.csv -o {order}.ele --order {order}")).ok();
        assert_eq!(scratch.read("m.ele"), scratch.read(&format!("{order}.ele")));
    }
}

#[test]
fn a_run_out_of_time_ends_with_six() {
    let scratch = Scratch::new();
    scratch.run("generate uniform -n 200000 -o p.csv").ok();
    scratch.run("triangulate p.csv -o m.ele --timeout 0.0000001").fails(6, &["s"]);
    assert_eq!(scratch.files(), ["p.csv"]);
}

#[test]
fn quiet_is_quiet_and_verbose_says_more() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0.5,0\n1,0\n0,1\n");
    let quiet = scratch.run("triangulate p.csv -o m.ele -q").ok();
    assert_eq!((quiet.stdout.as_str(), quiet.stderr.as_str()), ("", ""));
    let plain = scratch.run("triangulate p.csv -o m.ele").ok();
    assert!(plain.stderr.starts_with("lattice: decimals, steps of 1e-1, 4 bits\n"), "{plain:?}");
    let verbose = scratch.run("triangulate p.csv -o m.ele --backend model -v").ok();
    assert!(verbose.stderr.contains("  insertions                   3      1.000 per insertion\n"), "{verbose:?}");
    assert!(verbose.stderr.contains("  walk visits"), "{verbose:?}");
    // Without a clock the printed lines name no cycles.
    assert!(!verbose.stderr.contains("cycles"), "{verbose:?}");
}

#[test]
fn one_is_told_in_the_singular() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "0,0\n1,0\n0,1\n");
    let run = scratch.run("triangulate p.csv -o m.ele").ok();
    assert!(run.stderr.contains("\n3 points, 1 triangle, 3 points on the hull; "), "{run:?}");
    scratch.write("p.csv", "7,7\n");
    let run = scratch.run("triangulate p.csv -o m.ele").ok();
    assert!(run.stderr.contains("\n1 point, 0 triangles, 1 point on the hull; "), "{run:?}");
}

#[cfg(unix)]
#[test]
fn file_names_have_no_power_over_the_terminal() {
    let scratch = Scratch::new();
    let name = "a\n\u{1b}[2Jb.csv";
    scratch.write(name, "0,0\nx,1\n");
    let run = |arguments: &[&str]| crate::common::Run::of(scratch.command(arguments).output().expect("it runs"));
    let shown = r"a\n\u{1b}[2Jb.csv";
    run(&["triangulate", name, "-o", "m.ele"]).fails(3, &[shown, "row 2"]);
    run(&["triangulate", name, "-o", name]).fails(2, &[shown, "both the input"]);
    run(&["triangulate", "p.csv", "-o", "a\tb"]).fails(2, &[r"a\tb"]);
    run(&["generate", "uniform", "-n", "3", "-o", "a\tb.obj"]).fails(2, &[r"a\tb.obj"]);
}

#[test]
fn extreme_values_stay_short_in_messages() {
    let scratch = Scratch::new();
    scratch.write("p.csv", "1e300,0.5\n2e300,0\n1e300,1e300\n");
    let run = scratch.run("triangulate p.csv -o m.ele --quantize fit").ok();
    assert!(run.stderr.contains("offset (1e300, 0)"), "{run:?}");
    assert!(run.stderr.lines().all(|line| line.len() < 200), "{run:?}");
    scratch.write("p.csv", "0,0\n1e-310,0\n0,0.0\n");
    scratch.run("triangulate p.csv -o n.ele --quantize fit").fails(3, &["span 1e-310 units"]);
}
