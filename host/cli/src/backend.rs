//! Back ends of the command: from arguments to devices.

use std::num::{NonZeroU32, NonZeroUsize};
use std::time::Duration;

use incircle::pcie::{CardAddress, CardRegisters, PcieTransport};
use incircle::serial::{Address, SerialTransport};
use incircle::{Device, DeviceAddress, Error, MAX_POINTS};
use incircle_protocol::{Config, Greeting, CORE_COORD_BITS, LARGE, NAMED};

use crate::arguments::{BackendArguments, ConfigName, GridArguments, JobArguments};
use crate::failure::{failure_of, Exit, Failure};
use crate::lattice::{Laid, Numbers};
use crate::trace::Trace;

/// Bits of a coordinate of a model whose address names none, and the most that a model can have.
pub const MODEL_COORD_BITS: u32 = 31;
/// The smallest capacity that a model is made with.
const LEAST_CAPACITY: usize = 4;

/// Time for greeting a board, opening its session and finding a rate. A slow link counts this time more slowly.
const CONNECT_TIMEOUT: Duration = Duration::from_secs(12);

/// A board behind a serial line.
#[derive(Clone, Copy)]
pub struct Board {
    /// The answer of the board to a greeting.
    pub greeting: Greeting,
    /// The rate of the line, in bits per second.
    pub rate: u32,
    /// The factor by which a simulated board is slower than a real one; 1 for a real one.
    pub slow: u32,
}

impl Board {
    /// Seconds that a job of `points` points takes on the line alone. For each point one word goes to the board and six
    /// come back, of 40 bits each.
    pub fn seconds(&self, points: usize) -> f64 {
        let bits = 7.0 * 40.0 * points as f64;
        bits * f64::from(self.slow) / f64::from(self.rate.max(1))
    }
}

/// An opened back end.
pub struct Backend {
    /// The device that does the jobs.
    pub device: Device,
    /// The name in reports: `cpu`, `model`, `clock`, `sim`, `serial`, `udp` or `pcie`.
    pub name: &'static str,
    /// The configuration of a core in simulation, which is our choice.
    pub config: Option<Config>,
    /// The board, if the back end is one.
    pub board: Option<Board>,
    /// The registers of the card, if the back end is one.
    pub card: Option<CardRegisters>,
    /// What the address says about the core, if the back end is one in simulation.
    addressed: Addressed,
}

/// The choices of a simulated core that stand in the address, so that no argument may make them again.
#[derive(Clone, Copy, Default)]
struct Addressed {
    /// Whether the address names the configuration.
    has_config: bool,
    /// Whether the address asks for a core with runs.
    needs_runs: bool,
}

impl Addressed {
    fn of(address: &DeviceAddress) -> Self {
        match address {
            DeviceAddress::Clock { config } => Self { has_config: config.is_some(), needs_runs: false },
            DeviceAddress::Sim { config, living, .. } => {
                Self { has_config: config.is_some(), needs_runs: *living == Some(true) }
            }
            _ => Self::default(),
        }
    }
}

impl Backend {
    /// Whether the back end counts clock cycles.
    pub fn has_clock(&self) -> bool {
        self.config.is_some() || self.board.is_some() || self.card.is_some_and(|card| card.clocks > 0)
    }

    /// Whether the back end takes whole numbers of 64 bits and doubles as they are.
    pub fn takes_all_numbers(&self) -> bool {
        self.name == "cpu"
    }

    /// Rejects options that the back end cannot honour: more contexts than the core has, and `--order` or `--contexts`
    /// on `cpu`. The library checks the rest.
    pub fn check_job(&self, job: &JobArguments) -> Result<(), Failure> {
        if self.name == "cpu" && job.wants_insertion() {
            return Err(Failure::usage(
                "--order and --contexts are for back ends that insert points one by one, which cpu does not: \
                 leave them out, or use --backend model",
            ));
        }
        self.check_contexts(job.contexts)
    }

    fn check_contexts(&self, asked: Option<u32>) -> Result<(), Failure> {
        let (Some(asked), Some(config)) = (asked, self.config) else {
            return Ok(());
        };
        if asked <= config.contexts {
            return Ok(());
        }
        let Addressed { has_config, needs_runs } = self.addressed;
        let possible = || usual().filter(|&config| !needs_runs || has_simulated_runs(config));
        let all: Vec<_> = possible().map(|config| format!("{} {}", config.name, config.contexts)).collect();
        let all = all.join(", ");
        let advice = match possible().find(|config| config.contexts >= asked) {
            None => String::new(),
            Some(larger) if has_config => format!(", or config={} in the address of the back end", larger.name),
            Some(larger) => format!(" or --config {}", larger.name),
        };
        Err(Failure::usage(format!(
            "{asked} contexts are more than the {} of the core {} ({all}): choose fewer{advice}",
            config.contexts, config.name
        )))
    }
}

/// The configurations that the command chooses by itself, smallest first. A chip of several engines must be asked for:
/// it is meant for batches and parts, and an engine holds fewer points than a core of the same size.
fn usual() -> impl Iterator<Item = Config> {
    NAMED.into_iter().filter(|config| config.engines == 1)
}

/// A back end that is not open yet.
#[derive(Clone, Debug)]
pub struct Choice {
    /// The address of the device.
    pub address: DeviceAddress,
    /// Threads of the CPU triangulator, if they are chosen.
    threads: Option<NonZeroU32>,
    /// The configuration of the core, if one is chosen.
    pub config: Option<Config>,
    /// Whether a simulated core has runs, if that is chosen.
    living: Option<bool>,
    /// Bits of a coordinate, of the grid and of a model.
    pub coord_bits: u32,
}

impl Choice {
    /// The back end of the arguments, of which there is at most one, or else the one at the address `default`.
    /// Coordinates have the bits of `--coord-bits` or of the address, or else [`CORE_COORD_BITS`]. An address and an
    /// argument may not choose the same thing.
    pub fn of(arguments: &BackendArguments, coord_bits: Option<u32>, default: &str) -> Result<Self, Failure> {
        let address = arguments.or(default)?;
        let coord_bits = once(bits_in(&address), coord_bits, "coord-bits")?.unwrap_or(CORE_COORD_BITS);
        let asked = arguments.config.map(ConfigName::config);
        let (threads, config) = match address {
            DeviceAddress::Cpu { threads } => (once(threads, arguments.threads, "threads")?, asked),
            DeviceAddress::Clock { config } | DeviceAddress::Sim { config, .. } => {
                (arguments.threads, once(config, asked, "config")?)
            }
            _ => (arguments.threads, asked),
        };
        let living = match address {
            DeviceAddress::Sim { living, .. } => living,
            _ => None,
        };
        let choice = Self { address, threads, config, living, coord_bits };
        if choice.threads.is_some() && !matches!(choice.address, DeviceAddress::Cpu { .. }) {
            return Err(Failure::usage("--threads is for the CPU triangulator: it needs --backend cpu"));
        }
        if choice.config.is_some() && !choice.is_core() {
            return Err(Failure::usage(
                "--config chooses a configuration of the core: it needs --backend clock or --backend sim",
            ));
        }
        Ok(choice)
    }

    /// The threads of the CPU triangulator; 1 for any other back end.
    pub fn cpu_threads(&self) -> NonZeroUsize {
        let chosen = self.threads.and_then(|threads| NonZeroUsize::new(threads.get() as usize));
        match self.address {
            DeviceAddress::Cpu { .. } => {
                chosen.or_else(|| std::thread::available_parallelism().ok()).unwrap_or(NonZeroUsize::MIN)
            }
            _ => NonZeroUsize::MIN,
        }
    }

    /// The same back end, with this number of threads if it is the CPU triangulator.
    pub fn with_cpu_threads(self, threads: NonZeroUsize) -> Self {
        let threads = u32::try_from(threads.get()).ok().and_then(NonZeroU32::new);
        match self.address {
            DeviceAddress::Cpu { .. } => Self { threads, ..self },
            _ => self,
        }
    }

    /// The same back end for a mesh that lives, of up to `room` points. A simulated core then has runs, if a core with
    /// runs was built that the address and the points allow.
    pub fn with_runs_for(self, room: usize) -> Result<Self, Failure> {
        if !matches!(self.address, DeviceAddress::Sim { .. }) || self.living.is_some() {
            return Ok(self);
        }
        let living = Self { living: Some(true), ..self.clone() };
        let config = config_for(&living, Some(room))?;
        let is_possible = has_simulated_runs(config) && (self.config.is_some() || config.points as usize >= room);
        Ok(if is_possible { Self { config: Some(config), ..living } } else { self })
    }

    /// Whether the device takes the changes and the questions of a mesh that lives itself.
    pub fn has_runs(&self) -> bool {
        match self.address {
            DeviceAddress::Model { .. } | DeviceAddress::Clock { .. } => true,
            _ => self.living == Some(true),
        }
    }

    /// The back end for points of a file. Coordinates have the bits of `--coord-bits` or of the address. If neither
    /// names a number, they have [`MODEL_COORD_BITS`] in software and [`CORE_COORD_BITS`] in a core.
    pub fn for_points(arguments: &BackendArguments, grid: &GridArguments, default: &str) -> Result<Self, Failure> {
        let mut choice = Self::of(arguments, grid.checked()?.coord_bits, default)?;
        if choice.is_software() && bits_in(&choice.address).or(grid.coord_bits).is_none() {
            choice.coord_bits = MODEL_COORD_BITS;
        }
        Ok(choice)
    }

    /// Refuses points whose lattice the back end cannot hold. Boards and cards are asked only once they are open.
    pub fn check_lattice(&self, laid: &Laid<'_>) -> Result<(), Failure> {
        let is_known = self.is_core() || matches!(self.address, DeviceAddress::Model { .. });
        if is_known {
            laid.check_bits(self.coord_bits, self.address.name())
        } else {
            Ok(())
        }
    }

    /// Refuses more bits than a core has, if the back end is a core in simulation.
    pub fn check_bits(&self) -> Result<(), Failure> {
        if !self.is_core() || self.coord_bits <= CORE_COORD_BITS {
            return Ok(());
        }
        Err(Failure::new(
            Exit::Capacity,
            format!(
                "the core has coordinates of {CORE_COORD_BITS} bits, not {}: \
                 give --coord-bits {CORE_COORD_BITS} or --backend model",
                self.coord_bits
            ),
        ))
    }

    /// The number of points that the back end must hold for a job. For a core only distinct points count, because a
    /// core is small.
    pub fn room_for(&self, numbers: &Numbers<'_>) -> usize {
        match numbers {
            Numbers::Grid(points) if self.is_core() => count_distinct(points),
            _ => numbers.len(),
        }
    }

    /// Whether the back end is a core in simulation, whose configuration we choose.
    pub fn is_core(&self) -> bool {
        matches!(self.address, DeviceAddress::Clock { .. } | DeviceAddress::Sim { .. })
    }

    /// Whether the back end is software that is timed in seconds and not in cycles.
    pub fn is_software(&self) -> bool {
        matches!(self.address, DeviceAddress::Cpu { .. } | DeviceAddress::Model { .. })
    }
}

/// Bits of a coordinate, if the address chooses them.
fn bits_in(address: &DeviceAddress) -> Option<u32> {
    match address {
        &DeviceAddress::Model { coord_bits, .. } => coord_bits,
        _ => None,
    }
}

/// The choice that is made either in the address or by an argument; making it twice is an error.
fn once<T>(in_address: Option<T>, argument: Option<T>, name: &str) -> Result<Option<T>, Failure> {
    if in_address.is_some() && argument.is_some() {
        return Err(Failure::usage(format!("the address of the back end and --{name} both choose: leave one out")));
    }
    Ok(in_address.or(argument))
}

/// Opens the back end for jobs of up to `room` points, or, without that number, as large as possible.
///
/// For a model all points count, for a core distinct ones. A core in simulation has the chosen configuration, or else
/// the smallest one that holds the points, or else the largest. The waveform `trace` is of the back end `sim`. Greeting
/// a board takes no longer than `timeout`.
pub fn open_with_room(
    choice: &Choice,
    room: Option<usize>,
    trace: Option<Trace<'_>>,
    timeout: Option<Duration>,
) -> Result<Backend, Failure> {
    let (device, config) = match &choice.address {
        DeviceAddress::Serial(address) => return open_serial(address, timeout),
        DeviceAddress::Pcie(address) => return open_card(address),
        DeviceAddress::Cpu { .. } => (Ok(Device::cpu(choice.threads)), None),
        &DeviceAddress::Model { capacity, .. } => {
            (open_model(choice.coord_bits, capacity, room.unwrap_or(MAX_POINTS)), None)
        }
        DeviceAddress::Clock { .. } => {
            let config = config_for(choice, room)?;
            (Device::clock_model(config), Some(config))
        }
        DeviceAddress::Sim { .. } => {
            check_sim()?;
            let config = config_for(choice, room)?;
            (Ok(open_sim(config, choice.living == Some(true), trace)?), Some(config))
        }
        other => (Device::at(other), None),
    };
    let device = device.map_err(|error| failure_of(&error))?;
    let addressed = Addressed::of(&choice.address);
    Ok(Backend { device, name: choice.address.name(), config, board: None, card: None, addressed })
}

fn open_serial(address: &Address, timeout: Option<Duration>) -> Result<Backend, Failure> {
    let mut transport = SerialTransport::open(address).map_err(|error| failure_of(&error))?;
    let most = timeout.map_or(CONNECT_TIMEOUT, |timeout| CONNECT_TIMEOUT.min(timeout / address.slow.max(1)));
    transport.connect(most).map_err(|error| failure_of(&error))?;
    let rate = transport.rate();
    let board = transport.greeting().map(|&greeting| Board { greeting, rate, slow: address.slow });
    let device = Device::from_transport(Box::new(transport));
    Ok(Backend { device, name: "serial", config: None, board, card: None, addressed: Addressed::default() })
}

fn open_card(address: &CardAddress) -> Result<Backend, Failure> {
    let mut transport = PcieTransport::open(address).map_err(|error| failure_of(&error))?;
    let card = Some(transport.registers().map_err(|error| failure_of(&error))?);
    let device = Device::from_transport(Box::new(transport));
    Ok(Backend { device, name: "pcie", config: None, board: None, card, addressed: Addressed::default() })
}

/// Makes a model for `points` points, unless its address names a capacity.
fn open_model(coord_bits: u32, capacity: Option<u32>, points: usize) -> Result<Device, Error> {
    let enough = points.clamp(LEAST_CAPACITY, MAX_POINTS);
    Device::model(coord_bits, capacity.unwrap_or_else(|| u32::try_from(enough).unwrap_or(u32::MAX)))
}

/// Refuses the back end `sim` in a build without the core. The check comes before all checks of configurations, whose
/// advice would not help in such a build.
pub fn check_sim() -> Result<(), Failure> {
    if cfg!(feature = "sim") {
        return Ok(());
    }
    Err(Failure::usage(
        "this incircle was built without the simulated core: install Verilator and build it with \
         'cargo build --release --features sim', or use --backend clock",
    ))
}

#[cfg(not(feature = "sim"))]
fn open_sim(_: Config, _: bool, _: Option<Trace<'_>>) -> Result<Device, Failure> {
    check_sim().and(Err(Failure::usage("there is no simulated core in this build")))
}

#[cfg(feature = "sim")]
fn open_sim(config: Config, has_runs: bool, trace: Option<Trace<'_>>) -> Result<Device, Failure> {
    crate::sim_backend::open(config, has_runs, trace)
}

#[cfg(not(feature = "sim"))]
fn has_simulated_runs(_: Config) -> bool {
    false
}

/// Whether a simulated core of this configuration with runs was built.
#[cfg(feature = "sim")]
fn has_simulated_runs(config: Config) -> bool {
    incircle_sim::SimDevice::has_living(config)
}

/// The configuration for a job of `distinct` points: the chosen one, or else the smallest that holds the points, or
/// else the largest, which does the job in parts. If runs are chosen, only simulated cores with runs count. Fails if
/// the coordinates have more bits than any core takes.
fn config_for(choice: &Choice, distinct: Option<usize>) -> Result<Config, Failure> {
    choice.check_bits()?;
    let holds = |config: &Config| distinct.is_some_and(|distinct| config.points as usize >= distinct);
    let possible = || usual().filter(|&config| choice.living != Some(true) || has_simulated_runs(config));
    Ok(choice.config.or_else(|| possible().find(holds)).or_else(|| possible().last()).unwrap_or(LARGE))
}

/// The number of distinct points in a list.
pub fn count_distinct(points: &[incircle::Point]) -> usize {
    let mut sorted = points.to_vec();
    sorted.sort_unstable();
    sorted.dedup();
    sorted.len()
}
