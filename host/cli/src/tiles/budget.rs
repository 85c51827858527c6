//! The division of a bound on the memory among the steps, which run one after the other.

use std::num::NonZeroUsize;

use super::disk::told;
use crate::failure::Failure;

/// The least memory that a set in tiles takes.
const LEAST: u64 = 32 << 20;
/// The bytes that the program itself takes, with the buffers of its files.
const PROGRAM: u64 = 16 << 20;
/// The most bytes that a point of a tile takes until its tile is triangulated and written. Measured: 139 for a tile
/// alone, and 162 where threads do one tile after the other, because the system keeps some of what they free.
const TILE_BYTES: u64 = 168;
/// The most points of a tile, whose half-edges have numbers of 32 bits.
const MOST: u64 = 1 << 28;
/// A tile of fewer points is not worth a worker of its own.
const LEAST_TILE: u64 = 100_000;
/// The most points of the sample, and the bytes that one takes while the cuts are made.
const SAMPLE: (u64, u64) = (1 << 19, 48);
/// The most bytes of all buffers of the files of points.
const BUFFERS: u64 = 64 << 20;

/// The memory of each step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Budget {
    /// The memory of the whole run, in bytes.
    pub memory: u64,
    /// The most points of a tile.
    pub most: NonZeroUsize,
    /// The most tiles that are triangulated at once.
    pub workers: NonZeroUsize,
    /// The most points of the sample from which the cuts are made.
    pub sample: usize,
    /// The bytes of all buffers while points are dealt to their tiles.
    pub buffers: usize,
    /// The bytes for the sort of the triangles.
    pub sort: u64,
}

impl Budget {
    /// Divides a memory of `memory` bytes among at most `workers` tiles that are triangulated at once.
    ///
    /// # Errors
    /// Less than 32 MiB are too little for any set.
    pub fn of(memory: u64, workers: NonZeroUsize) -> Result<Self, Failure> {
        let points = points_at_once(memory)?;
        let workers = (points / LEAST_TILE).clamp(1, workers.get() as u64);
        Ok(Self::new(memory, workers, (points / workers).min(MOST)))
    }

    /// Divides a memory for tiles of up to `most` points that are there already.
    ///
    /// # Errors
    /// The memory does not hold one of these tiles.
    pub fn for_tiles(memory: u64, workers: NonZeroUsize, most: u64) -> Result<Self, Failure> {
        let at_once = points_at_once(memory)? / most.max(1);
        if at_once == 0 {
            return Err(Failure::usage(format!(
                "the {} of --memory do not hold a tile of the run that is to go on, of up to {most} points: give {}M \
                 or more",
                told(memory),
                PROGRAM.saturating_add(most.saturating_mul(TILE_BYTES)).div_ceil(1 << 20)
            )));
        }
        Ok(Self::new(memory, at_once.min(workers.get() as u64), most))
    }

    fn new(memory: u64, workers: u64, most: u64) -> Self {
        let free = memory - PROGRAM;
        let number = |value: u64| usize::try_from(value).ok().and_then(NonZeroUsize::new).unwrap_or(NonZeroUsize::MIN);
        let (sample, bytes) = SAMPLE;
        Self {
            memory,
            most: number(most),
            workers: number(workers),
            sample: sample.min(free / 4 / bytes) as usize,
            buffers: BUFFERS.min(free / 4) as usize,
            sort: free / 8 * 7,
        }
    }

    /// Whether a memory of `memory` bytes is enough for tiles.
    pub fn is_enough(memory: u64) -> bool {
        memory >= LEAST
    }

    /// The memory of `tile split` for tiles of at most `most` points. The verb has no other step.
    pub fn of_tiles(most: NonZeroUsize) -> Self {
        Self {
            memory: 0,
            most,
            workers: NonZeroUsize::MIN,
            sample: SAMPLE.0 as usize,
            buffers: BUFFERS as usize,
            sort: 0,
        }
    }
}

/// The points of all tiles that a memory holds at once.
fn points_at_once(memory: u64) -> Result<u64, Failure> {
    if memory < LEAST {
        return Err(Failure::usage(format!(
            "--memory {memory} is less than the {LEAST} bytes that tiles take at least: give 32M or more"
        )));
    }
    Ok((memory - PROGRAM) / TILE_BYTES)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_step_fits_the_memory() {
        let some = NonZeroUsize::new(6).expect("not zero");
        for memory in [LEAST, 100 << 20, 1 << 30, 1 << 36] {
            let budget = Budget::of(memory, some).expect("enough memory");
            let steps = [
                (budget.most.get() * budget.workers.get()) as u64 * TILE_BYTES,
                budget.sample as u64 * SAMPLE.1 + budget.buffers as u64,
                budget.sort,
            ];
            assert!(steps.iter().all(|&step| PROGRAM + step <= memory), "{budget:?}");
        }
        let resumed = |memory| Budget::for_tiles(memory, some, 1_000_000);
        assert_eq!(resumed(500 << 20).map(|budget| budget.workers.get()), Ok(3));
        let refused = resumed(100 << 20).map_err(|failure| failure.message);
        assert!(refused.is_err_and(|message| message.contains("give 177M or more")));
        assert_eq!(resumed(184_777_216).map(|budget| budget.workers.get()), Ok(1));
        assert!(Budget::of(LEAST - 1, some).is_err_and(|failure| failure.message.contains("give 32M")));
    }
}
