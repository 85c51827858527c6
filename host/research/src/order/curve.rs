//! The curves by name. Each puts points into an order in which neighbours lie near each other.

use incircle_geometry::order::hilbert;

use super::alpha::Alpha;
use super::{adaptive, median, morton, peano, sierpinski, squarified};
use incircle_geometry::Point;

/// A curve that visits all points, piece by piece of the plane.
///
/// The first four run over a fixed square, however points lie in it. The others look at the points: they split where
/// the points are, or cut boxes into squares.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Curve {
    /// Hilbert's curve over the grid: quadrants without jumps.
    Hilbert,
    /// The Z-curve over the square around the points: quadrants with jumps.
    Morton,
    /// Peano's curve over the square around the points: nine squares without jumps.
    Peano,
    /// Sierpiński's closed curve over the square around the points: triangles without jumps.
    Sierpinski,
    /// Hilbert's quadrants as CGAL has them, split at the median x, then each half at its median y. The step across the
    /// middle can be long.
    MedianHilbert,
    /// Hilbert's quadrants, split at the median y, then each half at its median x, without a long step.
    HilbertYx,
    /// Hilbert's quadrants, split at the medians of x and y at once.
    AdaptiveHilbert,
    /// Peano's squares, split at the thirds of x and y at once.
    AdaptivePeano,
    /// Hilbert's quadrants of the box around each subset; long boxes are cut into squares.
    SquarifiedHilbert,
    /// Peano's squares of the box around each subset; long boxes are cut into squares.
    SquarifiedPeano,
    /// The curve of [`Self::SquarifiedHilbert`], but split into parts of equal numbers of points.
    SquarifiedAdaptiveHilbert,
    /// The curve of [`Self::SquarifiedPeano`], but split into parts of equal numbers of points.
    SquarifiedAdaptivePeano,
}

impl Curve {
    /// All twelve curves.
    pub const ALL: [Self; 12] = [
        Self::Hilbert,
        Self::Morton,
        Self::Peano,
        Self::Sierpinski,
        Self::MedianHilbert,
        Self::HilbertYx,
        Self::AdaptiveHilbert,
        Self::AdaptivePeano,
        Self::SquarifiedHilbert,
        Self::SquarifiedPeano,
        Self::SquarifiedAdaptiveHilbert,
        Self::SquarifiedAdaptivePeano,
    ];

    /// Puts points in the order of the curve: returns a permutation of `0..points.len()`. Equal points stay
    /// together, in any order.
    pub fn order(self, points: &[Point]) -> Vec<u32> {
        match self {
            Self::Hilbert => hilbert(points),
            Self::Morton => morton::order(points),
            Self::Peano => peano::order(points),
            Self::Sierpinski => sierpinski::order(points),
            Self::MedianHilbert => median::order(points, median::First::X),
            Self::HilbertYx => median::order(points, median::First::Y),
            Self::AdaptiveHilbert => adaptive::hilbert(points),
            Self::AdaptivePeano => adaptive::peano(points),
            Self::SquarifiedHilbert => squarified::hilbert(points, squarified::Split::Box),
            Self::SquarifiedPeano => squarified::peano(points, squarified::Split::Box),
            Self::SquarifiedAdaptiveHilbert => squarified::hilbert(points, squarified::Split::Points),
            Self::SquarifiedAdaptivePeano => squarified::peano(points, squarified::Split::Points),
        }
    }
}

/// Makes the names of a curve, alone and in rounds, from one text, so that the names cannot differ.
macro_rules! names {
    ($($curve:ident $name:literal),* $(,)?) => {
        impl Curve {
            /// The name in reports and on the command line.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$curve => $name,)*
                }
            }

            /// The name of BRIO with this share along the curve.
            pub const fn brio_name(self, alpha: Alpha) -> &'static str {
                match (self, alpha) {
                    $(
                        (Self::$curve, Alpha::Half) => concat!("brio-half-", $name),
                        (Self::$curve, Alpha::Quarter) => concat!("brio-", $name),
                        (Self::$curve, Alpha::Eighth) => concat!("brio-eighth-", $name),
                    )*
                }
            }
        }
    };
}

names! {
    Hilbert "hilbert",
    Morton "morton",
    Peano "peano",
    Sierpinski "sierpinski",
    MedianHilbert "median-hilbert",
    HilbertYx "hilbert-yx",
    AdaptiveHilbert "adaptive-hilbert",
    AdaptivePeano "adaptive-peano",
    SquarifiedHilbert "squarified-hilbert",
    SquarifiedPeano "squarified-peano",
    SquarifiedAdaptiveHilbert "squarified-adaptive-hilbert",
    SquarifiedAdaptivePeano "squarified-adaptive-peano",
}
