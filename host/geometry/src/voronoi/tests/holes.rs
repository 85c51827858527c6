//! Clips with holes: exact areas beside half planes in fractions, and refusals.

use alloc::vec::Vec;

use incircle_testkit::{twice_area_inside, Area, Fraction, SplitMix64};

use super::brute::{draw, draw_clip, draw_corner, fraction, mesh_of, sets, shoelace, wide};
use crate::voronoi::{Cells, Clip, Corner, Error, Voronoi};
use crate::Point;

#[test]
fn cells_in_polygons_with_holes_have_the_areas_of_half_planes() {
    let mut random = SplitMix64::new(287);
    let (mut clips, mut whole_holes) = (0, 0);
    while clips < sets() {
        let Some(clip) = draw_holes(&mut random) else { continue };
        clips += 1;
        let points = draw(&mut random);
        let (mesh, exact) = (mesh_of(&points), wide(&points));
        let voronoi = Voronoi::of(&mesh).expect("a diagram");
        let (mut cells, mut sum) = (Cells::new(&voronoi, &clip), Area::default());
        let mut area = Area::default();
        clip.rings().for_each(|ring| {
            let corners: Vec<Fraction> = ring.iter().map(|&corner| fraction(Corner::of_point(corner))).collect();
            area.add_twice(&corners, 1);
        });
        for index in voronoi.cells().map(|cell| cell.point()) {
            let cell = cells.cell(index);
            let (mut found, mut by_pieces) = (Area::default(), Area::default());
            for ring in cell.rings() {
                let corners: Vec<Fraction> = ring.corners().map(|(corner, _)| fraction(corner)).collect();
                assert_eq!(shoelace(&corners) < 0.0, ring.is_hole(), "{corners:?}");
                found.add_twice(&corners, 1);
                sum.add_twice(&corners, 1);
            }
            for piece in cell.pieces() {
                let outer: Vec<Fraction> = piece.corners().map(|(corner, _)| fraction(corner)).collect();
                by_pieces.add_twice(&outer, 1);
                for hole in piece.holes() {
                    whole_holes += 1;
                    by_pieces.add_twice(&hole.corners().map(|(corner, _)| fraction(corner)).collect::<Vec<_>>(), 1);
                }
                assert!(piece.area() > 0.0, "{outer:?}");
            }
            let mut expected = Area::default();
            for ring in clip.rings() {
                let part = twice_area_inside(&exact, index as usize, &wide(ring));
                expected = expected.minus(&Area::default().minus(&part));
            }
            assert_eq!(found, expected, "cell {index} of {points:?} in {:?}", clip.corners());
            assert_eq!(by_pieces, expected, "cell {index} of {points:?} in {:?}", clip.corners());
        }
        assert_eq!(sum, area, "{points:?} in {:?}", clip.corners());
    }
    assert!(whole_holes > 0, "no hole inside a cell");
}

/// A polygon with one to three small holes, if the random rings fit together.
pub(in crate::voronoi) fn draw_holes(random: &mut SplitMix64) -> Option<Clip> {
    let outer: Vec<Point> = match random.below(2) {
        0 => [(0, 0), (14, 0), (14, 14), (0, 14)].map(Point::from).to_vec(),
        _ => draw_clip(random).corners().to_vec(),
    };
    let hole = |random: &mut SplitMix64| -> Vec<Point> {
        let (low, side) = (draw_corner(random), 2 + random.below_u32(6));
        let corners = 3 + random.below(2);
        (0..corners).map(|_| Point::new(low.x + random.below_u32(side), low.y + random.below_u32(side))).collect()
    };
    let holes: Vec<Vec<Point>> = (0..1 + random.below(3)).map(|_| hole(random)).collect();
    Clip::with_holes(&outer, &holes).ok()
}

#[test]
fn misplaced_holes_are_refused() {
    let square = |low: u32, high: u32| [(low, low), (high, low), (high, high), (low, high)].map(Point::from).to_vec();
    let clip = |holes: &[Vec<Point>]| Clip::with_holes(&square(10, 20), holes);
    assert_eq!(clip(&[square(12, 14)]).expect("a hole").twice_area(), 2 * (100 - 4));
    assert_eq!(clip(&[square(12, 14), square(1, 3)]).err(), Some(Error::MisplacedHole { hole: 1 }));
    assert_eq!(clip(&[square(13, 14), square(12, 18)]).err(), Some(Error::MisplacedHole { hole: 0 }));
    assert_eq!(clip(&[square(1, 30)]).err(), Some(Error::MisplacedHole { hole: 0 }));
    assert!(matches!(clip(&[square(12, 20)]), Err(Error::CrossedClip { .. })));
    assert!(matches!(clip(&[square(12, 14), square(14, 16)]), Err(Error::CrossedClip { .. })));
    assert_eq!(clip(&[square(12, 12)]).err(), Some(Error::EmptyClip));
}

#[test]
fn a_hole_that_touches_the_border_of_its_cell_belongs_to_it() {
    // Two corners of the hole lie on borders of the cell of point 2, and one of them is a Voronoi vertex.
    let points: Vec<Point> = [(7, 6), (4, 5), (6, 5), (5, 6)].map(Point::from).to_vec();
    let outer: Vec<Point> = [(0, 0), (14, 0), (14, 14), (0, 14)].map(Point::from).to_vec();
    let hole: Vec<Point> = [(6, 6), (8, 2), (5, 4)].map(Point::from).to_vec();
    let clip = Clip::with_holes(&outer, &[hole]).expect("a hole");
    let mesh = mesh_of(&points);
    let voronoi = Voronoi::of(&mesh).expect("a diagram");
    let mut cells = Cells::new(&voronoi, &clip);
    let cell = cells.cell(2);
    assert_eq!(cell.pieces().map(|piece| piece.holes().count()).sum::<usize>(), 1);
    assert_eq!(cell.pieces().map(|piece| 2.0 * piece.area()).sum::<f64>(), 39.0);
}
