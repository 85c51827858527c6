//! Makes a bitstream and its report: export, synthesis, place and route with several seeds, packing.
//!
//! The clock is the usual one of the core behind its link if the median of the seeds meets it. If the median misses a
//! clock, the median tells what is within reach, so the next clock tried is the largest one of the board's list that
//! the median meets.

use super::error::BoardError;
use super::kept::{hexadecimal, Kept, Key};
use super::link::BoardLink;
use super::mapping::{mapping, placer};
use super::port::{Rgmii, PORT_MHZ};
use super::report::{dividers, Attempt, Bitstream, Cells, Network, Parts, Report, Seed, Serial, Summary, Versions};
use super::tools::{run_strictly, Origin, Tools};
use super::{constraints, date, readings, workshop, Board};
use crate::files::replace;
use crate::udp::UdpParameters;
use incircle_protocol::Config;
use sha2::{Digest, Sha256};
use std::path::{Path, PathBuf};

/// Pattern of the core's cells in the synthesised board: the instance is called `core`.
const CORE: &str = "c:device.*.core.*";

/// Pattern of the cells of a core with runs, whose parts stand side by side in the instance `engines`.
const CORE_WITH_RUNS: &str = "c:device.engines.*";

/// Name of the file with the report.
const REPORT: &str = "report.json";

/// The choice of the clocks to try.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clock {
    /// The usual clock of the core behind its link, and lower ones while it is missed.
    UsualOrLess,
    /// The usual clock of the core behind its link, and no other.
    Usual,
    /// The largest clock that a user may ask of the board, and lower ones while it is missed.
    Largest,
    /// Only this clock, in MHz.
    Exactly(u32),
}

/// All that a build needs to know.
pub struct Request<'a> {
    pub board: Board,
    /// Configuration of the core.
    pub config: Config,
    /// Whether the core has runs, the commands for a mesh that lives.
    pub has_runs: bool,
    /// The link between core and host.
    pub link: BoardLink,
    /// Number of seeds for the placer; the seeds are 1, 2 and so on.
    pub seeds: u32,
    /// The clocks to try.
    pub clock: Clock,
    /// Folder for the bitstream, the report, and the folder `work` with the output of the tools.
    pub out: &'a Path,
    /// Source of the tools.
    pub tools: Origin,
    /// Called with a line for the user at each step.
    pub say: &'a dyn Fn(&str),
}

/// The tools, their versions, and what they made in earlier runs.
pub(super) struct Toolbox {
    pub tools: Tools,
    pub versions: Versions,
    pub kept: Kept,
}

/// The result of placing a design for one clock with every seed.
struct Placed {
    clock_mhz: u32,
    seeds: Vec<Seed>,
    cells: Parts,
}

impl Placed {
    fn summary(&self) -> Summary {
        Summary::of(&self.seeds)
    }

    /// The clocks of the Ethernet port; all 0 without one.
    fn port_summary(&self) -> Summary {
        Summary::of_clocks(self.seeds.iter().filter_map(|seed| seed.port_fmax_mhz))
    }

    /// Whether the Ethernet port, if there is one, meets its clock.
    fn port_is_met(&self) -> bool {
        self.seeds.iter().all(|seed| seed.port_fmax_mhz.is_none()) || self.port_summary().median >= f64::from(PORT_MHZ)
    }

    fn core_is_met(&self) -> bool {
        self.summary().median >= f64::from(self.clock_mhz)
    }

    fn is_met(&self) -> bool {
        self.core_is_met() && self.port_is_met()
    }

    /// The seed to pack: among those whose Ethernet port meets its clock, the one with the fastest core.
    fn fastest(&self) -> Option<u32> {
        let sound = self.seeds.iter().filter(|seed| seed.port_fmax_mhz.is_none_or(|mhz| mhz >= f64::from(PORT_MHZ)));
        sound.max_by(|a, b| a.fmax_mhz.total_cmp(&b.fmax_mhz)).map(|seed| seed.seed)
    }
}

/// Makes the bitstream and its report in the folder `request.out`.
///
/// # Errors
/// If a tool fails or warns, or none of the clocks is met; in the last case the report is written all the same.
pub fn build(request: &Request) -> Result<Report, BoardError> {
    let clocks = clocks(request)?;
    // Wrong parameters are told before any tool is fetched.
    device(request, clocks[0])?;
    let (work, _lock) = workshop::take(request.out)?;
    let tools = Tools::find(request.tools, request.say)?;
    let versions = tools.versions(&work)?;
    let toolbox = Toolbox { tools, versions, kept: Kept::within(&work) };
    forget_earlier(request)?;
    let mut missed = Vec::new();
    let mut rest = clocks.as_slice();
    loop {
        let [clock_mhz, lower @ ..] = rest else {
            // Not reached: the list of clocks is never empty, and the loop ends with its last clock.
            return Err(BoardError::form(&work, "no clock is left to try"));
        };
        // Each clock has its own folder, so that no file of another clock stands in for one that is missing.
        let work = work.join(format!("{clock_mhz}-mhz"));
        std::fs::create_dir(&work).map_err(BoardError::file(&work))?;
        let placed = place(request, &toolbox, &work, *clock_mhz)?;
        let median = placed.summary().median;
        let within_reach = lower.partition_point(|&clock| f64::from(clock) > median);
        rest = lower.get(within_reach..).unwrap_or_default();
        // A slower clock of the core does not help the port.
        if placed.core_is_met() || rest.is_empty() {
            let Toolbox { tools, versions, kept } = toolbox;
            let finished = finish(request, &tools, &work, describe(request, &placed, versions), missed, &placed);
            kept.drop_others()?;
            return finished;
        }
        missed.push(Attempt { clock_mhz: placed.clock_mhz, fmax_mhz: placed.summary() });
    }
}

/// Removes the report and the bitstream of an earlier run, so that nobody flashes them for those of this run.
fn forget_earlier(request: &Request) -> Result<(), BoardError> {
    for file in [request.out.join(REPORT), request.out.join(bitstream(request))] {
        if file.exists() {
            std::fs::remove_file(&file).map_err(BoardError::file(&file))?;
        }
    }
    Ok(())
}

/// Name of the file with the bitstream.
fn bitstream(request: &Request) -> String {
    format!("{}{}.bit", request.board.name, request.link.suffix())
}

/// The clocks to try, the largest one first.
fn clocks(request: &Request) -> Result<Vec<u32>, BoardError> {
    let board = request.board;
    let usual_mhz = request.link.usual_mhz(&board, request.config)?;
    match request.clock {
        Clock::UsualOrLess => Ok(board.clocks(usual_mhz)),
        Clock::Usual => Ok(vec![usual_mhz]),
        Clock::Largest => Ok(board.clocks(board.most_mhz)),
        Clock::Exactly(clock_mhz) if board.clocks(board.most_mhz).contains(&clock_mhz) => Ok(vec![clock_mhz]),
        Clock::Exactly(clock_mhz) => Err(BoardError::Clock {
            board: board.name,
            clock_mhz,
            least_mhz: board.least_mhz,
            most_mhz: board.most_mhz,
        }),
    }
}

/// Synthesises the board for a clock, and places it with every seed.
fn place(request: &Request, toolbox: &Toolbox, work: &Path, clock_mhz: u32) -> Result<Placed, BoardError> {
    let board = request.board;
    (request.say)(&format!("synthesis of {} for {clock_mhz} MHz", board.title));
    let (core, all) = synthesise(request, toolbox, work, clock_mhz)?;
    let design = Key::default().text(&toolbox.versions.nextpnr);
    let design = design.file(&work.join("netlist.json"))?.file(&work.join("pins.lpf"))?;
    let mut seeds = Vec::new();
    let (mut placed, mut available) = Default::default();
    for seed in 1..=request.seeds {
        let (report, config) = (format!("report-{seed}.json"), format!("seed-{seed}.config"));
        let seed_text = seed.to_string();
        let mut arguments: Vec<_> = board.chip.into_iter().chain(placer(request.config, request.has_runs)).collect();
        arguments.extend(["--json", "netlist.json", "--lpf", "pins.lpf", "--textcfg", &config, "--report", &report]);
        // A single seed may miss the clock: the median of all seeds decides.
        arguments.extend(["--seed", &seed_text, "--timing-allow-fail"]);
        let key = arguments.iter().fold(design.clone(), |key, argument| key.text(argument));
        let measured = work.join(&report);
        // A report without a clock or cells is no measurement, and is not kept.
        let read = || readings::fmax(&measured, clock_mhz, request.link.port_clock().map(|pin| (pin, PORT_MHZ)));
        let check = || read().and_then(|_| readings::cells(&measured)).map(drop);
        let is_kept = toolbox.kept.step(key, work, &[&report, &config], check, || {
            run_strictly(&toolbox.tools.nextpnr, &arguments, work, &format!("place-{seed}.log"))
        })?;
        let (fmax_mhz, port_fmax_mhz) = read()?;
        let kept = if is_kept { ", as an earlier run found" } else { "" };
        let port = port_fmax_mhz.map_or(String::new(), |mhz| format!(", the Ethernet port {mhz:.1} MHz"));
        (request.say)(&format!("seed {seed} reaches {fmax_mhz:.1} MHz{port}{kept}"));
        seeds.push(Seed { seed, fmax_mhz, port_fmax_mhz });
        (placed, available) = readings::cells(&measured)?;
    }
    let shell = Cells {
        lut: all.lut.saturating_sub(core.lut),
        ff: all.ff.saturating_sub(core.ff),
        dsp: all.dsp.saturating_sub(core.dsp),
        ebr: all.ebr.saturating_sub(core.ebr),
    };
    Ok(Placed { clock_mhz, seeds, cells: Parts { core, shell, placed, available } })
}

/// The Verilog of the device for a clock.
fn device(request: &Request, clock_mhz: u32) -> Result<String, BoardError> {
    let Request { board, config, has_runs, link, .. } = request;
    link.device(board, *config, *has_runs, clock_mhz)
}

/// Exports the device and maps the board's top module; returns the cells of the core and of the whole design.
fn synthesise(request: &Request, toolbox: &Toolbox, work: &Path, clock_mhz: u32) -> Result<(Cells, Cells), BoardError> {
    let board = request.board;
    let pll = board.pll(clock_mhz).ok_or_else(|| BoardError::form(work, "the PLL cannot make this clock"))?;
    let link = request.link;
    let written = work.join("device.v");
    std::fs::write(&written, device(request, clock_mhz)?).map_err(BoardError::file(&written))?;
    let shared = constraints().join("ecp5");
    let mut sources = vec!["device.v", "clock.v", "top.v"];
    sources.extend(link.source());
    let mut copies = vec![
        (shared.join("clock.v"), "clock.v"),
        (board.folder().join(format!("top{}.v", link.suffix())), "top.v"),
        (board.folder().join(format!("pins{}.lpf", link.suffix())), "pins.lpf"),
    ];
    let floorplan = board.floorplan(request.config);
    let floorplan = floorplan.as_deref();
    copies.extend(link.source().into_iter().chain(floorplan).map(|name| (shared.join(name), name)));
    for (from, to) in copies {
        std::fs::copy(&from, work.join(to)).map_err(BoardError::file(from))?;
    }
    let counts = "counts.txt";
    let mut script = format!(
        "read_verilog -D INCIRCLE_ECP5 -D {}{} {}; {}",
        pll.define(),
        link.defines(),
        sources.join(" "),
        mapping(&link.top(&board))
    );
    if let Some(file) = floorplan {
        script += &format!("; script {file}");
    }
    script += "; write_json netlist.json";
    let core = if request.has_runs { CORE_WITH_RUNS } else { CORE };
    for cell in readings::COUNTED {
        script += &format!("; tee -a {counts} select -count t:{cell}");
        script += &format!("; tee -a {counts} select -count {core} t:{cell} %i");
    }
    sources.extend(floorplan);
    let key = Key::default().text(&toolbox.versions.yosys).text(&script);
    let key = sources.iter().try_fold(key, |key, source| key.file(&work.join(source)))?;
    let counted = work.join(counts);
    let check = || readings::counts(&counted).map(drop);
    toolbox.kept.step(key, work, &["netlist.json", counts], check, || {
        // The script appends to the counts.
        if counted.exists() {
            std::fs::remove_file(&counted).map_err(BoardError::file(&counted))?;
        }
        run_strictly(&toolbox.tools.yosys, &["-p", &script], work, "synthesis.log")
    })?;
    readings::counts(&counted)
}

/// Packs the fastest seed if the clock is met, and writes the report in either case.
fn finish(
    request: &Request,
    tools: &Tools,
    work: &Path,
    described: Report,
    missed: Vec<Attempt>,
    placed: &Placed,
) -> Result<Report, BoardError> {
    let picked_seed = placed.fastest().filter(|_| placed.is_met());
    let bitstream = picked_seed.map(|seed| pack(request, tools, work, seed)).transpose()?;
    let report = Report { picked_seed, bitstream, missed, ..described };
    let file = request.out.join(REPORT);
    if let Err(error) = report.write(&file) {
        // A bitstream must not stay without its report. If it cannot be removed, the first error still says more.
        let _ = forget_earlier(request);
        return Err(error);
    }
    if report.met {
        return Ok(report);
    }
    if placed.core_is_met() {
        let (board, seeds) = (request.board.name, report.seeds.len());
        return Err(BoardError::PortTiming { board, seeds, median_mhz: placed.port_summary().median, report: file });
    }
    let median_mhz = report.fmax_mhz.median;
    Err(BoardError::Timing {
        board: request.board.name,
        clock_mhz: report.clock_mhz,
        seeds: report.seeds.len(),
        median_mhz,
        possible_mhz: request
            .board
            .clocks(request.board.most_mhz)
            .into_iter()
            .find(|&mhz| f64::from(mhz) <= median_mhz),
        report: file,
    })
}

/// The report without the bitstream and the clocks that were missed.
fn describe(request: &Request, placed: &Placed, tools: Versions) -> Report {
    let Placed { clock_mhz, cells, .. } = *placed;
    let (board, config) = (request.board, request.config);
    let (serial, network) = match request.link {
        BoardLink::Serial => (Some(serial(&board, clock_mhz)), None),
        BoardLink::Udp(parameters) => (None, board.ethernet.map(|port| network(parameters, port, placed))),
    };
    Report {
        board: board.name.into(),
        device: board.device.into(),
        date: date::today(),
        met: placed.is_met(),
        clock_mhz,
        fmax_mhz: placed.summary(),
        seeds: placed.seeds.clone(),
        picked_seed: None,
        missed: Vec::new(),
        configuration: config.name.into(),
        points: config.points,
        ring: config.ring,
        contexts: config.contexts,
        engines: config.engines,
        runs: request.has_runs,
        cells,
        serial,
        network,
        pll: board.pll(clock_mhz).map(dividers).unwrap_or_default(),
        tools,
        bitstream: None,
    }
}

fn serial(board: &Board, clock_mhz: u32) -> Serial {
    let link = board.link(clock_mhz);
    Serial {
        bridge: board.bridge.into(),
        bits_per_second: board.bridge_rate.min(link.max_rate()),
        fifo_bytes: link.fifo_bytes,
    }
}

fn network(UdpParameters { link, address, prefix, port }: UdpParameters, pins: Rgmii, placed: &Placed) -> Network {
    let mac: Vec<_> = link.mac.iter().map(|byte| format!("{byte:02x}")).collect();
    Network {
        phy: pins.phy.into(),
        ip: format!("{address}/{prefix}"),
        mac: mac.join(":"),
        udp_port: port,
        fifo_bytes: link.fifo_bytes,
        rgmii_delay: pins.delay,
        rgmii_clock_delay: pins.clock_delay,
        fmax_mhz: placed.port_summary(),
    }
}

/// Makes the bitstream from a placed seed.
fn pack(request: &Request, tools: &Tools, work: &Path, seed: u32) -> Result<Bitstream, BoardError> {
    let file = bitstream(request);
    let config = format!("seed-{seed}.config");
    run_strictly(&tools.ecppack, &["--compress", "--input", &config, "--bit", &file], work, "pack.log")?;
    let packed: PathBuf = work.join(&file);
    let bytes = std::fs::read(&packed).map_err(BoardError::file(&packed))?;
    if bytes.is_empty() {
        return Err(BoardError::form(&packed, "it is empty"));
    }
    let to = request.out.join(&file);
    replace(&to, &bytes).map_err(BoardError::file(&to))?;
    Ok(Bitstream { file, bytes: bytes.len() as u64, sha256: hexadecimal(Sha256::digest(&bytes)) })
}
