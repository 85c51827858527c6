//! A beat of the answer stream, which is one word or two.

/// The words that pass at one edge of the answer stream.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Beat {
    pub low: u32,
    /// The word that follows `low`.
    pub high: u32,
    /// Whether `high` is a word of the answer.
    pub both: bool,
    /// Whether the last word of the answer is among them.
    pub last: bool,
}

impl Beat {
    /// A beat of one word that is not the last of the answer.
    pub(super) fn of(word: u32) -> Self {
        Self { low: word, ..Self::default() }
    }
}
