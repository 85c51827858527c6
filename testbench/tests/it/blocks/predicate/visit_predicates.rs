//! Runs `VisitPredicates` in Rust and in Verilog beside plain integer arithmetic: all three must agree in every clock.

use crate::rig::stepper::named_ports;
use crate::rig::visit_points::{
    all_flags, lifted_incircle, orientation, point, run_visits, visit, Point, EDGE_FLAGS, INCIRCLE_FLAGS, LARGEST,
    ORDER_FLAGS,
};
use incircle_hdl::predicate::VisitPredicates;
use incircle_testbench::gate::cell_count;
use incircle_testkit::SplitMix64;

named_ports!([] VisitPredicates, [corners, p], [signs], clock);

const CYCLES: usize = 10_000;

#[test]
fn visit_predicates_agree_with_the_lifted_determinant() {
    let outputs = [&EDGE_FLAGS[..], &INCIRCLE_FLAGS, &ORDER_FLAGS].concat();
    assert_eq!(VisitPredicates::LATENCY, 10);
    run_visits("visit_predicates", VisitPredicates::default(), &outputs, VisitPredicates::LATENCY, all_flags);
}

#[test]
fn dangerous_visits_are_among_the_random_ones() {
    let mut numbers = SplitMix64::new(11);
    let mut seen = [0; 4];
    for _ in 0..CYCLES {
        let r: Vec<Point> = visit(&mut numbers).into_iter().map(point).collect();
        let triangle = [r[0], r[1], r[2]];
        let proper = orientation(r[0], r[1], r[2]) != 0 && !triangle.contains(&r[3]);
        seen[0] += usize::from(orientation(r[0], r[1], r[2]) == 0);
        seen[1] += usize::from(triangle.contains(&r[3]));
        seen[2] += usize::from(proper && lifted_incircle(triangle, r[3]) == 0);
        seen[3] += usize::from(proper && lifted_incircle(triangle, r[3]) > 0);
    }
    assert!(
        seen.iter().all(|count| *count > CYCLES / 100),
        "collinear triangles, points on vertices, cocircular, inside: {seen:?}"
    );
}

#[test]
fn incircle_fits_its_width() {
    let corner = |code: u32| ((code & 1) as i64 * LARGEST, (code >> 1 & 1) as i64 * LARGEST);
    let mut largest = 0;
    for code in 0..256 {
        let points = [0, 2, 4, 6].map(|shift| corner(code >> shift));
        largest = largest.max(lifted_incircle([points[0], points[1], points[2]], points[3]).abs());
    }
    assert!(largest < 1 << (incircle_hdl::predicate::INCIRCLE_BITS - 1));
}

#[test]
fn visit_predicates_take_twenty_multipliers() {
    let blocks = incircle_blocks::blocks();
    let (name, verilog) = blocks.iter().find(|block| block.0 == "visit_predicates").expect("the block is exported");
    let cells = cell_count(verilog, name).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(cells.multipliers, VisitPredicates::MULTIPLIERS as u64);
    assert_eq!(cells.multipliers, 20);
    assert_eq!((cells.block_ram, cells.distributed_ram), (0, 0));
}
