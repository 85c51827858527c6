//! The kernel of points whose predicates a floating-point filter decides before exact integers do: doubles, and
//! integers of more than 32 bits.

use core::cmp::Ordering;
use core::marker::PhantomData;

use bytemuck::Zeroable;

use super::kernel::{tie_is_inside, Ends, Kernel};
use super::view::level;
use crate::double::{incircle_of, orient2d_of, Bounds, Coordinate, View};
use crate::site::FilteredSite;

/// The kernel of points with coordinates of type `C`.
#[derive(Clone, Copy)]
pub(super) struct Filtered<C>(PhantomData<C>);

/// The place of a site in the tree of cuts: a cell of a grid over all points, and the rank among the points of that
/// cell in lexicographic order.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Zeroable)]
pub(super) struct Place {
    pub(super) cell: [u32; 2],
    pub(super) rank: u32,
}

/// The levels below those of the grid's cuts: an odd one for each bit of a rank.
const RANK_LEVELS: u32 = 2 * (u32::BITS + 1);

/// A site, and the base edge seen from it.
#[derive(Clone, Copy)]
pub(super) struct Seen<C> {
    site: FilteredSite<C>,
    view: View,
}

impl<C: Coordinate> Kernel for Filtered<C> {
    type Site = FilteredSite<C>;
    type Seen = Seen<C>;
    type Place = Place;
    type Bounds = Bounds;

    #[inline(always)]
    fn bounds<const N: usize>(sites: impl FnOnce() -> [FilteredSite<C>; N]) -> Bounds {
        Bounds::of(sites().map(|site| site.0))
    }

    #[inline(always)]
    fn swapped(site: FilteredSite<C>) -> FilteredSite<C> {
        FilteredSite([site.0[1], site.0[0]])
    }

    #[inline(never)]
    fn orient2d(a: FilteredSite<C>, b: FilteredSite<C>, c: FilteredSite<C>) -> Ordering {
        orient2d_of(a.0, b.0, c.0)
    }

    #[inline(always)]
    fn turn(Ends { a, b, bounds }: Ends<Self>, c: FilteredSite<C>) -> Ordering {
        bounds.side(View::of(a.0, b.0, c.0)).unwrap_or_else(|| Self::orient2d(a, b, c))
    }

    #[inline(always)]
    fn see(ends: Ends<Self>, site: FilteredSite<C>) -> Seen<C> {
        Seen { site, view: View::of(ends.a.0, ends.b.0, site.0) }
    }

    #[inline(always)]
    fn is_left(Ends { a, b, bounds }: Ends<Self>, seen: Seen<C>) -> bool {
        bounds.side(seen.view).unwrap_or_else(|| Self::orient2d(a, b, seen.site)).is_gt()
    }

    #[inline(always)]
    fn is_left_and_inside(ends: Ends<Self>, c: Seen<C>, q: Seen<C>) -> bool {
        ends.bounds.is_left_and_inside(c.view, q.view).unwrap_or_else(|| is_exactly_left_and_inside(ends, c, q))
    }

    #[inline(always)]
    fn level(one: Place, other: Place) -> u32 {
        let [x, y] = [one.cell[0] ^ other.cell[0], one.cell[1] ^ other.cell[1]];
        // Points of one cell are cut in lexicographic order, which is a vertical cut.
        if x | y == 0 {
            level(one.rank ^ other.rank, 0)
        } else {
            RANK_LEVELS + level(x, y)
        }
    }
}

/// The answer of `is_left_and_inside` if the bounds leave it open, by exact predicates.
#[inline(never)]
fn is_exactly_left_and_inside<C: Coordinate>(ends: Ends<Filtered<C>>, c: Seen<C>, q: Seen<C>) -> bool {
    let Ends { a, b, .. } = ends;
    // Around a vertex with two half-edges the vertex behind the candidate is the other end of the base edge.
    if q.site == a || q.site == b || !Filtered::is_left(ends, c) {
        return false;
    }
    match incircle_of(a.0, b.0, c.site.0, q.site.0) {
        Ordering::Greater => true,
        Ordering::Less => false,
        Ordering::Equal => tie_is_inside::<Filtered<C>>(a, b, c.site, q.site, Filtered::is_left(ends, q)),
    }
}
