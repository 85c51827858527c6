//! The options of the command.

use clap::{ArgGroup, Args, Parser, Subcommand, ValueEnum};
use incircle_hdl::board::sizes::{size_name, Family, FAMILIES, SIZES};
use incircle_hdl::board::{Board, Clock, Origin, BOARDS};
use incircle_hdl::top::UdpPins;
use incircle_hdl::udp::UdpParameters;
use incircle_protocol::{
    Config, UdpLinkConfig, BEAT_BITS, ENGINES, FULL, MAX_CONTEXTS, MAX_FIFO_BYTES, MAX_LINK_CLOCK_HZ, MAX_POINTS,
    MAX_RING, MIN_CONTEXTS, MIN_FIFO_BYTES, MIN_LINK_CLOCK_HZ, MIN_POINTS, MIN_RING, NAMED, SILENCE_MS, UDP_PORT,
};
use std::fmt::Display;
use std::net::Ipv4Addr;
use std::path::PathBuf;
use std::str::FromStr;

/// Export the incircle core to Verilog, make bitstreams for boards, and count cells in families of FPGAs.
#[derive(Parser)]
#[command(name = "incircle-hdl", version, after_help = "Example:\n  incircle-hdl export --config full -o core.v")]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

/// Clock of a core behind a serial link or a UDP link, in Hz, unless another is asked for.
const USUAL_CLOCK_HZ: u32 = 125_000_000;
/// Width of a beat of the stream link in bits, unless another is asked for.
const USUAL_BEAT_BITS: u32 = BEAT_BITS[0];

/// Bytes of the receive FIFO unless others are asked for.
pub(crate) const SERIAL_FIFO_BYTES: u32 = 4_096;
pub(crate) const UDP_FIFO_BYTES: u32 = 16_384;

#[derive(Subcommand)]
pub(crate) enum Command {
    /// Write the Verilog of the core or of a whole device.
    ///
    /// Without options the command renews the files in the repository, hdl/verilog/incircle_*.v.
    Export(ExportArguments),
    /// Make the bitstream of a board, and a report of its clock and its cells.
    ///
    /// The command exports the design, synthesises it, places and routes it with several seeds, and packs the fastest.
    /// The median of the seeds must meet the clock. The exit code is 0 only if there is a bitstream that meets its
    /// clock.
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
                  incircle-hdl export --points 2048 --contexts 12 --engines 2 -o chip.v\n  \
                  incircle-hdl export --config full --living -o living.v"
)]
pub(crate) struct ExportArguments {
    /// Configuration: tiny, small, full, large, dual or quad. Default: the ones that the repository holds.
    #[arg(long, value_parser = config)]
    pub(crate) config: Option<Config>,
    /// Number of points that a core of your own size holds, a power of two. Needs --contexts.
    #[arg(
        long,
        requires = "contexts",
        value_parser = whole_number::<u32>(MIN_POINTS, MAX_POINTS),
        allow_negative_numbers = true
    )]
    pub(crate) points: Option<u32>,
    /// Number of contexts of a core of your own size, that is, of insertions in progress at a time.
    #[arg(
        long,
        requires = "points",
        conflicts_with = "config",
        value_parser = whole_number::<u32>(MIN_CONTEXTS, MAX_CONTEXTS),
        allow_negative_numbers = true
    )]
    pub(crate) contexts: Option<u32>,
    /// Number of boundary edges that a context of a core of your own size keeps in its list.
    #[arg(
        long,
        default_value_t = FULL.ring,
        requires = "points",
        conflicts_with = "config",
        value_parser = whole_number::<u32>(MIN_RING, MAX_RING),
        allow_negative_numbers = true
    )]
    pub(crate) ring: u32,
    /// Number of engines of a chip of your own size, each a core with a memory of its own: 1, 2 or 4.
    #[arg(
        long,
        default_value_t = 1,
        requires = "points",
        conflicts_with = "config",
        value_parser = whole_number::<u32>(ENGINES[0], ENGINES[2]),
        allow_negative_numbers = true
    )]
    pub(crate) engines: u32,
    /// Give the core the commands for a mesh that lives: Locate, Interpolate, Nearest, InsertAs, Delete and
    /// Move. For cores of one engine, with at most 32 boundary edges in a list.
    #[arg(long, requires = "core_size")]
    pub(crate) living: bool,
    /// File to write; `-` is standard output. Needs --config or --points.
    #[arg(short, long, requires = "core_size")]
    pub(crate) out: Option<PathBuf>,
    /// Add the write port of the triangle memory to the ports, for simulation.
    #[arg(long, requires = "core_size")]
    pub(crate) probe: bool,
    /// Module to export: the core with its two streams of words, or the core behind a serial, stream or UDP link.
    #[arg(long, value_enum, default_value = "core", requires = "core_size")]
    pub(crate) top: TopName,
    /// Clock of the core behind a serial link or a UDP link, in Hz. Default: 125000000.
    #[arg(
        long,
        requires = "core_size",
        value_parser = whole_number::<u32>(MIN_LINK_CLOCK_HZ, MAX_LINK_CLOCK_HZ),
        allow_negative_numbers = true
    )]
    pub(crate) clock_hz: Option<u32>,
    /// Size of the receive FIFO of the serial link or the UDP link in bytes, a power of two. Default: 4096 for the
    /// serial link, 16384 for the UDP link.
    #[arg(
        long,
        requires = "core_size",
        value_parser = whole_number::<u32>(MIN_FIFO_BYTES, MAX_FIFO_BYTES),
        allow_negative_numbers = true
    )]
    pub(crate) fifo_bytes: Option<u32>,
    #[command(flatten)]
    pub(crate) network: NetworkArguments,
    #[command(flatten)]
    pub(crate) pins: PinArguments,
    /// Width of a beat of the stream link in bits: 64 or 128. Default: 64.
    #[arg(long, value_parser = beat_bits, requires = "core_size", allow_negative_numbers = true)]
    pub(crate) width: Option<u32>,
}

impl ExportArguments {
    /// The clock of the core behind a serial link or a UDP link, in Hz.
    pub(crate) fn clock_hz(&self) -> u32 {
        self.clock_hz.unwrap_or(USUAL_CLOCK_HZ)
    }

    /// The width of a beat of the stream link in bits.
    pub(crate) fn width(&self) -> u32 {
        self.width.unwrap_or(USUAL_BEAT_BITS)
    }

    /// Refuses the options of another module than the one that is exported, where they would change nothing.
    pub(crate) fn check_top(&self) -> Result<(), String> {
        use TopName::{Serial, Stream, Udp};
        let Self { network, pins, .. } = self;
        let given: [(bool, &str, &[TopName]); 8] = [
            (self.width.is_some(), "--width", &[Stream]),
            (self.clock_hz.is_some(), "--clock-hz", &[Serial, Udp]),
            (self.fifo_bytes.is_some(), "--fifo-bytes", &[Serial, Udp]),
            (network.ip.is_some(), "--ip", &[Udp]),
            (network.mac.is_some(), "--mac", &[Udp]),
            (network.udp_port.is_some(), "--udp-port", &[Udp]),
            (pins.rgmii_delay.is_some(), "--rgmii-delay", &[Udp]),
            (pins.rgmii_clock_delay.is_some(), "--rgmii-clock-delay", &[Udp]),
        ];
        for (is_given, option, tops) in given {
            if is_given && !tops.contains(&self.top) {
                let tops: Vec<_> = tops.iter().map(|top| format!("--top {}", top.name())).collect();
                let choose = if tops.len() == 1 { "it" } else { "one of them" };
                return Err(format!("{option} is for {}: choose {choose}, or leave out {option}", tops.join(" and ")));
            }
        }
        if matches!(pins.rgmii_delay, Some(UdpPins::Gmii)) && pins.rgmii_clock_delay.is_some() {
            return Err("--rgmii-clock-delay is for the pins of RGMII, and --rgmii-delay gmii makes those of GMII: \
                        leave out one of the two"
                .to_owned());
        }
        Ok(())
    }
}

/// The addresses of a device with a UDP link, unless others are asked for.
pub(crate) const USUAL_IP: (Ipv4Addr, u8) = (Ipv4Addr::new(192, 168, 1, 50), 24);
pub(crate) const USUAL_MAC: [u8; 6] = [0x02, 0x00, 0x00, 0x69, 0x43, 0x01];

#[derive(Args)]
pub(crate) struct NetworkArguments {
    /// IPv4 address of a device with a UDP link, and the number of bits of it that name the network.
    /// Default: 192.168.1.50/24.
    #[arg(long, value_name = "A.B.C.D/N", value_parser = network_address)]
    pub(crate) ip: Option<(Ipv4Addr, u8)>,
    /// Ethernet address of the device, which no other device of the network may have. Default: 02:00:00:69:43:01.
    #[arg(long, value_name = "MAC", value_parser = ethernet_address)]
    pub(crate) mac: Option<[u8; 6]>,
    /// UDP port at which the device listens. Default: 26947.
    #[arg(long, value_name = "PORT", value_parser = whole_number::<u16>(1, u16::MAX), allow_negative_numbers = true)]
    pub(crate) udp_port: Option<u16>,
}

impl NetworkArguments {
    /// Whether the user named any address.
    pub(crate) fn are_given(&self) -> bool {
        self.ip.is_some() || self.mac.is_some() || self.udp_port.is_some()
    }

    /// The parameters of a device with these addresses, a clock, and a FIFO of this size.
    pub(crate) fn parameters(&self, clock_hz: u32, fifo_bytes: u32) -> UdpParameters {
        let (address, prefix) = self.ip.unwrap_or(USUAL_IP);
        let mac = self.mac.unwrap_or(USUAL_MAC);
        let link = UdpLinkConfig { clock_hz, fifo_bytes, silence_ms: SILENCE_MS, mac };
        UdpParameters { link, address, prefix, port: self.udp_port.unwrap_or(UDP_PORT) }
    }
}

#[derive(Args)]
pub(crate) struct PinArguments {
    /// Taps of 25 ps by which an ECP5 delays the data of RGMII; or `gmii` for the pins of GMII, for simulation.
    /// Default: 0.
    #[arg(long, value_name = "TAPS", value_parser = udp_pins, allow_negative_numbers = true)]
    pub(crate) rgmii_delay: Option<UdpPins>,
    /// Taps of 25 ps by which an ECP5 delays the clock of RGMII to the PHY. Default: 0.
    #[arg(long, value_name = "TAPS", value_parser = taps, allow_negative_numbers = true)]
    pub(crate) rgmii_clock_delay: Option<u8>,
}

impl PinArguments {
    /// The pins that these options name.
    pub(crate) fn pins(&self) -> UdpPins {
        let clock_delay = self.rgmii_clock_delay.unwrap_or(0);
        match self.rgmii_delay {
            None => UdpPins::Rgmii { delay: 0, clock_delay },
            Some(UdpPins::Rgmii { delay, .. }) => UdpPins::Rgmii { delay, clock_delay },
            Some(UdpPins::Gmii) => UdpPins::Gmii,
        }
    }
}

/// The links that a board may have.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum LinkName {
    /// The serial line of the board
    Serial,
    /// The Ethernet port of a colorlight-i5 or ecpix-5
    Udp,
}

#[derive(Args)]
#[command(after_help = "Examples:\n  incircle-hdl board ulx3s-85f --out build/ulx3s-85f\n  \
                  incircle-hdl board ecpix-5 --link udp --ip 10.0.0.7/24 --mac 02:00:00:00:00:07 \
                  --out build/ecpix-5-udp")]
pub(crate) struct BoardArguments {
    /// Name of the board: ulx3s-85f, colorlight-i5 or ecpix-5.
    #[arg(
        value_parser = named_board,
        required_unless_present_any = ["all", "table"],
        conflicts_with_all = ["all", "table"]
    )]
    pub(crate) name: Option<Board>,
    /// Make a bitstream for every row of the table of boards, and for every Ethernet port. The folders are called BOARD
    /// for the board's first core, BOARD-CONFIGURATION for the others, and BOARD-udp for the first core behind
    /// Ethernet.
    #[arg(long, conflicts_with = "table")]
    pub(crate) all: bool,
    /// Write the tables in the documents again from the reports of the boards.
    #[arg(long, conflicts_with_all = ["out", "seeds", "config", "link", "clock", "system", "system_yosys", "renew"])]
    pub(crate) table: bool,
    /// Folder for the bitstream, report.json and the output of the tools.
    #[arg(short, long, required_unless_present = "table")]
    pub(crate) out: Option<PathBuf>,
    /// Number of seeds for the placer; their median must meet the clock.
    #[arg(long, default_value_t = 3, value_parser = clap::value_parser!(u32).range(1..=99))]
    pub(crate) seeds: u32,
    /// Configuration of the core. Default: the first core in the table of the board.
    #[arg(long, value_parser = config, conflicts_with = "all")]
    pub(crate) config: Option<Config>,
    /// Give the core the commands for a mesh that lives. For cores of one engine; no report of such a core is kept.
    #[arg(long, conflicts_with_all = ["all", "table", "renew"])]
    pub(crate) living: bool,
    /// Link between the core and its host.
    #[arg(long, value_enum, default_value = "serial", conflicts_with = "all")]
    pub(crate) link: LinkName,
    #[command(flatten)]
    pub(crate) network: NetworkArguments,
    /// Clock to try: a number of MHz; `usual`, the usual clock of the core behind its link; or `largest`, the largest
    /// clock that the board meets. Default: the usual clock, and lower ones while it is missed.
    #[arg(long, value_name = "MHZ", value_parser = clock)]
    pub(crate) clock: Option<Clock>,
    #[command(flatten)]
    pub(crate) tools: ToolArguments,
    /// Keep the report in the folder of the board, and renew the tables.
    #[arg(long)]
    pub(crate) renew: bool,
}

#[derive(Args)]
pub(crate) struct ToolArguments {
    /// Use yosys, nextpnr-ecp5 and ecppack from PATH instead of the pinned ones.
    #[arg(long)]
    pub(crate) system: bool,
    /// Use yosys from PATH, with the pinned nextpnr-ecp5 and ecppack.
    #[arg(long, conflicts_with = "system")]
    pub(crate) system_yosys: bool,
}

impl ToolArguments {
    /// The source of the tools that these options name.
    pub(crate) fn origin(&self) -> Origin {
        match (self.system, self.system_yosys) {
            (true, _) => Origin::System,
            (_, true) => Origin::SystemYosys,
            _ => Origin::Pinned,
        }
    }
}

#[derive(Args)]
#[command(after_help = "Example:\n  incircle-hdl sizes --out build/sizes --family nexus --cells")]
pub(crate) struct SizesArguments {
    /// Folder for sizes.json and the output of the tools.
    #[arg(short, long, required_unless_present = "table")]
    pub(crate) out: Option<PathBuf>,
    /// Core to measure, several with commas, such as `small` or `2048-points`. Default: all.
    #[arg(long, value_delimiter = ',', value_parser = size)]
    pub(crate) size: Vec<Config>,
    /// Family to synthesise for, several with commas. Default: all.
    #[arg(long, value_delimiter = ',', value_parser = family)]
    pub(crate) family: Vec<&'static Family>,
    /// Only count cells, and place nothing.
    #[arg(long)]
    pub(crate) cells: bool,
    #[command(flatten)]
    pub(crate) tools: ToolArguments,
    /// Take the figures over into hdl/sizes.json, and renew docs/sizes.md.
    #[arg(long)]
    pub(crate) renew: bool,
    /// Write docs/sizes.md again from hdl/sizes.json.
    #[arg(long, conflicts_with_all = ["out", "size", "family", "cells", "system", "system_yosys", "renew"])]
    pub(crate) table: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum TopName {
    /// The module incircle_core
    Core,
    /// The module incircle_serial_top
    Serial,
    /// The module incircle_stream_top
    Stream,
    /// The module incircle_udp_top
    Udp,
}

impl TopName {
    /// The name as the user writes it.
    fn name(self) -> &'static str {
        match self {
            Self::Core => "core",
            Self::Serial => "serial",
            Self::Stream => "stream",
            Self::Udp => "udp",
        }
    }
}

/// Parses a whole number. The sentence for anything else tells these bounds; a number outside them is left to the
/// checks of the design, which say more.
fn whole_number<N>(least: N, most: N) -> impl Fn(&str) -> Result<N, String> + Clone + Send + Sync + 'static
where
    N: FromStr + Copy + Display + Send + Sync + 'static,
{
    move |text| text.parse().map_err(|_| format!("write a whole number from {least} to {most}"))
}

fn taps(text: &str) -> Result<u8, String> {
    let taps = text.parse().ok().filter(|taps| *taps < 128);
    taps.ok_or_else(|| "write a number of taps from 0 to 127".into())
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
    taps(text).map(|delay| UdpPins::Rgmii { delay, clock_delay: 0 }).map_err(|told| format!("{told}, or gmii"))
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
