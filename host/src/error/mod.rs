//! Everything that can go wrong, as typed errors. Each says in one sentence what happened, with the numbers, and what
//! to do about it.

mod constrained_error;
mod device_fault;
mod kind;
mod shown;
mod transport_error;

use std::error::Error as StdError;
use std::time::Duration;

pub use constrained_error::ConstrainedError;
pub use device_fault::DeviceFault;
pub(crate) use device_fault::{MAX_DEVICE_CONTEXTS, MAX_DEVICE_ENGINES};
pub use kind::ErrorKind;
pub use shown::Shown;
pub use transport_error::TransportError;

use incircle_geometry::lattice::Lattice;
use incircle_geometry::living::Error as LivingError;

/// An error of the library.
///
/// Print the error: its text is one sentence with the numbers and what to do. Match on the variant where a program can
/// do something about that case, or ask [`kind`](Self::kind) whose fault the error is.
///
/// ```
/// use incircle::{Device, Error, ErrorKind};
///
/// let mut device = Device::open("clock?config=tiny")?;
/// let error = device.session()?.triangulate(&[(0, 0), (65536, 5)]).expect_err("16 bits are the limit");
/// assert!(matches!(error, Error::CoordinateOutOfRange { index: 1, coord_bits: 16, .. }));
/// assert_eq!(error.kind(), ErrorKind::BadInput);
/// assert!(error.to_string().starts_with("point 1 is (65536, 5), but coordinates of 16 bits end at 65535"));
/// # Ok::<(), Error>(())
/// ```
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A coordinate does not fit the bits of the device.
    #[error(
        "point {index} is ({x}, {y}), but coordinates of {coord_bits} bits end at {max}: \
         use a device with more coordinate bits or quantise the points", max = (1u64 << coord_bits) - 1
    )]
    CoordinateOutOfRange {
        /// Input index of the point.
        index: usize,
        /// Horizontal coordinate of the point.
        x: u32,
        /// Vertical coordinate of the point.
        y: u32,
        /// Bits of a coordinate of the device.
        coord_bits: u32,
    },
    /// The lattice of the points has more bits than a coordinate of the device.
    #[error(
        "the points lie on a lattice with steps of {} and {} bits, but {device} has coordinates of {coord_bits} bits: \
         use the back end cpu or quantise the points", .lattice.step, .lattice.bits
    )]
    LatticeTooWide {
        /// The lattice of the points.
        lattice: Lattice,
        /// Bits of a coordinate of the device.
        coord_bits: u32,
        /// Name of the device.
        device: String,
    },
    /// The points lie on no lattice of up to 32 bits, and the device cannot do without.
    #[error(
        "the points lie on no lattice of up to 32 bits, and {device} has coordinates of {coord_bits} bits: \
         use the back end cpu, which takes all doubles, or quantise the points"
    )]
    NoLattice {
        /// Bits of a coordinate of the device.
        coord_bits: u32,
        /// Name of the device.
        device: String,
    },
    /// A value is NaN or infinite.
    #[error("the {axis} of point {index} is {value}, which is not a finite number: remove or correct the point")]
    NotFinite {
        /// Input index of the point.
        index: usize,
        /// Axis of the coordinate, `x` or `y`.
        axis: char,
        /// Value of the coordinate, in input units.
        value: f64,
    },
    /// A value has a fraction, but coordinates must be integers.
    #[error("the {axis} of point {index} is {}, which is not an integer: quantise the points", Shown(*value))]
    NotInteger {
        /// Input index of the point.
        index: usize,
        /// Axis of the coordinate, `x` or `y`.
        axis: char,
        /// Value of the coordinate, in input units.
        value: f64,
    },
    /// A value is outside the grid.
    #[error(
        "the {axis} of point {index} is {}, outside the grid of {coord_bits} bits, 0 to {max}: \
         quantise the points or use more coordinate bits", Shown(*value), max = (1u64 << coord_bits) - 1
    )]
    OutOfGrid {
        /// Input index of the point.
        index: usize,
        /// Axis of the coordinate, `x` or `y`.
        axis: char,
        /// The value, in grid units.
        value: f64,
        /// Bits of a coordinate.
        coord_bits: u32,
    },
    /// The bounding box is too small or too large for a scale in double precision.
    #[error(
        "the points span {} units, for which double precision has no scale onto the grid: scale the points first",
        Shown(*extent)
    )]
    Extent {
        /// Longer side of the bounding box, in input units.
        extent: f64,
    },
    /// A scale that is not a positive finite number, or an offset that is not finite.
    #[error(
        "the quantisation scale {} with offset ({}, {}) is unusable: give a positive finite scale and finite offsets",
        Shown(*scale), Shown(offset[0]), Shown(offset[1])
    )]
    Scale {
        /// Grid units per input unit.
        scale: f64,
        /// The input point that falls on the grid's origin.
        offset: [f64; 2],
    },
    /// A number of coordinate bits outside 1 to 31.
    #[error("{0} coordinate bits are not possible: choose 1 to 31")]
    CoordBits(u32),
    /// More points than any job may have.
    #[error("{points} points are more than the {max} that indices allow: cut the set into parts")]
    TooManyPoints {
        /// Number of points given.
        points: usize,
        /// Most points of a job.
        max: usize,
    },
    /// A place does not fit the bits of the device that has the mesh.
    #[error(
        "the place ({x}, {y}) is not on the grid of {device}, whose coordinates of {coord_bits} bits end at {max}: \
         use a device with more coordinate bits or quantise the points", max = (1u64 << coord_bits) - 1
    )]
    OffGrid {
        /// Horizontal coordinate of the place.
        x: u32,
        /// Vertical coordinate of the place.
        y: u32,
        /// Bits of a coordinate of the device.
        coord_bits: u32,
        /// Name of the device.
        device: String,
    },
    /// The device that has the mesh has no room for another place. The mesh is as before.
    #[error("all {capacity} places that {device} can hold have points: delete some, or use a larger device")]
    MemoryFull {
        /// Different places that the device can hold.
        capacity: u32,
        /// Name of the device.
        device: String,
    },
    /// The device cannot change a mesh that stands.
    #[error(
        "{device} cannot keep a mesh that lives: use the back end model or clock, a core with runs, or a \
         Triangulation, which is on the processor"
    )]
    NoRuns {
        /// Name of the device.
        device: String,
    },
    /// The device keeps no constraints in a mesh that lives.
    #[error(
        "{device} keeps no constraints in a mesh that lives: use a Triangulation, which keeps them on the processor"
    )]
    NoConstraints {
        /// Name of the device.
        device: String,
    },
    /// A change of a mesh that lives is refused. The mesh is as before.
    #[error(transparent)]
    Living(Box<LivingError>),
    /// No contexts, or more than the device has.
    #[error("{device} cannot work with {asked} contexts: choose {}, or leave the choice out", from_one_to(*contexts))]
    Contexts {
        /// Number of contexts asked for.
        asked: u32,
        /// Number of contexts that the device has.
        contexts: u32,
        /// Name of the device.
        device: String,
    },
    /// The software model refused its parameters.
    #[error("the software model cannot be made: {0}")]
    Model(String),
    /// The text is not the address of a device, or of one that the library cannot open.
    #[error("\"{address}\" is not a device address that this library can open: {reason}")]
    Address {
        /// Text that was given as an address.
        address: String,
        /// The reason, and what would be right.
        reason: String,
    },
    /// The device at the address cannot be opened.
    #[error("{device} cannot be opened: {source}")]
    Open {
        /// Name of the port or the card.
        device: String,
        /// The reason, and what to do.
        ///
        /// For a board this is a [`PortFault`](crate::serial::PortFault), for a card a
        /// [`CardFault`](crate::pcie::CardFault), which `downcast_ref` gives.
        source: Box<dyn StdError + Send + Sync>,
    },
    /// Words did not get through between the host and the device.
    #[error("the link to {device} failed during {during}: {source}")]
    Link {
        /// Name of the device.
        device: String,
        /// Noun for the command under way, such as `"the insertion"`.
        during: &'static str,
        /// The reason that the transport gives.
        source: TransportError,
    },
    /// The device did not answer in time.
    #[error(
        "{device} did not finish {during} within {}: allow a longer time, or check the device",
        within(*timeout, *ahead)
    )]
    Timeout {
        /// Name of the device.
        device: String,
        /// Noun for the command under way, such as `"the insertion"`.
        during: &'static str,
        /// Time that the device was given: in a batch that of this job, or that of all jobs that share it.
        timeout: Duration,
        /// Time that the device was given beyond that, for jobs of the batch that were sent ahead; otherwise 0.
        ahead: Duration,
    },
    /// The device gave an answer that no sound device gives.
    #[error(
        "{device} answered {during} wrongly: {fault}: reset the device, and if that does not help, do not trust it"
    )]
    Device {
        /// Name of the device.
        device: String,
        /// Noun for the command under way, such as `"the insertion"`.
        during: &'static str,
        /// The fault in the answer.
        fault: DeviceFault,
    },
    /// An earlier error left commands and answers out of step, so the session refuses further work.
    #[error("an earlier error left the link to {device} out of step: reset the device and open it again")]
    OutOfStep {
        /// Name of the device.
        device: String,
    },
    /// A job of a batch cannot be done.
    #[error("job {job} of the batch, counted from 0: {source}")]
    InJob {
        /// Index of the job in the batch, from 0.
        job: usize,
        /// The error of this job.
        source: Box<Error>,
    },
    /// The progress listener ended the job.
    #[error("the job was cancelled after {done} of {total} in the stage \"{stage}\"")]
    Cancelled {
        /// Name of the stage.
        stage: &'static str,
        /// Points or records done in this stage.
        done: usize,
        /// Points or records of this stage.
        total: usize,
    },
}

/// The numbers from 1 to `last` as a choice, for messages.
fn from_one_to(last: u32) -> String {
    if last == 1 {
        "1".to_owned()
    } else {
        format!("1 to {last}")
    }
}

impl From<LivingError> for Error {
    fn from(error: LivingError) -> Self {
        Self::Living(Box::new(error))
    }
}

impl Error {
    /// The kind of this error: whose fault it is.
    pub fn kind(&self) -> ErrorKind {
        match self {
            Self::CoordinateOutOfRange { .. }
            | Self::LatticeTooWide { .. }
            | Self::NoLattice { .. }
            | Self::NotFinite { .. }
            | Self::NotInteger { .. }
            | Self::OutOfGrid { .. }
            | Self::OffGrid { .. }
            | Self::Extent { .. } => ErrorKind::BadInput,
            Self::Living(error) => match **error {
                LivingError::TooManyPoints | LivingError::IndicesUsedUp => ErrorKind::Capacity,
                _ => ErrorKind::BadInput,
            },
            Self::Scale { .. }
            | Self::CoordBits(_)
            | Self::Contexts { .. }
            | Self::Model(_)
            | Self::NoRuns { .. }
            | Self::NoConstraints { .. } => ErrorKind::BadChoice,
            Self::Address { .. } | Self::Open { .. } => ErrorKind::DeviceNotFound,
            Self::Link { source: TransportError::Other { kind, .. }, .. } => *kind,
            Self::TooManyPoints { .. } | Self::MemoryFull { .. } => ErrorKind::Capacity,
            Self::Link { .. } | Self::OutOfStep { .. } => ErrorKind::Link,
            Self::Timeout { .. } => ErrorKind::Timeout,
            Self::Device { .. } => ErrorKind::Device,
            Self::Cancelled { .. } => ErrorKind::Cancelled,
            Self::InJob { source, .. } => source.kind(),
        }
    }
}

/// The time that a device was given, as [`Error::Timeout`] tells it.
fn within(timeout: Duration, ahead: Duration) -> String {
    let own = format!("{} s", timeout.as_secs_f64());
    if ahead.is_zero() {
        return own;
    }
    format!("{own} and {} s more for the jobs sent ahead", ahead.as_secs_f64())
}
