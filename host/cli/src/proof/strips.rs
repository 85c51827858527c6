//! Strips: consecutive points in lexicographic order, as many as fit the memory, each with the triangles whose first
//! corner is one of them.

use std::path::Path;

use incircle::Point;

use super::points::Sites;
use super::spill::Spill;
use crate::failure::Failure;

/// The triangles of each strip, in the order of the list. Blocks of all strips lie in one file.
pub struct Deal {
    spill: Spill,
    /// The number of triangles of a block.
    block: usize,
    strips: Vec<Dealt>,
}

/// The triangles of one strip.
#[derive(Clone, Default)]
struct Dealt {
    /// The places of the full blocks.
    blocks: Vec<u64>,
    /// The triangles behind them.
    rows: Vec<[u32; 3]>,
}

impl Deal {
    /// Makes empty lists for so many strips, each with a buffer of `buffer` bytes.
    ///
    /// # Errors
    /// The folder cannot be written.
    pub fn new(folder: &Path, strips: usize, buffer: u64) -> Result<Self, Failure> {
        let block = (buffer / 12).max(1) as usize;
        Ok(Self { spill: Spill::create(folder)?, block, strips: vec![Dealt::default(); strips] })
    }

    /// Adds a triangle to a strip, which must exist.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn push(&mut self, strip: usize, triangle: [u32; 3]) -> Result<(), Failure> {
        let dealt = &mut self.strips[strip];
        if dealt.rows.is_empty() {
            dealt.rows.reserve_exact(self.block);
        }
        dealt.rows.push(triangle);
        if dealt.rows.len() == self.block {
            dealt.blocks.push(self.spill.append(&dealt.rows)?);
            dealt.rows.clear();
        }
        Ok(())
    }

    /// Calls `take` with the triangles of a strip.
    ///
    /// # Errors
    /// The file cannot be read, or `take` fails.
    fn each(&self, strip: usize, take: &mut dyn FnMut([u32; 3]) -> Result<(), Failure>) -> Result<(), Failure> {
        let (dealt, mut rows) = (&self.strips[strip], Vec::new());
        for &at in &dealt.blocks {
            rows.clear();
            self.spill.read(at, self.block, &mut rows)?;
            rows.iter().try_for_each(|&row| take(row))?;
        }
        dealt.rows.iter().try_for_each(|&row| take(row))
    }
}

/// The points of a strip, which are found by their indices.
pub struct Table {
    /// Rows of x, y and index, by rising indices.
    rows: Vec<[u32; 3]>,
    /// The place of the first row whose index is in each bucket, and the end.
    starts: Vec<u32>,
    low: u32,
    shift: u32,
}

impl Table {
    /// The table of a strip.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn of(sites: &Sites, strip: usize) -> Result<Self, Failure> {
        Ok(Self::new(sites.rows(strip)?))
    }

    fn new(mut rows: Vec<[u32; 3]>) -> Self {
        rows.sort_unstable_by_key(|row| row[2]);
        let (low, high) = (rows.first().map_or(0, |row| row[2]), rows.last().map_or(0, |row| row[2]));
        let shift = (0..u32::BITS).find(|&shift| ((high - low) >> shift) as usize <= rows.len()).unwrap_or(31);
        let buckets = ((high - low) >> shift) as usize + 1;
        let mut starts = vec![0u32; buckets + 1];
        rows.iter().for_each(|row| starts[((row[2] - low) >> shift) as usize + 1] += 1);
        for bucket in 1..starts.len() {
            starts[bucket] += starts[bucket - 1];
        }
        Self { rows, starts, low, shift }
    }

    /// The place of the point with this index; `None` if it is not in the strip.
    pub fn find(&self, index: u32) -> Option<u32> {
        let bucket = (index.checked_sub(self.low)? >> self.shift) as usize;
        let (begin, end) = (*self.starts.get(bucket)?, *self.starts.get(bucket + 1)?);
        let rows = &self.rows[begin as usize..end as usize];
        let found = rows.binary_search_by_key(&index, |row| row[2]).ok()?;
        Some(begin + found as u32)
    }

    /// The index of the point at a place.
    pub fn index(&self, place: u32) -> u32 {
        self.rows[place as usize][2]
    }

    /// The point at a place.
    pub fn point(&self, place: u32) -> Point {
        let [x, y, _] = self.rows[place as usize];
        Point::new(x, y)
    }
}

/// A triangle of a strip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Member {
    /// The places of the corners in the table of the strip.
    Within([u32; 3]),
    /// The corners, and those of their places that are in the table. Such a triangle goes through files.
    Crossing([u32; 3], [Option<u32>; 3]),
}

/// Calls `take` with the triangles of a strip, in the order of the list. At most `most` of them are
/// [within](Member::Within), and the same ones each time.
///
/// # Errors
/// The file cannot be read, or `take` fails.
pub fn members(
    (deal, strip, table): (&Deal, usize, &Table),
    most: usize,
    take: &mut dyn FnMut(Member) -> Result<(), Failure>,
) -> Result<(), Failure> {
    let mut within = 0;
    deal.each(strip, &mut |corners| {
        let places = corners.map(|corner| table.find(corner));
        take(match places {
            [Some(a), Some(b), Some(c)] if within < most => {
                within += 1;
                Member::Within([a, b, c])
            }
            _ => Member::Crossing(corners, places),
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_testkit::SplitMix64;

    #[test]
    fn points_are_found_by_their_indices() {
        let mut random = SplitMix64::new(4);
        for (count, most) in [(0, 1), (1, u32::MAX), (100, 100), (1000, u32::MAX), (500, 3000)] {
            let mut indices: Vec<u32> = (0..count).map(|_| random.below_u32(most)).collect();
            indices.sort_unstable();
            indices.dedup();
            let rows: Vec<[u32; 3]> = indices.iter().map(|&index| [index ^ 5, 7, index]).rev().collect();
            let table = Table::new(rows);
            for (place, &index) in (0..).zip(&indices) {
                assert_eq!(table.find(index), Some(place));
                assert_eq!((table.index(place), table.point(place)), (index, Point::new(index ^ 5, 7)));
            }
            for index in (0..2000).map(|_| random.below_u32(most)).chain([0, u32::MAX]) {
                assert_eq!(table.find(index).is_some(), indices.binary_search(&index).is_ok(), "{index} of {count}");
            }
        }
    }

    #[test]
    fn triangles_are_dealt_in_order() {
        for buffer in [0, 100, 1 << 14] {
            let mut deal = Deal::new(&std::env::temp_dir(), 3, buffer).expect("the folder can be written");
            (0..1000).for_each(|k| deal.push(k as usize % 7 % 3, [k, 0, 0]).expect("the folder can be written"));
            for strip in 0..3 {
                let mut found = Vec::new();
                let take = &mut |row: [u32; 3]| {
                    found.push(row[0]);
                    Ok(())
                };
                deal.each(strip, take).expect("the file can be read");
                let right: Vec<u32> = (0..1000).filter(|k| *k as usize % 7 % 3 == strip).collect();
                assert_eq!(found, right, "{buffer} bytes");
            }
        }
    }
}
