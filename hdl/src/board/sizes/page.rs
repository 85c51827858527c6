//! Makes the tables of `docs/sizes.md`.

use super::super::table::{batch_cycles, sizes, with_table};
use super::super::{repository, BoardError, BoardLink, Report, BOARDS};
use super::family::{Family, FamilyCells, FAMILIES};
use super::figures::{figures, Size, Sizes};
use std::path::PathBuf;

const BEGIN: &str = "<!-- made by `cargo run --release -p incircle-hdl -- sizes --table` -->\n";

/// The document with the tables.
pub fn page_path() -> PathBuf {
    repository().join("docs").join("sizes.md")
}

/// The text that the document must have.
///
/// # Errors
/// If the document, the figures, a report or the page of cycles cannot be read or understood.
pub fn page() -> Result<String, BoardError> {
    let measured = Sizes::read(&figures())?;
    let mut tables = String::new();
    for family in &FAMILIES {
        tables += &table(family, &measured)?;
    }
    tables += &format!("\nThe last measurement was on {}, with yosys {}.\n", measured.date, measured.yosys);
    with_table(&page_path(), BEGIN, &tables)
}

/// Writes the document again.
///
/// # Errors
/// The errors of [`page`], and a document that cannot be written.
pub fn renew_page() -> Result<(), BoardError> {
    let (path, text) = (page_path(), page()?);
    std::fs::write(&path, text).map_err(BoardError::file(&path))
}

/// The heading and the table of a family. The first family also has clocks and speeds.
fn table(family: &Family, measured: &Sizes) -> Result<String, BoardError> {
    let has_clocks = family.name == FAMILIES[0].name;
    let block = family.block;
    let mut rows = measured.sizes.iter().filter(|size| has_clocks || size.cells.contains_key(family.name)).peekable();
    if rows.peek().is_none() {
        return Ok(format!("\n### {}\n\nNot measured.\n", family.title));
    }
    let mut text = format!(
        "\n### {}{}\n\n| core | look-up tables | carry cells | tables as memory | FF | multipliers \
         | block RAMs, {block} |",
        family.title,
        if has_clocks { "" } else { ", cells alone" }
    );
    if has_clocks {
        text += " clock, MHz | million points a second in batches |";
    }
    text += &format!("\n|---|{}\n", "---:|".repeat(if has_clocks { 8 } else { 6 }));
    for size in rows {
        let name = if size.configuration == "custom" { String::new() } else { format!("{}: ", size.configuration) };
        text += &format!("| {name}{} |", sizes(size.engines, size.points, size.contexts));
        text += &match size.cells.get(family.name) {
            Some(FamilyCells { lut, carry, lut_memory, ff, multiplier, block_memory }) => {
                format!(" {lut} | {carry} | {lut_memory} | {ff} | {multiplier} | {block_memory} |")
            }
            None => " - |".repeat(6),
        };
        if has_clocks {
            text += &clocks(size)?;
        }
        text += "\n";
    }
    Ok(text)
}

/// The last two columns of a row: the clock, and the speed in batches.
fn clocks(size: &Size) -> Result<String, BoardError> {
    let of_board = of_board(size)?;
    let of_seed = || size.placed.as_ref().map(|placed| (placed.fmax_mhz, format!("{}, one seed", placed.board)));
    let Some((mhz, place)) = of_board.or_else(of_seed) else {
        return Ok(" not placed | - |".to_owned());
    };
    let cycles = batch_cycles(size.engines, size.points, size.contexts)?;
    let rates = cycles.iter().map(|cycles| cycles.map_or("-".to_owned(), |cycles| format!("{:.1}", mhz / cycles)));
    Ok(format!(" {mhz:.1} ({place}) | {} |", rates.collect::<Vec<_>>().join(" / ")))
}

/// The clock of the first board that meets its clock with this core, and the name of the board.
fn of_board(size: &Size) -> Result<Option<(f64, String)>, BoardError> {
    let Some(config) = size.config() else { return Ok(None) };
    for board in BOARDS {
        if let Some(path) = board.report(config, BoardLink::Serial.suffix()).filter(|path| path.exists()) {
            let report = Report::read(&path)?;
            if report.met {
                return Ok(Some((f64::from(report.clock_mhz), board.title.to_owned())));
            }
        }
    }
    Ok(None)
}
