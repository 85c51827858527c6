//! Parts of the control blocks that hold state: the first triangle, the last point, what a `Clear` asks for, the watchdog. Rust,
//! Verilog and lists of what must happen agree clock by clock.

use std::collections::VecDeque;

use crate::rig::stepper::bundles::{record_write, Deal, Finding};
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_cli::generate::SplitMix64;
use incircle_hdl::engine::{Seeder, Watchdog};
use incircle_hdl::link::{ClearCommand, PointSlot, RecordBuffer};
use incircle_protocol::{
    clear_word, command_starts_batch, command_word, patience, Layout, Opcode, CORE_COORD_BITS, FIRST_ROUND,
    MAX_CONTEXTS, MAX_POINTS,
};

named_ports!(
    Seeder,
    [reset, clears, infinite, deal, came, came_id, arrived, looks, verdict],
    [seeded, start_is_open, collinear, has_no_start, seeds, write],
    clock
);
named_ports!(
    PointSlot,
    [reset, clears, capacity, engine, taken], [arrival, tally],
    clock
);
named_ports!(ClearCommand, [reset, built, taken], [clearing, deal], clock);
named_ports!(
    RecordBuffer,
    [reset, read_done, record, takes, takes_whole], [holds, word, is_at_last, vertex0, vertex1, vertex2],
    clock
);
named_ports!(Watchdog, [reset, finishes, is_quiet, patience], [stuck], clock);

const CLOCKS: usize = 8000;
const INFINITE: u64 = 0x7fff;

/// The first triangles as writes that are still to be made.
#[derive(Default)]
struct SeedReference {
    /// Jobs of a batch; 0: there is none.
    jobs: u64,
    /// The job whose triangle is due.
    job: u64,
    /// Its three points had come a clock ago.
    had_triple: bool,
    /// Writes to come.
    due: VecDeque<u128>,
    /// The write that the clock shows.
    made: Option<u128>,
    seeded: bool,
    collinear: bool,
}

/// Inputs of a clock of the seeder.
#[derive(Clone, Copy, Default)]
struct SeedInputs {
    reset: bool,
    clears: bool,
    /// The point that is being stored.
    came: Option<u64>,
    arrived: u64,
    looks: bool,
    finding: Finding,
}

impl SeedReference {
    fn is_open(&self) -> bool {
        self.had_triple && !self.seeded && !self.collinear
    }

    fn edge(&mut self, inputs: &SeedInputs) {
        let job = self.job;
        if self.due.len() == 1 {
            self.seeded = job + 1 == self.jobs.max(1);
            self.job += u64::from(!self.seeded);
        }
        self.had_triple = inputs.arrived >= 3 * job + 3;
        self.made = self.due.pop_front();
        if inputs.came == Some(3 * job) {
            self.made = Some(record_write(4 * job, [0, 1, 2].map(|k| 3 * job + k), [4 * job; 3]));
        }
        if inputs.looks {
            self.collinear = inputs.finding.is_straight;
            if !self.collinear {
                self.due = first_records(job, inputs.finding.is_left);
            }
        }
        if inputs.clears || inputs.reset {
            (self.seeded, self.collinear, self.had_triple, self.job) = (false, false, false, 0);
        }
        if inputs.reset {
            *self = Self { jobs: self.jobs, ..Self::default() };
        }
    }

    fn expect(&self, block: &Stepper<Seeder>) {
        block.expect("seeded", self.seeded);
        block.expect("collinear", self.collinear);
        block.expect("start_is_open", self.is_open());
        block.expect("has_no_start", (!self.had_triple || self.collinear) && self.due.is_empty());
        block.expect("seeds", self.due.len() == 1);
        match self.made {
            Some(write) => block.expect("write", write),
            None => block.expect_masked("write", 1, 0u128),
        }
    }
}

/// The first triangle of a job and its ghosts.
fn first_records(job: u64, turns_left: bool) -> VecDeque<u128> {
    let a = 3 * job;
    let (b, c) = if turns_left { (a + 1, a + 2) } else { (a + 2, a + 1) };
    let inf = INFINITE;
    let record = |k: u64, v, n: [u64; 3]| record_write(4 * job + k, v, n.map(|k| 4 * job + k));
    [
        record(0, [a, b, c], [1, 2, 3]),
        record(1, [c, b, inf], [3, 2, 0]),
        record(2, [a, c, inf], [1, 3, 0]),
        record(3, [b, a, inf], [2, 1, 0]),
    ]
    .into()
}

fn seed_inputs(random: &mut SplitMix64, reference: &SeedReference, arrived: u64) -> SeedInputs {
    let rests = reference.due.is_empty();
    let is_due = !reference.seeded && !reference.collinear && arrived >= 3 * reference.job + 3;
    let came = (rests && !is_due && random.below(2) == 0).then_some(arrived);
    let bits = random.next_u64();
    let looks = rests && reference.is_open() && random.below(4) == 0;
    let often = if reference.seeded || reference.collinear { 10 } else { 200 };
    SeedInputs {
        reset: random.below(600) == 0,
        clears: rests && came.is_none() && !looks && random.below(often) == 0,
        came,
        arrived: came.map_or(arrived, |id| id + 1),
        looks,
        finding: Finding {
            conflict: bits & 1 == 1,
            located: bits & 2 == 2,
            falls_onto_corner: bits & 4 == 4,
            is_left: bits & 8 == 8,
            is_straight: bits & 0x70 == 0x70,
            walk_next: bits >> 49,
        },
    }
}

fn set_seed_inputs(block: &mut Stepper<Seeder>, reference: &SeedReference, inputs: &SeedInputs) {
    let is_batch = reference.jobs > 0;
    block.set("deal", Deal { contexts: if is_batch { reference.jobs } else { 7 }, is_batch, dealt_from: 0 }.bits());
    block.set("reset", inputs.reset);
    block.set("clears", inputs.clears);
    block.set("came", inputs.came.is_some());
    // Without `came` it is anything.
    block.set("came_id", inputs.came.unwrap_or(3 * reference.job));
    block.set("arrived", inputs.arrived);
    block.set("looks", inputs.looks);
    block.set("verdict", inputs.finding.verdict());
    block.settle();
}

#[test]
fn seeder_writes_the_first_triangle_of_every_job() {
    let mut random = SplitMix64::new(31);
    let mut block = Stepper::new("seeder", Seeder::default(), 1);
    let mut reference = SeedReference::default();
    let (mut kinds, mut arrived, mut batches) = ([0; 3], 0, 0);
    block.set("infinite", INFINITE);
    for clock in 0..2 * CLOCKS {
        let mut inputs = seed_inputs(&mut random, &reference, arrived);
        inputs.reset |= clock == 0;
        if inputs.clears || inputs.reset {
            batches += usize::from(reference.seeded && reference.jobs > 1);
            reference.jobs = if inputs.reset { 0 } else { random.below(25) };
        }
        set_seed_inputs(&mut block, &reference, &inputs);
        if clock > 0 {
            reference.expect(&block);
        }
        block.edge();
        if inputs.looks {
            let finding = inputs.finding;
            kinds[usize::from(finding.is_straight) * 2 + usize::from(finding.is_left && !finding.is_straight)] += 1;
        }
        reference.edge(&inputs);
        arrived = if inputs.clears || inputs.reset { 0 } else { inputs.arrived };
    }
    assert!(kinds.iter().all(|times| *times > 20) && batches > 20, "{kinds:?} {batches}");
}

#[test]
fn seeder_shows_the_wave_of_its_header() {
    let mut block = Stepper::new("seeder", Seeder::default(), 1);
    let reference = SeedReference { jobs: 2, ..SeedReference::default() };
    block.set("infinite", INFINITE);
    let mut wave = Wave::default();
    for clock in 0..17 {
        let came = [(1, 0), (3, 1), (5, 2), (14, 3)].into_iter().find(|came| came.0 == clock).map(|came| came.1);
        let arrived = [1, 3, 5, 14].into_iter().filter(|&came| came <= clock).count() as u64;
        let looks = clock == 8;
        let finding = Finding { is_left: true, ..Finding::default() };
        let inputs = SeedInputs { reset: clock == 0, clears: false, came, arrived, looks, finding };
        set_seed_inputs(&mut block, &reference, &inputs);
        if clock > 0 {
            let writes = block.get_masked("write", 1) == 1;
            let id = if writes { Cell::Number(block.get_masked("write", 0xfffe) >> 1) } else { Cell::Open };
            wave.take(&[
                ("came", Cell::Bit(came.is_some())),
                ("looks", Cell::Bit(looks)),
                ("start_is_open", Cell::Bit(block.is("start_is_open"))),
                ("has_no_start", Cell::Bit(block.is("has_no_start"))),
                ("write.valid", Cell::Bit(writes)),
                ("write.id", id),
                ("seeds", Cell::Bit(block.is("seeds"))),
                ("seeded", Cell::Bit(block.is("seeded"))),
            ]);
        }
        block.edge();
    }
    wave.assert_drawn_in("seeder");
}

/// Points that were stored, in their order, and how many were not.
#[derive(Default)]
struct SlotReference {
    stored: Vec<u64>,
    came: bool,
    refused: u64,
    /// The last point is refused, and counted at the next edge.
    is_surplus: bool,
}

impl SlotReference {
    fn expect(&self, block: &Stepper<PointSlot>) {
        block.expect("came", self.came);
        block.expect("arrived", self.stored.len() as u64);
        block.expect("refused", self.refused);
        block.expect("some_refused", self.refused > 0);
        if let (true, Some(point)) = (self.came, self.stored.last()) {
            block.expect("arrival_id", self.stored.len() as u64 - 1);
            block.expect("point", *point);
        }
    }

    /// An edge at which `word` comes and is stored or refused.
    fn edge(&mut self, word: Option<u64>, has_room: bool) {
        let stored = word.filter(|_| has_room);
        self.refused += u64::from(self.is_surplus);
        self.is_surplus = word.is_some() && !has_room;
        self.came = stored.is_some();
        self.stored.extend(stored);
    }
}

fn point_slot(capacity: u64) {
    let mut random = SplitMix64::new(32);
    let mut block = Stepper::new("point_slot", PointSlot::default(), 1);
    block.set("capacity", capacity);
    let (mut reference, mut most) = (SlotReference::default(), 0);
    for clock in 0..CLOCKS {
        let reset = clock == 0 || random.below(200) == 0;
        let clears = !reference.came && random.below(60) == 0;
        let [collinear, stuck] = [(); 2].map(|()| random.below(12) == 0);
        let accepts = !reference.came && !clears && random.below(2) == 0;
        let word = random.below(1 << 32);
        for (port, value) in
            [("reset", reset), ("clears", clears), ("collinear", collinear), ("stuck", stuck), ("is_point", accepts)]
        {
            block.set(port, value);
        }
        block.set("word", word);
        block.settle();
        if clock > 0 {
            reference.expect(&block);
        }
        block.edge();
        let has_room = !collinear && !stuck && (reference.stored.len() as u64) < capacity;
        reference.edge(accepts.then_some(word), has_room);
        most = most.max(reference.stored.len());
        if clears || reset {
            reference = SlotReference::default();
        }
    }
    assert!(most >= 4, "{most}");
}

#[test]
fn point_slot_hands_on_a_point_and_counts_it() {
    for capacity in [4, 8, 16384] {
        point_slot(capacity);
    }
}

#[test]
fn clear_command_is_granted_or_refused() {
    let mut random = SplitMix64::new(33);
    let mut block = Stepper::new("clear_command", ClearCommand::default(), 1);
    let (mut clears, mut contexts, mut is_batch, mut is_refused) = (false, 0, false, None);
    // The first vertex that is dealt follows a clock later.
    let mut dealt_from = 0;
    let mut kinds = [0; 3];
    let mut built = 1;
    for clock in 0..CLOCKS {
        let reset = clock == 0 || random.below(300) == 0;
        if reset {
            built = 1 + random.below(MAX_CONTEXTS.into()) as u32;
        }
        let wanted = [0, built, built + 1, random.below(256) as u32][random.below(4) as usize];
        let word = match random.below(3) {
            0 => command_word(Opcode::Insert) | wanted,
            1 => random.next_u64() as u32,
            // Of the bits between the opcode and the low byte only the lowest counts.
            _ => clear_word(wanted) | (random.below(1 << 16) as u32) << 8,
        };
        let accepts = random.below(2) == 0;
        block.set("reset", reset);
        block.set("built", built);
        block.set("is_command", accepts);
        block.set("word", word);
        block.settle();
        if clock > 1 {
            block.expect("clears", clears);
            let deal = Deal { contexts: contexts.into(), is_batch, dealt_from };
            block.expect("deal", deal.bits());
        }
        if let Some(is_refused) = is_refused {
            block.expect("is_refused", u32::from(is_refused));
        }
        block.edge();
        dealt_from = if is_batch { 3 * u64::from(contexts) } else { FIRST_ROUND.into() };
        let asks = accepts && word >> 24 == Opcode::Clear as u32;
        let number = word & 0xff;
        clears = asks && number <= built && !reset;
        if clears {
            contexts = if number == 0 { built } else { number };
            is_batch = command_starts_batch(word);
        }
        if accepts {
            is_refused = Some(asks && number > built);
        }
        if asks {
            kinds[if number > built { 2 } else { usize::from(number > 0) }] += 1;
        }
        if reset {
            (contexts, is_batch, dealt_from) = (built, false, FIRST_ROUND.into());
        }
    }
    assert!(kinds.iter().all(|times| *times > 100), "{kinds:?}");
}

#[test]
fn record_buffer_hands_out_three_words_or_all_vertices() {
    let mut random = SplitMix64::new(35);
    let mut block = Stepper::new("record_buffer", RecordBuffer::default(), 1);
    let layout = Layout::of(CORE_COORD_BITS, MAX_POINTS);
    let mut words: VecDeque<u32> = VecDeque::new();
    let (mut records, mut streamed) = (0, 0);
    for clock in 0..CLOCKS {
        let reset = clock == 0 || random.below(100) == 0;
        let is_whole = words.len() == 3;
        let takes_whole = is_whole && random.below(3) == 0;
        let takes = !words.is_empty() && !takes_whole && random.below(3) != 0;
        // The next record may come as one is taken whole.
        let comes = (words.is_empty() || takes_whole) && random.below(3) == 0;
        let columns = [(); 6].map(|()| random.below(1 << 15) as u32);
        let was_set = random.below(2) == 0;
        block.set("takes_whole", takes_whole);
        for (port, value) in [("reset", reset), ("read_done", comes), ("takes", takes), ("was_set", was_set)] {
            block.set(port, value);
        }
        for (port, value) in ["v0", "v1", "v2", "n0", "n1", "n2"].into_iter().zip(columns) {
            block.set(port, value);
        }
        block.settle();
        if clock > 0 {
            block.expect("holds", !words.is_empty());
        }
        if let Some(word) = words.front() {
            block.expect("word", *word);
            block.expect("is_at_last", words.len() == 1);
        }
        for (port, word) in ["vertex0", "vertex1", "vertex2"].into_iter().zip(&words).filter(|_| is_whole) {
            block.expect(port, word & 0x7fff);
        }
        block.edge();
        if takes {
            words.pop_front();
        }
        if takes_whole {
            words.clear();
        }
        streamed += u32::from(comes && takes_whole && !reset);
        if comes {
            let [v0, v1, v2, n @ ..] = columns;
            words.extend(&layout.record_to_words([v0, v1, v2], n, was_set)[..3]);
        }
        if reset {
            words.clear();
        }
        records += u32::from(comes && !reset);
    }
    assert!(records > 500 && streamed > 50, "{records} records, {streamed} behind each other");
}

#[test]
fn watchdog_loses_its_patience_and_not_before() {
    let mut random = SplitMix64::new(34);
    let mut block = Stepper::new("watchdog", Watchdog::default(), 1);
    for given in [0, 1, 5, 40] {
        let (mut idle_since, mut rested, mut is_over, mut stuck, mut times) = (0, false, false, false, 0);
        for clock in 0..2000 {
            let reset = clock == 0 || random.below(if stuck { 10 } else { 200 }) == 0;
            let [finishes, is_quiet] = [(); 2].map(|()| random.below(2 * given + 8) == 0);
            block.set("reset", reset);
            block.set("finishes", finishes);
            block.set("is_quiet", is_quiet);
            block.set("patience", given);
            block.settle();
            if clock > 0 {
                block.expect("stuck", stuck);
            }
            block.edge();
            // Each is known a clock later: that the core rests, that it has been too long, that it is stuck.
            times += usize::from(!stuck && is_over);
            stuck = !reset && (stuck || is_over);
            is_over = !reset && clock - idle_since == given;
            if rested || reset {
                idle_since = clock + 1;
            }
            rested = !reset && (finishes || is_quiet);
        }
        assert!(times > 5, "{times}");
    }
    assert!(patience(MAX_POINTS) < 1 << 22, "the port is wide enough");
}

#[test]
fn watchdog_shows_the_wave_of_its_header() {
    let mut block = Stepper::new("watchdog", Watchdog::default(), 1);
    block.set("patience", 4u64);
    let mut wave = Wave::default();
    for clock in 0..17 {
        let (is_quiet, finishes) = (clock == 1, clock == 4);
        block.set("reset", clock == 0);
        block.set("is_quiet", is_quiet);
        block.set("finishes", finishes);
        block.settle();
        if clock > 0 {
            wave.take(&[
                ("is_quiet", Cell::Bit(is_quiet)),
                ("finishes", Cell::Bit(finishes)),
                ("stuck", Cell::Bit(block.is("stuck"))),
            ]);
        }
        block.edge();
    }
    wave.assert_drawn_in("watchdog");
}
