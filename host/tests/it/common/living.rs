//! Meshes that live on a device, compared with those on the processor.

use incircle::{Device, LivingMesh, Point, Triangulation};
use incircle_testkit::SplitMix64;

/// Makes random changes of up to 500 points and asks questions, and compares the device with the processor. Panics if
/// they differ.
pub fn random_changes_agree(mut device: Device, seed: u64) {
    let mut session = device.session().expect("a session");
    let mut mesh = session.living().expect("the device has enough runs");
    let mut host = Triangulation::<Point>::new();
    let mut random = SplitMix64::new(seed + 1000);
    let side = 2 + random.below_u32(40);
    let mut point = move || Point::new(random.below_u32(side), random.below_u32(side));
    let mut random = SplitMix64::new(seed + 2000);
    for step in 0..12 {
        let count = 1 + random.below(500) as usize;
        let points: Vec<Point> = (0..count).map(|_| point()).collect();
        let living = host.indices();
        let indices: Vec<u32> =
            (0..count.min(60)).filter(|_| living.len() > 90).map(|_| random.pick(&living)).collect();
        let moves: Vec<(u32, Point)> = indices.into_iter().zip(points.iter().copied()).collect();
        let mut gone: Vec<u32> = moves.iter().map(|&(index, _)| index).collect();
        gone.sort_unstable();
        gone.dedup();
        let kind = random.below(4);
        let both: [&mut dyn LivingMesh<Point>; 2] = [&mut mesh, &mut host];
        for mesh in both {
            let made = match kind {
                0 => mesh.delete_all(&gone),
                1 => mesh.move_all(&moves),
                _ => mesh.insert_all(&points),
            };
            made.unwrap_or_else(|error| panic!("seed {seed}, step {step}: {error}"));
        }
        let places: Vec<Point> = (0..100).map(|_| point()).collect();
        let nearest: Vec<Option<u32>> = places.iter().map(|&place| host.nearest(place)).collect();
        assert_eq!(mesh.nearest_all(&places).expect("answers"), nearest, "seed {seed}, step {step}");
        let located: Vec<_> = places.iter().map(|&place| host.locate(place)).collect();
        assert_eq!(mesh.locate_all(&places).expect("answers"), located, "seed {seed}, step {step}");
    }
    assert_eq!(mesh.mesh().expect("a mesh"), host.mesh(), "seed {seed}");
}

/// Makes a few changes of every kind, one by one, and compares the device with the processor. Panics with `what` if
/// they differ.
pub fn few_changes_agree(mut device: Device, what: &str) {
    let mut session = device.session().expect("a session");
    let mut mesh = session.living().expect("the device has all runs");
    let mut host = Triangulation::new();
    let square = [[0, 0], [90, 0], [90, 90], [0, 90], [41, 30], [20, 50]].map(Point::from);
    let both: [&mut dyn LivingMesh<Point>; 2] = [&mut mesh, &mut host];
    let meshes = both.map(|mesh| {
        mesh.insert_all(&square).expect("room");
        assert_eq!(mesh.nearest(Point::new(1, 1)).expect("an answer"), Some(0));
        mesh.insert(Point::new(33, 33)).expect("room");
        mesh.insert(Point::new(60, 31)).expect("room");
        mesh.delete(4).expect("a deletion");
        mesh.move_to(5, Point::new(61, 62)).expect("a move");
        mesh.insert(Point::new(41, 30)).expect("room");
        mesh.delete(6).expect("a deletion");
        mesh.mesh().expect("a mesh")
    });
    assert_eq!(meshes[0], meshes[1], "{what}");
}
