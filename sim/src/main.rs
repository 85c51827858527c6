//! `incircle-sim`: a simulated board for programs that open serial ports.

use std::error::Error;
use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::Arc;
use std::time::Instant;

use clap::{Parser, Subcommand, ValueEnum};
use incircle_protocol::{Config, FULL, SMALL};
use incircle_sim::faults::FaultSpec;
use incircle_sim::serial::{board_link, Board, PinBoard, QuickBoard};
use incircle_sim::serve::{serve, Figures, Service};

/// Clocks that are run to learn how slow the simulation is.
const TRIAL: u64 = 200_000;
/// How much slower than at its trial the simulation may become, for other programs run as well: in halves.
const MARGIN_HALVES: f64 = 3.0;
/// How slow a board without bits is run.
const QUICK_SLOW: u32 = 50;

/// The incircle core on a simulated board.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    #[command(subcommand)]
    command: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Puts a board behind a pseudo-terminal, until the program is ended by SIGTERM or SIGINT.
    Serve {
        /// The symbolic link that is to lead to the terminal.
        #[arg(long, value_name = "PATH")]
        link: PathBuf,
        /// The core on the board.
        #[arg(long, value_enum, default_value = "small")]
        config: Core,
        /// Faults of the line, separated by commas, such as `ber=1e-5,drop-frame=0.01,seed=3`; `help=` tells all.
        #[arg(long, value_name = "SPEC", default_value = "")]
        fault: FaultSpec,
        /// Skips the bits of the line: the model of the link around the Verilated core.
        #[arg(long)]
        fast: bool,
        /// Real time over the board's time, at least; else it is measured.
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100_000))]
        slow: Option<u32>,
    },
}

#[derive(Clone, Copy, ValueEnum)]
enum Core {
    Small,
    Full,
}

fn main() -> ExitCode {
    let Task::Serve { link, config, fault, fast, slow } = Arguments::parse().command;
    let config = match config {
        Core::Small => SMALL,
        Core::Full => FULL,
    };
    match run(config, link, fault, fast, slow) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("incircle-sim: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(
    config: Config,
    link: PathBuf,
    faults: FaultSpec,
    is_quick: bool,
    slow: Option<u32>,
) -> Result<(), Box<dyn Error>> {
    let stops = Arc::new(AtomicBool::new(false));
    let raised = Arc::clone(&stops);
    ctrlc::set_handler(move || raised.store(true, Ordering::Relaxed))?;
    let (mut board, what): (Box<dyn Board>, _) = if is_quick {
        (Box::new(QuickBoard::new(config, board_link(config))?), "without the bits of its line")
    } else {
        (Box::new(PinBoard::new(config)?), "at its pins")
    };
    let slow = slow.unwrap_or_else(|| if is_quick { QUICK_SLOW } else { trial(board.as_mut()) });
    let service = Service { link, faults, slow };
    let ready = || {
        let path = service.link.display();
        let said = writeln!(
            std::io::stdout(),
            "ready: {path} is an incircle board, {}, {} MHz, simulated {what}, {slow} times slower than real: open \
             serial:{path}?slow={slow}",
            config.name,
            board_link(config).clock_hz / 1_000_000,
        );
        // Whoever waits for the line reads it through a pipe. If nobody does any more, that is no reason to end.
        let _ = said.and_then(|()| std::io::stdout().flush());
    };
    let figures = serve(board.as_mut(), &service, &stops, ready)?;
    report(&figures);
    Ok(())
}

/// How slow the simulation is here and now, with a margin, rounded up to a number that is easily typed.
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

/// What was served, for a reader; scripts have no use for it.
fn report(figures: &Figures) {
    let Figures { to_board, to_host, faults, slow_down } = figures;
    let slow_down =
        slow_down.map_or_else(|| "never at work".to_owned(), |slow| format!("{slow:.0} times slower than real"));
    eprintln!("incircle-sim: {to_board} bytes to the board, {to_host} to the host, {faults} faults, {slow_down}");
}
