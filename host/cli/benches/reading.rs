//! Benchmarks of reading points: bytes a second of each format, on one thread, from memory.
//!
//! `cargo bench -p incircle-cli --bench reading` prints the figures.

use std::fmt::Write;

use criterion::{criterion_group, criterion_main, Criterion, Throughput};
use incircle_cli::formats::{csv, wkt, xyz};
use incircle_cli::generate::SplitMix64;
use incircle_cli::{Failure, PointTable};

/// Points of a file.
const POINTS: usize = 1_000_000;

type Read = fn(&[u8]) -> Result<PointTable, Failure>;

/// A file whose rows are made from two random numbers of 24 bits.
fn file(row: impl Fn(&mut String, u64, u64)) -> String {
    let mut random = SplitMix64::new(1);
    let mut text = String::new();
    for _ in 0..POINTS {
        row(&mut text, random.below(1 << 24), random.below(1 << 24));
    }
    text
}

fn reading(criterion: &mut Criterion) {
    let files: [(&str, Read, String); 6] = [
        ("csv, whole numbers of 24 bits", csv::read_points, file(|text, x, y| drop(writeln!(text, "{x},{y}")))),
        (
            "csv, six digits behind the point",
            csv::read_points,
            file(|text, x, y| drop(writeln!(text, "-{}.{x:06},{}.{y:06}", x % 180, y % 90))),
        ),
        (
            "csv, doubles of 17 digits",
            csv::read_points,
            file(|text, x, y| drop(writeln!(text, "{},{}", x as f64 / 3.0, y as f64 / 7.0))),
        ),
        (
            "csv, a quoted name in each row",
            csv::read_points,
            file(|text, x, y| drop(writeln!(text, "{x},{y},\"a, b\""))),
        ),
        ("xyz, whole numbers of 24 bits", xyz::read_points, file(|text, x, y| drop(writeln!(text, "{x} {y} 7")))),
        ("wkt, whole numbers of 24 bits", wkt::read_points, file(|text, x, y| drop(writeln!(text, "POINT ({x} {y})")))),
    ];
    let mut group = criterion.benchmark_group("reading");
    group.sample_size(10);
    for (name, read, text) in &files {
        group.throughput(Throughput::Bytes(text.len() as u64));
        group.bench_function(*name, |bencher| bencher.iter(|| read(text.as_bytes())));
    }
    group.finish();
}

criterion_group!(benches, reading);
criterion_main!(benches);
