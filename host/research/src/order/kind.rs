//! The orders of insertion by name.

use incircle_geometry::{order as product, Point};

use super::alpha::Alpha;
use super::brio::brio;
use super::brio_dc::{brio_dc, BrioDc};
use super::curve::Curve;

/// An order of insertion. The mesh does not depend on the order, but the time does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Order {
    /// The order of the input.
    Input,
    /// A random order that follows from the coordinates.
    Random,
    /// One pass along a curve.
    Along(Curve),
    /// Rounds of growing random samples, each along a curve. [`Curve::Hilbert`] and [`Alpha::Quarter`] make the default
    /// order of the library.
    Brio(Curve, Alpha),
    /// Rounds in which each point comes after its nearest neighbour, at which the walk to the point begins.
    BrioDc(BrioDc),
}

impl Order {
    /// The default order of the library: BRIO with a share of 1/4 along Hilbert's curve.
    pub const BRIO_HILBERT: Self = Self::Brio(Curve::Hilbert, Alpha::Quarter);

    /// All orders of insertion.
    pub fn all() -> Vec<Self> {
        let along = Curve::ALL.map(Self::Along);
        let rounds = Curve::ALL.into_iter().flat_map(|curve| Alpha::ALL.map(|alpha| Self::Brio(curve, alpha)));
        [Self::Input, Self::Random]
            .into_iter()
            .chain(along)
            .chain(rounds)
            .chain(BrioDc::ALL.map(Self::BrioDc))
            .collect()
    }

    /// The orders that are compared by default: random order, every curve alone and in rounds of a quarter, and both
    /// variants of BrioDC.
    pub fn usual() -> Vec<Self> {
        let of_curve = |curve| [Self::Along(curve), Self::Brio(curve, Alpha::Quarter)];
        let curves = Curve::ALL.into_iter().flat_map(of_curve);
        [Self::Random].into_iter().chain(curves).chain(BrioDc::ALL.map(Self::BrioDc)).collect()
    }

    /// The name in tables and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Input => "input",
            Self::Random => "random",
            Self::Along(curve) => curve.name(),
            Self::Brio(curve, alpha) => curve.brio_name(alpha),
            Self::BrioDc(by) => by.name(),
        }
    }

    /// Puts points into this order: returns a permutation of `0..points.len()`.
    pub fn order(self, points: &[Point]) -> Vec<u32> {
        match self {
            Self::Input => (0..=u32::MAX).take(points.len()).collect(),
            Self::Random => product::random(points),
            Self::Along(curve) => curve.order(points),
            Self::Brio(curve, alpha) => brio(points, curve, alpha),
            Self::BrioDc(by) => brio_dc(points, by).order,
        }
    }

    /// Finds an order by its name; `None` if no order has it.
    pub fn named(name: &str) -> Option<Self> {
        Self::all().into_iter().find(|order| order.name() == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn every_order_is_found_by_its_name() {
        let all = Order::all();
        for &order in &all {
            assert_eq!(Order::named(order.name()), Some(order));
        }
        assert_eq!(Order::named("brio-half-squarified-peano"), Some(Order::Brio(Curve::SquarifiedPeano, Alpha::Half)));
        assert_eq!(Order::named("briodc-log-u"), Some(Order::BrioDc(BrioDc::LogU)));
        assert_eq!(Order::named("brio-hilbert"), Some(Order::BRIO_HILBERT));
        assert_eq!(all.iter().collect::<HashSet<_>>().len(), all.len());
        assert_eq!(all.len(), 52);
        assert_eq!(Order::named("spiral"), None);
    }

    #[test]
    fn the_orders_of_the_product_are_among_them_under_the_same_names() {
        let points: Vec<Point> = (0..900).map(|k| Point::new(k * 7919 % 10_007, k * 104_729 % 9973)).collect();
        for order in incircle_geometry::Order::ALL {
            let same = Order::named(order.name()).expect("the name is here too");
            assert_eq!(same.order(&points), order.order(&points), "{}", order.name());
        }
    }
}
