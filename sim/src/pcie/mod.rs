//! A card in a PCIe slot, as its driver XDMA shows it: three files, two of them streams that block.
//!
//! [`Card`] is what they do, around anything that takes and gives [`Beats`], with the faults of a [`CardFaultSpec`]. A test may call it as it
//! is. [`CardDirectory`] has the files in a directory of the system, so that a driver's own calls reach them: a file system in user space,
//! through FUSE. The program `incircle-sim` serves one.

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
