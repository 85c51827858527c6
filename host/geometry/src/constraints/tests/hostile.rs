//! Constraints in lists that are no mesh: an error or a wrong mesh, never a panic and never an endless loop.

use incircle_testkit::SplitMix64;

use super::canonical::mesh_of;
use crate::constraints::{constrain, Domain, Error, Mark, Plan};
use crate::mesh::Mesh;
use crate::point::{Duplicate, Point};

#[test]
fn no_list_of_triangles_makes_a_panic() {
    let mut random = SplitMix64::new(21);
    let mut errors = 0;
    for _ in 0..20_000 {
        let count = 1 + random.below(14) as usize;
        let points: Vec<Point> = random.points(count, 5);
        let mut mesh = mesh_of(&points);
        let any = |random: &mut SplitMix64| {
            let beyond = u64::from(random.once_in(50));
            random.below(count as u64 + beyond) as u32
        };
        for _ in 0..1 + random.below(4) {
            let triangle = random.below(mesh.triangles.len() as u64 + 1) as usize;
            match random.below(6) {
                0 => mesh.triangles.push([(); 3].map(|()| any(&mut random))),
                1 if triangle < mesh.triangles.len() => drop(mesh.triangles.swap_remove(triangle)),
                2 => mesh.hull.push(any(&mut random)),
                3 => drop(mesh.hull.pop()),
                4 => mesh.duplicates.push(Duplicate { index: any(&mut random), of: any(&mut random) }),
                _ => {
                    for corner in mesh.triangles.get_mut(triangle).into_iter().flatten() {
                        *corner = any(&mut random);
                    }
                }
            }
        }
        let constraints: Vec<[u32; 2]> = (0..random.below(6)).map(|_| [any(&mut random), any(&mut random)]).collect();
        let holes = random.below(3) as usize;
        let holes: Vec<Point> = random.points(holes, 5);
        let domain = Domain::ALL[random.below(4) as usize];
        let plan = Plan { domain, holes: &holes, regions: &holes, ..Plan::new(&constraints) };
        errors += usize::from(constrain(&mesh, &plan).is_err());
    }
    assert!(errors > 5000, "{errors}");
}

#[test]
fn numbers_beyond_the_points_are_refused() {
    let mesh = mesh_of(&[[0, 0], [4, 0], [0, 4]]);
    let made = constrain(&mesh, &Plan::new(&[[0, 1], [1, 3]]));
    assert_eq!(made, Err(Error::OutOfRange { constraint: 1, index: 3, points: 3 }));
    let bad = Mesh::new(vec![[0.0, 0.0], [f64::NAN, 0.0]], Vec::new(), Vec::new(), Vec::new());
    assert_eq!(constrain(&bad, &Plan::new(&[])), Err(Error::NotFinite { index: 1 }));
    let mesh = mesh_of(&[[0.0, 0.0], [4.0, 0.0], [0.0, 4.0]]);
    let places = [[1.0, 1.0], [f64::INFINITY, 0.0]];
    let marks = |holes, regions| constrain(&mesh, &Plan { domain: Domain::Holes, holes, regions, ..Plan::new(&[]) });
    let error = |kind| Err(Error::MarkNotFinite { kind, number: 1 });
    assert_eq!(marks(&places[..1], &places), error(Mark::Region));
    assert_eq!(marks(&places, &[]), error(Mark::Hole));
    assert_eq!(
        marks(&places, &[]).map_err(|error| error.to_string()).unwrap_err(),
        "hole 1, counted from 0, has a coordinate that is infinite or not a number"
    );
}
