//! The orders of insertion by name.

use alloc::vec::Vec;
use core::fmt;
use core::str::FromStr;

use super::brio::brio_hilbert;
use super::hilbert::hilbert;
use super::random::random;
use crate::point::Point;

/// The order in which points are inserted. The mesh does not depend on the order, but the time does.
///
/// Keep the default for points that come in no useful order. Choose [`Order::Input`] if neighbours in the input are
/// neighbours in the plane already, as in a scan; sorting is then saved. The CPU triangulator inserts nothing
/// and needs no order.
///
/// ```
/// use incircle_geometry::{Order, Point};
///
/// let points = [(9, 9), (0, 0), (1, 0)].map(Point::from);
/// assert_eq!(Order::Hilbert.order(&points).len(), 3);
/// assert_eq!("brio-hilbert".parse(), Ok(Order::default()));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Order {
    /// Rounds of growing random samples, each along a Hilbert curve; all rounds but the last have a quarter of the
    /// points together. The default. The expected sum of all cavities is O(n) for every set. See [`brio_hilbert`].
    #[default]
    BrioHilbert,
    /// One pass along a Hilbert curve: fast on even distributions, without a guarantee on others. See [`hilbert()`].
    Hilbert,
    /// The order of the input, without a guarantee.
    Input,
    /// A random order that follows from the coordinates, the classic one of textbooks. See [`random()`].
    Random,
}

impl Order {
    /// All four orders, the default first.
    pub const ALL: [Self; 4] = [Self::BrioHilbert, Self::Hilbert, Self::Input, Self::Random];
    /// The default order, the plain curve, and the order of the input, for comparisons.
    pub const BASIC: [Self; 3] = [Self::BrioHilbert, Self::Hilbert, Self::Input];

    /// The name in reports and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::BrioHilbert => "brio-hilbert",
            Self::Hilbert => "hilbert",
            Self::Input => "input",
            Self::Random => "random",
        }
    }

    /// Puts points into this order: returns a permutation of their indices, `0..points.len()`. O(n).
    pub fn order(self, points: &[Point]) -> Vec<u32> {
        match self {
            Self::BrioHilbert => brio_hilbert(points),
            Self::Hilbert => hilbert(points),
            Self::Input => (0..=u32::MAX).take(points.len()).collect(),
            Self::Random => random(points),
        }
    }

    /// Finds an order by its name; `None` if no order has it.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|order| order.name() == name)
    }
}

impl FromStr for Order {
    type Err = UnknownOrder;

    fn from_str(name: &str) -> Result<Self, UnknownOrder> {
        Self::named(name).ok_or(UnknownOrder)
    }
}

/// The error of a name that no order has. The message lists the names of the orders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnknownOrder;

impl fmt::Display for UnknownOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [first, second, third, last] = Order::ALL.map(Order::name);
        write!(
            f,
            "the orders are '{first}', '{second}', '{third}' and '{last}'; the other curves, rounds and guides are in \
             the repository's package incircle-research"
        )
    }
}

impl core::error::Error for UnknownOrder {}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn every_order_is_found_by_its_name() {
        for order in Order::ALL {
            assert_eq!(order.name().parse(), Ok(order));
        }
        assert_eq!(Order::ALL.iter().collect::<HashSet<_>>().len(), Order::ALL.len());
        assert_eq!(Order::named("spiral"), None);
    }

    #[test]
    fn other_names_are_refused_with_the_names_that_there_are() {
        for name in ["spiral", "brio-squarified-peano", "briodc-linear", "Hilbert", ""] {
            let refusal = name.parse::<Order>().expect_err("no order has this name").to_string();
            for part in ["'brio-hilbert'", "'hilbert'", "'input'", "'random'", "incircle-research"] {
                assert!(refusal.contains(part), "{refusal}");
            }
        }
    }
}
