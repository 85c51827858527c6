//! The point types that can be triangulated.

use alloc::borrow::Cow;

use crate::lattice::Numbers;
use crate::point::Point;
use crate::site::FilteredSite;

mod sealed {
    use crate::site::Site;

    /// Keeps the trait to this crate: another implementation could not promise exactness.
    pub trait Sealed {
        /// The point in the numbers in which predicates are computed.
        type Site: Site;

        /// The site of the point.
        fn site(self) -> Self::Site;
    }
}

/// A type of points that can be triangulated: pairs, arrays and vectors of numbers.
///
/// No coordinate is ever rounded: those of [`Point`], `u32`, `i32` and `i64` are whole numbers, and `f32` and `f64` are
/// the binary numbers that they hold. If the points have a [`Lattice`](crate::lattice::Lattice), the triangulation
/// computes in its integers, else in the numbers as they were given.
///
/// The trait is implemented for [`Point`], and for `[T; 2]` and `(T, T)` where `T` is `u32`, `i32`, `i64`, `f32` or
/// `f64`. The feature `glam` adds `UVec2`, `IVec2`, `I64Vec2`, `Vec2` and `DVec2` of the crate `glam`. The feature
/// `geo-types` adds `Point<T>` and `Coord<T>` of the crate `geo-types` for the same `T`. The trait is sealed.
pub trait PlanePoint: Copy + sealed::Sealed {
    /// The points in the numbers that they are made of.
    fn numbers(points: &[Self]) -> Numbers<'_>;
}

/// The sites of the kinds of [`Numbers`], by the same names.
mod site_of {
    use crate::site::FilteredSite;

    pub type Grid = crate::point::Point;
    pub type Whole = FilteredSite<i64>;
    pub type Doubles = FilteredSite<f64>;
}

impl sealed::Sealed for Point {
    type Site = Self;

    #[inline(always)]
    fn site(self) -> Self {
        self
    }
}

impl PlanePoint for Point {
    fn numbers(points: &[Self]) -> Numbers<'_> {
        Numbers::Grid(Cow::Borrowed(points))
    }
}

/// Implements the trait for types of points, given how a point becomes one of the numbers.
macro_rules! plane_points {
    ($($kind:ident: $point:ty, $pattern:pat => $value:expr;)*) => {$(
        impl sealed::Sealed for $point {
            type Site = site_of::$kind;

            #[inline(always)]
            fn site(self) -> Self::Site {
                let $pattern = self;
                let value = $value;
                value.into()
            }
        }

        impl PlanePoint for $point {
            fn numbers(points: &[Self]) -> Numbers<'_> {
                Numbers::$kind(points.iter().map(|&$pattern| $value).collect())
            }
        }
    )*};
}

plane_points! {
    Grid: [u32; 2], [x, y] => Point::new(x, y);
    Grid: (u32, u32), (x, y) => Point::new(x, y);
    Whole: [i32; 2], [x, y] => [x.into(), y.into()];
    Whole: (i32, i32), (x, y) => [x.into(), y.into()];
    Whole: (i64, i64), (x, y) => [x, y];
    Doubles: [f32; 2], [x, y] => [x.into(), y.into()];
    Doubles: (f32, f32), (x, y) => [x.into(), y.into()];
    Doubles: (f64, f64), (x, y) => [x, y];
}

impl sealed::Sealed for [i64; 2] {
    type Site = FilteredSite<i64>;

    #[inline(always)]
    fn site(self) -> Self::Site {
        self.into()
    }
}

impl PlanePoint for [i64; 2] {
    fn numbers(points: &[Self]) -> Numbers<'_> {
        Numbers::Whole(Cow::Borrowed(points))
    }
}

impl sealed::Sealed for [f64; 2] {
    type Site = FilteredSite<f64>;

    #[inline(always)]
    fn site(self) -> Self::Site {
        self.into()
    }
}

impl PlanePoint for [f64; 2] {
    fn numbers(points: &[Self]) -> Numbers<'_> {
        Numbers::Doubles(Cow::Borrowed(points))
    }
}

#[cfg(feature = "glam")]
plane_points! {
    Grid: glam::UVec2, v => Point::new(v.x, v.y);
    Whole: glam::IVec2, v => [v.x.into(), v.y.into()];
    Whole: glam::I64Vec2, v => [v.x, v.y];
    Doubles: glam::Vec2, v => [v.x.into(), v.y.into()];
    Doubles: glam::DVec2, v => [v.x, v.y];
}

#[cfg(feature = "geo-types")]
plane_points! {
    Grid: geo_types::Coord<u32>, v => Point::new(v.x, v.y);
    Grid: geo_types::Point<u32>, v => Point::new(v.x(), v.y());
    Whole: geo_types::Coord<i32>, v => [v.x.into(), v.y.into()];
    Whole: geo_types::Point<i32>, v => [v.x().into(), v.y().into()];
    Whole: geo_types::Coord<i64>, v => [v.x, v.y];
    Whole: geo_types::Point<i64>, v => [v.x(), v.y()];
    Doubles: geo_types::Coord<f32>, v => [v.x.into(), v.y.into()];
    Doubles: geo_types::Point<f32>, v => [v.x().into(), v.y().into()];
    Doubles: geo_types::Coord<f64>, v => [v.x, v.y];
    Doubles: geo_types::Point<f64>, v => [v.x(), v.y()];
}
