//! A group with the commands that it takes, and the meshes that are made of the answers.

use std::ops::Range;
use std::time::Duration;

use incircle_protocol::{infinite_vertex, Clear, Command, Layout};

use super::assemble::{checked_record, Assembly};
use super::group::{Group, Ordered};
use super::options::{Options, Stage};
use super::read_form::ReadForm;
use crate::error::DeviceFault;
use crate::transports::Capabilities;
use incircle_geometry::Point;

/// Most records of one `Read` or `Triangles` command of a job that goes step by step: 384 kB at most. A slow link gets
/// fewer at a time.
const READ_CHUNK: usize = 16_384;
/// Fewest points of an `Insert` command: its report can be checked only once the first triangle is there.
const MIN_INSERT_CHUNK: usize = 3;

/// A step of a load: a command, or the end of a stage.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Step {
    /// Empties the memory of the device.
    Clear,
    /// Inserts a range of the points that are sent.
    Insert(Range<usize>),
    /// Reads a range of the records.
    Read(Range<usize>),
    /// Reads the event counters.
    Counters,
    /// Reads the histogram of latencies.
    Latencies,
    /// Ends a stage, for the listener and the stopwatch. There is no command.
    Ended(Stage),
}

/// A group with the steps that it takes.
pub(crate) struct Load {
    pub(crate) group: Group,
    pub(crate) steps: Vec<Step>,
    /// The form in which its records are read.
    pub(crate) form: ReadForm,
    /// Whether the commands go one by one, so that a listener hears the progress between them.
    pub(crate) is_step_by_step: bool,
    /// The time of this load, if it does not share the limit of all.
    pub(crate) time: Option<Duration>,
    /// Tag of the job on the device, from its sending on.
    pub(crate) tag: u8,
    /// Engines that got stuck over this load.
    pub(crate) stuck_engines: Vec<u32>,
}

/// Triangles and hull of a job.
pub(crate) type Assembled = (Vec<[u32; 3]>, Vec<u32>);

impl Load {
    /// A load with one command for all points and one for all records, so that all commands may be sent ahead. The
    /// counters of a job that has the whole memory are read before its mesh, so that the load ends with the mesh.
    pub(crate) fn at_once(group: Group, form: ReadForm, time: Option<Duration>) -> Self {
        let mut steps = vec![Step::Clear, Step::Insert(0..group.sent())];
        if !group.is_shared {
            steps.push(Step::Counters);
        }
        steps.push(Step::Read(0..group.records()));
        Self { group, steps, form, is_step_by_step: false, time, tag: 0, stuck_engines: Vec::new() }
    }

    /// A load whose points and records go in pieces, with progress told between them.
    pub(crate) fn step_by_step(
        group: Group,
        form: ReadForm,
        options: &Options<'_>,
        capabilities: Capabilities,
        layout: Layout,
    ) -> Self {
        let pace = capabilities.pace;
        let points = pace.chunk(options.insert_chunk.max(MIN_INSERT_CHUNK), layout.point_words);
        let one = form.command::<()>(0..1).payload_words(layout);
        let records = pace.chunk(READ_CHUNK, one as usize);
        let mut steps = vec![Step::Clear];
        steps.extend(pieces(group.sent(), points).map(Step::Insert));
        steps.push(Step::Ended(Stage::Insert));
        steps.extend(pieces(group.records(), records).map(Step::Read));
        steps.extend([Step::Ended(Stage::Read), Step::Counters, Step::Latencies]);
        Self { group, steps, form, is_step_by_step: true, time: None, tag: 0, stuck_engines: Vec::new() }
    }

    /// The command of a step, if it has one. The words of its points are appended to `words`, and the command
    /// has their range there.
    pub(crate) fn command(
        &self,
        step: &Step,
        jobs: &[Vec<Point>],
        layout: Layout,
        words: &mut Vec<u32>,
    ) -> Option<Command<Range<usize>>> {
        let command = self.bare_command(step)?;
        Some(command.map(|range| {
            let begin = words.len();
            words.reserve(range.len() * layout.point_words);
            self.group.for_points(jobs, range, |point| {
                words.extend_from_slice(&layout.point_to_words(point.x, point.y)[..layout.point_words]);
            });
            begin..words.len()
        }))
    }

    /// The `Clear` of the group, without its tag. A batch with a context for each job is told without the number of
    /// jobs, which a device of version 1.2 does not know.
    fn clear(&self) -> Clear {
        let Group { jobs, contexts, is_shared } = &self.group;
        let jobs = jobs.len() as u32;
        match (is_shared, contexts) {
            (false, _) => Clear::one_mesh(*contexts),
            (true, 1) => Clear::batch(jobs),
            (true, _) => {
                Clear { contexts: jobs * contexts, meshes: incircle_protocol::Meshes::SideBySide(jobs), tag: 0 }
            }
        }
    }

    /// The command of a step, if it has one, with its range of the points that are sent.
    pub(crate) fn bare_command(&self, step: &Step) -> Option<Command<Range<usize>>> {
        Some(match step {
            Step::Clear => Command::Clear(Clear { tag: self.tag, ..self.clear() }),
            Step::Insert(points) => Command::Insert { count: points.len() as u32, points: points.clone() },
            Step::Read(records) => self.form.command(records.clone()),
            Step::Counters => Command::Counters,
            Step::Latencies => Command::Latencies,
            Step::Ended(_) => return None,
        })
    }
}

/// Ranges of at most `most` items that together are `0..all`.
fn pieces(all: usize, most: usize) -> impl Iterator<Item = Range<usize>> {
    (0..all).step_by(most).map(move |start| start..all.min(start + most))
}

/// Makes the meshes of a group from its records.
pub(crate) struct Meshes<'a> {
    group: &'a Group,
    layout: Layout,
    capacity: u32,
    form: ReadForm,
    assemblies: Vec<Assembly<'a>>,
}

impl<'a> Meshes<'a> {
    pub(crate) fn new(group: &'a Group, jobs: &'a [Vec<Point>], capacity: u32, form: ReadForm, layout: Layout) -> Self {
        let assembly = |ordered: &'a Ordered| Assembly::new(&ordered.prepared.order, &jobs[ordered.job], capacity);
        let assemblies = group.jobs.iter().map(assembly).collect();
        Self { group, layout, capacity, form, assemblies }
    }

    /// Takes the words of a range of records.
    pub(crate) fn take(&mut self, records: &Range<usize>, words: &[u32]) -> Result<(), DeviceFault> {
        let form = self.form;
        if form != ReadForm::Whole {
            for (place, record) in records.clone().enumerate() {
                let vertices = form.vertices(self.layout, self.capacity, words, records.len(), place);
                self.take_vertices(record, vertices)?;
            }
            return form.check_spare(self.layout, records, words);
        }
        let all = self.group.records();
        for (record, words) in records.clone().zip(words.chunks_exact(self.layout.record_words)) {
            self.take_vertices(record, checked_record(self.layout, record, words, all)?)?;
        }
        Ok(())
    }

    fn take_vertices(&mut self, record: usize, v: [u32; 3]) -> Result<(), DeviceFault> {
        if let [only] = &mut self.assemblies[..] {
            return only.take_vertices(record, v);
        }
        let (job, own) = self.group.own_vertices(record, v, self.group.sent(), infinite_vertex(self.capacity))?;
        self.assemblies[job].take_vertices(record, own)
    }

    /// The triangles and the hull of each job, after all records were taken.
    pub(crate) fn finish(self) -> Result<Vec<Assembled>, DeviceFault> {
        self.assemblies.into_iter().map(Assembly::finish).collect()
    }
}
