//! Parts of the control blocks that hold state: the first triangle, the last point, what a `Clear` asks for, the watchdog. Rust,
//! Verilog and lists of what must happen agree clock by clock.

mod block_ports;
mod stepper;

use std::collections::VecDeque;

use incircle_cli::generate::SplitMix64;
use incircle_hdl::engine::{Seeder, Watchdog};
use incircle_hdl::link::{ClearCommand, PointSlot, RecordBuffer};
use incircle_protocol::{
    clear_word, command_word, patience, Layout, Opcode, CORE_COORD_BITS, MAX_CONTEXTS, MAX_POINTS,
};
use stepper::bundles::{record_write, Finding};
use stepper::{named_ports, Cell, Stepper, Wave};

named_ports!(
    Seeder,
    [reset, clears, infinite, prepares, looks, verdict],
    [seeded, collinear, seeds, is_at_work, write],
    clock
);
named_ports!(
    PointSlot,
    [reset, clears, capacity, collinear, stuck, accepts, word],
    [came, came_id, point, arrived, refused, has_three, some_refused],
    clock
);
named_ports!(ClearCommand, [reset, built, accepts, word], [clears, contexts, is_refused], clock);
named_ports!(
    RecordBuffer,
    [reset, read_done, v0, v1, v2, n0, n1, n2, was_set, takes, takes_whole],
    [holds, word, is_at_last, vertex0, vertex1, vertex2],
    clock
);
named_ports!(Watchdog, [reset, finishes, is_quiet, patience], [stuck], clock);

const CLOCKS: usize = 8000;
const INFINITE: u64 = 0x7fff;

/// The first triangle as writes that are still to be made.
#[derive(Default)]
struct SeedReference {
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
    looks: bool,
    finding: Finding,
}

impl SeedReference {
    fn edge(&mut self, inputs: &SeedInputs) {
        self.seeded |= self.due.len() == 1;
        self.made = self.due.pop_front();
        if inputs.prepares {
            self.made = Some(record_write(0, [0, 1, 2], [0; 3]));
        }
        if inputs.looks {
            self.collinear = inputs.finding.is_straight;
            if !self.collinear {
                self.due = first_records(inputs.finding.is_left);
            }
        }
        if inputs.clears {
            (self.seeded, self.collinear) = (false, false);
        }
        if inputs.reset {
            *self = Self::default();
        }
    }

    fn expect(&self, block: &Stepper<Seeder>) {
        block.expect("seeded", self.seeded);
        block.expect("collinear", self.collinear);
        block.expect("seeds", self.due.len() == 1);
        block.expect("is_at_work", !self.due.is_empty());
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
    let rests = reference.due.is_empty();
    let is_open = rests && !reference.seeded && !reference.collinear;
    let bits = random.next_u64();
    SeedInputs {
        reset: random.below(150) == 0,
        clears: rests && random.below(10) == 0,
        prepares: is_open && random.below(4) == 0,
        looks: is_open && random.below(8) == 0,
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

fn set_seed_inputs(block: &mut Stepper<Seeder>, inputs: &SeedInputs) {
    block.set("reset", inputs.reset);
    block.set("clears", inputs.clears);
    block.set("prepares", inputs.prepares);
    block.set("looks", inputs.looks);
    block.set("verdict", inputs.finding.verdict());
    block.settle();
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
        set_seed_inputs(&mut block, &inputs);
        if clock > 0 {
            reference.expect(&block);
        }
        block.edge();
        if inputs.looks {
            let finding = inputs.finding;
            kinds[usize::from(finding.is_straight) * 2 + usize::from(finding.is_left && !finding.is_straight)] += 1;
        }
        reference.edge(&inputs);
    }
    assert!(kinds.iter().all(|times| *times > 20), "{kinds:?}");
}

#[test]
fn seeder_shows_the_wave_of_its_header() {
    let mut block = Stepper::new("seeder", Seeder::default(), 1);
    block.set("infinite", INFINITE);
    let mut wave = Wave::default();
    for clock in 0..17 {
        let (reset, prepares, looks) = (clock == 0, clock == 1, clock == 4);
        let finding = Finding { is_left: true, ..Finding::default() };
        set_seed_inputs(&mut block, &SeedInputs { reset, clears: false, prepares, looks, finding });
        if clock > 0 {
            let writes = block.get_masked("write", 1) == 1;
            let id = if writes { Cell::Number(block.get_masked("write", 0xfffe) >> 1) } else { Cell::Open };
            wave.take(&[
                ("prepares", Cell::Bit(prepares)),
                ("looks", Cell::Bit(looks)),
                ("is_at_work", Cell::Bit(block.is("is_at_work"))),
                ("write.valid", Cell::Bit(writes)),
                ("write.id", id),
                ("seeds", Cell::Bit(block.is("seeds"))),
                ("seeded", Cell::Bit(block.is("seeded"))),
            ]);
        }
        block.edge();
    }
    wave.assert_drawn_in(include_str!("../../hdl/src/engine/seeder.rs"));
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
        if !self.came {
            block.expect("has_three", self.stored.len() == 3);
        }
        if let (true, Some(point)) = (self.came, self.stored.last()) {
            block.expect("came_id", self.stored.len() as u64 - 1);
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
            [("reset", reset), ("clears", clears), ("collinear", collinear), ("stuck", stuck), ("accepts", accepts)]
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
    let (mut clears, mut contexts, mut is_refused) = (false, 0, None);
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
            // Bits between the opcode and the low byte do not count.
            _ => clear_word(wanted) | (random.below(1 << 16) as u32) << 8,
        };
        let accepts = random.below(2) == 0;
        block.set("reset", reset);
        block.set("built", built);
        block.set("accepts", accepts);
        block.set("word", word);
        block.settle();
        if clock > 0 {
            block.expect("clears", clears);
            block.expect("contexts", contexts);
        }
        if let Some(is_refused) = is_refused {
            block.expect("is_refused", u32::from(is_refused));
        }
        block.edge();
        let asks = accepts && word >> 24 == Opcode::Clear as u32;
        let number = word & 0xff;
        clears = asks && number <= built && !reset;
        if clears {
            contexts = if number == 0 { built } else { number };
        }
        if accepts {
            is_refused = Some(asks && number > built);
        }
        if asks {
            kinds[if number > built { 2 } else { usize::from(number > 0) }] += 1;
        }
        if reset {
            contexts = built;
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
    wave.assert_drawn_in(include_str!("../../hdl/src/engine/watchdog.rs"));
}
