//! The two ways to the nearest-neighbour graph.

/// How the nearest-neighbour graph is found. Both give the same order; only the time to find it differs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BrioDc {
    /// In O(n): radix sort, quadtree in one pass, points carried down the tree (Callahan and Kosaraju 1995).
    Linear,
    /// In O(n log U) for coordinates below U, with simpler stages: sort by comparison, quadtree from the top by
    /// bisection, all points of a pair looked at (Har-Peled 2011).
    LogU,
}

impl BrioDc {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Linear, Self::LogU];

    /// The name in reports and on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Linear => "briodc-linear",
            Self::LogU => "briodc-log-u",
        }
    }
}
