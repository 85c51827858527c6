//! Points laid onto the lattice that a device asks for.

use incircle_geometry::lattice::{Lattice, Numbers};
use incircle_geometry::{PlanePoint, Point};

use crate::error::Error;
use crate::quantize::check_finite;

/// The conditions that a device sets for points.
pub(super) struct Asked<'a> {
    pub(super) coord_bits: u32,
    /// Whether points need not lie on a lattice.
    pub(super) takes_all: bool,
    /// The name of the device.
    pub(super) device: &'a str,
}

/// Lays points onto their lattice. The numbers are those of the grid, unless there is no lattice and the device can do
/// without.
pub(super) fn lay<'p, P: PlanePoint>(
    points: &'p [P],
    Asked { coord_bits, takes_all, device }: Asked<'_>,
) -> Result<(Numbers<'p>, Option<Lattice>), Error> {
    let numbers = P::numbers(points);
    if let Numbers::Doubles(doubles) = &numbers {
        check_finite(doubles)?;
    }
    let device = || device.to_owned();
    let (numbers, lattice) = numbers.on_lattice();
    match (&numbers, lattice) {
        (Numbers::Grid(grid), Some(lattice)) if lattice.bits > coord_bits => {
            let outside = first_outside(grid, lattice, coord_bits);
            Err(outside.unwrap_or_else(|| Error::LatticeTooWide { lattice, coord_bits, device: device() }))
        }
        (_, None) if !takes_all => Err(Error::NoLattice { coord_bits, device: device() }),
        _ => Ok((numbers, lattice)),
    }
}

/// The error of the first grid point outside a device's grid; `None` if the points were laid onto the grid here, where
/// they have other coordinates than the caller knows.
fn first_outside(grid: &[Point], lattice: Lattice, coord_bits: u32) -> Option<Error> {
    if lattice != Lattice::of_grid(grid) {
        return None;
    }
    let index = grid.iter().position(|point| (point.x | point.y) >> coord_bits != 0)?;
    Some(Error::CoordinateOutOfRange { index, x: grid[index].x, y: grid[index].y, coord_bits })
}
