//! The cavity and the visits that open it: Rust behaviour, Verilog and a count of open edges agree clock by clock.
//!
//! The reference knows no bits of half-open triangles: it counts, for every cavity triangle, the boundary edges it still has.

mod block_ports;
mod cosimulation;
mod structures;

use std::cell::RefCell;

use cosimulation::{named_ports, Cosimulation, Expected, Numbers};
use incircle_hdl::engine::{Cavity, RootBundle};
use incircle_protocol::{Config, MAX_RING, TINY};
use structures::{pack, random, unpack, BUNDLE, ENTRY, TOKEN, TURNED, VERDICT};

named_ports!([] RootBundle, [step, root_id, root], [bundle, visits]);
named_ports!([] Cavity,
    [reset, ring, is_root, is_cavity, is_drain, root_visits, done, token, turned, verdict, entry_pointer, inner_pointer],
    [split, split_bundle, overflows, nothing_is_out, count, inner_count, entry, inner_id], clock);

const CYCLES: usize = 12_000;
const INPUTS: [&str; 12] = [
    "reset",
    "ring",
    "is_root",
    "is_cavity",
    "is_drain",
    "root_visits",
    "done",
    "token",
    "turned",
    "verdict",
    "entry_pointer",
    "inner_pointer",
];
const OUTPUTS: [&str; 8] =
    ["split", "split_bundle", "overflows", "nothing_is_out", "count", "inner_count", "entry", "inner_id"];

#[test]
fn root_bundle_locks_the_root_and_tests_its_neighbours() {
    let mut numbers = Numbers::new(41);
    let stimuli: Vec<Vec<u128>> = (0..4_000)
        .map(|_| {
            let root = pack(TURNED, random(TURNED, |bits| numbers.bits(bits)));
            vec![numbers.bits(3).into(), numbers.bits(15).into(), root]
        })
        .collect();
    Cosimulation {
        name: "root_bundle",
        rust: RootBundle::default(),
        inputs: &["step", "root_id", "root"],
        outputs: &["bundle", "visits"],
    }
    .run(stimuli, |values| {
        let root_id = values[1] as u64;
        let [_, _, _, n0, n1, n2, ..] = unpack(TURNED, values[2]);
        // The fields of the second visit stand there always.
        let second = [1, 2, n1];
        let (visits, first) = match values[0] {
            0 => (1, [0, 0, 1, 0, 0, 0, 0, root_id]),
            1 => (2, [1, 1, 1, 0, 1, 0, root_id, n0]),
            _ => (1, [0, 1, 1, 2, 0, 0, root_id, n2]),
        };
        let mut bundle = [0; 11];
        bundle[..8].copy_from_slice(&first);
        bundle[8..].copy_from_slice(&second);
        vec![Some(pack(BUNDLE, bundle)), Some(visits)]
    });
}

#[derive(Clone, Copy, PartialEq)]
enum Phase {
    /// Nothing of a cavity; visits of walks complete.
    Walk,
    /// The visits of the root are pushed; the step that comes next.
    Root(u64),
    Cavity,
    Drain,
}

/// A cavity as it grows, its visits kept in a bag from which any completes next.
struct Growth {
    ring: u64,
    phase: Phase,
    /// Visits out: `Some` a test with its ring entry, the entry after it, and the number and id of the triangle behind the edge;
    /// `None` the root's lock.
    out: Vec<Option<[u64; 4]>>,
    count: Expected,
    /// Boundary edges that a cavity triangle still has, by the entry it came with.
    open_edges: Vec<u32>,
    inners: Vec<u64>,
    is_known: bool,
    list: Vec<Expected>,
    inner_ids: Vec<Expected>,
    /// Percent of tests that find a conflict, chosen for each cavity.
    appetite: u64,
    splits: usize,
    overflows: usize,
    finished: usize,
    most_inners: usize,
}

impl Growth {
    fn new(ring: u32) -> Self {
        let places = ring.next_power_of_two() as usize;
        Self {
            ring: ring.into(),
            phase: Phase::Walk,
            out: vec![],
            count: None,
            open_edges: vec![0; 64],
            inners: vec![],
            is_known: false,
            list: vec![None; places],
            inner_ids: vec![None; places],
            appetite: 0,
            splits: 0,
            overflows: 0,
            finished: 0,
            most_inners: 0,
        }
    }

    /// Inputs of the next cycle.
    fn stimulus(&mut self, first: bool, numbers: &mut Numbers) -> Vec<u128> {
        let mut token = random(TOKEN, |bits| numbers.bits(bits));
        let mut done = numbers.bits(1);
        let mut visits: u64 = 0;
        match self.phase {
            Phase::Walk => token[0] = 0,
            Phase::Root(step) => {
                done = 0;
                visits = [1, 2, 1][step as usize];
            }
            Phase::Cavity | Phase::Drain => {
                done &= u64::from(!self.out.is_empty());
                if done == 1 {
                    let place = numbers.next() as usize % self.out.len();
                    match self.out.swap_remove(place) {
                        None => token[0] = 0,
                        Some([x, after, f_entry, f]) => {
                            token[0] = 1;
                            token[2..6].copy_from_slice(&[x, after, f_entry, f]);
                        }
                    }
                }
            }
        }
        let mut verdict = random(VERDICT, |bits| numbers.bits(bits));
        verdict[0] = u64::from(numbers.next() % 100 < self.appetite);
        let reset = first || numbers.once_in(300);
        vec![
            reset.into(),
            self.ring.into(),
            matches!(self.phase, Phase::Root(_)).into(),
            (self.phase == Phase::Cavity).into(),
            (self.phase == Phase::Drain).into(),
            visits.into(),
            done.into(),
            pack(TOKEN, token),
            pack(TURNED, random(TURNED, |bits| numbers.bits(bits))),
            pack(VERDICT, verdict),
            numbers.bits(6).into(),
            numbers.bits(6).into(),
        ]
    }

    /// Outputs of a cycle with these inputs; then its edge.
    fn cycle(&mut self, values: &[u128], numbers: &mut Numbers) -> Vec<Expected> {
        let token = unpack(TOKEN, values[7]);
        let turned = unpack(TURNED, values[8]);
        let [rotates, _, x, after, f_entry, f, u] = token;
        let is_test = values[6] == 1 && rotates == 1 && self.phase == Phase::Cavity;
        let conflict = is_test && values[9] & 1 == 1;
        let is_full = self.count == Some(self.ring.into());
        let splits = conflict && !is_full;
        let y = self.count.map_or(0, |count| count as u64);
        let bundle = [1, 1, 1, x, y, y, u, turned[4], y, after, turned[5]];
        let places = self.list.len();
        let outputs = vec![
            Some(splits.into()),
            splits.then(|| pack(BUNDLE, bundle)),
            Some((conflict && is_full).into()),
            Some(self.nothing_is_out(values[6] == 1).into()).filter(|_| self.is_known),
            self.count,
            self.count.map(|_| self.inners.len() as u128),
            self.list[values[10] as usize % places],
            self.inner_ids[values[11] as usize % places],
        ];
        if is_test && !conflict {
            let entry = [turned[2], u, turned[6], f, after];
            self.list[x as usize] = Some(pack(ENTRY, entry));
        }
        if splits {
            self.split([x, after, f_entry, f], y, u);
        }
        self.step(values, conflict && is_full, numbers);
        outputs
    }

    /// No visit is out; the one that completes in this cycle has left the bag and still counts.
    fn nothing_is_out(&self, done: bool) -> bool {
        let counts = matches!(self.phase, Phase::Cavity | Phase::Drain);
        self.out.is_empty() && !(done && counts)
    }

    fn split(&mut self, [x, after, f_entry, f]: [u64; 4], y: u64, u: u64) {
        self.splits += 1;
        self.out.push(Some([x, y, y, u]));
        self.out.push(Some([y, after, y, u]));
        self.count = Some(u128::from(y) + 1);
        self.open_edges[y as usize] = 2;
        self.open_edges[f_entry as usize] -= 1;
        if self.open_edges[f_entry as usize] == 0 {
            self.inner_ids[self.inners.len()] = Some(f.into());
            self.inners.push(f);
            self.most_inners = self.most_inners.max(self.inners.len());
        }
    }

    /// The phase after this edge, and what it resets.
    fn step(&mut self, values: &[u128], overflows: bool, numbers: &mut Numbers) {
        match self.phase {
            Phase::Walk => {
                if numbers.once_in(6) {
                    self.phase = Phase::Root(0);
                }
            }
            Phase::Root(step) => {
                self.count = Some(3);
                self.inners.clear();
                self.open_edges[0] = 3;
                let root = values[7] as u64 & 0x7fff;
                match step {
                    0 => self.out.push(None),
                    1 => self.out.extend([Some([0, 1, 0, root]), Some([1, 2, 0, root])]),
                    _ => self.out.push(Some([2, 0, 0, root])),
                }
                self.appetite = [20, 50, 60, 100][numbers.bits(2) as usize];
                self.phase = if step == 2 { Phase::Cavity } else { Phase::Root(step + 1) };
            }
            Phase::Cavity | Phase::Drain => {
                if overflows {
                    self.overflows += 1;
                    self.phase = Phase::Drain;
                } else if self.out.is_empty() {
                    self.finished += usize::from(self.phase == Phase::Cavity);
                    self.phase = Phase::Walk;
                }
            }
        }
        if values[0] == 1 {
            self.out.clear();
            self.is_known = true;
            self.phase = Phase::Walk;
        }
    }
}

/// Runs a cavity with a list of `ring` entries; some cavity must keep as many inner triangles as `inners`.
fn cavity(name: &str, ring: u32, inners: usize) {
    let growth = RefCell::new((Growth::new(ring), Numbers::new(42)));
    let stimuli = (0..CYCLES).map(|cycle| {
        let (growth, numbers) = &mut *growth.borrow_mut();
        growth.stimulus(cycle == 0, numbers)
    });
    Cosimulation { name, rust: Cavity::new(Config { ring, ..TINY }), inputs: &INPUTS, outputs: &OUTPUTS }.run(
        stimuli,
        |values| {
            let (growth, numbers) = &mut *growth.borrow_mut();
            growth.cycle(values, numbers)
        },
    );
    let growth = growth.into_inner().0;
    let reached = [growth.splits, growth.overflows, growth.finished, growth.most_inners];
    assert!(
        reached.iter().zip([1000, 20, 20, inners]).all(|(seen, least)| *seen >= least),
        "splits, overflows, finished cavities, inner triangles: {reached:?}"
    );
}

#[test]
fn cavity_of_the_shortest_list() {
    cavity("cavity_6", 6, 1);
}

#[test]
fn cavity_of_the_longest_list() {
    cavity("cavity_64", MAX_RING, 10);
}
