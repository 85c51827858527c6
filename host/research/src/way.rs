//! The ways of insertion that are compared: orders, and the hierarchy for points as they arrive.

use crate::order::{Alpha, BrioDc, Curve, Order};

/// A way to insert points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// Points are inserted in an order that is chosen when all points are known.
    Ordered(Order),
    /// Points are inserted one at a time as they arrive, through a Delaunay hierarchy.
    Hierarchy,
}

/// The name of the way without an order.
const HIERARCHY: &str = "arrival-hierarchy";

impl Way {
    /// The names of all ways.
    pub fn names() -> impl Iterator<Item = &'static str> {
        Order::all().into_iter().map(Order::name).chain([HIERARCHY])
    }

    /// Finds a way by its name; `None` if no way has it.
    pub fn named(name: &str) -> Option<Self> {
        let hierarchy = (name == HIERARCHY).then_some(Self::Hierarchy);
        hierarchy.or_else(|| Order::named(name).map(Self::Ordered))
    }

    /// The name in tables and on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Ordered(order) => order.name(),
            Self::Hierarchy => HIERARCHY,
        }
    }

    /// The ways that are compared by default: random order, every curve alone and in rounds, both variants of
    /// BrioDC, and the hierarchy.
    pub fn usual() -> Vec<Self> {
        let of_curve = |curve| [Order::Along(curve), Order::Brio(curve, Alpha::Quarter)];
        let orders = [Order::Random].into_iter().chain(Curve::ALL.into_iter().flat_map(of_curve));
        orders.chain(BrioDc::ALL.map(Order::BrioDc)).map(Self::Ordered).chain([Self::Hierarchy]).collect()
    }
}
