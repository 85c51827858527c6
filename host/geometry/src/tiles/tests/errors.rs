//! Lists that do not fit together are refused, and never cause a panic.

use super::*;
use crate::point::Point;
use crate::tiles::{Border, Error, Union};

fn square() -> Mesh {
    mesh_of(&[(0, 0), (4, 0), (4, 4), (0, 4)].map(Point::from))
}

fn border(region: Region) -> Border<Point, u32> {
    local(&square(), &[0, 1, 2, 3], region).expect("a tile").border
}

#[test]
fn a_tile_refuses_lists_that_do_not_fit() {
    let beyond = Region { east: Some(4), ..Region::WHOLE };
    assert_eq!(local(&square(), &[0, 1, 2, 3], beyond), Err(Error::Beyond { place: 1 }));
    assert_eq!(local(&square(), &[0, 1, 2], Region::WHOLE), Err(Error::Ids { points: 4, ids: 3 }));
    let mut mesh = square();
    mesh.triangles[1][2] = 4;
    assert_eq!(local(&mesh, &[0, 1, 2, 3], Region::WHOLE), Err(Error::NoSuchPoint { place: 4, points: 4 }));
    let mut mesh = square();
    mesh.hull[0] = u32::MAX;
    let error = local(&mesh, &[0, 1, 2, 3], Region::WHOLE);
    assert_eq!(error, Err(Error::NoSuchPoint { place: u32::MAX, points: 4 }));
    let nan = Mesh::new(vec![[f64::NAN, 0.0]], Vec::new(), vec![0], Vec::new());
    assert_eq!(local(&nan, &[0], Region { west: Some(0.0), ..Region::WHOLE }), Err(Error::Beyond { place: 0 }));
}

#[test]
fn a_join_refuses_regions_that_do_not_fit() {
    let west = Region { east: Some(5), ..Region::WHOLE };
    let error = join(west, vec![border(west), border(Region::WHOLE)]);
    assert_eq!(error, Err(Error::NotCovered { child: 1 }));
    let error = join(Region::WHOLE, vec![border(west), border(Region { east: Some(6), ..Region::WHOLE })]);
    assert_eq!(error, Err(Error::Overlap { one: 0, other: 1 }));
}

#[test]
fn a_join_refuses_lists_that_do_not_fit() {
    let region = Region { east: Some(5), ..Region::WHOLE };
    let mut short = border(region);
    short.ids.pop();
    assert_eq!(join(Region::WHOLE, vec![short]), Err(Error::Ids { points: 4, ids: 3 }));
    let mut wild = border(region);
    wild.open.push([0, 7, 2]);
    assert_eq!(join(Region::WHOLE, vec![wild]), Err(Error::NoSuchPoint { place: 7, points: 4 }));
    for order in [[[0, 2, 3], [0, 1, 2]], [[0, 1, 2], [0, 1, 2]], [[0, 1, 2], [2, 3, 0]]] {
        let mut disordered = border(region);
        disordered.open = order.to_vec();
        assert_eq!(join(Region::WHOLE, vec![disordered]), Err(Error::NotCanonical { place: 1 }));
    }
    let union = Union::of(Region::WHOLE, vec![border(region)]).expect("a union");
    let more = mesh_of(&[(0, 0), (4, 0), (4, 4), (0, 4), (9, 9)].map(Point::from));
    assert_eq!(union.settle(&more), Err(Error::NoSuchPoint { place: 4, points: 4 }));
    assert!(union.settle(&Mesh::default()).is_ok());
}
