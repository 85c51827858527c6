//! Runs the tools for cores of many sizes.

use super::super::flow::Toolbox;
use super::super::json;
use super::super::kept::{Kept, Key};
use super::super::tools::{run, Tools};
use super::super::{build, date, workshop, BoardError, BoardLink, Clock, Origin, Report, Request, BOARDS};
use super::family::{Family, FamilyCells};
use super::figures::{size_name, Placed, Size, Sizes};
use crate::export;
use crate::top::CORE_NAME;
use incircle_protocol::{Config, FULL};
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::Path;

/// All that a measurement needs to know.
pub struct SizesRequest<'a> {
    /// The cores to measure, of [`SIZES`](super::SIZES).
    pub sizes: Vec<Config>,
    /// The families to count cells in.
    pub families: Vec<&'static Family>,
    /// Whether to place the cores that no board lists.
    pub places: bool,
    /// Folder for the figures and the output of the tools.
    pub out: &'a Path,
    /// Source of the tools.
    pub tools: Origin,
    /// Called with a line for the user at each step.
    pub say: &'a dyn Fn(&str),
}

/// Measures the sizes, and writes the figures of each into `sizes.json` in the folder of the request, beside those that
/// are there. Steps that an earlier run in this folder has finished are not done again.
///
/// # Errors
/// If a tool fails or maps to a cell of no known kind, or the file holds something else.
pub fn measure(request: &SizesRequest) -> Result<Sizes, BoardError> {
    let (work, _lock) = workshop::take(request.out)?;
    let tools = Tools::find(request.tools, request.say)?;
    let versions = tools.versions(&work)?;
    let toolbox = Toolbox { tools, versions, kept: Kept::within(&work) };
    let file = request.out.join("sizes.json");
    let mut all = if file.exists() { Sizes::read(&file)? } else { Sizes::default() };
    for &config in &request.sizes {
        let mut cells = BTreeMap::new();
        for family in &request.families {
            cells.insert(family.name.to_owned(), synthesise(request, &toolbox, &work, config, family)?);
        }
        let placed = if request.places { place(request, config)? } else { None };
        let Config { engines, points, contexts, .. } = config;
        let size = Size { configuration: config.name.to_owned(), engines, points, contexts, cells, placed };
        let newer = Sizes { yosys: toolbox.versions.yosys.clone(), date: date::today(), sizes: vec![size] };
        all = all.renewed_by(newer);
        all.write(&file)?;
    }
    Ok(all)
}

/// Maps a core to a family.
fn synthesise(
    request: &SizesRequest,
    toolbox: &Toolbox,
    work: &Path,
    config: Config,
    family: &Family,
) -> Result<FamilyCells, BoardError> {
    const VERILOG: &str = "core.v";
    const COUNTS: &str = "counts.json";
    const LOG: &str = "synthesis.log";
    let size = size_name(config);
    let work = work.join(format!("{size}-{}", family.name));
    std::fs::create_dir(&work).map_err(BoardError::file(&work))?;
    let verilog = work.join(VERILOG);
    std::fs::write(&verilog, export::core(config, false)?).map_err(BoardError::file(&verilog))?;
    let script = format!("{}; tee -q -o {COUNTS} stat -json", family.script(VERILOG, CORE_NAME));
    let key = Key::default().text(&toolbox.versions.yosys).text(&script).file(&verilog)?;
    let check = || counts(&work.join(COUNTS), family).map(drop);
    let is_kept = toolbox
        .kept
        .step(key, &work, &[COUNTS], check, || run(&toolbox.tools.yosys, &["-p", &script], &work, LOG).map(drop))?;
    let kept = if is_kept { ", as an earlier run found" } else { "" };
    let cells = counts(&work.join(COUNTS), family)?;
    (request.say)(&format!("{size} in {}: {} look-up tables{kept}", family.title, cells.lut));
    Ok(cells)
}

fn counts(path: &Path, family: &Family) -> Result<FamilyCells, BoardError> {
    let counts: Value = json::read(path)?;
    let by_type = counts.pointer("/design/num_cells_by_type").and_then(Value::as_object);
    let by_type = by_type.ok_or_else(|| BoardError::form(path, "it does not count cells by type"))?;
    family.cells(by_type).map_err(|reason| BoardError::form(path, reason))
}

/// Places a core on the reference board, with one seed. `None` if a board lists the core, since `board` measures it
/// there, or if the core has more points than `full`, since the block memories of the device do not suffice.
fn place(request: &SizesRequest, config: Config) -> Result<Option<Placed>, BoardError> {
    let [board, ..] = BOARDS;
    let is_listed = BOARDS.iter().any(|board| board.report(config, BoardLink::Serial.suffix()).is_some());
    if is_listed || config.points > FULL.points {
        return Ok(None);
    }
    let say = |what: &str| (request.say)(&format!("{} on {}: {what}", size_name(config), board.name));
    let out = request.out.join(format!("{}-{}", board.name, size_name(config)));
    let (link, clock) = (BoardLink::Serial, Clock::Usual);
    let placing =
        Request { board, config, has_runs: false, link, seeds: 1, clock, out: &out, tools: request.tools, say: &say };
    let report = match build(&placing) {
        // A seed that misses the clock of the board is a figure like any other.
        Err(BoardError::Timing { report, .. }) => Report::read(&report)?,
        built => built?,
    };
    Ok(Some(Placed { board: board.title.to_owned(), fmax_mhz: report.fmax_mhz.median }))
}
