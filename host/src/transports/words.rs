//! Words in the frames of links.

/// Reads bytes as words, low byte first, without bytes that are left over.
pub(super) fn words_of(bytes: &[u8]) -> impl Iterator<Item = u32> + use<'_> {
    bytes.as_chunks().0.iter().map(|word| u32::from_le_bytes(*word))
}
