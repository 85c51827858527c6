//! BrioDC: biased randomised insertion with dependent choices, in which a nearest neighbour guides each point.
//!
//! Buchin and Mulzer, *Delaunay triangulations in O(sort(n)) time and more*, 2011; Schrijvers, van Bommel, Buchin,
//! *Delaunay triangulations on the word RAM*, 2012. Points are sorted along the Z-curve; a compressed quadtree over
//! them gives well-separated pairs, and these the nearest-neighbour graph. Each component of the graph has one pair of
//! points that are nearest to each other. A coin chooses one of the two for the sample, and a coin each decides for all
//! other points; the sample is ordered in the same way, by its own graph, down to a single point. What is not in the
//! sample is a round. In a round the points of a component come from its pair outwards, so that each comes after its
//! nearest neighbour: that one is its *guide*. It is a vertex already, no other vertex is nearer, and a walk from there
//! is short wherever the points lie.
//!
//! The paper leaves open which edge of a component is chosen, and lets the walk run along any of its edges; the pair
//! makes every guide a nearest neighbour. A component's sampled points are about half, so there are about log2 n
//! rounds, and all take about twice as long as the last.

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
    /// The points: a permutation of their indices.
    pub order: Vec<u32>,
    /// For each place of the order the index of a point before it, at which the search for this one begins; the first
    /// point guides itself.
    pub guides: Vec<u32>,
    /// The place at which each round begins.
    starts: Vec<usize>,
}

impl Guided {
    /// The order in rounds, and the guides, in which places of the order stand for points.
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

/// BRIO with dependent choices: each point is guided by its nearest neighbour among itself and the points of all
/// earlier rounds and of its own; of equally near ones, by the first along the Z-curve.
///
/// The order follows from the coordinates alone. Equal points stay together, in input order, and the first guides the
/// others. Exact for coordinates below 2^31; beyond, distances of 2^32 and more count as equally long. For up to 2^31
/// points. 0.25 µs per point for some hundred of them, 0.45 for a million, and 130 bytes while it runs.
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

/// The order of all points from that of groups of equal ones.
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

/// The rounds of distinct points in Z-order. Indices are places in that order.
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

/// Throws the coins: one of each pair of mutually nearest points is chosen, and each other point with probability 1/2.
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

/// Visits the points that are not chosen, each with its nearest neighbour and after it, unless that is chosen;
/// otherwise along the Z-curve.
fn outwards(nearest: &[u32], is_chosen: Vec<bool>, mut visit: impl FnMut(u32, u32)) {
    let mut is_in = is_chosen;
    let mut chain = Vec::new();
    for first in 0..nearest.len() as u32 {
        // The chain of nearest neighbours ends at the latest at the chosen point of the component's pair.
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
