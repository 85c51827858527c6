//! The orders of insertion by name.

use alloc::vec::Vec;
use core::fmt;
use core::str::FromStr;

use super::brio::brio_hilbert;
use super::hilbert::hilbert;
use super::random::random;
use crate::point::Point;

/// The order in which points reach the device. The mesh does not depend on it, the time does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Order {
    /// Rounds of growing random samples (a quarter of the points in all rounds but the last), each along a Hilbert
    /// curve. Good for every distribution: the default. See [`brio_hilbert`].
    #[default]
    BrioHilbert,
    /// One pass along a Hilbert curve: fast on even distributions, without a guarantee on others. See [`hilbert()`].
    Hilbert,
    /// As the points come.
    Input,
    /// Random, in an order that follows from the coordinates. See [`random()`].
    Random,
}

impl Order {
    /// All orders.
    pub const ALL: [Self; 4] = [Self::BrioHilbert, Self::Hilbert, Self::Input, Self::Random];
    /// The best, the plainest curve, and none.
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

    /// The points in this order: a permutation of `0..points.len()`.
    pub fn order(self, points: &[Point]) -> Vec<u32> {
        match self {
            Self::BrioHilbert => brio_hilbert(points),
            Self::Hilbert => hilbert(points),
            Self::Input => (0..=u32::MAX).take(points.len()).collect(),
            Self::Random => random(points),
        }
    }

    /// The order of this name; `None` if there is none.
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

/// A name that no order has. The message lists the names that there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UnknownOrder;

impl fmt::Display for UnknownOrder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [first, second, third, last] = Order::ALL.map(Order::name);
        write!(
            f,
            "the orders are '{first}', '{second}', '{third}' and '{last}'; the other curves, rounds and guides are in the \
             repository's package incircle-research"
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
