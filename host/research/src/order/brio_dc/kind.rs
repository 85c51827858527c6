//! The two algorithms for the nearest-neighbour graph.

/// The algorithm that finds the nearest-neighbour graph. Both give the same order in different times.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BrioDc {
    /// O(n): radix sort, quadtree in one pass, descent of points through the tree (Callahan and Kosaraju 1995).
    Linear,
    /// O(n log U) for coordinates below U, with simpler stages: sort by comparison, quadtree from the top by bisection,
    /// a look at all points of a pair (Har-Peled 2011).
    LogU,
}

impl BrioDc {
    /// Both algorithms.
    pub const ALL: [Self; 2] = [Self::Linear, Self::LogU];

    /// The name in reports and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Linear => "briodc-linear",
            Self::LogU => "briodc-log-u",
        }
    }
}
