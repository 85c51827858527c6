//! Benchmarks the reading of points from memory, on one thread. The figures are bytes a second for each format.
//!
//! `cargo bench -p incircle-cli --bench reading` prints the figures.

use criterion::{criterion_group, criterion_main, Criterion, Throughput};
use incircle_cli::formats::{csv, wkt, xyz};
use incircle_cli::generate::SplitMix64;
use incircle_cli::{Failure, Memory, PointTable};

/// The number of points in a file.
const POINTS: usize = 1_000_000;

type Read = fn(&[u8], Memory) -> Result<PointTable, Failure>;

/// A file whose rows are made from two random numbers of 24 bits.
fn file(row: impl Fn(u64, u64) -> String) -> String {
    let mut random = SplitMix64::new(1);
    let mut text = String::new();
    for _ in 0..POINTS {
        text.push_str(&row(random.below(1 << 24), random.below(1 << 24)));
    }
    text
}

fn reading(criterion: &mut Criterion) {
    let files: [(&str, Read, String); 6] = [
        ("csv, whole numbers of 24 bits", csv::read_points, file(|x, y| format!("{x},{y}\n"))),
        (
            "csv, six digits behind the point",
            csv::read_points,
            file(|x, y| format!("-{}.{x:06},{}.{y:06}\n", x % 180, y % 90)),
        ),
        (
            "csv, doubles of 17 digits",
            csv::read_points,
            file(|x, y| format!("{},{}\n", x as f64 / 3.0, y as f64 / 7.0)),
        ),
        ("csv, a quoted name in each row", csv::read_points, file(|x, y| format!("{x},{y},\"a, b\"\n"))),
        ("xyz, whole numbers of 24 bits", xyz::read_points, file(|x, y| format!("{x} {y} 7\n"))),
        ("wkt, whole numbers of 24 bits", wkt::read_points, file(|x, y| format!("POINT ({x} {y})\n"))),
    ];
    let mut group = criterion.benchmark_group("reading");
    group.sample_size(10);
    for (name, read, text) in &files {
        group.throughput(Throughput::Bytes(text.len() as u64));
        group.bench_function(*name, |bencher| bencher.iter(|| read(text.as_bytes(), Memory::ENDLESS)));
    }
    group.finish();
}

criterion_group!(benches, reading);
criterion_main!(benches);
