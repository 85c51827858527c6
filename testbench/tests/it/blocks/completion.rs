//! What a visit that completes means, and what follows from it: Rust, Verilog and a statement of each rule agree, over all inputs
//! where these are single bits, and over random ones.

use crate::rig::attempt_state::State;
use crate::rig::stepper::bundles::{commit_job, flip, id, release_job, turned, Edge, Finding, LockFinding, Visit};
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_cli::generate::SplitMix64;
use incircle_hdl::engine::{AttemptLists, NextVisits, VisitCase};

named_ports!(
    VisitCase,
    [early_done, early_token, early_turned, seeded, is_busy, is_waiter, verdict, drains, is_full],
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
        root_duplicate,
        is_done,
        asks,
        may_ask
    ],
    clock
);
named_ports!(NextVisits, [early_token, early_turned, walks_on, locates, walk_next, entry], [bundle], clock);
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

/// Drives what is looked at a clock ahead.
fn set_early(block: &mut Stepper<VisitCase>, bits: &Bits, random: &mut SplitMix64) {
    let token = Visit { rotates: bits.rotates, locks: bits.locks, ..Visit::random(random) };
    let lock = LockFinding { took: flip(random), ..bits.lock };
    block.set("early_done", bits.done);
    block.set("early_token", token.token());
    block.set("early_turned", turned([id(random); 3], [id(random); 3], 1, lock, [flip(random); 3]));
    for (port, value) in [("seeded", bits.seeded), ("is_busy", bits.is_busy), ("is_waiter", bits.is_waiter)] {
        block.set(port, value);
    }
}

/// One clock: what was looked at in the one before, with its verdict, and the next.
fn case_clock(block: &mut Stepper<VisitCase>, bits: &Bits, upcoming: &Bits, random: &mut SplitMix64) {
    set_early(block, upcoming, random);
    let finding = Finding { is_left: flip(random), is_straight: flip(random), walk_next: id(random), ..bits.finding };
    block.set("verdict", finding.verdict());
    block.set("drains", bits.drains);
    block.set("is_full", bits.is_full);
    let case = bits.case();
    block.settle();
    if block.clocks() > 0 {
        block.expect("is_done", bits.done);
        block.expect("is_walk", bits.done && !bits.rotates && !bits.locks && bits.seeded);
        block.expect("is_root", bits.done && !bits.rotates && bits.locks);
        block.expect("is_test", bits.done && bits.rotates);
        block.expect("waits", case == Some("repeats") && (bits.locks || bits.rotates));
        for port in CASES {
            block.expect(port, case == Some(port));
        }
        let asks = ["repeats", "walks_on", "locates", "opens", "splits"].map(Some).contains(&case);
        let settles = bits.rotates && !bits.lock.foreign && !bits.finding.conflict;
        block.expect("asks", asks);
        block.expect("may_ask", bits.done && !settles);
    }
    block.edge();
}

#[test]
fn visit_case_decides_every_case_by_its_rules() {
    let mut random = SplitMix64::new(50);
    let mut block = Stepper::new("visit_case", VisitCase::default(), 1);
    let mut seen = [0; CASES.len()];
    let mut numbers: Vec<u64> = (0..1 << 13).collect();
    random.shuffle(&mut numbers);
    let mut bits = Bits::of(0);
    case_clock(&mut block, &bits, &bits, &mut random);
    for number in numbers {
        let upcoming = Bits::of(number);
        case_clock(&mut block, &bits, &upcoming, &mut random);
        for (port, seen) in CASES.into_iter().zip(&mut seen) {
            *seen += usize::from(bits.case() == Some(port));
        }
        bits = upcoming;
    }
    assert!(seen.iter().all(|seen| *seen > 0), "{seen:?}");
}

#[test]
fn visit_case_shows_the_wave_of_its_header() {
    let mut random = SplitMix64::new(56);
    let mut block = Stepper::new("visit_case", VisitCase::default(), 2);
    let nothing = || Bits { seeded: true, ..Bits::of(0) };
    let at = |clock: usize| match clock {
        1 => Bits { done: true, finding: Finding { located: true, ..Finding::default() }, ..nothing() },
        3 => Bits { done: true, locks: true, finding: Finding { located: true, ..Finding::default() }, ..nothing() },
        5 => {
            let lock = LockFinding { foreign: true, ..LockFinding::default() };
            Bits { done: true, rotates: true, locks: true, lock, ..nothing() }
        }
        4 => Bits { locks: true, ..nothing() },
        _ => nothing(),
    };
    let mut wave = Wave::default();
    case_clock(&mut block, &nothing(), &at(0), &mut random);
    for clock in 0..9 {
        let (bits, upcoming) = (if clock == 0 { nothing() } else { at(clock - 1) }, at(clock));
        case_clock(&mut block, &bits, &upcoming, &mut random);
        let case = bits.case();
        wave.take(&[
            ("early_done", Cell::Bit(upcoming.done)),
            ("early.rotates", Cell::Bit(upcoming.rotates)),
            ("early.locks", Cell::Bit(upcoming.locks)),
            ("early.foreign", Cell::Bit(upcoming.lock.foreign)),
            ("located", Cell::Bit(bits.finding.located)),
            ("is_walk", Cell::Bit(bits.done && !bits.locks)),
            ("locates", Cell::Bit(case == Some("locates"))),
            ("opens", Cell::Bit(case == Some("opens"))),
            ("gives_up", Cell::Bit(case == Some("gives_up"))),
            ("asks", Cell::Bit(matches!(case, Some("locates" | "opens")))),
            ("may_ask", Cell::Bit(bits.done)),
        ]);
    }
    wave.assert_drawn_in("visit_case");
}

/// A visit that completes, and what follows: its bundle, of as many bits as count.
struct Follow {
    token: Visit,
    n: [u64; 3],
    is_foreign: bool,
    walks_on: bool,
    locates: bool,
    walk_next: u64,
    y: u64,
    visits: u64,
    bundle: u128,
}

impl Follow {
    /// Any visit of a case: it repeats, walks on, locates, opens, or splits.
    fn random(case: u64, random: &mut SplitMix64) -> Self {
        let n = [(); 3].map(|()| id(random));
        let (walk_next, y) = (id(random), random.below(64));
        let any = Visit::random(random);
        // Walks and roots have no entry.
        let look = Visit { owner: any.owner, ..Visit::look(any.u) };
        let token = match case {
            1 | 2 => look,
            3 => Visit { locks: true, ..look },
            4 => Visit { rotates: true, locks: true, ..any },
            _ => any,
        };
        let Visit { owner, u, after, .. } = token;
        let (visits, bundle) = match case {
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
            _ => (1, token.bundle(1, 0, 0, 0)),
        };
        let (walks_on, locates, is_foreign) = (case == 1, case == 2, case == 0);
        Self { token, n, is_foreign, walks_on, locates, walk_next, y, visits, bundle }
    }
}

/// One clock: what follows the visit that completes, and the one that does in the next clock.
fn follow_clock(block: &mut Stepper<NextVisits>, follow: &Follow, upcoming: &Follow, random: &mut SplitMix64) {
    let lock = LockFinding { foreign: upcoming.is_foreign, ..LockFinding::default() };
    block.set("early_token", upcoming.token.token());
    block.set("early_turned", turned([id(random); 3], upcoming.n, 1, lock, [false; 3]));
    block.set("walks_on", follow.walks_on);
    block.set("locates", follow.locates);
    block.set("walk_next", follow.walk_next);
    block.set("entry", follow.y);
    block.settle();
    if block.clocks() > 0 {
        let mask = (1 << [0, 57, 78, 93][follow.visits as usize]) - 1;
        block.expect_masked("bundle", mask, follow.bundle & mask);
    }
    block.edge();
}

#[test]
fn next_visits_asks_for_one_two_or_three() {
    let mut random = SplitMix64::new(52);
    let mut block = Stepper::new("next_visits", NextVisits::default(), 1);
    let mut follow = Follow::random(0, &mut random);
    for _ in 0..ROUNDS {
        let upcoming = Follow::random(random.below(5), &mut random);
        follow_clock(&mut block, &follow, &upcoming, &mut random);
        follow = upcoming;
    }
}

#[test]
fn next_visits_show_the_wave_of_their_header() {
    let mut random = SplitMix64::new(57);
    let mut block = Stepper::new("next_visits", NextVisits::default(), 2);
    let at = |clock: usize, random: &mut SplitMix64| {
        let case = [1, 3, 4].get(clock).copied().unwrap_or(0);
        let mut follow = Follow::random(case, random);
        let owner = follow.token.owner;
        match clock {
            0 => {
                follow.token = Visit { owner, ..Visit::look(5) };
                follow.walk_next = 6;
                follow.bundle = Visit { owner, ..Visit::look(6) }.bundle(1, 0, 0, 0);
            }
            1 => {
                (follow.token.u, follow.n) = (6, [0, 1, 2]);
                let first = Visit { owner, rotates: true, locks: true, after: 1, f: 6, ..Visit::default() };
                follow.bundle = first.bundle(3, 2, 1, 2);
            }
            2 => {
                (follow.token.u, follow.token.x, follow.n[1], follow.y) = (7, 4, 8, 9);
                let first = Visit { after: 9, f_entry: 9, f: 7, u: 8, ..follow.token };
                follow.bundle = first.bundle(2, follow.token.after, follow.n[2], 0);
            }
            _ => {}
        }
        follow
    };
    let mut wave = Wave::default();
    let mut follow = Follow::random(0, &mut random);
    for clock in 0..5 {
        let upcoming = at(clock, &mut random);
        follow_clock(&mut block, &follow, &upcoming, &mut random);
        let shown = |is_shown: bool, value: u64| if is_shown { Cell::Number(value.into()) } else { Cell::Open };
        let first = Visit::of_bundle(follow.bundle);
        let (is_there, is_pair) = ((1..4).contains(&clock), follow.visits > 1);
        wave.take(&[
            ("early.u", shown(clock < 3, upcoming.token.u)),
            ("early.n1", shown(matches!(clock, 1 | 2), upcoming.n[1])),
            ("walks_on", Cell::Bit(follow.walks_on)),
            ("bundle.u", shown(is_there, first.u)),
            ("bundle.is_pair", Cell::Bit(is_pair)),
            ("bundle.f", shown(is_pair, first.f)),
            ("bundle.x", shown(is_pair, first.x)),
            ("bundle.after", shown(is_pair, first.after)),
        ]);
        follow = upcoming;
    }
    wave.assert_drawn_in("next_visits");
}

#[test]
fn attempt_lists_add_what_was_found_and_hand_over_what_was_counted() {
    let mut random = SplitMix64::new(53);
    let mut block = Stepper::new("attempt_lists", AttemptLists::default(), 1);
    for _ in 0..ROUNDS {
        let token = Visit::random(&mut random);
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
