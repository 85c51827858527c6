//! Writing files of tiles: rows of numbers behind a head with their check sum.

use std::io::{self, Write};
use std::path::Path;

use crc32fast::Hasher;

use super::head::Head;
use crate::failure::Failure;
use crate::output::{Output, Written};

/// The number of rows that become bytes together.
const ROWS: usize = 1 << 12;

/// Writes rows of numbers, little endian.
pub fn write_rows<const N: usize>(rows: &[[u32; N]], out: &mut dyn Write) -> io::Result<()> {
    let mut bytes = Vec::with_capacity(ROWS.min(rows.len()) * 4 * N);
    for rows in rows.chunks(ROWS) {
        bytes.clear();
        bytes.extend(rows.as_flattened().iter().flat_map(|number| number.to_le_bytes()));
        out.write_all(&bytes)?;
    }
    Ok(())
}

/// Writes a file with a head. The check sum in the head is that of what `content` writes, which must be the same both
/// times that it is called. Then `rows` follow, with a check sum of their own at the end.
pub fn write_checked(
    path: &Path,
    head: Head,
    content: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>,
    rows: Option<&[[u32; 3]]>,
) -> Result<Written, Failure> {
    let mut sum = io::BufWriter::with_capacity(1 << 16, Summed { sum: Hasher::new(), out: io::sink() });
    let output = Output::prepare(path, &[])?;
    output.write(|out| {
        content(&mut sum)?;
        sum.flush()?;
        let check = sum.get_ref().sum.clone().finalize();
        out.write_all(&Head { check, ..head }.to_bytes())?;
        content(out)?;
        let Some(rows) = rows else { return Ok(()) };
        let mut summed = Summed { sum: Hasher::new(), out: &mut *out };
        write_rows(rows, &mut summed)?;
        let check = summed.sum.finalize();
        out.write_all(&check.to_le_bytes())
    })
}

/// A writer that keeps the check sum of what it passes on.
struct Summed<W> {
    sum: Hasher,
    out: W,
}

impl<W: Write> Write for Summed<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.out.write(bytes)?;
        self.sum.update(&bytes[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}
