//! Runs `NextVisits` in Rust and in Verilog beside a statement of each rule: all three must agree for every combination
//! of single bits and for random values of the wider inputs.

use crate::rig::stepper::bundles::{id, turned, LockFinding, Visit};
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::engine::NextVisits;
use incircle_testkit::SplitMix64;

named_ports!(NextVisits, [early_visit, early_turned, found, walk_next, entry], [bundle], clock);

const ROUNDS: usize = 6000;

/// A visit that completes, and the visits that follow: their bundle, and the number of its bits that count.
struct Follow {
    visit: Visit,
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
    /// Makes a random visit of a case: it repeats, walks on, locates, opens a cavity, or splits an edge.
    fn random(case: u64, random: &mut SplitMix64) -> Self {
        let n = [(); 3].map(|()| id(random));
        let (walk_next, y) = (id(random), random.below(64));
        let any = Visit::random(random);
        // Walks and root visits have no entry.
        let look = Visit { context: any.context, ..Visit::look(any.record) };
        let visit = match case {
            1 | 2 => look,
            3 => Visit { locks: true, ..look },
            4 => Visit { rotates: true, locks: true, ..any },
            _ => any,
        };
        let Visit { context, record, after, .. } = visit;
        let (visits, bundle) = match case {
            1 => (1, Visit { context, ..Visit::look(walk_next) }.bundle(1, 0, 0, 0)),
            2 => (1, Visit { locks: true, ..visit }.bundle(1, 0, 0, 0)),
            3 => {
                let first = Visit {
                    context,
                    rotates: true,
                    locks: true,
                    entry: 0,
                    after: 1,
                    cavity_entry: 0,
                    cavity_record: record,
                    record: n[0],
                };
                (3, first.bundle(3, 2, n[1], n[2]))
            }
            4 => {
                let first = Visit { after: y, cavity_entry: y, cavity_record: record, record: n[1], ..visit };
                (2, first.bundle(2, after, n[2], 0))
            }
            _ => (1, visit.bundle(1, 0, 0, 0)),
        };
        let (walks_on, locates, is_foreign) = (case == 1, case == 2, case == 0);
        Self { visit, n, is_foreign, walks_on, locates, walk_next, y, visits, bundle }
    }
}

/// Runs one clock: checks the visits that follow the completing one, and announces the one of the next clock.
fn follow_clock(block: &mut Stepper<NextVisits>, follow: &Follow, upcoming: &Follow, random: &mut SplitMix64) {
    let lock = LockFinding { foreign: upcoming.is_foreign, ..LockFinding::default() };
    block.set("early_visit", upcoming.visit.packed());
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
        let context = follow.visit.context;
        match clock {
            0 => {
                follow.visit = Visit { context, ..Visit::look(5) };
                follow.walk_next = 6;
                follow.bundle = Visit { context, ..Visit::look(6) }.bundle(1, 0, 0, 0);
            }
            1 => {
                (follow.visit.record, follow.n) = (6, [0, 1, 2]);
                let first =
                    Visit { context, rotates: true, locks: true, after: 1, cavity_record: 6, ..Visit::default() };
                follow.bundle = first.bundle(3, 2, 1, 2);
            }
            2 => {
                (follow.visit.record, follow.visit.entry, follow.n[1], follow.y) = (7, 4, 8, 9);
                let first = Visit { after: 9, cavity_entry: 9, cavity_record: 7, record: 8, ..follow.visit };
                follow.bundle = first.bundle(2, follow.visit.after, follow.n[2], 0);
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
            ("early.record", shown(clock < 3, upcoming.visit.record)),
            ("early.n1", shown(matches!(clock, 1 | 2), upcoming.n[1])),
            ("walks_on", Cell::Bit(follow.walks_on)),
            ("bundle.record", shown(is_there, first.record)),
            ("bundle.is_pair", Cell::Bit(is_pair)),
            ("bundle.cavity_record", shown(is_pair, first.cavity_record)),
            ("bundle.entry", shown(is_pair, first.entry)),
            ("bundle.after", shown(is_pair, first.after)),
        ]);
        follow = upcoming;
    }
    wave.assert_drawn_in("next_visits");
}
