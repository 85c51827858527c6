//! Larger runs of a triangulation that lives, with the constants of the library: its unit tests have others, so that
//! small sets have many levels.
//!
//! The regular churn has 100,000 commands. This command runs as many as the variable says:
//!
//! ```text
//! INCIRCLE_CHURN=10000000 cargo test --release -p incircle-geometry --test living -- --nocapture
//! ```

use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::time::Instant;

use incircle_geometry::{cpu, Mesh, PlanePoint, Point, Triangulation};
use incircle_testkit::SplitMix64;

fn anew<P: PlanePoint>(points: Vec<P>) -> Mesh<P> {
    cpu::triangulate(points, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(())).expect("finite points")
}

/// Panics if the mesh is not the one of the living points.
fn check<P: PlanePoint + PartialEq>(mesh: &Triangulation<P>) {
    let points = mesh.indices().into_iter().map(|index| mesh.point(index).expect("a living point")).collect();
    assert!(mesh.mesh() == anew(points));
}

/// Points of a kind: uniform on a wide and on a narrow grid, on a circle, on a few lines, in crowds.
fn point(kind: usize, random: &mut SplitMix64) -> [f64; 2] {
    match kind {
        0 => [random.unit(), random.unit()],
        1 => [random.below(60) as f64, random.below(60) as f64],
        2 => {
            let angle = std::f64::consts::TAU * random.unit();
            [libm::cos(angle), libm::sin(angle)]
        }
        3 => [random.unit(), random.below(3) as f64],
        _ => random.normal_pair().map(|value| value * value * value),
    }
}

#[test]
fn sets_of_all_kinds_grow_and_shrink_to_nothing() {
    for kind in 0..5 {
        let mut random = SplitMix64::new(kind as u64);
        let mut mesh = Triangulation::new();
        let mut living: Vec<u32> = (0..3000).map(|_| mesh.insert(point(kind, &mut random)).expect("room")).collect();
        check(&mesh);
        for round in 0..6 {
            for _ in 0..500 {
                let place = random.below(living.len() as u64) as usize;
                mesh.delete(living.swap_remove(place)).expect("a living point");
            }
            for _ in 0..300 * usize::from(round < 5) {
                let index = random.pick(&living);
                mesh.move_to(index, point(kind, &mut random)).expect("a living point");
            }
            check(&mesh);
        }
        assert!(mesh.is_empty() && mesh.vertices().next().is_none());
        mesh.insert([0.5, 0.5]).expect("room");
        assert_eq!((mesh.next_index(), mesh.nearest([7.0, 7.0])), (3001, Some(3000)));
    }
}

#[test]
fn frames_of_all_steps_give_the_mesh_of_their_places() {
    for kind in 0..5 {
        let mut random = SplitMix64::new(40 + kind as u64);
        let mut places: Vec<[f64; 2]> = (0..4000).map(|_| point(kind, &mut random)).collect();
        let mut mesh = Triangulation::from(places.iter().copied()).expect("finite points");
        for frame in 0..24 {
            let step = 0.1 / f64::from(1 << frame);
            places.iter_mut().flatten().for_each(|value| *value += step * (random.unit() - 0.5));
            mesh.move_all(&places).expect("finite points");
            check(&mesh);
        }
    }
}

#[test]
fn a_wheel_gets_and_loses_its_hub() {
    let mut random = SplitMix64::new(50);
    let rim: Vec<[f64; 2]> = (0..5000).map(|_| point(2, &mut random)).collect();
    let mut mesh = Triangulation::from(rim).expect("room");
    for _ in 0..3 {
        let hub = mesh.insert([0.0, 0.0]).expect("room");
        check(&mesh);
        assert!(mesh.neighbors(hub).expect("a living point").count() > 4900);
        mesh.delete(hub).expect("a living point");
        check(&mesh);
    }
    // A hull vertex with all others around it, which then lie on one line.
    let mut fan = Triangulation::from((0..1000).map(|k| [k, 0])).expect("room");
    let apexes = [[500, 9], [500, -9]].map(|apex| fan.insert(apex).expect("room"));
    check(&fan);
    for apex in apexes {
        fan.delete(apex).expect("a living point");
        check(&fan);
    }
}

#[test]
fn churn_takes_no_more_memory_or_time() {
    const POINTS: u32 = 1000;
    let commands: usize = std::env::var("INCIRCLE_CHURN").ok().and_then(|text| text.parse().ok()).unwrap_or(100_000);
    let mut random = SplitMix64::new(77);
    let mut mesh = Triangulation::new();
    let place = |random: &mut SplitMix64| Point::new(random.below_u32(1 << 16), random.below_u32(1 << 16));
    let mut living: Vec<u32> = (0..POINTS).map(|_| mesh.insert(place(&mut random)).expect("room")).collect();
    let (mut bytes, mut times) = (Vec::new(), Vec::new());
    for _ in 0..10 {
        let start = Instant::now();
        for _ in 0..commands / 20 {
            let chosen = random.below(POINTS.into()) as usize;
            mesh.delete(living[chosen]).expect("a living point");
            living[chosen] = mesh.insert(place(&mut random)).expect("room");
        }
        check(&mesh);
        bytes.push(mesh.bytes());
        times.push(start.elapsed().as_secs_f64());
    }
    println!("bytes {bytes:?}, seconds {times:.3?}");
    assert!(bytes[9] <= bytes[0] + bytes[0] / 8, "{bytes:?}");
    // Short runs say nothing about time, and other work on the machine disturbs them.
    if commands >= 1_000_000 {
        let quickest = |times: &[f64]| times.iter().copied().fold(f64::INFINITY, f64::min);
        assert!(quickest(&times[5..]) < 2.0 * quickest(&times[..5]), "{times:?}");
    }
}
