//! The rows of a CSV file, split into values.
//!
//! Most files have no quotes, and splitting a row at its separators is several times as fast as an automaton that looks
//! for quotes at every byte. So rows without a quote are split here, and only a row with a quote goes through the crate
//! `csv-core`, which knows the rules of RFC 4180. A quoted value may not run over the end of its row.

use csv_core::{ReadRecordResult, Reader, ReaderBuilder};
use memchr::{memchr, memchr2, memchr_iter};

use crate::failure::Failure;
use crate::number::{self, Decimal};
use crate::text;

/// The most values that a row may have. The places of the values are kept, at eight bytes each, and a file of commas
/// must not take eight times its size.
const MOST_COLUMNS: usize = 1 << 20;

/// The rows of a file that are neither blank nor comments.
pub struct CsvRows<'a> {
    rest: &'a [u8],
    row: usize,
    separator: u8,
    reader: Reader,
    /// The values of the current row without their quotes, if the row has any.
    unquoted: Vec<u8>,
    /// The ends of the values of the current row.
    ends: Vec<usize>,
}

/// The values of a row.
#[derive(Clone, Copy)]
pub struct Values<'r> {
    text: &'r [u8],
    ends: &'r [usize],
    /// Bytes between two values: 1 if `text` has the separators, 0 if it has the values without their quotes.
    gap: usize,
}

impl<'r> Values<'r> {
    /// The number of values; at least one.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// The value in a column, counted from 0; empty if the row has no such column.
    pub fn get(&self, column: usize) -> &'r [u8] {
        let start = column.checked_sub(1).and_then(|before| self.ends.get(before)).map_or(0, |end| end + self.gap);
        let end = self.ends.get(column).copied().unwrap_or(start);
        self.text.get(start..end).unwrap_or_default()
    }

    /// All values.
    pub fn iter(self) -> impl Iterator<Item = &'r [u8]> {
        (0..self.len()).map(move |column| self.get(column))
    }
}

impl<'a> CsvRows<'a> {
    /// The rows of a text. The separator is a comma, or the semicolon or tab that the first row has instead.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self::after(0, bytes, separator_of(bytes))
    }

    /// The rows of a text that has `row` rows before these bytes.
    pub fn after(row: usize, bytes: &'a [u8], separator: u8) -> Self {
        let reader = ReaderBuilder::new().delimiter(separator).build();
        Self { rest: bytes, row, separator, reader, unquoted: Vec::new(), ends: Vec::new() }
    }

    /// The byte between two values.
    pub fn separator(&self) -> u8 {
        self.separator
    }

    /// The number of rows of the text up to the last one taken.
    pub fn row(&self) -> usize {
        self.row
    }

    /// The next row with its number, counted from 1; `None` after the last one.
    pub fn next(&mut self) -> Result<Option<(usize, Values<'_>)>, Failure> {
        loop {
            let Some(row) = self.take_row() else {
                return Ok(None);
            };
            if row.first() == Some(&b'#') {
                continue;
            }
            self.ends.clear();
            let has_quotes = memchr(b'"', row).is_some();
            if has_quotes {
                self.unquote(row)?;
            } else {
                self.ends.extend(memchr_iter(self.separator, row).take(MOST_COLUMNS));
                if self.ends.len() == MOST_COLUMNS {
                    return Err(self.too_wide());
                }
                self.ends.push(row.len());
            }
            // A blank row has one value, which is blank.
            let only = if has_quotes { &self.unquoted[..self.ends[0]] } else { row };
            if self.ends.len() > 1 || !only.trim_ascii().is_empty() {
                let (text, gap) = if has_quotes { (self.unquoted.as_slice(), 0) } else { (row, 1) };
                return Ok(Some((self.row, Values { text, ends: &self.ends, gap })));
            }
        }
    }

    /// The next row with its number, if the row is two decimals without quotes, spaces or exponents, and nothing else.
    /// Most rows are of this kind, and this function takes a third of the time of [`next`](Self::next) for them. It
    /// leaves other rows to `next`.
    #[inline]
    pub fn next_pair(&mut self) -> Option<(usize, [Decimal; 2])> {
        let (x, rest) = number::leading(self.rest)?;
        let (y, rest) = number::leading(rest.strip_prefix(&[self.separator])?)?;
        self.rest = match rest {
            [b'\n', after @ ..] | [b'\r', b'\n', after @ ..] => after,
            [] => rest,
            _ => return None,
        };
        self.row += 1;
        Some((self.row, [x, y]))
    }

    /// Takes the next row without its end, which is LF, CRLF or CR.
    fn take_row(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        self.row += 1;
        let end = memchr2(b'\n', b'\r', self.rest).unwrap_or(self.rest.len());
        let (row, after) = self.rest.split_at(end);
        self.rest = after.strip_prefix(b"\r\n").or(after.get(1..)).unwrap_or_default();
        Some(row)
    }

    fn too_wide(&self) -> Failure {
        Failure::input(format!("row {} has more than {MOST_COLUMNS} columns", self.row))
    }

    /// Takes the quotes off the values of a row.
    fn unquote(&mut self, row: &[u8]) -> Result<(), Failure> {
        // A row has one value more than separators, and no value grows.
        self.unquoted.resize(row.len() + 1, 0);
        self.ends.resize((row.len() + 1).min(MOST_COLUMNS), 0);
        self.reader.reset();
        let (result, read, written, ended) = self.reader.read_record(row, &mut self.unquoted, &mut self.ends);
        if matches!(result, ReadRecordResult::OutputEndsFull) {
            return Err(self.too_wide());
        }
        let (unquoted, ends) = (&mut self.unquoted[written..], &mut self.ends[ended..]);
        let (result, _, _, last) = self.reader.read_record(b"\n", unquoted, ends);
        if read < row.len() || !matches!(result, ReadRecordResult::Record) {
            return Err(Failure::input(format!(
                "row {}: a quoted value runs over the end of its row: close the quote",
                self.row
            )));
        }
        self.ends.truncate(ended + last);
        Ok(())
    }
}

/// The byte between two values of a text: a comma, or the semicolon or tab that the first row has instead.
pub fn separator_of(bytes: &[u8]) -> u8 {
    let mut rows = text::rows(bytes).map(|(_, row)| row);
    let first = rows.find(|row| !row.trim_ascii().is_empty() && !row.starts_with(b"#")).unwrap_or_default();
    [b',', b';', b'\t'].into_iter().find(|byte| first.contains(byte)).unwrap_or(b',')
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_testkit::SplitMix64;

    /// All rows as the crate `csv` reads them.
    fn by_csv(text: &[u8], separator: u8) -> Vec<Vec<Vec<u8>>> {
        let mut builder = csv::ReaderBuilder::new();
        builder.has_headers(false).flexible(true).comment(Some(b'#')).delimiter(separator);
        let records = builder.from_reader(text).into_byte_records().map(|record| record.expect("bytes are a record"));
        records.map(|record| record.iter().map(<[u8]>::to_vec).collect()).collect()
    }

    /// Whether a value of some row holds the end of a row.
    fn runs_over(rows: &[Vec<Vec<u8>>]) -> bool {
        rows.iter().flatten().flatten().any(|byte| b"\n\r".contains(byte))
    }

    fn own(text: &[u8]) -> Option<Vec<Vec<Vec<u8>>>> {
        let mut rows = CsvRows::new(text);
        let mut all = Vec::new();
        while let Some((_, values)) = rows.next().ok()? {
            all.push(values.iter().map(<[u8]>::to_vec).collect());
        }
        Some(all)
    }

    #[test]
    fn the_crate_csv_splits_rows_alike() {
        let mut random = SplitMix64::new(3);
        let mut compared = 0;
        for _ in 0..60_000 {
            let len = random.below(24) as usize;
            // The crate `csv` does not always end a row at a lone CR, so the texts have none.
            let pieces = ["1", ",", "2", "\n", "\"", "\r\n", ";", "\t", " ", "#", "\n\"", "a", "\",", ",\""];
            let text: String = (0..len).map(|_| pieces[random.below(pieces.len() as u64) as usize]).collect();
            let text = text.into_bytes();
            let separator = CsvRows::new(&text).separator;
            let mut expected = by_csv(&text, separator);
            let found = own(&text);
            // A quoted value that runs over the end of its row is refused. The crate reads on to a later quote, or, if
            // there is none, to the end of the text: then a row with a closing quote belongs to the value as well.
            let closed = by_csv(&[&text[..], b"\nx\"\n"].concat(), separator);
            let may_be_refused = runs_over(&expected) || runs_over(&closed);
            expected.retain(|row| row.len() > 1 || !row[0].trim_ascii().is_empty());
            match found {
                Some(found) => {
                    assert_eq!(found, expected, "{:?}", String::from_utf8_lossy(&text));
                    compared += 1;
                }
                None => assert!(may_be_refused, "{:?}", String::from_utf8_lossy(&text)),
            }
        }
        assert!(compared > 10_000);
    }

    #[test]
    fn pairs_are_the_rows_of_two_decimals() {
        let mut random = SplitMix64::new(4);
        let pieces = ["1", "20", ",", ",", "\n", "\n", "\r\n", "-", ".", " ", "e1", "123456789012345", "\""];
        let mut pairs = 0;
        for _ in 0..200_000 {
            let len = random.below(12) as usize;
            let text: String = (0..len).map(|_| pieces[random.below(pieces.len() as u64) as usize]).collect();
            let (mut rows, mut quick) = (CsvRows::new(text.as_bytes()), CsvRows::new(text.as_bytes()));
            while let Some((row, [x, y])) = quick.next_pair() {
                let (found, values) = rows.next().expect("no quotes").expect("a row");
                assert_eq!((found, values.len()), (row, 2), "{text:?}");
                let decimals = [values.get(0), values.get(1)].map(number::parse);
                assert_eq!(decimals, [x, y].map(|decimal| Some(number::Number::Decimal(decimal))), "{text:?}");
                assert_eq!(quick.rest, rows.rest, "{text:?}");
                pairs += 1;
            }
        }
        assert!(pairs > 500, "{pairs}");
    }

    #[test]
    fn rows_of_separators_take_little_memory() {
        for quote in ["", "\"\""] {
            let row = |values: usize| quote.to_owned() + &",".repeat(values - 1);
            let text = row(MOST_COLUMNS);
            let mut rows = CsvRows::new(text.as_bytes());
            let count = rows.next().map(|row| row.map(|(_, values)| values.len()));
            assert_eq!(count, Ok(Some(MOST_COLUMNS)), "{quote}");
            let text = format!("1,2\n{}", row(8 * MOST_COLUMNS));
            let mut rows = CsvRows::new(text.as_bytes());
            assert!(rows.next().is_ok());
            let failure = rows.next().map(|_| ()).expect_err("too many columns");
            assert!(failure.message.contains("row 2 has more than 1048576 columns"), "{failure}");
            assert!(rows.ends.capacity() <= 2 * MOST_COLUMNS, "{}", rows.ends.capacity());
        }
    }

    #[test]
    fn rows_are_counted() {
        let mut rows = CsvRows::new(b"# a\r\n1,2\r\n\n \n3,\"4\"\r5,6");
        let mut found = Vec::new();
        while let Some((row, values)) = rows.next().expect("no open quote") {
            found.push((row, values.get(0).to_vec(), values.get(1).to_vec(), values.get(2).len()));
        }
        let row = |number, x: &str, y: &str| (number, x.into(), y.into(), 0);
        assert_eq!(found, [row(2, "1", "2"), row(5, "3", "4"), row(6, "5", "6")]);
    }
}
