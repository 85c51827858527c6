//! The tables of `cycles.md`.

use std::fmt::Write;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::Mutex;

use incircle_protocol::Counter;
use incircle_testkit::Distribution;

use super::airports::thinned_airports;
use super::{measure, measure_points, Counters, MeasureError};

/// The sets, a row each.
pub const ROWS: [Distribution; 11] = [
    Distribution::Uniform,
    Distribution::Normal,
    Distribution::Kuzmin,
    Distribution::Line,
    Distribution::Checkers,
    Distribution::Lattice,
    Distribution::Circle,
    Distribution::Clusters,
    Distribution::Parabola,
    Distribution::TwoChains,
    Distribution::Spiral,
];

/// Numbers of contexts, a column each.
pub const COLUMNS: [u32; 5] = [1, 4, 8, 16, 24];

/// Numbers of points, a table each.
pub const BLOCKS: [usize; 4] = [1024, 4096, 8192, 16_384];

/// The contexts whose limit stands beside each row, and whose time is given.
const CONTEXTS: u32 = 16;

/// Numbers of points that were published for the one earlier triangulator in an FPGA.
const EARLIER: [usize; 4] = [477, 953, 1906, 3811];

/// The clock that times are given for, in MHz.
const CLOCK: f64 = 125.0;

/// Cycles per insertion below which no schedule of these visits and writes comes: each memory has one port of a kind.
pub fn limit(counters: &Counters) -> f64 {
    counters.per_insertion(Counter::IssueCycles).max(counters.per_insertion(Counter::WriteCycles))
}

/// One row of a table for `n` points.
///
/// # Errors
/// As [`measure`].
pub fn row(distribution: Distribution, n: usize) -> Result<String, MeasureError> {
    let mut cells = String::new();
    let (mut points, mut least) = (0, 0.0);
    for contexts in COLUMNS {
        let counters = measure(distribution, n, contexts)?;
        points = counters.of(Counter::Insertions);
        if contexts == CONTEXTS {
            least = limit(&counters);
        }
        cells += &format!(" {:.2} |", counters.per_insertion(Counter::InsertCycles));
    }
    Ok(format!("| {distribution} | {points} |{cells} {least:.2} |\n"))
}

/// The table for `n` points, with its heading.
///
/// # Errors
/// As [`measure`].
pub fn block(n: usize) -> Result<String, MeasureError> {
    let rows = in_parallel(&ROWS, |&distribution| row(distribution, n))?;
    let columns: String = COLUMNS.iter().map(|contexts| format!(" K = {contexts} |")).collect();
    let rule = "---:|".repeat(COLUMNS.len() + 2);
    let heading = format!("## {n} points\n\n| set | distinct |{columns} limit, K = {CONTEXTS} |\n|---|{rule}\n");
    Ok(heading + &rows.concat())
}

/// The table for the sizes of the earlier paper.
///
/// # Errors
/// As [`measure`].
pub fn earlier() -> Result<String, MeasureError> {
    let mut text = format!(
        "## Sizes of the earlier triangulator in an FPGA\n\n| points | uniform, cycles | µs at {CLOCK} MHz | airports, cycles | \
         µs at {CLOCK} MHz |\n|---:|---:|---:|---:|---:|\n"
    );
    for n in EARLIER {
        let uniform = measure(Distribution::Uniform, n, CONTEXTS)?.of(Counter::InsertCycles);
        let airports = measure_points(&thinned_airports(n)?, CONTEXTS)?.of(Counter::InsertCycles);
        let time = |cycles: u64| cycles as f64 / CLOCK;
        // Writing to a string cannot fail.
        let _ = writeln!(text, "| {n} | {uniform} | {:.1} | {airports} | {:.1} |", time(uniform), time(airports));
    }
    Ok(text)
}

/// The whole of `cycles.md`.
///
/// # Errors
/// As [`measure`].
pub fn document() -> Result<String, MeasureError> {
    let mut parts = vec![INTRODUCTION.to_string()];
    for n in BLOCKS {
        parts.push(block(n)?);
    }
    parts.push(earlier()?);
    Ok(parts.join("\n"))
}

const INTRODUCTION: &str = "\
# Cycles per insertion

Counted on the model by clock, and exact: the same on every machine. Renewed by

    cargo run --release -p incircle-testbench --bin cycles

`tests/it/cores/cycles.rs` counts all of it again and compares. The sets are those of `incircle generate` with 16 bits and seed 1, duplicates
removed first, in the order of the host. K contexts, each with a boundary list of 32 edges; capacity the next power of two.
A cell is the counter `InsertCycles` by the points inserted: from the first point accepted to the last lock released, reading out
not included. The limit is what the counted accesses alone take: one visit and one write a clock, so the larger of
`IssueCycles` and `WriteCycles` by the points.
";

/// The results of all items in their order, worked out on all processors.
fn in_parallel<T: Sync, R: Send>(
    items: &[T],
    work: impl Fn(&T) -> Result<R, MeasureError> + Sync,
) -> Result<Vec<R>, MeasureError> {
    let at = AtomicUsize::new(0);
    let done = Mutex::new(Vec::with_capacity(items.len()));
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| loop {
                let place = at.fetch_add(1, Ordering::Relaxed);
                let Some(item) = items.get(place) else {
                    return;
                };
                let result = work(item);
                if let Ok(mut done) = done.lock() {
                    done.push((place, result));
                }
            });
        }
    });
    let mut results = done.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    results.sort_by_key(|(place, _)| *place);
    results.into_iter().map(|(_, result)| result).collect()
}
