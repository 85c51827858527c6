//! The distinct points along the Z-curve, which is what the engine divides by.

use super::parallel::in_parallel;
use super::view::Site;
use crate::mesh::Duplicate;
use crate::order::mix;
use crate::pages;
use crate::point::Point;
use crate::sort::{sort_by_key, Entry as _, Keyed as _, Narrow};

/// Below this length points of equal leading bits are sorted by comparison.
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
        let none = (Point::new(u32::MAX, u32::MAX), Point::new(0, 0));
        let (corner, far) = points.iter().fold(none, |(low, high), p| {
            (Point::new(low.x.min(p.x), low.y.min(p.y)), Point::new(high.x.max(p.x), high.y.max(p.y)))
        });
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

    /// The leading bits of a position.
    #[inline(always)]
    fn key(&self, point: Point) -> u32 {
        (self.position(point) >> self.shift) as u32
    }

    /// The bits below those of [`Window::key`]: 30 at most.
    fn rest(&self, point: Point) -> u32 {
        (self.position(point) & ((1 << self.shift) - 1)) as u32
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

/// Sorts the points along the curve and takes duplicates out, on so many threads. O(n): a radix sort of the 32 leading bits of the
/// positions, and another one of the rest inside long stretches that they leave undecided.
pub(super) fn sort(points: &[Point], threads: usize) -> Sites {
    let window = Window::of(points);
    let mut all = Sites {
        sites: pages::zeros(points.len()),
        ids: pages::zeros(points.len()),
        duplicates: Vec::new(),
        bits: window.bits,
    };
    let ranges = if threads < 2 { vec![entries(points, window)] } else { deal(points, window, threads) };
    let (mut sites, mut ids) = (all.sites.as_mut_slice(), all.ids.as_mut_slice());
    let parts: Vec<_> = ranges
        .into_iter()
        .map(|range| {
            let (own_sites, own_ids) = (
                sites.split_off_mut(..range.len()).unwrap_or_default(),
                ids.split_off_mut(..range.len()).unwrap_or_default(),
            );
            (range, Kept { sites: own_sites, ids: own_ids, count: 0, duplicates: Vec::new() })
        })
        .collect();
    let kept = in_parallel(parts.into_iter(), |(mut range, mut kept)| {
        sort_by_key(&mut range);
        if window.shift == 0 {
            kept.take_narrow(&range);
        } else {
            kept.take_wide(&mut range, points, window);
        }
        (range.len(), kept.count, kept.duplicates)
    });
    all.close_up(kept);
    all
}

/// Each point with its key, in the order of the input.
fn entries(points: &[Point], window: Window) -> Vec<Narrow> {
    let mut entries = pages::with_room(points.len());
    entries.extend(points.iter().zip(0..=u32::MAX).map(|(&point, index)| Narrow::new(window.key(point), index)));
    entries
}

/// The points with their keys in ranges of keys, one for each thread; in each range in the order of the input.
fn deal(points: &[Point], window: Window, threads: usize) -> Vec<Vec<Narrow>> {
    let bounds = bounds(points, window, threads);
    let chunk = points.len().div_ceil(threads).max(1);
    let dealt = in_parallel(points.chunks(chunk).enumerate(), |(place, points)| {
        let room = points.len() / threads + points.len() / (4 * threads);
        let mut ranges: Vec<Vec<Narrow>> = (0..threads).map(|_| pages::with_room(room)).collect();
        for (&point, index) in points.iter().zip((chunk * place) as u32..) {
            let key = window.key(point);
            // Counted rather than searched for: no processor predicts which range it is.
            let range: usize = bounds.iter().map(|&bound| usize::from(key >= bound)).sum();
            ranges[range].push(Narrow::new(key, index));
        }
        ranges
    });
    in_parallel(0..threads, |range| {
        let own = || dealt.iter().map(|ranges| &ranges[range]);
        let mut entries = pages::with_room(own().map(Vec::len).sum());
        own().for_each(|range| entries.extend_from_slice(range));
        entries
    })
}

/// The first keys of all ranges but the first, which hold about as many points each.
fn bounds(points: &[Point], window: Window, count: usize) -> Vec<u32> {
    let stride = points.len() / SAMPLE + 1;
    // Not evenly: rows of a lattice may be as long as a stride.
    let from_stride = |(place, own): (u64, &[Point])| own.get((mix(place) % stride as u64) as usize).copied();
    let mut sample: Vec<u32> =
        (0..).zip(points.chunks(stride)).filter_map(from_stride).map(|point| window.key(point)).collect();
    sample.sort_unstable();
    (1..count).filter_map(|k| sample.get(k * sample.len() / count).copied()).collect()
}

/// What is kept of a range of the curve: room for all its points.
struct Kept<'a> {
    sites: &'a mut [Site],
    ids: &'a mut [u32],
    count: usize,
    duplicates: Vec<Duplicate>,
}

impl Kept<'_> {
    /// Takes entries whose 32 bits are the whole position.
    fn take_narrow(&mut self, entries: &[Narrow]) {
        let mut before = None;
        for entry in entries {
            let position = entry.key();
            if before == Some(position) {
                self.drop_onto_last(entry.value());
                continue;
            }
            before = Some(position);
            self.keep(Point::new(gather(position >> 1), gather(position)).into(), entry.value());
        }
    }

    /// Takes entries whose 32 bits are the leading ones.
    fn take_wide(&mut self, entries: &mut [Narrow], points: &[Point], window: Window) {
        for group in entries.chunk_by_mut(|one, other| one.key() == other.key()) {
            if group.len() > 1 {
                sort_by_rest(group, points, window);
            }
            let mut before = None;
            for entry in &*group {
                let point = points[entry.value() as usize];
                if before == Some(point) {
                    self.drop_onto_last(entry.value());
                    continue;
                }
                before = Some(point);
                self.keep(window.site(point), entry.value());
            }
        }
    }

    #[inline(always)]
    fn keep(&mut self, site: Site, id: u32) {
        (self.sites[self.count], self.ids[self.count]) = (site, id);
        self.count += 1;
    }

    fn drop_onto_last(&mut self, index: u32) {
        // There is a last one: the point fell onto it.
        self.duplicates.extend(self.ids[..self.count].last().map(|&of| Duplicate { index, of }));
    }
}

impl Sites {
    /// Takes ranges together: of each its room, how much of that is used, and its duplicates.
    fn close_up(&mut self, ranges: Vec<(usize, usize, Vec<Duplicate>)>) {
        let (mut from, mut to) = (0, 0);
        for (room, count, duplicates) in ranges {
            if from > to {
                self.sites.copy_within(from..from + count, to);
                self.ids.copy_within(from..from + count, to);
            }
            (from, to) = (from + room, to + count);
            self.duplicates.extend(duplicates);
        }
        self.sites.truncate(to);
        self.ids.truncate(to);
    }
}

/// Sorts entries of equal leading bits by the others, equal points by index.
fn sort_by_rest(group: &mut [Narrow], points: &[Point], window: Window) {
    let rest = |entry: &Narrow| window.rest(points[entry.value() as usize]);
    if group.len() < SMALL {
        group.sort_unstable_by_key(|entry| (rest(entry), entry.value()));
        return;
    }
    let key = group[0].key() as u32;
    let mut by_rest: Vec<Narrow> = group.iter().map(|entry| Narrow::new(rest(entry), entry.value())).collect();
    sort_by_key(&mut by_rest);
    for (slot, entry) in group.iter_mut().zip(by_rest) {
        *slot = Narrow::new(key, entry.value());
    }
}
