//! Tests of `incircle bench`: a table for people, an object for scripts.

use std::path::Path;

use crate::common::{Run, Scratch};
use serde_json::Value;

/// The words of every row, without the lines above the rows.
fn rows(run: &Run, above: usize) -> Vec<Vec<String>> {
    let lines = run.stdout.lines().skip(above);
    lines.map(|line| line.split_whitespace().map(str::to_owned).collect()).collect()
}

#[test]
fn a_core_has_a_row_per_set_with_every_column() {
    let scratch = Scratch::new();
    let run = scratch.run("bench --backend clock -n 600 --seed 3").ok();
    assert_eq!(run.stderr, "");
    let about = "clock small, 16 contexts; sets of 600 points, 16 bits, seed 3, order brio-hilbert\n";
    assert!(run.stdout.starts_with(about), "{run:?}");
    assert!(run.stdout.lines().nth(1).is_some_and(|line| line.contains("at 125 MHz")), "{run:?}");
    // All lines of the table have the same width.
    let widths: Vec<usize> = run.stdout.lines().skip(1).map(str::len).collect();
    assert!(widths.iter().all(|&width| width == widths[0] && width < 140), "{widths:?}");
    let rows = rows(&run, 3);
    let sets: Vec<&str> = rows.iter().map(|row| row[0].as_str()).collect();
    assert_eq!(sets, ["uniform", "normal", "kuzmin", "line", "checkers", "lattice"]);
    for row in &rows {
        assert_eq!(row.len(), 17, "{row:?}");
        let value = |column: usize| row[column].parse::<f64>().unwrap_or_else(|_| panic!("column {column}: {row:?}"));
        let (distinct, cycles, ms) = (value(1), value(2), value(3));
        assert!((cycles * distinct / 125e3 - ms).abs() < 0.01, "{row:?}");
        assert!((9..=12).all(|column| value(column) > 1.0 && value(column) < 100.0), "{row:?}");
        assert!((13..16).all(|column| value(column) <= value(column + 1)), "{row:?}");
    }
    assert_eq!(scratch.run("bench --backend clock -n 600 --seed 3").ok().stdout, run.stdout);
}

#[test]
fn json_has_everything() {
    let scratch = Scratch::new();
    let run = scratch.run("bench box spiral --backend clock -n 900 --contexts 2 --order hilbert --mhz 50 --json").ok();
    assert_eq!((run.stderr.as_str(), run.stdout.lines().count()), ("", 1));
    let bench: Value = serde_json::from_str(&run.stdout).expect("an object");
    for (key, value) in [("backend", "clock"), ("config", "small"), ("order", "hilbert")] {
        assert_eq!(bench[key], value);
    }
    for (key, value) in [("contexts", 2), ("capacity", 1024), ("n", 900), ("coord_bits", 16), ("seed", 1)] {
        assert_eq!(bench[key], value);
    }
    let sets = bench["sets"].as_array().expect("a list");
    assert_eq!(sets.len(), 2);
    for (set, name) in sets.iter().zip(["box", "spiral"]) {
        assert_eq!(set["set"], name);
        let cycles = set["cycles"].as_f64().expect("cycles are counted");
        assert_eq!(set["seconds_at_mhz"], cycles / 50e6);
        assert_eq!(set["counters"]["insert_cycles"], set["cycles"]);
        assert_eq!(set["counters"]["insertions"], set["distinct"]);
        for port in ["issue", "write", "commit", "release"] {
            let share = set["busy"][port].as_f64().expect("a share");
            assert_eq!(share, set["counters"][format!("{port}_cycles")].as_f64().expect("a count") / cycles);
        }
        assert!(set["latency"]["p99"].as_u64() >= set["latency"]["median"].as_u64());
        assert!(set["seconds"]["total"].as_f64() > set["seconds"]["insert"].as_f64());
    }
}

#[test]
fn more_contexts_take_fewer_cycles() {
    let scratch = Scratch::new();
    let cycles = [1, 4, 16].map(|contexts| {
        let run = scratch.run(&format!("bench uniform --backend clock -n 2000 --contexts {contexts} --json")).ok();
        let bench: Value = serde_json::from_str(&run.stdout).expect("an object");
        bench["sets"][0]["cycles_per_insertion"].as_f64().expect("a number")
    });
    assert!(cycles[0] > 2.5 * cycles[1] && cycles[1] > 1.5 * cycles[2], "{cycles:?}");
}

#[test]
fn the_software_model_has_host_times() {
    let scratch = Scratch::new();
    let run = scratch.run("bench -n 3000 --coord-bits 20").ok();
    assert!(run.stdout.starts_with("model, 1 context; sets of 3000 points, 20 bits, seed 1,"), "{run:?}");
    let rows = rows(&run, 2);
    assert_eq!(rows.len(), 6);
    assert!(rows.iter().all(|row| row.len() == 7 && row[2].parse::<f64>().is_ok_and(|time| time > 1.0)), "{rows:?}");
    let run = scratch.run("bench lattice -n 100 --json").ok();
    let bench: Value = serde_json::from_str(&run.stdout).expect("an object");
    assert_eq!((&bench["config"], bench.get("mhz")), (&Value::Null, None));
    assert_eq!(bench["sets"][0]["latency"], Value::Null);
    assert_eq!(bench["sets"][0].get("cycles"), None);
}

#[test]
fn the_cpu_triangulator_has_host_times_and_no_counters() {
    let scratch = Scratch::new();
    let run = scratch.run("bench uniform -n 3000 --backend cpu --threads 1").ok();
    assert!(run.stdout.starts_with("cpu, 1 thread; sets of 3000 points, 16 bits, seed 1\n"), "{run:?}");
    let row = &rows(&run, 2)[0];
    assert!(row[2..4].iter().all(|time| time.parse::<f64>().is_ok_and(|time| time > 1.0)), "{row:?}");
    assert_eq!(row[4..], ["-", "-", "-"]);
    let run = scratch.run("bench lattice -n 100 --backend cpu --json").ok();
    let bench: Value = serde_json::from_str(&run.stdout).expect("an object");
    assert_eq!((&bench["backend"], &bench["order"]), (&Value::from("cpu"), &Value::Null));
    assert_eq!(bench["sets"][0]["counters"], Value::Null);
}

#[test]
fn sets_that_the_host_answers_alone_have_dashes() {
    let scratch = Scratch::new();
    for backend in ["cpu", "model", "clock"] {
        let run = scratch.run(&format!("bench uniform -n 2 --backend {backend}")).ok();
        let row = run.stdout.lines().last().expect("a row");
        assert!(row.ends_with(" -") && !row.contains("NaN") && !row.contains("inf"), "{row}");
        scratch.run(&format!("bench uniform -n 1 --json --backend {backend}")).ok();
    }
}

#[test]
fn a_batch_is_told_from_the_first_word_to_the_last_triangle() {
    let scratch = Scratch::new();
    let run = scratch.run("bench --batch 40 -n 200 --backend clock --seed 5").ok();
    let about =
        "clock full, 16 contexts; 40 jobs of 200 points each, 16 bits, seeds from 5, order brio-hilbert, ms at \
                 125 MHz\n";
    assert!(run.stdout.starts_with(about), "{run:?}");
    let widths: Vec<usize> = run.stdout.lines().skip(1).map(str::len).collect();
    assert!(widths.iter().all(|&width| width == widths[0]), "{widths:?}");
    let rows = rows(&run, 2);
    assert_eq!(rows.len(), 6);
    for row in &rows {
        let value = |column: usize| row[column].parse::<f64>().unwrap_or_else(|_| panic!("column {column}: {row:?}"));
        let (points, cycles, ms) = (value(1), value(3), value(7));
        // The batch runs in groups of 14, 13 and 13 jobs.
        assert!(points > 7900.0 && cycles > 10.0 && cycles < 25.0, "{row:?}");
        assert!((cycles * points / 125e3 - ms).abs() < 0.01, "{row:?}");
        assert!((value(8) - 25.0 * ms).abs() < 0.1 && (value(9) - 8.0 * cycles).abs() < 0.1, "{row:?}");
        assert!((40.0 * value(5) - cycles * points).abs() < 0.01 * points, "{row:?}");
        // The jobs share the memory, so none has a time of its own.
        assert_eq!((row[4].as_str(), row[6].as_str()), ("-", "-"));
    }
    let run = scratch.run("bench uniform --batch 20 -n 60 --backend clock --config small --contexts 3 --json").ok();
    let bench: Value = serde_json::from_str(&run.stdout).expect("an object");
    let numbers = ["jobs", "n", "contexts", "capacity"].map(|key| bench[key].as_u64());
    assert_eq!((&bench["config"], numbers), (&Value::from("small"), [Some(20), Some(60), Some(3), Some(1024)]));
    let set = &bench["sets"][0];
    let cycles = set["cycles"].as_f64().expect("cycles are counted");
    assert_eq!(set["cycles_per_point"], cycles / set["distinct"].as_f64().expect("a count"));
    assert_eq!((&set["longest_job_cycles"], &set["engine_cycles_per_point"]), (&Value::Null, &Value::Null));
    assert_eq!(set["seconds_at_mhz"], cycles / 125e6);
    // Jobs side by side take a fraction of the time of the same jobs one after the other.
    let alone = scratch.run("bench uniform --batch 20 -n 60 --backend clock --config small --contexts 1 --json").ok();
    let alone: Value = serde_json::from_str(&alone.stdout).expect("an object");
    assert!(alone["sets"][0]["cycles"].as_f64().expect("cycles") > 2.0 * cycles);
    for backend in ["cpu", "model"] {
        let run = scratch.run(&format!("bench uniform --batch 20 -n 100 --backend {backend}")).ok();
        let row = run.stdout.lines().last().expect("a row").split_whitespace().nth(3).map(str::to_owned);
        assert_eq!(row.as_deref(), Some("-"), "{run:?}");
        let run = scratch.run(&format!("bench uniform --batch 20 -n 100 --backend {backend} --json")).ok();
        let bench: Value = serde_json::from_str(&run.stdout).expect("an object");
        assert_eq!((bench.get("mhz"), bench["sets"][0].get("cycles")), (None, None));
    }
}

#[test]
fn jobs_that_a_core_cannot_hold_are_done_in_parts() {
    let scratch = Scratch::new();
    let run = scratch.run("bench uniform --batch 2 -n 2000 --backend clock --config small").ok();
    let row = &rows(&run, 2)[0];
    assert_eq!((&row[1..3], row[4].as_str()), (&["4000".to_owned(), "7952".to_owned()][..], "-"), "{row:?}");
    // Parts take more clocks than the insertions of one set.
    assert!(row[3].parse::<f64>().is_ok_and(|clocks| (15.0..40.0).contains(&clocks)), "{row:?}");
    let run = scratch.run("bench uniform -n 4096 --backend clock --config small").ok();
    assert!(rows(&run, 3)[0][2..].iter().all(|cell| cell == "-"), "{run:?}");
    assert!(run.stdout.lines().last().is_some_and(|line| line.trim_start().starts_with("13 parts")), "{run:?}");
}

#[test]
fn a_batch_of_which_no_job_reaches_the_core_has_no_cycles() {
    let scratch = Scratch::new();
    let run = scratch.run("bench uniform --batch 2 -n 1 --backend clock").ok();
    let row: Vec<&str> = run.stdout.lines().last().expect("a row").split_whitespace().collect();
    assert_eq!(row[3..], ["-"; 8], "{}", run.stdout);
    let run = scratch.run("bench uniform --batch 2 -n 1 --backend clock --json").ok();
    let bench: Value = serde_json::from_str(&run.stdout).expect("an object");
    assert_eq!((&bench["sets"][0]["distinct"], bench["sets"][0].get("cycles")), (&Value::from(2), None));
}

/// All points are in memory at once, so their number is limited.
#[test]
fn a_batch_of_too_many_points_is_refused() {
    let scratch = Scratch::new();
    scratch.run("bench --batch 1000000 -n 2000").fails(2, &["2000000000 points", "at most 67108864"]);
    scratch.run("bench --batch 4096 -n 16385").fails(2, &["67112960 points"]);
    // The largest allowed number passes this check, and the next wrong argument is named.
    scratch.run("bench --batch 4096 -n 16384 --backend clock --coord-bits 17").fails(7, &["16 bits", "17"]);
}

#[cfg(target_os = "linux")]
#[test]
fn more_points_than_memory_are_refused_before_they_are_made() {
    let scratch = Scratch::new();
    let program = env!("CARGO_BIN_EXE_incircle");
    let run = |arguments: &str| {
        let line = format!("ulimit -v 800000 && exec '{program}' bench uniform {arguments}");
        let output = std::process::Command::new("sh").args(["-c", &line]).current_dir(scratch.path("")).output();
        Run::of(output.expect("the shell starts"))
    };
    for (arguments, sets) in [
        ("-n 67 --batch 1000000 --backend clock?config=quad", "1000000 jobs of 67 points each"),
        ("-n 1 --batch 1000000", "1000000 jobs of 1 point each"),
        ("-n 67108864 --batch 1 --backend cpu", "1 job of 67108864 points each"),
        ("-n 67108864", "a set of 67108864 points"),
        ("-n 67108864 --backend clock", "a set of 67108864 points"),
    ] {
        run(arguments).fails(7, &[" MiB of memory are needed for ", sets, " MiB are free: "]);
    }
    run("-n 200 --batch 50 --backend cpu").ok();
}

#[test]
fn negative_numbers_are_refused_with_the_bounds() {
    let scratch = Scratch::new();
    for (arguments, told) in [
        ("--batch -1", "give a whole number from 1 to 1000000"),
        ("--batch 1000001", "give a whole number from 1 to 1000000"),
        ("-n -1", "give a whole number from 1 to 4294967295"),
        ("--coord-bits -1", "give a whole number from 1 to 31"),
        ("--mhz -1", "give a positive number of megahertz"),
    ] {
        let run = scratch.run(&format!("bench {arguments}"));
        assert!(run.code == Some(2) && run.stderr.contains(told), "{arguments}: {run:?}");
    }
}

/// As many jobs share the core as fit. Jobs of 5,000 points, of which only one fits, are exclusive jobs.
#[test]
fn jobs_of_middle_size_go_side_by_side() {
    let scratch = Scratch::new();
    let measured = |jobs: u32, n: u32| {
        let run = scratch.run(&format!("bench uniform --batch {jobs} -n {n} --backend clock --json")).ok();
        serde_json::from_str::<Value>(&run.stdout).expect("an object")["sets"][0].clone()
    };
    let cycles = |set: &Value| set["cycles_per_point"].as_f64().expect("cycles are counted");
    let [small, middle, large] = [(39, 520), (40, 1000), (10, 5000)].map(|(jobs, n)| measured(jobs, n));
    assert!(cycles(&small) < 17.0 && cycles(&middle) < 16.0 && cycles(&large) < 20.0, "{small} {middle} {large}");
    let is_exclusive = [&small, &middle, &large].map(|set| !set["longest_job_cycles"].is_null());
    assert_eq!(is_exclusive, [false, false, true]);
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/performance.md");
    let page = std::fs::read_to_string(page).expect("docs/performance.md is there");
    let figure = format!("{:.1} cycles a point", cycles(&middle));
    assert!(page.contains(&figure), "docs/performance.md has no {figure}");
}

/// Checks figures of the documents. Cycles are the same on every machine, so this test does not depend on time.
#[test]
fn a_sequence_of_exclusive_jobs_costs_little_more_than_the_insertions() {
    let scratch = Scratch::new();
    let run = scratch.run("bench uniform --batch 20 -n 8192 --backend clock --json").ok();
    let bench: Value = serde_json::from_str(&run.stdout).expect("an object");
    assert_eq!((&bench["config"], bench["contexts"].as_u64()), (&Value::from("full"), Some(16)));
    let set = &bench["sets"][0];
    let number = |key: &str| set[key].as_f64().unwrap_or_else(|| panic!("{key}: {set}"));
    assert_eq!(number("cycles_per_job"), number("cycles") / 20.0);
    assert!(number("cycles_per_job") <= number("longest_job_cycles"), "{set}");
    assert!(number("longest_job_cycles") <= 150_000.0, "{set}");
    // The documents have a comma after the thousands.
    let shown = |key: &str| {
        let cycles = number(key).round() as u64;
        format!("{},{:03}", cycles / 1000, cycles % 1000)
    };
    for document in ["docs/performance.md", "docs/core.md", "docs/engine.md", "docs/batches.md"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(document);
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        for figure in [shown("cycles_per_job"), shown("longest_job_cycles")] {
            assert!(text.contains(&figure), "{document} has no {figure}");
        }
    }
    let (whole, engine) = (number("cycles_per_point"), number("engine_cycles_per_point"));
    // The read-out alone takes two clocks a point.
    assert!(whole - engine > 2.0 && whole - engine <= 2.5, "{set}");
    let table = scratch.run("bench uniform --batch 2 -n 8192 --backend clock").ok();
    let row = &rows(&table, 2)[0];
    let value = |column: usize| row[column].parse::<f64>().unwrap_or_else(|_| panic!("column {column}: {row:?}"));
    assert!(value(3) > value(4) + 2.0 && value(5) <= value(6) && value(6) <= 150_000.0, "{row:?}");
}

#[test]
fn arguments_that_do_not_fit_the_core_are_told_before_any_row() {
    let scratch = Scratch::new();
    scratch.run("bench --backend clock --coord-bits 17").fails(7, &["16 bits", "17"]);
    scratch.run("bench --backend clock --contexts 17").fails(2, &["17 contexts", "the 16 of the core full"]);
    // The advice is one that the command accepts.
    let run = scratch.run("bench uniform -n 10 --backend clock --contexts 17");
    run.fails(2, &["choose fewer or --config large"]);
    let run = scratch.run("bench uniform -n 10 --batch 2 --backend clock?config=quad --contexts 17");
    run.fails(2, &["the 16 of the core quad", ": choose fewer, or config=large in the address of the back end"]);
    let run = scratch.run("bench uniform -n 10 --batch 2 --backend clock?config=large --contexts 17").ok();
    assert!(run.stdout.starts_with("clock large, 17 contexts;"), "{run:?}");
    let run = scratch.run("bench uniform -n 10 --batch 2 --backend clock?config=large --contexts 25");
    run.fails(2, &["the 24 of the core large", "): choose fewer\n"]);
    // Only distinct points count: 20000 points fall onto 5000 places.
    let run = scratch.run("bench box -n 20000 --backend clock").ok();
    assert!(run.stdout.starts_with("clock full,"), "{run:?}");
}
