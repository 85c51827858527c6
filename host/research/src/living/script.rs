//! The points and commands of the comparison.

use incircle::Order;
use incircle_geometry::Point;
use incircle_testkit::SplitMix64;

use super::arguments::LivingArguments;
use super::contestant::Block;

/// Bits of the grid, and its side. Doubles are the same points, each with a fraction.
const BITS: u32 = 31;
pub(super) const SIDE: u32 = 1 << BITS;

/// The operations, in the order in which they are measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stage {
    Locate,
    Nearest,
    Insert,
    Delete,
}

impl Stage {
    pub(super) const ALL: [Self; 4] = [Self::Locate, Self::Nearest, Self::Insert, Self::Delete];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Locate => "locate",
            Self::Nearest => "nearest",
            Self::Insert => "insert",
            Self::Delete => "delete",
        }
    }

    pub(super) fn is_change(self) -> bool {
        matches!(self, Self::Insert | Self::Delete)
    }
}

/// The first points, and the commands that follow.
pub(super) struct Script {
    pub(super) points: Vec<[f64; 2]>,
    /// The numbers of the points along a Hilbert curve.
    pub(super) order: Vec<u32>,
    /// The places that are asked for.
    places: Vec<[f64; 2]>,
    /// The points that are inserted.
    new: Vec<[f64; 2]>,
    /// The numbers of points that are deleted: a random choice of the first ones.
    old: Vec<u32>,
}

impl Script {
    /// Makes a script of uniform points, whose commands come in random order or along a Hilbert curve.
    pub(super) fn new(arguments: &LivingArguments, along_curve: bool) -> Self {
        let mut random = SplitMix64::new(arguments.seed);
        let (count, commands) = (arguments.n as usize, arguments.commands as usize);
        let mut list = |count: usize| -> Vec<[f64; 2]> {
            let value = |random: &mut SplitMix64| {
                let value = random.unit() * f64::from(SIDE);
                if arguments.grid {
                    value.floor()
                } else {
                    value
                }
            };
            (0..count).map(|_| [value(&mut random), value(&mut random)]).collect()
        };
        let (points, mut places, mut new) = (list(count), list(commands), list(commands));
        let mut old: Vec<u32> = (0..arguments.n).collect();
        random.shuffle(&mut old);
        old.truncate(commands);
        if along_curve {
            places = sorted(&places, |&place| place);
            new = sorted(&new, |&place| place);
            old = sorted(&old, |&number| points[number as usize]);
        }
        Self { order: order(&points), points, places, new, old }
    }

    /// The commands of a stage.
    pub(super) fn blocks(&self, stage: Stage, length: usize) -> impl Iterator<Item = Block<'_>> {
        let count = if stage == Stage::Delete { self.old.len() } else { self.places.len() };
        (0..count).step_by(length).map(move |start| {
            let range = start..count.min(start + length);
            match stage {
                Stage::Locate => Block::Locate(&self.places[range]),
                Stage::Nearest => Block::Nearest(&self.places[range]),
                Stage::Insert => Block::Insert(&self.new[range]),
                Stage::Delete => Block::Delete(&self.old[range]),
            }
        })
    }
}

/// The positions of places along a Hilbert curve.
fn order(places: &[[f64; 2]]) -> Vec<u32> {
    let points: Vec<Point> = places.iter().map(|&[x, y]| Point::new(x as u32, y as u32)).collect();
    Order::Hilbert.order(&points)
}

/// The items along a Hilbert curve through their places.
fn sorted<T: Copy>(items: &[T], place: impl Fn(&T) -> [f64; 2]) -> Vec<T> {
    let places: Vec<_> = items.iter().map(place).collect();
    order(&places).into_iter().map(|index| items[index as usize]).collect()
}
