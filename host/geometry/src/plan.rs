//! What is asked of a mesh: constraints, and the domain that they bound.

use core::fmt;
use core::str::FromStr;

/// Which triangles of a constrained mesh are wanted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Domain {
    /// All triangles of the hull.
    #[default]
    All,
    /// Those that constraints separate from the outside of the hull and from all holes, as in Shewchuk's Triangle.
    Holes,
    /// Those that an odd number of rings surround.
    EvenOdd,
    /// Those around which the rings run a number of times that is not zero, counter-clockwise counted up and clockwise
    /// counted down.
    NonZero,
}

impl Domain {
    /// All domains.
    pub const ALL: [Self; 4] = [Self::All, Self::Holes, Self::EvenOdd, Self::NonZero];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            Self::All => "all",
            Self::Holes => "holes",
            Self::EvenOdd => "even-odd",
            Self::NonZero => "non-zero",
        }
    }
}

impl fmt::Display for Domain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// A name that is none of a [`Domain`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a domain is all, holes, even-odd or non-zero")]
pub struct UnknownDomain;

impl FromStr for Domain {
    type Err = UnknownDomain;

    fn from_str(name: &str) -> Result<Self, UnknownDomain> {
        Self::ALL.into_iter().find(|domain| domain.name() == name).ok_or(UnknownDomain)
    }
}

/// Constraints and the domain that they bound. `M` is how holes and regions are given: as points, or as indices of
/// places behind the points of the mesh.
///
/// ```
/// use incircle_geometry::constraints::{Domain, Plan};
///
/// let square = [[0, 1], [1, 2], [2, 3], [3, 0]];
/// let plan = Plan { domain: Domain::EvenOdd, ..Plan::<[i32; 2]>::new(&square) };
/// assert_eq!(plan.constraints.len(), 4);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Plan<'a, M> {
    /// The constraints: pairs of indices of points. Their places in the list are their numbers.
    pub constraints: &'a [[u32; 2]],
    /// How many constraints at the end of the list bound nothing. They are edges of the mesh like all others, but no
    /// parts of rings: [`Domain::EvenOdd`] and [`Domain::NonZero`] do not count them.
    pub lines: usize,
    /// Which triangles are wanted.
    pub domain: Domain,
    /// A place in each hole of [`Domain::Holes`]. Other domains have no holes, and take no notice of these.
    pub holes: &'a [M],
    /// A place in each region whose number is wanted.
    pub regions: &'a [M],
}

impl<'a, M> Plan<'a, M> {
    /// The plan of all triangles of the hull with these constraints.
    pub fn new(constraints: &'a [[u32; 2]]) -> Self {
        Self { constraints, lines: 0, domain: Domain::All, holes: &[], regions: &[] }
    }

    /// Whether all triangles are wanted, and no region is named.
    pub(crate) fn takes_all(&self) -> bool {
        self.domain == Domain::All && self.regions.is_empty()
    }

    /// The number of constraints that bound the domain, which come before all lines.
    pub(crate) fn boundary(&self) -> usize {
        self.constraints.len().saturating_sub(self.lines)
    }
}

/// What a place inside a domain stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// A hole: the part of the hull around the place does not belong to the domain.
    Hole,
    /// A region: the part of the domain around the place gets the number of the region.
    Region,
}

impl fmt::Display for Mark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Hole => "hole",
            Self::Region => "region",
        })
    }
}
