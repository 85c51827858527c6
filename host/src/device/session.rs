//! Sessions: exclusive use of a device that has been greeted.

use incircle_protocol::Identity;

use super::backend::{Backend, JobLeft, Terms, Together};
use crate::error::Error;
use crate::job::watch::{tell, PartListener};
use crate::job::{Options, Solution, Stage};
use crate::limit::Limit;
use incircle_geometry::pages;
use incircle_geometry::Point;
use incircle_geometry::MAX_POINTS;

/// Exclusive use of a device that has been greeted and checked.
///
/// A session comes from [`Device::session`](crate::Device::session) and takes any number of jobs:
///
/// - [`triangulate`](Self::triangulate) for one job with the default [`Options`];
/// - [`triangulate_with`](Self::triangulate_with) for a time limit, progress, cancellation,
///   an order, or fewer contexts;
/// - [`triangulate_owned`](Self::triangulate_owned) for points that the caller can part with;
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
    backend: &'d mut dyn Backend,
    identity: Identity,
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
    pub fn triangulate<P: Into<Point> + Copy>(
        &mut self,
        points: &(impl AsRef<[P]> + ?Sized),
    ) -> Result<Solution, Error> {
        self.triangulate_with(points, &Options::default())
    }

    /// Triangulates one set of points: the Delaunay triangulation of its distinct points, in canonical form.
    ///
    /// Points that fall onto an earlier one are left out of the triangles and listed in
    /// [`Mesh::duplicates`](crate::Mesh::duplicates). With fewer than three distinct points, or with all points on one
    /// line, there are no triangles, and the host answers alone.
    ///
    /// Cost: O(n log n) on the device on average, O(n) on the host. At a million points of 16 bits the peak of memory
    /// is below 200 bytes per point, with the mesh and the CPU triangulator or the software model, but without the
    /// points of the caller.
    ///
    /// # Errors
    /// - [`Error::CoordinateOutOfRange`], [`Error::TooManyPoints`], [`Error::Capacity`] and [`Error::Contexts`]
    ///   for input and options that the device cannot take; [`Error::Cancelled`] if the listener says so. The
    ///   session can be used again.
    /// - [`Error::Link`] and [`Error::Device`] for a link that fails and an answer that no sound device gives;
    ///   [`Error::Timeout`] if the deadline passes while the device works. The session is then out of step and refuses
    ///   further work: open the device again.
    pub fn triangulate_with<P: Into<Point> + Copy>(
        &mut self,
        points: &(impl AsRef<[P]> + ?Sized),
        options: &Options<'_>,
    ) -> Result<Solution, Error> {
        self.triangulate_owned(own(points.as_ref()), options)
    }

    /// Triangulates points that the caller hands over, without a copy: the list becomes that of the mesh.
    ///
    /// # Errors
    /// The errors of [`Session::triangulate_with`].
    pub fn triangulate_owned(&mut self, points: Vec<Point>, options: &Options<'_>) -> Result<Solution, Error> {
        let terms = self.terms(points.len(), options);
        self.check_input(&points, terms.contexts)?;
        self.backend.triangulate(points, terms)
    }

    /// Triangulates many sets of points in one call, as a batch. Each mesh is byte for byte
    /// the one that [`Session::triangulate_with`] gives.
    ///
    /// Reach for a batch when there are many small jobs: a single small mesh has no room for many insertions at once,
    /// so a device works on several jobs side by side, one in each context. [`Options::contexts`] bounds their
    /// number. Jobs that are too large to share the memory are *exclusive*: each has the memory to itself, with as
    /// many contexts as pay. The host decides which jobs share the memory, so as to need the fewest clocks. While the
    /// device works on one job, the host sends the next and orders the points of the one after it, if the transport
    /// takes commands ahead. The CPU triangulator works on one small job in each thread.
    ///
    /// - **Reports.** Jobs that shared the device, or were sent ahead, have no times; they have counters only if
    ///   they had the whole memory.
    /// - **Time.** [`Options::timeout`] is one limit for all jobs that share the memory, and one for each of the
    ///   others. While a job is sent ahead, its time is added to that of the job before it.
    /// - **Progress** counts the points of all jobs, duplicates included, and never goes back: first [`Stage::Order`]
    ///   for the jobs that share the memory, then [`Stage::Insert`]. If the listener cancels, the answers to what was
    ///   sent are still received, so the session stays in step.
    /// - [`Options::insert_chunk`] matters only for a job of more than 65,536 points, and where
    ///   the transport takes nothing ahead.
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
    pub fn triangulate_batch<P: Into<Point> + Copy>(
        &mut self,
        jobs: &[impl AsRef<[P]>],
        options: &Options<'_>,
    ) -> Result<Vec<Solution>, Error> {
        let jobs: Vec<Vec<Point>> = jobs.iter().map(|points| own(points.as_ref())).collect();
        let total = jobs.iter().map(Vec::len).sum();
        let terms = self.terms(total, options);
        let in_job = |job: usize| move |source| Error::InJob { job, source: Box::new(source) };
        self.check_input(&[], terms.contexts)?;
        for (job, points) in jobs.iter().enumerate() {
            self.check_input(points, terms.contexts).map_err(in_job(job))?;
        }
        let Together { mut solutions, left } = self.backend.triangulate_together(jobs, terms)?;
        let mut passed = total - left.iter().map(|left| left.points.len()).sum::<usize>();
        for JobLeft { job, points, contexts } in left {
            let part = PartListener::new(options, passed, total);
            let listener = |progress| part.hear(progress);
            passed += points.len();
            let options = Options { progress: Some(&listener), contexts: Some(contexts), ..*options };
            solutions[job] = Some(self.triangulate_owned(points, &options).map_err(in_job(job))?);
        }
        tell(options, Stage::Insert, total, total)?;
        Ok(solutions.into_iter().flatten().collect())
    }

    /// Clocks of the device since it was opened; `None` unless the device is a simulated
    /// core, whose clocks are counted.
    #[must_use]
    pub fn clocks(&self) -> Option<u64> {
        self.backend.clocks()
    }

    /// The terms for a job of `points` points whose time begins now.
    fn terms<'t>(&self, points: usize, options: &'t Options<'t>) -> Terms<'t> {
        let default = || Options::default_timeout(points).saturating_mul(self.backend.slow());
        Terms {
            identity: self.identity,
            contexts: options.contexts.unwrap_or(self.identity.contexts),
            limit: Limit::of(options.timeout.unwrap_or_else(default)),
            options,
        }
    }

    /// Refuses more contexts than the device has, more points than a job may have, and coordinates beyond its bits.
    fn check_input(&self, points: &[Point], asked: u32) -> Result<(), Error> {
        let Identity { contexts, coord_bits, .. } = self.identity;
        if !(1..=contexts).contains(&asked) {
            return Err(Error::Contexts { asked, contexts, device: self.backend.name() });
        }
        if points.len() > MAX_POINTS {
            return Err(Error::TooManyPoints { points: points.len(), max: MAX_POINTS });
        }
        let outside = |point: &Point| (point.x | point.y) >> coord_bits != 0;
        match points.iter().position(outside) {
            Some(index) => {
                Err(Error::CoordinateOutOfRange { index, x: points[index].x, y: points[index].y, coord_bits })
            }
            None => Ok(()),
        }
    }
}

/// Copies the points of the caller, converted.
fn own<P: Into<Point> + Copy>(points: &[P]) -> Vec<Point> {
    let mut own = pages::with_room(points.len());
    own.extend(points.iter().map(|&point| -> Point { point.into() }));
    own
}
