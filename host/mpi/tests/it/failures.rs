//! A run that fails says one sentence, ends all processes, and leaves no folder that looks complete.

use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use crate::{sentences, Scratch};

/// Asserts that a run on three processes fails with this exit code and one sentence, and leaves no mesh.
#[track_caller]
fn refused(scratch: &Scratch, arguments: &str, code: i32, part: &str) -> Output {
    let before = scratch.names();
    let output = scratch.run(3, arguments);
    let said = sentences(&output);
    assert_eq!(output.status.code(), Some(code), "{arguments}: {output:?}");
    assert!(said.len() == 1 && said[0].contains(part), "{arguments}: {output:?}");
    assert_eq!(scratch.names(), before, "{arguments}");
    output
}

#[test]
fn inputs_that_cannot_be_read_are_named() {
    let scratch = Scratch::new();
    scratch.incircle("generate uniform -n 500 -o @p.npy");
    refused(&scratch, "triangulate p.npy absent.npy -o mesh", 3, "absent.npy: ");
    std::fs::write(scratch.path("text.npy"), "x,y\n1,2\n").expect("a file");
    refused(&scratch, "triangulate text.npy p.npy -o mesh", 3, "text.npy: not an array of NumPy");
    let whole = std::fs::read(scratch.path("p.npy")).expect("the points");
    std::fs::write(scratch.path("cut.npy"), &whole[..whole.len() - 5]).expect("a file");
    refused(&scratch, "triangulate p.npy cut.npy -o mesh", 3, "cut.npy: ");
    refused(&scratch, "triangulate p.csv -o mesh", 2, "p.csv: only .npy files");
    let doubles: Vec<u8> = [0.1, 0.0, 0.2, 7.0].iter().flat_map(|value: &f64| value.to_le_bytes()).collect();
    scratch.array("tenths.npy", "<f8", 2, &doubles);
    refused(&scratch, "triangulate p.npy tenths.npy -o mesh", 3, "tenths.npy: the points lie on no common lattice");
    scratch.integers("low.npy", &[[-1 << 40, 0]]);
    refused(&scratch, "triangulate p.npy low.npy -o mesh", 3, "41 bits");
}

#[test]
fn folders_that_cannot_be_made_are_named() {
    let scratch = Scratch::new();
    scratch.incircle("generate uniform -n 500 -o @p.npy");
    refused(&scratch, "triangulate p.npy -o no/such/mesh", 3, "no/such/mesh cannot be made: ");
    refused(&scratch, "triangulate p.npy -o p.npy", 3, "p.npy is there already");
    refused(&scratch, "triangulate p.npy -o ..", 2, ".. is no name for a folder");
    std::fs::create_dir_all(scratch.path("full/inside")).expect("a folder");
    refused(&scratch, "triangulate p.npy -o full", 3, "full is there already");
    std::fs::create_dir(scratch.path("mesh")).expect("a folder");
    assert!(scratch.run(2, "triangulate p.npy -o mesh/ -q").status.success(), "an empty folder is taken");
    assert_eq!(scratch.names(), ["full", "mesh", "p.npy"]);
}

#[test]
fn wrong_arguments_are_refused_once() {
    let scratch = Scratch::new();
    let output = scratch.run(3, "triangulate -o mesh");
    assert_eq!(output.status.code(), Some(2), "{output:?}");
    assert_eq!(String::from_utf8_lossy(&output.stderr).matches("Usage:").count(), 1, "{output:?}");
    let output = scratch.run(3, "--help");
    assert!(output.status.success() && String::from_utf8_lossy(&output.stdout).matches("Usage:").count() == 1);
}

/// The processes that a process has started.
fn children(process: u32) -> Vec<u32> {
    let list = std::fs::read_to_string(format!("/proc/{process}/task/{process}/children")).unwrap_or_default();
    list.split_whitespace().filter_map(|number| number.parse().ok()).collect()
}

/// Waits for the end of a run, at most 30 seconds.
fn ended(run: &mut Child) -> Option<i32> {
    let since = Instant::now();
    while since.elapsed() < Duration::from_secs(30) {
        if let Some(status) = run.try_wait().expect("a run") {
            return Some(status.code().unwrap_or(-1));
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    let _ = run.kill();
    None
}

#[test]
#[cfg(target_os = "linux")]
fn a_process_that_is_killed_ends_all_others() {
    let scratch = Scratch::new();
    scratch.incircle("generate uniform -n 3000000 --bits 31 -o @p.npy");
    for victim in [0, 2] {
        let mut command = scratch.command(4, "triangulate p.npy -o mesh -q");
        let mut run = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("mpirun is installed");
        let since = Instant::now();
        // The folder under its working name says that all processes have begun.
        while !scratch.names().iter().any(|name| name.starts_with(".mesh.")) {
            assert!(since.elapsed() < Duration::from_secs(30), "the run does not begin");
            std::thread::sleep(Duration::from_millis(5));
        }
        let ranks = children(run.id());
        assert_eq!(ranks.len(), 4, "mpirun starts the processes itself");
        let killed = Command::new("kill").args(["-9", &ranks[victim].to_string()]).status().expect("kill");
        assert!(killed.success());
        let code = ended(&mut run);
        assert!(code.is_some_and(|code| code != 0), "rank {victim}: {code:?}");
        assert!(!scratch.path("mesh").exists(), "rank {victim}");
        // The launcher may end a moment before the processes that it has ended.
        let since = Instant::now();
        while ranks.iter().any(|rank| is_alive(*rank)) {
            assert!(since.elapsed() < Duration::from_secs(30), "rank {victim}: others live on");
            std::thread::sleep(Duration::from_millis(20));
        }
        scratch.names().iter().filter(|name| name.starts_with('.')).for_each(|name| {
            std::fs::remove_dir_all(scratch.path(name)).expect("the rest of the run");
        });
    }
}

/// Whether a process is there and is no zombie.
fn is_alive(process: u32) -> bool {
    let stat = std::fs::read_to_string(format!("/proc/{process}/stat")).unwrap_or_default();
    stat.rsplit(") ").next().is_some_and(|rest| !rest.is_empty() && !rest.starts_with(['Z', 'X']))
}
