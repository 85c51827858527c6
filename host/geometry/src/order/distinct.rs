//! Points without their duplicates.

use alloc::vec::Vec;

use super::hilbert::{along_curve, Hilbert};
use crate::point::{Duplicate, Point};
use crate::sort::Entry;

/// The distinct points along the Hilbert curve, each under its lowest index, and the duplicates sorted by index.
///
/// O(n), with 16 bytes a point while it runs, or 32 where a coordinate has more than 16 bits.
pub fn distinct(points: &[Point]) -> (Hilbert, Vec<Duplicate>) {
    let mut curve = along_curve(points);
    let mut duplicates = match &mut curve {
        Hilbert::Narrow(entries) => remove_duplicates(entries),
        Hilbert::Wide(entries) => remove_duplicates(entries),
    };
    duplicates.sort_unstable();
    (curve, duplicates)
}

/// Keeps the first entry of each key, which has the lowest index because the sort was stable, and returns the others.
fn remove_duplicates<E: Entry>(entries: &mut Vec<E>) -> Vec<Duplicate> {
    let mut duplicates = Vec::new();
    entries.dedup_by(|later, kept| {
        let equal = later.key() == kept.key();
        if equal {
            duplicates.push(Duplicate { index: later.value(), of: kept.value() });
        }
        equal
    });
    duplicates
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn each_place_keeps_its_lowest_index(
            raw in prop::collection::vec((0u32..6, 0u32..6), 0..60),
            shift in prop::sample::select(vec![0u32, 20]),
        ) {
            let points: Vec<Point> = raw.iter().map(|&(x, y)| Point::new(x << shift, y << shift)).collect();
            let (curve, duplicates) = distinct(&points);
            let mut indices = curve.into_indices();
            let lowest = |index: u32| {
                points.iter().position(|p| *p == points[index as usize]).map(|found| found as u32)
            };
            prop_assert!(indices.iter().all(|&index| lowest(index) == Some(index)));
            prop_assert!(duplicates.is_sorted_by_key(|duplicate| duplicate.index));
            prop_assert!(duplicates.iter().all(|duplicate| lowest(duplicate.index) == Some(duplicate.of)));
            indices.extend(duplicates.iter().map(|duplicate| duplicate.index));
            indices.sort_unstable();
            prop_assert!(indices.into_iter().eq(0..points.len() as u32));
        }
    }
}
