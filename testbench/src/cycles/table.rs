//! Writes the tables of `cycles.md`.

use std::fmt::Write;

use incircle_protocol::Counter;
use incircle_testkit::Distribution;

use super::airports::thinned_airports;
use super::batches::batches;
use super::parallel::in_parallel;
use super::{measure, measure_points, Counters, MeasureError};

/// The point sets. Each is a row of every table.
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

/// The numbers of contexts. Each is a column of every table.
pub const COLUMNS: [u32; 5] = [1, 4, 8, 16, 24];

/// The numbers of points. Each has a table of its own.
pub const BLOCKS: [usize; 4] = [1024, 4096, 8192, 16_384];

/// The number of contexts for which the last column gives the limit, and the last table the time.
const CONTEXTS: u32 = 16;

/// The numbers of points at which the other FPGA core was measured (see `SURVEY`).
const SURVEY_POINTS: [usize; 4] = [477, 953, 1906, 3811];

/// The clock rate for which times are given, in MHz.
const CLOCK_MHZ: f64 = 125.0;

/// The cycles per insertion that no schedule of the counted visits and writes can beat, because each memory has
/// one read port and one write port.
pub fn limit(counters: &Counters) -> f64 {
    counters.per_insertion(Counter::IssueCycles).max(counters.per_insertion(Counter::WriteCycles))
}

/// Returns the row of one point set in the table for `n` points.
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

/// Returns the table for `n` points, with its heading.
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

/// Returns the table for the point counts of the other FPGA core, with its heading and the citation.
///
/// # Errors
/// As [`measure`].
pub fn survey_counts() -> Result<String, MeasureError> {
    let mut text = format!(
        "{SURVEY}\n| points | uniform, cycles | µs at {CLOCK_MHZ} MHz | airports, cycles | µs at {CLOCK_MHZ} MHz |\n\
         |---:|---:|---:|---:|---:|\n"
    );
    for n in SURVEY_POINTS {
        let uniform = measure(Distribution::Uniform, n, CONTEXTS)?.of(Counter::InsertCycles);
        let airports = measure_points(&thinned_airports(n)?, CONTEXTS)?.of(Counter::InsertCycles);
        let time = |cycles: u64| cycles as f64 / CLOCK_MHZ;
        // Writing to a string cannot fail.
        let _ = writeln!(text, "| {n} | {uniform} | {:.1} | {airports} | {:.1} |", time(uniform), time(airports));
    }
    Ok(text)
}

/// Returns the whole of `cycles.md`.
///
/// # Errors
/// As [`measure`].
pub fn document() -> Result<String, MeasureError> {
    let mut parts = vec![INTRODUCTION.to_string()];
    for n in BLOCKS {
        parts.push(block(n)?);
    }
    parts.push(batches()?);
    parts.push(survey_counts()?);
    Ok(parts.join("\n"))
}

const INTRODUCTION: &str = "\
# Cycles of the core

For engineers who want to know how fast the core works, and how close that is to what its memories allow.

All figures are counted on the model clock by clock, so they are exact and the same on every machine. One command renews
this page, and the test `tests/it/cores/cycles.rs` counts everything again and compares:

    cargo run --release -p incircle-testbench --bin cycles

In the tables of 1,024 to 16,384 points:
- A row is a point set of `incircle generate`, with 16-bit coordinates and seed 1. Duplicates are removed first; the
  column \"distinct\" counts the points that remain. The points are sent in the order of the host.
- K is the number of contexts. Each context has a boundary list of 32 edges, and the capacity of the core is the next
  power of two.
- A cell is the counter `InsertCycles` divided by the points inserted. The counter runs from the first point accepted to
  the last lock released, and leaves out the read-out.
- The limit is the time of the memory accesses alone, at one visit and one write a clock: the larger of `IssueCycles`
  and `WriteCycles`, divided by the points inserted. Visits of aborted attempts count as well, so the limit belongs
  to the run and not to the algorithm.
";

/// The heading and the text before the last table.
const SURVEY: &str = "\
## Point counts of the FPGA core in the survey of Elshakhs et al.

The survey reviews one other core that triangulates in an FPGA: reference 27, made by high-level synthesis. Figure 16
reports its speed at these four point counts, on samples of the Stanford Bunny. The points here are others: uniform
sets, and airports thinned to the same counts, on 16 contexts.

Y. S. Elshakhs, K. M. Deliparaschos, T. Charalambous, G. Oliva, A. Zolotas: \"A Comprehensive Survey on Delaunay
Triangulation: Applications, Algorithms, and Implementations Over CPUs, GPUs, and FPGAs\", IEEE Access 12, 2024, pages
12562 to 12585, <https://doi.org/10.1109/ACCESS.2024.3354709>.
";
