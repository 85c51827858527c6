//! The packed points of a LAZ file, chunk by chunk.
//!
//! A table at the end says how many bytes each chunk has, and, if chunks differ in length, how many points. Before any
//! chunk is decoded, two sums are checked: the chunks must fill the bytes between the header and the table exactly, and
//! must have as many points as the header promises. A chunk must end where its last point ends, which reveals a count
//! that is too small.

use std::io::{Cursor, Read, Seek, SeekFrom};

use laz::laszip::{ChunkTable, ChunkTableEntry};
use laz::record::{LayeredPointRecordDecompressor, RecordDecompressor, SequentialPointRecordDecompressor};
use laz::DecompressionSelection;

use crate::failure::{counted, Failure};
use crate::input::unreadable;

use super::guard::guarded;
use super::header::{read_at, refuse, Header};
use super::packing::Packing;
use super::sieve::Sieve;

/// Bytes before the first chunk, which hold the place of the table.
const PLACE_BYTES: u64 = 8;
/// Bytes of the head of the table: its version and the number of chunks.
const TABLE_HEAD: u64 = 8;
/// An upper bound for the bytes of the head and the end of a table.
const TABLE_ROOM: u64 = 64;
/// An upper bound for the bytes of an entry of the table, which has a number of bytes and a number of points.
const ENTRY_ROOM: u64 = 32;
/// More points than a byte of layers can hold. Each point has a symbol of a model in which all symbols together count
/// up to 2^15 and each of the others at least 1, so the most frequent one of 128 still takes 0.0056 bits.
const POINTS_OF_BYTE: u64 = 2048;
/// The number of records that are decoded at once.
const BLOCK: usize = 1024;

/// A chunk, by its number of bytes and of points.
struct Chunk {
    bytes: u64,
    points: u64,
}

/// Reads all points of a LAZ file into the sieve.
pub fn read<R: Read + Seek + ?Sized>(
    source: &mut R,
    header: &Header,
    packing: &Packing,
    sieve: &mut Sieve<'_>,
) -> Result<(), Failure> {
    let chunks = read_table(source, header, packing)?;
    source.seek(SeekFrom::Start(header.data_start + PLACE_BYTES)).map_err(|error| unreadable(&error))?;
    let mut bytes = Vec::new();
    for (index, chunk) in chunks.iter().enumerate() {
        bytes.clear();
        source.take(chunk.bytes).read_to_end(&mut bytes).map_err(|error| unreadable(&error))?;
        let at = |why: String| refuse(format!("chunk {} of {}: {why}", index + 1, chunks.len()));
        if chunk.points == 0 && chunk.bytes < header.record_bytes as u64 {
            // Some programs write an empty last chunk, with no bytes or with the few that end the packing.
            continue;
        }
        if chunk.points == 0 {
            return Err(at(format!("it has {} bytes, but the header leaves it no points", chunk.bytes)));
        }
        if packing.is_layered {
            check_layers(&bytes, chunk, header, packing).map_err(at)?;
        }
        let decoded = guarded(|| decode(&bytes, chunk, header, packing, sieve));
        match decoded.unwrap_or_else(|| Err(Fault::Damage("the packed bytes make no sense".to_owned()))) {
            Ok(()) => {}
            Err(Fault::Damage(why)) => return Err(at(why)),
            Err(Fault::Refusal(failure)) => return Err(failure),
        }
    }
    Ok(())
}

/// Refuses a file whose table of chunks contradicts its header or its length.
pub fn check_table<R: Read + Seek + ?Sized>(source: &mut R, header: &Header, packing: &Packing) -> Result<(), Failure> {
    read_table(source, header, packing).map(drop)
}

/// The chunks by the table of the file.
fn read_table<R: Read + Seek + ?Sized>(
    source: &mut R,
    header: &Header,
    packing: &Packing,
) -> Result<Vec<Chunk>, Failure> {
    let start = header.data_start.saturating_add(PLACE_BYTES);
    let mut place = place_at(source, header.data_start)?;
    if !(start..header.file_bytes).contains(&place) {
        // A program that could not go back to the start puts the place at the end of the file.
        place = place_at(source, header.file_bytes.saturating_sub(PLACE_BYTES))?;
    }
    // A file that was cut off has points where its table would be, and its place is beyond all files.
    let is_inside = (start..header.file_bytes).contains(&place);
    let head = if is_inside { read_at(source, place, TABLE_HEAD)? } else { Vec::new() };
    let Ok([_, _, _, _, count @ ..]) = <[u8; 8]>::try_from(head) else {
        return Err(refuse(format!(
            "the table of chunks behind the points is missing: the file of {} bytes is cut off or damaged, so copy or \
             download it again",
            header.file_bytes
        )));
    };
    let (count, room) = (u32::from_le_bytes(count), place - start);
    // Every chunk but an empty last one begins with a point that is not packed.
    if u64::from(count) > room / header.record_bytes as u64 + 1 {
        return Err(refuse(format!("the table promises {count} chunks, for which {room} bytes are too few")));
    }
    let has_points = packing.vlr.uses_variable_size_chunks();
    let rest = read_at(source, place, TABLE_ROOM + ENTRY_ROOM * u64::from(count))?;
    let table = guarded(|| ChunkTable::read(&mut Cursor::new(&rest[..]), has_points)).and_then(Result::ok);
    let Some(table) = table else {
        return Err(refuse(format!("the table of {count} chunks cannot be read: the file is cut off or damaged")));
    };
    let sizes = table.as_ref().iter().map(|entry| entry.byte_count);
    let sum = sizes.clone().try_fold(0u64, u64::checked_add);
    if sum != Some(room) {
        return Err(refuse(format!("the {count} chunks of the table do not fill the {room} bytes of the points")));
    }
    let points = points_of_chunks(table.as_ref(), header, packing).ok_or_else(|| {
        let (promised, count) = (header.count, counted(count as usize, "chunk"));
        refuse(format!("the header promises {promised} points, but the file has {count} with another number of points"))
    })?;
    Ok(sizes.zip(points).map(|(bytes, points)| Chunk { bytes, points }).collect())
}

/// The number of points in each chunk; `None` if they are not those that the header promises.
fn points_of_chunks(table: &[ChunkTableEntry], header: &Header, packing: &Packing) -> Option<Vec<u64>> {
    if !packing.vlr.uses_variable_size_chunks() {
        return shares(header.count, packing.vlr.chunk_size().into(), table.len() as u64);
    }
    let given: Vec<u64> = table.iter().map(|entry| entry.point_count).collect();
    let sum = given.iter().try_fold(0u64, |sum, &points| sum.checked_add(points));
    (sum == Some(header.count)).then_some(given)
}

/// The 64-bit number at a place of the file, or zero if the file ends before it.
fn place_at<R: Read + Seek + ?Sized>(source: &mut R, place: u64) -> Result<u64, Failure> {
    let bytes = read_at(source, place, PLACE_BYTES)?;
    Ok(bytes.try_into().map_or(0, u64::from_le_bytes))
}

/// The number of points in each of `count` chunks that have `total` points in all. Every chunk has `size` points, but
/// the last one may have fewer, and an empty chunk may follow it. `None` if `count` chunks cannot have `total` points.
fn shares(total: u64, size: u64, count: u64) -> Option<Vec<u64>> {
    let full = total.div_ceil(size);
    if count != full && count != full + 1 {
        return None;
    }
    Some((0..count).map(|index| size.min(total.saturating_sub(index * size))).collect())
}

/// Refuses a layered chunk whose own count of points differs from `chunk` or is too large for its bytes, or whose
/// layers do not fill its bytes.
fn check_layers(bytes: &[u8], chunk: &Chunk, header: &Header, packing: &Packing) -> Result<(), String> {
    let word = |place: usize| bytes.get(place..place + 4)?.try_into().ok().map(u32::from_le_bytes);
    let first = header.record_bytes;
    let count = word(first).ok_or("its first point is cut off")?;
    if u64::from(count) != chunk.points {
        return Err(format!("it has {count} points, but the header promises {}", chunk.points));
    }
    if chunk.points > chunk.bytes.saturating_mul(POINTS_OF_BYTE) {
        return Err(format!("its {} bytes are too few for {count} points", chunk.bytes));
    }
    let layers = first + 4..first + 4 + 4 * packing.layers;
    let sizes = layers.clone().step_by(4).map(|place| word(place).map(u64::from));
    let sum = sizes.sum::<Option<u64>>().map(|sum| sum + layers.end as u64);
    if sum != Some(chunk.bytes) {
        return Err(format!("its layers do not fill its {} bytes", chunk.bytes));
    }
    Ok(())
}

/// The reason why a chunk was not read to its end.
enum Fault {
    /// The chunk is damaged.
    Damage(String),
    /// The points were refused.
    Refusal(Failure),
}

/// Decodes a chunk of at least one point.
fn decode(bytes: &[u8], chunk: &Chunk, header: &Header, packing: &Packing, sieve: &mut Sieve<'_>) -> Result<(), Fault> {
    let mut layered;
    let mut pointwise;
    let decoder: &mut dyn RecordDecompressor<Cursor<&[u8]>> = if packing.is_layered {
        layered = LayeredPointRecordDecompressor::new(Cursor::new(bytes));
        &mut layered
    } else {
        pointwise = SequentialPointRecordDecompressor::new(Cursor::new(bytes));
        &mut pointwise
    };
    decoder.set_fields_from(packing.vlr.items()).map_err(|error| Fault::Damage(error.to_string()))?;
    let selection = DecompressionSelection::base().decompress_z();
    decoder.set_selection(if sieve.wants_class() { selection.decompress_classification() } else { selection });
    let mut block = vec![0; BLOCK * header.record_bytes];
    let mut left = chunk.points;
    while left > 0 {
        let count = left.min(BLOCK as u64);
        let records = &mut block[..count as usize * header.record_bytes];
        let done = chunk.points - left;
        decoder.decompress_many(records).map_err(|_| {
            Fault::Damage(format!("it ends after {done} to {} of its {} points", done + count - 1, chunk.points))
        })?;
        sieve.take(records).map_err(Fault::Refusal)?;
        left -= count;
    }
    match chunk.bytes - decoder.get().position() {
        0 => Ok(()),
        rest => Err(Fault::Damage(format!("it has {rest} bytes after its {} points", chunk.points))),
    }
}
