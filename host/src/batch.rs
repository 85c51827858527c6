//! Many small jobs: side by side in the memory of a device, or on the threads of this process.
//!
//! A small mesh has no room for many insertions at once, so a device with several contexts gets a group of jobs, a mesh for each context.
//! The words of the next group are sent before the answers of the last are received, so that the device never waits for the host.

use std::sync::atomic::{AtomicUsize, Ordering};

use incircle_protocol::{batch_word, command_word, infinite_vertex, Identity, InsertReport, Layout, Opcode};

use crate::assemble::{check_last_half, checked_record, Assembly};
use crate::cpu::CpuJob;
use crate::error::Error;
use crate::fault::DeviceFault;
use crate::link::{Limit, Link};
use crate::mesh::Mesh;
use crate::options::{Options, Order, Stage};
use crate::point::Point;
use crate::prepare::{prepare, Prepared};
use crate::report::Report;
use crate::session::{tell, Stopwatch};

/// Most points of a job that is one of a group: the records of a group are read at once.
const MAX_JOB_POINTS: usize = 8192;
/// Jobs that a thread takes between two looks at the listener.
const JOBS_PER_LOOK: usize = 64;

/// A job in the order of insertion.
struct Ordered {
    /// Its place in the list of the caller.
    job: usize,
    prepared: Prepared,
}

impl Ordered {
    fn vertices(&self) -> usize {
        self.prepared.order.len()
    }
}

/// Jobs that share the memory, the longest first.
struct Group {
    jobs: Vec<Ordered>,
}

/// A command of a group: its words, and the words of the payload of its answer.
struct Command {
    opcode: Opcode,
    words: Vec<u32>,
    payload: usize,
}

/// Triangles and hull of a job.
type Assembled = (Vec<[u32; 3]>, Vec<u32>);

/// What becomes of the jobs: meshes without their points, in the order of the caller, and those that must go one by one.
pub(crate) struct Done {
    pub(crate) meshes: Vec<Option<Mesh>>,
    pub(crate) singles: Vec<usize>,
}

/// A batch over a link.
pub(crate) struct Batch<'b> {
    pub(crate) identity: Identity,
    /// Contexts that work.
    pub(crate) contexts: u32,
    pub(crate) limit: Limit,
    pub(crate) link: &'b mut Link,
    pub(crate) options: &'b Options<'b>,
    pub(crate) jobs: &'b [Vec<Point>],
}

impl Batch<'_> {
    /// All jobs but those that are too large to share the memory.
    pub(crate) fn run(mut self) -> Result<Done, Error> {
        let mut done = Done { meshes: self.jobs.iter().map(|_| None).collect(), singles: Vec::new() };
        let groups = self.prepare_all(&mut done)?;
        let total = groups.iter().map(|group| group.jobs.iter().map(Ordered::vertices).sum::<usize>()).sum();
        let (mut sent, mut waiting) = (0, None);
        for group in groups {
            if let Err(cancelled) = tell(self.options, Stage::Insert, sent, total) {
                if let Some((group, commands)) = waiting {
                    // The session stays in step.
                    self.finish(group, commands, &mut done.meshes)?;
                }
                return Err(cancelled);
            }
            sent += group.jobs.iter().map(Ordered::vertices).sum::<usize>();
            let commands = self.commands(&group);
            if self.link.takes_ahead() {
                let words = commands.each_ref().map(|command| &command.words[..]).concat();
                self.link.send_ahead(Opcode::Insert, &words, self.limit)?;
            }
            if let Some((before, commands)) = waiting.replace((group, commands)) {
                self.finish(before, commands, &mut done.meshes)?;
            }
        }
        if let Some((last, commands)) = waiting {
            self.finish(last, commands, &mut done.meshes)?;
        }
        tell(self.options, Stage::Insert, total, total)?;
        Ok(done)
    }

    /// Puts all jobs in order, and those that share the memory into groups. What needs no device is answered here.
    fn prepare_all(&self, done: &mut Done) -> Result<Vec<Group>, Error> {
        let total = self.jobs.iter().map(Vec::len).sum();
        let share = (self.identity.capacity / self.contexts) as usize;
        let (mut shared, mut seen) = (Vec::new(), 0);
        for (job, points) in self.jobs.iter().enumerate() {
            if job % JOBS_PER_LOOK == 0 {
                tell(self.options, Stage::Order, seen, total)?;
            }
            seen += points.len();
            let prepared = prepare(points, self.options.order, 1);
            let vertices = prepared.order.len();
            if prepared.collinear && vertices <= self.identity.capacity as usize {
                done.meshes[job] = Some(self.mesh(job, Vec::new(), prepared.order.clone(), prepared));
            } else if prepared.collinear || vertices > share.min(MAX_JOB_POINTS) {
                done.singles.push(job);
            } else {
                shared.push(Ordered { job, prepared });
            }
        }
        // Jobs of one length side by side: none waits long for another.
        shared.sort_by_key(|ordered| std::cmp::Reverse(ordered.vertices()));
        let mut groups = Vec::new();
        let mut rest = shared.into_iter().peekable();
        while rest.peek().is_some() {
            groups.push(Group { jobs: rest.by_ref().take(self.contexts as usize).collect() });
        }
        Ok(groups)
    }

    fn layout(&self) -> Layout {
        Layout::of(self.identity.coord_bits, self.identity.capacity)
    }

    /// `Clear`, `Insert` and the read-out.
    fn commands(&self, group: &Group) -> [Command; 3] {
        let layout = self.layout();
        let points = group.points(self.jobs);
        let mut insert = Vec::with_capacity(2 + points.len() * layout.point_words);
        insert.extend([command_word(Opcode::Insert), points.len() as u32]);
        for point in &points {
            insert.extend_from_slice(&layout.point_to_words(point.x, point.y)[..layout.point_words]);
        }
        let records = group.records();
        let (opcode, payload) = match layout.triangles_words(records as u32) {
            Some(words) if self.link.packs_records() => (Opcode::Triangles, words as usize),
            _ => (Opcode::Read, records * layout.record_words),
        };
        [
            Command { opcode: Opcode::Clear, words: vec![batch_word(group.jobs.len() as u32)], payload: 0 },
            Command { opcode: Opcode::Insert, words: insert, payload: incircle_protocol::INSERT_REPORT_WORDS },
            Command { opcode, words: vec![command_word(opcode), 0, records as u32], payload },
        ]
    }

    /// Receives the answers of a group and makes its meshes.
    fn finish(&mut self, group: Group, commands: [Command; 3], meshes: &mut [Option<Mesh>]) -> Result<(), Error> {
        let is_sent = self.link.takes_ahead();
        let sent = (commands[1].words.len() - 2) / self.layout().point_words;
        let mut answer = Vec::new();
        for Command { opcode, words, payload } in commands {
            if !is_sent {
                self.link.send_ahead(opcode, &words, self.limit)?;
            }
            answer.clear();
            answer.resize(payload, 0);
            self.link.receive_answer(opcode, &mut answer, self.limit)?;
            if let (Opcode::Insert, Ok(report)) = (opcode, <[u32; 5]>::try_from(&answer[..])) {
                let checked = group.check_report(&InsertReport::from_words(report), sent);
                checked.map_err(|fault| self.link.distrust(opcode, fault))?;
            }
        }
        let opcode = if self.link.packs_records() { Opcode::Triangles } else { Opcode::Read };
        let assembled = self.assemble(&group, sent, &answer).map_err(|fault| self.link.distrust(opcode, fault))?;
        for (ordered, (triangles, hull)) in group.jobs.into_iter().zip(assembled) {
            meshes[ordered.job] = Some(self.mesh(ordered.job, triangles, hull, ordered.prepared));
        }
        Ok(())
    }

    /// The triangles and the hull of each job from the records of all.
    fn assemble(&self, group: &Group, sent: usize, words: &[u32]) -> Result<Vec<Assembled>, DeviceFault> {
        let (layout, capacity, records) = (self.layout(), self.identity.capacity, group.records());
        let assembly = |ordered| {
            let Ordered { job, prepared }: &Ordered = ordered;
            Assembly::new(&prepared.order, &self.jobs[*job], layout, capacity)
        };
        let mut assemblies: Vec<Assembly<'_>> = group.jobs.iter().map(assembly).collect();
        let is_packed = self.link.packs_records();
        for record in 0..records {
            let v = if is_packed {
                layout.vertices_from_words(words, record)
            } else {
                let width = layout.record_words;
                checked_record(layout, record, &words[record * width..][..width], records)?
            };
            let (job, [a, b, c]) = group.own_vertices(record, v, sent, infinite_vertex(capacity))?;
            assemblies[job].take_vertices(record, a, b, c)?;
        }
        if is_packed {
            check_last_half(layout, 0, records, words)?;
        }
        assemblies.into_iter().map(Assembly::finish).collect()
    }

    /// Everything but the points.
    fn mesh(&self, job: usize, triangles: Vec<[u32; 3]>, hull: Vec<u32>, prepared: Prepared) -> Mesh {
        let report = Report {
            points: self.jobs[job].len(),
            distinct: self.jobs[job].len() - prepared.duplicates.len(),
            duplicates: prepared.duplicates.len(),
            triangles: triangles.len(),
            hull: hull.len(),
            collinear: prepared.collinear,
            backend: self.link.name(),
            order: self.options.order.name(),
            coord_bits: self.identity.coord_bits,
            capacity: self.identity.capacity,
            contexts: 1,
            ..Report::default()
        };
        Mesh { points: Vec::new(), triangles, hull, duplicates: prepared.duplicates, report }
    }
}

impl Group {
    /// Records of all jobs.
    fn records(&self) -> usize {
        self.jobs.iter().map(|ordered| 2 * ordered.vertices() - 2).sum()
    }

    /// The points in the order in which they are sent: three of each job, then one of each in turn. A job that has no more repeats its last
    /// one, which is found at once, until the longest is over.
    fn points(&self, jobs: &[Vec<Point>]) -> Vec<Point> {
        let at = |ordered: &Ordered, index: u32| jobs[ordered.job][index as usize];
        let first = self
            .jobs
            .iter()
            .flat_map(|ordered| ordered.prepared.order[..3].iter().map(move |&index| at(ordered, index)));
        let mut points: Vec<Point> = first.collect();
        let longest = self.jobs.iter().map(Ordered::vertices).max().unwrap_or(0);
        // The jobs stand in the order of their lengths, so the last round ends with the last of the longest.
        let last_round = self.jobs.iter().take_while(|ordered| ordered.vertices() == longest).count();
        for place in 3..longest {
            let takers = if place + 1 == longest { last_round } else { self.jobs.len() };
            points.extend(self.jobs[..takers].iter().filter_map(|ordered| {
                let order = &ordered.prepared.order;
                order.get(place).or(order.last()).map(|&index| at(ordered, index))
            }));
        }
        points
    }

    /// All points must be in, and those that were repeated are duplicates.
    fn check_report(&self, report: &InsertReport, sent: usize) -> Result<(), DeviceFault> {
        let vertices: usize = self.jobs.iter().map(Ordered::vertices).sum();
        let counts = [
            ("points arrived", report.arrived, sent),
            ("points inserted", report.inserted, vertices),
            ("duplicates", report.duplicates, sent - vertices),
            ("points refused", report.refused, 0),
            ("records", report.records, self.records()),
        ];
        match counts.into_iter().find(|&(_, found, expected)| found as usize != expected) {
            Some((what, found, expected)) => Err(DeviceFault::Count { what, found, expected: expected as u32 }),
            None => Ok(()),
        }
    }

    /// The job that a record belongs to, and its vertices as that job counts them.
    fn own_vertices(
        &self,
        record: usize,
        v: [u32; 3],
        sent: usize,
        infinite: u32,
    ) -> Result<(usize, [u32; 3]), DeviceFault> {
        let (count, mut owner) = (self.jobs.len() as u32, None);
        let mut own = v;
        for (vertex, own) in v.into_iter().zip(&mut own).filter(|(vertex, _)| *vertex != infinite) {
            if vertex as usize >= sent {
                return Err(DeviceFault::VertexOutOfRange { record, vertex, points: sent });
            }
            let (job, place) = match vertex.checked_sub(3 * count) {
                None => (vertex / 3, vertex % 3),
                Some(dealt) => (dealt % count, 3 + dealt / count),
            };
            *own = place;
            if owner.replace(job).is_some_and(|other| other != job) {
                return Err(DeviceFault::MixedJobs { record, vertices: v });
            }
        }
        match owner {
            Some(job) => Ok((job as usize, own)),
            None => Err(DeviceFault::RepeatedVertex { record }),
        }
    }
}

/// Jobs side by side on the threads of this process, each by one thread. Large jobs are left to all threads together.
pub(crate) fn on_threads(
    jobs: &[Vec<Point>],
    threads: u32,
    options: &Options<'_>,
    limit: Limit,
) -> Result<Done, Error> {
    let total = jobs.iter().map(Vec::len).sum();
    let mut done = Done { meshes: jobs.iter().map(|_| None).collect(), singles: Vec::new() };
    let (small, large) = (0..jobs.len()).partition(|&job: &usize| jobs[job].len() <= MAX_JOB_POINTS);
    done.singles = large;
    let small: Vec<usize> = small;
    let (order, mut seen) = (options.order, 0);
    for look in small.chunks(JOBS_PER_LOOK * threads as usize) {
        tell(options, Stage::Insert, seen, total)?;
        let taken = AtomicUsize::new(0);
        let work = || take_jobs(jobs, look, &taken, order, limit);
        let results = std::thread::scope(|scope| {
            let others: Vec<_> = (1..threads).map(|_| scope.spawn(work)).collect();
            let mut results = work();
            for other in others {
                match other.join() {
                    Ok(own) => results.extend(own),
                    Err(panic) => std::panic::resume_unwind(panic),
                }
            }
            results
        });
        for (job, mesh) in results {
            done.meshes[job] = Some(mesh?);
            seen += jobs[job].len();
        }
    }
    tell(options, Stage::Insert, total, total)?;
    Ok(done)
}

/// What a thread does: the next of these jobs that nobody has taken, until there is none.
fn take_jobs(
    jobs: &[Vec<Point>],
    look: &[usize],
    taken: &AtomicUsize,
    order: Order,
    limit: Limit,
) -> Vec<(usize, Result<Mesh, Error>)> {
    let options = Options { order, ..Options::default() };
    let mut own = Vec::new();
    while let Some(&job) = look.get(taken.fetch_add(1, Ordering::Relaxed)) {
        let watch = Stopwatch::start();
        own.push((job, CpuJob { points: &jobs[job], contexts: 1, options: &options, limit, watch }.run()));
    }
    own
}
