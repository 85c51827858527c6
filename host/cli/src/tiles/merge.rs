//! Sorted lists of triangles, merged within a bound on the memory.

use std::sync::mpsc::sync_channel;
use std::vec::IntoIter;

use super::canonical::{key, sorted};
use super::result::Finals;
use super::runs::Run;
use crate::failure::Failure;
use crate::interrupt;

/// The bytes that a triangle in a buffer may take: there, while its round is sorted, and while it is written.
const BYTES: u64 = 12 * 5;
/// The least triangles of a buffer, unless there is one list for many thousand tiles.
const LEAST: usize = 64;

/// Takes triangles.
pub type Take<'a> = dyn FnMut(&[[u32; 3]]) -> Result<(), Failure> + 'a;

/// A sorted list.
pub enum Source {
    /// A list in memory.
    Memory(IntoIter<[u32; 3]>),
    /// A run of the joins.
    Run(Run),
    /// The final triangles of a tile.
    Tile(Box<Finals>),
}

impl Source {
    fn has_more(&self) -> bool {
        match self {
            Self::Memory(list) => list.len() > 0,
            Self::Run(run) => run.has_more(),
            Self::Tile(finals) => finals.has_more(),
        }
    }

    fn read(&mut self, list: &mut Vec<[u32; 3]>, most: usize) -> Result<(), Failure> {
        match self {
            Self::Memory(source) => {
                list.extend(source.take(most));
                Ok(())
            }
            Self::Run(run) => run.read(list, most),
            Self::Tile(finals) => finals.read(list, most),
        }
    }

    /// Checks what was read to its end.
    fn end(self) -> Result<(), Failure> {
        match self {
            Self::Tile(finals) => finals.end(),
            Self::Memory(_) | Self::Run(_) => Ok(()),
        }
    }
}

/// A list with those of its triangles that were read but not passed on.
struct Buffer {
    source: Source,
    list: Vec<[u32; 3]>,
}

/// Calls `take` with all triangles of the lists in canonical order. Another thread reads and sorts ahead. Both take about
/// `memory` bytes, and at least 4 KiB for each list.
///
/// # Errors
/// A list cannot be read, is damaged or not in order, or `take` fails.
pub fn merge(sources: Vec<Source>, memory: u64, take: &mut Take<'_>) -> Result<(), Failure> {
    let room = memory / BYTES / sources.len().max(1) as u64;
    let room = usize::try_from(room).unwrap_or(usize::MAX).clamp(LEAST, 1 << 24);
    let (sender, receiver) = sync_channel(0);
    std::thread::scope(|scope| {
        // If the reader is gone, so is the reason to go on.
        let reader = scope.spawn(move || {
            let mut buffers: Vec<Buffer> =
                sources.into_iter().map(|source| Buffer { source, list: Vec::new() }).collect();
            while let Some(some) = next(&mut buffers, room)? {
                if sender.send(some).is_err() {
                    return Ok(());
                }
            }
            buffers.into_iter().try_for_each(|buffer| buffer.source.end())
        });
        for some in receiver {
            interrupt::check()?;
            take(&some)?;
        }
        reader.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    })
}

/// The next triangles in canonical order: all that are not above the last one of any buffer that may get more. `None` at
/// the end.
fn next(buffers: &mut [Buffer], room: usize) -> Result<Option<Vec<[u32; 3]>>, Failure> {
    for buffer in buffers.iter_mut() {
        let missing = room.saturating_sub(buffer.list.len());
        if missing > 0 && buffer.source.has_more() {
            buffer.source.read(&mut buffer.list, missing)?;
        }
    }
    let open = buffers.iter().filter(|buffer| buffer.source.has_more());
    let bound = open.filter_map(|buffer| buffer.list.last()).map(key).min().unwrap_or(u64::MAX);
    let counts: Vec<usize> =
        buffers.iter().map(|buffer| buffer.list.partition_point(|triangle| key(triangle) <= bound)).collect();
    let parts = buffers.iter().zip(&counts).map(|(buffer, &count)| &buffer.list[..count]);
    let parts: Vec<&[[u32; 3]]> = parts.filter(|part| !part.is_empty()).collect();
    let some = match &parts[..] {
        [] => return Ok(None),
        [only] => only.to_vec(),
        several => sorted(several),
    };
    for (buffer, count) in buffers.iter_mut().zip(counts) {
        buffer.list.drain(..count);
    }
    Ok(Some(some))
}

#[cfg(test)]
mod tests {
    use incircle_testkit::SplitMix64;

    use super::*;

    fn merged(lists: &[Vec<[u32; 3]>], memory: u64) -> Vec<[u32; 3]> {
        let sources = lists.iter().map(|list| Source::Memory(list.clone().into_iter())).collect();
        let mut all = Vec::new();
        merge(sources, memory, &mut |some| {
            all.extend_from_slice(some);
            Ok(())
        })
        .expect("lists in memory can be read");
        all
    }

    #[test]
    fn lists_are_merged_in_any_memory() {
        let mut random = SplitMix64::new(7);
        for (count, length, points) in [(1, 1000, 50), (3, 5000, 900), (40, 700, 1 << 30), (5, 0, 9), (0, 0, 1)] {
            // A list per tile, with an even share of the triangles, or with those of its own range of points.
            for is_range in [false, true] {
                let lists: Vec<Vec<[u32; 3]>> = (0..count)
                    .map(|list| {
                        let corner = |random: &mut SplitMix64| random.below_u32(points);
                        let first = if is_range { list * (points / count) } else { 0 };
                        let mut own: Vec<[u32; 3]> = (0..length)
                            .map(|_| [first + corner(&mut random) / count, corner(&mut random), list])
                            .collect();
                        own.sort_unstable();
                        own.dedup_by_key(|triangle| key(triangle));
                        own
                    })
                    .collect();
                let mut expected: Vec<[u32; 3]> = lists.concat();
                expected.sort_unstable();
                for memory in [0, 100_000, 1 << 30] {
                    let found = merged(&lists, memory);
                    let keys = |list: &[[u32; 3]]| list.iter().map(key).collect::<Vec<_>>();
                    assert!(keys(&found) == keys(&expected), "{count} lists of {length}, {memory} bytes");
                }
            }
        }
    }

    #[test]
    fn a_hub_is_merged_in_little_memory() {
        // One point is the first corner of all triangles.
        let lists: Vec<Vec<[u32; 3]>> =
            (0..7).map(|list| (0..3000).map(|k| [0, 7 * k + list, 7 * k + list + 1]).collect()).collect();
        assert!(merged(&lists, 1000).into_iter().eq((0..21_000).map(|k| [0, k, k + 1])));
    }
}
