//! Checks that the tables of `cycles.md` hold what the model counts. `INCIRCLE_BLESS=1` renews all of them.

use std::path::{Path, PathBuf};

use incircle_protocol::Counter;
use incircle_testbench::cycles::{document, measure, ROWS};

fn file() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("cycles.md")
}

/// The document in the repository.
fn held() -> String {
    std::fs::read_to_string(file()).unwrap_or_else(|error| panic!("{}: {error}", file().display()))
}

/// Counts every table, the largest sizes included: more than a hundred million clocks of the model, half a minute on
/// two cores.
#[test]
fn all_tables_are_up_to_date() {
    let counted = document().unwrap();
    if std::env::var_os("INCIRCLE_BLESS").is_some() {
        std::fs::write(file(), counted).unwrap();
        panic!("blessed: {} is renewed and nothing was compared; run again without INCIRCLE_BLESS", file().display());
    }
    let held = held();
    let differs = counted.lines().zip(held.lines()).find(|(counted, held)| counted != held);
    assert!(
        counted == held,
        "cycles.md differs ({differs:?}, counted and held): \
         run `cargo run --release -p incircle-testbench --bin cycles`"
    );
}

#[test]
fn the_same_job_takes_the_same_cycles() {
    let once = measure(ROWS[0], 1000, 8).unwrap();
    assert_eq!(once, measure(ROWS[0], 1000, 8).unwrap());
    assert_eq!(once.of(Counter::Insertions), 1000);
}
