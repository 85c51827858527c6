//! Parts of the control blocks that hold state: the phases, the first triangle, the waiting point. Rust, Verilog and tables of what
//! must happen agree clock by clock.

mod stepper;

use std::collections::{BTreeMap, VecDeque};

use incircle_cli::generate::SplitMix64;
use incircle_hdl::engine::{PhaseMachine, Seeder};
use incircle_hdl::link::PointSlot;
use stepper::bundles::{record_write, Finding};
use stepper::{ports, Stepper};

ports!(
    PhaseMachine,
    [
        reset,
        takes_for_walk,
        takes_for_seed,
        seed_ends,
        finds,
        finds_duplicate,
        opened,
        nothing_is_out,
        overflows,
        commit_ends,
        solo_ends
    ],
    [is_idle, is_seed, is_walk, is_root, is_cavity, is_commit, is_drain, is_solo],
    clock
);
ports!(
    Seeder,
    [reset, clears, infinite, prepares, is_seed, done, verdict],
    [seeded, collinear, seeds, ends, write],
    clock
);
ports!(
    PointSlot,
    [reset, clears, capacity, collinear, accepts, word, takes],
    [valid, id, point, is_new, arrived, refused],
    clock
);

const CLOCKS: usize = 8000;
const PHASES: [&str; 8] = [
    "is_idle",
    "is_seed",
    "is_walk",
    "is_root",
    "is_cavity",
    "is_commit",
    "is_drain",
    "is_solo",
];
/// In this phase this event leads to that phase; of two events at once the later line counts.
const STEPS: [(&str, &str, &str); 11] = [
    ("is_idle", "takes_for_walk", "is_walk"),
    ("is_idle", "takes_for_seed", "is_seed"),
    ("is_seed", "seed_ends", "is_idle"),
    ("is_walk", "finds", "is_root"),
    ("is_walk", "finds_duplicate", "is_idle"),
    ("is_root", "opened", "is_cavity"),
    ("is_cavity", "nothing_is_out", "is_commit"),
    ("is_cavity", "overflows", "is_drain"),
    ("is_commit", "commit_ends", "is_idle"),
    ("is_drain", "nothing_is_out", "is_solo"),
    ("is_solo", "solo_ends", "is_idle"),
];

#[test]
fn phases_follow_their_table() {
    let mut random = SplitMix64::new(30);
    let mut block = Stepper::new("phase_machine", PhaseMachine::default(), 1);
    let mut phase = None;
    let mut taken = [0; STEPS.len()];
    for clock in 0..CLOCKS {
        let reset = clock == 0 || random.below(100) == 0;
        block.set("reset", reset);
        let mut next = phase;
        let mut events = BTreeMap::new();
        for (_, event, _) in STEPS {
            events.entry(event).or_insert_with(|| random.below(6) == 0);
        }
        for (event, happens) in &events {
            block.set(event, *happens);
        }
        for (step, (from, event, to)) in STEPS.iter().enumerate() {
            if phase == Some(*from) && events[event] {
                next = Some(*to);
                taken[step] += 1;
            }
        }
        block.settle();
        if phase.is_some() {
            for name in PHASES {
                block.expect(name, phase == Some(name));
            }
        }
        block.edge();
        phase = if reset { Some("is_idle") } else { next };
    }
    assert!(taken.iter().all(|times| *times > 20), "{taken:?}");
}

/// What the seeder does in a clock to come.
#[derive(Clone, Copy, Debug)]
struct Act {
    write: u128,
    is_last: bool,
}

#[test]
fn seeder_writes_the_first_triangle() {
    let mut random = SplitMix64::new(31);
    let mut block = Stepper::new("seeder", Seeder::default(), 1);
    let infinite = 0x7fff;
    let (mut acts, mut made) = (VecDeque::<Act>::new(), None);
    let (mut seeded, mut collinear, mut looks) = (false, false, false);
    let mut kinds = [0; 3];
    for clock in 0..CLOCKS {
        let reset = clock == 0 || random.below(150) == 0;
        let is_at_rest = !looks && acts.is_empty();
        let clears = is_at_rest && random.below(10) == 0;
        let prepares = is_at_rest && !seeded && random.below(4) == 0;
        let done = looks && random.below(5) == 0;
        let is_seed = !is_at_rest;
        let bits = random.next_u64();
        let finding = Finding {
            conflict: bits & 1 == 1,
            located: bits & 2 == 2,
            falls_onto_corner: bits & 4 == 4,
            is_left: bits & 8 == 8,
            is_straight: bits & 48 == 48,
            walk_next: bits >> 49,
        };
        for (port, value) in [
            ("reset", reset),
            ("clears", clears),
            ("prepares", prepares),
            ("is_seed", is_seed),
            ("done", done),
        ] {
            block.set(port, value);
        }
        block.set("infinite", infinite);
        block.set("verdict", finding.verdict());
        block.settle();
        let act = acts.pop_front();
        let is_last = act.is_some_and(|act| act.is_last);
        if clock > 0 {
            block.expect("seeded", seeded);
            block.expect("collinear", collinear);
            block.expect("seeds", is_last);
            block.expect("ends", is_last || done && finding.is_straight);
            match made {
                Some(write) => block.expect("write", write),
                None => block.expect_masked("write", 1, 0u128),
            }
        }
        block.edge();
        made = act
            .map(|act| act.write)
            .or(prepares.then(|| record_write(0, [0, 1, 2], [0; 3])));
        seeded |= is_last;
        if done {
            looks = false;
            kinds[if finding.is_straight {
                0
            } else {
                1 + usize::from(finding.is_left)
            }] += 1;
            let (b, c) = if finding.is_left { (1, 2) } else { (2, 1) };
            let records = [
                record_write(0, [0, b, c], [1, 2, 3]),
                record_write(1, [c, b, infinite], [3, 2, 0]),
                record_write(2, [0, c, infinite], [1, 3, 0]),
                record_write(3, [b, 0, infinite], [2, 1, 0]),
            ];
            if finding.is_straight {
                collinear = true;
            } else {
                acts = records
                    .iter()
                    .enumerate()
                    .map(|(id, write)| Act {
                        write: *write,
                        is_last: id == 3,
                    })
                    .collect();
            }
        } else if is_at_rest && !seeded && !collinear {
            looks = random.below(6) == 0;
        }
        if clears || reset {
            (seeded, collinear) = (false, false);
        }
        if reset {
            acts.clear();
            (made, looks) = (None, false);
        }
    }
    assert!(kinds.iter().all(|times| *times > 20), "{kinds:?}");
}

#[test]
fn point_slot_holds_a_point_until_it_is_taken() {
    for capacity in [4u64, 8, 16384] {
        let mut random = SplitMix64::new(32);
        let mut block = Stepper::new("point_slot", PointSlot::default(), 1);
        block.set("capacity", capacity);
        let (mut waiting, mut is_new) = (None, false);
        let (mut arrived, mut refused, mut most) = (0, 0, 0);
        for clock in 0..CLOCKS {
            let reset = clock == 0 || random.below(200) == 0;
            let clears = waiting.is_none() && random.below(60) == 0;
            let collinear = random.below(8) == 0;
            let accepts = waiting.is_none() && !clears && random.below(2) == 0;
            let takes = waiting.is_some() && random.below(3) == 0;
            let word = random.below(1 << 32);
            for (port, value) in [
                ("reset", reset),
                ("clears", clears),
                ("collinear", collinear),
                ("accepts", accepts),
                ("takes", takes),
            ] {
                block.set(port, value);
            }
            block.set("word", word);
            block.settle();
            if clock > 0 {
                block.expect("valid", waiting.is_some());
                block.expect("is_new", is_new);
                block.expect("arrived", arrived);
                block.expect("refused", refused);
                if let Some((id, point)) = waiting {
                    block.expect("id", id);
                    block.expect("point", point);
                }
            }
            block.edge();
            is_new = accepts && !collinear && arrived < capacity;
            if takes {
                waiting = None;
            }
            if is_new {
                waiting = Some((arrived, word));
                arrived += 1;
            } else {
                refused += u64::from(accepts);
            }
            most = most.max(arrived);
            if clears || reset {
                (arrived, refused) = (0, 0);
            }
            if reset {
                (waiting, is_new) = (None, false);
            }
        }
        assert!(most >= 4, "{most}");
    }
}
