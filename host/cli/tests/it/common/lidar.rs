//! Files of laser scanners, made by the writer of the crate `las` and packed by that of `laz`.

use std::io::{Cursor, Seek, SeekFrom, Write};

use laz::{LasZipCompressor, LazVlr, LazVlrBuilder};

/// A point as a file stores it: the integers of x, y and z, and the class.
pub type Stored = ([i32; 3], u8);

/// The scale and the offset of an axis.
pub type Axis = (f64, f64);

/// Writes points by the crate `las` as a file of this minor version and point format.
pub fn write(minor: u8, format: u8, is_packed: bool, axes: [Axis; 3], points: &[Stored]) -> Vec<u8> {
    let mut builder = las::Builder::from((1, minor));
    builder.point_format = las::point::Format::new(format).expect("a format");
    builder.point_format.is_compressed = is_packed;
    let [x, y, z] = axes.map(|(scale, offset)| las::Transform { scale, offset });
    builder.transforms = las::Vector { x, y, z };
    let header = builder.into_header().expect("a header");
    let mut writer = las::Writer::new(Cursor::new(Vec::new()), header).expect("a writer");
    for &([i, j, k], class) in points {
        let about = las::point::Format::new(format).expect("a format");
        let point = las::Point {
            x: x.direct(i),
            y: y.direct(j),
            z: z.direct(k),
            return_number: 1,
            number_of_returns: 1,
            classification: las::point::Classification::new(class).expect("a class"),
            gps_time: about.has_gps_time.then_some(1.0),
            color: about.has_color.then(|| las::Color::new(1, 2, 3)),
            nir: about.has_nir.then_some(4),
            ..las::Point::default()
        };
        writer.write_point(point).expect("memory takes all points");
    }
    writer.close().expect("memory takes all points");
    writer.into_inner().expect("the writer is closed").into_inner()
}

/// A number of the header of a file.
pub fn word(file: &[u8], place: usize) -> usize {
    u32::from_le_bytes(file[place..place + 4].try_into().expect("four bytes")) as usize
}

/// The head and the content of a variable-length record.
fn vlr(user: &[u8], number: u16, content: &[u8]) -> Vec<u8> {
    let mut record = vec![0; 54];
    record[2..2 + user.len()].copy_from_slice(user);
    record[18..20].copy_from_slice(&number.to_le_bytes());
    record[20..22].copy_from_slice(&(content.len() as u16).to_le_bytes());
    record.extend(content);
    record
}

/// Packs a LAS 1.4 file into a COPC file whose chunks have these numbers of points.
pub fn copc(plain: &[u8], chunks: &[usize]) -> Vec<u8> {
    let format = plain[104];
    let laz =
        LazVlrBuilder::default().with_point_format(format, 0).expect("a format").with_variable_chunk_size().build();
    let mut packing = Vec::new();
    laz.write_to(&mut packing).expect("memory takes all bytes");
    let mut file = Cursor::new(plain[..375].to_vec());
    file.seek(SeekFrom::End(0)).expect("a place in memory");
    let info = vlr(b"copc", 1, &[0; 160]);
    let records = [info, vlr(LazVlr::USER_ID.as_bytes(), LazVlr::RECORD_ID, &packing)].concat();
    file.write_all(&records).expect("memory takes all bytes");
    let start = 375 + records.len();
    let mut points = &plain[word(plain, 96)..];
    let record = usize::from(u16::from_le_bytes([plain[105], plain[106]]));
    let mut packer = LasZipCompressor::new(file, laz).expect("a packer");
    for count in chunks {
        let (chunk, rest) = points.split_at(count * record);
        packer.compress_many(chunk).expect("memory takes all bytes");
        packer.finish_current_chunk().expect("memory takes all bytes");
        points = rest;
    }
    assert!(points.is_empty());
    packer.done().expect("memory takes all bytes");
    let mut file = packer.into_inner().into_inner();
    // The hierarchy of a COPC file is an extended variable-length record.
    let hierarchy = file.len() as u64;
    let mut evlr = vec![0; 60 + 32];
    evlr[2..6].copy_from_slice(b"copc");
    evlr[18..20].copy_from_slice(&1000u16.to_le_bytes());
    evlr[20..28].copy_from_slice(&32u64.to_le_bytes());
    file.extend(evlr);
    file[96..100].copy_from_slice(&(start as u32).to_le_bytes());
    file[100..104].copy_from_slice(&2u32.to_le_bytes());
    file[104] |= 0x80;
    file[235..243].copy_from_slice(&hierarchy.to_le_bytes());
    file[243..247].copy_from_slice(&1u32.to_le_bytes());
    file
}
