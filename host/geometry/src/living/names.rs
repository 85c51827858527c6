//! The vertex of each living index: a hash table.
//!
//! Indices are never used again, so they grow without end. A list by index would grow with them; the size of this table
//! follows the number of living points.
//!
//! Eight indices in a row share a line of the processor's cache. Each has a column of its own, and a search goes down
//! its column, from line to line. If it went along the lines, a line that is already full would make all eight indices
//! of the next such line search on, and runs of entries would be eight times as long.

use alloc::vec::Vec;

use crate::pages;

/// Marks an entry without an index. No point has this index.
const EMPTY: u32 = u32::MAX;
/// Consecutive indices that share a line of 64 bytes.
const LINE: usize = 8;
/// The odd number nearest to 2^64 divided by the golden ratio, whose multiples are spread evenly.
const SPREAD: u64 = 0x9e37_79b9_7f4a_7c15;

/// A map from living indices to vertices: open addressing with linear probing, one column after the other.
#[derive(Clone, Debug, Default)]
pub struct Names {
    /// Pairs of index and vertex, line by line; the length is 0 or a power of two from [`LINE`] on.
    entries: Vec<[u32; 2]>,
    count: usize,
}

impl Names {
    /// The number of living indices.
    pub fn len(&self) -> usize {
        self.count
    }

    /// The vertex of an index.
    #[inline]
    pub fn get(&self, index: u32) -> Option<u32> {
        if self.entries.is_empty() || index == EMPTY {
            return None;
        }
        let [found, vertex] = *self.at(self.find(index));
        (found == index).then_some(vertex)
    }

    /// Gives an index a vertex, whether it has one already or not. The index `u32::MAX` is not allowed.
    pub fn set(&mut self, index: u32, vertex: u32) {
        // At most three of four entries are in use.
        if 4 * (self.count + 1) > 3 * self.entries.len() {
            self.grow((2 * self.entries.len()).max(LINE));
        }
        let place = self.find(index);
        self.count += usize::from(self.at(place)[0] == EMPTY);
        self.put(place, [index, vertex]);
    }

    /// Makes room for more indices.
    pub fn reserve(&mut self, more: usize) {
        let needed = (4 * (self.count + more) / 3 + 1).next_power_of_two().max(LINE);
        if needed > self.entries.len() {
            self.grow(needed);
        }
    }

    /// Takes an index out; returns its vertex.
    pub fn remove(&mut self, index: u32) -> Option<u32> {
        if self.entries.is_empty() || index == EMPTY {
            return None;
        }
        let mask = self.entries.len() - 1;
        let mut hole = self.find(index);
        let [found, vertex] = *self.at(hole);
        if found != index {
            return None;
        }
        let mut next = (hole + 1) & mask;
        // Later entries of the run move up, unless that would put them before the place at which they are looked for.
        loop {
            let entry = *self.at(next);
            if entry[0] == EMPTY {
                break;
            }
            let home = self.home(entry[0]);
            if next.wrapping_sub(home) & mask >= next.wrapping_sub(hole) & mask {
                self.put(hole, entry);
                hole = next;
            }
            next = (next + 1) & mask;
        }
        self.put(hole, [EMPTY; 2]);
        self.count -= 1;
        Some(vertex)
    }

    /// All living indices with their vertices, in no order.
    pub fn iter(&self) -> impl Iterator<Item = (u32, u32)> + '_ {
        self.entries.iter().filter(|entry| entry[0] != EMPTY).map(|&[index, vertex]| (index, vertex))
    }

    /// The bytes that the table takes.
    pub fn bytes(&self) -> usize {
        size_of::<[u32; 2]>() * self.entries.capacity()
    }

    /// The place of an index, or the empty one where it would be put. Places go down the columns.
    #[inline]
    fn find(&self, index: u32) -> usize {
        let mask = self.entries.len() - 1;
        let mut place = self.home(index);
        while self.at(place)[0] != index && self.at(place)[0] != EMPTY {
            place = (place + 1) & mask;
        }
        place
    }

    /// The place at which the search for an index begins.
    #[inline]
    fn home(&self, index: u32) -> usize {
        let lines = self.entries.len() / LINE;
        let line = (u64::from(index) / LINE as u64).wrapping_mul(SPREAD) >> 32;
        index as usize % LINE * lines + (line as usize & (lines - 1))
    }

    /// The number of the entry at a place.
    #[inline]
    fn entry(&self, place: usize) -> usize {
        let lines = self.entries.len() / LINE;
        (place & (lines - 1)) * LINE + (place >> lines.trailing_zeros())
    }

    #[inline]
    fn at(&self, place: usize) -> &[u32; 2] {
        &self.entries[self.entry(place)]
    }

    #[inline]
    fn put(&mut self, place: usize, entry: [u32; 2]) {
        let number = self.entry(place);
        self.entries[number] = entry;
    }

    fn grow(&mut self, length: usize) {
        let mut entries = pages::with_room(length);
        entries.resize(length, [EMPTY; 2]);
        let old = core::mem::replace(&mut self.entries, entries);
        for entry in old.into_iter().filter(|entry| entry[0] != EMPTY) {
            let place = self.find(entry[0]);
            self.put(place, entry);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_testkit::SplitMix64;
    use std::collections::BTreeMap;

    #[test]
    fn the_table_is_a_map() {
        let mut random = SplitMix64::new(11);
        for step in [1, 8, 64, 1 << 20] {
            let (mut names, mut map) = (Names::default(), BTreeMap::new());
            for _ in 0..20_000 {
                let index = random.below_u32(400) * step;
                if random.once_in(2) {
                    assert_eq!(names.remove(index), map.remove(&index));
                } else {
                    let vertex = random.below_u32(1000);
                    names.set(index, vertex);
                    map.insert(index, vertex);
                }
                assert_eq!(names.len(), map.len());
                let asked = random.below_u32(400) * step;
                assert_eq!(names.get(asked), map.get(&asked).copied());
            }
            let mut all: Vec<(u32, u32)> = names.iter().collect();
            all.sort_unstable();
            assert!(all.into_iter().eq(map));
            assert!(names.bytes() <= 8 * 1024);
            assert_eq!(names.get(EMPTY), None);
        }
    }
}
