//! The command `incircle-hdl export` makes cores and chips of the user's own size, and refuses others with a sentence.

use std::path::PathBuf;
use std::process::{Command, Output};

/// Runs `incircle-hdl export` with these arguments and a file of this name.
fn export(arguments: &str, name: &str) -> (Output, PathBuf) {
    let file = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    // A file of an earlier run would pass for one of this run.
    let _ = std::fs::remove_file(&file);
    let mut command = Command::new(env!("CARGO_BIN_EXE_incircle-hdl"));
    let output = command.arg("export").args(arguments.split(' ')).arg("--out").arg(&file).output();
    (output.expect("the command starts"), file)
}

#[test]
fn cores_and_chips_of_other_sizes_are_exported() {
    for (place, (arguments, modules)) in [
        ("--points 64 --contexts 3", &["module incircle_core ("][..]),
        ("--points 64 --contexts 3 --ring 8 --probe", &["module incircle_core (", "write_valid"]),
        (
            "--points 64 --contexts 3 --living --top serial",
            &["incircle core with runs behind a serial link", "module incircle_serial_top (", "$questions"],
        ),
        (
            "--points 64 --contexts 3 --living --top stream --width 128",
            &["incircle core with runs behind a stream link", "module incircle_stream_top (", "$questions"],
        ),
        (
            "--points 64 --contexts 3 --living --top udp --rgmii-delay gmii",
            &["incircle core with runs behind a UDP link", "module incircle_udp_top (", "$questions", "rx_data"],
        ),
        (
            "--points 64 --contexts 3 --living --top udp --probe",
            &["module incircle_udp_top_rgmii_in", "write_valid", "$questions", "rx_ctl"],
        ),
        ("--points 64 --contexts 3 --living", &["incircle core with runs", "module incircle_core (", "$questions"]),
        ("--points 16 --contexts 2 --engines 2", &["module incircle_core (", "$router", "$slot1"]),
        ("--points 16 --contexts 2 --engines 4 --top stream", &["module incircle_stream_top (", "$slot3"]),
    ]
    .into_iter()
    .enumerate()
    {
        let (output, file) = export(arguments, &format!("own_size_{place}.v"));
        assert!(output.status.success(), "{arguments}: {output:?}");
        let verilog = std::fs::read_to_string(file).expect("the file is there");
        for piece in modules {
            assert!(verilog.contains(piece), "{arguments}: no {piece}");
        }
    }
}

#[test]
fn sizes_that_cannot_be_built_leave_a_sentence_and_no_file() {
    for (arguments, code, sentence) in [
        ("--points 1000 --contexts 3", 1, "a core cannot hold 1000 points: choose a power of two from 4 to 16384"),
        ("--points 32768 --contexts 3", 1, "a core cannot hold 32768 points"),
        ("--points 64 --contexts 25", 1, "a core cannot have 25 contexts: choose a number from 1 to 24"),
        ("--points 64 --contexts 3 --engines 3", 1, "a chip cannot have 3 engines: choose 1, 2 or 4"),
        ("--points 64 --contexts 3 --ring 65", 1, "a boundary list cannot hold 65 edges"),
        ("--config dual --living", 1, "cannot have 2 engines: choose a configuration of one"),
        ("--config dual --living --top serial", 1, "cannot have 2 engines: choose a configuration of one"),
        ("--config dual --living --top udp", 1, "cannot have 2 engines: choose a configuration of one"),
        ("--points 64", 2, "--contexts"),
        ("--config full --engines 2", 2, "--config"),
        ("--config full --contexts 2 --engines 4", 2, "--config"),
    ] {
        let (output, file) = export(arguments, "refused.v");
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{arguments}: {told}");
        assert!(told.contains(sentence), "{arguments}: {told}");
        assert!(!file.exists(), "{arguments}");
    }
}

#[test]
fn options_of_another_module_are_refused() {
    let stream = |top: &str| format!("--config tiny {top}--width 128");
    for (arguments, sentence) in [
        (stream(""), "--width is for --top stream: choose it, or leave out --width"),
        (stream("--top serial "), "--width is for --top stream: choose it, or leave out --width"),
        (
            "--config dual --clock-hz 5".to_owned(),
            "--clock-hz is for --top serial and --top udp: choose one of them, or",
        ),
        ("--config tiny --top stream --fifo-bytes 4096".to_owned(), "--fifo-bytes is for --top serial and --top udp: "),
        ("--config tiny --ip 1.2.3.4/8".to_owned(), "--ip is for --top udp: choose it, or leave out --ip"),
        ("--config tiny --top serial --mac 02:00:00:00:00:07".to_owned(), "--mac is for --top udp: "),
        ("--config tiny --udp-port 7".to_owned(), "--udp-port is for --top udp: "),
        ("--config tiny --rgmii-delay 0".to_owned(), "--rgmii-delay is for --top udp: "),
        ("--config tiny --top stream --rgmii-clock-delay 3".to_owned(), "--rgmii-clock-delay is for --top udp: "),
        (
            "--config tiny --top udp --rgmii-delay gmii --rgmii-clock-delay 3".to_owned(),
            "--rgmii-clock-delay is for the pins of RGMII, and --rgmii-delay gmii makes those of GMII",
        ),
    ] {
        let (output, file) = export(&arguments, "another_module.v");
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments}: {told}");
        assert!(told.starts_with("incircle-hdl: ") && told.contains(sentence), "{arguments}: {told}");
        assert_eq!(told.lines().count(), 1, "{arguments}: {told}");
        assert!(!file.exists(), "{arguments}");
    }
}

#[test]
fn what_is_no_number_is_refused_with_the_bounds() {
    for (arguments, sentence) in [
        ("--points 4294967296 --contexts 3", "write a whole number from 4 to 16384"),
        ("--points abc --contexts 3", "write a whole number from 4 to 16384"),
        ("--points 64 --contexts -1", "write a whole number from 1 to 24"),
        ("--points 64 --contexts 3 --engines -1", "write a whole number from 1 to 4"),
        ("--points 64 --contexts 3 --ring 1e1", "write a whole number from 3 to 64"),
        ("--config tiny --top serial --fifo-bytes 4k", "write a whole number from 2048 to 32768"),
        ("--config tiny --top serial --clock-hz -125000000", "write a whole number from 921600 to 500000000"),
        ("--config tiny --top stream --width -64", "a beat of a stream has 64 or 128 bits"),
        ("--config tiny --top udp --udp-port 65536", "write a whole number from 1 to 65535"),
        ("--config tiny --top udp --rgmii-clock-delay 128", "write a number of taps from 0 to 127"),
        ("--config tiny --top udp --rgmii-delay -1", "write a number of taps from 0 to 127, or gmii"),
    ] {
        let (output, file) = export(arguments, "no_number.v");
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments}: {told}");
        assert!(told.contains(sentence), "{arguments}: {told}");
        assert!(!file.exists(), "{arguments}");
    }
}

#[test]
fn options_of_a_link_need_a_core() {
    for option in ["--width=128", "--clock-hz=128", "--fifo-bytes=128", "--living"] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_incircle-hdl"));
        let output = command.args(["export", option]).output().expect("the command starts");
        assert_eq!(output.status.code(), Some(2), "{option}: {output:?}");
    }
}
