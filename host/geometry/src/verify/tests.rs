//! The validator accepts right meshes and names what is wrong with others.

use super::*;
use crate::point::Point;

/// A lattice of 4 x 4 points with its canonical triangles. Each of its nine squares is a tie.
fn lattice() -> (Vec<Point>, Vec<[u32; 3]>) {
    let points: Vec<Point> = (0..16).map(|k| Point::new(k / 4, k % 4)).collect();
    let mut triangles = Vec::new();
    for square in [0, 1, 2, 4, 5, 6, 8, 9, 10] {
        triangles.push([square, square + 4, square + 5]);
        triangles.push([square, square + 5, square + 1]);
    }
    triangles.sort_unstable();
    (points, triangles)
}

fn error(points: &[Point], triangles: &[[u32; 3]]) -> VerifyError {
    verify(points, triangles).expect_err("the mesh is wrong")
}

#[test]
fn the_lattice_is_right_and_all_its_squares_are_ties() {
    let (points, triangles) = lattice();
    let summary = verify(&points, &triangles).expect("a right mesh");
    assert_eq!((summary.triangles, summary.edges, summary.ties), (18, 33, 9));
    assert_eq!(summary.hull.len(), 12);
}

#[test]
fn a_flipped_tie_is_found() {
    let (points, mut triangles) = lattice();
    triangles.retain(|t| *t != [5, 9, 10] && *t != [5, 10, 6]);
    triangles.extend([[5, 9, 6], [6, 9, 10]]);
    triangles.sort_unstable();
    let found = error(&points, &triangles);
    assert!(matches!(found, VerifyError::WrongTie { smallest: 5, .. }), "{found}");
}

#[test]
fn a_flipped_edge_is_found() {
    let points = [(0, 0), (10, 1), (20, 0), (10, 9)].map(Point::from);
    assert!(verify(&points, &[[0, 1, 3], [0, 2, 1], [1, 2, 3]]).is_ok());
    let square = [(0, 0), (10, 0), (12, 10), (0, 10)].map(Point::from);
    assert!(verify(&square, &[[0, 1, 3], [1, 2, 3]]).is_ok());
    let found = error(&square, &[[0, 1, 2], [0, 2, 3]]);
    assert!(matches!(found, VerifyError::NotDelaunay { edge: [2, 0] | [0, 2], .. }), "{found}");
}

#[test]
fn a_missing_triangle_is_found() {
    let (points, triangles) = lattice();
    for missing in 0..triangles.len() {
        let mut fewer = triangles.clone();
        fewer.remove(missing);
        let found = error(&points, &fewer);
        assert!(matches!(found, VerifyError::TriangleCount { found: 17, expected: 18, .. }), "{found}");
    }
}

#[test]
fn a_doubled_triangle_is_found() {
    let (points, mut triangles) = lattice();
    triangles.insert(5, triangles[5]);
    let found = error(&points, &triangles);
    assert!(matches!(found, VerifyError::DoubledTriangle { triangle: 6, .. }), "{found}");
}

#[test]
fn the_canonical_form_is_demanded() {
    let (points, triangles) = lattice();
    let mut turned = triangles.clone();
    turned[3].rotate_left(1);
    assert!(matches!(error(&points, &turned), VerifyError::NotRotated { triangle: 3, .. }));
    let mut swapped = triangles.clone();
    swapped.swap(6, 7);
    assert!(matches!(error(&points, &swapped), VerifyError::NotSorted { triangle: 7, .. }));
    let mut mirrored = triangles.clone();
    mirrored[2].swap(1, 2);
    assert!(matches!(error(&points, &mirrored), VerifyError::NotCounterClockwise { triangle: 2, .. }));
    let mut wild = triangles;
    wild[17][2] = 16;
    assert!(matches!(error(&points, &wild), VerifyError::IndexOutOfRange { index: 16, .. }));
}

#[test]
fn duplicates_go_by_their_lowest_index() {
    let points = [(0, 0), (5, 0), (5, 0), (0, 5)].map(Point::from);
    assert!(verify(&points, &[[0, 1, 3]]).is_ok());
    let found = error(&points, &[[0, 2, 3]]);
    assert_eq!(found, VerifyError::NotLowestIndex { triangle: 0, index: 2, of: 1 });
}

#[test]
fn an_unused_point_is_found() {
    // The number of triangles is right for five points, but no triangle has point 4.
    let points = [(0, 0), (4, 0), (4, 4), (0, 4), (2, 1)].map(Point::from);
    let found = error(&points, &[[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]]);
    assert_eq!(found, VerifyError::UnusedPoint { index: 4 });
}

#[test]
fn overlapping_triangles_do_not_pass_by_count() {
    let points = [(0, 0), (4, 0), (4, 4), (0, 4), (2, 1)].map(Point::from);
    let found = error(&points, &[[0, 1, 2], [0, 1, 4], [0, 2, 3], [1, 2, 4]]);
    assert!(matches!(found, VerifyError::Area { .. }), "{found}");
}

#[test]
fn an_open_edge_and_a_shared_side_are_found_behind_right_sums() {
    // Right count and right area, but the triangles overlap: a parallelogram's halves of equal area
    // in the wrong places.
    let points = [(0, 0), (4, 0), (4, 4), (0, 4)].map(Point::from);
    let found = error(&points, &[[0, 1, 2], [0, 1, 3]]);
    assert!(matches!(found, VerifyError::SameSide { edge: [0, 1], .. }), "{found}");
    let found = error(&points, &[[0, 1, 3], [0, 2, 3]]);
    let named = matches!(found, VerifyError::SameSide { edge: [3, 0], .. } | VerifyError::OpenEdge { .. });
    assert!(named, "{found}");
}

#[test]
fn collinear_points_have_no_triangles() {
    for raw in [&[][..], &[(3, 3)], &[(3, 3), (3, 3)], &[(0, 0), (7, 7), (3, 3), (5, 5)]] {
        let points: Vec<Point> = raw.iter().map(|&pair| pair.into()).collect();
        let summary = verify(&points, &[]).expect("no triangles are right");
        assert!(summary.collinear);
        let found = error(&points, &[[0, 1, 2]]);
        assert_eq!(found, VerifyError::TrianglesOfCollinearPoints { triangles: 1 });
    }
}

#[test]
fn coordinates_that_are_no_numbers_are_named() {
    for value in [f64::NAN, f64::INFINITY] {
        let points = [[0.0, 0.0], [value, 1.0], [2.0, 0.0]];
        assert_eq!(verify(&points, &[[0, 1, 2]]), Err(VerifyError::NotFinite { index: 1 }));
    }
}

#[test]
fn wrong_meshes_of_doubles_and_long_integers_are_refused() {
    let square = [[0.1, 0.1], [0.3, 0.1], [0.3, 0.3], [0.1, 0.3]];
    assert_eq!(verify(&square, &[[0, 1, 2], [0, 2, 3]]).map(|summary| summary.ties), Ok(1));
    assert!(matches!(verify(&square, &[[0, 1, 3], [1, 2, 3]]), Err(VerifyError::WrongTie { smallest: 0, .. })));
    // One unit in the last place moves the fourth corner into the circle.
    let mut inside = square;
    inside[2] = [0.3f64.next_down(), 0.3];
    assert!(
        matches!(verify(&inside, &[[0, 1, 3], [1, 2, 3]]), Err(VerifyError::NotDelaunay { .. }))
            || verify(&inside, &[[0, 1, 2], [0, 2, 3]]).is_err()
    );
    let far = [[i64::MIN, i64::MIN], [i64::MAX, i64::MIN], [i64::MAX, i64::MAX], [i64::MIN, i64::MAX]];
    assert_eq!(verify(&far, &[[0, 1, 2], [0, 2, 3]]).map(|summary| summary.ties), Ok(1));
    assert!(matches!(verify(&far, &[[0, 2, 1], [0, 2, 3]]), Err(VerifyError::NotCounterClockwise { triangle: 0, .. })));
    assert!(matches!(verify(&far, &[[0, 1, 2]]), Err(VerifyError::TriangleCount { .. })));
}

#[test]
fn hull_and_duplicates_are_compared_place_by_place() {
    let points = [(0, 0), (5, 0), (5, 0), (0, 5)].map(Point::from);
    let summary = verify(&points, &[[0, 1, 3]]).expect("a right mesh");
    assert_eq!(check_hull(&[0, 1, 3], &summary), Ok(()));
    let short = check_hull(&[0, 1], &summary);
    assert_eq!(short, Err(VerifyError::Hull { place: 2, found: None, expected: Some(3) }));
    assert_eq!(check_duplicates(&points, &[Duplicate { index: 2, of: 1 }]), Ok(()));
    assert_eq!(check_duplicates(&points, &[]), Err(VerifyError::Duplicates { place: 0 }));
}

/// Types of the rest of the library that the validator may use, because they carry numbers and decide nothing.
const TYPES: [&str; 8] = [
    "use crate::lattice::Numbers;",
    "use crate::plan::Domain;",
    "use crate::plan::Mark;",
    "use crate::plan::{Domain, Mark};",
    "use crate::plan::{Domain, Mark, Plan};",
    "use crate::plane_point::PlanePoint;",
    "use crate::point::Duplicate;",
    "use crate::point::Point;",
];

/// Whether a line of the validator uses code from outside the validator and the standard library.
fn shares_code(line: &str, modules: &[String]) -> bool {
    let line = line.trim();
    if line.starts_with("//") || TYPES.contains(&line) {
        return false;
    }
    let names_another_place =
        ["crate::", "super::super", "incircle_", "glam::"].iter().any(|place| line.contains(place));
    let import = line.strip_prefix("pub ").unwrap_or(line).strip_prefix("use ");
    let root = import.map(|path| path.split([':', ';', ' ']).next().unwrap_or_default());
    let is_known = |root: &str| {
        ["std", "core", "alloc", "self", "super"].contains(&root) || modules.iter().any(|module| module == root)
    };
    names_another_place || root.is_some_and(|root| !is_known(root))
}

#[test]
fn only_types_come_from_the_rest_of_the_library() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/verify");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    // Files of tests are not part of the validator.
    let is_test = |path: &std::path::PathBuf| path.ends_with("tests.rs") || path.ends_with("plan_tests.rs");
    let sources: Vec<_> = files.filter(|path| !is_test(path)).collect();
    let modules: Vec<String> =
        sources.iter().map(|path| path.file_stem().unwrap().to_string_lossy().into_owned()).collect();
    assert!(modules.len() >= 5 && modules.iter().any(|module| module == "mod"), "{modules:?}");
    for path in &sources {
        // Tests come last in a file, and may use what they like.
        let text = std::fs::read_to_string(path).unwrap();
        for line in text.lines().take_while(|line| *line != "#[cfg(test)]") {
            assert!(!shares_code(line, &modules), "{}: {line}", path.display());
        }
    }
    for line in [
        "use crate::prepare::orient2d;",
        "    let side = crate::cpu::orient2d(a, b, c);",
        "use super::super::cpu;",
        "pub use incircle_model::CommandModel;",
        "use glam::UVec2;",
        "use rand::Rng;",
    ] {
        assert!(shares_code(line, &modules), "{line} is not found");
    }
}
