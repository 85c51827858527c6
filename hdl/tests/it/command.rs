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
        ("--config small --living --top stream", 1, "a core with runs has no link but the serial one"),
        ("--config small --living --top udp", 1, "choose that one, or the core alone"),
        ("--config dual --living --top serial", 1, "cannot have 2 engines: choose a configuration of one"),
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
fn options_of_a_link_need_a_core() {
    for option in ["--width=128", "--clock-hz=128", "--fifo-bytes=128", "--living"] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_incircle-hdl"));
        let output = command.args(["export", option]).output().expect("the command starts");
        assert_eq!(output.status.code(), Some(2), "{option}: {output:?}");
    }
}
