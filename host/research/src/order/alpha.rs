//! How large the samples of a biased order are.

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

    /// α is 2 to the power of minus this.
    pub const fn shift(self) -> u32 {
        match self {
            Self::Half => 1,
            Self::Quarter => 2,
            Self::Eighth => 3,
        }
    }
}
