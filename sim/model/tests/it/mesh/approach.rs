//! Walks that begin at a record of the caller's choice give the same mesh.

use crate::common::mesh_check::{canonical, records_of};
use crate::common::{sets, Random};
use incircle_model::predicate::Point;
use incircle_model::{Insertion, Mesh};

const CAPACITY: u32 = 256;

fn point(word: &u32) -> Point {
    Point { x: word & 0xffff, y: word >> 16 }
}

/// Points spread evenly, points of a small box of which most are equal, points with large cavities, points on the hull.
fn set(random: &mut Random, which: u32) -> Vec<u32> {
    sets::started(match which % 5 {
        0 => sets::boxed(random, 200, 1 << 16),
        1 => sets::boxed(random, 200, 12),
        2 => sets::wheel(random, 150),
        3 => sets::wheel_from_outside(random, 20),
        _ => sets::parabola(random, 150),
    })
}

#[test]
fn a_point_is_approached_and_then_inserted() {
    let mut random = Random(32);
    for trial in 0..30 {
        let words = set(&mut random, trial);
        let (mut mesh, mut plain) = (Mesh::new(CAPACITY, 32), Mesh::new(CAPACITY, 32));
        assert!(mesh.approach(point(&0), None).is_none());
        for (place, word) in (0..).zip(&words) {
            let expected = plain.insert(point(word));
            let records = mesh.records().len() as u32;
            assert!(mesh.approach(point(word), Some(records)).is_none());
            let start = [None, Some(random.below(records.max(1)))][random.below(2) as usize];
            let Some(approach) = mesh.approach(point(word), start) else {
                assert!(place < 3 && mesh.insert(point(word)) == expected);
                continue;
            };
            let record = approach.record() as usize;
            assert_eq!(approach.insert(), expected);
            let is_around = mesh.records()[record].v.contains(&place);
            assert_eq!(is_around, expected == Insertion::Inserted);
        }
        let of = |mesh: &Mesh| canonical(&records_of(mesh, CAPACITY), &words, CAPACITY);
        assert_eq!(of(&mesh), of(&plain), "{words:x?}");
    }
}

#[test]
fn nothing_is_approached_in_a_batch() {
    let mut random = Random(34);
    // Two jobs in turn. A record of the other job would lead the walk into a wrong mesh.
    let words = [sets::started(vec![]), sets::started(sets::boxed(&mut random, 120, 300))].concat();
    let (mut mesh, mut plain) = (Mesh::new(CAPACITY, 32), Mesh::new(CAPACITY, 32));
    mesh.clear_for(2);
    plain.clear_for(2);
    for word in &words {
        assert!(mesh.approach(point(word), Some(0)).is_none());
        mesh.insert(point(word));
        plain.insert(point(word));
        assert!(mesh.approach(point(word), Some(0)).is_none());
    }
    assert_eq!(mesh.records(), plain.records());
}

#[test]
fn a_full_mesh_refuses_what_was_approached() {
    let mut mesh = Mesh::new(4, 9);
    for word in [0, 1, 0x1_0000, 0x5_0005] {
        mesh.insert(point(&word));
    }
    let approach = mesh.approach(point(&0x7_0007), Some(0)).expect("there are triangles");
    assert_eq!(approach.insert(), Insertion::Refused);
    assert_eq!(mesh.counts().refused, 1);
}
