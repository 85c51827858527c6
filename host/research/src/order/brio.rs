//! BRIO along any curve: rounds of growing random samples.

use incircle_geometry::order::{along_curve, rounds_of_share, Rounds};
use incircle_geometry::Point;

use super::alpha::Alpha;
use super::curve::Curve;

/// The biased randomized insertion order of this α with any curve in its rounds, as a permutation of `0..points.len()`.
///
/// The round of a point follows from a hash of its coordinates. Source: Amenta, Choi, Rote, *Incremental
/// constructions con BRIO*, 2003.
pub fn brio(points: &[Point], curve: Curve, alpha: Alpha) -> Vec<u32> {
    brio_rounds(points, curve, alpha).order
}

/// The order of [`brio`] with the places at which its rounds begin.
pub fn brio_rounds(points: &[Point], curve: Curve, alpha: Alpha) -> Rounds {
    let mut rounds = rounds_of_share(&along_curve(points), alpha.shift());
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
