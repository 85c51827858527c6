//! Goes from the source to a bitstream with stand-ins for the tools: which clock is chosen, which seed is packed, and
//! which failures end without a bitstream. With the real tools `./check` makes a tiny core.

use incircle_hdl::board::{Attempt, Report, Seed, Summary};
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// An empty folder for one test.
fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("board_flow").join(name);
    if folder.exists() {
        std::fs::remove_dir_all(&folder).unwrap();
    }
    folder
}

/// Runs `board colorlight-i5` with a tiny core and more options. `fmax` lists the clocks that the seeds reach, in their
/// order; `fault` names the fault of a tool.
fn build(out: &Path, options: &[&str], fmax: &str, fault: &str) -> Output {
    let stand_ins = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join("stand_ins");
    let path = std::env::var("PATH").unwrap_or_default();
    Command::new(env!("CARGO_BIN_EXE_incircle-hdl"))
        .args(["board", "colorlight-i5", "--config", "tiny", "--system", "--out"])
        .arg(out)
        .args(options)
        .env("PATH", format!("{}:{path}", stand_ins.display()))
        .envs([("FMAX", fmax), ("FAULT", fault)])
        .output()
        .unwrap()
}

/// Runs it to a report and a bitstream.
fn make(out: &Path, options: &[&str], fmax: &str) -> (Report, String) {
    let output = build(out, options, fmax, "");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(out.join("colorlight-i5.bit").exists());
    (report(out), String::from_utf8_lossy(&output.stdout).into_owned())
}

/// What a failure says, which is one sentence.
fn refusal(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(1), "{}", String::from_utf8_lossy(&output.stdout));
    let said = String::from_utf8_lossy(&output.stderr);
    said.lines().filter_map(|line| line.strip_prefix("incircle-hdl: ")).collect::<Vec<_>>().join("\n")
}

fn report(out: &Path) -> Report {
    Report::read(&out.join("report.json")).unwrap()
}

#[test]
fn the_fastest_seed_is_packed_if_the_median_meets_the_clock() {
    let out = folder("met");
    let (report, said) = make(&out, &[], "119.0 127.5 121.0");
    assert!(report.met && report.missed.is_empty());
    assert_eq!((report.clock_mhz, report.picked_seed), (120, Some(2)));
    assert_eq!(report.seeds[0], Seed { seed: 1, fmax_mhz: 119.0, port_fmax_mhz: None });
    assert_eq!(report.fmax_mhz, Summary { min: 119.0, median: 121.0, max: 127.5 });
    let bitstream = report.bitstream.unwrap();
    let bytes = std::fs::read(out.join(&bitstream.file)).unwrap();
    assert_eq!(bytes, b"seed 2\n");
    let sum: String = Sha256::digest(&bytes).iter().map(|byte| format!("{byte:02x}")).collect();
    assert_eq!((bitstream.bytes, &bitstream.sha256), (7, &sum));
    assert!(said.contains(&sum), "{said}");
}

#[test]
fn a_clock_that_was_asked_for_and_is_missed_is_a_failure() {
    let out = folder("missed");
    let said = refusal(&build(&out, &["--clock", "125"], "124.9 130.0 118.0", ""));
    assert!(said.contains("does not meet 125 MHz: the median of 3 seeds reaches 124.9 MHz"), "{said}");
    assert!(said.ends_with("--clock 120 is within reach"), "{said}");
    let report = report(&out);
    assert!(!report.met && report.missed.is_empty());
    assert_eq!((report.clock_mhz, report.picked_seed, &report.bitstream), (125, None, &None));
    assert!(!out.join("colorlight-i5.bit").exists());
}

#[test]
fn without_a_clock_a_lower_one_is_tried() {
    let fmax_mhz = Summary { min: 104.0, median: 111.0, max: 121.0 };
    refusal(&build(&folder("usual"), &["--clock", "usual"], "104.0 111.0 121.0", ""));
    for (options, missed) in [(&[][..], 120), (&["--clock", "largest"], 150)] {
        let out = folder(&format!("lower-{missed}"));
        let (report, _) = make(&out, options, "104.0 111.0 121.0");
        assert_eq!((report.clock_mhz, report.picked_seed), (110, Some(3)));
        assert_eq!(report.missed, [Attempt { clock_mhz: missed, fmax_mhz }]);
        for clock in [missed, 110] {
            let placed = out.join("work").join(format!("{clock}-mhz")).join("placed.txt");
            let expected = [1, 2, 3].map(|seed| format!("clock {clock}, seed {seed}\n"));
            assert_eq!(std::fs::read_to_string(placed).unwrap(), expected.concat());
        }
    }
}

#[test]
fn a_port_has_a_usual_clock_of_its_own() {
    let out = folder("port");
    let output = build(&out, &["--link", "udp", "--clock", "usual"], "106.0 107.0 108.0", "");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(out.join("colorlight-i5-udp.bit").exists());
    let report = report(&out);
    assert_eq!((report.clock_mhz, report.met), (105, true));
}

#[test]
fn the_lowest_clock_of_the_board_is_the_last() {
    let out = folder("lowest");
    let said = refusal(&build(&out, &["--seeds", "1"], "49.0", ""));
    assert!(said.contains("does not meet 120 MHz: the median of 1 seed reaches 49.0 MHz"), "{said}");
    assert!(said.ends_with("no clock of the board is within reach"), "{said}");
    assert!(!report(&out).met);
}

#[test]
fn whatever_a_tool_does_wrong_ends_without_a_bitstream() {
    let faults = [
        ("synthesis-fails", "yosys ends with exit status: 1"),
        ("synthesis-warns", "yosys warns, see "),
        ("placer-fails", "nextpnr-ecp5 ends with exit status: 1"),
        ("wrong-clock", "the clock is to be 120 MHz, and is 125 MHz"),
        ("packer-fails", "ecppack ends with exit status: 1"),
        ("packs-nothing", "it is empty"),
        ("places-nothing", "seed-1.config: No such file"),
        ("no-measurement", "which is no measurement"),
        ("more-than-there-is", "it does not say what is used"),
    ];
    for (fault, sentence) in faults {
        let out = folder(fault);
        let said = refusal(&build(&out, &["--seeds", "1"], "130.0", fault));
        assert!(said.contains(sentence), "{fault}: {said}");
        assert!(!out.join("colorlight-i5.bit").exists() && !out.join("report.json").exists(), "{fault}");
    }
}

#[test]
fn a_bitstream_of_an_earlier_run_does_not_outlive_a_failure() {
    let out = folder("earlier");
    make(&out, &["--seeds", "1"], "130.0");
    refusal(&build(&out, &["--seeds", "1", "--clock", "140"], "130.0", ""));
    assert!(!report(&out).met && !out.join("colorlight-i5.bit").exists());
    make(&out, &["--seeds", "1"], "130.0");
    refusal(&build(&out, &["--seeds", "1"], "130.0", "packer-fails"));
    assert!(!out.join("report.json").exists() && !out.join("colorlight-i5.bit").exists());
}

#[test]
fn a_run_that_was_stopped_goes_on_where_it_ended() {
    let out = folder("resumed");
    let placed = |clock: u32| std::fs::read_to_string(out.join("work").join(format!("{clock}-mhz")).join("placed.txt"));
    refusal(&build(&out, &[], "121.0 122.0 123.0", "placer-fails-3"));
    assert_eq!(placed(120).unwrap(), "clock 120, seed 1\nclock 120, seed 2\n");
    let output = build(&out, &[], "0 0 119.0", "");
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(said.contains("seed 2 reaches 122.0 MHz, as an earlier run found\n"), "{said}");
    assert_eq!(placed(120).unwrap(), "clock 120, seed 3\n");
    let first = report(&out);
    assert_eq!(first.seeds.iter().map(|seed| seed.fmax_mhz).collect::<Vec<_>>(), [121.0, 122.0, 119.0]);
    // With all steps kept no tool but the packer runs, and the result is the same.
    make(&out, &[], "0 0 0");
    assert!(placed(120).is_err());
    assert_eq!(report(&out), first);
    // Another clock is another design.
    make(&out, &["--clock", "110"], "131.0 132.0 133.0");
    assert_eq!(placed(110).unwrap().lines().count(), 3);
    make(&out, &[], "141.0 142.0 143.0");
    assert_eq!(placed(120).unwrap().lines().count(), 3, "only the last run is kept");
}

#[test]
fn a_folder_of_somebody_else_is_left_alone() {
    let out = folder("foreign");
    std::fs::create_dir_all(out.join("work")).unwrap();
    std::fs::write(out.join("work").join("thesis.tex"), "years").unwrap();
    let said = refusal(&build(&out, &["--seeds", "1"], "130.0", ""));
    assert!(said.contains("work is not of this command, which would empty it"), "{said}");
    assert_eq!(std::fs::read_to_string(out.join("work").join("thesis.tex")).unwrap(), "years");
}

#[test]
fn two_runs_do_not_share_a_folder() {
    let out = folder("shared");
    make(&out, &["--seeds", "1"], "130.0");
    let lock = std::fs::File::open(out.join("work").join(".incircle-board")).unwrap();
    lock.lock().unwrap();
    let said = refusal(&build(&out, &["--seeds", "1"], "130.0", ""));
    assert!(said.contains("another run works in "), "{said}");
    assert!(report(&out).met && out.join("colorlight-i5.bit").exists());
}

#[cfg(target_os = "linux")]
#[test]
fn what_is_no_plain_file_is_written_to_as_it_is() {
    let out = folder("export");
    std::fs::create_dir_all(&out).unwrap();
    std::os::unix::fs::symlink("target.v", out.join("link.v")).unwrap();
    std::fs::write(out.join("target.v"), "old").unwrap();
    let export = |path: &Path| {
        let arguments = ["export", "--config", "tiny", "--out"];
        Command::new(env!("CARGO_BIN_EXE_incircle-hdl")).args(arguments).arg(path).output().unwrap()
    };
    assert!(export(&out.join("link.v")).status.success());
    assert!(out.join("link.v").is_symlink());
    assert!(std::fs::read_to_string(out.join("target.v")).unwrap().starts_with("// incircle core"));
    assert!(export(Path::new("/dev/null")).status.success() && !Path::new("/dev/null").is_file());
    let full = export(Path::new("/dev/full"));
    assert!(!Path::new("/dev/full").is_file());
    assert!(refusal(&full).contains("cannot write /dev/full"), "{full:?}");
}

#[test]
fn a_clock_that_is_none_is_refused() {
    let out = folder("none");
    for clock in ["149", "45", "400", "4295"] {
        let said = refusal(&build(&out, &["--clock", clock], "130.0", ""));
        let sentence = format!("colorlight-i5 has no clock of {clock} MHz: choose a multiple of 5 from 50 to 150");
        assert!(said.contains(&sentence), "{said}");
    }
    let unknown = build(&out, &["--clock", "fast"], "130.0", "");
    assert_eq!(unknown.status.code(), Some(2));
    assert!(!out.exists());
}
