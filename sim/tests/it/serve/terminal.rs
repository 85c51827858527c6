//! The program `incircle-sim`: a terminal behind a link, a line when it is ready, an end that leaves nothing.

use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::{Child, Command};
use std::time::{Duration, Instant};

use super::service::{self, end};
use incircle_model::serial::{FromDevice, FromHost};
use incircle_protocol::{DeviceFrame, Greeting, HostFrame, RunKind};

/// A folder of the test's own.
fn folder(name: &str) -> PathBuf {
    let folder = std::env::temp_dir().join(format!("incircle-serve-{name}-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    folder
}

fn program(link: &Path, arguments: &[&str]) -> Command {
    let mut command = service::program(&["serve", "--link"]);
    command.arg(link).args(arguments);
    command
}

fn start(link: &Path, arguments: &[&str]) -> (Child, String) {
    service::start(program(link, arguments))
}

/// Sends a `Hello` without a driver, as any program may open the terminal, and returns the answer.
fn greet(link: &Path) -> FromDevice {
    let mut port = fs::OpenOptions::new().read(true).write(true).open(link).unwrap();
    let hello = FromHost { session: 0, kind: HostFrame::Hello, number: 0, payload: vec![] };
    port.write_all(&hello.to_line()).unwrap();
    let mut line = Vec::new();
    BufReader::new(port).read_until(0, &mut line).unwrap();
    FromDevice::from_line(&line[..line.len() - 1]).expect("a frame")
}

fn serves(name: &str, signal: &str, arguments: &[&str]) {
    let folder = folder(name);
    let link = folder.join("board");
    let (child, line) = start(&link, arguments);
    assert!(line.starts_with(&format!("ready: {} is an incircle board, small, 125 MHz", link.display())), "{line}");
    assert!(line.contains(&format!("open serial:{}?slow=", link.display())), "{line}");
    for _ in 0..2 {
        // A service outlives its clients.
        assert_eq!(greet(&link).kind, DeviceFrame::Hello);
    }
    let (status, said) = end(child, signal);
    assert_eq!(status.code(), Some(0), "{said}");
    assert!(said.contains("times slower than real"), "{said}");
    assert!(fs::symlink_metadata(&link).is_err(), "the link is left");
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_quick_board_greets_and_ends_on_sigterm() {
    serves("quick", "-TERM", &["--fast", "--slow", "4"]);
}

#[test]
fn a_quick_board_with_runs_says_so_in_its_greeting() {
    let folder = folder("living");
    let link = folder.join("board");
    let (child, line) = start(&link, &["--fast", "--living"]);
    assert!(line.contains("simulated with runs and without the bits of its line"), "{line}");
    let body: Vec<u32> =
        greet(&link).body.chunks(4).map(|word| u32::from_le_bytes([word[0], word[1], word[2], word[3]])).collect();
    let greeting = Greeting::from_words(body.try_into().expect("the words of a greeting"));
    assert!(greeting.identity.takes(RunKind::InsertAs) && greeting.identity.takes(RunKind::Delete));
    end(child, "-TERM");
    let refused = program(&link, &["--living", "--config", "full"]).output().unwrap();
    let said = String::from_utf8_lossy(&refused.stderr);
    assert!(refused.status.code() == Some(1) && said.contains("\"full\" with runs: choose small, or"), "{said}");
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn a_board_at_its_pins_greets_and_ends_on_sigint() {
    serves("pins", "-INT", &["--config", "small"]);
}

#[test]
fn a_killed_service_leaves_a_link_that_the_next_replaces() {
    let folder = folder("killed");
    let link = folder.join("board");
    let (mut child, _) = start(&link, &["--fast"]);
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(fs::symlink_metadata(&link).is_ok());
    let (child, line) = start(&link, &["--fast"]);
    assert!(line.starts_with("ready:"), "{line}");
    let second = program(&link, &["--fast"]).output().unwrap();
    assert_eq!(second.status.code(), Some(1));
    let said = String::from_utf8(second.stderr).unwrap();
    assert!(said.contains("leads to a pseudo-terminal that is in use"), "{said}");
    assert_eq!(end(child, "-TERM").0.code(), Some(0));
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn what_is_not_its_own_is_not_replaced() {
    let folder = folder("foreign");
    let link = folder.join("board");
    fs::write(&link, "mine").unwrap();
    let refused = |sentence: &str| {
        let output = program(&link, &["--fast"]).output().unwrap();
        assert_eq!(output.status.code(), Some(1));
        assert!(output.stdout.is_empty());
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(said.contains(sentence), "{said}");
    };
    refused("is not a symbolic link");
    fs::remove_file(&link).unwrap();
    symlink("/dev/null", &link).unwrap();
    refused("does not lead to a pseudo-terminal");
    fs::remove_dir_all(folder).unwrap();
}

#[test]
fn faults_that_do_not_exist_are_refused() {
    let output = program(Path::new("unused"), &["--fault", "gremlin=1"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("choose from ber, drop, double"), "{said}");
    assert!(!Path::new("unused").exists());
}

/// Time that the process has spent on a processor, in hundredths of a second.
fn ticks(child: &Child) -> u64 {
    let stat = fs::read_to_string(format!("/proc/{}/stat", child.id())).unwrap();
    let fields: Vec<_> = stat.rsplit_once(')').unwrap().1.split_whitespace().collect();
    fields[11].parse::<u64>().unwrap() + fields[12].parse::<u64>().unwrap()
}

#[test]
fn a_board_at_rest_takes_no_time_of_the_processor() {
    let folder = folder("rest");
    let link = folder.join("board");
    let (child, _) = start(&link, &["--fast", "--slow", "1"]);
    greet(&link);
    // The board rests when the line has been silent for long enough.
    let since = Instant::now();
    loop {
        let (before, begun) = (ticks(&child), Instant::now());
        std::thread::sleep(Duration::from_secs(1));
        let share = (ticks(&child) - before) as f64 / 100.0 / begun.elapsed().as_secs_f64();
        if share < 0.05 {
            break;
        }
        assert!(since.elapsed() < Duration::from_secs(60), "the board still takes {share:.2} of a processor");
    }
    assert_eq!(greet(&link).kind, DeviceFrame::Hello);
    end(child, "-TERM");
    fs::remove_dir_all(folder).unwrap();
}
