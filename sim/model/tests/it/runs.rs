//! Runs by words: what a device answers, item by item.

use incircle_model::CommandModel;
use incircle_protocol::{part_head, Command, Layout, Outcome, RunKind, Status, MAX_MODEL_POINTS};

const CAPACITY: u32 = 16;

/// A model with runs and these points.
fn model(coord_bits: u32, points: &[[u32; 2]]) -> CommandModel {
    let mut model = CommandModel::new(coord_bits, CAPACITY, 8).expect("possible").with_runs();
    let layout = Layout::of(coord_bits, CAPACITY);
    let words: Vec<u32> = points.iter().flat_map(|&[x, y]| point(layout, x, y)).collect();
    ask(&mut model, &Command::insert(words, layout));
    model
}

fn point(layout: Layout, x: u32, y: u32) -> Vec<u32> {
    match layout.point_words {
        1 => vec![x | y << 16],
        _ => vec![x, y],
    }
}

/// The answer to a command: its status, and its payload.
fn ask(model: &mut CommandModel, command: &Command<Vec<u32>>) -> (u8, Vec<u32>) {
    let mut words = Vec::new();
    command.encode(&mut words);
    model.send(&words);
    let mut answer = vec![0; 1000];
    let length = model.receive(&mut answer);
    answer.truncate(length);
    assert!(!model.is_busy() && answer.len() == 2 + answer[1] as usize);
    ((answer[0] >> 16) as u8, answer[2..].to_vec())
}

fn run(model: &mut CommandModel, kind: RunKind, items: &[u32]) -> Vec<u32> {
    let (status, payload) = ask(model, &Command::run(kind, items.to_vec(), Layout::of(16, CAPACITY)));
    assert_eq!(status, Status::Ok as u8);
    payload
}

/// A square with its middle: vertices 0 to 4.
const SQUARE: [[u32; 2]; 5] = [[0, 0], [8, 0], [8, 8], [0, 8], [4, 4]];

#[test]
fn questions_about_places() {
    let mut model = model(16, &SQUARE);
    let place = |x: u32, y: u32| x | y << 16;
    let places = [place(8, 8), place(2, 2), place(4, 2), place(9, 4), place(9, 9)];
    let located = run(&mut model, RunKind::Locate, &places);
    let parts: Vec<&[u32]> = located.chunks(4).collect();
    let outcomes = [Outcome::Vertex, Outcome::Edge, Outcome::Triangle, Outcome::Outside, Outcome::Outside];
    for (number, (part, outcome)) in (0..).zip(parts.iter().zip(outcomes)) {
        assert_eq!(part[0], part_head(number, outcome), "{part:x?}");
    }
    assert_eq!((parts[0][1..4].to_vec(), parts[3][1..4].to_vec()), (vec![2, 0, 0], vec![1, 2, 0]));
    let mut ends = [parts[1][1], parts[1][2]];
    ends.sort_unstable();
    assert_eq!((ends, parts[1][3]), ([0, 4], 0));
    let mut corners = [parts[2][1], parts[2][2], parts[2][3]];
    corners.sort_unstable();
    assert_eq!(corners, [0, 1, 4]);
    // From (9, 9) two hull edges are visible, and 1-2 is the first.
    assert_eq!(parts[4][1..4], [1, 2, 0]);
    let nearest = run(&mut model, RunKind::Nearest, &[place(7, 1), place(4, 0), place(9, 9)]);
    let head = |number| part_head(number, Outcome::Vertex);
    // (4, 0) is 4 away from (0, 0), (8, 0) and (4, 4), and (0, 0) is the smallest.
    assert_eq!(nearest, [head(0), 1, head(1), 0, head(2), 2]);
}

#[test]
fn weights_give_the_value_of_a_plane_at_every_place() {
    let mut model = model(20, &[[0, 0], [900_000, 10], [20, 700_000], [500_000, 500_001]]);
    let value = |x: u32, y: u32| 3 * i128::from(x) - 7 * i128::from(y) + 11;
    let at = [[0u32, 0], [900_000, 10], [20, 700_000], [500_000, 500_001]];
    let places = [[100, 100], [450_000, 5], [500_000, 500_001], [300_000, 300_000]];
    let items = places.iter().flatten().copied().collect();
    let (status, payload) = ask(&mut model, &Command::run(RunKind::Interpolate, items, Layout::of(20, CAPACITY)));
    assert_eq!((status, payload.len()), (0, 40));
    for ([x, y], part) in places.into_iter().zip(payload.chunks(10)) {
        let located = incircle_protocol::Located::from_words(&part[1..]);
        let pairs = located.vertices.into_iter().zip(located.weights);
        let sum: i128 = located.weights.iter().map(|&weight| i128::from(weight)).sum();
        let weighed =
            pairs.map(|(vertex, weight)| value(at[vertex as usize][0], at[vertex as usize][1]) * i128::from(weight));
        assert!(sum > 0);
        assert_eq!(weighed.sum::<i128>(), value(x, y) * sum, "at {x} {y}: {part:x?}");
    }
}

#[test]
fn changes_and_the_read_out_of_free_records() {
    let mut model = model(16, &SQUARE);
    let done = |number, vertex| [part_head(number, Outcome::Done), vertex];
    assert_eq!(run(&mut model, RunKind::Delete, &[4]), done(0, 4));
    // Four vertices have 6 records; ids 0 to 7 have been used.
    assert_eq!(ask(&mut model, &Command::Triangles(range(0, 7))).0, Status::BadRange as u8);
    let (status, packed) = ask(&mut model, &Command::Triangles(range(0, 6)));
    let vertices: Vec<u32> = packed.iter().flat_map(|word| [word & 0xffff, word >> 16]).collect();
    let finite: Vec<&[u32]> = vertices.chunks(3).filter(|v| !v.contains(&31)).collect();
    assert_eq!((status, packed.len(), finite.len()), (0, 9, 2));
    // The smallest point, vertex 0, is on the diagonal.
    assert!(finite.iter().all(|v| v.contains(&0) && v.contains(&2)), "{finite:?}");
    let parts: Vec<u32> = (0..6).flat_map(|first| ask(&mut model, &Command::Triangles(range(first, 1))).1).collect();
    let alone: Vec<u32> = parts.chunks(2).flat_map(|p| [p[0] & 0xffff, p[0] >> 16, p[1]]).collect();
    assert_eq!(alone, vertices);
    let records = ask(&mut model, &Command::Read(range(0, 8))).1;
    let infinite = |record: &&[u32]| record.iter().all(|word| word & 0x7fff == 31);
    assert_eq!(records.chunks(3).filter(infinite).count(), 2);
    assert_eq!(run(&mut model, RunKind::InsertAs, &[9, 5 | 5 << 16]), done(0, 9));
    assert_eq!(run(&mut model, RunKind::Move, &[9, 4 | 4 << 16]), done(0, 9));
    let report = ask(&mut model, &Command::insert(vec![4 | 4 << 16], Layout::of(16, CAPACITY)));
    assert_eq!(report, (0, vec![11, 5, 1, 0, 8]));
}

const fn range(first: u32, count: u32) -> incircle_protocol::RecordRange {
    incircle_protocol::RecordRange { first, count }
}

#[test]
fn what_cannot_be_done_is_said_for_each_item() {
    let mut model = model(12, &[[0, 0], [8, 0], [0, 8]]);
    let part = |number, outcome: Outcome, vertex| [part_head(number, outcome), vertex];
    let off = 4096;
    let given = run(&mut model, RunKind::InsertAs, &[16, 1, 2, 1, 3, off, 16, off, 2, off, 3, 8]);
    let expected = [
        part(0, Outcome::Full, 16),
        part(1, Outcome::InUse, 2),
        part(2, Outcome::OffGrid, 3),
        part(3, Outcome::Full, 16),
        part(4, Outcome::InUse, 2),
        part(5, Outcome::Duplicate, 1),
    ];
    assert_eq!(given, expected.concat());
    let given = run(&mut model, RunKind::Delete, &[3, u32::MAX, 0]);
    let expected = [part(0, Outcome::Missing, 3), part(1, Outcome::Missing, u32::MAX), part(2, Outcome::Flat, 0)];
    assert_eq!(given, expected.concat());
    let given = run(&mut model, RunKind::Move, &[3, off, 0, off << 16, 0, 1]);
    let expected = [part(0, Outcome::Missing, 3), part(1, Outcome::OffGrid, 0), part(2, Outcome::Flat, 0)];
    assert_eq!(given, expected.concat());
    for kind in [RunKind::Locate, RunKind::Interpolate, RunKind::Nearest] {
        let given = run(&mut model, kind, &[off]);
        assert_eq!(given[0], part_head(0, Outcome::OffGrid));
        assert!(given[1..].iter().all(|&word| word == 0));
    }
}

#[test]
fn a_run_out_of_place_is_taken_and_refused() {
    let layout = Layout::of(16, CAPACITY);
    let mut empty = model(16, &[[0, 0], [1, 1]]);
    for kind in RunKind::ALL {
        let items = vec![0; 3 * kind.item_words(layout)];
        assert_eq!(ask(&mut empty, &Command::run(kind, items, layout)), (Status::NoMesh as u8, vec![]));
    }
    assert_eq!(ask(&mut empty, &Command::insert(vec![2], layout)), (0, vec![3, 3, 0, 0, 4]));
    assert_eq!(run(&mut empty, RunKind::Locate, &[]), []);
    // In a batch there are several meshes.
    let mut batch = CommandModel::new(16, CAPACITY, 8).expect("possible").with_contexts(2).with_runs();
    let points = [0, 9, 9 << 16, 0, 9, 9 << 16].to_vec();
    let clear = incircle_protocol::Clear::batch(2);
    ask(&mut batch, &Command::Clear(clear));
    ask(&mut batch, &Command::insert(points, layout));
    assert_eq!(ask(&mut batch, &Command::run(RunKind::Delete, vec![0], layout)).0, Status::NoMesh as u8);
}

#[test]
fn an_answer_longer_than_any_is_refused() {
    let mut model = model(16, &SQUARE);
    // The items of such a run would never end; here some of them come.
    let run = Command::Run { kind: RunKind::Interpolate, count: u32::MAX / 2, items: vec![0; 5] };
    let mut words = Vec::new();
    run.encode(&mut words);
    model.send(&words);
    assert_eq!(model.receive(&mut [0; 8]), 0);
    assert!(!model.is_between_commands());
}

#[test]
fn a_device_without_runs_does_not_know_them() {
    let mut model = CommandModel::new(16, MAX_MODEL_POINTS, 8).expect("possible");
    let (status, payload) = ask(&mut model, &Command::Hello);
    assert_eq!((status, payload[6]), (0, 8));
    for kind in RunKind::ALL {
        model.send(&[(kind.opcode() as u32) << 24]);
        let mut answer = [0; 3];
        assert_eq!(model.receive(&mut answer), 2);
        assert_eq!(answer[..2], [(kind.opcode() as u32) << 24 | (Status::UnknownOpcode as u32) << 16, 0]);
    }
    let mut model = model.with_runs();
    assert_eq!(ask(&mut model, &Command::Hello).1[6], 1 << 16 | 8);
}
