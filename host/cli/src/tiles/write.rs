//! The triangles of a joined set, written one after the other.

use std::cell::RefCell;
use std::io::{self, Write};
use std::path::Path;

use super::join::{Joined, Order};
use super::manifest::Manifest;
use crate::failure::Failure;
use crate::formats::{npy_writer, MeshFormat};
use crate::output::{Output, Written};
use crate::progress::CountMeter;

/// Writes the triangles of a set whose tiles are in `folder`, in this order. The lists of the tiles take about `memory`
/// bytes. The format must be [streamed](MeshFormat::is_streamed).
///
/// # Errors
/// A file of the tiles cannot be read, or the output cannot be written.
pub fn write_triangles(
    joined: Joined,
    (folder, manifest): (&Path, &Manifest),
    (order, memory): (Order, u64),
    format: MeshFormat,
    output: Output,
    quiet: bool,
) -> Result<Written, Failure> {
    let failed = RefCell::new(None);
    let written = output.write(|out| {
        write_head(joined.triangles, format, out)?;
        let meter = CountMeter::new(joined.triangles, "writing", "triangles", quiet);
        let mut id = 0u64;
        let mut disk = None;
        let done = joined.each((folder, manifest), order, memory, &mut |triangles| {
            meter.advance(triangles.len() as u64);
            write_some(triangles, format, &mut id, out).map_err(|error| {
                let failure = Failure::input(error.to_string());
                disk = Some(error);
                failure
            })
        });
        match (done, disk) {
            (Ok(()), _) => Ok(()),
            (_, Some(error)) => Err(error),
            (Err(failure), None) => {
                *failed.borrow_mut() = Some(failure);
                Err(io::Error::other("the tiles cannot be read"))
            }
        }
    });
    // If a file of the tiles cannot be read, its own sentence is better than that of the output.
    match failed.into_inner() {
        Some(failure) => Err(failure),
        None => written,
    }
}

fn write_head(triangles: u64, format: MeshFormat, out: &mut dyn Write) -> io::Result<()> {
    match format {
        MeshFormat::Npy => npy_writer::write_mesh_head(triangles, out),
        MeshFormat::Ele => writeln!(out, "{triangles} 3 0"),
        _ => Ok(()),
    }
}

fn write_some(triangles: &[[u32; 3]], format: MeshFormat, id: &mut u64, out: &mut dyn Write) -> io::Result<()> {
    match format {
        MeshFormat::Npy => npy_writer::write_triangles(triangles, out),
        MeshFormat::Ele => triangles.iter().try_for_each(|[a, b, c]| {
            *id += 1;
            writeln!(out, "{} {a} {b} {c}", *id - 1)
        }),
        _ => triangles.iter().try_for_each(|[a, b, c]| writeln!(out, "{a},{b},{c}")),
    }
}
