//! Measures a whole job beside two well-known libraries, on one thread: uniform points of 16 bits, fresh ones for every
//! iteration. The counts are 16,384 and those at which the survey of Elshakhs et al. reports the speed of another core
//! in an FPGA; `testbench/cycles.md` cites the survey and has the cycles of our core for the same counts.
//!
//! `incircle/cpu` is the call `triangulate` of the library: it removes duplicates, orders the points, runs the
//! CPU triangulator and returns canonical triangles. `spade/bulk` builds a half-edge structure and `delaunator`
//! three arrays; both take doubles and decide ties in their own way. Criterion counts points, so `1e9 / thrpt` is
//! the number of nanoseconds per point.
//!
//! ```text
//! cargo bench -p incircle-testbench --bench triangulate
//! ```

use criterion::{criterion_group, criterion_main, BatchSize, Criterion, Throughput};
use incircle_testkit::SplitMix64;
use spade::Triangulation;

const POINTS: [usize; 5] = [477, 953, 1_906, 3_811, 16_384];

/// Uniform 16-bit points from one generator, so no two sets of a run are equal.
struct Uniform(SplitMix64);

impl Uniform {
    fn point(&mut self) -> [u16; 2] {
        let bits = self.0.next_u64();
        [bits as u16, (bits >> 16) as u16]
    }

    fn points<P>(&mut self, count: usize, make: impl Fn([u16; 2]) -> P) -> Vec<P> {
        (0..count).map(|_| make(self.point())).collect()
    }
}

fn triangulate(criterion: &mut Criterion) {
    for points in POINTS {
        beside_the_others(criterion, points);
    }
}

fn beside_the_others(criterion: &mut Criterion, count: usize) {
    let mut group = criterion.benchmark_group(format!("uniform-{count}"));
    group.throughput(Throughput::Elements(count as u64));
    group.bench_function("incircle/cpu", |bencher| {
        let mut source = Uniform(SplitMix64::new(1));
        bencher.iter_batched(
            || source.points(count, |[x, y]| incircle::Point::new(x.into(), y.into())),
            |points| incircle::triangulate(&points).expect("a mesh"),
            BatchSize::LargeInput,
        );
    });
    group.bench_function("spade/bulk", |bencher| {
        let mut source = Uniform(SplitMix64::new(1));
        bencher.iter_batched(
            || source.points(count, |[x, y]| spade::Point2::new(f64::from(x), f64::from(y))),
            |points| spade::DelaunayTriangulation::<spade::Point2<f64>>::bulk_load(points).expect("a mesh"),
            BatchSize::LargeInput,
        );
    });
    group.bench_function("delaunator", |bencher| {
        let mut source = Uniform(SplitMix64::new(1));
        bencher.iter_batched(
            || source.points(count, |[x, y]| delaunator::Point { x: x.into(), y: y.into() }),
            |points| delaunator::triangulate(&points),
            BatchSize::LargeInput,
        );
    });
    group.finish();
}

criterion_group!(benches, triangulate);
criterion_main!(benches);
