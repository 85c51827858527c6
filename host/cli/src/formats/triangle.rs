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
    let bytes = text::without_mark(bytes)?;
    let mut rows = text::rows(bytes)
        .map(|(row, content)| (row, text::without_comment(content)))
        .filter(|(_, content)| text::words(content).next().is_some());
    let Some((row, header)) = rows.next() else {
        return Err(Failure::input(format!("the file is empty: {} starts with a row '{}'", format.name, format.row)));
    };
    let mut values = text::words(header);
    let cell = |column| Place::Cell { row, column };
    let what = format!("a number of {}", format.items);
    let promised = text::whole(values.next().unwrap_or_default(), &what, cell(1))?;
    let (meaning, wanted) = format.second;
    match values.next() {
        Some(other) if other != wanted.as_bytes() => {
            Err(Failure::input(format!("{}: the {meaning} is {}, not {wanted}", cell(2), quoted(other))))
        }
        _ => Ok((promised, rows)),
    }
}
