//! Text files, read as rows of values.

use memchr::memchr;

use crate::failure::{quoted, Failure};
use crate::points::Place;

/// The byte order mark that some editors put before UTF-8 text.
const UTF8_MARK: &[u8] = b"\xef\xbb\xbf";

/// Removes the byte order mark; UTF-16 is refused with a sentence.
pub fn without_mark(bytes: &[u8]) -> Result<&[u8], Failure> {
    if bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff") {
        return Err(Failure::input("the text is UTF-16: save it as UTF-8"));
    }
    Ok(bytes.strip_prefix(UTF8_MARK).unwrap_or(bytes))
}

/// The text without its byte order mark, all of which must be UTF-8.
pub fn utf8(bytes: &[u8]) -> Result<&str, Failure> {
    std::str::from_utf8(without_mark(bytes)?).map_err(|_| Failure::input("the file is not UTF-8 text"))
}

/// The rows of a text with their numbers, counted from 1. Rows end in LF or CRLF; the last row may lack its end.
pub fn rows(bytes: &[u8]) -> impl Iterator<Item = (usize, &[u8])> {
    let mut rest = bytes;
    let mut number = 0;
    std::iter::from_fn(move || {
        if rest.is_empty() {
            return None;
        }
        number += 1;
        let end = memchr(b'\n', rest).unwrap_or(rest.len());
        let row = &rest[..end];
        rest = rest.get(end + 1..).unwrap_or_default();
        Some((number, row.strip_suffix(b"\r").unwrap_or(row)))
    })
}

/// The values of a row, separated by spaces and tabs.
pub fn words(row: &[u8]) -> impl Iterator<Item = &[u8]> {
    row.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty())
}

/// The row up to the first `#`.
pub fn without_comment(row: &[u8]) -> &[u8] {
    row.split(|&byte| byte == b'#').next().unwrap_or(row)
}

/// Whether a value is meant as a number, valid or not. A row without such values may be a header.
pub fn looks_like_number(value: &[u8]) -> bool {
    let value = value.trim_ascii();
    let starts = value.first().is_some_and(|byte| byte.is_ascii_digit() || b"+-.".contains(byte));
    starts || std::str::from_utf8(value).is_ok_and(|text| text.parse::<f64>().is_ok())
}

/// The failure of a value that is no number.
pub fn not_a_number(value: &[u8], place: Place) -> Failure {
    if value.is_empty() {
        return Failure::input(format!("{place}: the value is missing"));
    }
    let shown = quoted(value);
    let what = if std::str::from_utf8(value).is_err() { "not UTF-8 text" } else { "not a number" };
    Failure::input(format!("{place}: {shown} is {what}"))
}

/// The failure of NaN, infinities, and numbers too large for a double.
pub fn not_finite(shown: &str, place: Place) -> Failure {
    Failure::input(format!("{place}: {shown} is not a finite number"))
}

/// Parses a whole number from 0 to 2^32 - 1, which messages call `what`.
pub fn whole(value: &[u8], what: &str, place: Place) -> Result<u32, Failure> {
    let value = value.trim_ascii();
    let parsed = std::str::from_utf8(value).ok().and_then(|text| text.parse::<u32>().ok());
    parsed.ok_or_else(|| {
        let shown = quoted(value);
        Failure::input(format!("{place}: {shown} is not {what}, a whole number from 0 to 4294967295"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_end_in_any_way() {
        let numbered = |text: &'static str| rows(text.as_bytes()).map(|(n, r)| (n, r.len())).collect::<Vec<_>>();
        assert_eq!(numbered(""), []);
        assert_eq!(numbered("ab"), [(1, 2)]);
        assert_eq!(numbered("ab\r\n\r\nc\n"), [(1, 2), (2, 0), (3, 1)]);
    }

    #[test]
    fn numbers_are_told_from_names() {
        for number in ["1", "-2", ".5", "nan", "inf", "12a", "+"] {
            assert!(looks_like_number(number.as_bytes()), "{number}");
        }
        for name in ["x", "lon", "easting", ""] {
            assert!(!looks_like_number(name.as_bytes()), "{name}");
        }
    }
}
