//! Runs `RecordPacker` in Rust and in Verilog beside the layout that the protocol states: all three must agree, while
//! idle clocks, back-pressure and resets come in between.

use crate::rig::record_beats::{beats_of, leaves_no_rest, Beat, Columns, Form};
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::commands::RecordPacker;
use incircle_testkit::SplitMix64;

named_ports!(
    RecordPacker,
    [reset, starts, count, vertices_alone, has_short_ids, has_rests, comes, halves, rest],
    [valid, beat],
    clock
);

const HALVES: [&str; 6] = ["half0", "half1", "half2", "half3", "half4", "half5"];

fn start(block: &mut Stepper<RecordPacker>, count: usize, form: Form, reset: bool) {
    block.set("comes", false);
    block.set("starts", true);
    block.set("count", count as u32);
    form.set(block);
    block.set("reset", reset);
    block.settle();
    block.edge();
    block.set("starts", false);
    block.set("reset", false);
}

/// The halves that a record brings; those that do not count have those of a whole record.
fn halves(record: Columns, form: Form) -> [u32; 6] {
    let [a, b, c] = record.words().map(|word| [word & 0xffff, word >> 16]);
    let [v0, v1, v2] = record.v;
    match form {
        Form::Whole => [a[0], a[1], b[0], b[1], c[0], c[1]],
        Form::Vertices => [v0, v1, v2, b[1], c[0], c[1]],
        Form::Short(_) => {
            let low = v0 & 0x3ff | (v1 & 0x3ff) << 10 | (v2 & 0x3ff) << 20 | (v0 >> 10 & 3) << 30;
            [low & 0xffff, low >> 16, b[0], b[1], c[0], c[1]]
        }
    }
}

#[test]
fn packer_leaves_no_gap() {
    let mut random = SplitMix64::new(41);
    let mut block = Stepper::new("record_packer", RecordPacker::default(), 1);
    for run in 0..800u64 {
        let form = Form::random(&mut random);
        let records: Vec<Columns> = (0..1 + random.below(14)).map(|_| Columns::random(&mut random)).collect();
        start(&mut block, records.len(), form, run == 0);
        let mut expected = beats_of(&records, form);
        let mut rest = records.iter().enumerate();
        // Every ninth run is cut short by a reset.
        let cut = if run % 9 == 8 { random.below(12) } else { 1000 };
        let (mut clock, mut since_last, mut may_come) = (0, 0, true);
        while !expected.is_empty() && clock < cut {
            let comes = may_come && random.below([1, 3][(run % 2) as usize]) == 0;
            let next = if comes { rest.next() } else { None };
            may_come = next.is_none_or(|(place, _)| leaves_no_rest(place, form));
            block.set("comes", next.is_some());
            let brought = next.map_or([0x1234; 6], |(_, record)| halves(*record, form));
            for (port, half) in HALVES.into_iter().zip(brought) {
                block.set(port, half);
            }
            let bits = next.map_or(5, |(_, Columns { v: [_, b, c], .. })| b >> 10 & 3 | (c >> 10 & 3) << 2);
            block.set("rest", bits);
            block.settle();
            if block.is("valid") {
                let beat = Beat::of(block.get("beat"));
                assert_eq!(Some(beat), expected.pop_front(), "{records:?}");
            }
            block.edge();
            since_last += usize::from(rest.len() == 0);
            assert!(since_last <= 4, "the rest is late");
            clock += 1;
        }
        if cut < 1000 {
            start(&mut block, 1, form, true);
            block.settle();
            assert!(!block.is("valid"), "a beat survived the reset");
        }
    }
}

#[test]
fn packer_shows_the_wave_of_its_header() {
    let mut block = Stepper::new("record_packer", RecordPacker::default(), 1);
    block.set("reset", true);
    block.settle();
    block.edge();
    block.set("reset", false);
    let mut wave = Wave::default();
    let mut next = 1u32;
    for clock in 0..17 {
        let vertices_alone = clock < 10;
        let comes = [1, 2, 3, 5, 6, 11, 12, 14].contains(&clock);
        let starts = [0, 10].contains(&clock);
        if starts {
            next = 1;
        }
        let form = if vertices_alone { Form::Vertices } else { Form::Whole };
        form.set(&mut block);
        block.set("starts", starts);
        block.set("count", if vertices_alone { 5u32 } else { 3 });
        block.set("comes", comes);
        for (port, half) in HALVES.into_iter().zip(next..) {
            block.set(port, half);
        }
        block.settle();
        let beat = block.is("valid").then(|| Beat::of(block.get("beat")));
        wave.take(&[
            ("vertices_alone", Cell::Bit(vertices_alone)),
            ("starts", Cell::Bit(starts)),
            ("comes", Cell::Bit(comes)),
            ("half0", if comes { Cell::Number(next.into()) } else { Cell::Open }),
            ("valid", Cell::Bit(beat.is_some())),
            ("lowest", beat.map_or(Cell::Open, |beat| Cell::Number((beat.low & 0xffff).into()))),
            ("last", Cell::Bit(beat.is_some_and(|beat| beat.last))),
        ]);
        block.edge();
        next += if !comes {
            0
        } else if vertices_alone {
            3
        } else {
            6
        };
    }
    wave.assert_drawn_in("record_packer");
}
