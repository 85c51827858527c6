//! Sorting in place with a few instructions and no stack: heapsort. The sort of the standard library is quicker and
//! takes 15 kB of flash.

/// Sorts by heapsort. Equal items may change places. O(n log n).
/// Source: Williams, *Algorithm 232: Heapsort*, 1964, with the heap built as by Floyd.
pub(crate) fn sort_by<T: Copy>(items: &mut [T], mut is_less: impl FnMut(T, T) -> bool) {
    for root in (0..items.len() / 2).rev() {
        sift_down(items, root, &mut is_less);
    }
    let mut heap = items;
    while let [first, .., last] = heap {
        core::mem::swap(first, last);
        let Some((_, rest)) = heap.split_last_mut() else { return };
        heap = rest;
        sift_down(heap, 0, &mut is_less);
    }
}

/// Lets the item at `root` sink until no child is larger.
fn sift_down<T: Copy>(heap: &mut [T], root: usize, is_less: &mut impl FnMut(T, T) -> bool) {
    let mut hole = root;
    loop {
        let left = 2 * hole + 1;
        let (Some(&item), Some(&first)) = (heap.get(hole), heap.get(left)) else { return };
        let second = heap.get(left + 1).copied();
        let (child, larger) = match second {
            Some(second) if is_less(first, second) => (left + 1, second),
            _ => (left, first),
        };
        if !is_less(item, larger) {
            return;
        }
        if let Some(place) = heap.get_mut(hole) {
            *place = larger;
        }
        if let Some(place) = heap.get_mut(child) {
            *place = item;
        }
        hole = child;
    }
}

#[cfg(test)]
mod tests {
    extern crate std;

    use super::*;
    use incircle_testkit::SplitMix64;
    use std::vec::Vec;

    #[test]
    fn lists_sort_like_those_of_the_standard_library() {
        let mut random = SplitMix64::new(4);
        for count in (0..70).chain([1000, 4096]) {
            let mut items: Vec<u32> = (0..count).map(|_| random.below_u32(1 + count / 2)).collect();
            let mut expected = items.clone();
            expected.sort_unstable();
            sort_by(&mut items, |a, b| a < b);
            assert_eq!(items, expected);
        }
    }
}
