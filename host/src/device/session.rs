//! A session: exclusive use of a greeted device.

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

    /// What the device says of itself, checked.
    pub fn identity(&self) -> &Identity {
        &self.identity
    }

    /// Triangulates with the default [`Options`].
    ///
    /// # Errors
    /// As [`Session::triangulate_with`].
    pub fn triangulate<P: Into<Point> + Copy>(
        &mut self,
        points: &(impl AsRef<[P]> + ?Sized),
    ) -> Result<Solution, Error> {
        self.triangulate_with(points, &Options::default())
    }

    /// Triangulates: the Delaunay triangulation of the distinct points, in canonical form.
    ///
    /// Duplicates collapse onto their lowest index and are listed. Fewer than three distinct points, or points on one
    /// line, are answered by the host alone. O(n log n) on the device in the mean, O(n) on the host. At a million
    /// points of 16 bits the peak is below 200 bytes per point, the engine or the software model and the mesh included,
    /// the caller's points not.
    ///
    /// # Errors
    /// A coordinate beyond the device's bits, more contexts than it has, more distinct points than it holds, a failing
    /// link, an answer that no sound device gives, a passed deadline, or a cancelled job. After an error of link or
    /// device, or a deadline that passed while the device worked, the session is out of step: open the device again.
    /// After all others it can be used again.
    pub fn triangulate_with<P: Into<Point> + Copy>(
        &mut self,
        points: &(impl AsRef<[P]> + ?Sized),
        options: &Options<'_>,
    ) -> Result<Solution, Error> {
        self.triangulate_owned(own(points.as_ref()), options)
    }

    /// As [`Session::triangulate_with`], of points that need not be copied: they are those of the mesh.
    ///
    /// # Errors
    /// As [`Session::triangulate_with`].
    pub fn triangulate_owned(&mut self, points: Vec<Point>, options: &Options<'_>) -> Result<Solution, Error> {
        let terms = self.terms(points.len(), options);
        self.check_input(&points, terms.contexts)?;
        self.backend.triangulate(points, terms)
    }

    /// Triangulates many sets in one call: the mesh of each is that of [`Session::triangulate_with`], byte for byte; of
    /// the reports: a job that a device does with others, or ahead of another, has no times, and counters only where it
    /// had the whole memory.
    ///
    /// A device works on several jobs side by side in one memory: as many as it has contexts, if so many fit;
    /// [`Options::contexts`] says how many at most. Jobs so large that only few fit, or that are left over, are done
    /// one by one, each with as many contexts as pay: whatever is expected to take the device the fewest clocks. Where
    /// the link takes words ahead, those of the next job are on their way, and the one behind it is put in order in a
    /// thread, while the device works on the last and its mesh is assembled: three jobs are held in order at once. The
    /// engine in this process works on a job with each thread.
    ///
    /// [`Options::insert_chunk`] is used only where a job has more than 65,536 points, or the link takes nothing ahead.
    /// The time of [`Options::timeout`] is for all jobs that share the memory together, and for each of the others; a
    /// job that is sent ahead lends its own to the one before it. Progress is told in points of all jobs, duplicates
    /// included, and never goes back: first [`Stage::Order`] of those that share the memory, then [`Stage::Insert`].
    /// What has been sent when a listener cancels is still answered, so the session stays in step.
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
    /// Those of [`Session::triangulate_with`], with the number of the job where one is at fault. There are no solutions
    /// then.
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

    /// Clocks of the device since it was opened: of a core in simulation, of which every clock is counted; `None`
    /// elsewhere.
    #[must_use]
    pub fn clocks(&self) -> Option<u64> {
        self.backend.clocks()
    }

    /// The terms for so many points, from now on.
    fn terms<'t>(&self, points: usize, options: &'t Options<'t>) -> Terms<'t> {
        let default = || Options::default_timeout(points).saturating_mul(self.backend.slow());
        Terms {
            identity: self.identity,
            contexts: options.contexts.unwrap_or(self.identity.contexts),
            limit: Limit::of(options.timeout.unwrap_or_else(default)),
            options,
        }
    }

    /// The device must have the contexts; every point must fit its grid, and all of them 32-bit indices.
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

/// The points of a caller as our own.
fn own<P: Into<Point> + Copy>(points: &[P]) -> Vec<Point> {
    let mut own = pages::with_room(points.len());
    own.extend(points.iter().map(|&point| -> Point { point.into() }));
    own
}
