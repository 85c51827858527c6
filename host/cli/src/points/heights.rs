//! The z of the points of a file. A set has z only if all its points have one.

/// The z of the points so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Heights {
    /// The z of the first points, up to the first one that has none.
    list: Vec<f64>,
    /// The index of the first point that has no z, if the format can have one.
    first_without: Option<usize>,
    /// Whether a point has a z.
    has_some: bool,
}

impl Heights {
    /// The z of all points, or none.
    pub(super) fn of(list: Vec<f64>) -> Self {
        Self { list, first_without: None, has_some: false }
    }

    /// Notes the z of the next point.
    pub(super) fn push(&mut self, height: f64) {
        self.has_some = true;
        if self.first_without.is_none() {
            self.list.push(height);
        }
    }

    /// Notes that the point at this index has no z.
    pub(super) fn skip(&mut self, index: usize) {
        self.first_without.get_or_insert(index);
    }

    /// The z of all `points` points; empty unless all have one.
    pub(super) fn of_all(&self, points: usize) -> &[f64] {
        if self.first_without.is_none() && self.list.len() == points {
            &self.list
        } else {
            &[]
        }
    }

    /// The index of the first point without a z, if others have one.
    pub(super) fn missing(&self) -> Option<usize> {
        self.first_without.filter(|_| self.has_some)
    }

    /// The z of `points` points, followed by those of the `others` points of another list.
    pub(super) fn followed_by(&self, points: usize, other: &Self, others: usize) -> Self {
        let (own, theirs) = (self.of_all(points), other.of_all(others));
        let mut all = Self::of([own, theirs].concat());
        (all.first_without, all.has_some) = (self.first_without, self.has_some);
        let some_have = self.has_some || other.has_some || !all.list.is_empty();
        if all.list.len() < points + others && some_have {
            let first = if own.len() < points { 0 } else { points };
            let of_other = other.first_without.map(|index| points + index);
            all.first_without = self.first_without.or(of_other).or(Some(first));
            all.has_some = true;
        }
        all
    }
}
