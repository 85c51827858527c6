//! Makes finished rings of random cavities in the way in which a cavity grows: a triangle joins behind one edge of
//! the boundary and brings two edges.

use std::collections::{btree_map::Entry, BTreeMap};

use incircle_testkit::SplitMix64;

use crate::rig::stepper::bundles::{commit_job, Edge};

/// Lowest id of a cavity record; ids below are free for new records.
pub const OLD_IDS: u64 = 1 << 14;

/// The finished ring of a context.
#[derive(Clone, Debug, Default)]
pub struct Ring {
    pub context: u64,
    pub vertex: u64,
    pub locks: u64,
    pub since: u64,
    /// Entries by number; the ring starts at entry 0.
    pub entries: Vec<Edge>,
    /// Triangles of the cavity that have no edge on its boundary, in the order in which they lost their last one.
    pub inner: Vec<u64>,
}

impl Ring {
    /// Makes a ring with this many edges.
    pub fn random(edges: usize, context: u64, random: &mut SplitMix64) -> Self {
        let mut edges_of = BTreeMap::new();
        let root = new_triangle(3, &mut edges_of, random);
        let mut entries: Vec<Edge> =
            [1, 2, 0].map(|after| Edge { cavity_record: root, after, ..Edge::default() }).to_vec();
        let mut inner = Vec::new();
        while entries.len() < edges {
            let place = random.below(entries.len() as u64) as usize;
            let passed = entries[place];
            let open = edges_of.get_mut(&passed.cavity_record).expect("a triangle of the cavity");
            *open -= 1;
            if *open == 0 {
                inner.push(passed.cavity_record);
            }
            let cavity_record = new_triangle(2, &mut edges_of, random);
            entries.push(Edge { cavity_record, ..passed });
            entries[place] = Edge { cavity_record, after: entries.len() as u64 - 1, ..passed };
        }
        for entry in &mut entries {
            (entry.first_vertex, entry.outside_record, entry.slot) =
                (random.below(1 << 15), random.below(1 << 15), random.below(3));
        }
        let (vertex, locks, since) = (random.below(1 << 15), 1 + random.below(126), random.below(1 << 22));
        Self { context, vertex, locks, since, entries, inner }
    }

    /// The ring's job for the commit, packed as a `CommitJob`.
    pub fn job(&self) -> u128 {
        commit_job(self.context, self.vertex, self.inner.len() as u64, self.locks, self.since)
    }

    /// True if the entry at this place in the order has the same cavity record as the entry before
    /// it or as the first one.
    pub fn shares(&self, place: usize) -> bool {
        let order = self.in_order();
        place > 0 && [order[place - 1].cavity_record, order[0].cavity_record].contains(&order[place].cavity_record)
    }

    /// Entries in the order of the ring, from entry 0 on.
    pub fn in_order(&self) -> Vec<Edge> {
        let mut ring = vec![self.entries[0]];
        while ring[ring.len() - 1].after != 0 {
            ring.push(self.entries[ring[ring.len() - 1].after as usize]);
        }
        ring
    }
}

/// Returns random lengths of rings, often the shortest or the longest.
pub fn random_length(longest: u64, random: &mut SplitMix64) -> usize {
    let length = match random.below(8) {
        0 => 3,
        1 => longest,
        _ => 3 + random.below((longest - 2).min(14)),
    };
    length as usize
}

/// Returns an id that no triangle of the cavity has yet, and gives it `edges` edges on the boundary.
fn new_triangle(edges: u32, edges_of: &mut BTreeMap<u64, u32>, random: &mut SplitMix64) -> u64 {
    loop {
        let id = OLD_IDS + random.below(OLD_IDS);
        if let Entry::Vacant(place) = edges_of.entry(id) {
            place.insert(edges);
            return id;
        }
    }
}
