//! LAS, LAZ and COPC: the points of laser scanners.
//!
//! A file has x, y and z of each point as integers of 32 bits, and in its header a scale and an offset for each axis.
//! The integers become the steps of the points, so nothing is rounded. COPC is a LAZ file whose chunks differ in
//! length; all its points are read, in the order of the file. `laz` decodes the chunks of LAZ. This module reads and
//! checks the header and all counts, so that a claim of the file alone allocates nothing.

mod chunks;
mod guard;
mod header;
mod packing;
mod scale;
mod sieve;

use std::io::{Read, Seek, SeekFrom};

use crate::failure::{counted, Failure};
use crate::formats::pieces::Take;
use crate::formats::selection::Selection;
use crate::input::{unreadable, Input};
use crate::points::PointTable;

use header::{refuse, Header};
use packing::Packing;
use sieve::Sieve;

/// The number of bytes that are read at once from a file that is not packed.
const BLOCK_BYTES: usize = 1 << 18;

/// Reads the selected points of a file.
pub fn read_points(input: Input, selection: &Selection) -> Result<PointTable, Failure> {
    let memory = input.memory();
    let mut source = input.into_seekable()?;
    let header = header::read(&mut *source)?;
    let mut sieve = Sieve::new(&header, selection, memory);
    read_all(&mut *source, &header, &mut sieve)?;
    Ok(sieve.into_table())
}

/// Calls `take` with the coordinates of the selected points, in pieces. The memory holds one piece, and one packed
/// chunk of a LAZ file. An input that is packed as a whole is unpacked into the memory.
///
/// # Errors
/// As for [`read_points`], except that there may be any number of points; or `take` fails.
pub fn read_pieces(input: Input, selection: &Selection, take: Take<'_>) -> Result<(), Failure> {
    let mut source = input.into_seekable()?;
    let header = header::read(&mut *source)?;
    let mut sieve = Sieve::of_pieces(&header, selection, take);
    read_all(&mut *source, &header, &mut sieve)?;
    sieve.finish()
}

/// The number of points that the header promises, if the bytes of the file have room for them.
///
/// # Errors
/// The header or the table of the chunks cannot be read, or contradicts the length of the file.
pub fn count_points(input: Input) -> Result<u64, Failure> {
    let mut source = input.into_seekable()?;
    let header = header::read(&mut *source)?;
    match &header.packing {
        Some(record) => chunks::check_table(&mut *source, &header, &Packing::of(record, &header)?)?,
        None => check_room(&header)?,
    }
    Ok(header.count)
}

fn read_all<R: Read + Seek + ?Sized>(source: &mut R, header: &Header, sieve: &mut Sieve<'_>) -> Result<(), Failure> {
    match &header.packing {
        Some(record) => chunks::read(source, header, &Packing::of(record, header)?, sieve),
        None => read_plain(source, header, sieve),
    }
}

/// Refuses a LAS file whose points do not end where the header says that something else begins, or else at the end of
/// the file, so a count that is too small loses no points silently.
fn check_room(header: &Header) -> Result<(), Failure> {
    let &Header { record_bytes, count, data_start, .. } = header;
    let end = header.tail.unwrap_or(header.file_bytes);
    let room = end - data_start;
    let held = room / record_bytes as u64;
    if held < count {
        return Err(refuse(format!("the header promises {count} points, but the file has room for {held}")));
    }
    let rest = room - count * record_bytes as u64;
    if rest > 0 && (header.tail.is_none() || held > count) {
        return Err(refuse(format!(
            "the file holds more than the {count} points that its header promises: {} after them",
            counted(rest as usize, "byte")
        )));
    }
    Ok(())
}

/// Reads the points of a LAS file.
fn read_plain<R: Read + Seek + ?Sized>(source: &mut R, header: &Header, sieve: &mut Sieve<'_>) -> Result<(), Failure> {
    check_room(header)?;
    let &Header { record_bytes, count, data_start, .. } = header;
    source.seek(SeekFrom::Start(data_start)).map_err(|error| unreadable(&error))?;
    let block = (BLOCK_BYTES / record_bytes).max(1);
    let mut records = vec![0; block * record_bytes];
    let mut left = count;
    while left > 0 {
        let now = left.min(block as u64);
        let records = &mut records[..now as usize * record_bytes];
        source.read_exact(records).map_err(|error| unreadable(&error))?;
        sieve.take(records)?;
        left -= now;
    }
    Ok(())
}
