//! Parts of the control blocks that hold state: the phases, the first triangle, the waiting point. Rust, Verilog and tables of what
//! must happen agree clock by clock.

mod block_ports;
mod stepper;

use std::collections::{BTreeMap, VecDeque};

use incircle_cli::generate::SplitMix64;
use incircle_hdl::engine::{PhaseMachine, Seeder};
use incircle_hdl::link::PointSlot;
use stepper::bundles::{record_write, Finding};
use stepper::{named_ports, Stepper};

named_ports!(
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
named_ports!(
    Seeder,
    [reset, clears, infinite, prepares, is_seed, done, verdict],
    [seeded, collinear, seeds, ends, write],
    clock
);
named_ports!(
    PointSlot,
    [reset, clears, capacity, collinear, accepts, word, takes],
    [valid, id, point, is_new, arrived, refused],
    clock
);

const CLOCKS: usize = 8000;
const PHASES: [&str; 8] = ["is_idle", "is_seed", "is_walk", "is_root", "is_cavity", "is_commit", "is_drain", "is_solo"];
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

/// The first triangle as writes that are still to be made.
#[derive(Default)]
struct SeedReference {
    looks: bool,
    /// Writes to come.
    due: VecDeque<u128>,
    /// The write that the clock shows.
    made: Option<u128>,
    seeded: bool,
    collinear: bool,
}

/// Inputs of a clock of the seeder.
struct SeedInputs {
    reset: bool,
    clears: bool,
    prepares: bool,
    done: bool,
    finding: Finding,
}

const INFINITE: u64 = 0x7fff;

impl SeedReference {
    fn is_at_rest(&self) -> bool {
        !self.looks && self.due.is_empty()
    }

    fn edge(&mut self, inputs: &SeedInputs, looks_next: bool) {
        let starts = self.is_at_rest() && looks_next && !self.seeded && !self.collinear;
        self.seeded |= self.due.len() == 1;
        self.made = self.due.pop_front();
        if inputs.prepares {
            self.made = Some(record_write(0, [0, 1, 2], [0; 3]));
        }
        if inputs.done {
            self.looks = false;
            self.collinear = inputs.finding.is_straight;
            if !self.collinear {
                self.due = first_records(inputs.finding.is_left);
            }
        }
        self.looks |= starts;
        if inputs.clears {
            (self.seeded, self.collinear) = (false, false);
        }
        if inputs.reset {
            *self = Self::default();
        }
    }

    fn expect(&self, block: &Stepper<Seeder>, inputs: &SeedInputs) {
        let is_last = self.due.len() == 1;
        block.expect("seeded", self.seeded);
        block.expect("collinear", self.collinear);
        block.expect("seeds", is_last);
        block.expect("ends", is_last || inputs.done && inputs.finding.is_straight);
        match self.made {
            Some(write) => block.expect("write", write),
            None => block.expect_masked("write", 1, 0u128),
        }
    }
}

/// The triangle of vertices 0, 1, 2 and its ghosts.
fn first_records(turns_left: bool) -> VecDeque<u128> {
    let (b, c) = if turns_left { (1, 2) } else { (2, 1) };
    let inf = INFINITE;
    [
        record_write(0, [0, b, c], [1, 2, 3]),
        record_write(1, [c, b, inf], [3, 2, 0]),
        record_write(2, [0, c, inf], [1, 3, 0]),
        record_write(3, [b, 0, inf], [2, 1, 0]),
    ]
    .into()
}

fn seed_inputs(random: &mut SplitMix64, reference: &SeedReference) -> SeedInputs {
    let rests = reference.is_at_rest();
    let bits = random.next_u64();
    SeedInputs {
        reset: random.below(150) == 0,
        clears: rests && random.below(10) == 0,
        prepares: rests && !reference.seeded && random.below(4) == 0,
        done: reference.looks && random.below(5) == 0,
        finding: Finding {
            conflict: bits & 1 == 1,
            located: bits & 2 == 2,
            falls_onto_corner: bits & 4 == 4,
            is_left: bits & 8 == 8,
            is_straight: bits & 48 == 48,
            walk_next: bits >> 49,
        },
    }
}

#[test]
fn seeder_writes_the_first_triangle() {
    let mut random = SplitMix64::new(31);
    let mut block = Stepper::new("seeder", Seeder::default(), 1);
    let mut reference = SeedReference::default();
    let mut kinds = [0; 3];
    block.set("infinite", INFINITE);
    for clock in 0..CLOCKS {
        let mut inputs = seed_inputs(&mut random, &reference);
        inputs.reset |= clock == 0;
        block.set("reset", inputs.reset);
        block.set("clears", inputs.clears);
        block.set("prepares", inputs.prepares);
        block.set("is_seed", !reference.is_at_rest());
        block.set("done", inputs.done);
        block.set("verdict", inputs.finding.verdict());
        block.settle();
        if clock > 0 {
            reference.expect(&block, &inputs);
        }
        block.edge();
        if inputs.done {
            let finding = inputs.finding;
            kinds[usize::from(finding.is_straight) * 2 + usize::from(finding.is_left && !finding.is_straight)] += 1;
        }
        reference.edge(&inputs, random.below(6) == 0);
    }
    assert!(kinds.iter().all(|times| *times > 20), "{kinds:?}");
}

/// The waiting point and the counts.
#[derive(Default)]
struct SlotReference {
    waiting: Option<(u64, u64)>,
    is_new: bool,
    arrived: u64,
    refused: u64,
}

impl SlotReference {
    fn expect(&self, block: &Stepper<PointSlot>) {
        block.expect("valid", self.waiting.is_some());
        block.expect("is_new", self.is_new);
        block.expect("arrived", self.arrived);
        block.expect("refused", self.refused);
        if let Some((id, point)) = self.waiting {
            block.expect("id", id);
            block.expect("point", point);
        }
    }

    /// An edge at which `word` comes and is stored or refused.
    fn edge(&mut self, word: Option<u64>, has_room: bool, takes: bool) {
        if takes {
            self.waiting = None;
        }
        let stored = word.filter(|_| has_room);
        self.refused += u64::from(word.is_some() && !has_room);
        self.is_new = stored.is_some();
        if let Some(word) = stored {
            self.waiting = Some((self.arrived, word));
            self.arrived += 1;
        }
    }
}

fn point_slot(capacity: u64) {
    let mut random = SplitMix64::new(32);
    let mut block = Stepper::new("point_slot", PointSlot::default(), 1);
    block.set("capacity", capacity);
    let (mut reference, mut most) = (SlotReference::default(), 0);
    for clock in 0..CLOCKS {
        let is_free = reference.waiting.is_none();
        let reset = clock == 0 || random.below(200) == 0;
        let clears = is_free && random.below(60) == 0;
        let collinear = random.below(8) == 0;
        let accepts = is_free && !clears && random.below(2) == 0;
        let takes = !is_free && random.below(3) == 0;
        let word = random.below(1 << 32);
        block.set("reset", reset);
        block.set("clears", clears);
        block.set("collinear", collinear);
        block.set("accepts", accepts);
        block.set("takes", takes);
        block.set("word", word);
        block.settle();
        if clock > 0 {
            reference.expect(&block);
        }
        block.edge();
        let has_room = !collinear && reference.arrived < capacity;
        reference.edge(accepts.then_some(word), has_room, takes);
        most = most.max(reference.arrived);
        if clears || reset {
            (reference.arrived, reference.refused) = (0, 0);
        }
        if reset {
            reference = SlotReference::default();
        }
    }
    assert!(most >= 4, "{most}");
}

#[test]
fn point_slot_holds_a_point_until_it_is_taken() {
    for capacity in [4, 8, 16384] {
        point_slot(capacity);
    }
}
