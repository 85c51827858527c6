//! `.npy`, written: points as an array of n rows and two columns, meshes as one of m rows and three, little endian.

use std::io::{self, Write};

use npyz::{AutoSerialize, DType, TypeStr, WriteOptions, WriterBuilder};

use crate::formats::mesh_view::MeshView;

/// A number that an array can hold.
pub trait Stored: Copy {
    /// The type of the values in the array.
    type Value: Item;

    /// The value that is stored for the number.
    fn stored(self) -> Self::Value;
}

/// A type of the values in an array.
pub trait Item: AutoSerialize {
    /// The name of the type in the header of a file.
    const NAME: &'static str;
}

impl Item for u32 {
    const NAME: &'static str = "<u4";
}

impl Item for i32 {
    const NAME: &'static str = "<i4";
}

impl Item for f32 {
    const NAME: &'static str = "<f4";
}

impl Item for f64 {
    const NAME: &'static str = "<f8";
}

impl Stored for u32 {
    type Value = Self;

    fn stored(self) -> Self {
        self
    }
}

impl Stored for i32 {
    type Value = Self;

    fn stored(self) -> Self {
        self
    }
}

/// Writes points, one per row.
pub fn write_points<N: Stored>(points: impl ExactSizeIterator<Item = [N; 2]>, out: &mut dyn Write) -> io::Result<()> {
    let item: TypeStr = N::Value::NAME.parse().map_err(io::Error::other)?;
    let options = WriteOptions::new().dtype(DType::Plain(item)).shape(&[points.len() as u64, 2]);
    let mut array = options.writer(out).begin_nd()?;
    array.extend(points.flatten().map(N::stored))?;
    array.finish()
}

/// Writes the triangles as an array of m rows and three columns.
pub fn write_mesh(mesh: &MeshView<'_>, out: &mut dyn Write) -> io::Result<()> {
    write_mesh_head(mesh.triangles.len() as u64, out)?;
    write_triangles(mesh.triangles, out)
}

/// Writes the header of an array of this number of triangles.
pub fn write_mesh_head(triangles: u64, out: &mut dyn Write) -> io::Result<()> {
    let item: TypeStr = "<u4".parse().map_err(io::Error::other)?;
    let options = WriteOptions::new_header_only().dtype(DType::Plain(item)).shape(&[triangles, 3]);
    options.writer(&mut *out).write_header_only().map(|_| ())
}

/// Writes triangles behind the header.
pub fn write_triangles(triangles: &[[u32; 3]], out: &mut dyn Write) -> io::Result<()> {
    // Many triangles become bytes together, so that the time of the calls of the output does not count.
    const SOME: usize = 1 << 12;
    let mut bytes = Vec::with_capacity(SOME.min(triangles.len()) * 12);
    for some in triangles.chunks(SOME) {
        bytes.clear();
        bytes.extend(some.as_flattened().iter().flat_map(|index| index.to_le_bytes()));
        out.write_all(&bytes)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The bytes of the format are fixed by NumPy's page "numpy.lib.format", version 1.0.
    #[test]
    fn the_bytes_are_those_of_the_format() {
        let mut bytes = Vec::new();
        write_points([[1u32, 0x0203_0405], [7, 8]].into_iter(), &mut bytes).expect("memory can be written");
        let (head, data) = bytes.split_at(128);
        assert_eq!(head[..10], *b"\x93NUMPY\x01\x00\x76\x00");
        let text = std::str::from_utf8(&head[10..]).expect("ASCII");
        for part in ["'descr': '<u4'", "'fortran_order': False", "'shape': (2, 2"] {
            assert!(text.contains(part), "{text}");
        }
        assert_eq!(data, [1, 0, 0, 0, 5, 4, 3, 2, 7, 0, 0, 0, 8, 0, 0, 0]);
    }
}
