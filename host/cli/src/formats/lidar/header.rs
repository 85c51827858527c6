//! The header of a LAS file. Every number in it is a claim, which is checked against the file before it is used.

use std::io::{self, Read, Seek, SeekFrom};

use crate::failure::{counted, Failure};
use crate::input::unreadable;

/// Bytes of the header of LAS 1.4, the longest one.
const LONGEST: usize = 375;
/// Bytes of the header of each version from 1.0 on.
const HEADER_BYTES: [usize; 5] = [227, 227, 227, 235, LONGEST];
/// Bytes of a record of each point format, without extra bytes.
const RECORD_BYTES: [usize; 11] = [20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67];
/// The bit of the point format that LAZ sets.
const PACKED: u8 = 0x80;
/// Bytes of the head of a variable-length record.
const VLR_HEAD: u64 = 54;
/// Bytes of the head of an extended variable-length record.
const EVLR_HEAD: u64 = 60;
/// The name and the number of the variable-length record in which LAZ describes its packing.
const PACKING: (&[u8], u16) = (b"laszip encoded", 22204);

/// The fields of a header that the reader needs, all checked against the length of the file.
#[derive(Clone, Debug)]
pub struct Header {
    /// The point format, 0 to 10.
    pub format: u8,
    /// Bytes of a record.
    pub record_bytes: usize,
    /// The number of points that the header promises.
    pub count: u64,
    /// The place of the first record, or of the packed records.
    pub data_start: u64,
    /// The length of the file.
    pub file_bytes: u64,
    /// The place of the first thing behind the points, if the header names one.
    pub tail: Option<u64>,
    /// The lengths of a step in x, y and z.
    pub scale: [f64; 3],
    /// The place of step 0 in x, y and z.
    pub offset: [f64; 3],
    /// The record in which LAZ describes its packing; `None` if the points are not packed.
    pub packing: Option<Vec<u8>>,
}

impl Header {
    /// Whether the point format is one of LAS 1.4, whose records have a byte for the class.
    pub fn is_extended(&self) -> bool {
        self.format >= 6
    }
}

/// Reads the header and the variable-length records.
pub fn read<R: Read + Seek + ?Sized>(source: &mut R) -> Result<Header, Failure> {
    let file_bytes = source.seek(SeekFrom::End(0)).map_err(|error| unreadable(&error))?;
    let block = read_at(source, 0, LONGEST as u64)?;
    let block = Block { len: block.len(), bytes: padded(&block) };
    let minor = check_version(&block)?;
    let (format, is_packed, record_bytes) = record_form(&block)?;
    let header_bytes = u64::from(u16::from_le_bytes(block.at(94)));
    let data_start = u64::from(u32::from_le_bytes(block.at(96)));
    let least = HEADER_BYTES[minor] as u64;
    if header_bytes < least {
        return Err(refuse(format!("the header of LAS 1.{minor} has {least} bytes, but the file says {header_bytes}")));
    }
    if data_start < header_bytes || data_start > file_bytes {
        return Err(refuse(format!(
            "the points begin at byte {data_start}, which is not between the header of {header_bytes} bytes and the \
             end of the file at {file_bytes}"
        )));
    }
    let vlrs = u32::from_le_bytes(block.at(100));
    let packing = find_packing(source, header_bytes, data_start, vlrs)?;
    if is_packed && packing.is_none() {
        return Err(refuse("the points are packed as LAZ, but no record of the header says how"));
    }
    let count = count(&block, minor, format)?;
    let tail = find_tail(source, &block, minor, data_start, file_bytes)?;
    let (scale, offset) = scales(&block)?;
    let packing = packing.filter(|_| is_packed);
    Ok(Header { format, record_bytes, count, data_start, file_bytes, tail, scale, offset, packing })
}

/// The header's bytes, with zeros where a shorter version has none.
struct Block {
    len: usize,
    bytes: [u8; LONGEST],
}

impl Block {
    fn at<const N: usize>(&self, place: usize) -> [u8; N] {
        let mut found = [0; N];
        found.copy_from_slice(&self.bytes[place..place + N]);
        found
    }
}

fn padded(bytes: &[u8]) -> [u8; LONGEST] {
    let mut all = [0; LONGEST];
    all[..bytes.len()].copy_from_slice(bytes);
    all
}

/// Up to `len` bytes from a place on.
pub fn read_at<R: Read + Seek + ?Sized>(source: &mut R, place: u64, len: u64) -> Result<Vec<u8>, Failure> {
    let mut bytes = Vec::new();
    let mut read = || -> io::Result<usize> {
        // A file may have a million short records: a relative seek keeps what the reader has buffered.
        let by = i128::from(place) - i128::from(source.stream_position()?);
        match i64::try_from(by) {
            Ok(by) => source.seek_relative(by)?,
            Err(_) => source.seek(SeekFrom::Start(place)).map(drop)?,
        }
        source.take(len).read_to_end(&mut bytes)
    };
    read().map_err(|error| unreadable(&error))?;
    Ok(bytes)
}

/// The failure of a file that is no valid LAS.
pub fn refuse(why: impl Into<String>) -> Failure {
    Failure::input(why)
}

/// The minor version, if the file is a LAS of a version that is read.
fn check_version(block: &Block) -> Result<usize, Failure> {
    if !block.bytes.starts_with(b"LASF") {
        return Err(refuse("not a LAS or LAZ file: such a file begins with 'LASF'"));
    }
    let [major, minor] = block.at(24);
    let Some(&least) = HEADER_BYTES.get(usize::from(minor)).filter(|_| major == 1) else {
        return Err(refuse(format!("LAS {major}.{minor} is not read: convert the file to LAS 1.0 to 1.4")));
    };
    if block.len < least {
        let have = counted(block.len, "byte");
        return Err(refuse(format!("the file ends after {have}, within the header of {least} bytes")));
    }
    Ok(usize::from(minor))
}

/// The point format, whether the points are packed, and the bytes of a record.
fn record_form(block: &Block) -> Result<(u8, bool, usize), Failure> {
    let [code] = block.at(104);
    let format = code & !PACKED;
    let Some(&least) = RECORD_BYTES.get(usize::from(format)) else {
        return Err(refuse(format!("the point format is {format}: LAS has the formats 0 to 10")));
    };
    let record_bytes = usize::from(u16::from_le_bytes(block.at(105)));
    if record_bytes < least {
        return Err(refuse(format!(
            "a point of format {format} has at least {least} bytes, but the header says {record_bytes}"
        )));
    }
    Ok((format, code & PACKED != 0, record_bytes))
}

/// The number of points. LAS 1.4 stores the number twice: in 64 bits, and for older readers in 32 bits or as zero.
fn count(block: &Block, minor: usize, format: u8) -> Result<u64, Failure> {
    let short = u64::from(u32::from_le_bytes(block.at(107)));
    if minor < 4 {
        return Ok(short);
    }
    let long = u64::from_le_bytes(block.at(247));
    if short != 0 && short != long {
        return Err(refuse(format!(
            "the header promises {long} points of format {format} in one place, and {short} in another"
        )));
    }
    Ok(long)
}

/// Looks for the record that describes the packing. All variable-length records must lie before the points.
fn find_packing<R: Read + Seek + ?Sized>(
    source: &mut R,
    start: u64,
    end: u64,
    count: u32,
) -> Result<Option<Vec<u8>>, Failure> {
    let mut place = start;
    let mut found = None;
    for number in 1..=count {
        let head = read_at(source, place, VLR_HEAD.min(end - place))?;
        let body = place + VLR_HEAD;
        let len = head.get(20..22).map_or(0, |len| u64::from(u16::from_le_bytes([len[0], len[1]])));
        if head.len() as u64 != VLR_HEAD || body + len > end {
            return Err(refuse(format!(
                "variable-length record {number} of {count} does not end before the points at byte {end}"
            )));
        }
        let name = head[2..18].split(|&byte| byte == 0).next().unwrap_or_default();
        if (name, u16::from_le_bytes([head[18], head[19]])) == PACKING && found.is_none() {
            found = Some(read_at(source, body, len)?);
        }
        place = body + len;
    }
    Ok(found)
}

/// The place of the first thing behind the points that the header names: waveforms, or the extended variable-length
/// records of LAS 1.4, which must lie within the file.
fn find_tail<R: Read + Seek + ?Sized>(
    source: &mut R,
    block: &Block,
    minor: usize,
    data_start: u64,
    file_bytes: u64,
) -> Result<Option<u64>, Failure> {
    let waveforms = if minor >= 3 { u64::from_le_bytes(block.at(227)) } else { 0 };
    let count = if minor >= 4 { u32::from_le_bytes(block.at(243)) } else { 0 };
    let start = if count > 0 { u64::from_le_bytes(block.at(235)) } else { 0 };
    for (what, place) in [("waveforms", waveforms), ("extended records", start)] {
        if place != 0 && !(data_start..=file_bytes).contains(&place) {
            return Err(refuse(format!(
                "the {what} begin at byte {place}, which is not between the points and the end of the file at \
                 {file_bytes}"
            )));
        }
    }
    let mut place = start;
    for number in 1..=count {
        let head = read_at(source, place, EVLR_HEAD)?;
        let len = head.get(20..28).and_then(|len| len.try_into().ok()).map_or(0, u64::from_le_bytes);
        let end = place.checked_add(EVLR_HEAD).and_then(|body| body.checked_add(len));
        place = end.filter(|&end| start != 0 && end <= file_bytes).ok_or_else(|| {
            refuse(format!("extended record {number} of {count} does not end before the end of the file"))
        })?;
    }
    Ok([waveforms, start].into_iter().filter(|&place| place != 0).min())
}

/// The scales and offsets, which must be finite, and the scales positive.
fn scales(block: &Block) -> Result<([f64; 3], [f64; 3]), Failure> {
    let numbers = |place: usize| [0, 8, 16].map(|step| f64::from_le_bytes(block.at(place + step)));
    let (scale, offset) = (numbers(131), numbers(155));
    for (axis, name) in ['x', 'y', 'z'].into_iter().enumerate() {
        if !(scale[axis] > 0.0 && scale[axis].is_finite()) {
            return Err(refuse(format!(
                "the scale of {name} in the header is {:e}: it must be a positive number",
                scale[axis]
            )));
        }
        if !offset[axis].is_finite() {
            return Err(refuse(format!(
                "the offset of {name} in the header is {}: it must be a finite number",
                offset[axis]
            )));
        }
    }
    Ok((scale, offset))
}
