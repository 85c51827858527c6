//! Several devices that share the work on one set.

mod hall;
mod worker;

use std::panic::{catch_unwind, resume_unwind, AssertUnwindSafe};
use std::sync::OnceLock;
use std::thread::Builder;

use incircle_geometry::cpu::{Connectivity, Parts, Unsound};
use incircle_geometry::lattice::Numbers;
use incircle_geometry::PlanePoint;

use self::hall::{Greeted, Hall};
use self::worker::Choices;
use super::address::DeviceAddress;
use super::cpu_backend::error_of;
use super::in_parts::{host_threads, DURING};
use super::lay::{lay, Asked};
use super::open::Device;
use super::session::own;
use crate::error::{DeviceFault, Error};
use crate::job::watch::{tell, Stopwatch};
use crate::job::{Answer, Options, Report, Solution, Stage};
use crate::limit::Limit;

/// Fewest points of a part, if the set has more. With smaller parts, the host's work grows more than the time of the
/// devices falls.
const LEAST_PART: usize = 1024;
/// Most points of a part. Many parts keep all devices busy to the end.
const MOST_PART: usize = 16_384;

/// Several devices that share the work on one set.
///
/// Reach for a fleet when you have more than one board or card, or a board and a processor that would be idle. The set
/// is cut into parts, each part goes to whichever device is free, and the host joins the meshes of the parts. The mesh
/// is the one that any of the devices gives alone.
///
/// A device that cannot be opened, fails, or does not answer within [`Options::default_timeout`] of its parts is left
/// out. Other devices do its parts again, and [`Report::shares`] tells what each device did. The set ends with an error
/// if no device is left (that of the device left out last), if the points do not fit the devices, if the time is over,
/// if the listener cancels, or if the meshes do not fit together.
///
/// Each call of [`triangulate`](Self::triangulate) opens the devices anew, each on a thread of its own.
///
/// ```
/// use incircle::{Fleet, Options, Point};
///
/// let points: Vec<Point> = (0..5000).map(|k| Point::new(k * k % 8191, k * 7 % 8209)).collect();
/// let fleet = Fleet::open(&["clock?config=quad", "cpu?threads=1"])?;
/// let solution = fleet.triangulate(&points, &Options::default())?;
/// assert_eq!(solution.mesh, incircle::triangulate(&points)?);
/// assert_eq!(solution.report.shares.iter().map(|share| share.parts).sum::<usize>(), solution.report.parts);
/// # Ok::<(), incircle::Error>(())
/// ```
#[derive(Default)]
pub struct Fleet {
    members: Vec<Member>,
}

/// A device of a fleet that is not open yet.
struct Member {
    /// The name of the device until it is open.
    name: String,
    open: Box<dyn Fn() -> Result<Device, Error> + Send + Sync>,
}

impl Fleet {
    /// A fleet of the devices at these addresses; [`DeviceAddress`] lists all forms. Nothing is opened yet.
    ///
    /// # Errors
    /// [`Error::Address`] for text that is not an address.
    pub fn open(addresses: &[impl AsRef<str>]) -> Result<Self, Error> {
        let addresses: Result<Vec<DeviceAddress>, _> = addresses.iter().map(|text| text.as_ref().parse()).collect();
        let with = |fleet: Self, address: DeviceAddress| fleet.with(address.to_string(), move || Device::at(&address));
        Ok(addresses?.into_iter().fold(Self::default(), with))
    }

    /// Adds a device. `open` opens it, on a thread of the device's own, in each call of
    /// [`triangulate`](Self::triangulate). The name stands in reports if the device cannot be opened.
    #[must_use]
    pub fn with(mut self, name: String, open: impl Fn() -> Result<Device, Error> + Send + Sync + 'static) -> Self {
        self.members.push(Member { name, open: Box::new(open) });
        self
    }

    /// Triangulates one set of points with all devices of the fleet.
    ///
    /// [`Options::contexts`] bounds the contexts of every device. The points must lie on a
    /// [`Lattice`](crate::Lattice) that fits the coordinates of every device: one device with few bits makes the fleet
    /// refuse the set. The time limit begins when all devices are open or left out.
    ///
    /// Cost: the work of the devices, side by side. The host cuts and joins on up to all processors, in O(n) time on
    /// even sets. A device may give sound triangles that are not those of Delaunay; not all of them are found out, so
    /// call [`Mesh::verify`](crate::Mesh::verify) if you do not trust a device.
    ///
    /// # Errors
    /// The errors of [`Session::triangulate_with`](crate::Session::triangulate_with). An empty fleet is
    /// [`Error::Address`].
    pub fn triangulate<P: PlanePoint>(
        &self,
        points: &(impl AsRef<[P]> + ?Sized),
        options: &Options<'_>,
    ) -> Result<Solution<P>, Error> {
        let points = points.as_ref();
        let hall = Hall::new(self.members.iter().map(|member| member.name.clone()).collect());
        let parts = OnceLock::new();
        let mut watch = Stopwatch::start();
        let found = std::thread::scope(|scope| {
            for (place, member) in self.members.iter().enumerate() {
                let (hall, parts, choices) = (&hall, &parts, Choices::of(options));
                let work = move || member.work(place, hall, parts, choices);
                if let Err(error) = Builder::new().spawn_scoped(scope, work) {
                    hall.leave_out(place, Error::Open { device: member.name.clone(), source: Box::new(error) });
                }
            }
            let found = lead(points, &hall, &parts, options, &mut watch);
            hall.close();
            found
        });
        let report = found?;
        let parts = parts.into_inner().ok_or_else(|| no_device(&hall))?;
        let report = Report { shares: hall.shares(), ..report };
        let joined = join(parts, &hall, &report)?;
        watch.ended(Stage::Assemble);
        let Connectivity { triangles, hull, duplicates } = joined;
        let report = Report { stages: watch.stages, ..report };
        Ok(Answer { triangles, hull, duplicates, report }.with(own(points)))
    }
}

impl Member {
    /// Does parts with this device. If the caller's code panics, the device is left out before the panic goes on, so
    /// that nobody waits for it.
    fn work(&self, place: usize, hall: &Hall, parts: &OnceLock<Parts>, choices: Choices) {
        let work = || worker::work(place, &*self.open, hall, parts, choices);
        if let Err(panic) = catch_unwind(AssertUnwindSafe(work)) {
            hall.leave_out(place, Error::OutOfStep { device: self.name.clone() });
            resume_unwind(panic);
        }
    }
}

/// Leads the work: waits for the devices, cuts the set, and listens until all parts are done.
fn lead<P: PlanePoint>(
    points: &[P],
    hall: &Hall,
    parts: &OnceLock<Parts>,
    options: &Options<'_>,
    watch: &mut Stopwatch,
) -> Result<Report, Error> {
    let greeted = loop {
        tell(options, Stage::Order, 0, points.len())?;
        if let Some(greeted) = hall.greetings() {
            break greeted;
        }
    };
    let mut report = report_of(&greeted, options).ok_or_else(|| no_device(hall))?;
    let slow = greeted.iter().map(|device| device.slow).max().unwrap_or(1);
    let default = || Options::default_timeout(points.len()).saturating_mul(slow);
    let limit = Limit::of(options.timeout.unwrap_or_else(default));
    *watch = Stopwatch::start();
    let asked = Asked { coord_bits: report.coord_bits, takes_all: false, device: &report.backend };
    let (numbers, lattice) = lay(points, asked)?;
    let Numbers::Grid(grid) = &numbers else {
        return Err(Error::NoLattice { coord_bits: report.coord_bits, device: report.backend });
    };
    let cut = Parts::divide(grid, part_size(&greeted, grid.len()), host_threads(grid.len())).map_err(error_of)?;
    drop(numbers);
    watch.ended(Stage::Order);
    let distinct = cut.distinct();
    // Points on one line need no device.
    report.parts = if cut.collinear().is_some() { 0 } else { cut.count() };
    parts.get_or_init(|| cut);
    if report.parts > 0 {
        hall.begin(report.parts, limit);
        listen(hall, distinct, limit, &report.backend, options)?;
    }
    watch.ended(Stage::Insert);
    tell(options, Stage::Assemble, 0, distinct)?;
    Ok(Report { lattice, ..report })
}

/// The facts of a report that are known before the job is done; `None` if there is no device.
fn report_of(greeted: &[Greeted], options: &Options<'_>) -> Option<Report> {
    let names: Vec<&str> = greeted.iter().map(|device| device.name.as_str()).collect();
    let identities = || greeted.iter().map(|device| device.identity);
    Some(Report {
        order: options.order.name(),
        coord_bits: identities().map(|identity| identity.coord_bits).min()?,
        capacity: identities().map(|identity| identity.capacity).min()?,
        contexts: identities().map(|identity| identity.contexts).sum(),
        engines: identities().map(|identity| identity.engines).sum(),
        backend: names.join(" + "),
        ..Report::default()
    })
}

/// The most points of a part: what the smallest device holds, but small enough that each device gets about eight parts.
fn part_size(greeted: &[Greeted], points: usize) -> usize {
    let smallest = greeted.iter().map(|device| device.identity.capacity as usize).min().unwrap_or(0);
    let even = points / (8 * greeted.len().max(1));
    even.clamp(LEAST_PART, MOST_PART).min(smallest.max(LEAST_PART))
}

/// Tells the listener of progress until all parts are done, no device is left, or the time is over.
fn listen(hall: &Hall, total: usize, limit: Limit, backend: &str, options: &Options<'_>) -> Result<(), Error> {
    loop {
        let seen = hall.look();
        tell(options, Stage::Insert, seen.points.min(total), total)?;
        if seen.is_over {
            return Ok(());
        }
        if seen.devices == 0 {
            return Err(no_device(hall));
        }
        limit.check(backend, DURING)?;
    }
}

/// Joins the parts, all of which are done.
fn join(parts: Parts, hall: &Hall, report: &Report) -> Result<Connectivity, Error> {
    let threads = host_threads(parts.distinct());
    parts.join(hall.take_solved(), threads).map_err(|Unsound| Error::Device {
        device: report.backend.clone(),
        during: DURING,
        fault: DeviceFault::Unsound,
    })
}

/// The error of the device that was left out last.
fn no_device(hall: &Hall) -> Error {
    hall.take_failure().unwrap_or_else(|| Error::Address {
        address: String::new(),
        reason: "a fleet needs at least one device".to_owned(),
    })
}
