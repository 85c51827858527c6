//! The command of the hardware side: exports the core to Verilog, makes bitstreams for boards, and counts the cells of
//! cores in many families of FPGAs.

mod arguments;

use arguments::{
    Arguments, BoardArguments, Command, ExportArguments, LinkName, SizesArguments, TopName, SERIAL_FIFO_BYTES,
    UDP_FIFO_BYTES,
};
use clap::Parser;
use incircle_hdl::board::sizes::{self, Family, Sizes, SizesRequest, FAMILIES, SIZES};
use incircle_hdl::board::{self, Board, BoardError, BoardLink, Clock, Report, Request, BOARDS, MHZ};
use incircle_hdl::committed::{self, Top};
use incircle_protocol::{Config, LinkConfig, FULL, SILENCE_MS};
use std::io::Write;
use std::path::Path;
use std::process::ExitCode;

/// Writes the Verilog of one configuration, or renews the committed files.
fn export(arguments: ExportArguments) -> Result<(), committed::WriteError> {
    let (clock_hz, width) = (arguments.clock_hz(), arguments.width());
    let ExportArguments { config, points, contexts, ring, engines, living, out, probe, top, fifo_bytes, .. } =
        arguments;
    let own = points.zip(contexts).map(|(points, contexts)| Config { name: "custom", points, ring, contexts, engines });
    let serial = LinkConfig { clock_hz, fifo_bytes: fifo_bytes.unwrap_or(SERIAL_FIFO_BYTES), silence_ms: SILENCE_MS };
    let top = match top {
        TopName::Core if living => Top::Living,
        TopName::Serial if living => Top::LivingSerial(serial),
        TopName::Stream if living => Top::LivingStream(width),
        TopName::Core => Top::Core,
        TopName::Serial => Top::Serial(serial),
        TopName::Stream => Top::Stream(width),
        TopName::Udp => {
            let fifo_bytes = fifo_bytes.unwrap_or(UDP_FIFO_BYTES);
            let (parameters, pins) = (arguments.network.parameters(clock_hz, fifo_bytes), arguments.pins.pins());
            if living {
                Top::LivingUdp(parameters, pins)
            } else {
                Top::Udp(parameters, pins)
            }
        }
    };
    if let Some(config) = config.or(own) {
        return committed::write(config, top, probe, out);
    }
    for file in committed::renew()? {
        print(&file.display().to_string())
            .map_err(|error| committed::WriteError::File("standard output".into(), error))?;
    }
    Ok(())
}

/// Makes the bitstreams and tables that the user asked for, and returns the error of each board that failed.
fn boards(arguments: &BoardArguments) -> Vec<BoardError> {
    let mut errors = Vec::new();
    if let Some(out) = &arguments.out {
        match arguments.name {
            Some(board) => {
                let own = board.cores.first().map(|core| core.config);
                let config = arguments.config.or(own).unwrap_or(FULL);
                match link(arguments) {
                    Ok(link) => errors.extend(one_board(arguments, board, config, link, out).err()),
                    Err(error) => errors.push(error),
                }
            }
            None => BOARDS.into_iter().for_each(|board| errors.extend(all_cores(arguments, board, out))),
        }
    }
    if arguments.table || arguments.renew {
        errors.extend(board::renew_tables().err());
        errors.extend(sizes::renew_page().err());
    }
    errors
}

/// Makes all bitstreams of a board, each in a folder of its own, and returns the error of each that failed.
fn all_cores(arguments: &BoardArguments, board: Board, out: &Path) -> Vec<BoardError> {
    let mut made = Vec::new();
    for (place, core) in board.cores.iter().enumerate() {
        let rest = if place == 0 { String::new() } else { format!("-{}", core.config.name) };
        made.push((core.config, BoardLink::Serial, rest));
    }
    if let (Some(core), Some(_)) = (board.cores.first(), board.ethernet) {
        made.push((core.config, udp_link(arguments), "-udp".to_owned()));
    }
    let errors = made.into_iter().filter_map(|(config, link, rest)| {
        one_board(arguments, board, config, link, &out.join(format!("{}{rest}", board.name))).err()
    });
    errors.collect()
}

/// The link that the user asked for.
fn link(arguments: &BoardArguments) -> Result<BoardLink, BoardError> {
    match arguments.link {
        LinkName::Serial if arguments.network.are_given() => Err(BoardError::NoAddresses),
        LinkName::Serial => Ok(BoardLink::Serial),
        LinkName::Udp => Ok(udp_link(arguments)),
    }
}

/// The UDP link; the clock of the board that is made replaces the clock here.
fn udp_link(arguments: &BoardArguments) -> BoardLink {
    BoardLink::Udp(arguments.network.parameters(125 * MHZ, UDP_FIFO_BYTES))
}

fn one_board(
    arguments: &BoardArguments,
    board: Board,
    config: Config,
    link: BoardLink,
    out: &Path,
) -> Result<(), BoardError> {
    let runs = if arguments.living { " and runs" } else { "" };
    let say = |what: &str| complain(&format!("{}{} with {}{runs}: {what}", board.name, link.suffix(), config.name));
    let report_file = match board.report(config, link.suffix()) {
        None if arguments.renew => return Err(BoardError::NoReport { board: board.name, config: config.name }),
        file => file.filter(|_| arguments.renew),
    };
    let request = Request {
        board,
        config,
        has_runs: arguments.living,
        link,
        seeds: arguments.seeds,
        clock: arguments.clock.unwrap_or(Clock::UsualOrLess),
        out,
        tools: arguments.tools.origin(),
        say: &say,
    };
    let built = board::build(&request);
    if let Some(file) = report_file.filter(|_| matches!(built, Ok(_) | Err(BoardError::Timing { .. }))) {
        Report::read(&out.join("report.json"))?.write(&file)?;
    }
    let report = built?;
    if let Some(bitstream) = report.bitstream {
        let line = format!("{}: {} MHz, {}", out.join(bitstream.file).display(), report.clock_mhz, bitstream.sha256);
        print(&line).map_err(BoardError::Print)?;
    }
    Ok(())
}

/// Counts the cells of all sizes in the families that the user asked for; without a folder only renews the page.
fn measure_sizes(arguments: SizesArguments) -> Result<(), BoardError> {
    let Some(out) = &arguments.out else {
        return sizes::renew_page();
    };
    // What is named twice is measured once, in the order of the lists.
    let (sizes, families) = (&arguments.size, &arguments.family);
    let sizes = SIZES.into_iter().filter(|size| sizes.is_empty() || sizes.contains(size)).collect();
    let is_named = |family: &&Family| families.is_empty() || families.iter().any(|named| named.name == family.name);
    let families = FAMILIES.iter().filter(is_named).collect();
    let tools = arguments.tools.origin();
    let places = !arguments.cells && is_named(&&FAMILIES[0]);
    let measured = sizes::measure(&SizesRequest { sizes, families, places, out, tools, say: &complain })?;
    if arguments.renew {
        let figures = sizes::figures();
        let earlier = if figures.exists() { Sizes::read(&figures)? } else { Sizes::default() };
        earlier.renewed_by(measured).write(&figures)?;
        sizes::renew_page()?;
    }
    print(&out.join("sizes.json").display().to_string()).map_err(BoardError::Print)
}

/// Prints a line on standard output; a reader that closes the pipe early is no error.
fn print(line: &str) -> std::io::Result<()> {
    match writeln!(std::io::stdout(), "{line}") {
        Err(error) if error.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        written => written,
    }
}

/// Prints a line on standard error. If standard error is closed, nobody can be told.
fn complain(line: &str) {
    let _ = writeln!(std::io::stderr(), "{line}");
}

/// Exit code if the command was called wrongly, as for options that do not exist.
const WRONG_USE: u8 = 2;
/// Exit code if the tools cannot be fetched, so that a script can tell this case from a fault of the design.
const NO_TOOLS: u8 = 3;

fn main() -> ExitCode {
    match Arguments::parse().command {
        Command::Export(arguments) => {
            if let Err(told) = arguments.check_top() {
                complain(&format!("incircle-hdl: {told}"));
                return WRONG_USE.into();
            }
            match export(arguments) {
                Ok(()) => ExitCode::SUCCESS,
                Err(error) => {
                    complain(&format!("incircle-hdl: {error}"));
                    ExitCode::FAILURE
                }
            }
        }
        Command::Board(arguments) => exit_code(&boards(&arguments)),
        Command::Sizes(arguments) => exit_code(&measure_sizes(arguments).err().into_iter().collect::<Vec<_>>()),
    }
}

/// Tells the user the errors, and gives the exit code that the first of them calls for.
fn exit_code(errors: &[BoardError]) -> ExitCode {
    for error in errors {
        complain(&format!("incircle-hdl: {error}"));
    }
    match errors.first() {
        None => ExitCode::SUCCESS,
        Some(BoardError::Install(_)) => NO_TOOLS.into(),
        Some(_) => ExitCode::FAILURE,
    }
}
