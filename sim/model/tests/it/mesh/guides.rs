//! Walks that begin at a vertex: the table of triangles is right after every insertion, and the mesh is the same.

use crate::common::mesh_check::{canonical, records_of};
use crate::common::{sets, Random};
use incircle_model::predicate::Point;
use incircle_model::{CommandModel, Insertion, Mesh};
use incircle_protocol::{clear_word, command_word, infinite_vertex, Opcode};

const CAPACITY: u32 = 256;

fn point(word: &u32) -> Point {
    Point { x: word & 0xffff, y: word >> 16 }
}

/// Even points, points of a small box of which most fall together, points with large cavities, points on the hull.
fn set(random: &mut Random, which: u32) -> Vec<u32> {
    sets::started(match which % 5 {
        0 => sets::boxed(random, 200, 1 << 16),
        1 => sets::boxed(random, 200, 12),
        2 => sets::wheel(random, 150),
        3 => sets::wheel_from_outside(random, 20),
        _ => sets::parabola(random, 150),
    })
}

/// Each vertex has a finite triangle that has it.
fn check_table(mesh: &Mesh, is_vertex: &[bool]) {
    for (vertex, _) in (0..).zip(is_vertex).filter(|(_, &is_vertex)| is_vertex) {
        let triangle = mesh.triangle_of(vertex).unwrap_or_else(|| panic!("vertex {vertex} has no triangle"));
        let record = mesh.records()[triangle as usize];
        assert!(record.v.contains(&vertex), "vertex {vertex}: {record:?}");
        assert!(!record.v.contains(&infinite_vertex(CAPACITY)), "vertex {vertex}: {record:?}");
    }
}

#[test]
fn every_vertex_has_a_triangle_after_every_insertion() {
    let mut random = Random(31);
    let mut flips = 0;
    for trial in 0..60 {
        let words = set(&mut random, trial);
        let mut mesh = Mesh::new(CAPACITY, random.pick(&[9, 32]));
        // The first guide comes at any time.
        let unguided = random.below(40);
        let mut is_vertex = Vec::new();
        for (place, word) in (0..).zip(&words) {
            let inserted = match place < unguided {
                true => mesh.insert(point(word)),
                // A later point, or the point itself, is no guide.
                false => mesh.insert_near(point(word), random.below(place + 3)),
            };
            is_vertex.push(inserted == Insertion::Inserted);
            if place >= unguided.max(2) {
                check_table(&mesh, &is_vertex);
            }
        }
        flips += mesh.counts().flips;
        let mut plain = Mesh::new(CAPACITY, 32);
        for word in &words {
            plain.insert(point(word));
        }
        let of = |mesh: &Mesh| canonical(&records_of(mesh, CAPACITY), &words, CAPACITY);
        assert_eq!(of(&mesh), of(&plain), "{words:x?}");
        mesh.clear();
        assert_eq!(mesh.triangle_of(0), None);
    }
    assert!(flips > 100, "{flips} flips");
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
            let guide = [None, Some(random.below(place + 1))][random.below(2) as usize];
            let Some(approach) = mesh.approach(point(word), guide) else {
                assert!(place < 3 && mesh.insert(point(word)) == expected);
                continue;
            };
            let (vertex, at) = approach.nearest();
            assert_eq!(at, point(&words[vertex as usize]));
            assert_eq!(at == point(word), expected == Insertion::Duplicate);
            assert_eq!(approach.insert(), expected);
        }
        let of = |mesh: &Mesh| canonical(&records_of(mesh, CAPACITY), &words, CAPACITY);
        assert_eq!(of(&mesh), of(&plain), "{words:x?}");
    }
}

#[test]
fn a_batch_takes_no_guides() {
    let mut random = Random(34);
    // Two jobs in turn, of which a guide of the other would lead into a wrong mesh.
    let words = [sets::started(vec![]), sets::started(sets::boxed(&mut random, 120, 300))].concat();
    let (mut mesh, mut plain) = (Mesh::new(CAPACITY, 32), Mesh::new(CAPACITY, 32));
    mesh.clear_for(2);
    plain.clear_for(2);
    for (place, word) in (0..).zip(&words) {
        mesh.insert_near(point(word), random.below(place + 1));
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

/// Sends an `Insert` of these points, and returns the walk's visits so far.
fn insert(model: &mut CommandModel, words: &[u32]) -> u32 {
    model.send(&[command_word(Opcode::Insert), words.len() as u32]);
    model.send(words);
    model.mesh().counts().walk_visits
}

#[test]
fn commands_take_guides_in_turn_and_forget_them() {
    let mut random = Random(33);
    let words = sets::started(sets::boxed(&mut random, 200, 1 << 16));
    let mut model = CommandModel::new(16, CAPACITY, 32).expect("possible");
    let mut visits = Vec::new();
    for is_guided in [false, true, false] {
        model.send(&[clear_word(0)]);
        if is_guided {
            // The first point is far from all others: the walks get longer.
            model.guide(&vec![0; words.len()]);
        }
        insert(&mut model, &words[..100]);
        visits.push(insert(&mut model, &words[100..]));
    }
    assert!(visits[1] != visits[0] && visits[2] == visits[0], "{visits:?}");
    // Guides that were not used up are forgotten.
    model.guide(&[0; 64]);
    model.send(&[clear_word(0)]);
    assert_eq!(insert(&mut model, &words), visits[0]);
}
