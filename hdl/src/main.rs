//! The command of the hardware side: exports the core to Verilog, makes bitstreams for boards, and counts the cells of
//! cores in many families of FPGAs.

use clap::{ArgGroup, Args, Parser, Subcommand, ValueEnum};
use incircle_hdl::board::sizes::{self, size_name, Family, Sizes, SizesRequest, FAMILIES, SIZES};
use incircle_hdl::board::{self, Board, BoardError, Clock, Origin, Report, Request, BOARDS};
use incircle_hdl::committed::{self, Top};
use incircle_hdl::top::UdpPins;
use incircle_hdl::udp::UdpParameters;
use incircle_protocol::{Config, LinkConfig, UdpLinkConfig, BEAT_BITS, FULL, NAMED, SILENCE_MS, UDP_PORT};
use std::io::Write;
use std::net::Ipv4Addr;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Export the incircle core to Verilog, make bitstreams for boards, and count cells in families of FPGAs.
#[derive(Parser)]
#[command(name = "incircle-hdl", version, after_help = "Example:\n  incircle-hdl export --config full -o core.v")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

/// Bytes of the receive FIFO unless others are asked for.
const SERIAL_FIFO_BYTES: u32 = 4_096;
const UDP_FIFO_BYTES: u32 = 16_384;

#[derive(Subcommand)]
enum Command {
    /// Write the Verilog of the core or of a whole device.
    ///
    /// Without options the command renews the files in the repository, hdl/verilog/incircle_*.v.
    Export(ExportArguments),
    /// Make the bitstream of a board, and a report of its clock and its cells.
    ///
    /// The command exports the design, synthesises it, places and routes it with several seeds, and packs the fastest.
    /// The median of the seeds must meet the clock. The exit code is 0 only if there is a bitstream
    /// that meets its clock.
    Board(Box<BoardArguments>),
    /// Count the cells of cores of many sizes in many families of FPGAs.
    ///
    /// Each core is synthesised alone. If the ECP5 is among the families, cores that no board lists are placed on the
    /// ULX3S-85F with one seed if they fit. The figures go to sizes.json, beside those that are there. If a run is
    /// stopped, run the same command again: finished steps are not done again.
    Sizes(SizesArguments),
}

#[derive(Args)]
#[command(
    group = ArgGroup::new("core_size").args(["config", "points"]),
    after_help = "Examples:\n  incircle-hdl export --config full --top serial -o serial.v\n  \
                  incircle-hdl export --points 2048 --contexts 12 --engines 2 -o chip.v"
)]
struct ExportArguments {
    /// Configuration: tiny, small, full, large, dual or quad. Default: the ones that the repository holds.
    #[arg(long, value_parser = config)]
    config: Option<Config>,
    /// Number of points that a core of your own size holds, a power of two. Needs --contexts.
    #[arg(long, requires = "contexts")]
    points: Option<u32>,
    /// Number of contexts of a core of your own size, that is, of insertions in progress at a time.
    #[arg(long, requires = "points", conflicts_with = "config")]
    contexts: Option<u32>,
    /// Number of boundary edges that a context of a core of your own size keeps in its list.
    #[arg(long, default_value_t = FULL.ring, requires = "points", conflicts_with = "config")]
    ring: u32,
    /// Number of engines of a chip of your own size, each a core with a memory of its own: 1, 2 or 4.
    #[arg(long, default_value_t = 1, requires = "points", conflicts_with = "config")]
    engines: u32,
    /// File to write; `-` is standard output. Needs --config or --points.
    #[arg(short, long, requires = "core_size")]
    out: Option<PathBuf>,
    /// Add the write port of the triangle memory to the ports, for simulation.
    #[arg(long, requires = "core_size")]
    probe: bool,
    /// Module to export: the core with its two streams of words, or the core behind a serial, stream or UDP link.
    #[arg(long, value_enum, default_value = "core", requires = "core_size")]
    top: TopName,
    /// Clock of the core behind a serial link or a UDP link, in Hz.
    #[arg(long, default_value_t = 125_000_000, requires = "core_size")]
    clock_hz: u32,
    /// Size of the receive FIFO of the serial link or the UDP link in bytes, a power of two. Default: 4096 for the
    /// serial link, 16384 for the UDP link.
    #[arg(long, requires = "core_size")]
    fifo_bytes: Option<u32>,
    #[command(flatten)]
    network: NetworkArguments,
    /// Width of a beat of the stream link in bits: 64 or 128.
    #[arg(long, default_value_t = 64, value_parser = beat_bits, requires = "core_size")]
    width: u32,
}

#[derive(Args)]
struct NetworkArguments {
    /// IPv4 address of a device with a UDP link, and the number of bits of it that name the network.
    #[arg(long, value_name = "A.B.C.D/N", default_value = "192.168.1.50/24", value_parser = network_address)]
    ip: (Ipv4Addr, u8),
    /// Ethernet address of the device, which no other device of the network may have.
    #[arg(long, value_name = "MAC", default_value = "02:00:00:69:43:01", value_parser = ethernet_address)]
    mac: [u8; 6],
    /// UDP port at which the device listens.
    #[arg(long, value_name = "PORT", default_value_t = UDP_PORT)]
    udp_port: u16,
    /// Taps of 25 ps by which an ECP5 delays the data of RGMII; or `gmii` for the pins of GMII, for simulation.
    #[arg(long, value_name = "TAPS", default_value = "0", value_parser = udp_pins)]
    rgmii_delay: UdpPins,
}

#[derive(Args)]
#[command(after_help = "Example:\n  incircle-hdl board ulx3s-85f --out build/ulx3s-85f")]
struct BoardArguments {
    /// Name of the board: ulx3s-85f, colorlight-i5 or ecpix-5.
    #[arg(
        value_parser = named_board,
        required_unless_present_any = ["all", "table"],
        conflicts_with_all = ["all", "table"]
    )]
    name: Option<Board>,
    /// Make a bitstream for every row of the table of boards. The folders are called BOARD for the board's first core,
    /// and BOARD-CONFIGURATION for the others.
    #[arg(long, conflicts_with = "table")]
    all: bool,
    /// Write the tables in the documents again from the reports of the boards.
    #[arg(long, conflicts_with_all = ["out", "seeds", "config", "clock", "system", "system_yosys", "renew"])]
    table: bool,
    /// Folder for the bitstream, report.json and the output of the tools.
    #[arg(short, long, required_unless_present = "table")]
    out: Option<PathBuf>,
    /// Number of seeds for the placer; their median must meet the clock.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=99))]
    seeds: u32,
    /// Configuration of the core. Default: the first core in the table of the board.
    #[arg(long, value_parser = config, conflicts_with = "all")]
    config: Option<Config>,
    /// Clock to try: a number of MHz; `usual`, the usual clock of the core on the board; or `largest`, the largest
    /// clock that the board meets. Default: the usual clock, and lower ones while it is missed.
    #[arg(long, value_name = "MHZ", value_parser = clock)]
    clock: Option<Clock>,
    #[command(flatten)]
    tools: ToolArguments,
    /// Keep the report in the folder of the board, and renew the tables.
    #[arg(long)]
    renew: bool,
}

#[derive(Args)]
struct ToolArguments {
    /// Use yosys, nextpnr-ecp5 and ecppack from PATH instead of the pinned ones.
    #[arg(long)]
    system: bool,
    /// Use yosys from PATH, with the pinned nextpnr-ecp5 and ecppack.
    #[arg(long, conflicts_with = "system")]
    system_yosys: bool,
}

impl ToolArguments {
    /// The source of the tools that these options name.
    fn origin(&self) -> Origin {
        match (self.system, self.system_yosys) {
            (true, _) => Origin::System,
            (_, true) => Origin::SystemYosys,
            _ => Origin::Pinned,
        }
    }
}

#[derive(Args)]
#[command(after_help = "Example:\n  incircle-hdl sizes --out build/sizes --family nexus --cells")]
struct SizesArguments {
    /// Folder for sizes.json and the output of the tools.
    #[arg(short, long, required_unless_present = "table")]
    out: Option<PathBuf>,
    /// Core to measure, several with commas, such as `small` or `2048-points`. Default: all.
    #[arg(long, value_delimiter = ',', value_parser = size)]
    size: Vec<Config>,
    /// Family to synthesise for, several with commas. Default: all.
    #[arg(long, value_delimiter = ',', value_parser = family)]
    family: Vec<&'static Family>,
    /// Only count cells, and place nothing.
    #[arg(long)]
    cells: bool,
    #[command(flatten)]
    tools: ToolArguments,
    /// Take the figures over into hdl/sizes.json, and renew docs/sizes.md.
    #[arg(long)]
    renew: bool,
    /// Write docs/sizes.md again from hdl/sizes.json.
    #[arg(long, conflicts_with_all = ["out", "size", "family", "cells", "system", "system_yosys", "renew"])]
    table: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum TopName {
    /// The module incircle_core
    Core,
    /// The module incircle_serial_top
    Serial,
    /// The module incircle_stream_top
    Stream,
    /// The module incircle_udp_top
    Udp,
}

fn network_address(text: &str) -> Result<(Ipv4Addr, u8), String> {
    let parts = text.split_once('/').and_then(|(address, bits)| Some((address.parse().ok()?, bits.parse().ok()?)));
    parts.ok_or_else(|| "write an IPv4 address and the bits of its network, such as 192.168.1.50/24".into())
}

fn ethernet_address(text: &str) -> Result<[u8; 6], String> {
    let bytes = text.split(':').map(|byte| u8::from_str_radix(byte, 16).ok().filter(|_| byte.len() == 2));
    let bytes = bytes.collect::<Option<Vec<u8>>>().and_then(|bytes| <[u8; 6]>::try_from(bytes).ok());
    bytes.ok_or_else(|| "write an Ethernet address as six bytes in hexadecimal, such as 02:00:00:69:43:01".into())
}

fn udp_pins(text: &str) -> Result<UdpPins, String> {
    if text == "gmii" {
        return Ok(UdpPins::Gmii);
    }
    let delay = text.parse().ok().filter(|delay| *delay < 128);
    delay.map(|delay| UdpPins::Rgmii { delay }).ok_or_else(|| "write a number of taps from 0 to 127, or gmii".into())
}

fn config(name: &str) -> Result<Config, String> {
    let names = NAMED.map(|config| config.name).join(", ");
    Config::named(name).ok_or_else(|| format!("there is no configuration of this name: choose one of {names}"))
}

fn family(name: &str) -> Result<&'static Family, String> {
    let names: Vec<_> = FAMILIES.iter().map(|family| family.name).collect();
    Family::named(name).ok_or_else(|| format!("there is no family of this name: choose one of {}", names.join(", ")))
}

fn size(name: &str) -> Result<Config, String> {
    let names = SIZES.map(size_name).join(", ");
    let found = SIZES.into_iter().find(|&size| size_name(size) == name);
    found.ok_or_else(|| format!("there is no size of this name: choose one of {names}"))
}

fn beat_bits(number: &str) -> Result<u32, String> {
    let known = BEAT_BITS.into_iter().find(|bits| bits.to_string() == number);
    known.ok_or_else(|| format!("a beat of a stream has {} or {} bits: choose one of them", BEAT_BITS[0], BEAT_BITS[1]))
}

fn clock(text: &str) -> Result<Clock, String> {
    match text {
        "usual" => Ok(Clock::Usual),
        "largest" => Ok(Clock::Largest),
        number => number
            .parse()
            .map(Clock::Exactly)
            .map_err(|_| "a clock is a whole number of MHz, `usual` or `largest`".into()),
    }
}

fn named_board(name: &str) -> Result<Board, String> {
    let names = BOARDS.map(|board| board.name).join(", ");
    Board::named(name).ok_or_else(|| format!("there is no board of this name: choose one of {names}"))
}

/// Writes the Verilog of one configuration, or renews the committed files.
fn export(arguments: ExportArguments) -> Result<(), committed::WriteError> {
    let ExportArguments {
        config, points, contexts, ring, engines, out, probe, top, clock_hz, fifo_bytes, width, ..
    } = arguments;
    let NetworkArguments { ip: (address, prefix), mac, udp_port: port, rgmii_delay: pins } = arguments.network;
    let own = points.zip(contexts).map(|(points, contexts)| Config { name: "custom", points, ring, contexts, engines });
    let top = match top {
        TopName::Core => Top::Core,
        TopName::Serial => {
            let fifo_bytes = fifo_bytes.unwrap_or(SERIAL_FIFO_BYTES);
            Top::Serial(LinkConfig { clock_hz, fifo_bytes, silence_ms: SILENCE_MS })
        }
        TopName::Stream => Top::Stream(width),
        TopName::Udp => {
            let fifo_bytes = fifo_bytes.unwrap_or(UDP_FIFO_BYTES);
            let link = UdpLinkConfig { clock_hz, fifo_bytes, silence_ms: SILENCE_MS, mac };
            Top::Udp(UdpParameters { link, address, prefix, port }, pins)
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
                errors.extend(one_board(arguments, board, config, out).err());
            }
            None => {
                for board in BOARDS {
                    for (place, core) in board.cores.iter().enumerate() {
                        let folder = if place == 0 {
                            board.name.to_owned()
                        } else {
                            format!("{}-{}", board.name, core.config.name)
                        };
                        errors.extend(one_board(arguments, board, core.config, &out.join(folder)).err());
                    }
                }
            }
        }
    }
    if arguments.table || arguments.renew {
        errors.extend(board::renew_tables().err());
        errors.extend(sizes::renew_page().err());
    }
    errors
}

fn one_board(arguments: &BoardArguments, board: Board, config: Config, out: &Path) -> Result<(), BoardError> {
    let say = |what: &str| complain(&format!("{} with {}: {what}", board.name, config.name));
    let report_file = match board.report(config) {
        None if arguments.renew => return Err(BoardError::NoReport { board: board.name, config: config.name }),
        file => file.filter(|_| arguments.renew),
    };
    let request = Request {
        board,
        config,
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

/// Exit code if the tools cannot be fetched, so that a script can tell this case from a fault of the design.
const NO_TOOLS: u8 = 3;

fn main() -> ExitCode {
    match Arguments::parse().command {
        Command::Export(arguments) => match export(arguments) {
            Ok(()) => ExitCode::SUCCESS,
            Err(error) => {
                complain(&format!("incircle-hdl: {error}"));
                ExitCode::FAILURE
            }
        },
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
