//! Runs the commit in Rust and in Verilog beside a list of all its steps: all three must agree in every clock. The list
//! is written down beforehand from the whole ring, while the block sees one entry at a time.

use std::collections::{BTreeSet, VecDeque};

use crate::rig::random_rings::{random_length, Ring};
use crate::rig::record_count::{Count, Event};
use crate::rig::stepper::bundles::{link_write, record_write, Edge};
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::engine::Commit;
use incircle_protocol::{Config, MAX_CONTEXTS, MAX_RING, TINY};
use incircle_testkit::SplitMix64;

named_ports!(Commit, [reset, head, head_job, inner, fresh], [takes, takes_fresh, write, committed, is_at_work], clock);

const LONGEST: Config = Config { ring: MAX_RING, contexts: MAX_CONTEXTS, ..TINY };

/// A step of a commit. Each step takes a clock, or waits.
#[derive(Clone, Copy, Debug, Default)]
struct Act {
    /// The step takes an entry, and waits for it.
    takes: bool,
    /// The step gives an inner record back, and waits until its id is read.
    gives_back: bool,
    takes_fresh: bool,
    ends: bool,
    /// The write made at the edge of this step, which is seen in the next clock.
    makes: Option<u128>,
}

/// Ids of the star's records in the order of the ring, by their definition: the first edge of a cavity record keeps
/// that record's id, all other edges get the ids of inner records, and then new ones. The two flags say whether an id
/// is that of an inner record, and whether it is new.
fn ids(ring: &Ring, fresh: u64) -> Vec<(u64, bool, bool)> {
    let mut kept = BTreeSet::new();
    let mut spare = ring.inner.iter();
    let mut new = fresh..;
    let mut id = |cavity_record| match (kept.insert(cavity_record), spare.as_slice().is_empty()) {
        (true, _) => (cavity_record, false, false),
        (false, false) => (*spare.next().expect("it is not empty"), true, false),
        (false, true) => (new.next().expect("ids without end"), false, true),
    };
    let ids: Vec<_> = ring.in_order().into_iter().map(|edge| id(edge.cavity_record)).collect();
    // Every cavity record gives its id to one record of the star, and two ids are new.
    let mut old: BTreeSet<u64> = ring.entries.iter().map(|edge| edge.cavity_record).collect();
    old.extend(&ring.inner);
    old.extend([fresh, fresh + 1]);
    assert_eq!((ids.len(), ids.iter().map(|(id, ..)| *id).collect()), (old.len(), old), "{ring:?}");
    ids
}

/// All steps of a ring's commit after its first entry was taken.
fn acts(ring: &Ring, fresh: u64) -> VecDeque<Act> {
    let edges = ring.in_order();
    let ids = ids(ring, fresh);
    let count = edges.len();
    let record = |place: usize| {
        let (after, before) = ((place + 1) % count, (place + count - 1) % count);
        record_write(
            ids[place].0,
            [ring.vertex, edges[place].first_vertex, edges[after].first_vertex],
            [edges[place].outside_record, ids[after].0, ids[before].0],
        )
    };
    let mut acts = VecDeque::new();
    for (place, edge) in edges.iter().enumerate() {
        let ahead = ids.get(place + 1);
        // The first entry is passed over until the id of the last one is known.
        acts.push_back(Act {
            takes: ahead.is_some(),
            gives_back: ahead.is_some_and(|(_, is_inner, _)| *is_inner),
            takes_fresh: ahead.is_some_and(|(.., is_fresh)| *is_fresh),
            ends: false,
            makes: (place > 0).then(|| record(place)),
        });
        if ids[place].0 != edge.cavity_record {
            acts.push_back(Act {
                makes: Some(link_write(edge.outside_record, edge.slot, ids[place].0)),
                ..Act::default()
            });
        }
    }
    acts.push_back(Act { ends: true, makes: Some(record(0)), ..Act::default() });
    acts
}

/// Actions of the test in a clock.
#[derive(Clone, Copy, Debug, Default)]
struct Drive {
    /// The next entry is offered; an entry on offer stays.
    offers: bool,
    /// The next inner record is listed, if there is one.
    lists: bool,
    solo_inserts: bool,
    seeds: bool,
    clears: bool,
    reset: bool,
}

/// Outputs of a clock.
#[derive(Clone, Copy, Debug, Default)]
struct Shown {
    head_valid: bool,
    takes: bool,
    ends: bool,
    write: Option<u128>,
    fresh: u64,
}

/// The commit, and the rings that come to it.
struct CommitRig {
    block: Stepper<Commit>,
    /// Rings to come; the entries of the first one come first. Their inner records are listed one ring ahead.
    rings: VecDeque<Ring>,
    /// Number of inner records that are listed, of the first ring and of the second.
    listed: [usize; 2],
    /// Number of entries of the first ring that were taken.
    taken: usize,
    is_offered: bool,
    /// The ring at work, and the steps that are left for it.
    work: Option<(Ring, VecDeque<Act>)>,
    /// Clocks for which the block has looked for the next inner record.
    age: u32,
    made: Option<u128>,
    count: Count,
    committed: usize,
}

impl CommitRig {
    fn new(name: &'static str, config: Config) -> Self {
        let mut rig = Self {
            block: Stepper::new(name, Commit::new(config), 1),
            rings: VecDeque::new(),
            listed: [0; 2],
            taken: 0,
            is_offered: false,
            work: None,
            age: 0,
            made: None,
            count: Count::default(),
            committed: 0,
        };
        rig.clock(Drive { reset: true, ..Drive::default() });
        rig
    }

    /// Offers the next entry, and lists an inner record of the first ring, or else of the second.
    fn set_inputs(&mut self, drive: Drive) {
        let block = &mut self.block;
        block.set("reset", drive.reset);
        block.set("fresh", self.count.fresh);
        let head = self.rings.front().filter(|ring| ring.inner.len() == self.listed[0]);
        self.is_offered = head.is_some() && (self.is_offered || drive.offers);
        let shares = head.is_some_and(|ring| ring.shares(self.taken)) && self.is_offered;
        let edge = head.map(|ring| ring.in_order()[self.taken]).filter(|_| self.is_offered);
        block.set("head_valid", edge.is_some());
        block.set("head_entry", Edge { after: 0, ..edge.unwrap_or_default() }.entry());
        block.set("head_is_last", edge.is_some_and(|edge| edge.after == 0));
        block.set("head_shares", shares);
        block.set("head_job", head.map_or(0, Ring::job));
        block.set("inner_valid", false);
        let reader = self.work.as_ref().map(|(ring, _)| ring.context);
        for (ring, listed) in self.rings.iter().zip(&mut self.listed) {
            if let Some(id) = ring.inner.get(*listed).filter(|_| drive.lists && reader != Some(ring.context)) {
                block.set("inner_valid", true);
                block.set("inner_context", ring.context);
                block.set("inner_place", *listed as u64);
                block.set("inner_id", *id);
                *listed += 1;
                break;
            }
        }
    }

    /// The step of this clock, and whether it takes an entry.
    fn act(&self) -> (Option<Act>, bool) {
        let Some((_, acts)) = &self.work else {
            return (None, self.is_offered);
        };
        let act = acts[0];
        let waits = act.takes && !self.is_offered || act.gives_back && self.age < 3;
        match act {
            _ if waits => (None, false),
            Act { ends: true, .. } => (Some(act), self.is_offered),
            _ => (Some(act), act.takes),
        }
    }

    /// Runs one clock of the block and the list; nothing is compared in the first one.
    fn clock(&mut self, drive: Drive) -> Shown {
        self.set_inputs(drive);
        let (act, takes) = self.act();
        let ends = act.is_some_and(|act| act.ends);
        let shown = Shown { head_valid: self.is_offered, takes, ends, write: self.made, fresh: self.count.fresh };
        let block = &mut self.block;
        block.settle();
        if block.clocks() > 0 {
            // The block is ready before there is an entry.
            if self.is_offered {
                block.expect("takes", takes);
            }
            block.expect("committed_valid", ends);
            block.expect("takes_fresh", act.is_some_and(|act| act.takes_fresh));
            block.expect("is_at_work", self.work.is_some());
            match self.made {
                Some(write) => block.expect("write", write),
                None => block.expect_masked("write", 1, 0u128),
            }
        }
        if let Some((ring, _)) = self.work.as_ref().filter(|_| ends) {
            block.expect("committed_job", ring.job());
        }
        block.edge();
        self.edge(drive, act, takes);
        shown
    }

    fn edge(&mut self, drive: Drive, act: Option<Act>, takes: bool) {
        self.made = act.and_then(|act| act.makes);
        self.age += 1;
        let act = act.unwrap_or_default();
        if act.gives_back {
            self.age = 0;
        }
        if let Some((_, acts)) = self.work.as_mut().filter(|_| act.makes.is_some() || act.takes) {
            acts.pop_front();
        }
        if act.ends {
            self.work = None;
            self.committed += 1;
        }
        let Drive { solo_inserts, seeds, clears, reset, .. } = drive;
        self.count.edge(Event { takes: act.takes_fresh, ends: act.ends, solo_inserts, seeds, clears, reset });
        if takes {
            self.take();
        }
        if reset {
            self.rings.clear();
            (self.listed, self.taken, self.is_offered) = ([0; 2], 0, false);
            (self.work, self.made) = (None, None);
        }
    }

    /// Takes the entry at the head; the first entry of a ring begins its commit.
    fn take(&mut self) {
        if self.work.is_none() {
            let ring = self.rings[0].clone();
            let acts = acts(&ring, self.count.fresh);
            self.work = Some((ring, acts));
            self.age = 0;
        }
        self.is_offered = false;
        self.taken += 1;
        if self.taken == self.rings[0].entries.len() {
            self.rings.pop_front();
            self.listed = [self.listed[1], 0];
            self.taken = 0;
        }
    }

    /// Keeps two rings coming, never two of one context in a row, since a list is written while the one before is read.
    fn add_rings(&mut self, config: Config, random: &mut SplitMix64) {
        while self.rings.len() < 2 {
            let last = self.rings.back().or(self.work.as_ref().map(|(ring, _)| ring)).map(|ring| ring.context);
            let context = random.below(config.contexts.into());
            if last != Some(context) {
                self.rings.push_back(Ring::random(random_length(config.ring.into(), random), context, random));
            }
        }
    }
}

/// Runs a commit with rings that follow each other at once, and with gaps.
fn writes_stars(name: &'static str, config: Config) {
    let mut random = SplitMix64::new(9);
    let mut rig = CommitRig::new(name, config);
    let (mut at_once, mut waits, mut solo_insertions, mut resets, mut most_inners) = (0, 0, 0, 0, 0);
    for clock in 0..14_000 {
        rig.add_rings(config, &mut random);
        let (offers, lists) = [(8, 8), (8, 8), (5, 8), (2, 4)][clock / 500 % 4];
        let is_idle = rig.work.is_none() && !rig.is_offered && rig.made.is_none() && rig.count.is_settled();
        let event = if is_idle { random.below(16) } else { 16 };
        let drive = Drive {
            offers: event > 2 && random.below(8) < offers,
            lists: random.below(8) < lists,
            solo_inserts: event == 0,
            seeds: event == 1,
            clears: event == 2,
            reset: random.below(1200) == 0,
        };
        let shown = rig.clock(drive);
        at_once += usize::from(shown.ends && shown.takes);
        waits += usize::from(shown.head_valid && !shown.takes);
        solo_insertions += usize::from(drive.solo_inserts);
        resets += usize::from(drive.reset);
        most_inners = most_inners.max(rig.work.as_ref().map_or(0, |(ring, _)| ring.inner.len()));
    }
    let reached = [rig.committed, at_once, waits, solo_insertions, resets];
    assert!(
        reached.iter().zip([400, 100, 1000, 10, 3]).all(|(seen, least)| *seen >= least)
            && most_inners * 6 >= config.ring as usize,
        "rings, taken at once, clocks an entry waited, solo insertions, resets: {reached:?}; \
         {most_inners} inner records"
    );
}

#[test]
fn commit_of_the_shortest_list() {
    writes_stars("commit_6", TINY);
}

#[test]
fn commit_of_the_longest_list() {
    writes_stars("commit_64", LONGEST);
}

fn number(number: u64) -> Cell {
    Cell::Number(number.into())
}

/// Commits a cavity of two records, 0 and 1, as a star of four: two old ids, two new ones.
#[test]
fn commit_shows_the_wave_of_its_header() {
    let edge = |first_vertex, outside_record, cavity_record, after| Edge {
        first_vertex,
        outside_record,
        slot: 1,
        cavity_record,
        after,
    };
    let ring = Ring {
        vertex: 9,
        entries: vec![edge(1, 5, 0, 1), edge(2, 6, 1, 2), edge(3, 7, 1, 3), edge(4, 8, 0, 0)],
        ..Ring::default()
    };
    let mut rig = CommitRig::new("commit_6", TINY);
    rig.clock(Drive { seeds: true, ..Drive::default() });
    for _ in 0..3 {
        rig.clock(Drive { solo_inserts: true, ..Drive::default() });
    }
    rig.rings.extend([ring.clone(), Ring { context: 1, ..ring }]);
    let mut wave = Wave::default();
    for clock in 0..13 {
        let shown = rig.clock(Drive { offers: clock > 0, ..Drive::default() });
        let write = shown.write;
        wave.take(&[
            ("head_valid", Cell::Bit(shown.head_valid)),
            ("takes", Cell::Bit(shown.takes)),
            ("ends", Cell::Bit(shown.ends)),
            ("write.valid", Cell::Bit(write.is_some())),
            ("write.vertices", Cell::Bit(write.is_some_and(|write| write >> 16 & 1 == 1))),
            ("write.id", write.map_or(Cell::Open, |write| Cell::Number(write >> 1 & 0x7fff))),
            ("fresh", number(shown.fresh)),
        ]);
    }
    wave.assert_drawn_in("commit");
}
