//! Tests that no reader panics on any bytes, and that accepted coordinates are finite.

use incircle_cli::formats::{MeshFormat, PointFormat, Selection};
use incircle_cli::Input;
use incircle_testkit::SplitMix64;

const POINT_FILES: [(PointFormat, &[u8]); 13] = [
    (PointFormat::Wkt, b"POINT (1 2)\nSRID=4326;MULTIPOINT Z ((3 4 5), EMPTY)\nGEOMETRYCOLLECTION (POINT(6 7))"),
    (PointFormat::Csv, b"x,y,\"name\"\n1,2,a\n3.5,-4e2,\"b\"\n# c\n5,6,d\n"),
    (PointFormat::Xyz, b"x y z\n1 2 3\n4\t5 6 # c\r\n7 8 9\n"),
    (PointFormat::Node, b"# a\n3 2 1 1\n1 1 2 0 0\n2 3 4 0 0\n3 5 6.5 0 0\n"),
    (PointFormat::Obj, b"o a\nv 1 2 3\nvn 0 0 1\nv 4.5 5 6\nf 1/1/1 2//2 1\n"),
    (
        PointFormat::Ply,
        b"ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty double y\nproperty list uchar int l\n\
          end_header\n\
          1 2 2 3 4\n5 6 0\n",
    ),
    (
        PointFormat::Ply,
        b"ply\nformat binary_little_endian 1.0\nelement e 1\nproperty list uint uchar l\nelement vertex 2\n\
          property short x\n\
          property float y\nend_header\n\x02\0\0\0ab12345612\x7f\x7f\x7f\x7f",
    ),
    (
        PointFormat::Ply,
        b"ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty list char double l\n\
          property uint x\nproperty char y\n\
          end_header\n\x0112345678abcde",
    ),
    (
        PointFormat::Geojson,
        b"{\"type\":\"FeatureCollection\",\"features\":[{\"type\":\"Feature\",\"properties\":null,\
          \"geometry\":{\"type\":\"GeometryCollection\",\"geometries\":[{\"type\":\"Point\",\"coordinates\":[1,2]},\
          {\"type\":\"MultiPoint\",\"coordinates\":[[3,4.5],[5e3,6,7]]}]}}]}",
    ),
    (PointFormat::Json, br#"{"points":[[1,2],[3.5,-4e2]],"triangles":[],"hull":[]}"#),
    (
        PointFormat::Npy,
        b"\x93NUMPY\x01\x008\x00{'descr': '<f4', 'fortran_order': True, 'shape': (2, 3)}\x00\x00\x80\
          ?\x00\x00\x00@\x00\x00@@\x00\x00\x90@\x00\x00\xa0@\x00\x00\xc0@",
    ),
    (
        PointFormat::Npy,
        b"\x93NUMPY\x01\x00N\x00{'descr': [('x', '>i2'), ('y', '|u1')], 'fortran_order': False, 'sha\
          pe': (2,)}\x00\x01\x02\x00\x03\x04",
    ),
    (
        PointFormat::Npz,
        b"PK\x03\x04\x14\x00\x00\x00\x00\x00\x00\x00!\x00\x10\xcd`\x8aK\x00\x00\x00K\x00\x00\x00\x05\
          \x00\x00\x00a.npy\x93NUMPY\x01\x009\x00{'descr': '<i2', 'fortran_order': False, 'shape': (\
          2, 2)}\x01\x00\x02\x00\x03\x00\xfc\xffPK\x01\x02\x14\x03\x14\x00\x00\x00\x00\x00\x00\x00!\x00\
          \x10\xcd`\x8aK\x00\x00\x00K\x00\x00\x00\x05\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x00\x80\
          \x01\x00\x00\x00\x00a.npyPK\x05\x06\x00\x00\x00\x00\x01\x00\x01\x003\x00\x00\x00n\x00\x00\x00\
          \x00\x00",
    ),
];

const MESH_FILES: [(MeshFormat, &[u8]); 6] = [
    (MeshFormat::Ele, b"2 3 0\n0 0 1 2\n1 1 3 2\n"),
    (MeshFormat::Obj, b"v 1 2 3\nf 1 2 3\nf 2/1 4//1 3/2/1\n"),
    (
        MeshFormat::Ply,
        b"ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nelement face 2\n\
          property list uchar int vertex_indices\n\
          end_header\n1\n3 0 1 2\n3 1 3 2\n",
    ),
    (MeshFormat::Json, br#"{"points":[[1,2]],"triangles":[[0,1,2],[1,3,2]],"hull":[]}"#),
    (MeshFormat::Csv, b"a,b,c\n0,1,2\n1,3,2\n"),
    (
        MeshFormat::Npy,
        b"\x93NUMPY\x01\x009\x00{'descr': '<u2', 'fortran_order': False, 'shape': (2, 3)}\x00\x00\x01\
          \x00\x02\x00\x01\x00\x03\x00\x02\x00",
    ),
];

/// Bytes that have a meaning in some format.
const SPICE: &[u8] = b"0123456789-+.eE,; \t\r\n\"#/[]{}:naif\xff\x00\x80";

/// Makes one to four random edits: replaces, inserts or removes a byte, or cuts off the end.
fn spoil(sample: &[u8], random: &mut SplitMix64) -> Vec<u8> {
    let mut bytes = sample.to_vec();
    for _ in 0..=random.below(4) {
        let place = random.below(bytes.len() as u64 + 1) as usize;
        let byte = SPICE[random.below(SPICE.len() as u64) as usize];
        match random.below(8) {
            0 => bytes.truncate(place),
            1 | 2 => bytes.insert(place, byte),
            3 if place < bytes.len() => drop(bytes.remove(place)),
            _ if place < bytes.len() => bytes[place] = byte,
            _ => bytes.push(byte),
        }
    }
    bytes
}

#[test]
fn spoilt_point_files_never_panic() {
    let mut random = SplitMix64::new(1);
    for (format, sample) in POINT_FILES {
        let right = format
            .read(Input::of_bytes(sample), &Selection::default())
            .unwrap_or_else(|failure| panic!("{format:?}: {failure}"));
        assert!(!right.is_empty());
        let mut refused = 0;
        for _ in 0..3000 {
            let bytes = spoil(sample, &mut random);
            match format.read(Input::of_bytes(&bytes), &Selection::default()) {
                Ok(table) => {
                    assert!(table.doubles().iter().flatten().all(|value| value.is_finite()));
                    assert!(table.len() <= bytes.len());
                }
                Err(failure) => {
                    refused += 1;
                    let sentence = failure.to_string();
                    assert!(!sentence.contains('\n') && sentence.len() < 400, "{sentence}");
                }
            }
        }
        assert!(refused > 100, "{format:?}: only {refused} were refused");
    }
}

#[test]
fn spoilt_mesh_files_never_panic() {
    let mut random = SplitMix64::new(2);
    for (format, sample) in MESH_FILES {
        let right = format.read(Input::of_bytes(sample)).unwrap_or_else(|failure| panic!("{format:?}: {failure}"));
        assert_eq!(right, [[0, 1, 2], [1, 3, 2]], "{format:?}");
        for _ in 0..3000 {
            if let Err(failure) = format.read(Input::of_bytes(&spoil(sample, &mut random))) {
                let sentence = failure.to_string();
                assert!(!sentence.contains('\n') && sentence.len() < 400, "{sentence}");
            }
        }
    }
}
