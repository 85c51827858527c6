//! Runs `VisitReader` in Rust and in Verilog beside plain arithmetic: all three must agree in every clock.

use crate::rig::drawing::{draw, When};
use crate::rig::stepper::bundles::{pack, random_fields, unpack, VISIT};
use crate::rig::stepper::{named_ports, Stepper};
use crate::rig::visit_model::Record;
use incircle_hdl::engine::VisitReader;
use incircle_testkit::SplitMix64;

named_ports!(
    [] VisitReader,
    [infinite, visit, record, again, took, foreign, stored_corners],
    [turned, visit_at_record, corners],
    clock
);

const CYCLES: usize = 6_000;

const INFINITE: u64 = 0x7fff;

/// A record with three links that differ, and the infinite vertex on one corner or on none.
pub fn record(numbers: &mut SplitMix64) -> Record {
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
    let mut numbers = SplitMix64::new(33);
    let mut records: Vec<Record> = (0..CYCLES).map(|_| record(&mut numbers)).collect();
    records.push(Record::default());
    records.push(Record::default());
    let stimuli: Vec<Vec<u128>> = (0..CYCLES)
        .map(|cycle| {
            // The record of the visit is there two clocks later; the visit came through one
            // of its links, or through none.
            let mut visit = random_fields(VISIT, &mut numbers);
            let link = numbers.bits(2) as usize;
            if link < 3 {
                visit[6] = records[cycle + 2].n[link];
            }
            let Record { v, n } = records[cycle];
            let columns = [v, n].concat();
            let mut values = vec![INFINITE.into(), pack(VISIT, visit)];
            values.extend(columns.into_iter().map(u128::from));
            values.extend([(); 3].map(|()| u128::from(numbers.bits(1))));
            values.extend([(); 3].map(|()| u128::from(numbers.bits(32))));
            values
        })
        .collect();
    let mut past: Vec<Vec<u128>> = vec![];
    let mut turns = [0; 3];
    Stepper::new("visit_reader", VisitReader::default(), 1).run(
        &[
            "infinite",
            "visit",
            "record_v0",
            "record_v1",
            "record_v2",
            "record_n0",
            "record_n1",
            "record_n2",
            "took",
            "foreign",
            "again",
            "stored_corners_r0",
            "stored_corners_r1",
            "stored_corners_r2",
        ],
        &["visit_at_record", "turned", "corners_r0", "corners_r1", "corners_r2"],
        stimuli,
        |values| {
            past.push(values.to_vec());
            let ago = |clocks: usize| past.len().checked_sub(1 + clocks).map(|at| &past[at]);
            // The record that stood on the columns three clocks ago, the slot that its visit puts first,
            // and its lock a clock later.
            let visit = || {
                let (columns, lock, visit) = (ago(3)?, ago(2)?, unpack(VISIT, ago(5)?[1]));
                let column = |port: usize| columns[port] as u64;
                let record = Record { v: [2, 3, 4].map(column), n: [5, 6, 7].map(column) };
                let found = [lock[8], lock[9], columns[10]].map(|flag| flag == 1);
                Some((record, record.slot(visit[1] == 1, visit[6]), found))
            };
            let turned = visit().map(|(record, slot, found)| {
                turns[slot] += 1;
                record.turned(slot).pack_turned(slot, found, INFINITE)
            });
            let corners = [11, 12, 13].map(|port| ago(1).map(|then| then[port]));
            [&[ago(2).map(|then| then[1]), turned][..], &corners].concat()
        },
    );
    assert!(turns.iter().all(|turn| *turn > CYCLES / 10), "{turns:?}");
}

#[test]
fn visit_reader_shows_the_wave_of_its_header() {
    // The visit comes through link 1, so vertex 1 comes first.
    let stimuli = [
        (0, "visit", pack(VISIT, [0, 1, 0, 0, 0, 0, 30, 5])),
        (2, "record_v0", 11),
        (2, "record_v1", 12),
        (2, "record_n1", 30),
        (2, "again", 1),
        (3, "took", 1),
        (4, "stored_corners_r0", 51),
    ];
    let lanes = [
        ("visit.cavity_record", "visit", 25, 15, When::At(&[0])),
        ("n1", "record_n1", 0, 15, When::At(&[2])),
        ("v0", "record_v0", 0, 15, When::At(&[2])),
        ("v1", "record_v1", 0, 15, When::At(&[2])),
        ("again", "again", 0, 1, When::Always),
        ("took", "took", 0, 1, When::Always),
        ("turned.v0", "turned", 0, 15, When::At(&[5])),
        ("turned.slot", "turned", 90, 2, When::At(&[5])),
        ("turned.again", "turned", 94, 1, When::At(&[5])),
        ("turned.took", "turned", 92, 1, When::At(&[5])),
        ("position0", "stored_corners_r0", 0, 32, When::At(&[4])),
        ("r0", "corners_r0", 0, 32, When::At(&[5])),
    ];
    let reader = VisitReader::default();
    draw("visit_reader", reader, &stimuli, 7, &lanes).assert_drawn_in("visit_reader");
}
