//! The record in which LAZ describes its packing, checked against the header before a decoder is made from it.

use laz::LazVlr;

use crate::failure::{one_line, Failure};

use super::header::{refuse, Header};

/// The number of bytes of the record before the list of items.
const HEAD_BYTES: usize = 34;
/// Bytes of an item in the list.
const ITEM_BYTES: usize = 6;
/// The packing of the first point formats: all fields of a point, then those of the next.
const POINTWISE: u16 = 2;
/// The packing of the formats of LAS 1.4: a layer of bytes for each field.
const LAYERED: u16 = 3;
/// The item of the extra bytes of the first point formats.
const EXTRA: u16 = 0;
/// The item of the extra bytes of the formats of LAS 1.4.
const EXTRA_LAYERED: u16 = 14;

/// The packing of the points of a file.
pub struct Packing {
    /// The record in the form that the decoder takes.
    pub vlr: LazVlr,
    /// Whether each field of a chunk has layers of its own.
    pub is_layered: bool,
    /// The number of layers in a chunk, if the packing has layers.
    pub layers: usize,
}

impl Packing {
    /// Reads the record. The items that it names must be those of the point format.
    pub fn of(record: &[u8], header: &Header) -> Result<Self, Failure> {
        let word = |place: usize| record.get(place..place + 2).map_or(0, |two| u16::from_le_bytes([two[0], two[1]]));
        let items = usize::from(word(HEAD_BYTES - 2));
        if record.len() < HEAD_BYTES + items * ITEM_BYTES {
            return Err(refuse(format!(
                "the record of {} bytes about the packing is too short for its {items} items",
                record.len()
            )));
        }
        let (compressor, coder) = (word(0), word(2));
        let is_layered = header.is_extended();
        if compressor != if is_layered { LAYERED } else { POINTWISE } || coder != 0 {
            return Err(refuse(format!(
                "points of format {} with the packing {compressor} and the coder {coder} are not read: pack the file \
                 again with a newer program",
                header.format
            )));
        }
        let item = |index: usize| [0, 2, 4].map(|part| word(HEAD_BYTES + index * ITEM_BYTES + part));
        let found: Vec<[u16; 3]> = (0..items).map(item).collect();
        check_items(&found, header)?;
        let layers = found.iter().map(|&[kind, size, _]| layers_of(kind, size)).sum();
        // The decoder takes a list of items and ignores the bytes behind it.
        let vlr = LazVlr::read_from(record).map_err(|error| refuse(one_line(&error.to_string())))?;
        Ok(Self { vlr, is_layered, layers })
    }
}

/// The layers of an item.
fn layers_of(kind: u16, size: u16) -> usize {
    match kind {
        10 => 9,
        12 => 2,
        EXTRA_LAYERED => usize::from(size),
        _ => 1,
    }
}

/// The kinds and the bytes of the items of a point format, without extra bytes.
fn items_of(format: u8) -> &'static [(u16, u16)] {
    const FIRST: (u16, u16) = (6, 20);
    const TIME: (u16, u16) = (7, 8);
    const COLOUR: (u16, u16) = (8, 6);
    const WAVE: (u16, u16) = (9, 29);
    const EXTENDED: (u16, u16) = (10, 30);
    const NEAR_INFRARED: (u16, u16) = (12, 8);
    const EXTENDED_WAVE: (u16, u16) = (13, 29);
    match format {
        0 => &[FIRST],
        1 => &[FIRST, TIME],
        2 => &[FIRST, COLOUR],
        3 => &[FIRST, TIME, COLOUR],
        4 => &[FIRST, TIME, WAVE],
        5 => &[FIRST, TIME, COLOUR, WAVE],
        6 => &[EXTENDED],
        7 => &[EXTENDED, (11, 6)],
        8 => &[EXTENDED, NEAR_INFRARED],
        9 => &[EXTENDED, EXTENDED_WAVE],
        _ => &[EXTENDED, NEAR_INFRARED, EXTENDED_WAVE],
    }
}

/// Refuses items that are not those of the point format, each as `[kind, bytes, version]`. The decoder would trust
/// them.
fn check_items(found: &[[u16; 3]], header: &Header) -> Result<(), Failure> {
    let expected = items_of(header.format);
    let bytes = |items: &[[u16; 3]]| items.iter().map(|item| usize::from(item[1])).sum::<usize>();
    let (extra, versions) = if header.is_extended() { (EXTRA_LAYERED, 3..=4) } else { (EXTRA, 1..=2) };
    let is_right = found.len() >= expected.len()
        && found.iter().zip(expected).all(|(item, &(kind, size))| (item[0], item[1]) == (kind, size))
        && found[expected.len()..].iter().all(|item| item[0] == extra && item[1] > 0)
        && found.len() <= expected.len() + 1
        && found.iter().all(|item| versions.contains(&item[2]));
    if !is_right {
        return Err(refuse(format!(
            "the items of the packing are not those of point format {}: the file is damaged",
            header.format
        )));
    }
    if bytes(found) != header.record_bytes {
        return Err(refuse(format!(
            "the packing has points of {} bytes, but the header says {}",
            bytes(found),
            header.record_bytes
        )));
    }
    Ok(())
}
