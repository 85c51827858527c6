//! Exact canonical Delaunay triangulation of points in the plane, in hardware or software.
//!
//! Use this library when a triangulation must be *right* and *reproducible*: coordinates are taken as they are, every
//! predicate is exact, and a set of points has one answer. Every back end gives that answer byte for byte: the CPU
//! triangulator, the software model, the simulated core, a board at a serial port, a card in a PCIe slot. Duplicates,
//! collinear points and fewer than three points are no errors. Where four or more points lie on one empty circle, all
//! diagonals start at the lexicographically smallest of them.
//!
//! # In one call
//!
//! [`triangulate`] needs no device and no choices. Start here; most programs need nothing else.
//!
//! ```
//! let mesh = incircle::triangulate(&[(0, 0), (4, 0), (4, 4), (0, 4), (4, 0)])?;
//! assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
//! assert_eq!(mesh.hull, [0, 1, 2, 3]);
//! assert_eq!(mesh.duplicates[0].of, 1);
//! mesh.verify()?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! The result is a [`Mesh`]: triangles and hull as indices into the points, and the list of duplicates.
//! [`Mesh::neighbors`] and [`Mesh::halfedges`] give the adjacency; [`Mesh::verify`] proves the mesh with a validator
//! that shares no code with any back end.
//!
//! # Floating-point values
//!
//! [`triangulate`] takes floating-point values as the exact numbers that they are. For a device, [`quantize()`] lays
//! values onto the integer grid and reports what rounding did. The mesh has the indices of the values, so a program can
//! draw it with the values themselves.
//!
//! ```
//! use incircle::{quantize, triangulate, Quantize};
//!
//! let places = [[-0.1, 51.5], [2.4, 48.9], [13.4, 52.5], [4.9, 52.4]];
//! let (points, report) = quantize(&places, 31, Quantize::Fit)?;
//! let mesh = triangulate(&points)?;
//! assert_eq!(mesh.triangles.len(), 2);
//! assert!(report.largest_error < 1e-8 && report.merged == 0);
//! let [x, y] = report.restore(points[0]);
//! assert!((x - places[0][0]).abs() <= report.largest_error && (y - places[0][1]).abs() <= report.largest_error);
//! # Ok::<(), incircle::Error>(())
//! ```
//!
//! # Many small sets
//!
//! A [`Triangulator`] triangulates one small set after the other on the calling thread. The triangulator and the mesh
//! keep their memory: a set of at most 2^21 points that has no more points than an earlier one allocates nothing.
//!
//! ```
//! use incircle::{Mesh, Point, Triangulator};
//!
//! let mut points: Vec<Point> = (0..200).map(|k| Point::new(k * k % 83, k * 7 % 89)).collect();
//! let (mut triangulator, mut mesh) = (Triangulator::new(), Mesh::default());
//! for step in 0..3 {
//!     for point in &mut points {
//!         point.x += step * point.y;
//!     }
//!     triangulator.triangulate_into(&points, &mut mesh)?;
//!     assert_eq!(mesh, incircle::triangulate(&points)?);
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Points that change
//!
//! A [`Triangulation`] can be asked and changed; see [`living`].
//!
//! ```
//! use incircle::living::{Location, Triangulation};
//!
//! let mut mesh = Triangulation::from([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]])?;
//! assert_eq!(mesh.locate([3.0, 1.0]), Location::Triangle([0, 1, 2]));
//! let middle = mesh.insert([2.0, 1.0])?;
//! assert!(mesh.neighbors(middle)?.eq([0, 1, 2, 3]));
//! mesh.move_to(middle, [2.5, 1.5])?;
//! assert_eq!(mesh.nearest([3.0, 3.0]), Some(2));
//! mesh.delete(middle)?;
//! assert_eq!(mesh.mesh().triangles, [[0, 1, 2], [0, 2, 3]]);
//! # Ok::<(), incircle::living::Error>(())
//! ```
//!
//! # Points that change on a device
//!
//! A device that can keep a mesh does so in a [`LivingSession`], which shares the trait [`LivingMesh`] with
//! [`Triangulation`]. Of the devices of this library only the model can.
//!
//! ```
//! use incircle::living::Location;
//! use incircle::{Device, LivingMesh, Point};
//!
//! let mut device = Device::open("model")?;
//! let mut session = device.session()?;
//! let mut mesh = session.living()?;
//! mesh.insert_all(&[[0, 0], [8, 0], [8, 8], [0, 8], [4, 4]].map(Point::from))?;
//! assert_eq!(mesh.nearest(Point::new(4, 0))?, Some(0));
//! mesh.move_to(4, Point::new(4, 5))?;
//! assert_eq!(mesh.locate(Point::new(4, 2))?, Location::Triangle([0, 1, 4]));
//! mesh.delete(4)?;
//! assert_eq!(mesh.mesh()?.triangles, [[0, 1, 2], [0, 2, 3]]);
//! # Ok::<(), incircle::Error>(())
//! ```
//!
//! # Edges that must be there
//!
//! Roads, coastlines and outlines are edges of a mesh, whose triangles may be those of a domain alone; see
//! [`constraints`].
//!
//! ```
//! use incircle::constraints::{constrain, Domain, Plan};
//!
//! // A square with a notch: point 4 lies inside the hull.
//! let mesh = incircle::triangulate(&[(0, 0), (8, 0), (8, 8), (0, 8), (4, 3)])?;
//! let outline = [[0, 1], [1, 2], [2, 4], [4, 3], [3, 0]];
//! let made = constrain(&mesh, &Plan { domain: Domain::EvenOdd, ..Plan::new(&outline) })?;
//! assert_eq!(made.triangles, [[0, 1, 4], [0, 4, 3], [1, 2, 4]]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Crossings become points
//!
//! Constraints that cross can be rounded to a finer grid, where they meet in points; see [`constraints::snap`].
//!
//! ```
//! use incircle::constraints::snap;
//! use incircle::Point;
//!
//! let points = [(0, 0), (3, 3), (0, 2), (4, 0)].map(|(x, y)| Point::new(x, y));
//! let snapped = snap(&points, &[[0, 1], [2, 3]])?;
//! // The crossing (4/3, 4/3) is about (341.33, 341.33) on a grid that is 256 times finer.
//! assert_eq!((snapped.new_points, snapped.points[4]), (1, Point::new(341, 341)));
//! assert_eq!(snapped.constraints, [[0, 4], [4, 1], [2, 4], [4, 3]]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Edges that come and go
//!
//! A [`Triangulation`] keeps constraints while its points come, go and move.
//!
//! ```
//! use incircle::living::{Error, Triangulation};
//!
//! let mut mesh = Triangulation::from([[0, 0], [4, -1], [8, 0], [4, 1]])?;
//! let wall = mesh.insert_constraint(0, 2)?;
//! assert_eq!(mesh.mesh().triangles, [[0, 1, 2], [0, 2, 3]]);
//! let post = mesh.insert([4, 0])?; // on the constraint, which now has two pieces
//! assert_eq!(mesh.pieces().edges(), [[0, post], [2, post]]);
//! assert_eq!(mesh.delete(0), Err(Error::EndOfConstraint { index: 0, constraint: wall }));
//! mesh.remove_constraint(wall)?;
//! mesh.delete(0)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # With a device
//!
//! Open a [`Device`] when you want hardware, a model of it, another number of threads, or figures about the job. A
//! [`Session`] of the device takes any number of jobs, each with [`Options`]. The answer to a job is a [`Solution`]:
//! the mesh, and a [`Report`] of times and counters. A device stays on the thread that made it.
//!
//! ```
//! use incircle::{Device, Options, Order, Point, Solution};
//!
//! let points: Vec<Point> = (0..100).map(|k| Point::new(k * k % 83, k * 7 % 89)).collect();
//! let mut device = Device::open("model?coord-bits=12")?;
//! let mut session = device.session()?;
//! assert_eq!(session.identity().coord_bits, 12);
//! let options = Options::default().order(Order::Hilbert);
//! let Solution { mesh, report, .. } = session.triangulate_with(&points, &options)?;
//! assert_eq!(mesh.triangles.len(), 2 * report.distinct - 2 - mesh.hull.len());
//! assert_eq!(mesh, incircle::triangulate(&points)?);
//! # Ok::<(), incircle::Error>(())
//! ```
//!
//! # Several devices for one set
//!
//! A set that is too large for a device is cut into parts, and the host joins their meshes. A [`Fleet`] shares the
//! parts among several devices.
//!
//! ```
//! use incircle::{Fleet, Options, Point};
//!
//! let points: Vec<Point> = (0..5000).map(|k| Point::new(k * k % 8191, k * 7 % 8209)).collect();
//! let fleet = Fleet::open(&["clock?config=quad", "cpu?threads=1"])?;
//! let solution = fleet.triangulate(&points, &Options::default())?;
//! assert_eq!(solution.mesh, incircle::triangulate(&points)?);
//! assert_eq!(solution.report.shares.iter().map(|share| share.parts).sum::<usize>(), solution.report.parts);
//! # Ok::<(), incircle::Error>(())
//! ```
//!
//! # Which to reach for
//!
//! | you have | reach for |
//! |---|---|
//! | a set of points, whole numbers or floating-point ones | [`triangulate`] |
//! | floating-point values that a device is to take | [`quantize()`] first; its report says what rounding did |
//! | a board, a card or a model | [`Device::open`] with an address from [`DeviceAddress`], then [`Device::session`] |
//! | a time limit, a progress bar, a cancel button | [`Options`] with [`Session::triangulate_with`] |
//! | small sets one after the other, such as points that move | [`Triangulator`], which keeps its memory |
//! | points that come, go or move, or questions about places | [`Triangulation`], which changes with them |
//! | the same with the mesh on a device | [`Session::living`], with the trait [`LivingMesh`] |
//! | edges that must be in the mesh, or triangles inside polygons | [`Session::triangulate_constrained`] |
//! | the same for a mesh that there is already | [`constraints::constrain`] |
//! | the region nearest to each point, clipped to a polygon | [`voronoi`], with the mesh of grid points |
//! | grid points and a clip from points of any numbers | [`GridSet`] |
//! | cells as flat lists, for another language or a graphics card | [`VoronoiLists`] |
//! | points spread evenly over a region | [`lloyd::relax`], with grid points and a [`voronoi::Clip`] |
//! | values between points, such as heights | [`interpolate::Surface`], with the mesh of the points |
//! | the same on a device that answers where places lie | [`linear_values`] |
//! | many small sets at once | [`Session::triangulate_batch`]: a device works on them side by side |
//! | several devices for one set | [`Fleet`], which leaves out a device that dies |
//! | a `Vec` of points that you can hand over | [`Session::triangulate_owned`], which does not copy it |
//! | a mesh from elsewhere, to check | [`verify()`] |
//! | a simulator or a link of your own | [`Transport`] with [`Device::from_transport`] |
//!
//! # Cost and limits
//!
//! The CPU triangulator takes O(n) time on even sets and O(n w) at worst, with coordinates of `w` bits. At a million
//! points of 16 bits it takes at most 200 bytes a point beyond the points themselves. The CPU triangulator takes whole
//! numbers of up to 64 bits and all finite doubles; a device has its own number of bits, 16 for the standard cores, and
//! takes points whose [`Lattice`] fits them. A job may have up to [`MAX_POINTS`] points. A device holds as many
//! distinct ones as its [`Identity`] says, and does larger sets in parts. Voronoi cells ([`voronoi`]) are exact on
//! lattices of up to 31 bits.
//!
//! No set of points and no faulty device makes a call panic: every failure is an [`Error`], whose [`ErrorKind`] says
//! whose fault it is. Only the predicates of integers, called by themselves, need coordinates below 2^31.
//!
//! # Features
//!
//! - `geo-types`, off by default: [`triangulate`] and sessions also take points and coordinates of `geo-types` 0.7.
#![warn(missing_docs)]

mod commands;
mod device;
mod error;
mod grid_set;
mod job;
mod limit;
mod linear;
pub mod quantize;
pub mod transports;
mod voronoi_lists;

pub use device::{Device, DeviceAddress, Fleet, LivingMesh, LivingSession, Session};
pub use error::{ConstrainedError, DeviceFault, Error, ErrorKind, Shown, TransportError};
pub use grid_set::{GridSet, GridSetError};
pub use incircle_geometry::constraints;
pub use incircle_geometry::cpu::{Error as TriangulatorError, Triangulator};
pub use incircle_geometry::lattice::{Lattice, Step};
pub use incircle_geometry::living::{self, Triangulation};
pub use incircle_geometry::verify::{self, verify, VerifyError, VerifySummary};
pub use incircle_geometry::{double, interpolate, lloyd, orient2d, predicate, tiles, voronoi};
pub use incircle_geometry::{Duplicate, Mesh, Order, PlanePoint, Point};
pub use incircle_geometry::{UnknownOrder, EMPTY, MAX_POINTS};
pub use incircle_protocol::{Config, Identity};
pub use job::{Counters, Latencies, Options, Progress, ProgressListener, Report, Share, Solution, Stage};
pub use linear::linear_values;
pub use quantize::{quantize, Quantization, Quantize};
pub use transports::{pcie, serial, udp, Transport};
pub use voronoi_lists::{CellLists, VoronoiLists};

/// Orders of insertion, for programs that compare them.
///
/// A session chooses an order by its name, [`Order`], so most programs need none of these functions. The same set
/// always gets the same order, whatever the order of the input.
pub mod order {
    pub use crate::job::deal::{brio_hilbert_dealt, deal};
    pub use incircle_geometry::order::{brio_hilbert, hilbert, random, z_curve, Order, Rounds, UnknownOrder};
}

/// Triangulates a set of points with the CPU triangulator, on all processors if the set is large.
///
/// Points may be [`Point`]s, or pairs and arrays of `u32`, `i32`, `i64`, `f32` or `f64`: [`PlanePoint`] lists all
/// types, among them those of the crate `glam` and, with the feature `geo-types`, of the crate `geo-types`. Each
/// coordinate is taken as the exact number that it is. For another number of threads, a time limit or progress, open a
/// [`Device`] instead. The cost is O(n) on even sets, and O(n w) at worst with coordinates of `w` bits.
///
/// ```
/// let mesh = incircle::triangulate(&[(0, 0), (9, 0), (3, 5), (9, 9)])?;
/// assert_eq!(mesh.triangles, [[0, 1, 2], [1, 3, 2]]);
/// let tenths = incircle::triangulate(&[[-0.1, 0.1], [0.2, 0.1], [0.2, 0.4], [-0.1, 0.4]])?;
/// assert_eq!(tenths.triangles.len(), 2);
/// # Ok::<(), incircle::Error>(())
/// ```
///
/// # Errors
/// [`Error::NotFinite`] for a coordinate that is NaN or infinite, [`Error::TooManyPoints`] beyond [`MAX_POINTS`], and
/// [`Error::Timeout`] for a job that takes longer than [`Options::default_timeout`].
pub fn triangulate<P: PlanePoint>(points: &(impl AsRef<[P]> + ?Sized)) -> Result<Mesh<P>, Error> {
    Device::cpu(None).session()?.triangulate(points).map(|solution| solution.mesh)
}
