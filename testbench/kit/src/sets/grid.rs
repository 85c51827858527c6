//! The grid on which points lie, and memory for them.

use std::fmt;

/// Numbers of coordinate bits that a grid can have.
pub const BITS: std::ops::RangeInclusive<u32> = 1..=31;

/// The reasons why a set cannot be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum GenerateError {
    /// Coordinate bits outside [`BITS`].
    Bits(u32),
    /// The memory cannot hold that many points.
    Memory(usize),
}

impl fmt::Display for GenerateError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Bits(bits) => {
                write!(f, "{bits} coordinate bits are not possible: choose 1 to 31")
            }
            Self::Memory(n) => write!(f, "there is no memory for {n} points of {POINT_BYTES} bytes: choose fewer"),
        }
    }
}

impl std::error::Error for GenerateError {}

/// Bytes that a point takes.
const POINT_BYTES: usize = size_of::<[u32; 2]>();

/// The points, or an error if there is no memory for them.
pub type Points = Result<Vec<[u32; 2]>, GenerateError>;

/// Returns an empty list with room for `n` points.
pub fn room(n: usize) -> Points {
    let mut points = Vec::new();
    match points.try_reserve_exact(n) {
        Ok(()) => Ok(points),
        Err(_) => Err(GenerateError::Memory(n)),
    }
}

/// The square grid on which points lie.
#[derive(Clone, Copy)]
pub struct Grid {
    /// Number of points along a side: 2^bits.
    pub size: u64,
}

impl Grid {
    /// Half of the side, in grid units.
    pub fn half(self) -> f64 {
        self.size as f64 / 2.0
    }

    /// The grid point below and left of this place, or `None` outside the grid.
    pub fn cell(self, x: f64, y: f64) -> Option<[u32; 2]> {
        let inside = |value: f64| value >= 0.0 && value < self.size as f64;
        (inside(x) && inside(y)).then_some([x as u32, y as u32])
    }

    /// The grid point nearest to this place, within the closed square of the grid.
    pub fn nearest(self, x: f64, y: f64) -> [u32; 2] {
        let last = (self.size - 1) as f64;
        [libm::rint(x).clamp(0.0, last) as u32, libm::rint(y).clamp(0.0, last) as u32]
    }
}
