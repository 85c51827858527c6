//! Orders of insertion.
//!
//! The mesh does not depend on the order, the time does: a point whose predecessor lies near is found in a few steps,
//! and random rounds keep any input from making many triangles that do not last.
//! Amenta, Choi, Rote, *Incremental constructions con BRIO*, 2003; Buchin, *Constructing Delaunay triangulations along
//! space-filling curves*, 2009; with guides, Buchin and Mulzer, *Delaunay triangulations in O(sort(n)) time and more*, 2011.
//!
//! Indices are 32 bits wide: points past the 2^32nd are left out.

mod adaptive;
mod brio_dc;
mod curve;
#[cfg(test)]
mod drawing;
mod median;
pub(crate) mod morton;
mod peano;
mod pieces;
mod random;
mod sierpinski;
mod squarified;

pub use brio_dc::{brio_dc, BrioDc, Guided};
pub use curve::Curve;

use crate::hilbert::{position_16, position_32};
use crate::point::Point;
use crate::sort::{sort_by_key, Entry, Narrow, Wide};

/// The first round of a biased order has at least about this many points.
const FIRST_ROUND: usize = 16;

/// The biased randomised order of α = 1/4 along a Hilbert curve: a permutation of `0..points.len()`.
///
/// The last round takes three quarters of the points, the round before it three quarters of the rest, down to about 16
/// points. Each round runs along the Hilbert curve of the grid. The round of a point follows from a hash of its
/// coordinates: the same set always gives the same order, however the input was arranged. Equal points stay together, in
/// input order. O(n), about 20 ns per point; twice that where a coordinate has more than 16 bits.
pub fn brio_hilbert(points: &[Point]) -> Vec<u32> {
    rounds(&along_curve(points)).order
}

/// The points in rounds, and how a device with several contexts gets them.
#[derive(Debug)]
pub(crate) struct Rounds {
    /// First round first.
    pub(crate) order: Vec<u32>,
    /// Where each round begins; the first begins at 0.
    pub(crate) starts: Vec<usize>,
    /// For each place one before it, whose point guides this one, or its own; empty where the order has no guides.
    pub(crate) guides: Vec<u32>,
}

impl Rounds {
    /// One round of points in this order.
    pub(crate) fn single(order: Vec<u32>) -> Self {
        Self { order, starts: vec![0], guides: Vec::new() }
    }

    /// Deals each round to the contexts of a device, so that every context runs along a stretch of the curve of its own and they
    /// work far apart.
    ///
    /// Context 0 takes the points before [`FIRST_ROUND`], and place `j` from there on belongs to context
    /// `(j - FIRST_ROUND) mod contexts`. The places of a round that belong to context `c` get the `c`-th stretch of the round.
    pub(crate) fn deal(self, contexts: u32) -> Vec<u32> {
        let Self { mut order, starts, .. } = self;
        let ends = starts.iter().skip(1).copied().chain([order.len()]);
        for (start, end) in starts.iter().copied().zip(ends) {
            let alone = (incircle_protocol::FIRST_ROUND as usize).clamp(start, end);
            deal_round(&mut order[alone..end], alone, contexts as usize);
        }
        order
    }
}

/// Deals a round that begins at place `first`.
fn deal_round(round: &mut [u32], first: usize, contexts: usize) {
    if contexts < 2 || round.is_empty() {
        return;
    }
    let along_curve = round.to_vec();
    let mut next = 0;
    for context in 0..contexts {
        let place = (first - incircle_protocol::FIRST_ROUND as usize) % contexts;
        let offset = (context + contexts - place) % contexts;
        for slot in round.iter_mut().skip(offset).step_by(contexts) {
            *slot = along_curve[next];
            next += 1;
        }
    }
}

/// The order in which a device with this many contexts gets the points: [`brio_hilbert`], each round cut into as many stretches,
/// dealt out in turn.
pub fn brio_hilbert_dealt(points: &[Point], contexts: u32) -> Vec<u32> {
    rounds(&along_curve(points)).deal(contexts)
}

/// The share of the points that all rounds but the last have together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Alpha {
    /// 1/2, as the authors have it: a coin is thrown for each point.
    Half,
    /// 1/4: fewer rounds, and still none that is much larger than all before it.
    #[default]
    Quarter,
    /// 1/8.
    Eighth,
}

impl Alpha {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Half, Self::Quarter, Self::Eighth];

    /// α is 2 to minus this.
    const fn shift(self) -> u32 {
        match self {
            Self::Half => 1,
            Self::Quarter => 2,
            Self::Eighth => 3,
        }
    }
}

/// The biased randomised order of this α with any curve in its rounds: a permutation of `0..points.len()`. The round of a point follows
/// from a hash of its coordinates.
///
/// Amenta, Choi, Rote, *Incremental constructions con BRIO*, 2003.
pub fn brio(points: &[Point], curve: Curve, alpha: Alpha) -> Vec<u32> {
    brio_rounds(points, curve, alpha).order
}

/// The rounds of [`brio`].
pub(crate) fn brio_rounds(points: &[Point], curve: Curve, alpha: Alpha) -> Rounds {
    let mut rounds = match along_curve(points) {
        Hilbert::Narrow(entries) => sort_into_rounds(&entries, alpha),
        Hilbert::Wide(entries) => sort_into_rounds(&entries, alpha),
    };
    if curve == Curve::Hilbert {
        return rounds;
    }
    let ends = rounds.starts.iter().skip(1).copied().chain([points.len()]);
    for (start, end) in rounds.starts.iter().copied().zip(ends) {
        let round = rounds.order[start..end].to_vec();
        let within: Vec<Point> = round.iter().map(|&index| points[index as usize]).collect();
        for (slot, place) in rounds.order[start..end].iter_mut().zip(curve.order(&within)) {
            *slot = round[place as usize];
        }
    }
    rounds
}

/// A random permutation of `0..points.len()`, which follows from the coordinates alone.
pub fn random(points: &[Point]) -> Vec<u32> {
    random::order(points)
}

/// One pass along the Hilbert curve: a permutation of `0..points.len()`. Equal points stay together, in input order.
pub fn hilbert(points: &[Point]) -> Vec<u32> {
    along_curve(points).into_indices()
}

/// Points sorted along the curve, in the smallest form that holds them.
pub(crate) enum Hilbert {
    /// Coordinates below 2^16: 8 bytes per point.
    Narrow(Vec<Narrow>),
    /// Any: 16 bytes per point.
    Wide(Vec<Wide>),
}

impl Hilbert {
    /// The indices along the curve.
    pub(crate) fn into_indices(self) -> Vec<u32> {
        match self {
            Self::Narrow(entries) => entries.iter().map(Entry::value).collect(),
            Self::Wide(entries) => entries.iter().map(Entry::value).collect(),
        }
    }
}

/// Sorts indices by position along the curve; equal positions are equal points, and stay in input order.
pub(crate) fn along_curve(points: &[Point]) -> Hilbert {
    let all = points.iter().fold(0, |all, point| all | point.x | point.y);
    if all < 1 << 16 {
        let mut entries: Vec<Narrow> = points
            .iter()
            .zip(0..=u32::MAX)
            .map(|(point, index)| Narrow::new(position_16(point.x, point.y), index))
            .collect();
        sort_by_key(&mut entries);
        Hilbert::Narrow(entries)
    } else {
        let mut entries: Vec<Wide> = points
            .iter()
            .zip(0..=u32::MAX)
            .map(|(point, index)| Wide::new(position_32(point.x, point.y), index))
            .collect();
        sort_by_key(&mut entries);
        Hilbert::Wide(entries)
    }
}

/// Deals points that are sorted along the curve into rounds.
pub(crate) fn rounds(curve: &Hilbert) -> Rounds {
    match curve {
        Hilbert::Narrow(entries) => sort_into_rounds(entries, Alpha::default()),
        Hilbert::Wide(entries) => sort_into_rounds(entries, Alpha::default()),
    }
}

/// Counting sort by round, first round first; the curve's order stays inside a round.
fn sort_into_rounds<E: Entry>(entries: &[E], alpha: Alpha) -> Rounds {
    let shift = alpha.shift();
    let level = |key: u64, last: usize| level(key, last, shift);
    let last = last_level(entries.len(), shift);
    let mut starts = [0usize; LEVELS];
    for entry in entries {
        starts[level(entry.key(), last)] += 1;
    }
    let mut sum = 0;
    for start in starts.iter_mut().rev() {
        sum += std::mem::replace(start, sum);
    }
    let mut order = vec![0; entries.len()];
    for entry in entries {
        let slot = &mut starts[level(entry.key(), last)];
        order[*slot] = entry.value();
        *slot += 1;
    }
    // By now each slot is the end of its level, which is where the round after it begins.
    let mut rounds = vec![0];
    rounds.extend((1..=last).rev().map(|level| starts[level]));
    Rounds { order, starts: rounds, guides: Vec::new() }
}

/// Levels there can be: the trailing zeros of a 64-bit hash, and all of them zero.
const LEVELS: usize = u64::BITS as usize + 1;

/// How many levels below the last round `points` points have.
fn last_level(points: usize, shift: u32) -> usize {
    let mut level = 0;
    let mut sample = points >> shift;
    while sample >= FIRST_ROUND {
        level += 1;
        sample >>= shift;
    }
    level
}

/// The level of a point: 0 is the last round, and one in 2^`shift` reaches the next level.
fn level(key: u64, last: usize, shift: u32) -> usize {
    ((mix(key).trailing_zeros() / shift) as usize).min(last)
}

/// A fixed hash: the output function of the SplitMix64 generator (Steele, Lea, Flood 2014), at the state `key`
/// steps from 0.
pub(crate) fn mix(key: u64) -> u64 {
    let z = key.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ z >> 30).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ z >> 27).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ z >> 31
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn lattice(side: u32, step: u32) -> Vec<Point> {
        (0..side * side).map(|k| Point::new(k / side * step, k % side * step)).collect()
    }

    #[test]
    fn a_quarter_of_a_lattice_comes_before_the_last_round() {
        let points = lattice(64, 1000);
        let curve = along_curve(&points);
        let Hilbert::Narrow(entries) = &curve else {
            panic!("16-bit points take the narrow form");
        };
        let last = last_level(points.len(), 2);
        assert_eq!(last, 4);
        let early = entries.iter().filter(|e| level(crate::sort::Keyed::key(*e), last, 2) > 0).count();
        assert!((900..1150).contains(&early), "{early} of 4096 before the last round");
    }

    #[test]
    fn the_order_follows_from_the_set_alone() {
        let points = lattice(40, 7);
        let mut reversed = points.clone();
        reversed.reverse();
        let in_order =
            |points: &[Point]| -> Vec<Point> { brio_hilbert(points).iter().map(|&i| points[i as usize]).collect() };
        assert_eq!(in_order(&points), in_order(&reversed));
    }

    #[test]
    fn a_context_gets_a_stretch_of_each_round() {
        let points = lattice(40, 7);
        for contexts in 1..=incircle_protocol::MAX_CONTEXTS {
            for single in [false, true] {
                let undealt = || match single {
                    true => Rounds::single(hilbert(&points)),
                    false => rounds(&along_curve(&points)),
                };
                let Rounds { order, starts, .. } = undealt();
                let dealt = undealt().deal(contexts);
                assert_eq!(dealt[..FIRST_ROUND], order[..FIRST_ROUND]);
                assert_eq!(starts.len(), if single { 1 } else { 4 });
                for (round, &start) in starts.iter().enumerate() {
                    let end = starts.get(round + 1).copied().unwrap_or(order.len());
                    let places = || start.max(FIRST_ROUND)..end;
                    let belongs = |place: usize| (place - FIRST_ROUND) as u32 % contexts;
                    let stretches = (0..contexts).flat_map(|context| places().filter(move |&j| belongs(j) == context));
                    let along: Vec<u32> = stretches.map(|place| dealt[place]).collect();
                    assert_eq!(along, order[places()], "{contexts} contexts, round {round}");
                }
            }
        }
    }

    #[test]
    fn short_sets_and_one_context_are_not_dealt() {
        let points = lattice(4, 9);
        assert_eq!(brio_hilbert_dealt(&points, 24), brio_hilbert(&points));
        let points = lattice(30, 9);
        assert_eq!(brio_hilbert_dealt(&points, 1), brio_hilbert(&points));
        assert_ne!(brio_hilbert_dealt(&points, 2), brio_hilbert(&points));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]

        #[test]
        fn every_order_is_a_permutation_and_keeps_equal_points_together(
            raw in prop::collection::vec((any::<u32>(), any::<u32>()), 0..300),
            (wide, high) in (0u32..32, 0u32..32),
        ) {
            let cut = |value: u32, bits: u32| if bits == 0 { 0 } else { value >> (32 - bits) };
            let points: Vec<Point> = raw.iter().map(|&(x, y)| Point::new(cut(x, wide), cut(y, high))).collect();
            let along = Curve::ALL.map(|curve| curve.order(&points));
            let rounds = Curve::ALL.into_iter().flat_map(|c| Alpha::ALL.map(|alpha| brio(&points, c, alpha)));
            let guided = BrioDc::ALL.map(|by| brio_dc(&points, by).order);
            for order in along.into_iter().chain(rounds).chain(guided).chain([random(&points)]) {
                let mut seen = std::collections::HashSet::new();
                for pair in order.chunk_by(|&one, &other| points[one as usize] == points[other as usize]) {
                    prop_assert!(seen.insert(points[pair[0] as usize]), "{} comes twice", points[pair[0] as usize]);
                }
                let mut sorted = order;
                sorted.sort_unstable();
                prop_assert!(sorted.iter().copied().eq(0..points.len() as u32));
            }
        }
    }

    proptest! {
        #[test]
        fn dealt_orders_are_permutations(
            raw in prop::collection::vec((0u32..1 << 16, 0u32..1 << 16), 0..1500),
            contexts in 1u32..25,
        ) {
            let points: Vec<Point> = raw.into_iter().map(Point::from).collect();
            let guided = brio_dc(&points, BrioDc::Linear).into_rounds().deal(contexts);
            for mut dealt in [brio_hilbert_dealt(&points, contexts), Rounds::single(hilbert(&points)).deal(contexts), guided] {
                dealt.sort_unstable();
                prop_assert!(dealt.iter().copied().eq(0..points.len() as u32));
            }
        }

        #[test]
        fn both_orders_are_permutations(
            raw in prop::collection::vec((any::<u32>(), any::<u32>()), 0..1500),
            bits in 1u32..32,
        ) {
            let points: Vec<Point> = raw.iter().map(|&(x, y)| Point::new(x >> (32 - bits), y >> (32 - bits))).collect();
            for order in [brio_hilbert(&points), hilbert(&points)] {
                let mut sorted = order;
                sorted.sort_unstable();
                prop_assert!(sorted.iter().copied().eq(0..points.len() as u32));
            }
        }

        #[test]
        fn neighbours_in_the_last_round_are_near(seed in any::<u64>()) {
            let points: Vec<Point> = (0..4096u64)
                .map(|k| mix(seed ^ k << 40))
                .map(|h| Point::new(h as u32 & 0xffff, (h >> 32) as u32 & 0xffff))
                .collect();
            let order = brio_hilbert(&points);
            let step = |pair: &[u32]| {
                let (a, b) = (points[pair[0] as usize], points[pair[1] as usize]);
                u64::from(a.x.abs_diff(b.x) + a.y.abs_diff(b.y))
            };
            let sum: u64 = order[2048..].windows(2).map(step).sum();
            prop_assert!(sum / 2047 < 3000, "mean step {}", sum / 2047);
        }
    }
}
