//! The distinct points of a small set along the Z-curve, in memory that is kept from set to set.
//!
//! A word has the leading bits of the position on the curve, and below them the index of the point. Two passes of a
//! radix sort order the words by so many leading bits that few points agree in them. Comparisons sort these few.

use alloc::vec::Vec;

use super::super::view::Site;
use crate::order::z_curve::{narrow_position, position};
use crate::point::{Duplicate, Point};

/// Sets of fewer points are sorted by comparison alone.
const FEW: usize = 48;
/// Sets of at least this many points are sorted by digits of 11 bits, smaller sets by digits of 8 bits. Two digits of 8
/// bits distinguish nearly all of 4096 even points, and their counters take less time to clear and to add up.
const MANY: usize = 4096;
/// Most bits of a coordinate for the narrow form of positions.
const NARROW_BITS: u32 = 16;

/// The distinct points of a set, sorted along the Z-curve, and the memory to sort them.
#[derive(Debug, Default)]
pub(super) struct SmallSites {
    /// The coordinates, counted from the lower left corner of the bounding box.
    pub(super) sites: Vec<Site>,
    /// The input index of each site: the lowest of all points at its place.
    pub(super) ids: Vec<u32>,
    words: Vec<u64>,
    spare: Vec<u64>,
    counts: Vec<u32>,
}

/// The bounding box of the points, and the form of their words.
#[derive(Clone, Copy)]
struct Form {
    corner: Point,
    /// The number of bits of a coordinate counted from the corner.
    bits: u32,
    /// The bits of a word that are an index.
    indices: u64,
    /// The bits of a digit.
    digit_bits: u32,
}

impl Form {
    fn of(points: &[Point]) -> Self {
        let none = (Point::new(u32::MAX, u32::MAX), Point::new(0, 0));
        let (corner, far) = points.iter().fold(none, |(low, high), p| {
            (Point::new(low.x.min(p.x), low.y.min(p.y)), Point::new(high.x.max(p.x), high.y.max(p.y)))
        });
        let extent = far.x.saturating_sub(corner.x) | far.y.saturating_sub(corner.y);
        let index_bits = usize::BITS - points.len().saturating_sub(1).leading_zeros();
        let digit_bits = if points.len() < MANY { 8 } else { 11 };
        Self { corner, bits: u32::BITS - extent.leading_zeros(), indices: (1 << index_bits) - 1, digit_bits }
    }

    /// The point with its coordinates counted from the corner.
    #[inline(always)]
    fn site(self, point: Point) -> Point {
        Point::new(point.x - self.corner.x, point.y - self.corner.y)
    }

    /// Positions are shifted by this number of bits, so that their first bit is the first of a word.
    fn shift(self) -> u32 {
        u64::BITS - 2 * self.bits.max(1)
    }

    /// Whether the words have whole positions.
    fn is_exact(self) -> bool {
        self.indices >> self.shift() == 0
    }

    /// The position of a point on the curve.
    fn position(self, index: u64, points: &[Point]) -> u64 {
        let Point { x, y } = self.site(points[index as usize]);
        position(x, y)
    }
}

impl SmallSites {
    /// Sorts the points along the curve and takes duplicates out. The duplicates go to a list of their own, sorted by
    /// index. Returns the number of bits of a coordinate of the sites.
    pub(super) fn sort(&mut self, points: &[Point], duplicates: &mut Vec<Duplicate>) -> u32 {
        let form = Form::of(points);
        if points.len() < FEW {
            self.fill(points, form, |_| ());
            self.words.sort_unstable();
        } else {
            self.sort_by_digits(points, form);
        }
        if !form.is_exact() {
            let groups = self.words.chunk_by_mut(|one, other| (one ^ other) & !form.indices == 0);
            for group in groups.filter(|group| group.len() > 1) {
                let key = |word: &u64| (form.position(word & form.indices, points), word & form.indices);
                group.sort_unstable_by_key(key);
            }
        }
        self.take(points, form, duplicates);
        form.bits
    }

    /// Makes the words of all points, each of which is shown to `look`.
    #[inline(always)]
    fn fill(&mut self, points: &[Point], form: Form, mut look: impl FnMut(u64)) {
        let shift = form.shift();
        let mut word = |position: u64, index: u64| {
            let word = position << shift & !form.indices | index;
            look(word);
            word
        };
        self.words.clear();
        self.words.reserve(points.len());
        let sites = points.iter().map(|&point| form.site(point)).zip(0..);
        if form.bits <= NARROW_BITS {
            self.words.extend(sites.map(|(site, index)| word(narrow_position(site.x, site.y), index)));
        } else {
            self.words.extend(sites.map(|(site, index)| word(position(site.x, site.y), index)));
        }
    }

    /// Sorts the words of all points by their two leading digits, then those that agree in both by comparison.
    fn sort_by_digits(&mut self, points: &[Point], form: Form) {
        const MASK: usize = (1 << 11) - 1;
        let (first, second) = (u64::BITS - form.digit_bits, u64::BITS - 2 * form.digit_bits);
        let mask = (1 << form.digit_bits) - 1;
        let digit = |word: u64, shift: u32| (word >> shift) as usize & mask & MASK;
        let mut counts = core::mem::take(&mut self.counts);
        counts.resize(2 * (MASK + 1), 0);
        let (by_first, by_second) = counts.split_at_mut(MASK + 1);
        by_first[..=mask].fill(0);
        by_second[..=mask].fill(0);
        self.fill(points, form, |word| {
            by_first[digit(word, first)] += 1;
            by_second[digit(word, second)] += 1;
        });
        self.spare.resize(points.len().max(self.spare.len()), 0);
        let spare = &mut self.spare[..points.len()];
        scatter(&self.words, spare, &mut by_second[..=mask], |word| digit(word, second));
        scatter(spare, &mut self.words, &mut by_first[..=mask], |word| digit(word, first));
        self.counts = counts;
        for group in self.words.chunk_by_mut(|one, other| (one ^ other) >> second == 0) {
            if group.len() > 1 {
                group.sort_unstable();
            }
        }
    }

    /// Takes the points in the order of their words.
    fn take(&mut self, points: &[Point], form: Form, duplicates: &mut Vec<Duplicate>) {
        let Self { sites, ids, words, .. } = self;
        sites.clear();
        sites.reserve(points.len());
        ids.clear();
        ids.reserve(points.len());
        let mut before = None;
        for word in words {
            let index = (*word & form.indices) as u32;
            let point = points[index as usize];
            if before == Some(point) {
                duplicates.extend(ids.last().map(|&of| Duplicate { index, of }));
                continue;
            }
            before = Some(point);
            sites.push(form.site(point).into());
            ids.push(index);
        }
        duplicates.sort_unstable();
    }
}

/// Puts words in the order of a digit, given how many words have each digit. Words of the same digit keep their order.
#[inline(always)]
fn scatter(from: &[u64], to: &mut [u64], counts: &mut [u32], digit: impl Fn(u64) -> usize) {
    let mut sum = 0;
    for count in &mut *counts {
        sum += core::mem::replace(count, sum);
    }
    for &word in from {
        let place = &mut counts[digit(word)];
        to[*place as usize] = word;
        *place += 1;
    }
}
