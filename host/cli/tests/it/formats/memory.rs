//! Tests that readers refuse more than the memory holds, while they read and in every format.

use std::process::Command;

use incircle_cli::formats::{MeshFormat, PointFormat, Selection};
use incircle_cli::{Input, Memory};

use super::lidar::{points, AXES};
use crate::common::lidar::write;
use crate::common::{Run, Scratch};

/// Bytes of memory for a point, as the command counts them.
const POINT_BYTES: u64 = 224;
/// Points of each file.
const POINTS: usize = 20;

/// A file of twenty points in every format.
fn files() -> Vec<(PointFormat, Vec<u8>)> {
    let rows = |row: &str| row.repeat(POINTS).into_bytes();
    let list = |item: &str| vec![item; POINTS].join(",");
    let head = "ply\nformat ascii 1.0\nelement vertex 20\nproperty int x\nproperty int y\nend_header\n";
    let array = "{'descr': '|i1', 'fortran_order': False, 'shape': (20, 2)}";
    let array = [b"\x93NUMPY\x01\x00".as_slice(), &[array.len() as u8, 0], array.as_bytes(), &[1; 2 * POINTS]].concat();
    let nodes: String = (0..POINTS).map(|id| format!("{id} 1 2\n")).collect();
    let mut archive = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    archive.start_file("a.npy", zip::write::SimpleFileOptions::default()).expect("a new name");
    std::io::Write::write_all(&mut archive, &array).expect("memory takes all bytes");
    let las = points(POINTS as u64, 1);
    vec![
        (PointFormat::Csv, rows("1,2\n")),
        (PointFormat::Csv, rows("1,2,\"a\"\n")),
        (PointFormat::Xyz, rows("1 2\n")),
        (PointFormat::Node, format!("20 2 0 0\n{nodes}").into_bytes()),
        (PointFormat::Obj, rows("v 1 2 3\n")),
        (PointFormat::Ply, [head.as_bytes(), &rows("1 2\n")].concat()),
        (PointFormat::Geojson, format!("{{\"type\":\"MultiPoint\",\"coordinates\":[{}]}}", list("[1,2]")).into()),
        (PointFormat::Json, format!("{{\"points\":[{}]}}", list("[1,2]")).into_bytes()),
        (PointFormat::Las, write(2, 0, false, AXES, &las)),
        (PointFormat::Las, write(2, 0, true, AXES, &las)),
        (PointFormat::Npz, archive.finish().expect("memory takes all bytes").into_inner()),
        (PointFormat::Npy, array),
        (PointFormat::Wkt, rows("POINT (1 2)\n")),
    ]
}

#[test]
fn no_reader_takes_more_points_than_fit() {
    for (format, file) in files() {
        let read = |points: u64| {
            let input = Input::of_bytes_within(&file, Memory::of_bytes(points * POINT_BYTES));
            format.read(input, &Selection::default()).map(|table| table.len())
        };
        assert_eq!(read(POINTS as u64), Ok(POINTS), "{format:?}");
        let failure = read(POINTS as u64 - 1).expect_err("a point too many");
        assert!(failure.message.contains("more than 19 points"), "{format:?}: {failure}");
        assert!(failure.message.contains("free memory"), "{format:?}: {failure}");
    }
}

#[test]
fn no_reader_takes_more_triangles_than_fit() {
    let rows = |row: &str| row.repeat(8).into_bytes();
    let head = "ply\nformat ascii 1.0\nelement face 8\nproperty list uchar int vertex_indices\nend_header\n";
    let array = "{'descr': '|u1', 'fortran_order': False, 'shape': (8, 3)}";
    let files = [
        (MeshFormat::Ele, [b"8 3 0\n".as_slice(), &rows("1 0 1 2\n")].concat()),
        (MeshFormat::Obj, rows("f 1 2 3\n")),
        (MeshFormat::Ply, [head.as_bytes(), &rows("3 0 1 2\n")].concat()),
        (MeshFormat::Csv, rows("0,1,2\n")),
        (MeshFormat::Json, format!("{{\"triangles\":[{}]}}", ["[0,1,2]"; 8].join(",")).into_bytes()),
        (
            MeshFormat::Npy,
            [b"\x93NUMPY\x01\x00".as_slice(), &[array.len() as u8, 0], array.as_bytes(), &[1; 24]].concat(),
        ),
    ];
    for (format, file) in files {
        let read = |triangles: u64| format.read(Input::of_bytes_within(&file, Memory::of_bytes(triangles * 96)));
        assert_eq!(read(8).map(|mesh| mesh.len()), Ok(8), "{format:?}");
        let failure = read(7).expect_err("a triangle too many");
        assert!(failure.message.contains("more than 7 triangles"), "{format:?}: {failure}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_limit_of_addresses_ends_in_a_sentence() {
    let scratch = Scratch::new();
    let rows = "1,2\n".repeat(3_000_000);
    scratch.write("p.csv", &rows);
    scratch.write("p.csv.zst", zstd::encode_all(rows.as_bytes(), 0).expect("memory takes all bytes"));
    for name in ["p.csv", "p.csv.zst"] {
        let program = env!("CARGO_BIN_EXE_incircle");
        let line = format!("ulimit -v 600000 && exec '{program}' triangulate {name} -o m.obj");
        let mut command = Command::new("sh");
        command.args(["-c", &line]).current_dir(scratch.path(""));
        let run = Run::of(command.output().expect("the shell starts"));
        run.fails(3, &[name, "more than", "points", "free memory", "224 bytes a point"]);
    }
    assert_eq!(scratch.files(), ["p.csv", "p.csv.zst"]);
}
