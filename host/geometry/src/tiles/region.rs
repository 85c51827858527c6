//! Regions: the rectangles into which tiles divide the plane.

/// A rectangle of the plane whose sides are parallel to the axes: all places with `west <= x < east` and
/// `south <= y < north`. A side that is `None` is infinitely far away.
///
/// A place on the west or the south side belongs to the region, and a place on the east or the north side belongs to
/// its neighbour. So regions that share sides share no place. The sides of grid points are whole numbers (`i64`), and
/// those of doubles are doubles.
///
/// ```
/// use incircle_geometry::tiles::Region;
///
/// let left = Region { east: Some(8), ..Region::WHOLE };
/// let right = Region { west: Some(8), ..Region::WHOLE };
/// assert!(left.contains([7, 0]) && right.contains([8, 0]));
/// assert_eq!(left.union(&right), Some(Region::WHOLE));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Region<C = i64> {
    /// The least x of the region.
    pub west: Option<C>,
    /// The least x beyond the region.
    pub east: Option<C>,
    /// The least y of the region.
    pub south: Option<C>,
    /// The least y beyond the region.
    pub north: Option<C>,
}

impl<C> Region<C> {
    /// The region of the whole plane, which has no sides.
    pub const WHOLE: Self = Self { west: None, east: None, south: None, north: None };
}

impl<C: Copy + PartialOrd> Region<C> {
    /// Whether a place lies in the region.
    #[inline(always)]
    pub fn contains(&self, [x, y]: [C; 2]) -> bool {
        let is_from = |low: Option<C>, value: C| low.is_none_or(|low| low <= value);
        let is_below = |high: Option<C>, value: C| high.is_none_or(|high| value < high);
        is_from(self.west, x) & is_below(self.east, x) & is_from(self.south, y) & is_below(self.north, y)
    }

    /// Whether no place of the other region lies beyond this one.
    pub fn covers(&self, other: &Self) -> bool {
        let is_from = |low: Option<C>, value: Option<C>| low.is_none() || low <= value;
        let is_to = |high: Option<C>, value: Option<C>| high.is_none() || value.is_some() && value <= high;
        is_from(self.west, other.west)
            && is_to(self.east, other.east)
            && is_from(self.south, other.south)
            && is_to(self.north, other.north)
    }

    /// Whether two regions may have a place in common: they are not on two sides of a vertical or horizontal line.
    pub fn overlaps(&self, other: &Self) -> bool {
        let is_past = |end: Option<C>, start: Option<C>| end.is_some() && start.is_some() && end <= start;
        !(is_past(self.east, other.west)
            || is_past(other.east, self.west)
            || is_past(self.north, other.south)
            || is_past(other.north, self.south))
    }

    /// The parts of the region west and east of the vertical line `x = at`. A place on the line is in the east.
    ///
    /// ```
    /// use incircle_geometry::tiles::Region;
    ///
    /// let [west, east] = Region::WHOLE.split_at_x(5);
    /// assert_eq!((west.east, east.west), (Some(5), Some(5)));
    /// ```
    pub fn split_at_x(&self, at: C) -> [Self; 2] {
        [Self { east: Some(at), ..*self }, Self { west: Some(at), ..*self }]
    }

    /// The parts of the region south and north of the horizontal line `y = at`. A place on the line is in the north.
    pub fn split_at_y(&self, at: C) -> [Self; 2] {
        [Self { north: Some(at), ..*self }, Self { south: Some(at), ..*self }]
    }

    /// The rectangle that two regions form together. `None` if they have no whole side in common.
    pub fn union(&self, other: &Self) -> Option<Self> {
        let meet = |end: Option<C>, start: Option<C>| end.is_some() && end == start;
        if (self.south, self.north) == (other.south, other.north) {
            let stacked = |left: &Self, right: &Self| {
                meet(left.east, right.west).then_some(Self { west: left.west, east: right.east, ..*left })
            };
            return stacked(self, other).or_else(|| stacked(other, self));
        }
        if (self.west, self.east) == (other.west, other.east) {
            let stacked = |low: &Self, high: &Self| {
                meet(low.north, high.south).then_some(Self { south: low.south, north: high.north, ..*low })
            };
            return stacked(self, other).or_else(|| stacked(other, self));
        }
        None
    }

    /// The rectangle that several regions form together, found by uniting two at a time: four quadrants, a row, the
    /// cells of a grid. `None` if there are no regions, or if some stage has no two regions with a whole side in
    /// common.
    ///
    /// O(k³) for `k` regions at worst, so this function is for the few children of one join.
    ///
    /// ```
    /// use incircle_geometry::tiles::Region;
    ///
    /// let [west, east] = [Region { east: Some(4), ..Region::WHOLE }, Region { west: Some(4), ..Region::WHOLE }];
    /// let halves = |half: Region| [Region { north: Some(9), ..half }, Region { south: Some(9), ..half }];
    /// let quadrants = [halves(west), halves(east)].concat();
    /// assert_eq!(Region::union_of(&quadrants), Some(Region::WHOLE));
    /// assert_eq!(Region::union_of(&quadrants[..3]), None);
    /// ```
    pub fn union_of(regions: &[Self]) -> Option<Self> {
        let mut left = regions.to_vec();
        while let Some(first) = left.pop() {
            if left.is_empty() {
                return Some(first);
            }
            // The region that was united last comes first, so a row or a stack is united in one pass.
            let with_first = left.iter().enumerate().find_map(|(place, other)| Some((place, first.union(other)?)));
            if let Some((place, both)) = with_first {
                left.swap_remove(place);
                left.push(both);
                continue;
            }
            let (one, other, both) = united_pair(&left)?;
            // `one < other`, so that the removal of `other` leaves `one` in its place.
            left.swap_remove(other);
            left[one] = both;
            left.push(first);
        }
        None
    }
}

/// The places of two regions that form a rectangle, the smaller place first, and this rectangle.
fn united_pair<C: Copy + PartialOrd>(regions: &[Region<C>]) -> Option<(usize, usize, Region<C>)> {
    let mut pairs = (0..regions.len()).flat_map(|other| (0..other).map(move |one| (one, other)));
    pairs.find_map(|(one, other)| Some((one, other, regions[one].union(&regions[other])?)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;

    fn cell([west, east]: [i64; 2], [south, north]: [i64; 2]) -> Region {
        Region { west: Some(west), east: Some(east), south: Some(south), north: Some(north) }
    }

    #[test]
    fn a_region_contains_its_west_and_south_side_alone() {
        let region = cell([2, 5], [0, 3]);
        for (x, y, is_inside) in [(2, 0, true), (4, 2, true), (5, 0, false), (2, 3, false), (1, 1, false)] {
            assert_eq!(region.contains([x, y]), is_inside, "({x}, {y})");
        }
        assert!(Region::WHOLE.contains([i64::MIN, i64::MAX]));
        assert!(!Region { west: Some(0.0), ..Region::WHOLE }.contains([f64::NAN, 0.0]));
    }

    #[test]
    fn only_neighbours_with_a_whole_common_side_have_a_union() {
        let middle = cell([2, 5], [0, 3]);
        assert_eq!(middle.union(&cell([5, 9], [0, 3])), Some(cell([2, 9], [0, 3])));
        assert_eq!(middle.union(&cell([0, 2], [0, 3])), Some(cell([0, 5], [0, 3])));
        assert_eq!(middle.union(&cell([2, 5], [3, 4])), Some(cell([2, 5], [0, 4])));
        assert_eq!(middle.union(&cell([2, 5], [-9, 0])), Some(cell([2, 5], [-9, 3])));
        let strangers = [middle, cell([6, 9], [0, 3]), cell([5, 9], [0, 4]), cell([5, 9], [3, 6]), Region::WHOLE];
        for other in strangers {
            assert_eq!(middle.union(&other), None, "{other:?}");
        }
    }

    #[test]
    fn regions_cover_their_parts_and_overlap_no_neighbour() {
        let middle = cell([2, 5], [0, 3]);
        for halves in [middle.split_at_x(3), middle.split_at_y(1), Region::WHOLE.split_at_x(0)] {
            let whole = Region::union_of(&halves).unwrap();
            for half in halves {
                assert!(whole.covers(&half) && !half.covers(&whole) && whole.overlaps(&half));
            }
            assert!(!halves[0].overlaps(&halves[1]) && !halves[1].overlaps(&halves[0]));
        }
        assert!(middle.covers(&middle) && Region::WHOLE.covers(&middle) && !middle.covers(&Region::WHOLE));
        assert!(middle.overlaps(&cell([4, 9], [2, 9])) && !middle.overlaps(&cell([5, 9], [0, 3])));
    }

    #[test]
    fn cells_of_a_grid_form_a_rectangle_in_any_order() {
        let cells: Vec<Region> =
            (0..4).flat_map(|x| (0..3).map(move |y| cell([x, x + 1], [2 * y, 2 * y + 2]))).collect();
        for step in [1, 5, 7, 11] {
            let turned: Vec<Region> = (0..12).map(|k| cells[k * step % 12]).collect();
            assert_eq!(Region::union_of(&turned), Some(cell([0, 4], [0, 6])), "every {step}th cell");
            assert_eq!(Region::union_of(&turned[1..]), None);
        }
        assert_eq!(Region::<i64>::union_of(&[]), None);
    }
}
