//! The cycles of a deletion: runs of 1,000 to 4,000 among 8,000 uniform points in Hilbert order, dealt to 16 contexts.

use incircle_model::{ClockModel, Inputs};
use incircle_protocol::{command_word, Clear, Opcode, FULL};
use incircle_testkit::{generate, Distribution, SplitMix64};

/// Number of clocks of these commands, until this many words of answers have been taken.
pub fn clocks(model: &mut ClockModel, words: &[u32], answers: usize) -> usize {
    let (mut rest, mut taken, mut clocks) = (words, 0, 0);
    while !rest.is_empty() || taken < answers {
        let outputs = model.outputs();
        taken += if outputs.response_valid { 1 + usize::from(outputs.response_both) } else { 0 };
        model.clock(Inputs {
            reset: false,
            command_valid: !rest.is_empty(),
            command_data: rest.first().copied().unwrap_or(0),
            response_ready: true,
        });
        if outputs.command_ready && !rest.is_empty() {
            rest = &rest[1..];
        }
        clocks += 1;
        assert!(clocks < 10_000_000, "the core answers");
    }
    clocks
}

/// The place of a point on the Hilbert curve.
fn on_curve([x, y]: [u32; 2]) -> u64 {
    let (mut x, mut y, mut along) = (x, y, 0);
    for bit in (0..16).rev() {
        let [a, b] = [x >> bit & 1, y >> bit & 1];
        along = along << 2 | u64::from((3 * a) ^ b);
        if b == 0 {
            if a == 1 {
                (x, y) = (!x & 0xffff, !y & 0xffff);
            }
            (x, y) = (y, x);
        }
    }
    along
}

/// Items of a run in Hilbert order, a stretch for each of 16 contexts.
pub fn dealt(points: &[[u32; 2]], vertices: &[usize]) -> Vec<usize> {
    let mut order = vertices.to_vec();
    order.sort_by_key(|&vertex| on_curve(points[vertex]));
    let stretch = order.len() / 16;
    (0..16 * stretch).map(|item| order[item % 16 * stretch + item / 16]).collect()
}

#[test]
fn a_deletion_takes_fewer_than_25_cycles_in_runs_of_2000() {
    let points = generate(Distribution::Uniform, 8_000, 16, 1).expect("a set of this size");
    let word = |vertex: usize| points[vertex][0] | points[vertex][1] << 16;
    for (seed, count, most) in
        [(1, 1_000, 27.0), (1, 2_000, 25.0), (2, 2_000, 25.0), (3, 2_000, 25.0), (1, 4_000, 24.0)]
    {
        let mut model = ClockModel::new(FULL).unwrap().with_core_runs();
        let mut insert = vec![Clear::default().word(), command_word(Opcode::Insert), 8_000];
        insert.extend((0..8_000).map(word));
        clocks(&mut model, &insert, 2 + 7);
        let mut vertices: Vec<usize> = (0..8_000).collect();
        SplitMix64::new(seed).shuffle(&mut vertices);
        let items = dealt(&points, &vertices[..count]);
        let mut ask = vec![command_word(Opcode::Locate), 16];
        ask.extend(items[..16].iter().map(|&vertex| word(vertex)));
        clocks(&mut model, &ask, 2 + 4 * 16);
        let mut run = vec![command_word(Opcode::Delete), items.len() as u32];
        run.extend(items.iter().map(|&vertex| vertex as u32));
        let cycles = clocks(&mut model, &run, 2 + 2 * items.len()) as f64 / items.len() as f64;
        clocks(&mut model, &ask, 2 + 4 * 16);
        let mut run = vec![command_word(Opcode::InsertAs), items.len() as u32];
        run.extend(items.iter().flat_map(|&vertex| [vertex as u32, word(vertex)]));
        let back = clocks(&mut model, &run, 2 + 2 * items.len()) as f64 / items.len() as f64;
        println!("{count} items, seed {seed}: a deletion takes {cycles:.2} cycles, an insertion {back:.2}");
        assert!(cycles < most && back < 17.0, "{count} items, seed {seed}: {cycles} and {back} cycles");
    }
}
