//! Refused changes, changes that other triangulators have failed on, and doubles that are hostile to rounding.

use std::num::NonZeroUsize;
use std::ops::ControlFlow;

use incircle_testkit::SplitMix64;

use super::structure;
use crate::cpu;
use crate::cpu::hostile::KINDS;
use crate::living::{Error, Location, Triangulation};
use crate::plane_point::PlanePoint;

pub fn check<P: PlanePoint + PartialEq + core::fmt::Debug>(mesh: &Triangulation<P>) {
    structure::check(mesh);
    let points: Vec<P> = mesh.indices().into_iter().map(|index| mesh.point(index).expect("living")).collect();
    let expected = cpu::triangulate(points, NonZeroUsize::MIN, &mut |_| ControlFlow::Continue(()));
    assert_eq!(mesh.mesh(), expected.expect("finite points"));
}

#[test]
fn refused_changes_leave_the_mesh_as_it_was() {
    let mut mesh = Triangulation::from([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 0.0]]).expect("finite points");
    mesh.delete(0).expect("a living point");
    let before = mesh.mesh();
    for bad in [[f64::NAN, 0.0], [0.0, f64::INFINITY], [f64::NEG_INFINITY, f64::NAN]] {
        assert_eq!(mesh.insert(bad), Err(Error::NotFinite));
        assert_eq!(mesh.move_to(1, bad), Err(Error::NotFinite));
        assert_eq!(mesh.move_all(&[[0.0, 0.0], bad, [0.0, 1.0]]), Err(Error::NotFiniteAt { position: 1 }));
        assert_eq!(Triangulation::from([[0.0, 0.0], bad]).err(), Some(Error::NotFiniteAt { position: 1 }));
        assert_eq!((mesh.locate(bad), mesh.nearest(bad)), (Location::None, None));
        assert!(mesh.k_nearest(bad, 3).is_empty() && mesh.within_circle(bad, 9.0).is_empty());
        assert!(mesh.within_rectangle(bad, [0.0, 0.0]).is_empty() && mesh.segment([0.0, 0.0], bad).is_empty());
    }
    assert!(mesh.within_circle([0.0, 0.0], f64::NAN).is_empty() && mesh.within_circle([1.0, 0.0], -1.0).is_empty());
    assert_eq!(mesh.within_circle([0.0, 0.0], f64::INFINITY), [1, 2]);
    assert_eq!(mesh.move_all(&[]), Err(Error::WrongCount { given: 0, living: 3 }));
    assert_eq!(
        (mesh.delete(0), mesh.delete(4)),
        (Err(Error::Deleted { index: 0 }), Err(Error::Unknown { index: 4, next: 4 }))
    );
    assert_eq!(mesh.move_to(u32::MAX, [0.0, 0.0]), Err(Error::Unknown { index: u32::MAX, next: 4 }));
    assert_eq!(mesh.neighbors(0).err(), Some(Error::Deleted { index: 0 }));
    assert_eq!(mesh.star(9).err(), Some(Error::Unknown { index: 9, next: 4 }));
    assert_eq!((mesh.point(0), mesh.place_of(7), mesh.place_of(3)), (None, None, Some(1)));
    assert_eq!((mesh.mesh(), mesh.next_index()), (before, 4));
    check(&mesh);
}

#[test]
fn the_last_index_is_refused_and_new_indices_help() {
    let mut mesh = Triangulation::from([[1, 1], [2, 2], [1, 1]]).expect("finite points");
    mesh.next = u32::MAX;
    assert_eq!(mesh.insert([5, 5]), Err(Error::IndicesUsedUp));
    mesh.delete(1).expect("a living point");
    assert_eq!(mesh.renumber(), [0, 2]);
    assert_eq!(mesh.insert([5, 5]), Ok(2));
    assert_eq!((mesh.place_of(1), mesh.point(2)), (Some(0), Some([5, 5])));
    check(&mesh);
}

/// Report 8347 of CGAL/cgal on GitHub: an insertion fails after a removal has left points on one line.
#[test]
fn points_come_back_after_all_left_lie_on_one_line() {
    let line = [[0, 0], [1, 0], [2, 0], [3, 0]];
    for off in [[1, 5], [1, -5], [9, 1], [-9, -1]] {
        let mut mesh = Triangulation::from(line).expect("finite points");
        for again in [[2, 7], off, [0, -1]] {
            let apex = mesh.insert(off).expect("room");
            check(&mesh);
            mesh.delete(apex).expect("a living point");
            check(&mesh);
            let other = mesh.insert(again).expect("room");
            check(&mesh);
            mesh.delete(other).expect("a living point");
        }
        (0..4).for_each(|index| mesh.delete(index).expect("a living point"));
        assert_eq!((mesh.len(), mesh.locate([0, 0])), (0, Location::None));
        let index = mesh.insert([3, 3]).expect("room");
        assert_eq!(mesh.locate([3, 3]), Location::Vertex(index));
    }
}

/// Reports 70, 96 and 104 of JuliaGeometry/DelaunayTriangulation.jl on GitHub: a deletion fails where the neighbours
/// have an indentation, or on the hull. Every point of each set is deleted and comes back.
#[test]
fn vertices_with_indented_neighbours_and_on_the_hull_can_be_deleted() {
    let indented = [[0, 0], [10, 0], [10, 10], [0, 10], [5, 4], [5, 9], [4, 5], [6, 5], [5, 1]];
    let comb = [[0, 0], [2, 9], [4, 1], [6, 9], [8, 0], [4, 20], [4, -20], [1, 1], [7, 1]];
    for points in [indented, comb] {
        let mut mesh = Triangulation::from(points).expect("finite points");
        for (index, point) in (0u32..).zip(points) {
            mesh.delete(index).expect("a living point");
            check(&mesh);
            mesh.insert(point).expect("room");
            check(&mesh);
        }
    }
}

/// Report 62 of ianmackenzie/elm-geometry on GitHub: a point that was added twice and removed once is still there.
#[test]
fn a_point_that_came_twice_must_be_deleted_twice() {
    let mut mesh = Triangulation::from([[0, 0], [4, 0], [0, 4], [4, 0]]).expect("finite points");
    mesh.delete(1).expect("a living point");
    assert_eq!(mesh.locate([4, 0]), Location::Vertex(3));
    check(&mesh);
    mesh.move_to(2, [4, 0]).expect("a living point");
    assert_eq!((mesh.locate([4, 0]), mesh.place_of(3)), (Location::Vertex(2), Some(2)));
    check(&mesh);
    [2, 3].into_iter().for_each(|index| mesh.delete(index).expect("a living point"));
    assert_eq!(mesh.locate([4, 0]), Location::None);
    check(&mesh);
}

#[test]
fn hostile_doubles_come_move_and_go() {
    let mut random = SplitMix64::new(93);
    for make in KINDS {
        for _ in 0..12 {
            let mut mesh = Triangulation::new();
            let mut living = Vec::new();
            for _ in 0..40 {
                let point = make(&mut random);
                if living.len() < 4 || random.once_in(2) {
                    living.push(mesh.insert(point).expect("finite points"));
                } else {
                    let chosen = random.below(living.len() as u64) as usize;
                    if random.once_in(2) {
                        mesh.move_to(living[chosen], point).expect("a living point");
                    } else {
                        mesh.delete(living.swap_remove(chosen)).expect("a living point");
                    }
                }
                check(&mesh);
                check_nearest(&mesh, make(&mut random));
            }
        }
    }
}

/// No point is nearer than the nearest, in exact integers.
fn check_nearest(mesh: &Triangulation<[f64; 2]>, q: [f64; 2]) {
    let nearest = mesh.nearest(q).and_then(|index| mesh.point(index)).expect("a point");
    let is_nearer = |point: [f64; 2]| crate::double::nearer_of(q, point, nearest).is_lt();
    assert!(!mesh.indices().into_iter().filter_map(|index| mesh.point(index)).any(is_nearer), "{q:?}");
}
