//! The living points by index, and the indices of each place.

use std::collections::{BTreeMap, BTreeSet};

use incircle_geometry::living::Error;
use incircle_geometry::{Duplicate, Point, MAX_POINTS};

/// The living points, and where each place is in the device.
#[derive(Default)]
pub(super) struct Names {
    points: BTreeMap<u32, Point>,
    places: BTreeMap<Point, Place>,
    next: u32,
}

/// A place with at least one living point.
pub(super) struct Place {
    /// The vertex of the device; without meaning while the device has no mesh.
    pub(super) vertex: u32,
    indices: BTreeSet<u32>,
}

impl Place {
    /// The index that names the place: the lowest.
    pub(super) fn name(&self) -> u32 {
        self.indices.first().copied().unwrap_or(u32::MAX)
    }

    /// Whether several points have the place.
    pub(super) fn is_shared(&self) -> bool {
        self.indices.len() > 1
    }
}

impl Names {
    /// The index that the next point will have.
    pub(super) fn next(&self) -> u32 {
        self.next
    }

    /// The index for another point, if one is left.
    pub(super) fn new_index(&self) -> Result<u32, Error> {
        match self.next {
            u32::MAX => Err(Error::IndicesUsedUp),
            _ if self.points.len() >= MAX_POINTS => Err(Error::TooManyPoints),
            index => Ok(index),
        }
    }

    /// The point of a living index.
    pub(super) fn point(&self, index: u32) -> Result<Point, Error> {
        self.points.get(&index).copied().ok_or(match self.next {
            next if index < next => Error::Deleted { index },
            next => Error::Unknown { index, next },
        })
    }

    pub(super) fn place(&self, point: Point) -> Option<&Place> {
        self.places.get(&point)
    }

    /// All places in lexicographic order.
    pub(super) fn places(&self) -> &BTreeMap<Point, Place> {
        &self.places
    }

    /// The living indices in rising order.
    pub(super) fn indices(&self) -> Vec<u32> {
        self.points.keys().copied().collect()
    }

    /// Puts an index at a point; `vertex` is that of the device if the place is new.
    pub(super) fn put(&mut self, index: u32, point: Point, vertex: u32) {
        self.points.insert(index, point);
        let new = || Place { vertex, indices: BTreeSet::new() };
        self.places.entry(point).or_insert_with(new).indices.insert(index);
        self.next = self.next.max(index + 1);
    }

    /// Takes a living index away from its point.
    pub(super) fn take(&mut self, index: u32) {
        let Some(point) = self.points.remove(&index) else {
            return;
        };
        if let Some(place) = self.places.get_mut(&point) {
            place.indices.remove(&index);
            if place.indices.is_empty() {
                self.places.remove(&point);
            }
        }
    }

    /// Notes the vertex of a place.
    pub(super) fn set_vertex(&mut self, point: Point, vertex: u32) {
        if let Some(place) = self.places.get_mut(&point) {
            place.vertex = vertex;
        }
    }

    /// The living points in the order of their indices, and the duplicates among them, by their ranks in that order.
    pub(super) fn ranked(&self) -> (Vec<Point>, Vec<Duplicate>) {
        let ranks: BTreeMap<u32, u32> = self.points.keys().copied().zip(0..).collect();
        let rank = |index: u32| ranks.get(&index).copied().unwrap_or(u32::MAX);
        let mut duplicates: Vec<Duplicate> = Vec::new();
        for place in self.places.values().filter(|place| place.is_shared()) {
            let of = rank(place.name());
            duplicates.extend(place.indices.iter().skip(1).map(|&index| Duplicate { index: rank(index), of }));
        }
        duplicates.sort_unstable();
        (self.points.values().copied().collect(), duplicates)
    }

    /// The rank of the name of each place, in the order of the places.
    pub(super) fn place_ranks(&self) -> Vec<u32> {
        let indices = self.indices();
        let rank = |place: &Place| indices.binary_search(&place.name()).map_or(u32::MAX, |rank| rank as u32);
        self.places.values().map(rank).collect()
    }
}
