//! Makes the tables of the documents from the reports in the folders of the boards and from the table of cycles, so
//! that nobody types a figure.

use super::error::{seeds_in_words, BoardError};
use super::link::BoardLink;
use super::report::{Cells, Network, Parts, Report, Serial, Summary};
use super::{constraints, repository, Board, BoardCore, BOARDS};
use incircle_protocol::Config;
use std::path::PathBuf;

/// The line before a table of boards in a document.
const BEGIN: &str = "<!-- made by `cargo run --release -p incircle-hdl -- board --table` -->\n";
/// The line behind a table that this command makes.
const END: &str = "<!-- end -->\n";

/// The suffix of the reports on cores behind the Ethernet port of a board.
const UDP_SUFFIX: &str = "-udp";

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
    let measured = rows(BoardLink::Serial.suffix())?;
    let mut behind_ethernet = rows(UDP_SUFFIX)?;
    behind_ethernet.retain(|row| row.measurement.is_some());
    let of = |rows: &'_ [Row], board: &Board, of: fn(&[&Row]) -> String| {
        of(&rows.iter().filter(|row| row.board.name == board.name).collect::<Vec<_>>())
    };
    let single = BOARDS
        .iter()
        .map(|board| of(&measured, board, details) + &of(&behind_ethernet, board, details_behind_ethernet));
    let tables = std::iter::once(overview(&measured)).chain(single);
    let fill = |(path, table): (PathBuf, String)| {
        let text = with_table(&path, BEGIN, &table)?;
        Ok((path, text))
    };
    documents().into_iter().zip(tables).map(fill).collect()
}

/// The cores of all boards, with the measurements behind the link of this suffix.
fn rows(suffix: &str) -> Result<Vec<Row>, BoardError> {
    let cores = BOARDS.into_iter().flat_map(|board| board.cores.iter().map(move |&core| (board, core)));
    cores.map(|(board, core)| Ok(Row { board, core, measurement: measurement(&board, core.config, suffix)? })).collect()
}

/// The text of a document with this table behind the line `begin`, up to [`END`].
///
/// # Errors
/// If the document cannot be read, or lacks one of the lines.
pub(super) fn with_table(path: &PathBuf, begin: &str, table: &str) -> Result<String, BoardError> {
    let text = held_text(path)?;
    let parts = text.split_once(begin).and_then(|(before, rest)| Some((before, rest.split_once(END)?.1)));
    let (before, after) = parts.ok_or_else(|| BoardError::form(path, format!("it has no {begin:?} and {END:?}")))?;
    Ok(format!("{before}{begin}{table}{END}{after}"))
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

/// A core on a board, with its measurement if there is one.
struct Row {
    board: Board,
    core: BoardCore,
    measurement: Option<Measurement>,
}

/// The report of a core on a board, and what the table of cycles has on the core.
struct Measurement {
    report: Report,
    /// Cycles of one insertion, in a set that fills the memory; `None` for a chip, which divides no set among its
    /// engines.
    cycles: Option<f64>,
    /// Cycles of the whole chip per point, in batches of jobs of 200, 1,000, 2,000 and 4,000 points; `None` where a job
    /// does not fit.
    batches: Vec<Option<f64>>,
}

impl Measurement {
    /// Millions of points in a second, at so many cycles a point.
    fn millions(&self, cycles: f64) -> f64 {
        f64::from(self.report.clock_mhz) / cycles
    }

    fn cycles(&self) -> String {
        self.cycles.map_or("-".into(), |cycles| format!("{cycles:.2}"))
    }

    fn rate(&self) -> String {
        self.cycles.map_or("-".into(), |cycles| format!("{:.2} million", self.millions(cycles)))
    }

    /// Millions of points in a second, in batches.
    fn batch_rates(&self) -> String {
        let rates = self.batches.iter().map(|cycles| match cycles {
            Some(cycles) => format!("{:.1}", self.millions(*cycles)),
            None => "-".into(),
        });
        rates.collect::<Vec<_>>().join(" / ")
    }

    /// The points and contexts of the core.
    fn sizes(&self) -> String {
        sizes(self.report.engines, self.report.points, self.report.contexts)
    }

    fn clock(&self) -> String {
        let met = if self.report.met { "" } else { ", **missed**" };
        format!("{} MHz{met}", self.report.clock_mhz)
    }
}

/// The points and contexts of a core, as in `2 x 4096 points, 16 contexts each`.
pub(super) fn sizes(engines: u32, points: u32, contexts: u32) -> String {
    match engines {
        1 => format!("{points} points, {contexts} contexts"),
        _ => format!("{engines} x {points} points, {contexts} contexts each"),
    }
}

fn measurement(board: &Board, config: Config, suffix: &str) -> Result<Option<Measurement>, BoardError> {
    let Some(path) = board.report(config, suffix).filter(|path| path.exists()) else {
        return Ok(None);
    };
    let report = Report::read(&path)?;
    let cycles = if report.engines == 1 { set_cycles(report.points, report.contexts)? } else { None };
    let batches = batch_cycles(report.engines, report.points, report.contexts)?;
    Ok(Some(Measurement { report, cycles, batches }))
}

/// The rows under a heading of `testbench/cycles.md`, each as its columns; the first row is the head. Empty if the page
/// has no such heading.
fn rows_of_cycles(heading: &str) -> Result<Vec<Vec<String>>, BoardError> {
    let text = held_text(&cycles_page())?;
    let section = text.split_once(&format!("## {heading}\n")).map_or("", |(_, section)| section);
    let rows = section.lines().take_while(|line| !line.starts_with("##")).filter(|line| line.starts_with('|'));
    let cells = |row: &str| row.trim_matches('|').split('|').map(|cell| cell.trim().to_string()).collect();
    Ok(rows.map(cells).collect())
}

fn cycles_page() -> PathBuf {
    repository().join("testbench").join("cycles.md")
}

/// Cycles of one insertion, for a set of this many points and a core with this many contexts.
fn set_cycles(points: u32, contexts: u32) -> Result<Option<f64>, BoardError> {
    let rows = rows_of_cycles(&format!("{points} points"))?;
    let column = rows.first().and_then(|head| head.iter().position(|cell| *cell == format!("K = {contexts}")));
    let row = rows.iter().find(|row| row.first().is_some_and(|set| set == POINT_SET));
    let (Some(column), Some(row)) = (column, row) else { return Ok(None) };
    let cycles = row.get(column).and_then(|cell| cell.parse().ok());
    let missing = || BoardError::form(cycles_page(), format!("no number of cycles for {points} points"));
    cycles.map(Some).ok_or_else(missing)
}

/// Cycles per point in batches on a core of these sizes, for jobs of 200, 1,000, 2,000 and 4,000 points; empty if the
/// page does not have the core.
pub(super) fn batch_cycles(engines: u32, points: u32, contexts: u32) -> Result<Vec<Option<f64>>, BoardError> {
    let key = [engines, points, contexts].map(|number| number.to_string());
    let rows = rows_of_cycles("Batches")?;
    let row = rows.into_iter().find(|row| row.get(1..4).is_some_and(|sizes| sizes == key));
    Ok(row.unwrap_or_default().iter().skip(4).map(|cell| cell.parse().ok()).collect())
}

fn three(Summary { min, median, max }: Summary) -> String {
    format!("{min:.1} / {median:.1} / {max:.1}")
}

/// The table of all boards. Its links start at `constraints/`.
fn overview(measured: &[Row]) -> String {
    let mut text = String::from(
        "\n| board | core | LUT, core + link | FF | DSP | EBR | Fmax of the seeds, min / median / max \
         | clock | cycles an insertion | insertions a second \
         | million points a second of the core alone, in batches | serial |\n\
         |---|---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    measured.iter().for_each(|row| text += &overview_row(row));
    let mut measurements: Vec<_> = measured
        .iter()
        .filter_map(|row| {
            let report = &row.measurement.as_ref()?.report;
            let seeds = seeds_in_words(report.seeds.len());
            let Row { board, core, .. } = row;
            Some(format!("{} with {} {}, {seeds}, {}", board.title, core.config.name, report.date, tools(report)))
        })
        .collect();
    measurements.push(format!("cycles of {POINT_SET} points: testbench/cycles.md"));
    text += &format!("\nMeasured:\n- {}.\n", measurements.join(";\n- "));
    text
}

/// The row of a core on a board in the table of all boards.
fn overview_row(Row { board, core, measurement }: &Row) -> String {
    let link = format!("[{}]({}/README.md), {}", board.title, board.name, board.device);
    let Some(measurement) = measurement else {
        let Config { name, engines, points, contexts, .. } = core.config;
        return format!("| {link} | {name}: {} | not placed |{}\n", sizes(engines, points, contexts), " |".repeat(9));
    };
    let Report { configuration, cells, fmax_mhz, serial, .. } = &measurement.report;
    let sum = |of: fn(&Cells) -> u64| format!("{} + {}", of(&cells.core), of(&cells.shell));
    format!(
        "| {link} | {configuration}: {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} bit/s |\n",
        measurement.sizes(),
        sum(|cells| cells.lut),
        sum(|cells| cells.ff),
        sum(|cells| cells.dsp),
        sum(|cells| cells.ebr),
        three(*fmax_mhz),
        measurement.clock(),
        measurement.cycles(),
        measurement.rate(),
        measurement.batch_rates(),
        serial.as_ref().map_or(0, |serial| serial.bits_per_second),
    )
}

fn tools(report: &Report) -> String {
    let tools = &report.tools;
    format!("yosys {}, nextpnr {}", tools.yosys, tools.nextpnr)
}

/// The tables of one board: first the board's own core, then the others, each under a heading.
fn details(rows: &[&Row]) -> String {
    let section = |(place, row): (usize, &&Row)| {
        let heading = if place == 0 { String::new() } else { format!("\n### With `{}`\n", row.core.config.name) };
        heading + &row.measurement.as_ref().map_or_else(|| "\nNot placed.\n".to_owned(), tables)
    };
    rows.iter().enumerate().map(section).collect()
}

/// The tables of one board behind its Ethernet port, each under a heading.
fn details_behind_ethernet(rows: &[&Row]) -> String {
    let sections = rows.iter().filter_map(|row| {
        let measurement = row.measurement.as_ref()?;
        Some(format!("\n### With `{}` behind Ethernet\n{}", row.core.config.name, tables(measurement)))
    });
    sections.collect()
}

/// The two tables of a measurement: the cells, and the other figures.
fn tables(measurement: &Measurement) -> String {
    let rows = readings(measurement).map(|(name, value)| format!("| {name} | {value} |\n"));
    format!("{}\n| | |\n|---|---|\n{}", resources(&measurement.report.cells), rows.concat())
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
fn readings(measurement: &Measurement) -> [(&'static str, String); 10] {
    let (link_name, link) = link(&measurement.report);
    let report = &measurement.report;
    let seeds: Vec<_> = report.seeds.iter().map(|seed| format!("{:.1} (seed {})", seed.fmax_mhz, seed.seed)).collect();
    let bitstream = report.bitstream.as_ref();
    [
        ("configuration", format!("{}: {}", report.configuration, measurement.sizes())),
        ("clock", measurement.clock()),
        ("Fmax, MHz", seeds.join(", ")),
        ("Fmax, min / median / max", three(report.fmax_mhz)),
        ("cycles an insertion", measurement.cycles()),
        ("insertions a second", measurement.rate()),
        (
            "million points a second of the core alone, in batches of jobs of 200 / 1,000 / 2,000 / 4,000",
            measurement.batch_rates(),
        ),
        (link_name, link),
        (
            "bitstream, SHA-256",
            bitstream.map_or("none".into(), |made| format!("`{}`, {} bytes", made.sha256, made.bytes)),
        ),
        ("measured", format!("{}, {}, ecppack {}", report.date, tools(report), report.tools.ecppack)),
    ]
}

/// The link in words, as a report gives it, with its name.
fn link(report: &Report) -> (&'static str, String) {
    if let Some(Serial { bridge, bits_per_second, fifo_bytes }) = &report.serial {
        return ("serial", format!("{bits_per_second} bit/s ({bridge}), FIFO of {fifo_bytes} bytes"));
    }
    let of_network = |network: &Network| {
        format!(
            "{} at `{}`, `{}`, UDP port {}, FIFO of {} bytes; data from the PHY delayed by {} taps of 25 ps, clock to \
             the PHY by {}; Fmax of the seeds at the port {} MHz, 125 MHz needed",
            network.phy,
            network.ip,
            network.mac,
            network.udp_port,
            network.fifo_bytes,
            network.rgmii_delay,
            network.rgmii_clock_delay,
            three(network.fmax_mhz)
        )
    };
    ("Ethernet", report.network.as_ref().map_or_else(String::new, of_network))
}
