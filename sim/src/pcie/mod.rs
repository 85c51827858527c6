//! A card in a PCIe slot, as the driver XDMA shows it: three files, two of them streams that block.
//!
//! [`Card`] is the behaviour of the files, around any device that takes and gives [`Beats`], with the faults of a
//! [`CardFaultSpec`]. A test may use a `Card` directly. [`CardDirectory`] puts the files into a directory by means of a
//! file system in user space (FUSE), so that the system calls of a driver's user reach them. The program `incircle-sim`
//! serves such a directory.

mod beats;
mod card;
mod directory;
mod faults;
mod liar;
mod null;
mod pins;

pub use beats::Beats;
pub use card::{Card, CardFigures, Errno};
pub use directory::{CardDirectory, DirectoryError};
pub use faults::{CardFaultSpec, CardSpecError, Strike};
pub use liar::CardLie;
pub use null::NullDevice;
pub use pins::PinCard;
