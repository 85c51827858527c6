//! Measures the cost of the PCIe driver itself: whole jobs against a card that does nothing, without the ordering of
//! points and the mapping of indices.

use std::time::{Duration, Instant};

use incircle::pcie::{CardAddress, PcieTransport};
use incircle::{Error, Transport, TransportError};
use incircle_protocol::{answer_head, Clear, Command, Config, Layout, Opcode, RecordRange, CORE_COORD_BITS};
use incircle_sim::pcie::{Beats, CardFaultSpec, DirectoryError, NullDevice};

use super::{MemoryCard, MountedCard};

/// Time limit of one call.
const LIMIT: Duration = Duration::from_secs(60);
/// Bits of a beat of the stream.
const BEAT_BITS: u32 = 128;

/// The way in which the driver reaches the card.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Through calls within the memory of the process.
    Memory,
    /// Through the files of a directory, by calls of the system.
    Files,
}

impl Way {
    /// Both ways, each with its target in nanoseconds per point.
    pub const ALL: [(Self, f64); 2] = [(Self::Memory, 30.0), (Self::Files, 200.0)];

    /// Name of the way in reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Memory => "memory",
            Self::Files => "files",
        }
    }
}

/// Cost of the driver, as measured.
#[derive(Clone, Copy, Debug)]
pub struct DriverCost {
    /// Nanoseconds per point of the fastest job.
    pub best: f64,
    /// Nanoseconds per point of the median job.
    pub median: f64,
}

/// Reasons why nothing was measured.
#[derive(Debug, thiserror::Error)]
pub enum DriverCostError {
    /// The card cannot be opened.
    #[error(transparent)]
    Open(#[from] Error),
    /// The card does not answer.
    #[error(transparent)]
    Transport(#[from] TransportError),
    /// There is no directory for the card.
    #[error(transparent)]
    Directory(#[from] DirectoryError),
}

/// Jobs whose time is measured.
#[derive(Clone, Copy, Debug)]
pub struct Jobs {
    /// Number of jobs to run.
    pub count: usize,
    /// Points of each job.
    pub points: u32,
    /// Configuration that the card reports.
    pub config: Config,
    /// Opcode of the read-out: `Triangles` or `Read`.
    pub read_out: Opcode,
}

/// Runs the jobs. Each sends the commands of a session: `Clear`, `Insert`, the read-out, `Counters` and `Latencies`.
///
/// # Errors
/// No card could be opened, or the card does not answer.
pub fn driver_cost(way: Way, jobs: Jobs) -> Result<DriverCost, DriverCostError> {
    let device: Box<dyn Beats> = Box::new(NullDevice::new(jobs.config, BEAT_BITS));
    let faults = CardFaultSpec::default();
    match way {
        Way::Memory => {
            let card = MemoryCard::new(device, &faults);
            jobs.run(PcieTransport::new("pcie:memory".to_owned(), card.files())?)
        }
        Way::Files => {
            let card = MountedCard::new(device, &faults)?;
            jobs.run(PcieTransport::open(&CardAddress::in_directory(card.path()))?)
        }
    }
}

impl Jobs {
    fn run(self, mut transport: PcieTransport) -> Result<DriverCost, DriverCostError> {
        let Self { count, points, config, read_out } = self;
        let words: Vec<u32> = (0..points).map(|point| point.wrapping_mul(0x9e37_79b9)).collect();
        let layout = Layout::of(CORE_COORD_BITS, config.points);
        let records = RecordRange { first: 0, count: (2 * points).saturating_sub(2) };
        let commands = [
            Command::Clear(Clear::one_mesh(0)),
            Command::insert(&words[..], layout),
            if read_out == Opcode::Triangles { Command::Triangles(records) } else { Command::Read(records) },
            Command::Counters,
            Command::Latencies,
        ];
        let lengths = commands.map(|command| command.payload_words(layout) as usize);
        let mut answer = vec![0; lengths.into_iter().max().unwrap_or(0)];
        let mut times = Vec::with_capacity(count);
        for _ in 0..count {
            let begun = Instant::now();
            for (command, length) in commands.iter().zip(lengths) {
                let deadline = Instant::now() + LIMIT;
                let head = answer_head(command.opcode(), length as u32);
                transport.submit(std::slice::from_ref(command), deadline)?;
                transport.receive(head, &mut answer[..length], deadline)?;
            }
            times.push(begun.elapsed().as_secs_f64() * 1e9 / f64::from(points));
        }
        times.sort_by(f64::total_cmp);
        let at = |place: usize| times.get(place).copied().unwrap_or(f64::NAN);
        Ok(DriverCost { best: at(0), median: at(count / 2) })
    }
}
