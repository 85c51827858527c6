//! What a caller can choose for one job, and what it hears while the job runs.

use std::ops::ControlFlow;
use std::time::Duration;

use crate::order::{self, Alpha, BrioDc, Curve};
use crate::point::Point;

/// The order in which points reach the device. The mesh does not depend on it, the time does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Order {
    /// Rounds of growing random samples (a quarter of the points in all rounds but the last), each along a Hilbert
    /// curve. Good for every distribution: the default. See [`order::brio_hilbert`](crate::order::brio_hilbert).
    #[default]
    BrioHilbert,
    /// One pass along a Hilbert curve: fast on even distributions, without a guarantee on others.
    Hilbert,
    /// As the points come.
    Input,
    /// Random, in an order that follows from the coordinates.
    Random,
    /// One pass along a curve.
    Along(Curve),
    /// Rounds of growing random samples, each along a curve.
    Brio(Curve, Alpha),
    /// Rounds in which each point comes after its nearest neighbour, at which the software model then begins to look for it; no
    /// other device does. See [`order::brio_dc`](crate::order::brio_dc()).
    BrioDc(BrioDc),
}

/// Every order once: Hilbert's curve has names of its own.
const ALL: [Order; 3 + 1 + (Curve::ALL.len() - 1) + (3 * Curve::ALL.len() - 1) + 2] = {
    let mut all = [Order::BrioHilbert; 3 + 1 + (Curve::ALL.len() - 1) + (3 * Curve::ALL.len() - 1) + 2];
    all[1] = Order::Hilbert;
    all[2] = Order::Input;
    all[3] = Order::Random;
    all[4] = Order::BrioDc(BrioDc::Linear);
    all[5] = Order::BrioDc(BrioDc::LogU);
    let (mut place, mut which) = (6, 0);
    while which < Curve::ALL.len() {
        let curve = Curve::ALL[which];
        let is_hilbert = matches!(curve, Curve::Hilbert);
        if !is_hilbert {
            all[place] = Order::Along(curve);
            all[place + 1] = Order::Brio(curve, Alpha::Quarter);
            place += 2;
        }
        all[place] = Order::Brio(curve, Alpha::Half);
        all[place + 1] = Order::Brio(curve, Alpha::Eighth);
        place += 2;
        which += 1;
    }
    all
};

impl Order {
    /// All orders.
    pub const ALL: [Self; ALL.len()] = ALL;
    /// The best, the plainest curve, and none.
    pub const BASIC: [Self; 3] = [Self::BrioHilbert, Self::Hilbert, Self::Input];

    /// The name in reports and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::BrioHilbert => "brio-hilbert",
            Self::Hilbert => "hilbert",
            Self::Input => "input",
            Self::Random => "random",
            Self::Along(curve) => curve.name(),
            Self::Brio(curve, alpha) => curve.brio_name(alpha),
            Self::BrioDc(by) => by.name(),
        }
    }

    /// The points in this order: a permutation of `0..points.len()`.
    pub fn order(self, points: &[Point]) -> Vec<u32> {
        match self {
            Self::BrioHilbert => order::brio_hilbert(points),
            Self::Hilbert => order::hilbert(points),
            Self::Input => (0..=u32::MAX).take(points.len()).collect(),
            Self::Random => order::random(points),
            Self::Along(curve) => curve.order(points),
            Self::Brio(curve, alpha) => order::brio(points, curve, alpha),
            Self::BrioDc(by) => order::brio_dc(points, by).order,
        }
    }

    /// The order of this name.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|order| order.name() == name)
    }
}

/// A part of a job.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// The host removes duplicates and chooses the order.
    Order,
    /// The device takes points.
    Insert,
    /// The device hands out triangle records.
    Read,
    /// The host sorts the triangles into the canonical list.
    Assemble,
}

impl Stage {
    /// The name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Order => "order",
            Self::Insert => "insert",
            Self::Read => "read",
            Self::Assemble => "assemble",
        }
    }
}

/// How far a job is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// The part of the job.
    pub stage: Stage,
    /// Points (records in [`Stage::Read`]) done in this part.
    pub done: usize,
    /// Points (records in [`Stage::Read`]) of this part.
    pub total: usize,
}

/// A listener: [`ControlFlow::Break`] cancels the job with [`Error::Cancelled`](crate::Error::Cancelled).
pub type ProgressListener<'a> = &'a dyn Fn(Progress) -> ControlFlow<()>;

/// Points of one `Insert` command unless chosen otherwise.
pub const INSERT_CHUNK: usize = 65_536;

/// Choices for one job; [`Options::default`] suits most.
#[derive(Clone, Copy)]
pub struct Options<'a> {
    /// Time the device may take for the whole job. `None`: [`Options::default_timeout`].
    pub timeout: Option<Duration>,
    /// Order of insertion.
    pub order: Order,
    /// Called at the start of each stage and after every chunk.
    pub progress: Option<ProgressListener<'a>>,
    /// Contexts that work, that is insertions in flight at once: 1 to what [`Session::identity`](crate::Session::identity) says the
    /// device has. `None`: all of them. In a batch that is the most that may work, and a job has as many as pay. The mesh does not depend
    /// on it, the time does.
    pub contexts: Option<u32>,
    /// Points of one `Insert` command; at least 3 are sent. Progress and cancellation come between chunks.
    pub insert_chunk: usize,
}

impl Options<'_> {
    /// The time a job of this many points may take when none is chosen: a minute and 2 ms per point.
    ///
    /// The simulated core with one context takes about 0.07 ms per uniform point: 120 clocks at two million a second. Choose more
    /// for a device that is much slower, such as a simulation that writes waveforms.
    pub fn default_timeout(points: usize) -> Duration {
        let milliseconds = u64::try_from(points).unwrap_or(u64::MAX).saturating_mul(2);
        Duration::from_secs(60).saturating_add(Duration::from_millis(milliseconds))
    }
}

impl Default for Options<'_> {
    fn default() -> Self {
        Self { timeout: None, order: Order::default(), progress: None, contexts: None, insert_chunk: INSERT_CHUNK }
    }
}

impl std::fmt::Debug for Options<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Options")
            .field("timeout", &self.timeout)
            .field("order", &self.order)
            .field("progress", &self.progress.is_some())
            .field("contexts", &self.contexts)
            .field("insert_chunk", &self.insert_chunk)
            .finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_order_is_found_by_its_name() {
        for order in Order::ALL {
            assert_eq!(Order::named(order.name()), Some(order));
        }
        assert_eq!(Order::named("brio-half-squarified-peano"), Some(Order::Brio(Curve::SquarifiedPeano, Alpha::Half)));
        assert_eq!(Order::named("briodc-log-u"), Some(Order::BrioDc(BrioDc::LogU)));
        assert_eq!(Order::ALL.iter().collect::<std::collections::HashSet<_>>().len(), Order::ALL.len());
        assert_eq!(Order::named("spiral"), None);
    }

    #[test]
    fn default_timeout_grows_with_the_points() {
        assert_eq!(Options::default_timeout(0), Duration::from_secs(60));
        assert_eq!(Options::default_timeout(500_000), Duration::from_secs(1060));
    }
}
