//! Points and constraints as one job give, byte for byte, what a mesh and then its constraints give.

use std::cell::RefCell;
use std::ops::ControlFlow;
use std::time::Duration;

use incircle::constraints::{constrain, Domain, Plan, Triangulated};
use incircle::{ConstrainedError, Device, Error, ErrorKind, Options, PlanePoint, Point, Report, Stage};

use crate::common::Random;

const DOMAINS: [Domain; 4] = [Domain::All, Domain::Holes, Domain::EvenOdd, Domain::NonZero];

type Found = Result<(Triangulated, Report), ConstrainedError>;

/// What the two calls give, one after the other.
fn in_two_steps<P: PlanePoint>(points: &[P], plan: &Plan<'_, P>) -> Found {
    let solution = Device::cpu(None).session()?.triangulate(points)?;
    let made = constrain(&solution.mesh, plan)?;
    let mut found = Triangulated::default();
    (found.made, found.hull, found.duplicates) = (made, solution.mesh.hull, solution.mesh.duplicates);
    Ok((found, solution.report))
}

fn by<P: PlanePoint>(address: &str, points: &[P], plan: &Plan<'_, P>) -> Found {
    Device::open(address)?.session()?.triangulate_constrained(points, plan, &Options::default())
}

/// The report without times.
fn counts(mut report: Report) -> Report {
    report.stages.iter_mut().for_each(|stage| stage.1 = Duration::ZERO);
    report
}

/// Compares both ways; whether there is a mesh.
fn compare<P: PlanePoint>(points: &[P], plan: &Plan<'_, P>) -> bool {
    let about = (plan.constraints, plan.domain);
    match (by("cpu", points, plan), in_two_steps(points, plan)) {
        (Ok((one, report)), Ok((other, reference))) => {
            assert_eq!(one, other, "{about:?}");
            assert_eq!(counts(report), counts(reference), "{about:?}");
            true
        }
        (Err(one), Err(other)) => {
            assert_eq!(one.to_string(), other.to_string(), "{about:?}");
            false
        }
        (one, other) => panic!("{about:?}: {:?}, but in two steps {:?}", one.err(), other.err()),
    }
}

/// Compares both ways for random plans on points of one kind; the number of plans with a mesh and of those without.
fn compare_random<P: PlanePoint>(seed: u64, place: impl Fn([u32; 2]) -> P) -> [usize; 2] {
    let (mut random, mut counts) = (Random(seed), [0; 2]);
    for round in 0..400 {
        let count = random.below(20) as usize;
        let side = 2 + random.below(8);
        let mut places = |count: usize| {
            let place = |_| place([random.below(side), random.below(side)]);
            (0..count).map(place).collect::<Vec<P>>()
        };
        let (points, holes, regions) = (places(count), places(round % 3), places(round % 2));
        // Now and then a constraint names a point that does not exist.
        let mut end = || random.below(count as u32 + u32::from(round % 16 == 0));
        let mut constraints: Vec<[u32; 2]> = (0..if count == 0 { 0 } else { 4 }).map(|_| [end(), end()]).collect();
        if count > 2 && round % 4 != 0 {
            // A ring bounds a domain.
            let [a, b, c] = [end(), end(), end()];
            constraints = vec![[a, b], [b, c], [c, a], [end(), end()]];
        }
        for domain in DOMAINS {
            let lines = usize::from(!constraints.is_empty());
            let (none, holes) = (&[][..], if domain == Domain::Holes { &holes[..] } else { &[] });
            for regions in [none, &regions[..]] {
                let plan = Plan { domain, lines, holes, regions, ..Plan::new(&constraints) };
                counts[usize::from(!compare(&points, &plan))] += 1;
            }
        }
    }
    counts
}

#[test]
fn one_job_is_both_steps_in_all_kinds_of_numbers() {
    let wide = 1i64 << 40;
    let all = [
        compare_random(1, |[x, y]| Point::new(x, y)),
        compare_random(2, |[x, y]| [x as i32 - 3, 3 - y as i32]),
        compare_random(3, |[x, y]| [i64::from(x) * wide + i64::from(y % 2), i64::from(y) - 3]),
        compare_random(4, |[x, y]| [f64::from(x) * 0.1, f64::from(y) * 1e-9]),
        compare_random(5, |[x, y]| [x as f32 * 0.5, y as f32]),
    ];
    for [meshes, errors] in all {
        assert!(meshes > 500 && errors > 500, "{all:?}");
    }
}

#[test]
fn other_devices_give_the_same_mesh_and_the_same_errors() {
    let mut random = Random(6);
    for _ in 0..40 {
        let points = random.points(30, 20);
        let constraints: Vec<[u32; 2]> = (0..3).map(|_| [random.below(30), random.below(30)]).collect();
        let plan = Plan::new(&constraints);
        let made = |address| by(address, &points, &plan).map(|(found, _)| found).map_err(|error| error.to_string());
        assert_eq!(made("model"), made("cpu"));
        assert_eq!(made("cpu?threads=1"), made("cpu"));
    }
}

#[test]
fn progress_cancelling_and_the_deadline_are_those_of_a_job() {
    let points = Random(7).points(5000, 1 << 16);
    let plan = Plan::new(&[[0, 1]]);
    let mut device = Device::cpu(None);
    let mut session = device.session().expect("a session");
    let heard = RefCell::new(Vec::new());
    let listen = |progress: incircle::Progress| {
        heard.borrow_mut().push((progress.stage, progress.total));
        ControlFlow::Continue(())
    };
    let mut lists = Vec::new();
    session.triangulate_constrained(&points, &plan, &Options::default().progress(&listen)).expect("a mesh");
    lists.push(heard.take());
    session.triangulate_with(&points, &Options::default().progress(&listen)).expect("a mesh");
    lists.push(heard.take());
    lists.iter_mut().for_each(Vec::dedup);
    assert_eq!(lists[0], lists[1]);
    for stage in [Stage::Order, Stage::Insert, Stage::Assemble] {
        let stop = |progress: incircle::Progress| {
            if progress.stage == stage {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        };
        let options = Options::default().progress(&stop);
        let error = session.triangulate_constrained(&points, &plan, &options).expect_err("cancelled");
        let ConstrainedError::Job(error) = error else { panic!("{error}") };
        let plain = session.triangulate_with(&points, &options).expect_err("cancelled");
        assert_eq!((error.kind(), error.to_string()), (ErrorKind::Cancelled, plain.to_string()));
    }
    let options = Options::default().timeout(Duration::from_nanos(1));
    let error = session.triangulate_constrained(&points, &plan, &options).expect_err("too late");
    assert!(matches!(error, ConstrainedError::Job(Error::Timeout { .. })), "{error}");
    assert!(session.triangulate_constrained(&points, &plan, &Options::default()).is_ok());
}

#[test]
fn a_wrong_plan_is_told_after_one_run_of_the_stages() {
    let points = Random(8).points(5000, 1 << 16);
    let mut device = Device::cpu(None);
    let mut session = device.session().expect("a session");
    let heard = RefCell::new(Vec::new());
    let listen = |progress: incircle::Progress| {
        heard.borrow_mut().push(progress.stage);
        ControlFlow::Continue(())
    };
    // Chords between random points surely cross, and a boundary of one edge is not closed.
    let chords: Vec<[u32; 2]> = (0..50).map(|k| [k, 4999 - k]).collect();
    let open = Plan { domain: Domain::EvenOdd, ..Plan::new(&chords[..1]) };
    for plan in [Plan::new(&chords), open] {
        let found = session.triangulate_constrained(&points, &plan, &Options::default().progress(&listen));
        assert!(matches!(found, Err(ConstrainedError::Plan(_))));
        let mut stages = heard.take();
        stages.dedup();
        assert_eq!(stages, [Stage::Order, Stage::Insert, Stage::Assemble]);
    }
}

#[test]
fn the_listener_can_end_a_job_while_constraints_are_forced() {
    let points = Random(9).points(5000, 1 << 16);
    // A fan has no crossings, and many pieces.
    let fan: Vec<[u32; 2]> = (1..5000).map(|k| [0, k]).collect();
    let mut device = Device::cpu(None);
    let mut session = device.session().expect("a session");
    let heard = RefCell::new(0);
    let third = |progress: incircle::Progress| {
        *heard.borrow_mut() += u32::from(progress.stage == Stage::Assemble);
        match *heard.borrow() < 3 {
            true => ControlFlow::Continue(()),
            false => ControlFlow::Break(()),
        }
    };
    let options = Options::default().progress(&third);
    let error = session.triangulate_constrained(&points, &Plan::new(&fan), &options).expect_err("cancelled");
    assert!(matches!(error, ConstrainedError::Job(Error::Cancelled { stage: "assemble", .. })), "{error}");
    assert_eq!(*heard.borrow(), 3);
}

#[test]
fn points_are_refused_before_constraints() {
    let (nan, plan) = ([[0.0, 0.0], [f64::NAN, 1.0]], Plan::new(&[[0, 7]]));
    assert!(!compare(&nan, &plan));
    let mut device = Device::cpu(None);
    let mut session = device.session().expect("a session");
    let error = session.triangulate_constrained(&nan, &plan, &Options::default()).expect_err("no number");
    assert!(matches!(error, ConstrainedError::Job(Error::NotFinite { index: 1, .. })), "{error}");
    let options = Options::default().contexts(9999);
    let error = session.triangulate_constrained(&[[0.0, 0.0]], &plan, &options).expect_err("no such threads");
    assert!(matches!(error, ConstrainedError::Job(Error::Contexts { .. })), "{error}");
}
