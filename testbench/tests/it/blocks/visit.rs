//! The parts of a visit: queue, reader and verdict agree in Rust, in Verilog and in plain arithmetic, clock by clock.

use std::cell::RefCell;
use std::collections::VecDeque;

use crate::rig::cosimulation::{named_ports, Cosimulation, Expected, Numbers};
use crate::rig::structures::{pack, random, unpack, BUNDLE, TOKEN};
use crate::rig::visit_model::{incircle, orientation, verdict_parts, word, Point, Record, VERDICT_PARTS};
use incircle_hdl::engine::{Issue, VerdictLogic, VisitJudge, VisitReader};

named_ports!([] Issue, [reset, push, bundle, read, read_id], [token_valid, token, vertices_id, links_id, read_valid], clock);
named_ports!([] VisitReader,
    [infinite, token, v0, v1, v2, n0, n1, n2, took, foreign, again, position0, position1, position2],
    [turned, token_at_record, r0, r1, r2], clock);
named_ports!([] VisitJudge, [r0, r1, r2, p, turned], [verdict], clock);
named_ports!([] VerdictLogic,
    [turned, e0_negative, e1_negative, e2_negative, e0_zero, e1_zero, e2_zero, e1_below_e0, e2_below_e0, e2_below_e1,
     incircle_positive, incircle_zero, p_before_r0, p_before_r1, p_before_r2, p_equals_r0, p_equals_r1, p_equals_r2,
     r0_before_r1, r0_before_r2, r1_before_r2], [verdict]);

const CYCLES: usize = 6_000;
const INFINITE: u64 = 0x7fff;

/// Visits waiting, each with a mark on the last of its bundle, and the issue register.
#[derive(Default)]
struct Queue {
    waiting: VecDeque<(u128, bool)>,
    issued: Expected,
    read_id: Option<u64>,
    fullest: usize,
}

impl Queue {
    fn bundles(&self) -> usize {
        self.waiting.iter().filter(|(_, is_last)| *is_last).count()
    }

    fn push(&mut self, bundle: u128) {
        let [is_pair, is_triple, owner, rotates, locks, x, after, f_entry, f, u, after2, u2, u3] =
            unpack(BUNDLE, bundle);
        let visits = [(x, after, u), (after, after2, u2), (after2, 0, u3)];
        let last = (is_pair + is_triple) as usize;
        for (place, (x, after, u)) in visits.into_iter().enumerate().take(last + 1) {
            let token = pack(TOKEN, [owner, rotates, locks, x, after, f_entry, f, u]);
            self.waiting.push_back((token, place == last));
        }
        self.fullest = self.fullest.max(self.bundles());
    }
}

#[test]
fn issue_makes_one_visit_a_clock_in_order() {
    const PLACES: usize = 32;
    let queue = RefCell::new((Queue::default(), Numbers::new(31)));
    let stimuli = (0..CYCLES).map(|cycle| {
        let (queue, numbers) = &mut *queue.borrow_mut();
        // In turn: floods, drops, droughts.
        let rate = [1, 2, 9, 40][cycle / 128 % 4];
        let has_place = queue.bundles() < PLACES;
        let push = has_place && numbers.once_in(rate);
        let read = queue.waiting.is_empty() && !push && numbers.bits(1) == 1;
        let mut bundle = random(BUNDLE, |bits| numbers.bits(bits));
        bundle[1] &= bundle[0];
        vec![
            u128::from(cycle == 0 || numbers.once_in(200)),
            push.into(),
            pack(BUNDLE, bundle),
            read.into(),
            numbers.bits(15).into(),
        ]
    });
    let mut is_known = false;
    Cosimulation {
        name: "issue_5",
        rust: Issue::new(5),
        inputs: &["reset", "push", "bundle", "read", "read_id"],
        outputs: &["token_valid", "token", "read_valid", "token[40+:15]", "vertices_id", "links_id"],
    }
    .run(stimuli, |values| {
        let queue = &mut queue.borrow_mut().0;
        let token_valid = Some(queue.issued.is_some().into());
        let read_valid = Some(queue.read_id.is_some().into());
        let read_id = queue.read_id.map(u128::from);
        let record = queue.issued.map(|token| unpack(TOKEN, token)[7].into()).or(read_id);
        let outputs = vec![token_valid, queue.issued, read_valid, read_id, record, record];
        if values[1] == 1 {
            queue.push(values[2]);
        }
        queue.issued = queue.waiting.pop_front().map(|(token, _)| token);
        queue.read_id = (values[3] == 1).then_some(values[4] as u64);
        if values[0] == 1 {
            let fullest = queue.fullest;
            *queue = Queue { fullest, ..Queue::default() };
        }
        let shown = if is_known { outputs } else { vec![None; 6] };
        is_known |= values[0] == 1;
        shown
    });
    assert_eq!(queue.into_inner().0.fullest, PLACES, "the test fills every place");
}

/// A record with three links that differ, and the infinite vertex on one corner or none.
fn record(numbers: &mut Numbers) -> Record {
    let mut v = [(); 3].map(|()| numbers.bits(15) % INFINITE);
    let place = numbers.bits(3) as usize;
    if place < 3 {
        v[place] = INFINITE;
    }
    let n0 = numbers.bits(15);
    Record { v, n: [n0, n0 ^ (1 + numbers.bits(3)), n0 ^ (9 + numbers.bits(2))] }
}

#[test]
fn visit_reader_turns_record_and_corners() {
    let mut numbers = Numbers::new(33);
    let mut records: Vec<Record> = (0..CYCLES).map(|_| record(&mut numbers)).collect();
    records.push(Record::default());
    records.push(Record::default());
    let stimuli: Vec<Vec<u128>> = (0..CYCLES)
        .map(|cycle| {
            // The visit's record is there two clocks later; it came through one of its links, or through none.
            let mut token = random(TOKEN, |bits| numbers.bits(bits));
            let link = numbers.bits(2) as usize;
            if link < 3 {
                token[6] = records[cycle + 2].n[link];
            }
            let Record { v, n } = records[cycle];
            let columns = [v, n].concat();
            let mut values = vec![INFINITE.into(), pack(TOKEN, token)];
            values.extend(columns.into_iter().map(u128::from));
            values.extend([(); 3].map(|()| u128::from(numbers.bits(1))));
            values.extend([(); 3].map(|()| u128::from(numbers.bits(32))));
            values
        })
        .collect();
    let mut past: Vec<Vec<u128>> = vec![];
    let mut turns = [0; 3];
    Cosimulation {
        name: "visit_reader",
        rust: VisitReader::default(),
        inputs: &[
            "infinite",
            "token",
            "v0",
            "v1",
            "v2",
            "n0",
            "n1",
            "n2",
            "took",
            "foreign",
            "again",
            "position0",
            "position1",
            "position2",
        ],
        outputs: &["token_at_record", "turned", "r0", "r1", "r2"],
    }
    .run(stimuli, |values| {
        past.push(values.to_vec());
        let ago = |clocks: usize| past.len().checked_sub(1 + clocks).map(|at| &past[at]);
        // The record that stood on the columns three clocks ago, the slot that its visit puts first, and its lock a clock later.
        let visit = || {
            let (columns, lock, token) = (ago(3)?, ago(2)?, unpack(TOKEN, ago(5)?[1]));
            let column = |port: usize| columns[port] as u64;
            let record = Record { v: [2, 3, 4].map(column), n: [5, 6, 7].map(column) };
            let found = [lock[8], lock[9], columns[10]].map(|flag| flag == 1);
            Some((record, record.slot(token[1] == 1, token[6]), found))
        };
        let turned = visit().map(|(record, slot, found)| {
            turns[slot] += 1;
            record.turned(slot).pack_turned(slot, found, INFINITE)
        });
        let corners = [11, 12, 13].map(|port| ago(1).map(|then| then[port]));
        [&[ago(2).map(|then| then[1]), turned][..], &corners].concat()
    });
    assert!(turns.iter().all(|turn| *turn > CYCLES / 10), "{turns:?}");
}

/// Four points: few places, so that lines, circles and equal points are common; or the whole range.
fn points(numbers: &mut Numbers) -> [Point; 4] {
    let bits = [1, 2, 2, 3, 4, 16][(numbers.next() % 6) as usize];
    let shift = if bits < 16 { [0, 12][numbers.bits(1) as usize] } else { 0 };
    let mut coordinate = || (numbers.bits(bits) << shift) as i64;
    [(); 4].map(|()| (coordinate(), coordinate()))
}

#[test]
fn verdict_logic_agrees_with_the_geometry() {
    let mut numbers = Numbers::new(34);
    let mut cases = vec![];
    let stimuli: Vec<Vec<u128>> = (0..4 * CYCLES)
        .map(|_| {
            let [r0, r1, r2, p] = points(&mut numbers);
            let r = [r0, r1, r2];
            let record = record(&mut numbers);
            let slot = (numbers.next() % 3) as usize;
            cases.push((record, slot, r, p));
            let e = [0, 1, 2].map(|k| orientation(r[(k + 1) % 3], r[(k + 2) % 3], p));
            let inside = incircle(r, p);
            let flags = [
                e[0] < 0,
                e[1] < 0,
                e[2] < 0,
                e[0] == 0,
                e[1] == 0,
                e[2] == 0,
                e[1] < e[0],
                e[2] < e[0],
                e[2] < e[1],
                inside > 0,
                inside == 0,
                p < r0,
                p < r1,
                p < r2,
                p == r0,
                p == r1,
                p == r2,
                r0 < r1,
                r0 < r2,
                r1 < r2,
            ];
            let turned = record.turned(slot).pack_turned(slot, [false; 3], INFINITE);
            [&[turned][..], &flags.map(u128::from)].concat()
        })
        .collect();
    let mut cases = cases.into_iter();
    let mut seen = [0; 5];
    Cosimulation {
        name: "verdict_logic",
        rust: VerdictLogic::default(),
        inputs: &[
            "turned",
            "e0_negative",
            "e1_negative",
            "e2_negative",
            "e0_zero",
            "e1_zero",
            "e2_zero",
            "e1_below_e0",
            "e2_below_e0",
            "e2_below_e1",
            "incircle_positive",
            "incircle_zero",
            "p_before_r0",
            "p_before_r1",
            "p_before_r2",
            "p_equals_r0",
            "p_equals_r1",
            "p_equals_r2",
            "r0_before_r1",
            "r0_before_r2",
            "r1_before_r2",
        ],
        outputs: &VERDICT_PARTS,
    }
    .run(stimuli, |_| {
        let (record, slot, r, p) = cases.next().expect("a case for each stimulus");
        let verdict = record.verdict(slot, r, p, INFINITE);
        seen[0] += usize::from(verdict & 1 == 1);
        seen[1] += usize::from(verdict >> 1 & 1 == 1);
        seen[2] += usize::from(incircle(r, p) == 0 && !r.contains(&p));
        seen[3] += usize::from(record.v.contains(&INFINITE));
        seen[4] += usize::from(slot > 0 && incircle(r, p) == 0 && verdict & 1 == 1);
        verdict_parts(verdict, slot, r).to_vec()
    });
    assert!(
        seen.iter().all(|count| *count > CYCLES / 10),
        "conflicts, located, cocircular, ghosts, turned ties: {seen:?}"
    );
}

#[test]
fn visit_judge_answers_ten_clocks_after_the_corners() {
    const LATENCY: usize = 10;
    let mut numbers = Numbers::new(35);
    let cases: Vec<_> =
        (0..CYCLES).map(|_| (points(&mut numbers), record(&mut numbers), (numbers.next() % 3) as usize)).collect();
    let stimuli = cases.iter().enumerate().map(|(cycle, (points, ..))| {
        // The record of the visit whose corners came before.
        let before = cycle.checked_sub(LATENCY).map(|before| &cases[before]);
        let (record, slot) = before.map_or((Record::default(), 0), |(_, record, slot)| (*record, *slot));
        let turned = record.turned(slot).pack_turned(slot, [false; 3], INFINITE);
        [&points.map(|point| u128::from(word(point)))[..], &[turned]].concat()
    });
    let mut seen = [0; 3];
    let mut cycle = 0usize;
    Cosimulation {
        name: "visit_judge",
        rust: VisitJudge::default(),
        inputs: &["r0", "r1", "r2", "p", "turned"],
        outputs: &VERDICT_PARTS,
    }
    .run(stimuli, |_| {
        let parts = cycle.checked_sub(LATENCY).map(|before| {
            let ([r0, r1, r2, p], record, slot) = cases[before];
            let verdict = record.verdict(slot, [r0, r1, r2], p, INFINITE);
            for (bit, count) in seen.iter_mut().enumerate() {
                *count += usize::from(verdict >> bit & 1 == 1);
            }
            verdict_parts(verdict, slot, [r0, r1, r2]).to_vec()
        });
        cycle += 1;
        parts.unwrap_or(vec![None; VERDICT_PARTS.len()])
    });
    assert!(seen.iter().all(|count| *count > CYCLES / 50), "conflicts, located, on a corner: {seen:?}");
}
