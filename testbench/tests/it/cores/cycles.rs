//! The tables of `cycles.md` are what the model counts. `INCIRCLE_BLESS=1` renews all of them.

use std::path::{Path, PathBuf};

use incircle_protocol::Counter;
use incircle_testbench::cycles::{block, document, earlier, measure, BLOCKS, ROWS};

fn file() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("cycles.md")
}

/// The document as it stands.
fn held() -> String {
    std::fs::read_to_string(file()).unwrap_or_else(|error| panic!("{}: {error}", file().display()))
}

#[test]
fn small_tables_are_up_to_date() {
    if std::env::var_os("INCIRCLE_BLESS").is_some() {
        std::fs::write(file(), document().unwrap()).unwrap();
    }
    let held = held();
    for text in [block(BLOCKS[0]).unwrap(), block(BLOCKS[1]).unwrap(), earlier().unwrap()] {
        let missing = text.lines().find(|line| !held.lines().any(|held| held == *line));
        assert!(
            held.contains(&text),
            "cycles.md does not have {missing:?}: run `cargo run --release -p incircle-testbench --bin cycles`"
        );
    }
}

#[test]
fn the_same_job_takes_the_same_cycles() {
    let once = measure(ROWS[0], 1000, 8).unwrap();
    assert_eq!(once, measure(ROWS[0], 1000, 8).unwrap());
    assert_eq!(once.of(Counter::Insertions), 1000);
}
