//! Tests that a script on a simulated core with runs gives the files of the back end `cpu`, byte for byte.

use crate::common::Scratch;
use serde_json::Value;

/// Replays `s.txt` on the processor and on this back end, compares all files, and returns the report of the second run.
#[track_caller]
pub fn compare(scratch: &Scratch, backend: &str) -> Value {
    scratch.run("replay s.txt -o cpu.ele --answers cpu.txt --film cpu.svg -q").ok();
    let run = format!("replay s.txt -o sim.ele --answers sim.txt --film sim.svg --backend {backend} --json");
    let run = scratch.run(&run).ok();
    for ending in ["ele", "txt", "svg"] {
        assert!(scratch.read(&format!("sim.{ending}")) == scratch.read(&format!("cpu.{ending}")), "{ending}");
    }
    serde_json::from_str(&run.stdout).expect("the report is JSON")
}

#[test]
fn made_scripts_give_the_files_of_the_processor() {
    let scratch = Scratch::new();
    for (recipe, length) in [("drift", "--frames 6"), ("tracks", "--frames 10"), ("churn", "--commands 400")] {
        scratch.run(&format!("generate {recipe} -n 60 {length} --seed 8 -o s.txt")).ok();
        let report = compare(&scratch, "sim");
        let by = [&report["changes_by"], &report["mesh_by"], &report["config"]];
        assert_eq!(by, ["sim", "sim", "small"], "{recipe}");
    }
}

#[test]
fn the_address_chooses_a_core_with_runs_or_one_without() {
    let scratch = Scratch::new();
    scratch.write("s.txt", "insert 0 0\ninsert 9 0\ninsert 0 9\nlocate 1 1\ndelete 1\nnearest 8 1\ninsert 5 5\n");
    for (address, by) in
        [("sim?living=yes", "sim"), ("sim?config=small&living=yes", "sim"), ("sim?config=small&living=no", "cpu")]
    {
        assert_eq!(compare(&scratch, address)["changes_by"], by, "{address}");
    }
    let missing = "there is no simulated core \"tiny\" with runs: choose small, or the back end clock";
    scratch.run("replay s.txt -o m.ele --backend sim?config=tiny&living=yes").fails(2, &[missing]);
    scratch.run("info --backend sim?config=quad&living=yes").fails(2, &["\"quad\" with runs: choose small, or"]);
    let plain = "cannot keep a mesh that lives";
    scratch.write("p.csv", "x,y,z\n0,0,1\n9,0,2\n0,9,3\n");
    scratch.run("interpolate p.csv --grid 4 -o v.csv --backend sim?config=small&living=no --quiet").fails(2, &[plain]);
    // A core with runs does all other jobs as well.
    scratch.run("generate uniform -n 300 --bits 16 -o u.csv").ok();
    scratch.run("triangulate u.csv -o a.ele -q").ok();
    scratch.run("triangulate u.csv -o b.ele -q --backend sim?living=yes").ok();
    assert_eq!(scratch.read("a.ele"), scratch.read("b.ele"));
    let waves = "a simulated core with runs writes no waveform";
    scratch.run("triangulate u.csv -o b.ele --backend sim?living=yes --trace w.vcd").fails(2, &[waves]);
}

#[test]
fn places_get_the_values_of_the_processor() {
    let scratch = Scratch::new();
    let rows: String = (0..40u32).map(|k| format!("{},{},{}\n", k * 37 % 100, k * k % 89, k % 7)).collect();
    scratch.write("p.csv", format!("x,y,z\n{rows}"));
    for backend in ["cpu", "sim"] {
        scratch.run(&format!("interpolate p.csv --grid 10 -o {backend}.csv --backend {backend} --quiet")).ok();
    }
    assert_eq!(scratch.read("sim.csv"), scratch.read("cpu.csv"));
}

#[test]
fn a_full_memory_ends_the_run() {
    let scratch = Scratch::new();
    let rows: String = (0..1025u32).map(|k| format!("insert {} {}\n", k % 33, k / 33)).collect();
    scratch.write("s.txt", &rows);
    let full = "all 1024 places that sim:small can hold have points: delete some, or use a larger device";
    scratch.run("replay s.txt -o none.ele --backend sim?living=yes").fails(7, &["s.txt: row 1025: ", full]);
    assert_eq!(scratch.files(), ["s.txt"]);
    // A deletion makes room.
    scratch.write("s.txt", rows.replacen("insert 4 0", "delete 2\ninsert 4 0", 1));
    assert_eq!(compare(&scratch, "sim?living=yes")["living"], 1024);
}
