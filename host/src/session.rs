//! A session: exclusive use of a greeted device.

use std::time::{Duration, Instant};

use incircle_protocol::{command_word, Identity, InsertReport, Layout, Opcode};

use crate::assemble::Assembly;
use crate::batch::{on_threads, points_of, Batch, Done, PartListener, Single};
use crate::counters::Latencies;
use crate::cpu::{CpuJob, CPU_NAME};
use crate::error::Error;
use crate::fault::DeviceFault;
use crate::link::{Limit, Link};
use crate::options::{Options, Progress, Stage};
use crate::prepare::{prepare, Prepared};
use crate::report::Report;
use crate::solution::Solution;
use incircle_geometry::pages;
use incircle_geometry::{Mesh, Point, MAX_POINTS};

/// Records of one `Read` or `Triangles` command: 384 kB at most. A slow link takes fewer.
const READ_CHUNK: usize = 16_384;
/// Fewest points of an `Insert` command: the device can judge its report only after the first triangle.
const MIN_INSERT_CHUNK: usize = 3;

/// Exclusive use of a device that has been greeted and checked.
pub struct Session<'d> {
    /// `None`: the engine in this process.
    link: Option<&'d mut Link>,
    identity: Identity,
}

impl<'d> Session<'d> {
    pub(crate) fn new(link: &'d mut Link, identity: Identity) -> Self {
        Self { link: Some(link), identity }
    }

    /// Use of the engine in this process.
    pub(crate) fn of_cpu(identity: Identity) -> Self {
        Self { link: None, identity }
    }

    /// What the device says of itself, checked.
    pub fn identity(&self) -> &Identity {
        &self.identity
    }

    /// Triangulates with the default [`Options`].
    ///
    /// # Errors
    /// As [`Session::triangulate_with`].
    pub fn triangulate<P: Into<Point> + Copy>(&mut self, points: &[P]) -> Result<Solution, Error> {
        let mut own = pages::with_room(points.len());
        own.extend(points.iter().map(|&point| -> Point { point.into() }));
        self.triangulate_owned(own, &Options::default())
    }

    /// Triangulates: the Delaunay triangulation of the distinct points, in canonical form.
    ///
    /// Duplicates collapse onto their lowest index and are listed. Fewer than three distinct points, or points on one
    /// line, are answered by the host alone. O(n log n) on the device in the mean, O(n) on the host. At a million points
    /// of 16 bits the peak is below 200 bytes per point, the engine or the software model and the mesh included, the caller's points not.
    ///
    /// # Errors
    /// A coordinate beyond the device's bits, more contexts than it has, more distinct points than it holds, a failing link, an answer that no
    /// sound device gives, a passed deadline, or a cancelled job. After an error of link or device, or a deadline that passed while
    /// the device worked, the session is out of step: open the device again. After all others it can be used again.
    pub fn triangulate_with(&mut self, points: &[Point], options: &Options<'_>) -> Result<Solution, Error> {
        let mut own = pages::with_room(points.len());
        own.extend_from_slice(points);
        self.triangulate_owned(own, options)
    }

    /// Triangulates many sets in one call: the mesh of each is that of [`Session::triangulate_with`], byte for byte but for its
    /// report: a job that a device does with others, or ahead of another, has no times, and counters only where it had the whole memory.
    ///
    /// A device works on several jobs side by side in one memory: as many as it has contexts, if so many fit; [`Options::contexts`] says how
    /// many at most. Jobs so large that only few fit, or that are left over, are done one by one, each with as many contexts as pay:
    /// whatever is expected to take the device the fewest clocks. Where the link takes words ahead, those of the next
    /// job are on their way, and the one behind it is put in order in a thread, while the device works on the last and its mesh is assembled:
    /// three jobs are held in order at once. The engine in this process works on a job with each thread.
    ///
    /// [`Options::insert_chunk`] is used only where a job has more than 65,536 points, or the link takes nothing ahead. The time of
    /// [`Options::timeout`] is for all jobs that share the memory together, and for each of the others; a job that is sent ahead lends its own to
    /// the one before it. Progress is told in points of all jobs, duplicates included, and never goes back: first [`Stage::Order`] of those that
    /// share the memory, then [`Stage::Insert`]. What has been sent when a listener cancels is still answered, so the session stays in step.
    ///
    /// ```
    /// use incircle::{Device, Options, Point};
    ///
    /// let job = |seed: u32| (0..50).map(|k| Point::new(k * (seed + 7) % 83, k * k % 89)).collect::<Vec<_>>();
    /// let jobs = [job(1), job(2), job(3)];
    /// let mut device = Device::open("clock?config=small")?;
    /// let mut session = device.session()?;
    /// let meshes = session.triangulate_batch(&jobs, &Options::default())?;
    /// assert_eq!(meshes[2].triangles, session.triangulate(&jobs[2])?.triangles);
    /// # Ok::<(), incircle::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`Session::triangulate_with`], with the number of the job where one is at fault. There are no meshes then.
    pub fn triangulate_batch(&mut self, jobs: &[Vec<Point>], options: &Options<'_>) -> Result<Vec<Solution>, Error> {
        let slow = self.link.as_ref().map_or(1, |link| link.pace().slow);
        let total = points_of(jobs);
        let default = || Options::default_timeout(total).saturating_mul(slow);
        let limit = Limit::of(options.timeout.unwrap_or_else(default));
        let identity = self.identity;
        let contexts = options.contexts.unwrap_or(identity.contexts);
        let name = self.link.as_ref().map_or_else(|| CPU_NAME.to_owned(), |link| link.name());
        let in_job = |job: usize| move |source| Error::InJob { job, source: Box::new(source) };
        check_input(&[], contexts, &identity, name.clone())?;
        for (job, points) in jobs.iter().enumerate() {
            check_input(points, contexts, &identity, name.clone()).map_err(in_job(job))?;
        }
        let Done { mut meshes, singles, mut passed } = match &mut self.link {
            None => on_threads(jobs, contexts, options, limit)?,
            Some(link) => Batch { identity, contexts, limit, link, options, jobs }.run()?,
        };
        for Single { job, contexts } in singles {
            let part = PartListener::new(options, passed, total);
            let listener = |progress| part.hear(progress);
            let options = Options { progress: Some(&listener), contexts, ..*options };
            meshes[job] = Some(self.triangulate_with(&jobs[job], &options).map_err(in_job(job))?);
            passed += jobs[job].len();
        }
        tell(options, Stage::Insert, total, total)?;
        let whole = |(solution, points): (Option<Solution>, &Vec<Point>)| {
            solution.map(|mut solution| {
                solution.mesh.points.clone_from(points);
                solution
            })
        };
        Ok(meshes.into_iter().zip(jobs).filter_map(whole).collect())
    }

    /// Clocks of the device since it was opened: of a core in simulation, of which every clock is counted; `None` elsewhere.
    pub fn clocks(&self) -> Option<u64> {
        self.link.as_ref().and_then(|link| link.clocks())
    }

    pub(crate) fn triangulate_owned(&mut self, points: Vec<Point>, options: &Options<'_>) -> Result<Solution, Error> {
        let slow = self.link.as_ref().map_or(1, |link| link.pace().slow);
        let default = || Options::default_timeout(points.len()).saturating_mul(slow);
        let timeout = options.timeout.unwrap_or_else(default);
        let (identity, limit, watch) = (self.identity, Limit::of(timeout), Stopwatch::start());
        let contexts = options.contexts.unwrap_or(identity.contexts);
        let name = self.link.as_ref().map_or_else(|| CPU_NAME.to_owned(), |link| link.name());
        check_input(&points, contexts, &identity, name)?;
        let mut solution = match &mut self.link {
            None => return CpuJob { points, contexts, options, limit, watch }.run(),
            Some(link) => {
                let layout = Layout::of(identity.coord_bits, identity.capacity);
                let (mut watch, mut is_first) = (watch, true);
                loop {
                    let points = &points;
                    let job = Job { identity, contexts, layout, limit, link, options, watch, points };
                    match job.run() {
                        // A fault that a reset mends costs time, and not the job.
                        Err(error) if is_first && link.recover(&error, limit)? => {
                            (watch, is_first) = (Stopwatch::start(), false);
                        }
                        result => break result?,
                    }
                }
            }
        };
        solution.mesh.points = points;
        Ok(solution)
    }
}

/// The device must have the contexts; every point must fit its grid, and all of them 32-bit indices.
fn check_input(points: &[Point], asked: u32, identity: &Identity, device: String) -> Result<(), Error> {
    let contexts = identity.contexts;
    if !(1..=contexts).contains(&asked) {
        return Err(Error::Contexts { asked, contexts, device });
    }
    if points.len() > MAX_POINTS {
        return Err(Error::TooManyPoints { points: points.len(), max: MAX_POINTS });
    }
    let coord_bits = identity.coord_bits;
    let outside = |point: &Point| (point.x | point.y) >> coord_bits != 0;
    match points.iter().position(outside) {
        Some(index) => Err(Error::CoordinateOutOfRange { index, x: points[index].x, y: points[index].y, coord_bits }),
        None => Ok(()),
    }
}

/// Tells the listener, which may cancel.
pub(crate) fn tell(options: &Options<'_>, stage: Stage, done: usize, total: usize) -> Result<(), Error> {
    let Some(listener) = options.progress else {
        return Ok(());
    };
    if listener(Progress { stage, done, total }).is_break() {
        return Err(Error::Cancelled { stage: stage.name(), done, total });
    }
    Ok(())
}

/// Times stages.
pub(crate) struct Stopwatch {
    since: Instant,
    pub(crate) stages: Vec<(&'static str, Duration)>,
}

impl Stopwatch {
    pub(crate) fn start() -> Self {
        Self { since: Instant::now(), stages: Vec::with_capacity(4) }
    }

    pub(crate) fn ended(&mut self, stage: Stage) {
        let now = Instant::now();
        self.stages.push((stage.name(), now - self.since));
        self.since = now;
    }
}

/// One triangulation under way.
struct Job<'j> {
    identity: Identity,
    /// Contexts that work.
    contexts: u32,
    layout: Layout,
    limit: Limit,
    link: &'j mut Link,
    options: &'j Options<'j>,
    watch: Stopwatch,
    points: &'j [Point],
}

impl<'j> Job<'j> {
    /// Everything but the points of the mesh.
    fn run(mut self) -> Result<Solution, Error> {
        self.tell(Stage::Order, 0, self.points.len())?;
        let prepared = prepare(self.points, self.options.order, self.contexts);
        self.watch.ended(Stage::Order);
        self.check_capacity(prepared.order.len())?;
        let mut report = self.begin_report(&prepared);
        let (triangles, hull) = if prepared.collinear {
            (Vec::new(), prepared.order)
        } else {
            self.insert(&prepared.order)?;
            let assembly = self.read(&prepared.order)?;
            let counters = self.link.counters(self.limit)?;
            report.counters = Some(counters);
            report.latencies = Latencies::of(&counters, &self.link.latencies(self.limit)?);
            self.assemble(assembly)?
        };
        report.triangles = triangles.len();
        report.hull = hull.len();
        report.stages = self.watch.stages;
        Ok(Solution { mesh: Mesh::new(Vec::new(), triangles, hull, prepared.duplicates), report })
    }

    fn check_capacity(&self, distinct: usize) -> Result<(), Error> {
        let capacity = self.identity.capacity;
        if distinct > capacity as usize {
            return Err(Error::Capacity { distinct, capacity, device: self.link.name() });
        }
        Ok(())
    }

    fn begin_report(&self, prepared: &Prepared) -> Report {
        Report {
            points: self.points.len(),
            distinct: prepared.order.len(),
            duplicates: prepared.duplicates.len(),
            collinear: prepared.collinear,
            backend: self.link.name(),
            order: self.options.order.name(),
            coord_bits: self.identity.coord_bits,
            capacity: self.identity.capacity,
            contexts: self.contexts,
            ..Report::default()
        }
    }

    /// Clears the device and inserts all points, a chunk per command.
    fn insert(&mut self, order: &[u32]) -> Result<(), Error> {
        self.link.clear(self.contexts, self.limit)?;
        let most = self.options.insert_chunk.max(MIN_INSERT_CHUNK);
        let chunk = self.link.pace().chunk(most, self.layout.point_words);
        let mut words = Vec::with_capacity(2 + chunk.min(order.len()) * self.layout.point_words);
        let mut sent = 0;
        for indices in order.chunks(chunk) {
            self.tell(Stage::Insert, sent, order.len())?;
            words.clear();
            words.extend([command_word(Opcode::Insert), indices.len() as u32]);
            for &index in indices {
                let point = self.points[index as usize];
                let pair = self.layout.point_to_words(point.x, point.y);
                words.extend_from_slice(&pair[..self.layout.point_words]);
            }
            let report = self.link.insert(&words, self.limit)?;
            sent += indices.len();
            check_insert(&report, sent as u32).map_err(|fault| self.link.distrust(Opcode::Insert, fault))?;
        }
        self.tell(Stage::Insert, sent, order.len())?;
        self.watch.ended(Stage::Insert);
        Ok(())
    }

    /// Reads all records, a range per command.
    fn read<'a>(&mut self, order: &'a [u32]) -> Result<Assembly<'a>, Error>
    where
        'j: 'a,
    {
        let mut assembly = Assembly::new(order, self.points, self.layout, self.identity.capacity);
        let records = assembly.records();
        let is_packed = self.link.packs_records();
        let opcode = if is_packed { Opcode::Triangles } else { Opcode::Read };
        let chunk = self.link.pace().chunk(READ_CHUNK, self.words_of(1, is_packed));
        let mut words = vec![0; self.words_of(chunk.min(records), is_packed)];
        for first in (0..records).step_by(chunk) {
            self.tell(Stage::Read, first, records)?;
            let count = chunk.min(records - first);
            let words = &mut words[..self.words_of(count, is_packed)];
            self.link.read(opcode, [first as u32, count as u32], words, self.limit)?;
            let taken = if is_packed { assembly.take_packed(first, count, words) } else { assembly.take(first, words) };
            taken.map_err(|fault| self.link.distrust(opcode, fault))?;
        }
        self.tell(Stage::Read, records, records)?;
        self.watch.ended(Stage::Read);
        Ok(assembly)
    }

    /// Words of this many records, or of their vertices; at most `READ_CHUNK` records are read at once.
    fn words_of(&self, records: usize, is_packed: bool) -> usize {
        match self.layout.triangles_words(records as u32) {
            Some(words) if is_packed => words as usize,
            _ => records * self.layout.record_words,
        }
    }

    /// The canonical triangles and the hull.
    fn assemble(&mut self, assembly: Assembly<'_>) -> Result<(Vec<[u32; 3]>, Vec<u32>), Error> {
        self.tell(Stage::Assemble, 0, self.points.len())?;
        let finished = assembly.finish().map_err(|fault| self.link.distrust(Opcode::Read, fault))?;
        self.watch.ended(Stage::Assemble);
        Ok(finished)
    }

    /// Tells the listener, which may cancel.
    fn tell(&self, stage: Stage, done: usize, total: usize) -> Result<(), Error> {
        tell(self.options, stage, done, total)
    }
}

/// All points sent so far must be in, and none of them twice.
fn check_insert(report: &InsertReport, sent: u32) -> Result<(), DeviceFault> {
    let counts = [
        ("points arrived", report.arrived, sent),
        ("points inserted", report.inserted, sent),
        ("duplicates", report.duplicates, 0),
        ("points refused", report.refused, 0),
        ("records", report.records, 2 * sent - 2),
    ];
    match counts.into_iter().find(|(_, found, expected)| found != expected) {
        Some((what, found, expected)) => Err(DeviceFault::Count { what, found, expected }),
        None => Ok(()),
    }
}
