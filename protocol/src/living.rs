//! Runs: commands that ask about a mesh that stands, or change it vertex by vertex.
//!
//! A run is one command with many items of one kind, as the deletions of a hundred vertices. Its answer has a part of
//! fixed length for each item, and each part begins with the number of its item, because a device that works on several
//! items at once may finish them in another order.
//!
//! The features of its [`Identity`] say which of these commands a device has: [`FEATURE_RUNS`] stands for all of them,
//! and [`RunKind::feature`] for one.

use crate::layout::{Identity, Layout};
use crate::opcode::Opcode;
use crate::status::Outcome;

/// The bit of [`Identity::features`] of a device that takes runs of all kinds.
pub const FEATURE_RUNS: u32 = 1;

/// The features of a core with runs: one bit for each kind.
pub const CORE_RUNS: u32 = RunKind::Locate.feature()
    | RunKind::Interpolate.feature()
    | RunKind::Nearest.feature()
    | RunKind::InsertAs.feature()
    | RunKind::Delete.feature()
    | RunKind::Move.feature();

/// Lowest bit of the outcome in the first word of a part of an answer.
pub const OUTCOME_SHIFT: u32 = 24;
/// The first word of a part of an answer has the number of its item modulo this number.
pub const ITEM_NUMBERS: u32 = 1 << OUTCOME_SHIFT;

/// The kinds of runs. Each is described at the [`Opcode`] of its name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs)] // the names are those of `Opcode`, where each is explained
pub enum RunKind {
    Locate,
    Interpolate,
    Nearest,
    InsertAs,
    Delete,
    Move,
}

impl RunKind {
    /// All kinds, in the order of their opcodes.
    pub const ALL: [Self; 6] =
        [Self::Locate, Self::Interpolate, Self::Nearest, Self::InsertAs, Self::Delete, Self::Move];

    /// The opcode of runs of this kind.
    pub const fn opcode(self) -> Opcode {
        match self {
            Self::Locate => Opcode::Locate,
            Self::Interpolate => Opcode::Interpolate,
            Self::Nearest => Opcode::Nearest,
            Self::InsertAs => Opcode::InsertAs,
            Self::Delete => Opcode::Delete,
            Self::Move => Opcode::Move,
        }
    }

    /// The kind of runs with this opcode; `None` for the opcodes of other commands.
    pub const fn of(opcode: Opcode) -> Option<Self> {
        Some(match opcode {
            Opcode::Locate => Self::Locate,
            Opcode::Interpolate => Self::Interpolate,
            Opcode::Nearest => Self::Nearest,
            Opcode::InsertAs => Self::InsertAs,
            Opcode::Delete => Self::Delete,
            Opcode::Move => Self::Move,
            _ => return None,
        })
    }

    /// The bit of [`Identity::features`] of a device that takes runs of this kind, whether or not it takes others.
    pub const fn feature(self) -> u32 {
        4 << (self.opcode() as u32 - Opcode::Locate as u32)
    }

    /// Whether the items change the mesh. Runs of the other kinds only ask about it.
    pub const fn is_change(self) -> bool {
        matches!(self, Self::InsertAs | Self::Delete | Self::Move)
    }

    /// Whether an item begins with the id of a vertex.
    pub const fn has_vertex(self) -> bool {
        self.is_change()
    }

    /// Whether an item ends with a point.
    pub const fn has_point(self) -> bool {
        !matches!(self, Self::Delete)
    }

    /// Number of words of an item: the id of the vertex, then the point, as far as the kind has them. 1 to 3.
    pub const fn item_words(self, layout: Layout) -> usize {
        self.has_vertex() as usize + if self.has_point() { layout.point_words } else { 0 }
    }

    /// Number of words of the part of the answer for one item.
    pub const fn part_words(self) -> usize {
        match self {
            Self::Locate => 4,
            Self::Interpolate => 10,
            Self::Nearest | Self::InsertAs | Self::Delete | Self::Move => 2,
        }
    }
}

impl Identity {
    /// Whether the device takes runs of this kind.
    pub const fn takes(&self, kind: RunKind) -> bool {
        self.features & (FEATURE_RUNS | kind.feature()) != 0
    }
}

impl Opcode {
    /// The opcode of this number if it is one of a command that every device has, which the runs are not.
    pub const fn of_every_device(value: u8) -> Option<Self> {
        match Self::from_u8(value) {
            Some(opcode) if RunKind::of(opcode).is_none() => Some(opcode),
            _ => None,
        }
    }
}

/// The first word of a part of an answer: the number of the item in bits 23 to 0, and the outcome above.
pub const fn part_head(item: u32, outcome: Outcome) -> u32 {
    ((outcome as u32) << OUTCOME_SHIFT) | (item % ITEM_NUMBERS)
}

/// The number of the item in the first word of a part of an answer, modulo [`ITEM_NUMBERS`].
pub const fn part_item(word: u32) -> u32 {
    word % ITEM_NUMBERS
}

/// The outcome byte in the first word of a part of an answer, known or not.
pub const fn part_outcome(word: u32) -> u8 {
    (word >> OUTCOME_SHIFT) as u8
}

/// The part of the answer to a `Locate` or `Interpolate` for one item.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Located {
    /// The vertices. `Vertex`: one. `Edge`: its two ends, in either order. `Triangle`: three, counter-clockwise,
    /// beginning with any. `Outside`: the two ends of the hull edge, counter-clockwise. All others are 0.
    pub vertices: [u32; 3],
    /// `Interpolate` only: for each of the vertices the weight of its value, at least 0. The value at the place is the
    /// sum of weights times values, divided by the sum of the weights. All weights are 0 outside the hull.
    pub weights: [u64; 3],
}

impl Located {
    /// The words behind the first one, of which a `Locate` uses three.
    pub const fn to_words(self) -> [u32; 9] {
        let ([a, b, c], [u, v, w]) = (self.vertices, self.weights);
        [a, b, c, u as u32, (u >> 32) as u32, v as u32, (v >> 32) as u32, w as u32, (w >> 32) as u32]
    }

    /// Reads the words behind the first one: nine of an `Interpolate`, three of a `Locate`. Words that are missing
    /// count as 0.
    pub fn from_words(words: &[u32]) -> Self {
        let word = |place: usize| words.get(place).copied().unwrap_or(0);
        let weight = |slot: usize| u64::from(word(3 + 2 * slot)) | u64::from(word(4 + 2 * slot)) << 32;
        Self { vertices: [word(0), word(1), word(2)], weights: [weight(0), weight(1), weight(2)] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::IDENTITY_WORDS;
    use crate::short_ids::FEATURE_SHORT_IDS;

    #[test]
    fn every_kind_has_an_opcode_of_its_own() {
        for (kind, number) in RunKind::ALL.into_iter().zip(8..) {
            assert_eq!(kind.opcode() as u8, number);
            assert_eq!(Opcode::from_u8(number).and_then(RunKind::of), Some(kind));
            assert_eq!(Opcode::of_every_device(number), None);
        }
        for number in 1..8 {
            assert_eq!(Opcode::from_u8(number).and_then(RunKind::of), None);
            assert_eq!(Opcode::from_u8(number), Opcode::of_every_device(number));
        }
    }

    #[test]
    fn every_kind_has_a_feature_of_its_own() {
        let identity = |features| Identity { features, ..Identity::from_words([0; IDENTITY_WORDS]) };
        let taken = |features| RunKind::ALL.map(|kind| identity(features).takes(kind));
        let others = FEATURE_RUNS | FEATURE_SHORT_IDS;
        assert_eq!(taken(FEATURE_SHORT_IDS), [false; 6]);
        assert_eq!(taken(FEATURE_RUNS), [true; 6]);
        for kind in RunKind::ALL {
            assert_eq!(kind.feature() & others, 0);
            assert_eq!(taken(kind.feature()), RunKind::ALL.map(|other| other == kind));
        }
        assert_eq!(taken(CORE_RUNS), [true; 6]);
    }

    #[test]
    fn items_and_parts_have_the_words_of_the_page() {
        let layouts = [(16, 1024), (20, 100_000)].map(|(bits, capacity)| Layout::of(bits, capacity));
        let items = layouts.map(|layout| RunKind::ALL.map(|kind| kind.item_words(layout)));
        assert_eq!(items, [[1, 1, 1, 2, 1, 2], [2, 2, 2, 3, 1, 3]]);
        assert_eq!(RunKind::ALL.map(RunKind::part_words), [4, 10, 2, 2, 2, 2]);
    }

    #[test]
    fn the_head_of_a_part_has_item_and_outcome() {
        let head = part_head(ITEM_NUMBERS + 5, Outcome::Duplicate);
        assert_eq!(head, 0x0500_0005);
        assert_eq!((part_item(head), part_outcome(head)), (5, Outcome::Duplicate as u8));
    }

    #[test]
    fn what_is_written_is_read() {
        let located = Located { vertices: [7, 8, u32::MAX], weights: [0, 1 << 40 | 3, u64::MAX] };
        assert_eq!(Located::from_words(&located.to_words()), located);
        let short = Located { weights: [0; 3], ..located };
        assert_eq!(Located::from_words(&located.to_words()[..3]), short);
    }
}
