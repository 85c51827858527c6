//! The example of `docs/simulation.md`: what it prints, and the layout of its waveform.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

#[allow(dead_code)] // The example has a function `main`.
#[path = "../../examples/own_test.rs"]
mod example;

fn scratch(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// The full names of all signals in the head of a waveform, read apart from the code that writes layouts.
fn signals(waveform: &str) -> BTreeSet<String> {
    let mut scopes: Vec<&str> = Vec::new();
    let mut names = BTreeSet::new();
    for line in waveform.lines().map(str::trim).take_while(|line| !line.starts_with("$enddefinitions")) {
        let words: Vec<&str> = line.split(' ').filter(|word| !word.is_empty()).collect();
        match words[0..1.min(words.len())] {
            ["$scope"] => scopes.push(words[2]),
            ["$upscope"] => drop(scopes.pop()),
            ["$var"] => drop(names.insert(format!("{}.{}", scopes.join("."), words[4..words.len() - 1].concat()))),
            _ => {}
        }
    }
    names
}

#[test]
fn the_example_prints_what_its_page_shows() {
    let waveform = scratch("example_prints").join("second.vcd");
    let mut printed = Vec::new();
    example::run(&waveform, &mut printed).unwrap();
    let page = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/simulation.md")).unwrap();
    let printed: String = String::from_utf8(printed).unwrap().lines().map(|line| format!("    {line}\n")).collect();
    assert!(page.contains(&printed), "docs/simulation.md does not show what the example prints:\n{printed}");
}

#[test]
fn every_signal_of_a_layout_is_in_the_waveform() {
    let waveform = scratch("example_layout").join("second.vcd");
    example::run(&waveform, &mut Vec::new()).unwrap();
    let text = fs::read_to_string(&waveform).unwrap();
    let signals = signals(&text);
    let layout = fs::read_to_string(waveform.with_extension("gtkw")).unwrap();
    // Some signals have a shorter name before the full one: `+{short} TOP.full`.
    let full = |line| str::find(line, "TOP.").and_then(|at| line.get(at..));
    let shown: Vec<&str> = layout.lines().filter_map(full).collect();
    for name in &shown {
        assert!(signals.contains(*name), "{name} is not in the waveform");
    }
    for part in ["TOP.command_data[31:0]", "command_port.state$q", "responder.state$q"] {
        assert!(shown.iter().any(|name| name.contains(part)), "{part} is not shown: {shown:?}");
    }
    // Each file of names is there, and names the states in the order of their values.
    let files: BTreeSet<&str> = layout.lines().filter_map(|line| line.strip_prefix("^1 ")).collect();
    assert!(files.len() >= 4, "{files:?}");
    for file in files {
        let names = fs::read_to_string(waveform.with_file_name(file)).unwrap();
        assert!(names.starts_with("0 ") && names.lines().count() > 1, "{file}: {names}");
    }
    let states = fs::read_to_string(waveform.with_file_name("second.AnswerState.txt")).unwrap();
    assert!(states.starts_with("0 Idle\n1 Prepare\n"), "{states}");
}

/// The waveform has the second job and nothing else: it begins with a `Clear` and has one more, its last word.
#[test]
fn the_waveform_shows_the_chosen_job_alone() {
    let folder = scratch("example_job");
    example::run(&folder.join("second.vcd"), &mut Vec::new()).unwrap();
    let text = fs::read_to_string(folder.join("second.vcd")).unwrap();
    let times: Vec<u64> = text.lines().filter_map(|line| line.strip_prefix('#')?.parse().ok()).collect();
    let clocks = (times[times.len() - 1] - times[0]) / 10;
    // The three jobs take some hundred clocks each, and the start of a core more than that.
    assert!((100..2000).contains(&clocks), "{clocks} clocks");
    assert!(times[0] > 1000, "the waveform begins at {}", times[0]);
}

#[test]
fn a_file_that_is_no_waveform_of_a_core_gets_no_layout() {
    let file = scratch("no_waveform").join("text.vcd");
    fs::write(&file, "$scope module TOP $end\n").unwrap();
    let error = incircle_sim::waves::write_layout(&file).unwrap_err().to_string();
    assert!(error.contains("is no VCD waveform"), "{error}");
    let other = "$scope module TOP $end\n$var wire 1 ! clock $end\n$upscope $end\n$enddefinitions $end\n#0\n0!\n";
    fs::write(&file, other).unwrap();
    let error = incircle_sim::waves::write_layout(&file).unwrap_err().to_string();
    assert!(error.contains("it has no signal TOP.command_valid"), "{error}");
    let error = incircle_sim::waves::write_layout(file.with_extension("missing")).unwrap_err().to_string();
    assert!(error.contains("cannot read"), "{error}");
}
