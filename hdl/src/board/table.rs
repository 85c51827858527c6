//! Makes the tables of the documents from the reports in the folders of the boards and from the table of cycles, so
//! that nobody types a figure.

use super::error::{seeds_in_words, BoardError};
use super::pll::MHZ;
use super::report::{Cells, Parts, Report, Summary};
use super::{constraints, repository, Board, BOARDS};
use std::path::PathBuf;

/// The lines before and behind a table in a document.
const BEGIN: &str = "<!-- made by `cargo run --release -p incircle-hdl -- board --table` -->\n";
const END: &str = "<!-- end -->\n";

/// The row of the table of cycles that the tables quote.
const POINT_SET: &str = "uniform";

/// The documents with a table: first the page of all boards, then the README of each board.
pub fn documents() -> Vec<PathBuf> {
    let all = constraints().join("README.md");
    std::iter::once(all).chain(BOARDS.iter().map(|board| board.folder().join("README.md"))).collect()
}

/// The path and the required text of every document.
///
/// # Errors
/// If a document, a report or the table of cycles cannot be read or understood.
pub fn pages() -> Result<Vec<(PathBuf, String)>, BoardError> {
    let mut measured = Vec::new();
    for board in BOARDS {
        measured.push((board, measurement(&board)?));
    }
    let single = measured.iter().map(|(_, measurement)| details(measurement.as_ref()));
    let tables = std::iter::once(overview(&measured)).chain(single);
    let fill = |(path, table): (PathBuf, String)| {
        let text = held_text(&path)?;
        let parts = text.split_once(BEGIN).and_then(|(before, rest)| Some((before, rest.split_once(END)?.1)));
        let (before, after) =
            parts.ok_or_else(|| BoardError::form(&path, format!("it has no {BEGIN:?} and {END:?}")))?;
        Ok((path, format!("{before}{BEGIN}{table}{END}{after}")))
    };
    documents().into_iter().zip(tables).map(fill).collect()
}

/// The present text of a document.
///
/// # Errors
/// If the document cannot be read.
pub fn held_text(path: &PathBuf) -> Result<String, BoardError> {
    std::fs::read_to_string(path).map_err(BoardError::file(path))
}

/// Writes the tables in all documents again.
///
/// # Errors
/// The errors of [`pages`], and any document that cannot be written.
pub fn renew_tables() -> Result<(), BoardError> {
    for (path, text) in pages()? {
        std::fs::write(&path, text).map_err(BoardError::file(path))?;
    }
    Ok(())
}

/// The report of a board, and the cycles of one insertion on the board's core if the table of cycles has them.
struct Measurement {
    report: Report,
    cycles: Option<f64>,
}

impl Measurement {
    /// Number of insertions in a second.
    fn points_per_second(&self) -> Option<f64> {
        self.cycles.map(|cycles| f64::from(self.report.clock_mhz * MHZ) / cycles)
    }

    fn cycles(&self) -> String {
        self.cycles.map_or("-".into(), |cycles| format!("{cycles:.2}"))
    }

    fn rate(&self) -> String {
        self.points_per_second().map_or("-".into(), |rate| format!("{:.2} million", rate / f64::from(MHZ)))
    }

    fn clock(&self) -> String {
        let met = if self.report.met { "" } else { ", **missed**" };
        format!("{} MHz{met}", self.report.clock_mhz)
    }
}

fn measurement(board: &Board) -> Result<Option<Measurement>, BoardError> {
    let path = board.folder().join("report.json");
    if !path.exists() {
        return Ok(None);
    }
    let report = Report::read(&path)?;
    let cycles = cycles(report.points, report.contexts)?;
    Ok(Some(Measurement { report, cycles }))
}

/// Cycles of one insertion from the committed table, for a set of this many points and a core with this many contexts.
fn cycles(points: u32, contexts: u32) -> Result<Option<f64>, BoardError> {
    let path = repository().join("testbench").join("cycles.md");
    let text = held_text(&path)?;
    let Some((_, section)) = text.split_once(&format!("## {points} points\n")) else { return Ok(None) };
    let rows = section.lines().take_while(|line| !line.starts_with("##")).filter(|line| line.starts_with('|'));
    let cells = |row: &str| row.split('|').map(|cell| cell.trim().to_string()).collect::<Vec<_>>();
    let rows: Vec<_> = rows.map(cells).collect();
    let column = rows.first().and_then(|head| head.iter().position(|cell| *cell == format!("K = {contexts}")));
    let row = rows.iter().find(|row| row.get(1).is_some_and(|set| set == POINT_SET));
    let (Some(column), Some(row)) = (column, row) else { return Ok(None) };
    let cycles = row.get(column).and_then(|cell| cell.parse().ok());
    cycles.map(Some).ok_or_else(|| BoardError::form(path, format!("no number of cycles for {points} points")))
}

fn three(Summary { min, median, max }: Summary) -> String {
    format!("{min:.1} / {median:.1} / {max:.1}")
}

/// The table of all boards. Its links start at `constraints/`.
fn overview(measured: &[(Board, Option<Measurement>)]) -> String {
    let mut text = String::from(
        "\n| board | points, contexts | LUT, core + link | FF | DSP | EBR | Fmax of the seeds, min / median / max \
         | clock | cycles an insertion | insertions a second | serial |\n\
         |---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    for (board, measurement) in measured {
        let link = format!("[{}]({}/README.md), {}", board.title, board.name, board.device);
        let Some(measurement) = measurement else {
            text += &format!("| {link} | not measured |{}\n", " |".repeat(9));
            continue;
        };
        let Report { points, contexts, cells, fmax_mhz, serial, .. } = &measurement.report;
        let sum = |of: fn(&Cells) -> u64| format!("{} + {}", of(&cells.core), of(&cells.shell));
        text += &format!(
            "| {link} | {points}, {contexts} | {} | {} | {} | {} | {} | {} | {} | {} | {} bit/s |\n",
            sum(|cells| cells.lut),
            sum(|cells| cells.ff),
            sum(|cells| cells.dsp),
            sum(|cells| cells.ebr),
            three(*fmax_mhz),
            measurement.clock(),
            measurement.cycles(),
            measurement.rate(),
            serial.bits_per_second,
        );
    }
    let mut measurements: Vec<_> = measured
        .iter()
        .filter_map(|(board, measurement)| {
            let report = &measurement.as_ref()?.report;
            let seeds = seeds_in_words(report.seeds.len());
            Some(format!("{} {}, {seeds}, {}", board.title, report.date, tools(report)))
        })
        .collect();
    measurements.push(format!("cycles of {POINT_SET} points to the brim: testbench/cycles.md"));
    text += &format!("\nMeasured:\n- {}.\n", measurements.join(";\n- "));
    text
}

fn tools(report: &Report) -> String {
    let tools = &report.tools;
    format!("yosys {}, nextpnr {}", tools.yosys, tools.nextpnr)
}

/// The table of one board.
fn details(measurement: Option<&Measurement>) -> String {
    let Some(measurement) = measurement else { return "\nNot measured.\n".into() };
    let rows: String =
        readings(measurement).into_iter().map(|(name, value)| format!("| {name} | {value} |\n")).collect();
    format!("{}\n| | |\n|---|---|\n{rows}", resources(&measurement.report.cells))
}

/// The rows that say how much of the device the core and the shell take.
fn resources(cells: &Parts) -> String {
    let row = |name: &str, of: fn(&Cells) -> u64| {
        let (core, shell, placed, available) = (&cells.core, &cells.shell, &cells.placed, &cells.available);
        let share = 100.0 * of(placed) as f64 / of(available).max(1) as f64;
        let shown = [of(core), of(shell), of(placed), of(available)];
        let [core, shell, placed, available] = shown.map(|count| count.to_string());
        format!("| {name} | {core} | {shell} | {placed} of {available}, {share:.0} % |\n")
    };
    let mut text = String::from("\n| | core | link, clock, reset | placed |\n|---|---|---|---|\n");
    text += &row("LUT", |cells| cells.lut);
    text += &row("FF", |cells| cells.ff);
    text += &row("DSP", |cells| cells.dsp);
    text += &row("EBR", |cells| cells.ebr);
    text
}

/// The other figures of a board, each with its name.
fn readings(measurement: &Measurement) -> [(&'static str, String); 9] {
    let report = &measurement.report;
    let seeds: Vec<_> = report.seeds.iter().map(|seed| format!("{:.1} (seed {})", seed.fmax_mhz, seed.seed)).collect();
    let bitstream = report.bitstream.as_ref();
    [
        ("configuration", format!("{}: {} points, {} contexts", report.configuration, report.points, report.contexts)),
        ("clock", measurement.clock()),
        ("Fmax, MHz", seeds.join(", ")),
        ("Fmax, min / median / max", three(report.fmax_mhz)),
        ("cycles an insertion", measurement.cycles()),
        ("insertions a second", measurement.rate()),
        (
            "serial",
            format!(
                "{} bit/s ({}), FIFO of {} bytes",
                report.serial.bits_per_second, report.serial.bridge, report.serial.fifo_bytes
            ),
        ),
        (
            "bitstream, SHA-256",
            bitstream.map_or("none".into(), |made| format!("`{}`, {} bytes", made.sha256, made.bytes)),
        ),
        ("measured", format!("{}, {}, ecppack {}", report.date, tools(report), report.tools.ecppack)),
    ]
}
