//! What a visit that completes means, and what follows from it: Rust, Verilog and a statement of each rule agree, over all inputs
//! where these are single bits, and over random ones.

mod attempt_state;
mod block_ports;
mod stepper;

use attempt_state::State;
use incircle_cli::generate::SplitMix64;
use incircle_hdl::engine::{AttemptLists, NextVisits, VisitCase};
use stepper::bundles::{commit_job, release_job, turned, Edge, Finding, LockFinding, Visit};
use stepper::{named_ports, Stepper};

named_ports!(
    VisitCase,
    [done, token, turned, verdict, seeded, is_busy, is_waiter, drains, is_full],
    [
        is_walk,
        is_root,
        is_test,
        looks,
        repeats,
        waits,
        walks_on,
        locates,
        opens,
        retries,
        splits,
        settles,
        overflows,
        gives_up_root,
        gives_up,
        walk_duplicate,
        root_duplicate
    ]
);
named_ports!(NextVisits, [token, turned, walk_next, entry, repeats, walks_on, locates, opens, splits], [push, bundle]);
named_ports!(
    AttemptLists,
    [done, token, turned, attempt, after, p, since, is_root, settles, finds_inner, succeeds, fails, stops_at_root],
    [
        entry_enable,
        entry_place,
        entry,
        inner_enable,
        inner_place,
        inner_id,
        lock_enable,
        lock_place,
        lock_id,
        commit_enable,
        commit_job,
        release_enable,
        release_job
    ]
);

const ROUNDS: usize = 6000;

fn id(random: &mut SplitMix64) -> u64 {
    random.below(1 << 15)
}

fn flip(random: &mut SplitMix64) -> bool {
    random.below(2) == 1
}

/// Every field random.
fn visit(random: &mut SplitMix64) -> Visit {
    Visit {
        owner: random.below(24),
        rotates: flip(random),
        locks: flip(random),
        x: random.below(64),
        after: random.below(64),
        f_entry: random.below(64),
        f: id(random),
        u: id(random),
    }
}

/// Outputs of `VisitCase` of which at most one is high.
const CASES: [&str; 13] = [
    "looks",
    "repeats",
    "walks_on",
    "locates",
    "opens",
    "retries",
    "splits",
    "settles",
    "overflows",
    "gives_up_root",
    "gives_up",
    "walk_duplicate",
    "root_duplicate",
];

/// The single bits that a case follows from.
struct Bits {
    done: bool,
    rotates: bool,
    locks: bool,
    seeded: bool,
    lock: LockFinding,
    finding: Finding,
    is_busy: bool,
    is_waiter: bool,
    drains: bool,
    is_full: bool,
}

impl Bits {
    /// The bits of a number.
    fn of(number: u64) -> Self {
        let bit = |place: u32| number >> place & 1 == 1;
        let finding = Finding { conflict: bit(3), located: bit(4), falls_onto_corner: bit(5), ..Finding::default() };
        Self {
            done: bit(0),
            rotates: bit(1),
            locks: bit(2),
            seeded: bit(6),
            lock: LockFinding { foreign: bit(7), again: bit(8), took: false },
            finding,
            is_busy: bit(9),
            is_waiter: bit(10),
            drains: bit(11),
            is_full: bit(12),
        }
    }

    /// What the visit means, as the rules have it.
    fn case(&self) -> Option<&'static str> {
        let Finding { conflict, located, falls_onto_corner, .. } = self.finding;
        if !self.done {
            return None;
        }
        if self.rotates {
            return match (self.drains, self.lock.foreign, conflict) {
                (true, ..) => None,
                (_, true, _) if self.is_waiter => Some("repeats"),
                (_, true, _) => Some("gives_up"),
                (.., false) => Some("settles"),
                (.., true) if self.is_full => Some("overflows"),
                (.., true) => Some("splits"),
            };
        }
        if self.locks {
            return Some(match (self.lock.foreign, located) {
                (true, _) if self.is_waiter => "repeats",
                (true, _) => "gives_up_root",
                (_, false) => "retries",
                (_, true) if falls_onto_corner => "root_duplicate",
                (_, true) => "opens",
            });
        }
        Some(match (self.lock.again, located) {
            _ if !self.seeded => "looks",
            (true, _) => "repeats",
            (_, false) => "walks_on",
            (_, true) if falls_onto_corner => "walk_duplicate",
            (_, true) if self.is_busy => "repeats",
            (_, true) => "locates",
        })
    }
}

#[test]
fn visit_case_decides_every_case_by_its_rules() {
    let mut random = SplitMix64::new(50);
    let mut block = Stepper::new("visit_case", VisitCase::default(), 1);
    let mut seen = [0; CASES.len()];
    for number in 0..1 << 13 {
        let bits = Bits::of(number);
        let token = Visit { rotates: bits.rotates, locks: bits.locks, ..visit(&mut random) };
        let lock = LockFinding { took: flip(&mut random), ..bits.lock };
        let finding = Finding {
            is_left: flip(&mut random),
            is_straight: flip(&mut random),
            walk_next: id(&mut random),
            ..bits.finding
        };
        block.set("done", bits.done);
        block.set("token", token.token());
        block.set("turned", turned([id(&mut random); 3], [id(&mut random); 3], 1, lock, [flip(&mut random); 3]));
        block.set("verdict", finding.verdict());
        for (port, value) in [
            ("seeded", bits.seeded),
            ("is_busy", bits.is_busy),
            ("is_waiter", bits.is_waiter),
            ("drains", bits.drains),
            ("is_full", bits.is_full),
        ] {
            block.set(port, value);
        }
        let case = bits.case();
        block.settle();
        block.expect("is_walk", bits.done && !bits.rotates && !bits.locks && bits.seeded);
        block.expect("is_root", bits.done && !bits.rotates && bits.locks);
        block.expect("is_test", bits.done && bits.rotates);
        block.expect("waits", case == Some("repeats") && (bits.locks || bits.rotates));
        for (port, seen) in CASES.into_iter().zip(&mut seen) {
            block.expect(port, case == Some(port));
            *seen += usize::from(case == Some(port));
        }
    }
    assert!(seen.iter().all(|seen| *seen > 0), "{seen:?}");
}

#[test]
fn next_visits_asks_for_one_two_or_three() {
    let mut random = SplitMix64::new(52);
    let mut block = Stepper::new("next_visits", NextVisits::default(), 1);
    for _ in 0..ROUNDS {
        let case = random.below(6);
        let n = [(); 3].map(|()| id(&mut random));
        let (walk_next, y) = (id(&mut random), random.below(64));
        let random_visit = visit(&mut random);
        // Walks and roots have no entry.
        let look = Visit { owner: random_visit.owner, ..Visit::look(random_visit.u) };
        let token = match case {
            1 | 2 => look,
            3 => Visit { locks: true, ..look },
            4 => Visit { rotates: true, locks: true, ..random_visit },
            _ => random_visit,
        };
        block.set("token", token.token());
        block.set("turned", turned([id(&mut random); 3], n, 1, LockFinding::default(), [false; 3]));
        block.set("walk_next", walk_next);
        block.set("entry", y);
        for (code, port) in ["repeats", "walks_on", "locates", "opens", "splits"].into_iter().enumerate() {
            block.set(port, case == code as u64);
        }
        let Visit { owner, u, after, .. } = token;
        let (visits, bundle) = match case {
            0 => (1, token.bundle(1, 0, 0, 0)),
            1 => (1, Visit { owner, ..Visit::look(walk_next) }.bundle(1, 0, 0, 0)),
            2 => (1, Visit { locks: true, ..token }.bundle(1, 0, 0, 0)),
            3 => {
                let first = Visit { owner, rotates: true, locks: true, x: 0, after: 1, f_entry: 0, f: u, u: n[0] };
                (3, first.bundle(3, 2, n[1], n[2]))
            }
            4 => {
                let first = Visit { after: y, f_entry: y, f: u, u: n[1], ..token };
                (2, first.bundle(2, after, n[2], 0))
            }
            _ => (0, 0),
        };
        block.settle();
        block.expect("push", visits > 0);
        if let Some(bits) = [0, 57, 78, 93].get(visits).filter(|bits| **bits > 0) {
            let mask = (1 << bits) - 1;
            block.expect_masked("bundle", mask, bundle & mask);
        }
    }
}

#[test]
fn attempt_lists_add_what_was_found_and_hand_over_what_was_counted() {
    let mut random = SplitMix64::new(53);
    let mut block = Stepper::new("attempt_lists", AttemptLists::default(), 1);
    for _ in 0..ROUNDS {
        let token = visit(&mut random);
        let [v0, v1, v2, n0, n1, n2, p] = [(); 7].map(|()| id(&mut random));
        let lock = LockFinding { took: flip(&mut random), ..LockFinding::default() };
        let (slot, since) = (random.below(3), random.below(1 << 22));
        let [before, after] = [(); 2].map(|()| State::random(&mut random));
        block.set("token", token.token());
        block.set("turned", turned([v0, v1, v2], [n0, n1, n2], slot, lock, [false; 3]));
        block.set("attempt", before.packed());
        block.set("after", after.packed());
        block.set("p", p);
        block.set("since", since);
        let ports = ["done", "is_root", "settles", "finds_inner", "succeeds", "fails", "stops_at_root"];
        let flags = ports.map(|_| flip(&mut random));
        let [done, is_root, settles, finds_inner, succeeds, fails, stops_at_root] = flags;
        for (port, value) in ports.into_iter().zip(flags) {
            block.set(port, value);
        }
        block.settle();
        block.expect("entry_enable", settles);
        block.expect("entry_place", token.x);
        block.expect("entry", Edge { a: v2, u: token.u, slot, f: token.f, after: token.after }.entry());
        block.expect("inner_enable", finds_inner);
        block.expect("inner_place", before.inners);
        block.expect("inner_id", token.f);
        block.expect("lock_enable", done && lock.took);
        block.expect("lock_place", if is_root { 0 } else { before.logged });
        block.expect("lock_id", token.u);
        block.expect("commit_enable", succeeds);
        block.expect("commit_job", commit_job(token.owner, p, before.inners, after.logged, since));
        block.expect("release_enable", fails || stops_at_root);
        block.expect("release_job", release_job(token.owner, if stops_at_root { 1 } else { after.logged }));
    }
}
