//! The back end of every device that takes commands.

use incircle_protocol::{Clear, Command, Identity, Opcode};

use super::backend::{Backend, JobLeft, Terms, Together};
use crate::commands::{Came, CommandChannel};
use crate::error::{DeviceFault, Error};
use crate::job::answer::Answer;
use crate::job::batch::Batch;
use crate::job::flight::{Carrier, Done};
use crate::job::group::{Group, Ordered};
use crate::job::load::Load;
use crate::job::prepare::prepare;
use crate::job::watch::{tell, Stopwatch};
use crate::job::{Solution, Stage};
use crate::limit::Limit;
use crate::transports::Transport;
use incircle_geometry::Point;

/// A device behind a transport.
pub(crate) struct DeviceBackend {
    channel: CommandChannel,
    /// The tag of the mesh that lives on the device.
    living_tag: u8,
}

impl DeviceBackend {
    pub(crate) fn new(transport: Box<dyn Transport>) -> Self {
        Self { channel: CommandChannel::new(transport), living_tag: 0 }
    }

    fn carrier<'c>(&'c mut self, jobs: &'c [Vec<Point>], terms: &Terms<'c>) -> Carrier<'c> {
        let &Terms { identity, limit, shares_limit, options, .. } = terms;
        Carrier { identity, channel: &mut self.channel, options, limit, shares_limit, watch: Stopwatch::start(), jobs }
    }

    /// Does a single job, which has the whole memory, step by step.
    fn solve(&mut self, jobs: &[Vec<Point>; 1], terms: &Terms<'_>) -> Result<Option<Answer>, Error> {
        let ([points], contexts) = (jobs, terms.contexts);
        let (capabilities, layout) = (self.channel.capabilities(), self.channel.layout());
        let mut carrier = self.carrier(jobs, terms);
        let mut done = Done::nothing_of(jobs);
        tell(terms.options, Stage::Order, 0, points.len())?;
        let ordered = Ordered { job: 0, prepared: prepare(points, terms.options.order, contexts) };
        carrier.watch.ended(Stage::Order);
        let ordered = carrier.answer_here(ordered, contexts, &mut done);
        let mut load = ordered.map(|ordered| {
            let group = Group::alone(ordered, contexts);
            let form = carrier.read_form(&group);
            Load::step_by_step(group, form, terms.options, capabilities, layout)
        });
        carrier.carry(&mut done, |_, _| Ok(load.take())).map_err(|failed| failed.error)?;
        Ok(done.answers.pop().flatten())
    }
}

impl Backend for DeviceBackend {
    fn name(&self) -> String {
        self.channel.name()
    }

    fn greet(&mut self, limit: Limit) -> Result<Identity, Error> {
        match self.channel.hello(limit) {
            Err(error) if self.channel.recover(&error, limit)? => self.channel.hello(limit),
            result => result,
        }
    }

    fn slow(&self) -> u32 {
        self.channel.capabilities().pace.slow
    }

    fn clocks(&self) -> Option<u64> {
        self.channel.clocks().map(|clocks| clocks.now)
    }

    fn triangulate(&mut self, points: Vec<Point>, terms: Terms<'_>) -> Result<Solution, Error> {
        let jobs = [points];
        let answer = self.solve(&jobs, &terms)?;
        let [points] = jobs;
        let solution = answer.map(|answer| answer.with(points));
        // `carry` returns without an error only when every job has its answer, so this error is never returned. If that
        // rule were broken, the session could not be trusted any more, and this error says so without a panic.
        solution.ok_or_else(|| Error::OutOfStep { device: self.name() })
    }

    fn triangulate_together(&mut self, jobs: Vec<Vec<Point>>, terms: Terms<'_>) -> Result<Together, Error> {
        let batch = Batch::new(self.carrier(&jobs, &terms), terms.contexts);
        let (done, contexts) = batch.run().map_err(|failed| failed.in_batch())?;
        let mut together = Together { solutions: Vec::with_capacity(jobs.len()), left: Vec::new() };
        for (job, ((points, answer), contexts)) in jobs.into_iter().zip(done.answers).zip(contexts).enumerate() {
            match answer {
                Some(answer) => together.solutions.push(Some(answer.with(points))),
                None => {
                    together.solutions.push(None);
                    together.left.push(JobLeft { job, points, contexts: contexts.unwrap_or(terms.contexts) });
                }
            }
        }
        Ok(together)
    }

    fn exchange(&mut self, command: Command<&[u32]>, payload: &mut Vec<u32>, limit: Limit) -> Result<(), Error> {
        let command = match command {
            Command::Clear(clear) => {
                self.living_tag = self.channel.new_tag();
                Command::Clear(Clear { tag: self.living_tag, ..clear })
            }
            command => command,
        };
        self.channel.submit(self.living_tag, &[command], limit)?;
        match self.channel.receive(self.living_tag, &command, payload, limit)? {
            Came::Whole => Ok(()),
            Came::Stuck(_) => Err(self.channel.distrust(command.opcode(), DeviceFault::AllStuck { engines: 1 })),
        }
    }

    fn run_words(&self) -> usize {
        self.channel.capabilities().run_words
    }

    fn repeats(&self) -> u64 {
        self.channel.repeats()
    }

    fn distrust(&mut self, opcode: Opcode, fault: DeviceFault) -> Error {
        self.channel.distrust(opcode, fault)
    }
}
