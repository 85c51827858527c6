//! How files of tiles are written: rows of numbers behind a head with their check sum.

use std::io::{self, Write};
use std::path::Path;

use crc32fast::Hasher;

use super::head::Head;
use crate::failure::Failure;
use crate::output::{Output, Written};

/// Writes rows of numbers, little endian.
pub fn write_rows<const N: usize>(rows: &[[u32; N]], out: &mut dyn Write) -> io::Result<()> {
    for number in rows.as_flattened() {
        out.write_all(&number.to_le_bytes())?;
    }
    Ok(())
}

/// Writes a file with a head. Its check sum is that of what `content` writes. `content` is called twice and must write
/// the same bytes.
pub fn write_checked(
    path: &Path,
    head: Head,
    content: &mut dyn FnMut(&mut dyn Write) -> io::Result<()>,
) -> Result<Written, Failure> {
    let mut sum = io::BufWriter::with_capacity(1 << 16, Sum(Hasher::new()));
    let output = Output::prepare(path, &[])?;
    output.write(|out| {
        content(&mut sum)?;
        sum.flush()?;
        let check = sum.get_ref().0.clone().finalize();
        out.write_all(&Head { check, ..head }.to_bytes())?;
        content(out)
    })
}

/// A writer that keeps nothing but the check sum.
struct Sum(Hasher);

impl Write for Sum {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.update(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
