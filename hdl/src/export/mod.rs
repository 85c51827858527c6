//! Exports blocks, the core and whole devices to Verilog.

mod udp;

use std::fmt;

use incircle_protocol::{Config, ConfigError, LinkConfig, LinkConfigError, BEAT_BITS};
use rust_hdl_core::check_error::CheckError;
use rust_hdl_core::prelude::*;

use crate::cluster::{Dual, Quad};
use crate::serial::{SerialError, SerialLink};
use crate::stream::StreamLink;
use crate::top::{
    serial_wrapper, stream_wrapper, wrapper, ChipParts, Core, LivingCore, SerialTop, StreamTop, CORE_NAME,
    SERIAL_TOP_NAME, STREAM_TOP_NAME,
};
use crate::udp::UdpError;

pub use udp::{udp_device, udp_link, udp_top, udp_top_with_runs};

/// The reason why a design cannot become Verilog.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ExportError {
    /// Signals that nothing drives.
    OpenSignals(Vec<String>),
    /// Signals that are used before they are assigned, or that depend on themselves.
    LogicLoops(Vec<String>),
    /// Inputs that the block itself drives.
    DrivenInputs(Vec<String>),
    /// A parameter with which no core can be built.
    Config(ConfigError),
    /// A parameter with which no serial link can be built.
    Link(LinkConfigError),
    /// A parameter with which no UDP link can be built.
    Udp(UdpError),
    /// A width of beats with which no stream link can be built.
    BeatBits(u32),
}

impl fmt::Display for ExportError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (names, fault, remedy) = match self {
            Self::Config(error) => return error.fmt(f),
            Self::Link(error) => return error.fmt(f),
            Self::Udp(error) => return error.fmt(f),
            Self::BeatBits(given) => {
                let [narrow, wide] = BEAT_BITS;
                return write!(f, "a beat of a stream has {narrow} or {wide} bits, not {given}: choose one of them");
            }
            Self::OpenSignals(names) => (names, "are driven by nothing", "assign or connect each of them"),
            Self::LogicLoops(names) => (names, "are read before they are assigned", "assign them first"),
            Self::DrivenInputs(names) => (names, "are inputs that their own block assigns", "assign them one level up"),
        };
        write!(f, "{} signals {fault} ({}): {remedy}", names.len(), names.join(", "))
    }
}

impl std::error::Error for ExportError {}

impl From<ConfigError> for ExportError {
    fn from(error: ConfigError) -> Self {
        Self::Config(error)
    }
}

impl From<SerialError> for ExportError {
    fn from(error: SerialError) -> Self {
        match error {
            SerialError::Core(error) => Self::Config(error),
            SerialError::Link(error) => Self::Link(error),
        }
    }
}

impl From<UdpError> for ExportError {
    fn from(error: UdpError) -> Self {
        match error {
            UdpError::Core(error) => Self::Config(error),
            error => Self::Udp(error),
        }
    }
}

impl From<CheckError> for ExportError {
    fn from(error: CheckError) -> Self {
        let names = |paths: Vec<rust_hdl_core::check_error::PathedName>| {
            let mut names: Vec<_> =
                paths.into_iter().map(|signal| format!("{}${}", signal.path, signal.name)).collect();
            names.sort();
            names
        };
        match error {
            CheckError::OpenSignal(open) => Self::OpenSignals(names(open.into_values().collect())),
            CheckError::LogicLoops(loops) => Self::LogicLoops(names(loops)),
            CheckError::WritesToInputs(inputs) => Self::DrivenInputs(names(inputs)),
        }
    }
}

/// The Verilog of a block whose root module is called `name`.
///
/// The caller must have called `connect_all` on the block. The text makes undeclared nets errors (`default_nettype
/// none`), because synthesis would otherwise invent them.
///
/// # Errors
/// If a signal is open, in a loop, or an input is driven from inside.
pub fn verilog<U: Block>(uut: &U, name: &str) -> Result<String, ExportError> {
    check_all(uut)?;
    let mut modules = ModuleDefines::default();
    uut.accept(name, &mut modules);
    Ok(format!("`default_nettype none\n{}\n`default_nettype wire\n", modules.defines()))
}

/// The whole Verilog of a configuration: the core, or several engines between two streams, and the ANSI wrapper
/// [`CORE_NAME`](crate::top::CORE_NAME) around it.
///
/// `with_probe` adds the write port of the triangle memory to the wrapper's ports, for simulation.
///
/// # Errors
/// If a parameter is out of range, or the design is not fit for export.
pub fn core(config: Config, with_probe: bool) -> Result<String, ExportError> {
    on_large_stack(|| {
        let inside = format!("{CORE_NAME}_logic");
        Ok(format!("{}{}", engines(config, &inside)?, wrapper(&inside, config.engines, with_probe)))
    })
}

/// The whole Verilog of a core of one engine with runs, which answers questions about its mesh and changes it: the
/// core, and the ANSI wrapper [`CORE_NAME`](crate::top::CORE_NAME) around it.
///
/// `with_probe` adds the write port of the triangle memory to the wrapper's ports, for simulation.
///
/// # Errors
/// If a parameter is out of range, or the design is not fit for export.
pub fn core_with_runs(config: Config, with_probe: bool) -> Result<String, ExportError> {
    on_large_stack(|| {
        let inside = format!("{CORE_NAME}_logic");
        Ok(format!("{}{}", connected(LivingCore::new(config)?, &inside)?, wrapper(&inside, config.engines, with_probe)))
    })
}

/// The Verilog of the engines of a configuration, with the root module `name`.
fn engines(config: Config, name: &str) -> Result<String, ExportError> {
    match config.check()?.engines {
        1 => connected(Core::new(config)?, name),
        2 => connected(Dual::new(config)?, name),
        _ => connected(Quad::new(config)?, name),
    }
}

/// The whole Verilog of a core, or of a chip of several engines, behind a serial link: the device, and around it the
/// ANSI wrapper [`SERIAL_TOP_NAME`](crate::top::SERIAL_TOP_NAME).
///
/// `with_probe` adds the write port of the triangle memory to the wrapper's ports, for simulation.
///
/// # Errors
/// If a parameter is out of range, or the design is not fit for export.
pub fn serial_top(config: Config, link: LinkConfig, with_probe: bool) -> Result<String, ExportError> {
    on_large_stack(|| {
        if config.engines > 1 {
            let names = [format!("{SERIAL_TOP_NAME}_link"), format!("{SERIAL_TOP_NAME}_engines")];
            let parts = ChipParts { link: &names[0], chip: &names[1], engines: config.engines, with_probe };
            let inside = serial_link(config, link, parts.link)? + &engines(config, parts.chip)?;
            return Ok(inside + &parts.serial());
        }
        let inside = format!("{SERIAL_TOP_NAME}_logic");
        let device = connected(SerialTop::new(config, link)?, &inside)?;
        Ok(format!("{device}{}", serial_wrapper(&inside, with_probe)))
    })
}

/// The whole Verilog of a core of one engine with runs behind a serial link: the link, the core, and around them
/// the ANSI wrapper [`SERIAL_TOP_NAME`](crate::top::SERIAL_TOP_NAME).
///
/// `with_probe` adds the write port of the triangle memory to the wrapper's ports, for simulation.
///
/// # Errors
/// If a parameter is out of range, or the design is not fit for export.
pub fn serial_top_with_runs(config: Config, link: LinkConfig, with_probe: bool) -> Result<String, ExportError> {
    on_large_stack(|| {
        let names = [format!("{SERIAL_TOP_NAME}_link"), format!("{SERIAL_TOP_NAME}_core")];
        let parts = ChipParts { link: &names[0], chip: &names[1], engines: 1, with_probe };
        let core = connected(LivingCore::new(config)?, parts.chip)?;
        let link = connected(SerialLink::with_runs(config, link)?, parts.link)?;
        Ok(link + &core + &parts.serial())
    })
}

/// The whole Verilog of a core behind a stream link with beats of 64 or 128 bits: the device, and around it
/// the ANSI wrapper [`STREAM_TOP_NAME`](crate::top::STREAM_TOP_NAME).
///
/// `with_probe` adds the write port of the triangle memory to the wrapper's ports, for simulation.
///
/// # Errors
/// If a parameter is out of range, or the design is not fit for export.
pub fn stream_top(config: Config, beat_bits: u32, with_probe: bool) -> Result<String, ExportError> {
    on_large_stack(|| {
        if config.engines > 1 {
            let names = [format!("{STREAM_TOP_NAME}_link"), format!("{STREAM_TOP_NAME}_engines")];
            let parts = ChipParts { link: &names[0], chip: &names[1], engines: config.engines, with_probe };
            let inside = stream_link(config, beat_bits, parts.link)? + &engines(config, parts.chip)?;
            return Ok(inside + &parts.stream(beat_bits as usize));
        }
        let inside = format!("{STREAM_TOP_NAME}_logic");
        let device = match beat_bits {
            64 => connected(StreamTop::<64, 8, 65>::new(config)?, &inside)?,
            128 => connected(StreamTop::<128, 16, 129>::new(config)?, &inside)?,
            _ => return Err(ExportError::BeatBits(beat_bits)),
        };
        Ok(format!("{device}{}", stream_wrapper(&inside, beat_bits as usize, with_probe)))
    })
}

/// The whole Verilog of a core of one engine with runs behind a stream link with beats of 64 or 128 bits: the link, the
/// core, and around them the ANSI wrapper [`STREAM_TOP_NAME`](crate::top::STREAM_TOP_NAME).
///
/// `with_probe` adds the write port of the triangle memory to the wrapper's ports, for simulation.
///
/// # Errors
/// If a parameter is out of range, or the design is not fit for export.
pub fn stream_top_with_runs(config: Config, beat_bits: u32, with_probe: bool) -> Result<String, ExportError> {
    on_large_stack(|| {
        let names = [format!("{STREAM_TOP_NAME}_link"), format!("{STREAM_TOP_NAME}_core")];
        let parts = ChipParts { link: &names[0], chip: &names[1], engines: 1, with_probe };
        let core = connected(LivingCore::new(config)?, parts.chip)?;
        let link = match beat_bits {
            64 => connected(StreamLink::<64, 8, 65>::with_runs(config)?, parts.link)?,
            128 => connected(StreamLink::<128, 16, 129>::with_runs(config)?, parts.link)?,
            _ => return Err(ExportError::BeatBits(beat_bits)),
        };
        Ok(link + &core + &parts.stream(beat_bits as usize))
    })
}

/// Runs `work` in a thread with a large stack: a device is built by value, in several copies of 300 kB an engine, too
/// much for the usual stack of a thread. If the system will not start a thread, the caller's stack must do.
fn on_large_stack<T: Send>(work: impl Fn() -> T + Sync) -> T {
    const STACK_BYTES: usize = 64 << 20;
    std::thread::scope(|scope| match std::thread::Builder::new().stack_size(STACK_BYTES).spawn_scoped(scope, &work) {
        Ok(thread) => thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
        Err(_) => work(),
    })
}

/// The Verilog of a serial link alone, with the root module `name`.
///
/// # Errors
/// The errors of [`serial_top`].
pub fn serial_link(config: Config, link: LinkConfig, name: &str) -> Result<String, ExportError> {
    let mut uut = SerialLink::new(config, link)?;
    uut.connect_all();
    verilog(&uut, name)
}

/// The Verilog of a stream link alone with beats of `beat_bits` bits, with the root module `name`.
///
/// # Errors
/// If a parameter is out of range, or the design is not fit for export.
pub fn stream_link(config: Config, beat_bits: u32, name: &str) -> Result<String, ExportError> {
    match beat_bits {
        64 => connected(StreamLink::<64, 8, 65>::new(config)?, name),
        128 => connected(StreamLink::<128, 16, 129>::new(config)?, name),
        _ => Err(ExportError::BeatBits(beat_bits)),
    }
}

/// Connects a block and returns its Verilog.
fn connected<U: Block>(mut uut: U, name: &str) -> Result<String, ExportError> {
    uut.connect_all();
    verilog(&uut, name)
}
