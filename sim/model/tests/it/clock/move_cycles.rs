//! The cycles of a move: runs of 1,000 to 8,000 among 8,000 uniform points in Hilbert order, dealt to 16 contexts.

use super::delete_cycles::{clocks, dealt};
use incircle_model::ClockModel;
use incircle_protocol::{command_word, Clear, Opcode, FULL};
use incircle_testkit::{generate, Distribution, SplitMix64};
use std::collections::{HashMap, HashSet};

/// The distance to the nearest other point.
fn nearest(points: &[[u32; 2]], [x, y]: [u32; 2]) -> f64 {
    let distance = |&[u, v]: &[u32; 2]| u64::from(x.abs_diff(u)).pow(2) + u64::from(y.abs_diff(v)).pow(2);
    let least = points.iter().map(distance).filter(|&distance| distance > 0).min().expect("another point");
    (least as f64).sqrt()
}

/// New places of all vertices but the first three: a share of the distance to the nearest neighbour away, in any
/// direction, and different from all places before and after.
fn moved(points: &[[u32; 2]], percent: f64, random: &mut SplitMix64) -> Vec<(usize, [u32; 2])> {
    let mut taken: HashSet<[u32; 2]> = points.iter().copied().collect();
    let mut items = Vec::new();
    for (vertex, &at) in points.iter().enumerate().skip(3) {
        let step = (nearest(points, at) * percent / 100.0).round().max(1.0);
        let angle = random.unit() * std::f64::consts::TAU;
        let shift = |value: u32, by: f64| (f64::from(value) + by.round()).clamp(0.0, 65535.0) as u32;
        let to = [shift(at[0], step * angle.cos()), shift(at[1], step * angle.sin())];
        if taken.insert(to) {
            items.push((vertex, to));
        }
    }
    items
}

/// The cycles of a move in a run of so many, by a share of the distance to the nearest neighbour.
fn cycles(percent: u32, count: usize, seed: u64) -> f64 {
    let word = |[x, y]: [u32; 2]| x | y << 16;
    let mut points = generate(Distribution::Uniform, 8_000, 16, 1).expect("a set of this size");
    let mut model = ClockModel::new(FULL).unwrap().with_core_runs();
    let mut insert = vec![Clear::default().word(), command_word(Opcode::Insert), 8_000];
    insert.extend(points.iter().copied().map(word));
    clocks(&mut model, &insert, 2 + 7);
    let mut random = SplitMix64::new(seed);
    let mut items = moved(&points, f64::from(percent), &mut random);
    random.shuffle(&mut items);
    items.truncate(count);
    let vertices: Vec<usize> = items.iter().map(|&(vertex, _)| vertex).collect();
    let order = dealt(&points, &vertices);
    let places: HashMap<usize, [u32; 2]> = items.into_iter().collect();
    let mut ask = vec![command_word(Opcode::Locate), 16];
    ask.extend(order[..16].iter().map(|&vertex| word(points[vertex])));
    clocks(&mut model, &ask, 2 + 4 * 16);
    let mut run = vec![command_word(Opcode::Move), order.len() as u32];
    for &vertex in &order {
        points[vertex] = places[&vertex];
        run.extend([vertex as u32, word(points[vertex])]);
    }
    clocks(&mut model, &run, 2 + 2 * order.len()) as f64 / order.len() as f64
}

#[test]
fn a_small_move_takes_no_more_cycles_than_the_page_says() {
    // The cycles of a run differ by a hundredth from one set of new places to another.
    for (percent, count, sets, most) in [
        (2, 8_000, 1, 17.0),
        (5, 1_000, 1, 23.0),
        (5, 2_000, 1, 20.5),
        (5, 4_000, 1, 19.1),
        (5, 8_000, 6, 18.0),
        (10, 1_000, 1, 25.0),
        (10, 2_000, 1, 22.6),
        (10, 8_000, 6, 20.0),
    ] {
        let mean = (2..2 + sets).map(|seed| cycles(percent, count, seed)).sum::<f64>() / sets as f64;
        println!("{count} items by {percent} %: a move takes {mean:.2} cycles");
        assert!(mean <= most, "{count} items by {percent} %: {mean} cycles");
    }
}
