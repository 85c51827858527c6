//! The cells that cores of many sizes take in each family of FPGAs, and the clock that they reach on an ECP5.
//!
//! [`measure`] runs the tools and [`page`] makes the tables of `docs/sizes.md` from the figures in `hdl/sizes.json`. A
//! core that a board lists takes its clock from the report of that board. Others are placed on the reference board, if
//! they fit.

mod family;
mod figures;
mod measure;
mod page;

pub use family::{Family, FamilyCells, FAMILIES};
pub use figures::{figures, size_name, Placed, Size, Sizes, SIZES};
pub use measure::{measure, SizesRequest};
pub use page::{page, page_path, renew_page};
