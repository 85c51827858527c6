//! The measurement of one order of insertion on one set.

use std::time::Instant;

use incircle::order::deal;
use incircle::{Device, Error, Options, Point};
use incircle_protocol::{CORE_COORD_BITS, LARGE};
use incircle_testkit::Distribution;

use super::row::Row;
use crate::job;
use crate::order::Order;
use crate::prepare::prepare;

/// The number of runs, of which the fastest counts.
const RUNS: usize = 3;

/// Measures one order of insertion on one set.
///
/// # Errors
/// An error of the core's model, which a sound model never causes.
pub fn measure(set: Distribution, points: &[Point], order: Order, coord_bits: u32) -> Result<Row, Error> {
    let (_, order_ns) = fastest(points.len(), || order.order(points));
    let (job::Outcome { mesh, counts }, total_ns) = fastest(points.len(), || job::triangulate(points, order));
    let distinct = points.len() - mesh.duplicates.len();
    let cycles = cycles(points, order, coord_bits, distinct)?;
    let mean = |count: u32| f64::from(count) / distinct.max(1) as f64;
    Ok(Row {
        set,
        asked: points.len(),
        points: distinct,
        order,
        order_ns,
        total_ns,
        walk: mean(counts.walk_visits),
        tests: mean(counts.tests),
        cavity: mean(counts.cavity_triangles),
        cycles,
    })
}

/// Calls `work` three times; returns the result and the nanoseconds per point of the fastest call.
fn fastest<R>(points: usize, work: impl Fn() -> R) -> (R, f64) {
    let once = || {
        let since = Instant::now();
        let result = work();
        (result, since.elapsed().as_secs_f64() * 1e9 / points.max(1) as f64)
    };
    let mut best = once();
    for _ in 1..RUNS {
        let next = once();
        best = if next.1 < best.1 { next } else { best };
    }
    best
}

/// Cycles of an insertion on the largest core; `None` if the core does not hold the points. The points are ordered and
/// dealt to the contexts here, and the device takes them in that sequence.
fn cycles(points: &[Point], order: Order, coord_bits: u32, distinct: usize) -> Result<Option<f64>, Error> {
    if distinct > LARGE.points as usize || coord_bits > CORE_COORD_BITS {
        return Ok(None);
    }
    let prepared = prepare(points, order);
    let order = match order {
        Order::Input => prepared.rounds.order,
        _ => deal(prepared.rounds, LARGE.contexts),
    };
    let sent: Vec<Point> = order.into_iter().map(|index| points[index as usize]).collect();
    let mut device = Device::clock_model(LARGE)?;
    let options = Options::default().order(incircle::Order::Input).insert_chunk(sent.len());
    let solution = device.session()?.triangulate_with(&sent, &options)?;
    Ok(solution.report.cycles_per_insertion())
}
