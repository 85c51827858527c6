//! What the driver itself costs: whole jobs against a card that does nothing, without ordering points and mapping indices.

use std::time::{Duration, Instant};

use incircle::pcie::{CardAddress, PcieTransport};
use incircle::{Error, Transport, TransportError};
use incircle_protocol::{
    clear_word, command_word, Config, Layout, Opcode, CORE_COORD_BITS, COUNTER_WORDS, INSERT_REPORT_WORDS,
    LATENCY_BUCKETS,
};
use incircle_sim::pcie::{Beats, CardFaultSpec, DirectoryError, NullDevice};

use super::{MemoryCard, MountedCard};

/// Time for a call.
const LIMIT: Duration = Duration::from_secs(60);
/// Bits of a beat.
const BEAT_BITS: u32 = 128;

/// How the driver reaches the card.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// In the memory of the process.
    Memory,
    /// Through the files of a directory, by the system's calls.
    Files,
}

impl Way {
    /// Both, with what is aimed at in nanoseconds a point.
    pub const ALL: [(Self, f64); 2] = [(Self::Memory, 30.0), (Self::Files, 200.0)];

    /// For reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Memory => "memory",
            Self::Files => "files",
        }
    }
}

/// What it costs.
#[derive(Clone, Copy, Debug)]
pub struct DriverCost {
    /// Nanoseconds a point of the fastest job.
    pub best: f64,
    /// Of the job in the middle.
    pub median: f64,
}

/// Why nothing was measured.
#[derive(Debug, thiserror::Error)]
pub enum DriverCostError {
    /// The card cannot be opened.
    #[error(transparent)]
    Open(#[from] Error),
    /// It does not answer.
    #[error(transparent)]
    Transport(#[from] TransportError),
    /// There is no directory for it.
    #[error(transparent)]
    Directory(#[from] DirectoryError),
}

/// Jobs to be done.
#[derive(Clone, Copy, Debug)]
pub struct Jobs {
    /// How many.
    pub count: usize,
    /// Points of each.
    pub points: u32,
    /// What the card says it is.
    pub config: Config,
    /// `Triangles` or `Read`.
    pub read_out: Opcode,
}

/// Does these jobs. Each is what a session says: `Clear`, `Insert`, the read-out, `Counters` and `Latencies`.
///
/// # Errors
/// No card could be opened, or it does not answer.
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
        let mut insert = vec![command_word(Opcode::Insert), points];
        insert.extend((0..points).map(|point| point.wrapping_mul(0x9e37_79b9)));
        let records = (2 * points).saturating_sub(2);
        let layout = Layout::of(CORE_COORD_BITS, config.points);
        let payload = match read_out {
            Opcode::Triangles => layout.triangles_words(records).unwrap_or(0) as usize,
            _ => records as usize * layout.record_words,
        };
        let mut answer = vec![0; payload.max(LATENCY_BUCKETS)];
        let mut times = Vec::with_capacity(count);
        for _ in 0..count {
            let begun = Instant::now();
            for (command, words) in [
                (&[clear_word(0)][..], 0),
                (&insert[..], INSERT_REPORT_WORDS),
                (&[command_word(read_out), 0, records][..], payload),
                (&[command_word(Opcode::Counters)][..], COUNTER_WORDS),
                (&[command_word(Opcode::Latencies)][..], LATENCY_BUCKETS),
            ] {
                let deadline = Instant::now() + LIMIT;
                let mut head = [0; 2];
                transport.send(command, deadline)?;
                transport.receive(&mut head, deadline)?;
                transport.receive(&mut answer[..words], deadline)?;
            }
            times.push(begun.elapsed().as_secs_f64() * 1e9 / f64::from(points));
        }
        times.sort_by(f64::total_cmp);
        let at = |place: usize| times.get(place).copied().unwrap_or(f64::NAN);
        Ok(DriverCost { best: at(0), median: at(count / 2) })
    }
}
