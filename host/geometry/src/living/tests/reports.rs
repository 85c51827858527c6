//! What users of other libraries have reported about deletions and questions, as tests.

use super::changes::check;
use crate::living::{Location, Triangulation};

/// Report 8347 of CGAL/cgal on GitHub, with its points: two points come, one goes, and another comes.
#[test]
fn one_of_two_points_goes_and_another_comes() {
    for gone in [0, 1] {
        let mut mesh = Triangulation::from([[2.0, 3.0], [6.0, 3.0]]).expect("finite points");
        mesh.delete(gone).expect("a living point");
        check(&mesh);
        let third = mesh.insert([0.0, 4.0]).expect("room");
        check(&mesh);
        assert_eq!(mesh.neighbors(third).expect("a living point").collect::<Vec<_>>(), [1 - gone]);
    }
}

/// Report 448 of acgetchell/delaunay on GitHub: a deletion from a strip of three rows of five points is rolled back.
/// All points go, in several orders, and every mesh on the way is checked.
#[test]
fn strips_of_three_rows_lose_their_points_in_any_order() {
    for skew in [0, 1, 7] {
        let points: Vec<[i32; 2]> =
            (0..15).map(|k| [10 * (k % 5) + skew * (k / 5) + k * k % 3, 10 * (k / 5)]).collect();
        for step in [1, 2, 4, 7, 8, 11] {
            let mut mesh = Triangulation::from(points.iter().copied()).expect("finite points");
            for k in 0..15 {
                mesh.delete(step * k % 15).expect("a living point");
                check(&mesh);
            }
            assert!(mesh.is_empty());
        }
    }
}

/// Reports 64 and 77 of d3/d3-delaunay on GitHub: on a line each point has the points beside it as its neighbours.
#[test]
fn points_on_a_line_have_neighbours_through_all_changes() {
    let mut mesh = Triangulation::from([[0, 0], [2, 4], [1, 2]]).expect("finite points");
    let sorted = |mesh: &Triangulation<[i32; 2]>, index| {
        let mut around: Vec<u32> = mesh.neighbors(index).expect("a living point").collect();
        around.sort_unstable();
        around
    };
    assert_eq!((sorted(&mesh, 0), sorted(&mesh, 1), sorted(&mesh, 2)), (vec![2], vec![2], vec![0, 1]));
    mesh.delete(2).expect("a living point");
    assert_eq!((sorted(&mesh, 0), sorted(&mesh, 1)), (vec![1], vec![0]));
    let off = mesh.insert([5, 0]).expect("room");
    mesh.delete(off).expect("a living point");
    let between = mesh.insert([1, 2]).expect("room");
    assert_eq!((sorted(&mesh, 0), sorted(&mesh, between)), (vec![between], vec![0, 1]));
}

/// Report 1861 of llnl/axom on GitHub: places on the edges of a regular grid, or a rounding away from them, are not
/// found. A place is in an edge only if it lies there exactly.
#[test]
fn places_beside_the_edges_of_a_regular_grid_are_found() {
    let mesh = Triangulation::from((0..36).map(|k| [f64::from(k % 6) * 0.1, f64::from(k / 6) * 0.1])).expect("finite");
    for k in 0..5 {
        let edge = [k, k + 1].map(|column| 6 * 2 + column);
        let [a, b] = edge.map(|index| mesh.point(index).expect("a living point"));
        let middle = 0.5 * (a[0] + b[0]);
        assert_eq!(mesh.locate([middle, a[1]]), Location::Edge(edge));
        for beside in [a[1].next_up(), a[1].next_down()] {
            let Location::Triangle(found) = mesh.locate([middle, beside]) else { panic!("{middle} {beside}") };
            assert!(edge.iter().all(|end| found.contains(end)), "{found:?} {edge:?}");
        }
    }
}

/// Report 23328 of scipy/scipy on GitHub: places are found wrongly after triangles have been taken out. Here points are
/// taken out, and every place of a fine grid lies where the mesh that is left says.
#[test]
fn places_are_found_after_half_of_the_points_are_gone() {
    let mut mesh = Triangulation::from((0..64).map(|k| [9 * (k % 8) + k % 3, 9 * (k / 8) + k % 5])).expect("finite");
    (0..64).filter(|k| k % 3 != 1).for_each(|index| mesh.delete(index).expect("a living point"));
    check(&mesh);
    let turn = |[a, b, c]: [[i64; 2]; 3]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let wide = |[x, y]: [i32; 2]| [i64::from(x), i64::from(y)];
    let triangles: Vec<[u32; 3]> = mesh.triangles().collect();
    for place in (0..80 * 80).map(|cell| [cell % 80 - 4, cell / 80 - 4]) {
        let holds = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|index| wide(mesh.point(index).expect("a living point")));
            [[a, b], [b, c], [c, a]].iter().all(|&[from, to]| turn([from, to, wide(place)]) > 0)
        };
        let found = match mesh.locate(place) {
            Location::Triangle(triangle) => Some(triangle),
            _ => None,
        };
        assert_eq!(found, triangles.iter().copied().find(holds), "{place:?}");
    }
}
