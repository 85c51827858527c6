//! The nearest vertices that a core with questions finds, against those of brute force, on grids so small that most
//! places have several vertices at the same distance.

use crate::common::bench::{Bench, Stalls};
use crate::common::Random;
use incircle_model::ClockModel;
use incircle_protocol::{command_word, part_item, Clear, Config, Meshes, Opcode, Outcome, Status, TINY};
use std::collections::BTreeSet;

const CORE: Config = Config { points: 256, contexts: 16, ring: 32, ..TINY };

/// The vertex nearest to a place; of equal distances that of the smallest point.
fn nearest(points: &[u32], place: u32) -> u32 {
    let [x, y] = [place & 0xffff, place >> 16];
    let nearness = |&(_, &point): &(usize, &u32)| {
        let [a, b] = [point & 0xffff, point >> 16];
        (u64::from(a.abs_diff(x)).pow(2) + u64::from(b.abs_diff(y)).pow(2), [a, b])
    };
    points.iter().enumerate().min_by_key(nearness).map_or(0, |(vertex, _)| vertex as u32)
}

/// Asks a new mesh about random places, and returns their number.
fn ask(random: &mut Random) -> usize {
    let side = random.pick(&[2, 3, 4, 6, 9, 1 << 16]);
    let word = |random: &mut Random, side: u32| random.below(side) | random.below(side) << 16;
    let (mut seen, most) = (BTreeSet::new(), 3 + random.below(70));
    let points: Vec<u32> = (0..most).map(|_| word(random, side)).filter(|&point| seen.insert(point)).collect();
    let places: Vec<u32> = (0..60).map(|_| word(random, (side + 2).min(1 << 16))).collect();
    let contexts = 1 + random.below(CORE.contexts);
    let mut words = vec![Clear { contexts, meshes: Meshes::One, tag: 0 }.word()];
    words.extend([command_word(Opcode::Insert), points.len() as u32]);
    words.extend(&points);
    words.extend([command_word(Opcode::Nearest), places.len() as u32]);
    words.extend(&places);
    let mut bench = Bench::new(CORE);
    bench.core = ClockModel::new(CORE).expect("a core that can be built").with_core_runs();
    let answers = bench.run(&words, 3, Stalls::default(), 1_000_000, random).expect("the core answers");
    let answer = answers.last().expect("an answer to each command");
    if answer.status == Status::NoMesh as u8 {
        return 0;
    }
    assert_eq!((answer.status, answer.payload.len()), (0, 2 * places.len()));
    let mut asked = BTreeSet::new();
    for part in answer.payload.chunks(2) {
        let place = places[part_item(part[0]) as usize];
        assert!(asked.insert(part_item(part[0])), "each item has one part");
        let found = (part[0] >> 24, part[1]);
        assert_eq!(found, (Outcome::Vertex as u32, nearest(&points, place)), "{place:#x} among {points:x?}");
    }
    asked.len()
}

#[test]
fn nearest_vertices_are_those_of_brute_force() {
    let mut random = Random(86);
    let asked: usize = (0..1_500).map(|_| ask(&mut random)).sum();
    assert!(asked > 60_000, "{asked} places");
}
