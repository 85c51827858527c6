//! Runs `VertexPacker` in Rust and in Verilog beside the layout that the protocol states: all three must agree, while
//! idle clocks, back-pressure and resets come in between.

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use crate::rig::vertex_beats::{beats_of, set_vertices, vertices, Beat};
use incircle_hdl::commands::VertexPacker;
use incircle_testkit::SplitMix64;

named_ports!(VertexPacker, [reset, starts, count, comes, v0, v1, v2], [valid, beat], clock);

fn start(block: &mut Stepper<VertexPacker>, count: usize, reset: bool) {
    block.set("comes", false);
    block.set("starts", true);
    block.set("count", count as u32);
    block.set("reset", reset);
    block.settle();
    block.edge();
    block.set("starts", false);
    block.set("reset", false);
}

#[test]
fn packer_leaves_no_gap() {
    let mut random = SplitMix64::new(41);
    let mut block = Stepper::new("vertex_packer", VertexPacker::default(), 1);
    for run in 0..400u64 {
        let records: Vec<[u32; 3]> = (0..1 + random.below(14)).map(|_| vertices(&mut random)).collect();
        start(&mut block, records.len(), run == 0);
        let mut expected = beats_of(&records);
        let mut rest = records.iter();
        // Every ninth run is cut short by a reset.
        let cut = if run % 9 == 8 { random.below(12) } else { 1000 };
        let mut clock = 0;
        let mut since_last = 0;
        while !expected.is_empty() && clock < cut {
            let next = if random.below([1, 3][(run % 2) as usize]) == 0 { rest.next() } else { None };
            block.set("comes", next.is_some());
            set_vertices(&mut block, next.copied().unwrap_or([0x1234; 3]));
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
            start(&mut block, 1, true);
            block.settle();
            assert!(!block.is("valid"), "a beat survived the reset");
        }
    }
}

#[test]
fn packer_shows_the_wave_of_its_header() {
    let mut block = Stepper::new("vertex_packer", VertexPacker::default(), 1);
    block.set("reset", true);
    block.settle();
    block.edge();
    block.set("reset", false);
    let mut wave = Wave::default();
    let mut next = 1;
    for clock in 0..10 {
        let comes = [1, 2, 3, 5, 6].contains(&clock);
        block.set("starts", clock == 0);
        block.set("count", 5u32);
        block.set("comes", comes);
        set_vertices(&mut block, [next, next + 1, next + 2]);
        block.settle();
        let beat = block.is("valid").then(|| Beat::of(block.get("beat")));
        wave.take(&[
            ("starts", Cell::Bit(clock == 0)),
            ("comes", Cell::Bit(comes)),
            ("v0", if comes { Cell::Number(next.into()) } else { Cell::Open }),
            ("valid", Cell::Bit(beat.is_some())),
            ("half", beat.map_or(Cell::Open, |beat| Cell::Number((beat.low & 0xffff).into()))),
            ("last", Cell::Bit(beat.is_some_and(|beat| beat.last))),
        ]);
        block.edge();
        next += if comes { 3 } else { 0 };
    }
    wave.assert_drawn_in("vertex_packer");
}
