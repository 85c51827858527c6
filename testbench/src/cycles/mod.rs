//! Cycles of the core, counted on the model clock by clock: exact figures, and the same on every machine.
//!
//! [`measure`] runs one job as the host does: it removes duplicates, orders the points in rounds along the
//! Hilbert curve, and deals them to the contexts. [`batch`] runs many jobs through the host library. [`document`] puts
//! the counts into the tables of `cycles.md`.

mod airports;
mod batches;
mod parallel;
mod table;

pub use airports::thinned_airports;
pub use batches::{batch, batches, JOBS};
pub use table::{block, document, row, survey_counts, BLOCKS, COLUMNS, ROWS};

use incircle::order::brio_hilbert_dealt;
use incircle::Point;
use incircle_model::{ClockModel, Inputs};
use incircle_protocol::{clear_word, command_word, Config, ConfigError, Counter, Opcode, COUNTER_WORDS, MIN_POINTS};
use incircle_testkit::{generate, Distribution, GenerateError};

/// Bits of a coordinate.
const BITS: u32 = 16;
/// Seed of every generated set.
const SEED: u64 = 1;
/// Boundary edges that the list of a context holds.
const RING: u32 = 32;
/// Clocks for each point after which the job is taken to hang.
const PATIENCE: u64 = 4000;

/// The reasons why there is no figure.
#[derive(Debug, thiserror::Error)]
pub enum MeasureError {
    /// The set cannot be made.
    #[error("{0}")]
    Generate(#[from] GenerateError),
    /// The core cannot be built.
    #[error("{0}")]
    Config(#[from] ConfigError),
    /// The points do not fit the grid, or the host library cannot do a batch.
    #[error("{0}")]
    Host(#[from] incircle::Error),
    /// A line of the list of airports does not begin with two numbers.
    #[error("line {0} of the airports does not begin with two coordinates")]
    Airport(usize),
    /// All points lie on one line, so there is no mesh.
    #[error("all points lie on one line")]
    Collinear,
    /// The job does not end.
    #[error("the job does not end: {0}")]
    Hang(String),
    /// The back end does not count its clocks.
    #[error("the back end does not count clocks")]
    NoClocks,
    /// Fewer points are in the mesh than were sent.
    #[error("{inserted} of {sent} points are in the mesh")]
    Lost {
        /// Number of points in the mesh.
        inserted: u32,
        /// Number of points sent.
        sent: usize,
    },
}

/// The counters of a finished job.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Counters([u32; COUNTER_WORDS]);

impl Counters {
    /// Value of a counter, of all its words.
    pub fn of(&self, counter: Counter) -> u64 {
        let place = counter as usize;
        let high = match counter {
            Counter::InsertCycles | Counter::WaitCycles | Counter::ReadCycles => self.0[place + 1],
            _ => 0,
        };
        u64::from(self.0[place]) | u64::from(high) << 32
    }

    /// Value of a counter divided by the number of inserted points.
    pub fn per_insertion(&self, counter: Counter) -> f64 {
        self.of(counter) as f64 / self.of(Counter::Insertions) as f64
    }
}

/// Runs a job of `n` points of a distribution on a core of `contexts` contexts, and returns its counters.
///
/// Duplicate points are removed. The capacity of the core is the next power of two, and
/// its boundary lists hold 32 edges.
///
/// # Errors
/// No core of that size exists, or the model is at fault.
pub fn measure(distribution: Distribution, n: usize, contexts: u32) -> Result<Counters, MeasureError> {
    let points = generate(distribution, n, BITS, SEED)?;
    measure_points(&points.into_iter().map(|[x, y]| Point::new(x, y)).collect::<Vec<_>>(), contexts)
}

/// Runs a job as [`measure`] does, for given points.
///
/// # Errors
/// The errors of [`measure`].
pub fn measure_points(points: &[Point], contexts: u32) -> Result<Counters, MeasureError> {
    let points = in_order(points, contexts)?;
    let capacity = (points.len() as u32).next_power_of_two().max(MIN_POINTS);
    let core = ClockModel::new(Config { name: "measured", points: capacity, ring: RING, contexts, engines: 1 })?;
    let mut words = vec![clear_word(contexts), command_word(Opcode::Insert), points.len() as u32];
    words.extend(points.iter().map(|point| point.x | point.y << BITS));
    words.push(command_word(Opcode::Counters));
    let counters = Counters(run(core, &words, PATIENCE * (points.len() as u64 + 100))?);
    match counters.of(Counter::Insertions) as u32 {
        inserted if inserted as usize == points.len() => Ok(counters),
        inserted => Err(MeasureError::Lost { inserted, sent: points.len() }),
    }
}

/// The distinct points in the order in which the host sends them: in rounds and dealt,
/// with the first three not collinear.
fn in_order(points: &[Point], contexts: u32) -> Result<Vec<Point>, MeasureError> {
    let mut distinct = points.to_vec();
    distinct.sort_unstable();
    distinct.dedup();
    let mut points: Vec<Point> =
        brio_hilbert_dealt(&distinct, contexts).into_iter().map(|index| distinct[index as usize]).collect();
    let [a, b, rest @ ..] = &points[..] else {
        return Err(MeasureError::Collinear);
    };
    let off_the_line = |c: &Point| {
        let minus = |one: u32, other: u32| i64::from(one) - i64::from(other);
        minus(b.x, a.x) * minus(c.y, a.y) != minus(b.y, a.y) * minus(c.x, a.x)
    };
    let third = rest.iter().position(off_the_line).ok_or(MeasureError::Collinear)?;
    points[2..third + 3].rotate_right(1);
    Ok(points)
}

/// Sends all words, takes every answer at once, and returns the payload of the last answer, which has the counters.
fn run(mut core: ClockModel, words: &[u32], limit: u64) -> Result<[u32; COUNTER_WORDS], MeasureError> {
    // `Clear` answers two words and `Insert` seven; the answer to `Counters` has two words before the counters.
    const BEFORE: usize = 2 + 7 + 2;
    let mut rest = words;
    let mut answers = Vec::with_capacity(BEFORE + COUNTER_WORDS);
    for _ in 0..limit {
        let outputs = core.outputs();
        let offered = rest.first().copied();
        core.clock(Inputs {
            reset: false,
            command_valid: offered.is_some(),
            command_data: offered.unwrap_or_default(),
            response_ready: true,
        });
        if outputs.command_ready && offered.is_some() {
            rest = &rest[1..];
        }
        answers.extend(outputs.answer_words());
        if let Some(Ok(counters)) = answers.get(BEFORE..).map(TryInto::try_into) {
            return Ok(counters);
        }
    }
    Err(MeasureError::Hang(core.describe()))
}
