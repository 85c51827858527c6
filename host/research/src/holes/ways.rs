//! Ways to fill a hole. All give the canonical triangles.

use incircle_testkit::SplitMix64;

use super::patch::Patch;
use super::ring::{smallest_first, Ring, Tests, Triangle};

/// A way to fill a hole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Way {
    /// The triangle on an edge of the hole has the apex whose circle holds no other vertex; the triangle cuts the hole
    /// in two. This is what the library does.
    GiftWrapping,
    /// A corner is cut off where the circle of the corner and its neighbours holds no other vertex.
    Ears,
    /// Any corners are cut off until three are left, which flips the edges at the hub; then edges are flipped until the
    /// mesh is canonical (Lawson 1977).
    Flips,
    /// The neighbours are inserted again in random order, each beside its neighbours along the ring, so that nothing
    /// has to be located (Chew 1990).
    Insertion,
}

impl Way {
    pub(super) const ALL: [Self; 4] = [Self::GiftWrapping, Self::Ears, Self::Flips, Self::Insertion];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::GiftWrapping => "gift wrapping",
            Self::Ears => "ears",
            Self::Flips => "flips",
            Self::Insertion => "insertion",
        }
    }

    /// The multiplications of the tests. The view of an edge from a point takes four, and gives `orient2d` as well; the
    /// determinant of two views takes two. Gift wrapping and ears look at one edge from many points, and need one view
    /// for each; the other two ways look at another edge in each test.
    pub(super) fn multiplications(self, tests: Tests) -> u64 {
        match self {
            Self::GiftWrapping => 4 * tests.orient2d + 2 * tests.incircle,
            Self::Ears => 4 * tests.orient2d + 6 * tests.incircle,
            Self::Flips | Self::Insertion => 2 * tests.orient2d + 10 * tests.incircle,
        }
    }

    /// Fills the hole; the triangles are sorted.
    pub(super) fn fill(self, ring: &mut Ring, random: &mut SplitMix64) -> Vec<Triangle> {
        let mut triangles = match self {
            Self::GiftWrapping => gift_wrapping(ring),
            Self::Ears => ears(ring),
            Self::Flips => flips(ring),
            Self::Insertion => insertion(ring, random),
        };
        triangles.iter_mut().for_each(|triangle| *triangle = smallest_first(*triangle));
        triangles.sort_unstable();
        triangles
    }
}

fn gift_wrapping(ring: &mut Ring) -> Vec<Triangle> {
    let mut triangles = Vec::new();
    let mut parts = vec![(0, ring.len() - 1)];
    while let Some((first, last)) = parts.pop() {
        let mut apex = None;
        for place in first + 1..last {
            // One candidate needs no test.
            let is_left = last - first == 2 || ring.turns_left([last, first, place]);
            if is_left && apex.is_none_or(|apex| ring.conflicts([last, first, apex], place)) {
                apex = Some(place);
            }
        }
        let Some(apex) = apex else { continue };
        triangles.push([last, first, apex]);
        parts.extend([(first, apex), (apex, last)].into_iter().filter(|(first, last)| last - first > 1));
    }
    triangles
}

/// Cuts corners off until three are left, beginning again at the corner before each that was cut off.
fn cut(ring: &mut Ring, mut is_ear: impl FnMut(&mut Ring, &[usize], Triangle) -> bool) -> Vec<Triangle> {
    let mut left: Vec<usize> = (0..ring.len()).collect();
    let (mut triangles, mut place, mut refused) = (Vec::new(), 0, 0);
    while left.len() > 3 && refused < left.len() {
        let count = left.len();
        let corner = [place + count - 1, place, place + 1].map(|place| left[place % count]);
        if is_ear(ring, &left, corner) {
            triangles.push(corner);
            left.remove(place);
            (place, refused) = ((place + count - 1) % count % (count - 1), 0);
        } else {
            (place, refused) = ((place + 1) % count, refused + 1);
        }
    }
    triangles.extend(left.first_chunk::<3>());
    triangles
}

fn ears(ring: &mut Ring) -> Vec<Triangle> {
    cut(ring, |ring, left, corner| {
        let others = left.iter().filter(|place| !corner.contains(place));
        ring.turns_left(corner) && others.into_iter().all(|&place| !ring.conflicts(corner, place))
    })
}

fn flips(ring: &mut Ring) -> Vec<Triangle> {
    let triangles = cut(ring, |ring, _, corner| ring.turns_left(corner) && ring.has_hub_left(corner[0], corner[2]));
    let mut patch = Patch::default();
    triangles.into_iter().for_each(|triangle| patch.add(triangle));
    patch.flip_all(ring);
    patch.triangles()
}

fn insertion(ring: &mut Ring, random: &mut SplitMix64) -> Vec<Triangle> {
    let count = ring.len();
    let first = first_three(ring, random.below(count as u64) as usize);
    let mut patch = Patch::default();
    patch.add(first);
    let mut others: Vec<usize> = (0..count).filter(|place| !first.contains(place)).collect();
    random.shuffle(&mut others);
    // The places before and behind each along the ring at the time of its insertion, found by taking them out in the
    // opposite order.
    let (mut before, mut behind): (Vec<usize>, Vec<usize>) =
        (0..count).map(|place| ((place + count - 1) % count, (place + 1) % count)).unzip();
    for &place in others.iter().rev() {
        (behind[before[place]], before[behind[place]]) = (behind[place], before[place]);
    }
    for place in others {
        patch.insert(ring, place, [before[place], behind[place]]);
    }
    patch.triangles()
}

/// Three places with the hub between them: the start, the last one before half a turn, and the one behind that.
fn first_three(ring: &mut Ring, start: usize) -> Triangle {
    let count = ring.len();
    let (mut low, mut high) = (1, count - 1);
    while high - low > 1 {
        let middle = (low + high) / 2;
        // The hub is to the right of the way back from a place within half a turn.
        let is_within = !ring.has_hub_left((start + middle) % count, start);
        if is_within {
            low = middle;
        } else {
            high = middle;
        }
    }
    [start, (start + low) % count, (start + low + 1) % count]
}
