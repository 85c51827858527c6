//! The distinct points along the Z-curve, which is what the engine divides by.

use std::ops::RangeInclusive;
use std::panic::resume_unwind;

use super::view::Site;
use crate::mesh::Duplicate;
use crate::pages;
use crate::point::Point;

/// Bits of a radix digit: 2048 counters stay in the first-level cache.
const DIGIT_BITS: u32 = 11;
/// Digits of the 32 bits that are sorted at a time.
const DIGITS: usize = 3;
/// Below this length a comparison sort is faster than the passes over all digits.
const SMALL: usize = 256;

/// Points of which the ranges of threads are guessed.
const SAMPLE: usize = 1024;

/// The distinct points, sorted.
pub(super) struct Sites {
    /// Along the Z-curve, seen from the lower left corner of all.
    pub(super) sites: Vec<Site>,
    /// The input index of each: the lowest of its place.
    pub(super) ids: Vec<u32>,
    /// Points that fell onto an earlier one, in any order.
    pub(super) duplicates: Vec<Duplicate>,
    /// Bits of a coordinate of `sites`.
    pub(super) bits: u32,
}

/// Thirty-two bits of a position on the curve above an index.
type Entry = u64;

/// The index of an entry.
fn index_of(entry: Entry) -> usize {
    entry as u32 as usize
}

/// The window onto the grid that the points are in: curve positions count from its corner.
#[derive(Clone, Copy)]
struct Window {
    corner: Point,
    /// Bits of a coordinate seen from the corner.
    bits: u32,
    /// How far a position must be shifted so that its 32 leading bits stay.
    shift: u32,
}

impl Window {
    fn of(points: &[Point]) -> Self {
        let fold = |start: u32, choose: fn(u32, u32) -> u32, get: fn(&Point) -> u32| {
            points.iter().map(get).fold(start, choose)
        };
        let corner = Point::new(fold(u32::MAX, u32::min, |p| p.x), fold(u32::MAX, u32::min, |p| p.y));
        let far = Point::new(fold(0, u32::max, |p| p.x), fold(0, u32::max, |p| p.y));
        let extent = far.x.saturating_sub(corner.x) | far.y.saturating_sub(corner.y);
        let bits = u32::BITS - extent.leading_zeros();
        Self { corner, bits, shift: 2 * bits.saturating_sub(16) }
    }

    /// The point, seen from the corner.
    #[inline(always)]
    fn site(&self, point: Point) -> Site {
        Point::new(point.x - self.corner.x, point.y - self.corner.y).into()
    }

    /// The position of a point on the curve: its coordinates' bits in turn, x first.
    #[inline(always)]
    fn position(&self, point: Point) -> u64 {
        spread(point.x - self.corner.x) << 1 | spread(point.y - self.corner.y)
    }

    fn entry(&self, point: Point, index: u32) -> Entry {
        (self.position(point) >> self.shift) << 32 | u64::from(index)
    }

    /// The bits below those of [`Window::entry`].
    fn rest(&self, point: Point) -> u64 {
        self.position(point) & ((1 << self.shift) - 1)
    }
}

/// The bits of a number, each with a zero above it.
#[inline(always)]
fn spread(value: u32) -> u64 {
    let mut bits = u64::from(value);
    bits = (bits | bits << 16) & 0x0000_ffff_0000_ffff;
    bits = (bits | bits << 8) & 0x00ff_00ff_00ff_00ff;
    bits = (bits | bits << 4) & 0x0f0f_0f0f_0f0f_0f0f;
    bits = (bits | bits << 2) & 0x3333_3333_3333_3333;
    (bits | bits << 1) & 0x5555_5555_5555_5555
}

/// The number whose bits [`spread`] gave these.
#[inline(always)]
fn gather(bits: u64) -> u32 {
    let mut bits = bits & 0x5555_5555_5555_5555;
    bits = (bits | bits >> 1) & 0x3333_3333_3333_3333;
    bits = (bits | bits >> 2) & 0x0f0f_0f0f_0f0f_0f0f;
    bits = (bits | bits >> 4) & 0x00ff_00ff_00ff_00ff;
    bits = (bits | bits >> 8) & 0x0000_ffff_0000_ffff;
    (bits | bits >> 16) as u32
}

/// Sorts by the upper half; entries of equal upper halves keep their order. O(n).
fn sort_entries(entries: &mut Vec<Entry>) {
    if entries.len() < SMALL {
        // The lower halves rise in the input, so they decide nothing.
        entries.sort_unstable();
        return;
    }
    const MASK: usize = (1 << DIGIT_BITS) - 1;
    let digit = |entry: Entry, place: usize| (entry >> (32 + place as u32 * DIGIT_BITS)) as usize & MASK;
    let mut starts = [[0u32; 1 << DIGIT_BITS]; DIGITS];
    for &entry in &*entries {
        for (place, counts) in starts.iter_mut().enumerate() {
            counts[digit(entry, place)] += 1;
        }
    }
    let mut scratch = pages::zeros(entries.len());
    for (place, starts) in starts.iter_mut().enumerate() {
        if starts[digit(entries[0], place)] as usize == entries.len() {
            continue;
        }
        let mut sum = 0;
        for start in starts.iter_mut() {
            sum += std::mem::replace(start, sum);
        }
        for &entry in &*entries {
            let slot = &mut starts[digit(entry, place)];
            scratch[*slot as usize] = entry;
            *slot += 1;
        }
        std::mem::swap(entries, &mut scratch);
    }
}

/// Sorts the points along the curve and takes duplicates out, on so many threads. O(n): a radix sort of the 32 leading bits of the
/// positions, and another one of the rest inside long stretches that they leave undecided.
pub(super) fn sort(points: &[Point], threads: usize) -> Sites {
    let window = Window::of(points);
    if threads < 2 {
        return sort_range(points, window, 0..=u64::MAX);
    }
    let ranges = ranges(points, window, threads);
    let sorted: Vec<Sites> = std::thread::scope(|scope| {
        let spawn = |range: RangeInclusive<Entry>| scope.spawn(move || sort_range(points, window, range));
        let workers: Vec<_> = ranges.into_iter().map(spawn).collect();
        workers.into_iter().map(|worker| worker.join().unwrap_or_else(|panic| resume_unwind(panic))).collect()
    });
    let mut all = Sites::with_room(points.len(), window);
    for part in sorted {
        all.sites.extend(part.sites);
        all.ids.extend(part.ids);
        all.duplicates.extend(part.duplicates);
    }
    all
}

/// Ranges of entries that hold about as many points each. Entries of equal upper halves are in one range.
fn ranges(points: &[Point], window: Window, count: usize) -> Vec<RangeInclusive<Entry>> {
    let mut sample: Vec<Entry> =
        points.iter().step_by(points.len() / SAMPLE + 1).map(|&point| window.entry(point, 0)).collect();
    sample.sort_unstable();
    let mut starts: Vec<Entry> = (1..count).filter_map(|k| sample.get(k * sample.len() / count).copied()).collect();
    starts.dedup();
    starts.retain(|&start| start > 0);
    let firsts = std::iter::once(0).chain(starts.iter().copied());
    let lasts = starts.iter().map(|&start| start - 1).chain([u64::MAX]);
    firsts.zip(lasts).map(|(first, last)| first..=last).collect()
}

/// The points whose entries lie in a range.
fn sort_range(points: &[Point], window: Window, range: RangeInclusive<Entry>) -> Sites {
    let all = points.iter().zip(0..=u32::MAX).map(|(&point, index)| window.entry(point, index));
    let is_whole = range == (0..=u64::MAX);
    let mut entries: Vec<Entry> = pages::with_room(if is_whole { points.len() } else { 0 });
    if is_whole {
        entries.extend(all);
    } else {
        entries.extend(all.filter(|entry| range.contains(entry)));
    }
    sort_entries(&mut entries);
    let mut sorted = Sites::with_room(entries.len(), window);
    if window.shift == 0 {
        sorted.take_narrow(&entries);
    } else {
        sorted.take_wide(&mut entries, points, window);
    }
    sorted
}

impl Sites {
    fn with_room(points: usize, window: Window) -> Self {
        Self {
            sites: pages::with_room(points),
            ids: pages::with_room(points),
            duplicates: Vec::new(),
            bits: window.bits,
        }
    }

    /// Takes entries whose 32 bits are the whole position.
    fn take_narrow(&mut self, entries: &[Entry]) {
        let mut before = None;
        for &entry in entries {
            let (position, index) = (entry >> 32, entry as u32);
            if before == Some(position) {
                self.drop_onto_last(index);
                continue;
            }
            before = Some(position);
            self.sites.push(Point::new(gather(position >> 1), gather(position)).into());
            self.ids.push(index);
        }
    }

    /// Takes entries whose 32 bits are the leading ones.
    fn take_wide(&mut self, entries: &mut [Entry], points: &[Point], window: Window) {
        for group in entries.chunk_by_mut(|one, other| one >> 32 == other >> 32) {
            if group.len() > 1 {
                sort_by_rest(group, points, window);
            }
            let mut before = None;
            for &entry in &*group {
                let point = points[index_of(entry)];
                if before == Some(point) {
                    self.drop_onto_last(entry as u32);
                    continue;
                }
                before = Some(point);
                self.sites.push(window.site(point));
                self.ids.push(entry as u32);
            }
        }
    }

    fn drop_onto_last(&mut self, index: u32) {
        // There is a last one: the point fell onto it.
        self.duplicates.extend(self.ids.last().map(|&of| Duplicate { index, of }));
    }
}

/// Sorts entries of equal leading bits by the others, equal points by index.
fn sort_by_rest(group: &mut [Entry], points: &[Point], window: Window) {
    if group.len() < SMALL {
        group.sort_unstable_by_key(|&entry| (window.rest(points[index_of(entry)]), entry));
        return;
    }
    let mut rest: Vec<Entry> =
        group.iter().map(|&entry| window.rest(points[index_of(entry)]) << 32 | entry & 0xffff_ffff).collect();
    sort_entries(&mut rest);
    group.copy_from_slice(&rest);
}
