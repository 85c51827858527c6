//! Runs `ChangeEnds` in Rust and in Verilog beside lists of items: each item must end once, and its part must name its
//! number, its outcome and a vertex.

use std::collections::VecDeque;

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::living::ChangeEnds;
use incircle_protocol::TINY;
use incircle_testkit::SplitMix64;

named_ports!(
    ChangeEnds,
    [
        reset,
        runs,
        events,
        context_id,
        number,
        corner,
        hole_runs,
        is_move,
        refuses,
        is_beyond,
        refused_number,
        refused_vertex,
        has_room
    ],
    [is_noted, ends, came, raises, raised, unmarks, unmarked, remarks, remarked],
    clock
);

const DUPLICATE: u64 = 5;
const MISSING: u64 = 6;
const IN_USE: u64 = 7;
const FULL: u64 = 8;
const MANY_NEIGHBORS: u64 = 10;
const FLAT: u64 = 11;

/// An event of the insertion engine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Event {
    Nothing,
    HandsOver,
    Duplicate,
    Solo {
        inserts: bool,
    },
    /// A move in place ends.
    Moves,
    /// The hole of a deletion is full, or no triangle would be left.
    Fill {
        is_flat: bool,
    },
}

#[test]
fn change_ends_gives_each_item_its_part() {
    let mut random = SplitMix64::new(84);
    let mut block = Stepper::new("living_change_ends", ChangeEnds::new(TINY), 1);
    // Number and vertex of the item that each context has handed over, and the parts of commits that are due.
    let mut handed = [None::<[u64; 2]>; 2];
    let mut due: VecDeque<[u64; 2]> = VecDeque::new();
    let mut last = [0; 3];
    let mut run = 0;
    let mut seen = [0; 7];
    for clock in 0..20_000 {
        let (reset, runs) = (clock < 4, !random.once_in(10) || !due.is_empty());
        let context = random.below(2);
        let [number, vertex, corner] = [random.bits(24), random.bits(15), random.bits(15)];
        // The run changes only while no part is due.
        if due.is_empty() && handed == [None; 2] {
            run = random.below(3);
        }
        let [hole_runs, is_move] = [run > 0, run == 2];
        // A visit of a move may be one of its deletion, or of its insertion.
        let finds = hole_runs && (!is_move || random.once_in(2));
        let event = match random.below(9) {
            _ if reset => Event::Nothing,
            0 | 1 if handed[context as usize].is_none() && !finds => Event::HandsOver,
            2 => Event::Duplicate,
            3 if !finds => Event::Solo { inserts: random.once_in(2) },
            3 => Event::Fill { is_flat: true },
            8 if is_move => Event::Moves,
            4 if hole_runs && !is_move && handed[context as usize].is_none() => Event::Fill { is_flat: false },
            _ => Event::Nothing,
        };
        let committed = (0..2).find(|&context| handed[context].is_some() && random.once_in(4) && due.len() < 2);
        let is_solo = matches!(event, Event::Solo { .. });
        // Nothing else is under way beside a solo insertion.
        let committed = committed.filter(|_| !is_solo && !reset);
        let refused = (random.once_in(3), random.once_in(2), random.bits(24), random.bits(32), random.once_in(2));
        block.set("reset", reset);
        block.set("runs", runs);
        block.set("events_hands_over", event == Event::HandsOver);
        block.set("events_duplicate", [Event::Duplicate, Event::Moves].contains(&event));
        block.set("events_finds", finds || event == Event::Moves);
        block.set("events_moves_in_place", event == Event::Moves);
        block.set("is_move", is_move);
        block.set("events_vertex", vertex);
        block.set("events_commit_ends", committed.is_some());
        block.set("events_committed_context", committed.unwrap_or(0) as u64);
        let done = committed.and_then(|context| handed[context]).unwrap_or([0, 0]);
        block.set("events_committed_vertex", done[1]);
        block.set("events_solo_ends", is_solo);
        block.set("events_solo_inserts", event == Event::Solo { inserts: true });
        block.set("events_solo_context", context);
        block.set("hole_runs", hole_runs);
        block.set("events_fill_ends", matches!(event, Event::Fill { .. }));
        block.set("events_fill_is_flat", event == Event::Fill { is_flat: true });
        block.set("events_fill_context", context);
        block.set("events_fill_vertex", vertex ^ 1);
        for (port, value) in [("context_id", context), ("number", number), ("corner", corner)] {
            block.set(port, value);
        }
        let (refuses, is_beyond, refused_number, refused_vertex, has_room) = refused;
        block.set("refuses", refuses);
        block.set("is_beyond", is_beyond);
        block.set("refused_number", refused_number);
        block.set("refused_vertex", refused_vertex);
        block.set("has_room", has_room);
        block.settle();

        if committed.is_some() && runs {
            due.push_back(done);
        }
        let ends = event != Event::Nothing;
        let hands_over = matches!(event, Event::HandsOver | Event::Fill { is_flat: false });
        let is_early = ends && !hands_over;
        let part = match event {
            Event::Duplicate if finds => Some((number, MANY_NEIGHBORS, vertex)),
            Event::Duplicate => Some((number, DUPLICATE, corner)),
            Event::Moves => Some((number, 0, vertex)),
            Event::Fill { is_flat: true } => Some((number, FLAT, vertex ^ 1)),
            Event::Solo { inserts: true } => Some((last[0], 0, last[1])),
            Event::Solo { inserts: false } => Some((last[0], DUPLICATE, last[2])),
            Event::Nothing | Event::HandsOver | Event::Fill { is_flat: false } => {
                due.front().map(|&[number, vertex]| (number, 0, vertex))
            }
        };
        let is_noted = part.is_none() && refuses && has_room;
        let refusal = match (hole_runs, is_beyond) {
            (true, _) => (refused_number, MISSING, refused_vertex),
            (false, true) => (refused_number, FULL, refused_vertex),
            (false, false) => (refused_number, IN_USE, refused_vertex),
        };
        let part = part.or_else(|| is_noted.then_some(refusal));
        if !reset {
            block.expect("is_noted", is_noted);
            block.expect("ends_valid", ends);
            block.expect("came_valid", runs && part.is_some());
            if let Some((number, outcome, vertex)) = part {
                block.expect("came_part_number", number);
                block.expect("came_part_finding_outcome", outcome);
                let is_word = [MISSING, FULL].contains(&outcome);
                let port = if is_word { "came_part_finding_w0" } else { "came_part_finding_v0" };
                let bits = if is_word { u64::MAX } else { 0x7fff };
                block.expect(port, vertex & bits);
                seen[[0, 5, 6, 7, 8, 10, 11].iter().position(|&known| known == outcome).unwrap_or(0)] += 1;
            }
            if ends {
                block.expect("ends_context", context);
            }
            let unmarked = match event {
                Event::Duplicate if !hole_runs => Some(vertex),
                Event::Solo { inserts: false } if !is_move => Some(last[1]),
                _ => None,
            };
            let remarked = match event {
                Event::Duplicate if finds => Some(vertex),
                Event::Moves => Some(vertex),
                Event::Fill { is_flat: true } => Some(vertex ^ 1),
                Event::Solo { inserts: true } if is_move => Some(last[1]),
                Event::Nothing | Event::HandsOver if is_move => due.front().map(|&[_, vertex]| vertex),
                _ => None,
            };
            let raised = match event {
                Event::Solo { inserts: true } => Some(last[1]),
                _ => committed.map(|_| done[1]),
            };
            for (port, id, wanted) in
                [("unmarks", "unmarked", unmarked), ("remarks", "remarked", remarked), ("raises", "raised", raised)]
            {
                block.expect(port, wanted.is_some());
                if let Some(wanted) = wanted {
                    block.expect(id, wanted);
                }
            }
        }
        block.edge();
        if !is_early {
            due.pop_front();
        }
        if let Some(context) = committed {
            handed[context] = None;
        }
        if hands_over {
            handed[context as usize] = Some([number, vertex]);
        }
        last = [number, vertex, corner];
    }
    assert!(seen.iter().all(|&count| count > 200), "parts by their outcome: {seen:?}");
}
