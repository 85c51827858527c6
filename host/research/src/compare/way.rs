//! What `bench orders` compares: orders of insertion, and points as they arrive.

use incircle::order::{Alpha, BrioDc, Curve};
use incircle::{Hierarchy, Order, Point, Report};

use crate::failure::Failure;
use crate::grid::failure_of;

/// A way to insert points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Way {
    /// In an order that is chosen when all points are known.
    Ordered(Order),
    /// One at a time as they arrive, found through a Delaunay hierarchy.
    Hierarchy,
}

/// The name of the way without an order.
const HIERARCHY: &str = "arrival-hierarchy";

impl Way {
    /// All names.
    pub fn names() -> impl Iterator<Item = &'static str> {
        Order::ALL.into_iter().map(Order::name).chain([HIERARCHY])
    }

    /// The way of this name.
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

    /// Random order, every curve, alone and in rounds, both variants of BrioDC, and points as they arrive.
    pub fn usual() -> Vec<Self> {
        let others = Curve::ALL.into_iter().filter(|&curve| curve != Curve::Hilbert);
        let along = others.flat_map(|curve| [Order::Along(curve), Order::Brio(curve, Alpha::Quarter)]);
        let guided = BrioDc::ALL.map(Order::BrioDc);
        let orders = [Order::Random, Order::Hilbert, Order::BrioHilbert].into_iter().chain(along).chain(guided);
        orders.map(Self::Ordered).chain([Self::Hierarchy]).collect()
    }
}

/// Inserts points as they come.
pub fn by_arrival(hierarchy: &mut Hierarchy, points: &[Point]) -> Result<Report, Failure> {
    let inserted = points.iter().try_for_each(|&point| hierarchy.insert(point).map(drop));
    let mesh = inserted.and_then(|()| hierarchy.mesh());
    mesh.map(|mesh| mesh.report).map_err(|error| failure_of(&error))
}
