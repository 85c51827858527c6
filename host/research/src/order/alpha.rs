//! The sizes of the samples in the rounds of BRIO.

/// The share of the points that all rounds but the last have together, which BRIO calls α.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Alpha {
    /// A share of 1/2, as in the paper: a coin is thrown for each point.
    Half,
    /// A share of 1/4, with fewer rounds, none of which is much larger than all earlier ones together.
    #[default]
    Quarter,
    /// A share of 1/8, with the fewest rounds.
    Eighth,
}

impl Alpha {
    /// All three shares.
    pub const ALL: [Self; 3] = [Self::Half, Self::Quarter, Self::Eighth];

    /// The exponent of the share: α is 2 to the power of minus this number.
    pub const fn shift(self) -> u32 {
        match self {
            Self::Half => 1,
            Self::Quarter => 2,
            Self::Eighth => 3,
        }
    }
}
