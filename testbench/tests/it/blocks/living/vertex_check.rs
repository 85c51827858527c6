//! Runs `VertexCheck` in Rust and in Verilog beside a set of vertices in use: each item must have the outcome that the
//! set says, whatever comes into use and falls out of use meanwhile. A vertex that is deleted keeps ids from then on. Its
//! item has its word in the vertex memory, and so has an item that inserts a vertex.

use std::collections::BTreeSet;

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::living::VertexCheck;
use incircle_protocol::TINY;
use incircle_testkit::SplitMix64;

named_ports!(
    VertexCheck,
    [
        reset,
        clears,
        capacity,
        arrived,
        dealt,
        is_change,
        hole_runs,
        vertex,
        accepted,
        is_noted,
        marks,
        marked,
        unmarks,
        unmarked,
        unmarked_owns,
        fetches,
        fetched
    ],
    [taken, offered, refuses, is_beyond, wanted],
    clock
);

const POINTS: u64 = TINY.points as u64;

/// The block, and what it must know.
struct Rig {
    block: Stepper<VertexCheck>,
    random: SplitMix64,
    in_use: BTreeSet<u64>,
    /// The vertices for which ids are kept.
    keepers: BTreeSet<u64>,
    arrived: u64,
    /// The vertices whose points come in the next two clocks.
    fetched: [u64; 2],
}

/// The point of a vertex.
fn point(vertex: u64) -> u64 {
    (vertex * 0x0101_0101) & 0xffff_ffff
}

impl Rig {
    /// Runs a clock. Now and then a vertex that is not asked about comes into use or falls out of it.
    fn edge(&mut self, asked: Option<u64>) {
        let vertex = self.random.below(POINTS);
        let known = vertex < self.arrived && Some(vertex) != asked;
        let marks = known && self.random.once_in(3);
        let unmarks = known && !marks && self.random.once_in(3);
        self.block.set("marks", marks);
        self.block.set("unmarks", unmarks);
        self.block.set("marked", vertex);
        self.block.set("unmarked", vertex);
        let owns = self.random.once_in(2);
        self.block.set("unmarked_owns", owns);
        let fetches = self.random.once_in(3);
        self.block.set("fetches", fetches);
        self.block.set("fetched", point(self.fetched[1]));
        self.block.settle();
        let wanted = if fetches { self.random.bits(15) } else { self.block.get("wanted") as u64 };
        self.fetched = [wanted, self.fetched[0]];
        self.block.edge();
        if marks {
            self.in_use.insert(vertex);
        }
        if unmarks {
            self.in_use.remove(&vertex);
            self.keepers.remove(&vertex);
            self.keepers.extend(Some(vertex).filter(|_| owns));
        }
    }

    /// Forgets all vertices, and inserts some.
    fn clear(&mut self) {
        self.arrived = 0;
        self.block.set("arrived", 0u64);
        self.block.set("clears", true);
        self.edge(None);
        self.block.set("clears", false);
        self.in_use = BTreeSet::from([0, 1]);
        self.keepers.clear();
        for _ in 0..2 {
            self.edge(None);
        }
        // Points of an `Insert` come into use one by one, and some fall out of it again.
        let count = 3 + self.random.below(POINTS - 2);
        self.block.set("arrived", count);
        for vertex in 2..count {
            self.block.set("marks", true);
            self.block.set("marked", vertex);
            self.block.set("unmarks", false);
            self.block.settle();
            self.block.edge();
            self.in_use.insert(vertex);
        }
        self.arrived = count;
        self.edge(None);
    }

    /// Brings an item through the block: `None` if it goes to its context, else whether its vertex is beyond the
    /// capacity.
    fn bring(&mut self, vertex: u64, is_change: bool, hole_runs: bool) -> Option<bool> {
        self.block.set("hole_runs", hole_runs);
        self.block.set("dealt_valid", true);
        self.block.set("is_change", is_change);
        self.block.set("vertex", vertex);
        for _ in 0..200 {
            self.block.set("accepted", false);
            self.block.set("is_noted", false);
            self.block.settle();
            let [is_offered, is_refused] = ["offered_valid", "refuses"].map(|port| self.block.is(port));
            assert!(!(is_offered && is_refused));
            assert!(is_change || is_offered, "items of questions go through");
            let takes = self.random.once_in(2);
            self.block.set("accepted", takes && is_offered);
            self.block.set("is_noted", takes && is_refused);
            self.block.settle();
            if is_change && is_offered {
                self.block.expect("offered_item_vertex", vertex);
                if !hole_runs {
                    self.block.expect("offered_item_owns", self.keepers.contains(&vertex));
                    self.block.expect("offered_item_target", point(vertex));
                }
            }
            if hole_runs && is_offered {
                self.block.expect("offered_item_place", point(vertex));
            }
            self.block.expect("taken", takes && (is_offered || is_refused));
            let is_beyond = self.block.is("is_beyond");
            let asked = Some(vertex).filter(|_| is_change);
            self.edge(asked);
            if takes && (is_offered || is_refused) {
                self.block.set("dealt_valid", false);
                self.block.set("accepted", false);
                self.block.set("is_noted", false);
                return is_refused.then_some(is_beyond);
            }
        }
        panic!("the item is neither offered nor refused");
    }
}

#[test]
fn vertex_check_refuses_what_cannot_be_inserted_or_deleted() {
    let block = Stepper::new("living_vertex_check", VertexCheck::new(TINY), 1);
    let random = SplitMix64::new(82);
    let (in_use, keepers) = (BTreeSet::new(), BTreeSet::new());
    let mut rig = Rig { block, random, in_use, keepers, arrived: 0, fetched: [0; 2] };
    for port in ["clears", "dealt_valid", "is_change", "hole_runs", "accepted", "is_noted"] {
        rig.block.set(port, false);
    }
    rig.block.set("capacity", POINTS);
    rig.block.set("vertex", 0u64);
    rig.block.set("arrived", 0u64);
    for clock in 0..5 {
        rig.block.set("reset", clock < 4);
        rig.edge(None);
    }
    let mut seen = [0; 5];
    for _ in 0..300 {
        rig.clear();
        for _ in 0..rig.random.below(12) {
            let is_change = !rig.random.once_in(6);
            let hole_runs = is_change && rig.random.once_in(3);
            let vertex = match rig.random.below(6) {
                0 => rig.random.bits(32) | POINTS,
                1 => POINTS,
                _ => rig.random.below(POINTS),
            };
            let wanted = match () {
                () if !is_change => None,
                () if hole_runs && rig.in_use.contains(&vertex) => None,
                () if hole_runs => Some(vertex >= POINTS),
                () if vertex >= POINTS => Some(true),
                () if rig.in_use.contains(&vertex) => Some(false),
                () => None,
            };
            assert_eq!(rig.bring(vertex, is_change, hole_runs), wanted, "vertex {vertex}, in use {:?}", rig.in_use);
            if hole_runs && wanted.is_none() {
                rig.in_use.remove(&vertex);
                rig.keepers.insert(vertex);
            } else if is_change && wanted.is_none() {
                rig.in_use.insert(vertex);
            }
            let kind = match wanted {
                _ if hole_runs => 3 + usize::from(wanted.is_some()),
                None => 0,
                Some(is_beyond) => 1 + usize::from(is_beyond),
            };
            seen[kind] += 1;
        }
    }
    assert!(seen.iter().all(|&count| count > 100), "offered, in use, beyond, deleted, missing: {seen:?}");
}
