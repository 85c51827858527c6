//! Sets and constraints that have an answer although they look like mistakes.

use super::canonical::mesh_of;
use crate::constraints::{constrain, Domain, Error, Plan};

#[test]
fn overlapping_constraints_share_their_pieces() {
    let points = [[0, 0], [2, 0], [4, 0], [6, 0], [3, 5], [3, -5], [2, 0]];
    let constraints = [[0, 3], [2, 1], [3, 0], [6, 6], [6, 4], [1, 6]];
    let made = constrain(&mesh_of(&points), &Plan::new(&constraints)).expect("no crossing");
    let pieces: Vec<([u32; 2], &[u32])> = made.pieces.iter().collect();
    assert_eq!(pieces, [([0, 1], &[0, 2][..]), ([1, 2], &[0, 1, 2]), ([1, 4], &[4]), ([2, 3], &[0, 2])]);
    assert_eq!(made.pieces.of_edge([2, 1]), [0, 1, 2]);
    assert!(made.pieces.of_edge([0, 4]).is_empty() && made.pieces.constraints(4).is_empty());
}

#[test]
fn points_of_one_line_have_pieces_and_no_triangle() {
    let points = [[4, 4], [0, 0], [2, 2], [2, 2], [6, 6]];
    let mesh = mesh_of(&points);
    let made = constrain(&mesh, &Plan::new(&[[0, 1], [3, 4]])).expect("no crossing");
    let pieces: Vec<([u32; 2], &[u32])> = made.pieces.iter().collect();
    assert_eq!(pieces, [([0, 2], &[0, 1][..]), ([0, 4], &[1]), ([1, 2], &[0])]);
    assert!(made.triangles.is_empty());
    let holes = Plan { domain: Domain::Holes, ..Plan::new(&[[0, 1]]) };
    assert_eq!(constrain(&mesh, &holes), Err(Error::Empty { triangles: 0 }));
    assert!(constrain(&mesh_of::<[i32; 2]>(&[]), &Plan::new(&[])).expect("nothing").triangles.is_empty());
}

#[test]
fn edges_hang_into_the_triangles_that_a_constraint_crosses() {
    // Needles point from both sides at a long constraint, which passes between their tips.
    let mut points = vec![[0, 0], [400, 0]];
    for k in 1..40 {
        points.extend([[10 * k, 1], [10 * k + 3, -1], [10 * k + 1, 500 + k], [10 * k + 2, -500 - k]]);
    }
    let made = constrain(&mesh_of(&points), &Plan::new(&[[0, 1], [2, 154], [3, 155]])).expect("no crossing");
    assert_eq!(made.pieces.len(), 1 + 38 + 38);
    let all: i128 = made.twice_area.expect("a lattice");
    let hull = mesh_of(&points);
    let whole = constrain(&hull, &Plan::new(&[])).expect("no constraint");
    assert_eq!(Some(all), whole.twice_area);
    assert_eq!(made.triangles.len(), hull.triangles.len());
    assert_ne!(made.triangles, hull.triangles);
}

#[test]
fn crossings_are_told_in_the_numbers_of_the_points() {
    let points = [[-0.5, 0.0], [1.0, 1.0], [0.0, 1.25], [1.0, 0.0]];
    let error = constrain(&mesh_of(&points), &Plan::new(&[[0, 1], [2, 3]])).expect_err("a crossing");
    assert_eq!(
        error.to_string(),
        "constraint 1 (from point 2 to point 3) crosses constraint 0 (from point 0 to point 1) at (11/23, 15/23): \
         make the crossing a point"
    );
}
