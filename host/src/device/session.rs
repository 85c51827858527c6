//! Sessions: exclusive use of a device that has been greeted.

use std::ops::ControlFlow;

use incircle_protocol::{Identity, RunKind};

use super::backend::{Backend, JobLeft, Terms, Together};
use super::lay::{lay, Asked};
use super::living::{Choices, LivingSession};
use crate::error::Error;
use crate::job::watch::{tell, PartListener};
use crate::job::{Options, Progress, Solution, Stage};
use crate::limit::Limit;
use incircle_geometry::lattice::{Lattice, Numbers};
use incircle_geometry::pages;
use incircle_geometry::{PlanePoint, Point, MAX_POINTS};

/// Exclusive use of a device that has been greeted and checked.
///
/// A session comes from [`Device::session`](crate::Device::session) and takes any number of jobs:
///
/// - [`triangulate`](Self::triangulate) for one job with the default [`Options`];
/// - [`triangulate_with`](Self::triangulate_with) for a time limit, progress, cancellation, an
///   order, or fewer contexts;
/// - [`triangulate_owned`](Self::triangulate_owned) for points that the caller can part with;
/// - [`triangulate_constrained`](Self::triangulate_constrained) for edges that must be in the mesh;
/// - [`triangulate_batch`](Self::triangulate_batch) for many jobs, which a device works on side by side.
///
/// ```
/// use incircle::Device;
///
/// let mut device = Device::open("cpu")?;
/// let mut session = device.session()?;
/// let solution = session.triangulate(&[(0, 0), (4, 0), (0, 4)])?;
/// assert_eq!(solution.mesh.triangles, [[0, 1, 2]]);
/// assert_eq!(solution.report.backend, "cpu");
/// # Ok::<(), incircle::Error>(())
/// ```
pub struct Session<'d> {
    pub(super) backend: &'d mut dyn Backend,
    pub(super) identity: Identity,
}

impl<'d> Session<'d> {
    pub(crate) fn new(backend: &'d mut dyn Backend, identity: Identity) -> Self {
        Self { backend, identity }
    }

    /// The identity of the device: coordinate bits, capacity, contexts and versions, all checked.
    pub fn identity(&self) -> &Identity {
        &self.identity
    }

    /// Triangulates one set of points with the default [`Options`].
    ///
    /// # Errors
    /// The errors of [`Session::triangulate_with`].
    pub fn triangulate<P: PlanePoint>(&mut self, points: &(impl AsRef<[P]> + ?Sized)) -> Result<Solution<P>, Error> {
        self.triangulate_with(points, &Options::default())
    }

    /// Triangulates one set of points: the Delaunay triangulation of its distinct points, in canonical form.
    ///
    /// Points that fall onto an earlier one are left out of the triangles and listed in
    /// [`Mesh::duplicates`](crate::Mesh::duplicates). With fewer than three distinct points, or with all points on one
    /// line, there are no triangles, and the host answers alone.
    ///
    /// More distinct points than the device holds are cut into parts, which the device does as a batch. The host joins
    /// the meshes of the parts, and [`Report::parts`](crate::Report::parts) says how many there were. Progress then
    /// counts the points of all parts, and has no [`Stage::Read`].
    ///
    /// Cost: O(n log n) on the device on average, O(n) on the host. At a million points of 16 bits the peak of memory
    /// is below 200 bytes per point, with the mesh and the CPU triangulator or the software model, but without the
    /// points of the caller.
    ///
    /// # Errors
    /// - [`Error::NotFinite`], [`Error::CoordinateOutOfRange`], [`Error::LatticeTooWide`], [`Error::NoLattice`],
    ///   [`Error::TooManyPoints`] and [`Error::Contexts`] for input and options that the device cannot take;
    ///   [`Error::Cancelled`] if the listener says so. The session can be used again.
    /// - [`Error::Link`] and [`Error::Device`] for a link that fails and an answer that no sound device gives;
    ///   [`Error::Timeout`] if the deadline passes while the device works. The session is then out of step and refuses
    ///   further work: open the device again.
    pub fn triangulate_with<P: PlanePoint>(
        &mut self,
        points: &(impl AsRef<[P]> + ?Sized),
        options: &Options<'_>,
    ) -> Result<Solution<P>, Error> {
        self.triangulate_owned(own(points.as_ref()), options)
    }

    /// Triangulates points that the caller hands over, without a copy: the list becomes that of the mesh.
    ///
    /// # Errors
    /// The errors of [`Session::triangulate_with`].
    pub fn triangulate_owned<P: PlanePoint>(
        &mut self,
        points: Vec<P>,
        options: &Options<'_>,
    ) -> Result<Solution<P>, Error> {
        let terms = self.terms(points.len(), options);
        let (numbers, lattice) = self.on_lattice(&points, terms)?;
        let mut solution = match numbers {
            // The job of a device owns its grid points. `on_lattice` has refused all that is not on the device's grid.
            Numbers::Grid(grid) if !self.backend.takes_all_numbers() => {
                let grid = grid.into_owned();
                self.triangulate_grid(grid, terms)?.with_points(points)
            }
            numbers => {
                let answer = self.backend.triangulate_numbers(&numbers, terms)?;
                drop(numbers);
                answer.with(points)
            }
        };
        solution.report.lattice = lattice;
        Ok(solution)
    }

    /// Triangulates many sets of points in one call, as a batch. Each mesh is byte for byte the one that
    /// [`Session::triangulate_with`] gives.
    ///
    /// Reach for a batch when there are many small jobs: a single small mesh has no room for many insertions at once,
    /// so a device works on several jobs side by side, each with a team of contexts. [`Options::contexts`] bounds their
    /// sum. Jobs that are too large to share the memory are *exclusive*: each has the memory to itself, with as many
    /// contexts as pay. The host decides which jobs share the memory, so as to need the fewest clocks. While the device
    /// works on one job, the host sends the next and orders the points of the one after it, if the transport takes
    /// commands ahead. The CPU triangulator works on one small job in each thread.
    ///
    /// - **Reports.** Jobs that shared the device, or were sent ahead, have no times; they have counters only if they
    ///   had the whole memory.
    /// - **Time.** [`Options::timeout`] is one limit for all jobs that share the memory, and one for each of the
    ///   others. While a job is sent ahead, its time is added to that of the job before it.
    /// - **Large jobs**, which the device cannot hold, are done in parts, one by one, after all others.
    /// - **Progress** counts the points of all jobs, duplicates included, and never goes back: first [`Stage::Order`]
    ///   for the jobs that share the memory, then [`Stage::Insert`]. If the listener cancels, the answers to what was
    ///   sent are still received, so the session stays in step.
    /// - [`Options::insert_chunk`] matters only for a job of more than 65,536 points, and where the
    ///   transport takes nothing ahead.
    ///
    /// ```
    /// use incircle::{Device, Options, Point};
    ///
    /// let job = |seed: u32| (0..50).map(|k| Point::new(k * (seed + 7) % 83, k * k % 89)).collect::<Vec<_>>();
    /// let jobs = [job(1), job(2), job(3)];
    /// let mut device = Device::open("clock?config=small")?;
    /// let mut session = device.session()?;
    /// let solutions = session.triangulate_batch(&jobs, &Options::default())?;
    /// assert_eq!(solutions[2].mesh, session.triangulate(&jobs[2])?.mesh);
    /// # Ok::<(), incircle::Error>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`Session::triangulate_with`], inside [`Error::InJob`] if one job is at fault. After an error
    /// there are no solutions, not even of the jobs that were done.
    pub fn triangulate_batch<P: PlanePoint>(
        &mut self,
        jobs: &[impl AsRef<[P]>],
        options: &Options<'_>,
    ) -> Result<Vec<Solution<P>>, Error> {
        let total = jobs.iter().map(|points| points.as_ref().len()).sum();
        let terms = self.terms(total, options);
        self.check_job(0, terms.contexts)?;
        let mut solutions: Vec<Option<Solution<P>>> = jobs.iter().map(|_| None).collect();
        let (mut on_lattices, mut grids) = (Vec::new(), Vec::new());
        let mut off_lattices = Vec::new();
        for (job, points) in jobs.iter().enumerate() {
            match self.on_lattice(points.as_ref(), terms).map_err(in_job(job))? {
                (Numbers::Grid(grid), lattice) => {
                    on_lattices.push((job, lattice));
                    grids.push(grid.into_owned());
                }
                _ => off_lattices.push(job),
            }
        }
        let mut passed = grids.iter().map(Vec::len).sum();
        let found = self.triangulate_grids(grids, |grid| on_lattices[grid].0, terms, total)?;
        for ((job, lattice), mut solution) in on_lattices.into_iter().zip(found) {
            solution.report.lattice = lattice;
            solutions[job] = Some(solution.with_points(own(jobs[job].as_ref())));
        }
        for job in off_lattices {
            let points = own(jobs[job].as_ref());
            let part = PartListener::new(options, passed, total);
            let listener = |progress| part.hear(progress);
            passed += points.len();
            let options = Options { progress: Some(&listener), ..*options };
            solutions[job] = Some(self.triangulate_owned(points, &options).map_err(in_job(job))?);
        }
        tell(options, Stage::Insert, total, total)?;
        Ok(solutions.into_iter().flatten().collect())
    }

    /// Triangulates jobs of grid points, which count among `total` points; `job` gives the number of each among all
    /// jobs. Jobs that the device cannot hold are done one by one, in parts, after all others. The listener hears of
    /// `total` points throughout.
    pub(super) fn triangulate_grids(
        &mut self,
        mut grids: Vec<Vec<Point>>,
        job: impl Fn(usize) -> usize,
        terms: Terms<'_>,
        total: usize,
    ) -> Result<Vec<Solution>, Error> {
        let own_total: usize = grids.iter().map(Vec::len).sum();
        let mut too_large = Vec::new();
        for (grid, points) in grids.iter_mut().enumerate().filter(|(_, points)| !self.holds(points)) {
            // The batch gets an empty job in the place of this one.
            too_large.push(JobLeft { job: grid, points: std::mem::take(points), contexts: terms.contexts });
        }
        let hear_of_all = |progress: Progress| match (terms.options.progress, progress.stage) {
            (None, _) => ControlFlow::Continue(()),
            (Some(listener), Stage::Insert) => listener(Progress { total, ..progress }),
            (Some(listener), _) => listener(progress),
        };
        let options = Options { progress: Some(&hear_of_all), ..*terms.options };
        let together = Terms { options: &options, ..terms };
        let Together { mut solutions, mut left } = self.backend.triangulate_together(grids, together)?;
        left.extend(too_large);
        let mut passed = own_total - left.iter().map(|left| left.points.len()).sum::<usize>();
        for JobLeft { job: grid, points, contexts } in left {
            let part = PartListener::new(terms.options, passed, total);
            let listener = |progress| part.hear(progress);
            passed += points.len();
            let timeout = if terms.shares_limit { Some(terms.limit.time_left()) } else { terms.options.timeout };
            let options = Options { progress: Some(&listener), contexts: Some(contexts), timeout, ..*terms.options };
            solutions[grid] = Some(self.triangulate_owned(points, &options).map_err(in_job(job(grid)))?);
        }
        Ok(solutions.into_iter().flatten().collect())
    }

    /// Whether the device can keep a mesh that lives: it must answer questions about its mesh, and insert points at
    /// vertices that the host names. Of the devices of this library the back ends `model`, and `clock` with one engine,
    /// can, and of simulated cores those with runs; on the processor use [`Triangulation`](crate::Triangulation).
    ///
    /// A device that can do all this may still have no commands to delete and to move a vertex. Then every change of
    /// this kind has the host make the mesh on the device anew before the next question, see [`LivingSession`].
    pub fn keeps_living_meshes(&self) -> bool {
        let needed = [RunKind::Locate, RunKind::Interpolate, RunKind::Nearest, RunKind::InsertAs];
        needed.into_iter().all(|kind| self.identity.takes(kind))
    }

    /// Begins a mesh that lives on the device, without points. See [`LivingMesh`](crate::LivingMesh) for an example.
    ///
    /// # Errors
    /// [`Error::NoRuns`] unless the device [can](Self::keeps_living_meshes).
    pub fn living(&mut self) -> Result<LivingSession<'_>, Error> {
        self.living_with(&Options::default())
    }

    /// The same with options. [`Options::timeout`] is the limit for each call that asks the device something.
    /// [`Options::order`] and [`Options::contexts`] count where many points are given to the device at once, and the
    /// listener hears nothing.
    ///
    /// # Errors
    /// [`Error::NoRuns`] unless the device [can](Self::keeps_living_meshes), and [`Error::Contexts`] for more contexts
    /// than it has.
    pub fn living_with(&mut self, options: &Options<'_>) -> Result<LivingSession<'_>, Error> {
        if !self.keeps_living_meshes() {
            return Err(Error::NoRuns { device: self.backend.name() });
        }
        let contexts = options.contexts.unwrap_or(self.identity.contexts);
        self.check_job(0, contexts)?;
        let choices = Choices { timeout: options.timeout, order: options.order, contexts };
        Ok(LivingSession::new(self.backend, self.identity, choices))
    }

    /// Clocks of the device since it was opened; `None` unless the device is a simulated core, whose clocks are
    /// counted.
    #[must_use]
    pub fn clocks(&self) -> Option<u64> {
        self.backend.clocks()
    }

    /// The terms for a job of `points` points whose time begins now.
    pub(super) fn terms<'t>(&self, points: usize, options: &'t Options<'t>) -> Terms<'t> {
        let default = || Options::default_timeout(points).saturating_mul(self.backend.slow());
        Terms {
            identity: self.identity,
            contexts: options.contexts.unwrap_or(self.identity.contexts),
            limit: Limit::of(options.timeout.unwrap_or_else(default)),
            shares_limit: false,
            options,
        }
    }

    /// Refuses more contexts than the device has, and more points than a job may have.
    pub(super) fn check_job(&self, points: usize, asked: u32) -> Result<(), Error> {
        let contexts = self.identity.contexts;
        if !(1..=contexts).contains(&asked) {
            return Err(Error::Contexts { asked, contexts, device: self.backend.name() });
        }
        if points > MAX_POINTS {
            return Err(Error::TooManyPoints { points, max: MAX_POINTS });
        }
        Ok(())
    }

    /// Checks the number of points and of contexts, then lays the points onto their lattice.
    pub(super) fn on_lattice<'p, P: PlanePoint>(
        &self,
        points: &'p [P],
        terms: Terms<'_>,
    ) -> Result<(Numbers<'p>, Option<Lattice>), Error> {
        self.check_job(points.len(), terms.contexts)?;
        let (coord_bits, takes_all) = (self.identity.coord_bits, self.backend.takes_all_numbers());
        lay(points, Asked { coord_bits, takes_all, device: &self.backend.name() })
    }

    /// The name of the device in reports and errors.
    pub(super) fn name(&self) -> String {
        self.backend.name()
    }

    /// The factor by which the device is slower than real hardware.
    pub(super) fn slow(&self) -> u32 {
        self.backend.slow()
    }
}

/// Puts an error into its job of a batch.
fn in_job(job: usize) -> impl Fn(Error) -> Error {
    move |source| Error::InJob { job, source: Box::new(source) }
}

/// Copies the points of the caller.
pub(super) fn own<P: PlanePoint>(points: &[P]) -> Vec<P> {
    let mut own = pages::with_room(points.len());
    own.extend_from_slice(points);
    own
}
