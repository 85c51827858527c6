//! `incircle-sim`: a simulated board for programs that open serial ports, a simulated card for programs that open PCIe
//! cards, and a device on the network for programs that open UDP sockets. The program also lays out waveforms.

use std::error::Error;
use std::io::Write;
use std::net::SocketAddrV4;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::Arc;
use std::time::{Duration, Instant};

use clap::{Parser, Subcommand, ValueEnum};
use incircle_model::stream::{ModelCore, StreamModel};
use incircle_protocol::{Config, FULL, SMALL};
use incircle_sim::faults::FaultSpec;
use incircle_sim::network::{NetworkBoard, ADDRESS};
use incircle_sim::pcie::{Beats, Card, CardDirectory, CardFaultSpec, CardFigures, NullDevice, PinCard};
use incircle_sim::serial::{board_link, Board, PinBoard, QuickBoard};
use incircle_sim::serve::{
    serve, serve_network, serve_tap, Figures, NetworkFigures, NetworkService, Service, TapFigures,
};
use incircle_testkit::NetworkFaults;

/// Number of clocks of the trial run, which measures how slow the simulation is.
const TRIAL: u64 = 200_000;
/// Ratio by which the simulation may become slower than in its trial because other programs run, in halves.
const MARGIN_HALVES: f64 = 3.0;
/// Time between two checks whether the program must end.
const LOOK: Duration = Duration::from_millis(50);
/// Ratio of real time to simulated time of a board without bits.
const QUICK_SLOW: u32 = 50;

/// The incircle core on a simulated board or card, or on the network.
#[derive(Parser)]
#[command(version, after_help = "Example:\n  incircle-sim serve --link /tmp/board --config full")]
struct Arguments {
    #[command(subcommand)]
    command: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Put a board behind a pseudo-terminal, until SIGTERM or SIGINT ends the program.
    #[command(after_help = "Example:\n  incircle-sim serve --link /tmp/board")]
    Serve {
        /// Symbolic link to make, which leads to the terminal.
        #[arg(long, value_name = "PATH")]
        link: PathBuf,
        /// Core on the board.
        #[arg(long, value_enum, default_value = "small")]
        config: Core,
        /// Faults of the line, separated by commas, such as `ber=1e-5,drop-frame=0.01,seed=3`; `help=` lists them all.
        #[arg(long, value_name = "SPEC", default_value = "")]
        fault: FaultSpec,
        /// Leave out the bits of the line: run the model of the serial link around the Verilated core.
        #[arg(long)]
        fast: bool,
        /// Give the core runs, for a mesh that lives; only `small` is built with them.
        #[arg(long)]
        living: bool,
        /// Smallest ratio of real time to the board's time; by default it is measured, or 50 with `--fast`.
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
        slow: Option<u32>,
    },
    /// Put the files of a PCIe card into a directory, until SIGTERM or SIGINT ends the program.
    #[command(after_help = "Example:\n  incircle-sim serve-pcie --dir /tmp/card")]
    ServePcie {
        /// Directory for the files; made if it does not exist.
        #[arg(long, value_name = "DIR")]
        dir: PathBuf,
        /// Core on the card.
        #[arg(long, value_enum, default_value = "small")]
        config: Core,
        /// Faults of the card, separated by commas, such as `short-read=0.1,eio=4096,seed=3`; `help=` lists them all.
        #[arg(long, value_name = "SPEC", default_value = "")]
        fault: CardFaultSpec,
        /// Width of a beat in bits.
        #[arg(long, value_name = "BITS", default_value = "64")]
        #[arg(value_parser = clap::builder::PossibleValuesParser::new(["64", "128"]))]
        width: String,
        /// Leave out the pins: run the software model, which has one context and no clock.
        #[arg(long)]
        fast: bool,
        /// Serve a device that does nothing, to measure drivers: its read-outs are zeros.
        #[arg(long, conflicts_with = "fast")]
        null: bool,
        /// Take the core small with runs, for a mesh that lives, with beats of 64 bits.
        #[arg(long, conflicts_with_all = ["fast", "null"])]
        living: bool,
    },
    /// Write a layout for the viewer GTKWave beside a waveform of a core, with the names of states.
    #[command(after_help = "Example:\n  incircle-sim layout job.vcd && gtkwave job.gtkw")]
    Layout {
        /// Waveform, such as `incircle triangulate ... --backend sim --trace job.vcd` writes.
        #[arg(value_name = "FILE.vcd")]
        waveform: PathBuf,
    },
    /// Put a device on the network, until SIGTERM or SIGINT ends the program.
    #[command(after_help = "Example:\n  incircle-sim serve-udp")]
    ServeUdp {
        /// IPv4 address and UDP port to listen at; with port 0 the system chooses one.
        #[arg(long, value_name = "ADDRESS:PORT", default_value = "127.0.0.1:0")]
        listen: SocketAddrV4,
        /// Core of the device.
        #[arg(long, value_enum, default_value = "small")]
        config: Core,
        /// Faults of the network, separated by commas: chances loss=P, double=P, swap=P, flip=P of each datagram, and
        /// delay=MS, seed=N.
        #[arg(long, value_name = "SPEC", default_value = "")]
        fault: NetworkFaults,
        /// Leave out the pins: run the software model, which has one context and no clock. With `--living`, run the
        /// software model of the link around the Verilated core.
        #[arg(long)]
        fast: bool,
        /// Give the core runs, for a mesh that lives; only `small` is built with them.
        #[arg(long)]
        living: bool,
        /// Put the board behind this TAP device of Linux instead of a UDP port: the kernel's own ARP, ICMP and UDP talk
        /// to its pins.
        #[arg(long, value_name = "NAME", conflicts_with_all = ["listen", "fault", "fast"])]
        tap: Option<String>,
    },
}

#[derive(Clone, Copy, ValueEnum)]
enum Core {
    Small,
    Full,
}

/// The board behind a terminal.
#[derive(Clone, Copy, PartialEq, Eq)]
enum BoardKind {
    Pins,
    Quick,
}

/// The device behind the files of a card.
#[derive(Clone, Copy)]
enum CardKind {
    Pins,
    Living,
    Model,
    Null,
}

impl Core {
    fn config(self) -> Config {
        match self {
            Self::Small => SMALL,
            Self::Full => FULL,
        }
    }
}

fn main() -> ExitCode {
    let result = match Arguments::parse().command {
        Task::Layout { waveform } => write_layout(&waveform),
        Task::ServeUdp { config, living, tap: Some(tap), .. } => run_tap(config.config(), living, &tap),
        Task::ServeUdp { listen, config, fault, fast, living, tap: None } => {
            let (config, faults) = (config.config(), fault);
            run_network(NetworkService { listen, config, is_fast: fast, has_runs: living, faults })
        }
        Task::Serve { link, config, fault, fast, living, slow } => {
            let kind = if fast { BoardKind::Quick } else { BoardKind::Pins };
            run(config.config(), kind, living, Service { link, faults: fault, slow: slow.unwrap_or(0) })
        }
        Task::ServePcie { dir, config, fault, width, fast, null, living } => {
            let kind = if living {
                CardKind::Living
            } else if null {
                CardKind::Null
            } else if fast {
                CardKind::Model
            } else {
                CardKind::Pins
            };
            run_card(config.config(), &dir, &fault, if width == "128" { 128 } else { 64 }, kind)
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("incircle-sim: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run_network(service: NetworkService) -> Result<(), Box<dyn Error>> {
    let stops = stops()?;
    let what = match (service.is_fast, service.has_runs) {
        (true, false) => "the software model",
        (true, true) => "with runs, behind the software model of its link",
        (false, false) => "simulated at its pins",
        (false, true) => "with runs, simulated at its pins",
    };
    let ready = |address| {
        say_ready(&format!("an incircle device on the network, {}, {what}: open udp:{address}", service.config.name));
    };
    let NetworkFigures { to_device, to_host, faults } = serve_network(&service, &stops, ready)?;
    eprintln!("incircle-sim: {to_device} datagrams to the device, {to_host} to hosts, {faults} faults");
    Ok(())
}

fn run_tap(config: Config, has_runs: bool, tap: &str) -> Result<(), Box<dyn Error>> {
    let stops = stops()?;
    let runs = if has_runs { "with runs, " } else { "" };
    let ready = || {
        let what = "simulated at its pins behind the TAP device";
        let name = config.name;
        say_ready(&format!("an incircle device on the network, {name}, {runs}{what} {tap}: open udp:{ADDRESS}"));
    };
    let board = || if has_runs { NetworkBoard::living(config) } else { NetworkBoard::new(config) };
    let TapFigures { to_device, to_host } = serve_tap(tap, board, &stops, ready)?;
    eprintln!("incircle-sim: {to_device} frames to the device, {to_host} to the kernel");
    Ok(())
}

fn write_layout(waveform: &Path) -> Result<(), Box<dyn Error>> {
    for path in incircle_sim::waves::write_layout(waveform)? {
        eprintln!("incircle-sim: wrote {}", path.display());
    }
    Ok(())
}

/// A flag that SIGTERM and SIGINT set.
fn stops() -> Result<Arc<AtomicBool>, ctrlc::Error> {
    let stops = Arc::new(AtomicBool::new(false));
    let raised = Arc::clone(&stops);
    ctrlc::set_handler(move || raised.store(true, Ordering::Relaxed))?;
    Ok(stops)
}

/// Prints that all is ready. A program that waits for this line reads it through a pipe. If the pipe is closed by now,
/// the service goes on all the same.
fn say_ready(line: &str) {
    let mut out = std::io::stdout();
    let _ = writeln!(out, "ready: {line}").and_then(|()| out.flush());
}

fn run_card(
    config: Config,
    directory: &Path,
    faults: &CardFaultSpec,
    beat_bits: u32,
    kind: CardKind,
) -> Result<(), Box<dyn Error>> {
    let stops = stops()?;
    let (device, what): (Box<dyn Beats>, _) = match kind {
        CardKind::Pins => (Box::new(PinCard::new(config, beat_bits)?), "simulated at its pins"),
        CardKind::Living => (Box::new(PinCard::living(config, beat_bits)?), "with runs, simulated at its pins"),
        CardKind::Model => (Box::new(StreamModel::new(ModelCore::of(config)?, beat_bits)), "the software model"),
        CardKind::Null => (Box::new(NullDevice::new(config, beat_bits)), "a device that does nothing"),
    };
    let card = Arc::new(Card::new(device, faults));
    let mounted = CardDirectory::mount(directory, Arc::clone(&card))?;
    let path = directory.display();
    say_ready(&format!(
        "{path} has an incircle card, {}, beats of {beat_bits} bits, {what}: open pcie:{path}",
        config.name
    ));
    while !stops.load(Ordering::Relaxed) {
        std::thread::sleep(LOOK);
    }
    drop(mounted);
    let CardFigures { to_card, to_host, faults } = card.figures();
    eprintln!("incircle-sim: {to_card} bytes to the card, {to_host} to the host, {faults} faults");
    Ok(())
}

/// Serves a board. A ratio of 0 in the service is not chosen yet.
fn run(config: Config, kind: BoardKind, has_runs: bool, mut service: Service) -> Result<(), Box<dyn Error>> {
    let stops = stops()?;
    let link = board_link(config);
    let (mut board, what): (Box<dyn Board>, _) = match (kind, has_runs) {
        (BoardKind::Pins, false) => (Box::new(PinBoard::new(config)?), "at its pins"),
        (BoardKind::Pins, true) => (Box::new(PinBoard::living(config)?), "with runs and at its pins"),
        (BoardKind::Quick, false) => (Box::new(QuickBoard::new(config, link)?), "without the bits of its line"),
        (BoardKind::Quick, true) => {
            (Box::new(QuickBoard::living(config, link)?), "with runs and without the bits of its line")
        }
    };
    if service.slow == 0 {
        service.slow = if kind == BoardKind::Pins { trial(board.as_mut()) } else { QUICK_SLOW };
    }
    let slow = service.slow;
    let ready = || {
        let path = service.link.display();
        say_ready(&format!(
            "{path} is an incircle board, {}, {} MHz, simulated {what}, {slow} times slower than real: open \
             serial:{path}?slow={slow}",
            config.name,
            board_link(config).clock_hz / 1_000_000,
        ));
    };
    let figures = serve(board.as_mut(), &service, &stops, ready)?;
    report(&figures);
    Ok(())
}

/// Ratio of real time to simulated time on this machine, with a margin, rounded up to a number that is easy to type.
fn trial(board: &mut dyn Board) -> u32 {
    let begun = Instant::now();
    board.run(TRIAL);
    let simulated = TRIAL as f64 / f64::from(board.link().clock_hz);
    let slow = begun.elapsed().as_secs_f64() / simulated * MARGIN_HALVES / 2.0;
    [10, 20, 50, 100, 150, 200, 300, 500, 1000, 2000, 5000]
        .into_iter()
        .find(|&round| f64::from(round) >= slow)
        .unwrap_or(10_000)
}

/// Prints the figures of a service on standard error, for a human reader.
fn report(figures: &Figures) {
    let Figures { to_board, to_host, faults, slow_down } = figures;
    let slow_down =
        slow_down.map_or_else(|| "never at work".to_owned(), |slow| format!("{slow:.0} times slower than real"));
    eprintln!("incircle-sim: {to_board} bytes to the board, {to_host} to the host, {faults} faults, {slow_down}");
}
