//! Runs `VisitCase` in Rust and in Verilog beside a statement of each rule: all three must agree for every combination
//! of single bits and for random values of the wider inputs.

use crate::rig::stepper::bundles::{flip, id, turned, Finding, LockFinding, Visit};
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::engine::VisitCase;
use incircle_testkit::SplitMix64;

named_ports!(VisitCase, [early, seeded, is_busy, holds_priority, verdict, drains, is_full], [found], clock);

/// Outputs of `VisitCase`, of which at most one is high.
const CASES: [&str; 13] = [
    "looks",
    "revisits",
    "walks_on",
    "locates",
    "opens",
    "root_changed",
    "splits",
    "settles",
    "overflows",
    "aborts_root",
    "aborts",
    "walk_duplicate",
    "root_duplicate",
];

/// The single bits from which a case follows.
struct Bits {
    done: bool,
    rotates: bool,
    locks: bool,
    seeded: bool,
    lock: LockFinding,
    finding: Finding,
    is_busy: bool,
    holds_priority: bool,
    drains: bool,
    is_full: bool,
}

impl Bits {
    /// Takes the bits from a number.
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
            holds_priority: bit(10),
            drains: bit(11),
            is_full: bit(12),
        }
    }

    /// The case of the visit, by the rules.
    fn case(&self) -> Option<&'static str> {
        let Finding { conflict, falls_onto_corner, .. } = self.finding;
        if !self.done {
            return None;
        }
        if self.rotates {
            return match (self.drains, self.lock.foreign, conflict) {
                (true, ..) => None,
                (_, true, _) if self.holds_priority => Some("revisits"),
                (_, true, _) => Some("aborts"),
                (.., false) => Some("settles"),
                (.., true) if self.is_full => Some("overflows"),
                (.., true) => Some("splits"),
            };
        }
        if self.locks {
            return Some(match (self.lock.foreign, conflict) {
                (true, _) if self.holds_priority => "revisits",
                (true, _) => "aborts_root",
                _ if falls_onto_corner => "root_duplicate",
                (_, false) => "root_changed",
                (_, true) => "opens",
            });
        }
        Some(match (self.lock.again, conflict) {
            _ if !self.seeded => "looks",
            (true, _) => "revisits",
            _ if falls_onto_corner => "walk_duplicate",
            (_, false) => "walks_on",
            (_, true) if self.is_busy => "revisits",
            (_, true) => "locates",
        })
    }
}

/// Drives the inputs that the block reads a clock ahead.
fn set_early(block: &mut Stepper<VisitCase>, bits: &Bits, random: &mut SplitMix64) {
    let visit = Visit { rotates: bits.rotates, locks: bits.locks, ..Visit::random(random) };
    let lock = LockFinding { took: flip(random), ..bits.lock };
    block.set("early_done", bits.done);
    block.set("early_visit", visit.packed());
    block.set("early_turned", turned([id(random); 3], [id(random); 3], 1, lock, [flip(random); 3]));
    for (port, value) in [("seeded", bits.seeded), ("is_busy", bits.is_busy), ("holds_priority", bits.holds_priority)] {
        block.set(port, value);
    }
}

/// Runs one clock: the verdict for the bits of the clock before, and the early inputs of the next.
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
        block.expect("waits", case == Some("revisits") && (bits.locks || bits.rotates));
        for port in CASES {
            block.expect(port, case == Some(port));
        }
        let asks = ["revisits", "walks_on", "locates", "opens", "splits"].map(Some).contains(&case);
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
        1 => Bits { done: true, finding: Finding { conflict: true, ..Finding::default() }, ..nothing() },
        3 => Bits { done: true, locks: true, finding: Finding { conflict: true, ..Finding::default() }, ..nothing() },
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
            ("conflict", Cell::Bit(bits.finding.conflict)),
            ("is_walk", Cell::Bit(bits.done && !bits.locks)),
            ("locates", Cell::Bit(case == Some("locates"))),
            ("opens", Cell::Bit(case == Some("opens"))),
            ("aborts", Cell::Bit(case == Some("aborts"))),
            ("asks", Cell::Bit(matches!(case, Some("locates" | "opens")))),
            ("may_ask", Cell::Bit(bits.done)),
        ]);
    }
    wave.assert_drawn_in("visit_case");
}
