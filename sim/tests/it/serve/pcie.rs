//! `incircle-sim serve-pcie`: three files in a directory, a line when they are ready, an end that leaves nothing.

use std::fs::{self, File};
use std::io::{Read, Write};
use std::os::unix::fs::FileExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command};

use super::service::{self, end};
use incircle_protocol::{command_word, Opcode, StreamRegister, MAGIC, PROTOCOL_VERSION};

/// A folder of the test's own, which does not exist yet.
fn folder(name: &str) -> PathBuf {
    std::env::temp_dir().join(format!("incircle-serve-pcie-{name}-{}", std::process::id()))
}

fn program(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = service::program(&["serve-pcie", "--dir"]);
    command.arg(folder).args(arguments);
    command
}

fn start(folder: &Path, arguments: &[&str]) -> (Child, String) {
    service::start(program(folder, arguments))
}

fn register(folder: &Path, register: StreamRegister) -> u32 {
    let mut word = [0; 4];
    File::open(folder.join("xdma0_user")).unwrap().read_exact_at(&mut word, register.offset().into()).unwrap();
    u32::from_le_bytes(word)
}

/// Sends a `Hello` without a driver, as any program may open the files, and returns the answer.
fn greet(folder: &Path, beat_bytes: usize) -> Vec<u32> {
    let mut beat = vec![0; beat_bytes];
    beat[..4].copy_from_slice(&command_word(Opcode::Hello).to_le_bytes());
    File::options().write(true).open(folder.join("xdma0_h2c_0")).unwrap().write_all(&beat).unwrap();
    let mut answer = [0; 4096];
    let read = File::open(folder.join("xdma0_c2h_0")).unwrap().read(&mut answer).unwrap();
    answer[..read].chunks(4).map(|word| u32::from_le_bytes(word.try_into().unwrap())).collect()
}

fn serves(name: &str, signal: &str, arguments: &[&str], beat_bytes: usize) {
    let folder = folder(name);
    let (child, line) = start(&folder, arguments);
    let shown = folder.display();
    assert!(line.starts_with(&format!("ready: {shown} has an incircle card, small")), "{line}");
    assert!(line.trim_end().ends_with(&format!("open pcie:{shown}")), "{line}");
    for _ in 0..2 {
        // A service outlives its clients.
        assert_eq!(register(&folder, StreamRegister::Magic), MAGIC);
        let answer = greet(&folder, beat_bytes);
        assert_eq!(answer[..4], [0x0100_0000, 7, MAGIC, PROTOCOL_VERSION]);
        assert_eq!(answer.len(), (9 * 4_usize).next_multiple_of(beat_bytes) / 4);
    }
    // A client that still has a file open must not keep the program alive.
    let open = File::open(folder.join("xdma0_user")).unwrap();
    let (status, said) = end(child, signal);
    assert_eq!(status.code(), Some(0), "{said}");
    assert!(said.contains("bytes to the card"), "{said}");
    assert_eq!(fs::read_dir(&folder).unwrap().count(), 0, "it is still mounted");
    drop(open);
    fs::remove_dir(folder).unwrap();
}

#[test]
fn a_card_greets_and_ends_on_sigterm() {
    serves("term", "-TERM", &["--fast"], 8);
}

#[test]
fn a_card_at_its_pins_greets_and_ends_on_sigterm() {
    serves("pins", "-TERM", &[], 8);
}

#[test]
fn a_card_of_wide_beats_greets_and_ends_on_sigint() {
    serves("int", "-INT", &["--fast", "--width", "128", "--config", "small"], 16);
}

#[test]
fn a_killed_service_leaves_a_directory_that_the_next_takes_over() {
    let folder = folder("killed");
    let (mut child, _) = start(&folder, &["--fast"]);
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(fs::read_dir(&folder).is_err(), "the file system has died");
    let (child, line) = start(&folder, &["--fast"]);
    assert!(line.starts_with("ready:"), "{line}");
    assert_eq!(end(child, "-TERM").0.code(), Some(0));
    fs::remove_dir(folder).unwrap();
}

#[test]
fn what_cannot_be_used_is_refused() {
    let folder = folder("refused");
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("mine"), "").unwrap();
    for (path, sentence) in [(folder.clone(), "name an empty directory"), (folder.join("mine"), "cannot be used")] {
        let output = program(&path, &["--fast"]).output().unwrap();
        assert_eq!(output.status.code(), Some(1));
        assert!(output.stdout.is_empty());
        let said = String::from_utf8(output.stderr).unwrap();
        assert!(said.contains(sentence), "{said}");
    }
    let output = program(&folder, &["--fault", "gremlin=1"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(said.contains("choose from short-read"), "{said}");
    fs::remove_dir_all(folder).unwrap();
}
