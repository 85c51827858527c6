//! A text in blocks of whole rows, so that the text may be larger than the memory.

use std::io::{self, Read};

use memchr::{memchr_iter, memrchr, memrchr2};

use crate::failure::Failure;
use crate::input::unreadable;

/// The bytes that are read at once.
const BLOCK: usize = 1 << 18;
/// The most bytes of a row. A block holds one row at least.
const LONGEST_ROW: usize = 1 << 23;

/// The bytes that end a row.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RowEnd {
    /// LF. A CR before it is left to the reader of the rows.
    Feed,
    /// LF, CRLF, or CR alone.
    Any,
}

/// The blocks of a text. Each holds whole rows, and only the last one may lack the end of its last row.
pub struct Blocks<R> {
    source: R,
    end: RowEnd,
    bytes: Vec<u8>,
    /// The number of bytes of the last block, which are still in `bytes`.
    given: usize,
    is_over: bool,
}

impl<R: Read> Blocks<R> {
    /// The blocks of a text whose rows end in this way.
    pub fn new(source: R, end: RowEnd) -> Self {
        Self { source, end, bytes: Vec::new(), given: 0, is_over: false }
    }

    /// The next block; `None` at the end of the text.
    ///
    /// # Errors
    /// The source cannot be read, or a row has more than 8 MiB.
    pub fn next(&mut self) -> Result<Option<&[u8]>, Failure> {
        self.bytes.drain(..self.given);
        self.given = 0;
        while !self.is_over {
            let before = self.bytes.len();
            let mut more = (&mut self.source).take(BLOCK as u64);
            let count = more.read_to_end(&mut self.bytes).map_err(|error| unreadable(&error))?;
            self.is_over = count == 0;
            // A row end that was not in the bytes before can only be their last byte or behind it.
            let from = before.saturating_sub(1);
            if let Some(end) = self.last_end(from).filter(|_| !self.is_over) {
                self.given = from + end;
                return Ok(Some(&self.bytes[..self.given]));
            }
            if self.bytes.len() > LONGEST_ROW {
                return Err(Failure::input(format!(
                    "a row has more than {LONGEST_ROW} bytes, which is the most of a text that is read in pieces"
                )));
            }
        }
        self.given = self.bytes.len();
        Ok((self.given > 0).then_some(&self.bytes))
    }

    /// The place behind the last row end from a place on, counted from there. A CR as the last byte may be half a CRLF.
    fn last_end(&self, from: usize) -> Option<usize> {
        let bytes = &self.bytes[from..];
        let last = match self.end {
            RowEnd::Feed => memrchr(b'\n', bytes),
            RowEnd::Any if bytes.ends_with(b"\r") => memrchr2(b'\n', b'\r', &bytes[..bytes.len() - 1]),
            RowEnd::Any => memrchr2(b'\n', b'\r', bytes),
        };
        last.map(|place| place + 1)
    }
}

/// An upper bound for the number of rows of a text: its bytes that may end a row, and one.
///
/// # Errors
/// The source cannot be read.
pub fn count_rows(mut source: impl Read) -> io::Result<u64> {
    let (mut block, mut rows) = (vec![0; BLOCK], 1);
    loop {
        match source.read(&mut block) {
            Ok(0) => return Ok(rows),
            // Rows that end in CRLF have one LF each; a text without LF may have rows that end in CR.
            Ok(count) => {
                let (feeds, returns) =
                    (memchr_iter(b'\n', &block[..count]).count(), memchr_iter(b'\r', &block[..count]).count());
                rows += feeds.max(returns) as u64;
            }
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) => return Err(error),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_testkit::SplitMix64;

    /// A source that gives few bytes at a time.
    struct Slow<'a>(&'a [u8], SplitMix64);

    impl Read for Slow<'_> {
        fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
            let most = 1 + self.1.below(9) as usize;
            let count = most.min(self.0.len()).min(into.len());
            into[..count].copy_from_slice(&self.0[..count]);
            self.0 = &self.0[count..];
            Ok(count)
        }
    }

    fn blocks(text: &[u8], end: RowEnd) -> Vec<Vec<u8>> {
        let mut blocks = Blocks::new(Slow(text, SplitMix64::new(1)), end);
        let mut all = Vec::new();
        while let Some(block) = blocks.next().expect("no long row") {
            all.push(block.to_vec());
        }
        all
    }

    #[test]
    fn blocks_end_where_rows_end() {
        for (row, end) in
            [("12,3\n", RowEnd::Any), ("12,3\r\n", RowEnd::Any), ("12,3\r", RowEnd::Any), ("1\r\n", RowEnd::Feed)]
        {
            for rest in ["", "4,5"] {
                let text = row.repeat(3 * BLOCK / row.len() + 5) + rest;
                let found = blocks(text.as_bytes(), end);
                assert!(found.len() > 2, "{row:?}");
                assert_eq!(found.concat(), text.as_bytes());
                let (last, others) = found.split_last().expect("some blocks");
                assert!(others.iter().all(|block| block.len() % row.len() == 0), "{row:?}");
                assert!(last.ends_with(rest.as_bytes()));
            }
        }
        assert!(blocks(b"", RowEnd::Any).is_empty());
    }

    #[test]
    fn a_row_longer_than_a_block_stays_whole() {
        let text = ["1".repeat(3 * BLOCK), "2".repeat(5)].join("\n");
        assert_eq!(blocks(text.as_bytes(), RowEnd::Any).concat(), text.as_bytes());
        let endless = io::repeat(b'1');
        let failure = Blocks::new(endless, RowEnd::Feed).next().map(|_| ()).expect_err("a row without an end");
        assert!(failure.message.contains("more than 8388608 bytes"), "{failure}");
    }

    #[test]
    fn rows_are_counted_once_at_least() {
        for (text, rows) in [("", 1), ("1,2\n3,4\n", 3), ("1,2\r\n3,4", 2), ("1,2\r3,4\r", 3)] {
            assert_eq!(count_rows(text.as_bytes()).expect("memory is read"), rows, "{text:?}");
        }
    }
}
