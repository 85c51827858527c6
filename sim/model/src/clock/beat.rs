//! A beat of the answer stream: one word or two.

/// What passes at one edge of the answer stream.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Beat {
    pub low: u32,
    /// The word that follows it.
    pub high: u32,
    /// There is one.
    pub both: bool,
    /// The last word of the answer is among them.
    pub last: bool,
}

impl Beat {
    /// One word, and not the last.
    pub(super) fn of(word: u32) -> Self {
        Self { low: word, ..Self::default() }
    }
}
