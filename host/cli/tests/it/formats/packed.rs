//! Tests of files that are packed by gzip or zstd, and of inputs that are larger than the memory.

use std::io::{Read, Write};
use std::process::Stdio;

use flate2::read::MultiGzDecoder;
use flate2::write::GzEncoder;

use crate::common::{Run, Scratch};

const POINTS: &[u8] = b"0,0\n4,0\n0,4\n4,5\n";
const ELE: &str = "2 3 0\n0 0 1 2\n1 1 3 2\n";

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut packer = GzEncoder::new(Vec::new(), Default::default());
    packer.write_all(bytes).expect("memory takes all bytes");
    packer.finish().expect("memory takes all bytes")
}

fn zstd(bytes: &[u8]) -> Vec<u8> {
    zstd::encode_all(bytes, 0).expect("memory takes all bytes")
}

#[test]
fn packed_points_are_read_by_their_extension() {
    let scratch = Scratch::new();
    let (head, tail) = POINTS.split_at(7);
    // Packed parts that were joined are read as one file.
    scratch.write("joined.csv.gz", [gzip(head), gzip(tail)].concat());
    scratch.write("joined.csv.zst", [zstd(head), zstd(tail)].concat());
    scratch.write("upper.CSV.GZ", gzip(POINTS));
    for name in ["joined.csv.gz", "joined.csv.zst", "upper.CSV.GZ"] {
        scratch.run(&format!("triangulate {name} -o m.ele")).ok();
        assert_eq!(scratch.read("m.ele"), ELE, "{name}");
    }
    // The format that the user names is that of the unpacked bytes.
    scratch.write("points.gz", gzip(POINTS));
    scratch.run("triangulate points.gz --from csv -o m.ele").ok();
    scratch.run("triangulate points.gz -o n.ele").fails(2, &["points.gz", "--from"]);
}

#[test]
fn packed_meshes_are_written_and_read_back() {
    let scratch = Scratch::new();
    scratch.write("p.csv", POINTS);
    for name in ["m.ele.gz", "m.ele.zst"] {
        scratch.run(&format!("triangulate p.csv -o {name}")).ok();
        scratch.run(&format!("verify p.csv {name}")).ok();
    }
    let mut unpacked = String::new();
    let gzip = std::fs::read(scratch.path("m.ele.gz")).expect("the file was written");
    MultiGzDecoder::new(&gzip[..]).read_to_string(&mut unpacked).expect("a gzip file");
    assert_eq!(unpacked, ELE);
    let zstd = std::fs::read(scratch.path("m.ele.zst")).expect("the file was written");
    assert_eq!(zstd::decode_all(&zstd[..]).expect("a zstd file"), ELE.as_bytes());
    scratch.run("generate uniform -n 20 -o q.csv.gz").ok();
    scratch.run("generate uniform -n 20 -o q.csv").ok();
    scratch.run("triangulate q.csv.gz -o q.ele").ok();
    scratch.run("verify q.csv q.ele").ok();
}

#[test]
fn damaged_packed_files_are_refused() {
    let scratch = Scratch::new();
    let cut = |bytes: Vec<u8>| bytes[..bytes.len() - 5].to_vec();
    let spoilt = |mut bytes: Vec<u8>| {
        let last = bytes.len() - 6;
        bytes[last] ^= 0xff;
        bytes
    };
    let files = [
        ("cut.csv.gz", cut(gzip(POINTS))),
        ("spoilt.csv.gz", spoilt(gzip(POINTS))),
        ("plain.csv.gz", POINTS.to_vec()),
        ("cut.csv.zst", cut(zstd(POINTS))),
        ("plain.csv.zst", POINTS.to_vec()),
        ("empty.csv.gz", Vec::new()),
    ];
    for (name, bytes) in files {
        scratch.write(name, bytes);
        let run = scratch.run(&format!("triangulate {name} --from csv -o m.ele"));
        run.fails(3, &[name, if name.starts_with("empty") { "" } else { "damaged or cut off" }]);
        scratch.write("empty.csv", "x,y\n");
        scratch.run(&format!("verify empty.csv {name} --format ele")).fails(3, &[name, "cannot be read"]);
    }
}

#[test]
fn a_folder_is_no_file() {
    let scratch = Scratch::new();
    std::fs::create_dir(scratch.path("d.csv")).expect("a folder");
    scratch.run("triangulate d.csv -o m.ele").fails(3, &["d.csv", "cannot be read"]);
    let mut command = scratch.command(["triangulate", "-", "-o", "m.ele"]);
    let run = Run::of(command.stdin(Stdio::null()).output().expect("the command starts"));
    run.fails(3, &["standard input", "the file is empty"]);
}
