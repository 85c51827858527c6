//! The payload of read-outs: records and their vertices packed into beats. Rust, Verilog and the layout that the protocol states agree,
//! crossed with idle, back-pressure and resets.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, Cell, NamedPorts, Stepper, Wave};
use incircle_cli::generate::SplitMix64;
use incircle_hdl::link::{RecordReads, VertexPacker, VertexStream};
use incircle_protocol::{Layout, CORE_COORD_BITS, MAX_POINTS};

named_ports!(VertexPacker, [reset, starts, count, comes, v0, v1, v2], [valid, beat], clock);
named_ports!(VertexStream, [reset, starts, count, comes, v0, v1, v2, takes], [has_room, valid, beat], clock);
named_ports!(
    RecordReads,
    [reset, starts, first, count, is_packed, runs, read_done, record, takes], [read, read_id, valid, beat],
    clock
);

/// The layout of the largest core.
const LAYOUT: Layout = Layout::of(CORE_COORD_BITS, MAX_POINTS);

/// A beat as its fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Beat {
    low: u32,
    high: u32,
    both: bool,
    last: bool,
}

impl Beat {
    fn of(number: u128) -> Self {
        Self {
            low: number as u32,
            high: (number >> 32) as u32,
            both: number >> 64 & 1 == 1,
            last: number >> 65 & 1 == 1,
        }
    }
}

/// The beats of these vertices, after the layout.
fn beats_of(records: &[[u32; 3]]) -> VecDeque<Beat> {
    let length = LAYOUT.triangles_words(records.len() as u32).expect("few records");
    let mut words = vec![0; length as usize];
    for (place, &vertices) in records.iter().enumerate() {
        LAYOUT.vertices_to_words(vertices, &mut words, place);
    }
    let count = words.len().div_ceil(2);
    let beat = |(place, words): (usize, &[u32])| Beat {
        low: words[0],
        high: words.get(1).copied().unwrap_or(0),
        both: words.len() == 2,
        last: place + 1 == count,
    };
    words.chunks(2).enumerate().map(beat).collect()
}

fn vertices(random: &mut SplitMix64) -> [u32; 3] {
    [(); 3].map(|()| [0, 0x7fff, random.below(1 << 15) as u32][random.below(3) as usize])
}

fn set_vertices<U: NamedPorts>(block: &mut Stepper<U>, vertices: [u32; 3]) {
    for (port, vertex) in ["v0", "v1", "v2"].into_iter().zip(vertices) {
        block.set(port, vertex);
    }
}

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
        // Now and then it is cut short by a reset.
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
            assert!(!block.is("valid"), "a beat after a reset");
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

#[test]
fn stream_keeps_every_beat_whatever_is_taken() {
    for (seed, ready) in [(42, 100), (43, 50), (44, 3)] {
        let mut random = SplitMix64::new(seed);
        let mut block = Stepper::new("vertex_stream", VertexStream::default(), 1);
        for run in 0..60 {
            let records: Vec<[u32; 3]> = (0..1 + random.below(80)).map(|_| vertices(&mut random)).collect();
            let latency = 1 + random.below(VertexStream::PATIENCE as u64) as usize;
            for reset in [run == 0, false] {
                block.set("reset", reset);
                block.set("starts", !reset);
                block.set("count", records.len() as u32);
                block.set("comes", false);
                block.set("takes", false);
                block.settle();
                block.edge();
            }
            block.set("starts", false);
            let mut expected = beats_of(&records);
            let mut under_way: VecDeque<Option<[u32; 3]>> = vec![None; latency].into();
            let mut rest = records.iter().copied();
            let mut clock = 0;
            while !expected.is_empty() {
                // `has_room` follows registers only.
                block.set("takes", false);
                let next = under_way.pop_front().flatten();
                block.set("comes", next.is_some());
                set_vertices(&mut block, next.unwrap_or([0x7ead; 3]));
                block.settle();
                under_way.push_back(if block.is("has_room") { rest.next() } else { None });
                let takes = block.is("valid") && random.below(100) < ready;
                if block.is("valid") {
                    assert_eq!(Beat::of(block.get("beat")), expected[0]);
                }
                block.set("takes", takes);
                block.settle();
                block.edge();
                if takes {
                    expected.pop_front();
                }
                clock += 1;
                assert!(clock < 40_000, "no end");
            }
            block.settle();
            assert!(!block.is("valid"), "nothing is left");
        }
    }
}

/// A record whose columns tell its id.
fn columns(id: u32) -> ([u32; 3], [u32; 3], bool) {
    let column = |k: u32| (id ^ (0x1357 * k)) & 0x7fff;
    ([column(1), column(2), column(3)], [column(4), column(5), column(6)], id.is_multiple_of(3))
}

#[test]
fn reads_give_the_words_of_records_or_their_vertices() {
    for (seed, ready) in [(45, 100), (46, 40), (47, 5)] {
        let mut random = SplitMix64::new(seed);
        let mut block = Stepper::new("record_reads", RecordReads::default(), 1);
        for run in 0..80 {
            let is_packed = random.below(2) == 0;
            let count = 1 + random.below(if is_packed { 60 } else { 8 }) as u32;
            let first = random.below(u64::from((1u32 << 15) - count)) as u32;
            let ids = first..first + count;
            let mut expected = if is_packed {
                beats_of(&ids.map(|id| columns(id).0).collect::<Vec<_>>())
            } else {
                let words = |id| {
                    let (v, n, lock) = columns(id);
                    LAYOUT.record_to_words(v, n, lock)[..3].to_vec()
                };
                let words: Vec<u32> = ids.flat_map(words).collect();
                let beat = |(place, &low)| Beat { low, high: 0, both: false, last: place + 1 == words.len() };
                words.iter().enumerate().map(beat).collect()
            };
            for reset in [run == 0 || random.below(9) == 0, false] {
                block.set("reset", reset);
                block.set("starts", !reset);
                block.set("is_packed", is_packed);
                block.set("first", first);
                block.set("count", count);
                block.set("runs", false);
                block.set("read_done", false);
                block.set("takes", false);
                block.settle();
                block.edge();
            }
            block.set("starts", false);
            block.set("runs", true);
            let mut reads: VecDeque<Option<u32>> = vec![None; 3].into();
            let (mut asked, mut clock) = (first, 0);
            let cut = if run % 10 == 9 { random.below(30) } else { 40_000 };
            while !expected.is_empty() && clock < cut {
                block.set("takes", false);
                let done = reads.pop_front().flatten();
                block.set("read_done", done.is_some());
                let (v, n, lock) = columns(done.unwrap_or_else(|| random.below(1 << 15) as u32));
                for (port, value) in ["v0", "v1", "v2", "n0", "n1", "n2"].into_iter().zip([v, n].concat()) {
                    block.set(port, value);
                }
                block.set("was_set", lock);
                block.settle();
                let reads_now = block.is("read");
                if reads_now {
                    block.expect("read_id", asked);
                    asked += 1;
                }
                reads.push_back(reads_now.then(|| asked - 1));
                let valid = block.is("valid");
                if valid {
                    assert_eq!(Beat::of(block.get("beat")), expected[0], "run {run}");
                }
                let takes = valid && random.below(100) < ready;
                block.set("takes", takes);
                block.settle();
                block.edge();
                if takes {
                    expected.pop_front();
                }
                clock += 1;
                assert!(clock < 40_000, "no end");
            }
            if cut < 40_000 {
                // What was under way is dropped, here and on the way from the memory.
                block.set("runs", false);
                block.set("read_done", false);
                block.set("takes", false);
                block.set("reset", true);
                block.settle();
                block.edge();
                block.set("reset", false);
            } else {
                assert_eq!(asked, first + count, "every record is read once");
            }
        }
    }
}
