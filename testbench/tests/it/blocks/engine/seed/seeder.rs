//! Runs `Seeder` in Rust and in Verilog beside lists of what must happen: all three must agree in every clock.

use std::collections::VecDeque;

use crate::rig::stepper::bundles::{record_write, Deal, Finding};
use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::engine::Seeder;
use incircle_testkit::SplitMix64;

named_ports!(
    Seeder,
    [reset, clears, infinite, deal, arrival, arrived, looks, verdict],
    [progress, start_is_open, collinear, write],
    clock
);

const CLOCKS: usize = 8000;

const INFINITE: u64 = 0x7fff;

/// The first triangles as writes that are still to be made.
#[derive(Default)]
struct SeedReference {
    /// Number of jobs of a batch, or 0 without a batch.
    jobs: u64,
    /// The job whose triangle is due.
    job: u64,
    /// The three points of that job had come a clock ago.
    had_triple: bool,
    /// Writes that are still to come.
    due: VecDeque<u128>,
    /// The write that the clock shows.
    made: Option<u128>,
    seeded: bool,
    collinear: bool,
}

/// Inputs of the seeder in a clock.
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

/// Writes of the first triangle of a job and of its ghost triangles.
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
    let jobs = reference.jobs.max(1);
    block.set("deal", Deal { contexts: 7, jobs, dealt_from: 0 }.bits());
    block.set("reset", inputs.reset);
    block.set("clears", inputs.clears);
    block.set("came", inputs.came.is_some());
    // Without `came` the input is arbitrary.
    block.set("arrival_id", inputs.came.unwrap_or(3 * reference.job));
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
