//! BrioDC: biased randomized insertion with dependent choices, in which a nearest neighbour guides each point.
//!
//! Points are sorted along the Z-curve. A compressed quadtree over the sorted points gives well-separated pairs, and
//! the pairs give the nearest-neighbour graph. Each component of the graph has one pair of points that are nearest to
//! each other. A coin chooses one of the two for the sample, and one coin for each other point decides whether it is in
//! the sample. The sample is ordered in the same way, by its own graph, down to a single point. The points outside the
//! sample form a round. In a round the points of a component come from its pair outwards, so that each comes after its
//! nearest neighbour, which is its *guide*. The guide is a vertex already, no other vertex is nearer, and a walk from
//! the guide is short wherever the points lie.
//!
//! The paper leaves open which edge of a component is chosen, and lets the walk run along any of its edges. Choosing
//! the pair makes every guide a nearest neighbour. About half of the points are in the sample, so there are about log2
//! n rounds, and all rounds together take about twice as long as the last.
//!
//! Sources: Buchin and Mulzer, *Delaunay triangulations in O(sort(n)) time and more*, 2011; Schrijvers, van Bommel,
//! Buchin, *Delaunay triangulations on the word RAM*, 2012.

mod descent;
mod distance;
mod kind;
mod neighbors;
mod pairs;
mod quadtree;
mod z_order;

pub use kind::BrioDc;

use self::neighbors::Search;
use self::z_order::{along_z, Along};
use incircle_geometry::order::{mix, Rounds};
use incircle_geometry::pages::zeros;
use incircle_geometry::Point;

/// An order of insertion, with a guide for each point.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Guided {
    /// The order, as a permutation of the indices of the points.
    pub order: Vec<u32>,
    /// For each place of the order the index of an earlier point, at which the walk to this point begins. The
    /// first point guides itself.
    pub guides: Vec<u32>,
    /// The place at which each round begins.
    starts: Vec<usize>,
}

impl Guided {
    /// Splits the value into the order in rounds and the guides, which are then places of the order instead of indices.
    pub fn into_rounds(self) -> (Rounds, Vec<u32>) {
        let Self { order, mut guides, starts } = self;
        let mut place_of = vec![0; order.len()];
        for (place, &point) in (0..).zip(&order) {
            place_of[point as usize] = place;
        }
        guides.iter_mut().for_each(|guide| *guide = place_of[*guide as usize]);
        (Rounds { order, starts }, guides)
    }
}

/// The order of BRIO with dependent choices. The guide of a point is its nearest neighbour among the points of its own
/// round and of all earlier ones; among equally near points it is the first along the Z-curve.
///
/// The order follows from the coordinates alone. Equal points stay together, in input order, and the first of them
/// guides the others. The order is exact for coordinates below 2^31; with wider ones, distances of 2^32 and more count
/// as equal. There may be up to 2^31 points. The cost is 0.25 µs a point for some hundred points and 0.45 µs for a
/// million, with 130 bytes a point while the function runs.
pub fn brio_dc(points: &[Point], by: BrioDc) -> Guided {
    let Along { indices, points } = along_z(points, by);
    if points.windows(2).all(|pair| pair[0] != pair[1]) {
        let mut guided = rounds(points, by);
        let places = guided.order.iter_mut().chain(&mut guided.guides);
        places.for_each(|place| *place = indices[*place as usize]);
        return guided;
    }
    let mut rest = indices.as_slice();
    let groups: Vec<&[u32]> =
        points.chunk_by(|one, other| one == other).filter_map(|equal| rest.split_off(..equal.len())).collect();
    let mut distinct = points;
    distinct.dedup();
    repeat_equals(&rounds(distinct, by), &groups)
}

/// Turns the order of distinct points into the order of all points. Each distinct point stands for a
/// group of equal ones.
fn repeat_equals(distinct: &Guided, groups: &[&[u32]]) -> Guided {
    let mut all = Guided::default();
    let mut starts = distinct.starts.iter().peekable();
    for (place, (&group, &guide)) in distinct.order.iter().zip(&distinct.guides).enumerate() {
        if starts.next_if(|&&start| start == place).is_some() {
            all.starts.push(all.order.len());
        }
        let group = groups[group as usize];
        all.order.extend(group);
        all.guides.push(groups[guide as usize][0]);
        all.guides.extend(group.iter().skip(1).map(|_| group[0]));
    }
    all
}

/// The rounds of distinct points in Z-order. Indices are places in the Z-order.
fn rounds(points: Vec<Point>, by: BrioDc) -> Guided {
    let mut all = Guided { order: zeros(points.len()), guides: zeros(points.len()), starts: Vec::new() };
    let mut sample: Vec<u32> = (0..=u32::MAX).take(points.len()).collect();
    let mut points = points;
    let mut search = Search::with_room(points.len(), by);
    while sample.len() > 1 {
        let nearest = search.run(&points);
        let is_chosen = choose(&points, nearest, all.starts.len() as u32);
        let start = is_chosen.iter().filter(|&&is_chosen| is_chosen).count();
        let mut slots = all.order[start..].iter_mut().zip(&mut all.guides[start..]);
        outwards(nearest, is_chosen.clone(), |place, guide| {
            if let Some((own, before)) = slots.next() {
                (*own, *before) = (sample[place as usize], sample[guide as usize]);
            }
        });
        all.starts.push(start);
        keep(&mut sample, &is_chosen);
        keep(&mut points, &is_chosen);
    }
    if let [first] = *sample {
        (all.order[0], all.guides[0]) = (first, first);
        all.starts.push(0);
    }
    all.starts.reverse();
    all
}

fn keep<T>(items: &mut Vec<T>, is_chosen: &[bool]) {
    let mut chosen = is_chosen.iter();
    items.retain(|_| chosen.next() == Some(&true));
}

/// Throws the coins. One of each pair of mutually nearest points is chosen, and each other point with probability 1/2.
fn choose(points: &[Point], nearest: &[u32], round: u32) -> Vec<bool> {
    let bit = round % u64::BITS;
    let coin = |point: &Point| mix(u64::from(point.x) << 32 | u64::from(point.y)) >> bit & 1 == 0;
    let mut is_chosen: Vec<bool> = points.iter().map(coin).collect();
    for (place, &other) in (0..).zip(nearest) {
        if place < other && nearest[other as usize] == place {
            is_chosen[other as usize] = !is_chosen[place as usize];
        }
    }
    is_chosen
}

/// Visits the points that are not chosen, each with its nearest neighbour. A point comes after its nearest neighbour if
/// that one is visited as well; apart from that, points come along the Z-curve.
fn outwards(nearest: &[u32], is_chosen: Vec<bool>, mut visit: impl FnMut(u32, u32)) {
    let mut is_in = is_chosen;
    let mut chain = Vec::new();
    for first in 0..nearest.len() as u32 {
        // The chain of nearest neighbours always ends, at the latest at the chosen point of the component's pair.
        let mut place = first;
        while !std::mem::replace(&mut is_in[place as usize], true) {
            chain.push(place);
            place = nearest[place as usize];
        }
        while let Some(place) = chain.pop() {
            visit(place, nearest[place as usize]);
        }
    }
}

#[cfg(test)]
mod tests;
