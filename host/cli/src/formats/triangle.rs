//! The beginning that `.node` and `.ele`, the formats of Shewchuk's Triangle, share: a header `N M …`, then
//! one row per item.

use crate::failure::{quoted, Failure};
use crate::points::Place;
use crate::text;

/// The header of one of the formats.
pub struct Header {
    /// The extension of the format.
    pub name: &'static str,
    /// The header row for messages.
    pub row: &'static str,
    /// The name of the items that the first value counts.
    pub items: &'static str,
    /// The meaning of the second value, and the only value that is accepted.
    pub second: (&'static str, &'static str),
}

/// Reads the header. Returns the number of items that it promises, and the numbered rows after it without
/// comments and blank rows.
pub fn open<'a>(bytes: &'a [u8], format: &Header) -> Result<(u32, impl Iterator<Item = (usize, &'a [u8])>), Failure> {
    let mut rows = contents(text::without_mark(bytes)?);
    let Some((row, header)) = rows.next() else { return Err(format.missing()) };
    Ok((format.promised(row, header)?, rows))
}

/// The rows of a text with their numbers, without comments and blank rows.
pub fn contents(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    text::rows(bytes)
        .map(|(row, content)| (row, text::without_comment(content)))
        .filter(|(_, content)| text::words(content).next().is_some())
}

impl Header {
    /// The failure of a file without a row.
    pub fn missing(&self) -> Failure {
        Failure::input(format!("the file is empty: {} starts with a row '{}'", self.name, self.row))
    }

    /// The number of items that the header promises, which stands in this row.
    ///
    /// # Errors
    /// The row is no header of this format.
    pub fn promised(&self, row: usize, header: &[u8]) -> Result<u32, Failure> {
        let mut values = text::words(header);
        let cell = |column| Place::Cell { row, column };
        let what = format!("a number of {}", self.items);
        let promised = text::whole(values.next().unwrap_or_default(), &what, cell(1))?;
        let (meaning, wanted) = self.second;
        match values.next() {
            Some(other) if other != wanted.as_bytes() => {
                Err(Failure::input(format!("{}: the {meaning} is {}, not {wanted}", cell(2), quoted(other))))
            }
            _ => Ok(promised),
        }
    }
}
