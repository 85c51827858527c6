//! Runs `NearSearch` in Rust and in Verilog beside a statement of the rules: all three must agree.

use crate::rig::nearest::Nearest;
use crate::rig::stepper::bundles::{flip, id, unpack, Visit, BUNDLE};
use crate::rig::stepper::{named_ports, Stepper};
use crate::rig::visit_model::Record;
use incircle_hdl::living::NearSearch;
use incircle_protocol::{Config, TINY};
use incircle_testkit::SplitMix64;

named_ports!(NearSearch, [completion, nearest, begins, follows], [asks, bundle, ends, vertex], clock);

const ROUNDS: usize = 30_000;
const CONTEXTS: u64 = 24;
const MOST_CONTEXTS: Config = Config { contexts: CONTEXTS as u32, ..TINY };
/// `entry` of a visit of a chain to the right, to the left, and of a record once more.
const ENTRIES: [u64; 3] = [2, 6, 8];

/// The search of a context: parity of the centre, and whether each chain has a visit in flight.
#[derive(Clone, Copy, Debug, Default)]
struct Search {
    parity: bool,
    goes: [bool; 2],
}

/// What follows a visit: visits of these entries, or the end of the item.
#[derive(Debug, PartialEq, Eq)]
enum Follows {
    Nothing,
    Visits(Vec<u64>),
    End,
}

impl Search {
    fn restart(&mut self, nearest: &Nearest, other_is_in_flight: bool) -> Follows {
        self.goes = nearest.begins;
        match (nearest.begins, other_is_in_flight) {
            ([true, true], _) => Follows::Visits(vec![ENTRIES[1], ENTRIES[0]]),
            ([false, true], _) => Follows::Visits(vec![ENTRIES[1]]),
            ([true, false], _) => Follows::Visits(vec![ENTRIES[0]]),
            ([false, false], true) => Follows::Visits(vec![ENTRIES[2]]),
            ([false, false], false) => Follows::End,
        }
    }

    fn begin(&mut self, nearest: &Nearest) -> Follows {
        self.parity = false;
        self.restart(nearest, false)
    }

    fn follow(&mut self, nearest: &Nearest, left: usize, parity: bool) -> Follows {
        if parity != self.parity {
            return Follows::Nothing;
        }
        if nearest.slot == 0 {
            self.parity = !self.parity;
            return self.restart(nearest, self.goes[1 - left]);
        }
        if nearest.goes[left] {
            return Follows::Visits(vec![ENTRIES[left]]);
        }
        self.goes[left] = false;
        if self.goes[1 - left] {
            Follows::Nothing
        } else {
            Follows::End
        }
    }
}

#[test]
fn near_search_goes_round_each_centre() {
    let mut random = SplitMix64::new(84);
    let mut block = Stepper::new("living_near_search", NearSearch::new(MOST_CONTEXTS), 1);
    let mut searches = [None::<Search>; CONTEXTS as usize];
    let mut seen = [0; 7];
    for _ in 0..ROUNDS {
        let context = random.below(CONTEXTS);
        let record = Record { v: [(); 3].map(|()| id(&mut random)), n: [(); 3].map(|()| id(&mut random)) };
        let mut flags = || [flip(&mut random), flip(&mut random)];
        let (begins, goes) = (flags(), flags());
        let nearest = Nearest { slot: random.below(3) as usize, begins, goes };
        let (left, is_begin) = (random.below(2) as usize, random.once_in(6));
        let state = &mut searches[context as usize];
        // A chain goes on only in a search that has begun, and with a visit that is in flight.
        let (known, parity) = (state.unwrap_or_default(), flip(&mut random));
        let is_chain = !is_begin && state.is_some() && (parity != known.parity || known.goes[left]);
        let visit = Visit {
            context,
            rotates: is_chain,
            entry: ENTRIES[left],
            cavity_entry: parity.into(),
            ..Visit::look(id(&mut random))
        };
        block.set("completion_visit", visit.packed());
        block.set("completion_turned", record.pack_turned(0, [false; 3], 0x7fff));
        block.set("nearest", nearest.packed(0));
        block.set("begins", is_begin);
        block.set("follows", is_chain);
        block.settle();
        let follows = match (is_begin, is_chain) {
            (true, _) => state.insert(Search::default()).begin(&nearest),
            (_, true) => state.get_or_insert_default().follow(&nearest, left, parity),
            _ => Follows::Nothing,
        };
        block.expect("asks", matches!(follows, Follows::Visits(_)));
        block.expect("ends", follows == Follows::End);
        seen[match &follows {
            Follows::Nothing => 0,
            Follows::End => 1,
            Follows::Visits(entries) if entries[0] == ENTRIES[2] => 2,
            Follows::Visits(entries) => 2 + entries.len() + usize::from(nearest.slot == 0) * 2,
        }] += 1;
        if follows == Follows::End {
            block.expect("vertex", record.v[nearest.slot]);
        }
        if let Follows::Visits(entries) = follows {
            let parity = state.is_some_and(|search| search.parity);
            check_visits(&block, &entries, visit, record.turned(nearest.slot), parity);
        }
        block.edge();
    }
    assert!(seen.iter().all(|count| *count > ROUNDS / 300), "nothing, ends, looks, other visits by number: {seen:?}");
}

/// Compares the visits that are asked for. The record has the centre in slot 0.
fn check_visits(block: &Stepper<NearSearch>, entries: &[u64], from: Visit, record: Record, parity: bool) {
    let next = |entry: u64| match entry {
        2 => record.n[2],
        6 => record.n[1],
        _ => from.record,
    };
    let found = Visit::of_bundle(block.get("bundle"));
    let wanted = Visit {
        rotates: entries[0] != ENTRIES[2],
        locks: false,
        entry: entries[0],
        after: found.after,
        cavity_entry: parity.into(),
        cavity_record: from.record,
        record: next(entries[0]),
        context: from.context,
    };
    assert_eq!(found, wanted);
    let bundle = unpack(BUNDLE, block.get("bundle"));
    assert_eq!(bundle[..2], [u64::from(entries.len() == 2), 0], "one or two visits");
    if let Some(&second) = entries.get(1) {
        assert_eq!([bundle[6], bundle[11]], [second, next(second)], "entry and record of the second visit");
    }
}
