//! The features of an image: where they are, and what becomes of them from one frame to the next.

use std::collections::BTreeMap;
use std::fmt;

use incircle_geometry::Point;
use incircle_testkit::SplitMix64;

use super::arguments::TracksArguments;

/// The size of the image in pixels. Features are found to 1/32 of a pixel, which makes coordinates of 16 bits.
const IMAGE: [u32; 2] = [1920, 1080];
const STEPS: u32 = 32;
/// One of so many features vanishes in each frame, and another appears.
const LIFE: u64 = 60;

/// How features drift from one frame to the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion {
    /// One of so many features drifts.
    pub one_in: u64,
    /// The longest drift along each axis.
    pub pixels: f64,
}

impl fmt::Display for Motion {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let pixels = self.pixels;
        match self.one_in {
            1 => write!(f, "all by up to {pixels} px"),
            one_in => write!(f, "one in {one_in} by up to {pixels} px"),
        }
    }
}

/// What happens in a frame.
#[derive(Debug, Default)]
pub(super) struct Frame {
    pub moves: Vec<(u32, Point)>,
    pub gone: Vec<u32>,
    pub new: Vec<Point>,
    pub places: Vec<Point>,
}

pub(super) struct Scene {
    motion: Motion,
    random: SplitMix64,
    /// The place of each living feature, by its index.
    features: BTreeMap<u32, Point>,
    next_index: u32,
    count: u32,
    places: u32,
}

impl Scene {
    pub(super) fn new(arguments: &TracksArguments, motion: Motion) -> Self {
        let random = SplitMix64::new(arguments.seed);
        let (count, places) = (arguments.n, arguments.places);
        Self { motion, random, features: BTreeMap::new(), next_index: 0, count, places }
    }

    /// The features before the first frame.
    pub(super) fn first(&mut self) -> Vec<Point> {
        (0..self.count).map(|_| self.appear()).collect()
    }

    pub(super) fn frame(&mut self) -> Frame {
        let mut frame = Frame::default();
        for index in self.features.keys().copied().collect::<Vec<_>>() {
            if self.random.once_in(LIFE) {
                frame.gone.push(index);
            } else if self.random.once_in(self.motion.one_in) {
                let place = self.drifted(self.features[&index]);
                self.features.insert(index, place);
                frame.moves.push((index, place));
            }
        }
        for index in &frame.gone {
            self.features.remove(index);
        }
        frame.new = frame.gone.iter().map(|_| self.appear()).collect();
        frame.places = (0..self.places).map(|_| self.anywhere()).collect();
        frame
    }

    fn appear(&mut self) -> Point {
        let place = self.anywhere();
        self.features.insert(self.next_index, place);
        self.next_index += 1;
        place
    }

    fn anywhere(&mut self) -> Point {
        Point::new(self.random.below_u32(IMAGE[0] * STEPS), self.random.below_u32(IMAGE[1] * STEPS))
    }

    fn drifted(&mut self, from: Point) -> Point {
        let most = (self.motion.pixels * f64::from(STEPS)) as u32;
        let mut step = |value: u32, axis: usize| {
            let moved = value + self.random.below_u32(2 * most + 1);
            moved.saturating_sub(most).min(IMAGE[axis] * STEPS - 1)
        };
        Point::new(step(from.x, 0), step(from.y, 1))
    }
}
