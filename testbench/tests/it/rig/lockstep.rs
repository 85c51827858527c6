//! Runs jobs on a pair of core and model, compares the answers with those of the model by commands, and
//! leaves a waveform of a mismatch.

use incircle::Point;
use incircle_model::{CommandModel, Inputs};
use incircle_protocol::{
    command_word, infinite_vertex, Config, Counter, Layout, Opcode, ShortIds, CORE_COORD_BITS, COUNTER_WORDS,
    IDENTITY_WORDS, INSERT_REPORT_WORDS, LATENCY_BUCKETS,
};
use incircle_testbench::lockstep::{Job, Lockstep, Mismatch, Stalls};
use incircle_testkit::{canonical, generate, Distribution, SplitMix64, StoredRecord};
use std::path::PathBuf;

/// A point as a command word.
pub fn word(x: u64, y: u64) -> u32 {
    x as u32 | (y as u32) << 16
}

/// Points of a distribution in the order in which the host sends them, duplicates included.
pub fn ordered(distribution: Distribution, count: usize, bits: u32, seed: u64, contexts: u32) -> Vec<u32> {
    let points = generate(distribution, count, bits, seed).unwrap_or_else(|error| panic!("{error}"));
    let points: Vec<Point> = points.into_iter().map(Point::from).collect();
    let order = incircle::order::brio_hilbert_dealt(&points, contexts);
    let mut ordered: Vec<Point> = order.into_iter().map(|index| points[index as usize]).collect();
    make_first_three_span(&mut ordered);
    ordered.into_iter().map(|p| word(u64::from(p.x), u64::from(p.y))).collect()
}

/// Moves the first point that is not collinear with the first two distinct ones to place 3.
fn make_first_three_span(points: &mut [Point]) {
    let Some(second) = points.iter().position(|&p| p != points[0]) else {
        return;
    };
    points.swap(1, second);
    let turns = |&p: &Point| {
        let [a, b] = [points[0], points[1]].map(|q| (i64::from(q.x), i64::from(q.y)));
        let c = (i64::from(p.x), i64::from(p.y));
        (b.0 - a.0) * (c.1 - a.1) != (b.1 - a.1) * (c.0 - a.0)
    };
    if let Some(third) = points.iter().position(turns) {
        points.swap(2, third);
    }
}

/// A pair of core and model that runs one job after another.
pub struct Rig {
    name: &'static str,
    config: Config,
    seed: u32,
    pair: Lockstep,
    random: SplitMix64,
    clocks: u64,
    counters: [u64; COUNTER_WORDS],
}

impl Rig {
    pub fn new(name: &'static str, config: Config, seed: u32) -> Self {
        let pair = Lockstep::new(name, config, seed);
        Self {
            name,
            config,
            seed,
            pair,
            random: SplitMix64::new(u64::from(seed)),
            clocks: 0,
            counters: [0; COUNTER_WORDS],
        }
    }

    /// Makes the pair in the state that an ECP5 has after configuration.
    pub fn configured(name: &'static str, config: Config) -> Self {
        Self { pair: Lockstep::configured(name, config), ..Self::new(name, config, 1) }
    }

    /// Starts again from another random initial state.
    pub fn start_anew(&mut self, salt: u32) {
        self.clocks += self.pair.clocks();
        self.seed = self.seed.wrapping_mul(31).wrapping_add(salt);
        self.pair = Lockstep::new(self.name, self.config, self.seed);
    }

    /// Checks that the test ran for at least this many clocks.
    pub fn expect_clocks(&mut self, least: u64) {
        self.clocks += self.pair.clocks();
        println!("{}: {} clocks", self.name, self.clocks);
        assert!(self.clocks >= least, "{} clocks, {least} are meant", self.clocks);
    }

    /// Value of a counter summed over all jobs.
    pub fn counted(&self, counter: Counter) -> u64 {
        self.counters[counter as usize]
    }

    /// Runs a whole job with this many contexts (0 for all): insert in pieces, read everything, latencies, counters.
    pub fn run(&mut self, points: &[u32], piece: usize, contexts: u32, stalls: Stalls) {
        let job = Job::of(points, piece, contexts, self.config);
        let answers = self.execute(&job, stalls);
        let expected = self.by_commands(&job);
        let counters = answers.len() - COUNTER_WORDS;
        for (sum, &word) in self.counters.iter_mut().zip(&answers[counters..]) {
            *sum += u64::from(word);
        }
        self.compare(points, piece, &answers, &expected);
    }

    /// Compares the core's answers with those of the model by commands, which knows no clock and no contexts: all
    /// reports are equal, and all meshes apart from their ids.
    fn compare(&self, points: &[u32], piece: usize, answers: &[u32], expected: &[u32]) {
        let reports = points.chunks(piece.max(1)).len() * (2 + INSERT_REPORT_WORDS);
        let triangles = 2 + IDENTITY_WORDS + 2 + reports;
        let behind = |head: usize| head + 2 + answers[head + 1] as usize;
        let (ten, twelve) = (behind(triangles), behind(behind(triangles)));
        let records = behind(twelve);
        let latencies = answers.len() - (2 + COUNTER_WORDS) - (2 + LATENCY_BUCKETS);
        assert_eq!(answers.len(), expected.len());
        assert_eq!(answers[2 + IDENTITY_WORDS..triangles + 2], expected[2 + IDENTITY_WORDS..triangles + 2], "reports");
        let layout = Layout::of(CORE_COORD_BITS, self.config.points);
        let stored = answers[records + 2..latencies].chunks(layout.record_words);
        let count = stored.len();
        for (place, record) in stored.enumerate() {
            let expected = layout.record_from_words(record).0;
            let vertices = layout.vertices_from_words(&answers[triangles + 2..ten], place);
            assert_eq!(vertices, expected, "vertices of record {place}");
            for (ids, words) in
                [(ShortIds::Ten, &answers[ten + 2..twelve]), (ShortIds::Twelve, &answers[twelve + 2..records])]
            {
                // Ids keep their low bits, also where they are too large for the form.
                let low = expected.map(|id| id & ((1 << ids.word_bits()) - 1));
                assert_eq!(ids.vertices_from_words(words, count, place), low, "{ids:?}, vertices of record {place}");
            }
        }
        let mesh = |words: &[u32]| {
            let stored = words[records + 2..latencies].chunks(3).map(|words| {
                let (vertices, links) = layout.record_from_words(words);
                StoredRecord { vertices, links, is_locked: words[0] >> 31 != 0 }
            });
            let arrived = &points[..points.len().min(self.config.points as usize)];
            let infinite = infinite_vertex(self.config.points);
            (stored.len() != 0)
                .then(|| canonical(stored, arrived, infinite).unwrap_or_else(|fault| panic!("{}: {fault}", self.name)))
        };
        assert_eq!(mesh(answers), mesh(expected), "the core and the model clock by clock agree, the mesh is wrong");
        let counters = answers.len() - COUNTER_WORDS;
        for counter in [Counter::Insertions, Counter::Duplicates, Counter::Refused] {
            let place = counters + counter as usize;
            assert_eq!(answers[place], expected[place], "{counter:?}");
        }
        let timed: u32 = answers[latencies + 2..latencies + 2 + LATENCY_BUCKETS].iter().sum();
        assert!(timed <= answers[counters + Counter::Insertions as usize], "{timed} latencies");
    }

    /// Runs any commands. `Counters` answers may hold cycles, so these answers are compared with
    /// the model clock by clock only.
    pub fn run_commands(&mut self, commands: &[u32], stalls: Stalls) {
        let mut job = Job { commands: commands.to_vec(), answers: 0 };
        // The pair keeps its mesh from run to run, so the number of answer words is known only
        // when no more of them come.
        self.execute(&job, stalls);
        job.commands.clear();
        for _ in 0..400 {
            self.step(Inputs { response_ready: true, ..Inputs::default() }, &job);
        }
    }

    /// Runs a part of a job, then resets at some clock.
    pub fn run_and_reset(&mut self, points: &[u32], clocks: u64, stalls: Stalls) {
        let job = Job::of(points, 40, 0, self.config);
        let mut rest = job.commands.as_slice();
        for _ in 0..clocks {
            let chance = self.random.next_u64();
            let outputs = self.pair.outputs();
            let inputs = stalls.inputs(rest, chance);
            if inputs.command_valid && outputs.command_ready {
                rest = &rest[1..];
            }
            self.step(inputs, &job);
        }
        let length = 1 + self.random.below(3);
        for _ in 0..length {
            let chance = self.random.next_u64();
            let command_valid = chance & 1 == 0;
            let inputs =
                Inputs { reset: true, command_valid, command_data: chance as u32, response_ready: chance & 2 == 0 };
            self.step(inputs, &job);
        }
    }

    fn step(&mut self, inputs: Inputs, job: &Job) {
        if let Err(mismatch) = self.pair.clock(inputs) {
            self.fail(&mismatch, job);
        }
    }

    fn execute(&mut self, job: &Job, stalls: Stalls) -> Vec<u32> {
        let random = &mut self.random;
        match self.pair.run(job, stalls, &mut || random.next_u64()) {
            Ok(answers) => answers,
            Err(mismatch) => self.fail(&mismatch, job),
        }
    }

    fn fail(&self, mismatch: &Mismatch, job: &Job) -> ! {
        let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("{}.vcd", self.name));
        let waveform = match self.pair.leave_waveform(&path) {
            Ok(()) => format!("waveform: {}", path.display()),
            Err(error) => format!("no waveform: {error}"),
        };
        panic!("{}: {mismatch}\n{waveform}\njob {:x?}", self.name, job.commands);
    }

    fn by_commands(&self, job: &Job) -> Vec<u32> {
        let mut model = CommandModel::new(CORE_COORD_BITS, self.config.points, self.config.ring)
            .unwrap_or_else(|error| panic!("{error}"));
        // The model by commands has one context, however many the core has.
        let mut commands = job.commands.clone();
        commands[1] = command_word(Opcode::Clear);
        model.send(&commands);
        let mut answers = vec![0; job.answers + 1];
        let count = model.receive(&mut answers);
        answers.truncate(count);
        answers
    }
}
