//! Drives a stream of commands through the core and its model, with idle clocks and back-pressure.

use super::report::Mismatch;
use super::Lockstep;
use incircle_model::Inputs;
use incircle_protocol::{batch_word, clear_word, command_word, Clear, Config, Meshes, Opcode, ShortIds, PADDING};

/// Frequency of stalls on each side of the core.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stalls {
    /// The host offers no word in this many of 256 clocks.
    pub idle: u8,
    /// The host takes no answer in this many of 256 clocks.
    pub back_pressure: u8,
}

impl Stalls {
    /// No stalls on either side.
    pub const NONE: Self = Self { idle: 0, back_pressure: 0 };
    /// Every combination of three frequencies on each side.
    pub const ALL: [Self; 9] = {
        let rates = [0, 64, 230];
        let mut all = [Self::NONE; 9];
        let mut k = 0;
        while k < 9 {
            all[k] = Self { idle: rates[k / 3], back_pressure: rates[k % 3] };
            k += 1;
        }
        all
    };

    /// Inputs of a clock, by a random number: the host offers the next of `words` or idles, and takes an answer or not.
    pub fn inputs(self, words: &[u32], chance: u64) -> Inputs {
        let is_idle = (chance & 0xff) < u64::from(self.idle);
        let offered = words.first().filter(|_| !is_idle);
        Inputs {
            reset: false,
            command_valid: offered.is_some(),
            // The data of an idle clock must not matter, so it is random.
            command_data: offered.copied().unwrap_or((chance >> 32) as u32),
            response_ready: (chance >> 8 & 0xff) >= u64::from(self.back_pressure),
        }
    }
}

/// A stream of commands with everything that a job does, and the number of answer words.
#[derive(Clone, Debug)]
pub struct Job {
    /// Words of the commands.
    pub commands: Vec<u32>,
    /// Number of answer words that the commands lead to.
    pub answers: usize,
}

impl Job {
    /// Makes a job that clears, inserts the points in pieces of the given length with this many contexts (0 for all),
    /// and reads all triangles, all records, latencies and counters, with padding between the commands. The model by
    /// commands tells the number of answer words.
    pub fn of(points: &[u32], piece: usize, contexts: u32, config: Config) -> Self {
        let mut job = Self::beginning_with(command_word(Opcode::Clear), points, piece, config);
        // The model by commands inserts one point after another, however many contexts the core has.
        job.commands[1] = clear_word(contexts);
        job
    }

    /// Makes such a job for a batch of this many jobs (0 for as many as the core has contexts).
    pub fn batch_of(points: &[u32], piece: usize, jobs: u32, config: Config) -> Self {
        Self::beginning_with(batch_word(jobs), points, piece, config)
    }

    /// Makes such a job for a batch of `jobs` jobs that share `contexts` contexts.
    pub fn teams_of(points: &[u32], piece: usize, [contexts, jobs]: [u32; 2], config: Config) -> Self {
        let clear = Clear { contexts, meshes: Meshes::SideBySide(jobs), tag: 0 };
        Self::beginning_with(clear.word(), points, piece, config)
    }

    fn beginning_with(clear: u32, points: &[u32], piece: usize, config: Config) -> Self {
        let mut model =
            incircle_model::CommandModel::new(incircle_protocol::CORE_COORD_BITS, config.points, config.ring)
                .unwrap_or_else(|error| panic!("{error}"))
                .with_contexts(config.contexts);
        let mut commands = vec![command_word(Opcode::Hello), clear];
        for piece in points.chunks(piece.max(1)) {
            commands.extend([command_word(Opcode::Insert), piece.len() as u32]);
            commands.extend(piece);
        }
        model.send(&commands);
        let records = model.mesh().records().len() as u32;
        let [read, triangles, latencies, counters] =
            [Opcode::Read, Opcode::Triangles, Opcode::Latencies, Opcode::Counters].map(command_word);
        let short = [ShortIds::Ten, ShortIds::Twelve].map(|ids| triangles | ids.word_bits());
        let rest = [
            [triangles, 0, records, PADDING],
            [short[0], 0, records, PADDING],
            [short[1], 0, records, PADDING],
            [read, 0, records, PADDING],
            [PADDING, latencies, counters, PADDING],
        ]
        .concat();
        commands.extend(&rest);
        model.send(&rest);
        let mut answers = 0;
        let mut buffer = [0; 1024];
        loop {
            match model.receive(&mut buffer) {
                0 => break,
                some => answers += some,
            }
        }
        Self { commands, answers }
    }
}

impl Lockstep {
    /// Runs a job to its last answer word, and returns all answer words.
    ///
    /// # Errors
    /// The first mismatch between core and model.
    ///
    /// # Panics
    /// Panics if the job takes more clocks than any job of its size can.
    pub fn run(&mut self, job: &Job, stalls: Stalls, random: &mut impl FnMut() -> u64) -> Result<Vec<u32>, Mismatch> {
        let mut answers = Vec::with_capacity(job.answers);
        let mut rest = job.commands.as_slice();
        let limit = self.clocks + 1_000_000 + 40_000 * job.commands.len() as u64;
        while !rest.is_empty() || answers.len() < job.answers {
            let chance = random();
            let outputs = self.outputs();
            let inputs = stalls.inputs(rest, chance);
            if inputs.response_ready && outputs.response_valid {
                answers.extend(outputs.answer_words());
            }
            if inputs.command_valid && outputs.command_ready {
                rest = &rest[1..];
            }
            self.clock(inputs)?;
            assert!(self.clocks < limit, "no end after {} clocks: a hang that core and model share", self.clocks);
        }
        Ok(answers)
    }
}
