//! The model of a chip, clock by clock: several engines between one stream of commands and one of answers.
//!
//! A chip of one engine is that engine and nothing else. Otherwise a router gives each job to an engine that is free, a
//! queue of command words stands before each engine, and a collector brings the answers together, each of them whole.
//! As in [`ClockModel`], an edge computes the next state of all parts from the registers as they were.

mod collector;
mod places;
mod queue;
mod router;

use crate::clock::{ClockModel, Defect, Inputs, Outputs, Write};
use collector::{Collector, Offers};
use incircle_protocol::{Config, ConfigError};
use places::MOST;
use queue::CommandQueue;
use router::{JobRouter, Sight};

/// The state of a chip at a clock.
#[derive(Clone, Debug)]
pub struct ChipModel {
    engines: Vec<ClockModel>,
    /// Number of commands of each engine that are not answered to their end.
    owed: [u32; MOST],
    queues: [CommandQueue; MOST],
    router: JobRouter,
    collector: Collector,
}

impl ChipModel {
    /// The chip of a configuration, as it is after a clock with reset.
    ///
    /// # Errors
    /// A parameter that no chip can be built with.
    pub fn new(config: Config) -> Result<Self, ConfigError> {
        let config = config.check()?;
        let engines = (0..config.engines as u8).map(|engine| ClockModel::numbered(config, engine));
        Ok(Self {
            engines: engines.collect::<Result<_, _>>()?,
            owed: [0; MOST],
            queues: Default::default(),
            router: JobRouter::default(),
            collector: Collector::default(),
        })
    }

    /// The same chip with an engine that lacks one of its rules. A number that no engine has changes nothing.
    #[must_use]
    pub fn with_defect(mut self, engine: usize, defect: Defect) -> Self {
        if let Some(model) = self.engines.get_mut(engine) {
            *model = model.clone().with_defect(defect);
        }
        self
    }

    /// Whether a command word waits for an engine of several, or one of them owes an answer; `false` on a chip of one
    /// engine.
    pub(crate) fn is_at_work(&self) -> bool {
        self.owed.iter().any(|&owed| owed > 0) || !self.router.is_ready()
    }

    /// The same chip with the commands for a mesh that stands, the runs, if it is a single engine. A chip of several
    /// has none: it has no one mesh that stands.
    #[must_use]
    pub fn with_runs(mut self) -> Self {
        if let [only] = &mut self.engines[..] {
            *only = only.clone().with_runs();
        }
        self
    }

    /// The same chip with runs as the hardware does them, clock by clock, if it is a single engine. Its identity offers
    /// these.
    #[must_use]
    pub fn with_core_runs(mut self) -> Self {
        if let [only] = &mut self.engines[..] {
            *only = only.clone().with_core_runs();
        }
        self
    }

    /// The outputs in the current state, with the write port of engine 0.
    pub fn outputs(&self) -> Outputs {
        if let [only] = &self.engines[..] {
            return only.outputs();
        }
        let offers = self.offers();
        Outputs { command_ready: self.router.is_ready(), write: self.write(0), ..self.collector.outputs(&offers) }
    }

    /// The write port of the triangle memory of an engine; nothing for a number that no engine has.
    pub fn write(&self, engine: usize) -> Write {
        self.engines.get(engine).map_or_else(Write::default, |engine| engine.outputs().write)
    }

    /// The state of the chip in a few lines, for readers of a report of a mismatch.
    pub fn describe(&self) -> String {
        let engines: Vec<String> = self.engines.iter().map(ClockModel::describe).collect();
        match &engines[..] {
            [only] => only.clone(),
            all => {
                let between = format!("{:?}, owed {:?}, {:?}", self.router, self.owed, self.collector);
                format!("{}; between: {between}", all.join("; "))
            }
        }
    }

    /// The outputs of the engines. A place without an engine offers nothing.
    fn offers(&self) -> Offers {
        let mut offers = [Outputs::default(); MOST];
        for (place, engine) in offers.iter_mut().zip(&self.engines) {
            *place = engine.outputs();
        }
        offers
    }

    /// Simulates one rising edge.
    ///
    /// # Panics
    /// As [`ClockModel::clock`] does.
    pub fn clock(&mut self, inputs: Inputs) {
        if let [only] = &mut self.engines[..] {
            return only.clock(inputs);
        }
        let offers = self.offers();
        let count = self.engines.len();
        let sight = Sight {
            is_free: std::array::from_fn(|engine| engine < count && self.owed[engine] == 0),
            is_stuck: std::array::from_fn(|engine| engine >= count || self.collector.is_stuck(engine)),
            has_room: self.queues.each_ref().map(CommandQueue::has_room),
        };
        let push = self.router.push(&sight);
        let takes = self.collector.takes(&offers, inputs.response_ready);
        let ended = takes.filter(|&engine| offers[engine].response_last);
        for (engine, model) in self.engines.iter_mut().enumerate() {
            let pushed = push.filter(|push| push.engine == engine);
            let word = self.queues[engine].offered();
            let is_taken = word.is_some() && offers[engine].command_ready;
            model.clock(Inputs {
                reset: inputs.reset,
                command_valid: word.is_some(),
                command_data: word.unwrap_or(0),
                response_ready: self.collector.is_chosen(engine) && inputs.response_ready,
            });
            self.queues[engine].clock(pushed.map(|push| push.word), is_taken);
            self.owed[engine] += u32::from(pushed.is_some_and(|push| push.begins));
            self.owed[engine] -= u32::from(ended == Some(engine));
        }
        self.router.clock(&sight, inputs.command_valid.then_some(inputs.command_data));
        self.collector.clock(&offers, takes);
        if inputs.reset {
            self.owed = [0; MOST];
            self.queues = Default::default();
            self.router = JobRouter::default();
            self.collector = Collector::default();
        }
    }
}
