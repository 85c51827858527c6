//! Every order of insertion and every number of contexts gives the same mesh.

use crate::common::bench::{Bench, Stalls};
use crate::common::mesh_check::canonical;
use crate::common::{sets, Random};
use incircle_protocol::{clear_word, command_word, Config, Opcode, Status};

#[test]
fn every_order_gives_the_same_mesh() {
    const ORDERS: u32 = 12;
    let mut random = Random(11);
    for trial in 0..24 {
        let side = random.pick(&[6, 16, 40, 1 << 16]);
        let mut points = match trial % 4 {
            0 => sets::wheel(&mut random, 120),
            1 => sets::parabola(&mut random, 150),
            _ => sets::boxed(&mut random, 200, side),
        };
        let mut first = None;
        for contexts in [1, 2, 4, 8, 16, 24] {
            let mut bench =
                Bench::new(Config { name: "test", points: 256, ring: random.pick(&[9, 32]), contexts, engines: 1 });
            for _ in 0..ORDERS {
                random.shuffle(&mut points);
                let sent = sets::started(points.clone());
                let mut words = vec![clear_word(0), command_word(Opcode::Insert), sent.len() as u32];
                words.extend(&sent);
                // The mesh must not depend on when the points come, either.
                let stalls = Stalls { idle: random.pick(&[0, 2, 3]), ..Stalls::default() };
                let answers = bench.run(&words, 2, stalls, 1_000_000, &mut random).unwrap();
                assert!(answers[1].is(Status::Ok), "{answers:?}, {}", bench.core.describe());
                let records = bench.records(answers[1].report().records);
                let mesh = canonical(&records, &sent, 256).unwrap_or_else(|fault| panic!("{fault}: {sent:x?}"));
                let right = first.get_or_insert_with(|| mesh.clone());
                assert_eq!(&mesh, right, "{contexts} contexts, points {sent:x?}");
            }
        }
    }
}
