//! Reading a mesh from the core: how long it takes, and that every range comes right under any back-pressure.

use crate::common::bench::{Bench, Stalls};
use crate::common::{sets, Random};
use incircle_protocol::{command_word, Counter, Layout, Opcode, ShortIds, Status, CORE_COORD_BITS, FULL, TINY};

/// A core with a mesh of this many points, most of them different, and the number of its records.
fn filled(points: u32) -> (Bench, u32) {
    let mut bench = Bench::new(FULL);
    let points = sets::started(sets::boxed(&mut Random(9), points - 3, 1 << 16));
    let answer = bench.insert(0, &points).expect("an end");
    assert!(answer.is(Status::Ok));
    (bench, answer.report().records)
}

/// Number of clocks from the acceptance of a read-out until its last word was taken, by a host that takes
/// every word at once.
fn clocks_of(bench: &mut Bench, opcode: Opcode, count: u32) -> u64 {
    let read_cycles = |bench: &mut Bench| bench.counters().expect("counters").counter(Counter::ReadCycles);
    let before = read_cycles(bench);
    let words = [command_word(opcode), 0, count];
    let answers = bench.run(&words, 1, Stalls::default(), 100_000, &mut Random(0)).expect("an end");
    assert!(answers[0].is(Status::Ok));
    read_cycles(bench) - before
}

/// Number of clocks of a read-out beyond those of its records: up to the first beat, and for the last word.
const LATENCY: u64 = 16;

#[test]
fn a_point_takes_two_clocks_without_links_and_three_with_them() {
    let points = 4096;
    let (mut bench, records) = filled(points);
    // A clock has one beat of two words, so two records of three words take three clocks. `Triangles` fills three beats
    // with four records, but only one record is read in a clock.
    for (opcode, expected) in [(Opcode::Triangles, u64::from(records)), (Opcode::Read, 3 * u64::from(records) / 2)] {
        let clocks = clocks_of(&mut bench, opcode, records);
        println!("{opcode:?}: {clocks} clocks for {points} points, {:.3} a point", clocks as f64 / f64::from(points));
        assert!((expected..=expected + LATENCY).contains(&clocks), "{opcode:?}: {clocks} clocks for {records} records");
    }
}

#[test]
fn every_range_has_the_records_of_the_memory() {
    let (mut bench, records) = filled(300);
    let layout = Layout::of(CORE_COORD_BITS, FULL.points);
    let whole = bench.records(records);
    let mut random = Random(4);
    for k in 0..300 {
        let first = random.below(records + 1);
        let count = match k % 3 {
            0 => random.below(9).min(records - first),
            1 => random.below(records - first + 1),
            _ => records - first,
        };
        let stalls = Stalls { full: random.pick(&[0, 0, 2, 3]), ..Stalls::default() };
        let range = &whole[first as usize..][..count as usize];
        let words = [command_word(Opcode::Read), first, count];
        let answer = bench.run(&words, 1, stalls, 100_000, &mut random).expect("an end").swap_remove(0);
        assert_eq!(answer.payload, range.as_flattened(), "{count} records from {first}");
        let words = [command_word(Opcode::Triangles), first, count];
        let answer = bench.run(&words, 1, stalls, 100_000, &mut random).expect("an end").swap_remove(0);
        assert_eq!(Some(answer.payload.len() as u32), layout.triangles_words(count));
        for (place, record) in range.iter().enumerate() {
            let (v, _) = layout.record_from_words(record);
            assert_eq!(layout.vertices_from_words(&answer.payload, place), v, "record {place} of {count} from {first}");
        }
        if count % 2 == 1 {
            assert_eq!(answer.payload.last().map(|word| word >> 16), Some(0), "the last half");
        }
        for ids in [ShortIds::Ten, ShortIds::Twelve] {
            let words = [command_word(Opcode::Triangles) | ids.word_bits(), first, count];
            let answer = bench.run(&words, 1, stalls, 100_000, &mut random).expect("an end").swap_remove(0);
            assert_eq!(answer.payload.len() as u64, ids.words(count));
            for (place, record) in range.iter().enumerate() {
                let (v, _) = layout.record_from_words(record);
                let short = v.map(|id| ids.infinite(id));
                let found = ids.vertices_from_words(&answer.payload, count as usize, place);
                assert_eq!(found, short, "{ids:?}, record {place} of {count} from {first}");
            }
            let spare = ids.spare_bits(count as usize);
            assert!(answer.payload.last().is_none_or(|word| word & spare == 0), "{ids:?}, {count} records");
        }
    }
}

#[test]
fn padding_has_no_answer_and_leaves_all_as_it_was() {
    let mut bench = Bench::new(TINY);
    let hello = command_word(Opcode::Hello);
    let words = [0, 0, hello, 0, hello, 0, 0, 0, command_word(Opcode::Insert), 3, 0, 5, 5 << 16, 0, 1];
    let answers =
        bench.run(&words, 4, Stalls { idle: 3, ..Stalls::default() }, 10_000, &mut Random(1)).expect("an end");
    let opcodes: Vec<u8> = answers.iter().map(|answer| answer.opcode).collect();
    assert_eq!(opcodes, [Opcode::Hello as u8, Opcode::Hello as u8, Opcode::Insert as u8, 0]);
    // A point of zeros is a valid point. A word with opcode 0 that is not all zeros is an unknown command.
    assert_eq!(answers[2].report().inserted, 3);
    assert!(answers[3].is(Status::UnknownOpcode));
}
