//! The canonical order of more triangles than the memory holds: dealt to buckets by their first corners, each of which
//! is sorted alone.

use std::fs::{self, File, OpenOptions};
use std::io::{self, BufReader, Read, Write};
use std::path::{Path, PathBuf};

use crate::failure::Failure;
use crate::{interrupt, path};

/// The bytes that a triangle takes while its bucket is sorted: twice 12 for the triangle, and up to 8 for counts.
const SORT_BYTES: u64 = 32;
/// By how much the fullest bucket may exceed the average. If the points are numbered at random, the lowest indices come
/// first in three times as many triangles as the average; and a number of buckets that is a power of two may be half
/// of what is wanted.
const UNEVEN: u64 = 6;
const MOST_BUCKETS: u64 = 1 << 12;
/// The number of bytes that are read at a time.
const PIECE: usize = 1 << 16;

/// Takes triangles in any order.
pub type Take<'a> = dyn FnMut(&[[u32; 3]]) -> Result<(), Failure> + 'a;

/// Sorts triangles, each of which has its smallest index first. What does not fit the memory is in files.
pub struct Sorter {
    folder: PathBuf,
    /// The bytes that buffers, and then one bucket, may take.
    memory: u64,
    /// The least key, and the bits of keys that are different within a bucket.
    first: u64,
    shift: u32,
    /// The bytes of a bucket that are kept in memory.
    room: usize,
    buckets: Vec<Bucket>,
}

impl Sorter {
    /// Makes a sorter of about `expected` triangles whose indices are below `points`.
    pub fn new(folder: &Path, points: u64, expected: u64, memory: u64) -> Self {
        let largest = points.saturating_sub(1).min(u32::MAX.into());
        let index_bits = u64::BITS - largest.leading_zeros();
        Self::of_keys(folder, 0, u32::BITS + index_bits, expected, memory)
    }

    /// Makes a sorter of keys from `first` on, which differ in the lowest `bits` bits alone.
    fn of_keys(folder: &Path, first: u64, bits: u32, expected: u64, memory: u64) -> Self {
        let wanted = expected.saturating_mul(SORT_BYTES * UNEVEN).div_ceil(memory.max(1));
        let split = wanted.clamp(1, MOST_BUCKETS).next_power_of_two().ilog2().min(bits);
        let buckets = (0..1usize << split).map(|_| Bucket::new()).collect();
        // One bucket may fill all of the memory before it goes to a file, because it is sorted where it is.
        let room = if split == 0 { memory / SORT_BYTES * 12 } else { (memory / 4) >> split };
        let room = usize::try_from(room).unwrap_or(usize::MAX).max(PIECE / 64);
        Self { folder: folder.to_owned(), memory, first, shift: bits - split, room, buckets }
    }

    /// Adds triangles.
    pub fn add(&mut self, triangles: &[[u32; 3]]) -> Result<(), Failure> {
        for triangle in triangles {
            let place = (key(triangle) - self.first).checked_shr(self.shift).unwrap_or(0) as usize;
            let last = self.buckets.len() - 1;
            self.buckets[place.min(last)].push(*triangle, self.room, &self.folder)?;
        }
        Ok(())
    }

    /// Calls `take` with all triangles in canonical order.
    pub fn finish(self, take: &mut Take<'_>) -> Result<(), Failure> {
        let Self { folder, memory, first, shift, mut buckets, .. } = self;
        buckets.iter_mut().try_for_each(Bucket::flush)?;
        for (place, bucket) in (0u64..).zip(buckets) {
            if bucket.count.saturating_mul(SORT_BYTES) <= memory || shift == 0 {
                take(&sorted(bucket.into_list()?))?;
                continue;
            }
            // One point may be a corner of most triangles, so a bucket may be cut again, down to single keys.
            let first = first + place.checked_shl(shift).unwrap_or(0);
            let mut finer = Self::of_keys(&folder, first, shift, bucket.count, memory);
            bucket.each(&mut |triangles| finer.add(triangles))?;
            drop(bucket);
            finer.finish(take)?;
        }
        Ok(())
    }
}

/// Each directed edge has one triangle on its left, so two corners order all triangles.
#[inline]
fn key(triangle: &[u32; 3]) -> u64 {
    u64::from(triangle[0]) << u32::BITS | u64::from(triangle[1])
}

/// Triangles in canonical order, by counting their first corners.
fn sorted(mut triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
    let firsts = || triangles.iter().map(|triangle| triangle[0]);
    let (Some(low), Some(high)) = (firsts().min(), firsts().max()) else {
        return triangles;
    };
    let span = (high - low) as usize + 1;
    if span > triangles.len().saturating_mul(2) {
        triangles.sort_unstable();
        return triangles;
    }
    let mut places = vec![0u32; span];
    firsts().for_each(|first| places[(first - low) as usize] += 1);
    let mut sum = 0;
    for place in &mut places {
        sum += std::mem::replace(place, sum);
    }
    let mut list = vec![[0; 3]; triangles.len()];
    for triangle in &triangles {
        let place = &mut places[(triangle[0] - low) as usize];
        list[*place as usize] = *triangle;
        *place += 1;
    }
    list.chunk_by_mut(|one, other| one[0] == other[0]).for_each(<[_]>::sort_unstable);
    list
}

/// Triangles in the order in which they were added, in memory and then in a file. Dropping the value removes the file.
pub struct Bucket {
    buffer: Vec<[u32; 3]>,
    file: Option<PathBuf>,
    /// The number of triangles.
    pub count: u64,
}

impl Bucket {
    /// Makes an empty bucket without a file.
    pub fn new() -> Self {
        Self { buffer: Vec::new(), file: None, count: 0 }
    }

    /// Adds a triangle. A buffer of `room` bytes goes to a file in the folder.
    #[inline]
    pub fn push(&mut self, triangle: [u32; 3], room: usize, folder: &Path) -> Result<(), Failure> {
        if (self.buffer.len() + 1) * 12 > room {
            self.spill(folder)?;
        }
        self.buffer.push(triangle);
        self.count += 1;
        Ok(())
    }

    fn spill(&mut self, folder: &Path) -> Result<(), Failure> {
        if self.file.is_none() {
            self.file = Some(create(folder)?);
        }
        self.flush()
    }

    /// Writes the buffer to the file, if there is one.
    fn flush(&mut self) -> Result<(), Failure> {
        let Some(path) = &self.file else { return Ok(()) };
        let append = || -> io::Result<()> {
            let mut out = io::BufWriter::with_capacity(PIECE, OpenOptions::new().append(true).open(path)?);
            super::written::write_rows(&self.buffer, &mut out)?;
            out.flush()
        };
        append().map_err(|error| failed(path, "written", &error))?;
        self.buffer = Vec::new();
        Ok(())
    }

    /// Calls `take` with all triangles, some at a time.
    pub fn each(&self, take: &mut Take<'_>) -> Result<(), Failure> {
        if let Some(path) = &self.file {
            let in_file = self.count - self.buffer.len() as u64;
            read_rows(path, in_file, take)?;
        }
        take(&self.buffer)
    }

    fn into_list(mut self) -> Result<Vec<[u32; 3]>, Failure> {
        if self.file.is_none() {
            return Ok(std::mem::take(&mut self.buffer));
        }
        let mut list = Vec::with_capacity(self.count as usize);
        self.each(&mut |triangles| {
            list.extend_from_slice(triangles);
            Ok(())
        })?;
        Ok(list)
    }
}

impl Drop for Bucket {
    fn drop(&mut self) {
        if let Some(path) = self.file.take() {
            let mut unfinished = interrupt::unfinished();
            let _ = fs::remove_file(&path);
            unfinished.retain(|kept| *kept != path);
        }
    }
}

fn read_rows(path: &Path, count: u64, take: &mut Take<'_>) -> Result<(), Failure> {
    let failed = |error: io::Error| failed(path, "read", &error);
    let mut source = BufReader::with_capacity(PIECE, File::open(path).map_err(failed)?);
    let (mut rows, mut left) = (Vec::new(), count);
    while left > 0 {
        rows.clear();
        for _ in 0..left.min(PIECE as u64 / 12) {
            let mut bytes = [0; 12];
            source.read_exact(&mut bytes).map_err(failed)?;
            let word = |at: usize| bytes[at..].first_chunk().map_or(0, |word| u32::from_le_bytes(*word));
            rows.push([word(0), word(4), word(8)]);
        }
        left -= rows.len() as u64;
        take(&rows)?;
    }
    Ok(())
}

/// Makes a new empty file, which an interrupt removes.
fn create(folder: &Path) -> Result<PathBuf, Failure> {
    use std::sync::atomic::{AtomicU64, Ordering};
    static NEXT: AtomicU64 = AtomicU64::new(0);
    let number = NEXT.fetch_add(1, Ordering::Relaxed);
    let path = folder.join(format!(".join.{}.{number}.part", std::process::id()));
    let mut unfinished = interrupt::unfinished();
    let made = OpenOptions::new().write(true).create(true).truncate(true).open(&path);
    made.map_err(|error| failed(&path, "written", &error))?;
    unfinished.push(path.clone());
    Ok(path)
}

fn failed(file: &Path, what: &str, error: &io::Error) -> Failure {
    Failure::input(format!("{} cannot be {what}: {error}", path::name(file)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_testkit::SplitMix64;

    fn check(points: u64, triangles: &[[u32; 3]], memory: u64) {
        let folder = std::env::temp_dir().join(format!("incircle-sort-{}-{points}-{memory}", std::process::id()));
        fs::create_dir_all(&folder).expect("the folder can be made");
        let mut sorter = Sorter::new(&folder, points, triangles.len() as u64, memory);
        triangles.chunks(100).for_each(|some| sorter.add(some).expect("the disk has room"));
        let mut list = Vec::new();
        sorter
            .finish(&mut |some| {
                list.extend_from_slice(some);
                Ok(())
            })
            .expect("the files can be read");
        let left = fs::read_dir(&folder).expect("the folder is there").count();
        fs::remove_dir_all(&folder).expect("the folder is there");
        let mut right = triangles.to_vec();
        right.sort_unstable();
        assert!(list == right, "{points} points, {memory} bytes");
        assert_eq!(left, 0, "no file is left");
    }

    #[test]
    fn triangles_are_sorted_in_any_memory() {
        let mut random = SplitMix64::new(5);
        for points in [1u64, 2, 1000, 65_537, u64::from(u32::MAX)] {
            let mut corner = || random.below(points) as u32;
            let even: Vec<[u32; 3]> = (0..5000).map(|_| [corner(), corner(), corner()]).collect();
            // One point is a corner of all triangles.
            let hub: Vec<[u32; 3]> = even.iter().map(|triangle| [0, triangle[1], triangle[2]]).collect();
            for memory in [3000, 20_000, 1 << 30] {
                check(points, &even, memory);
                check(points, &hub, memory);
            }
        }
        check(0, &[], 1 << 16);
    }
}
