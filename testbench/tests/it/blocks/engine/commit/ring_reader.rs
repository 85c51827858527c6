//! Runs `RingReader` in Rust and in Verilog beside a list of all entries in their order: all three must agree in every
//! clock. The list is laid out when a ring is finished, and has no pointers.

use std::collections::VecDeque;

use crate::rig::random_rings::{random_length, Ring};
use crate::rig::stepper::bundles::Edge;
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::engine::RingReader;
use incircle_protocol::{Config, MAX_CONTEXTS, MAX_RING, TINY};
use incircle_testkit::SplitMix64;

named_ports!(RingReader, [reset, entry, commit, takes], [head, head_job], clock);

/// An entry at its place in the order.
#[derive(Clone, Copy, Debug, Default)]
struct Item {
    entry: u128,
    is_first: bool,
    is_last: bool,
    /// The cavity record of the entry is that of the entry before or of the first one too.
    shares: bool,
    job: u128,
    context: u64,
}

/// The reader as a list: five stages that all move when the last one is empty or taken.
#[derive(Default)]
struct ReaderReference {
    coming: VecDeque<Item>,
    stages: [Option<Item>; 5],
}

impl ReaderReference {
    fn head(&self) -> Option<Item> {
        self.stages[4]
    }

    fn edge(&mut self, takes: bool, finished: Option<&Ring>) {
        if self.head().is_none() || takes {
            self.stages.rotate_right(1);
            // Behind a ring one place stays empty.
            let is_past_a_ring = self.stages[1].is_some_and(|item| item.is_last);
            self.stages[0] = if is_past_a_ring { None } else { self.coming.pop_front() };
        }
        if let Some(ring) = finished {
            let (order, job, context) = (ring.in_order(), ring.job(), ring.context);
            self.coming.extend(order.iter().enumerate().map(|(place, edge)| Item {
                entry: Edge { after: 0, ..*edge }.entry(),
                is_first: place == 0,
                is_last: edge.after == 0,
                shares: ring.shares(place),
                job,
                context,
            }));
        }
    }
}

/// A context: its ring, and the places that are not final yet, of which none is left once the ring is finished.
#[derive(Clone, Default)]
struct Filling {
    ring: Ring,
    open_places: Vec<u64>,
}

/// The block, its reference, and contexts that fill their lists side by side.
struct ReaderRig {
    block: Stepper<RingReader>,
    reference: ReaderReference,
    contexts: Vec<Option<Filling>>,
    longest: u64,
    finished: usize,
    heads: usize,
    shared: usize,
}

/// Events at an edge.
#[derive(Default)]
struct Drive {
    reset: bool,
    takes: bool,
    /// The entry of a context that becomes final.
    entry: Option<(u64, u64, Edge)>,
    /// The ring that the entry finishes, if any.
    finished: Option<Ring>,
}

impl ReaderRig {
    fn new(name: &'static str, config: Config) -> Self {
        let mut rig = Self {
            block: Stepper::new(name, RingReader::new(config), 5),
            reference: ReaderReference::default(),
            contexts: vec![None; config.contexts as usize],
            longest: config.ring.into(),
            finished: 0,
            heads: 0,
            shared: 0,
        };
        rig.clock(&Drive { reset: true, ..Drive::default() });
        rig
    }

    /// Runs one clock of the block and the reference; nothing is compared in the first one.
    fn clock(&mut self, drive: &Drive) {
        let block = &mut self.block;
        let (context, place, edge) =
            drive.entry.unwrap_or((7, 5, Edge { first_vertex: 0x1234, after: 1, ..Edge::default() }));
        block.set("reset", drive.reset);
        block.set("entry_valid", drive.entry.is_some());
        block.set("entry_context", context);
        block.set("entry_place", place);
        block.set("entry_entry", edge.entry());
        block.set("commit_valid", drive.finished.is_some());
        block.set("commit_job", drive.finished.as_ref().map_or(0, Ring::job));
        block.set("takes", drive.takes);
        block.settle();
        let head = self.reference.head();
        if block.clocks() > 0 {
            block.expect("head_valid", head.is_some());
        }
        if let Some(item) = head {
            block.expect("head_entry", item.entry);
            block.expect("head_is_last", item.is_last);
            block.expect("head_shares", item.shares);
            if item.is_first {
                block.expect("head_job", item.job);
            }
            self.heads += usize::from(drive.takes);
            self.shared += usize::from(drive.takes && item.shares);
        }
        block.edge();
        self.reference.edge(drive.takes, drive.finished.as_ref());
        if let Some(item) = head.filter(|item| drive.takes && item.is_last) {
            self.contexts[item.context as usize] = None;
        }
        if drive.reset {
            self.reference = ReaderReference::default();
            self.contexts.fill(None);
        }
    }

    /// Makes entries of any context final in any order, and takes the head, each in this many of 8 clocks.
    fn random_drive(&mut self, fills: u64, takes: u64, random: &mut SplitMix64) -> Drive {
        let mut drive = Drive { reset: random.below(900) == 0, takes: random.below(8) < takes, ..Drive::default() };
        let context = random.below(self.contexts.len() as u64);
        let longest = self.longest;
        if random.below(8) >= fills {
            return drive;
        }
        let filling = self.contexts[context as usize].get_or_insert_with(|| {
            let ring = Ring::random(random_length(longest, random), context, random);
            let mut open_places: Vec<u64> = (0..ring.entries.len() as u64).collect();
            random.shuffle(&mut open_places);
            Filling { ring, open_places }
        });
        if let Some(place) = filling.open_places.pop() {
            drive.entry = Some((context, place, filling.ring.entries[place as usize]));
            if filling.open_places.is_empty() {
                drive.finished = Some(filling.ring.clone());
                self.finished += 1;
            }
        }
        drive
    }
}

/// Runs a reader with rings that come faster than they are taken, and slower.
fn reads_rings(name: &'static str, config: Config) {
    let mut random = SplitMix64::new(7);
    let mut rig = ReaderRig::new(name, config);
    let (mut most_waiting, mut droughts) = (0, 0);
    for clock in 0..12_000 {
        let (fills, takes) = [(8, 3), (8, 8), (4, 8), (8, 6), (2, 4)][clock / 300 % 5];
        let drive = rig.random_drive(fills, takes, &mut random);
        rig.clock(&drive);
        most_waiting = most_waiting.max(rig.reference.coming.iter().filter(|item| item.is_last).count());
        droughts += usize::from(rig.reference.head().is_none());
    }
    assert!(
        rig.finished > 300
            && rig.heads > 3_000
            && rig.shared * 8 > rig.heads
            && most_waiting + 1 >= config.contexts.min(12) as usize
            && droughts > 300,
        "{} rings, {} heads, {} of which share, {most_waiting} waiting, {droughts} clocks without a head",
        rig.finished,
        rig.heads,
        rig.shared
    );
}

#[test]
fn ring_reader_of_the_shortest_list() {
    reads_rings("ring_reader_6", TINY);
}

#[test]
fn ring_reader_of_the_longest_list() {
    reads_rings("ring_reader_64", Config { ring: MAX_RING, contexts: MAX_CONTEXTS, ..TINY });
}

#[test]
fn ring_reader_shows_the_wave_of_its_header() {
    let mut rig = ReaderRig::new("ring_reader_6", TINY);
    let ring = |context: u64| {
        let edge = |place: u64, after: u64, cavity_record: u64| Edge {
            first_vertex: 20 - 10 * context + place,
            cavity_record,
            after,
            ..Edge::default()
        };
        Ring { context, entries: vec![edge(0, 2, 7), edge(1, 0, 8), edge(2, 1, 7)], ..Ring::default() }
    };
    let (one, zero) = (ring(1), ring(0));
    let mut wave = Wave::default();
    for clock in 0..17 {
        let of = |ring: &Ring, place: u64| Some((ring.context, place, ring.entries[place as usize]));
        let head = rig.reference.head();
        let drive = Drive {
            reset: false,
            takes: head.is_some() && clock != 10,
            entry: match clock {
                1..=3 => of(&one, clock - 1),
                4..=6 => of(&zero, clock - 4),
                _ => None,
            },
            finished: [(3, &one), (6, &zero)].into_iter().find(|(at, _)| *at == clock).map(|(_, ring)| ring.clone()),
        };
        rig.clock(&drive);
        let number = |number: Option<u64>| number.map_or(Cell::Open, |number| Cell::Number(number.into()));
        wave.take(&[
            ("entry_enable", Cell::Bit(drive.entry.is_some())),
            ("entry_place", number(drive.entry.map(|(_, place, _)| place))),
            ("job_enable", Cell::Bit(drive.finished.is_some())),
            ("head_valid", Cell::Bit(head.is_some())),
            ("head.first_vertex", number(head.map(|item| item.entry as u64 & 0x7fff))),
            ("head_is_last", Cell::Bit(head.is_some_and(|item| item.is_last))),
            ("head_shares", Cell::Bit(head.is_some_and(|item| item.shares))),
            ("head_job.context", number(head.filter(|item| item.is_first).map(|item| item.context))),
            ("takes", Cell::Bit(drive.takes)),
        ]);
    }
    wave.assert_drawn_in("ring_reader");
}
