//! The waves in the headers of the blocks that a visit passes are what Rust and Verilog show.

mod block_ports;
mod stepper;
mod structures;

use std::collections::BTreeMap;

use block_ports::NamedPorts;
use incircle_hdl::engine::{Cavity, Issue, VisitPipeline, VisitReader, WritePort};
use incircle_hdl::mesh::{TriangleStore, VertexStore};
use incircle_protocol::TINY;
use incircle_testbench::blocks;
use stepper::{named_ports, Cell, Stepper, Wave};
use structures::{pack, BUNDLE, TOKEN, TURNED, VERDICT, WRITE};
use verilated::Direction;

named_ports!(Issue, [reset, push, bundle, read, read_id], [token_valid, token, read_valid], clock);
named_ports!(WritePort, [reset, commit, solo, seed], [write], clock);
named_ports!(
    TriangleStore,
    [write, read_id, read_locks, clear_id, clear_enable],
    [v0, v1, v2, n0, n1, n2, was_set],
    clock
);
named_ports!(
    VertexStore,
    [write_id, write_position, write_enable, id0, id1, id2],
    [position0, position1, position2],
    clock
);
named_ports!(
    VisitReader,
    [infinite, token, v0, v1, v2, n0, n1, n2, was_set, position0, position1, position2],
    [turned, token_at_record, r0, r1, r2],
    clock
);
named_ports!(
    Cavity,
    [
        reset,
        ring,
        is_root,
        is_cavity,
        is_drain,
        root_visits,
        done,
        token,
        turned,
        verdict,
        entry_pointer,
        inner_pointer
    ],
    [split, split_bundle, overflows, nothing_is_out, count, inner_count, entry, inner_id],
    clock
);
named_ports!(
    VisitPipeline,
    [
        reset,
        infinite,
        push,
        bundle,
        p,
        read,
        read_id,
        write,
        vertex_id,
        vertex_position,
        vertex_enable,
        clear_id,
        clear_enable
    ],
    [done, token, turned, verdict, read_done, v0, v1, v2, n0, n1, n2, was_set],
    clock
);

/// When a lane shows something.
#[derive(Clone, Copy)]
enum When {
    Always,
    /// While bit 0 of this port is set.
    If(&'static str),
    /// In these clocks.
    At(&'static [usize]),
}

/// A line of a wave: its name, and where it comes from: port, lowest bit, width. One bit is drawn as a level.
type Lane = (&'static str, &'static str, u32, u32, When);

/// Values of inputs in some clocks; in all others they are zero.
type Stimuli = [(usize, &'static str, u128)];

/// Runs `clocks` clocks after one with `reset` and nothing else, and draws them.
fn draw<U: NamedPorts>(name: &'static str, rust: U, stimuli: &Stimuli, clocks: usize, lanes: &[Lane]) -> Wave {
    let ports = blocks::model(name).description().ports();
    let inputs: Vec<&'static str> =
        ports.filter(|port| port.direction == Direction::Input && port.name != "clock").map(|port| port.name).collect();
    let mut stepper = Stepper::new(name, rust, 1);
    let mut wave = Wave::default();
    for input in &inputs {
        stepper.set(input, u128::from(*input == "reset"));
    }
    stepper.settle();
    stepper.edge();
    for clock in 0..clocks {
        let mut driven: BTreeMap<_, _> = inputs.iter().map(|input| (*input, 0)).collect();
        let now = stimuli.iter().filter(|(at, ..)| *at == clock);
        driven.extend(now.map(|(_, input, value)| (*input, *value)));
        for (input, value) in &driven {
            stepper.set(input, *value);
        }
        stepper.settle();
        let value = |port: &str, low: u32, width: u32| {
            let mask = ((1 << width) - 1) << low;
            let driven = driven.get(port).map(|value| value & mask);
            driven.unwrap_or_else(|| stepper.get_masked(port, mask)) >> low
        };
        let cells: Vec<_> = lanes
            .iter()
            .map(|(name, port, low, width, when)| {
                let shows = match when {
                    When::Always => true,
                    When::If(flag) => value(flag, 0, 1) == 1,
                    When::At(clocks) => clocks.contains(&clock),
                };
                let cell = match (shows, width) {
                    (false, _) => Cell::Open,
                    (true, 1) => Cell::Bit(value(port, *low, 1) == 1),
                    (true, _) => Cell::Number(value(port, *low, *width)),
                };
                (*name, cell)
            })
            .collect();
        wave.take(&cells);
        stepper.edge();
    }
    wave
}

/// A bundle of these ring entries.
fn bundle(is_pair: u64, x: u64, second_x: u64) -> u128 {
    pack(BUNDLE, [is_pair, 1, 0, x, 0, 0, 0, 0, second_x, 0, 0])
}

#[test]
fn issue_shows_the_wave_of_its_header() {
    let stimuli = [
        (1, "push", 1),
        (1, "bundle", bundle(1, 1, 2)),
        (2, "push", 1),
        (2, "bundle", bundle(0, 3, 0)),
        (5, "read", 1),
        (5, "read_id", 9),
    ];
    let lanes = [
        ("push", "push", 0, 1, When::Always),
        ("bundle.x", "bundle", 3, 6, When::If("push")),
        ("token_valid", "token_valid", 0, 1, When::Always),
        ("token.x", "token", 2, 6, When::If("token_valid")),
        ("read", "read", 0, 1, When::Always),
        ("read_valid", "read_valid", 0, 1, When::Always),
        ("token.u", "token", 35, 15, When::If("read_valid")),
    ];
    draw("issue_3", Issue::new(3), &stimuli, 8, &lanes).assert_drawn_in(include_str!("../../hdl/src/engine/issue.rs"));
}

/// A write of a record with these columns; `columns` has a bit for the vertices and one for each link.
fn write(id: u64, columns: u64, v0: u64, n1: u64) -> u128 {
    let [vertices, link0, link1, link2] = [0, 1, 2, 3].map(|bit| columns >> bit & 1);
    pack(WRITE, [1, id, vertices, link0, link1, link2, v0, 0, 0, 0, n1, 0])
}

#[test]
fn write_port_shows_the_wave_of_its_header() {
    let stimuli =
        [(1, "commit", write(5, 15, 1, 1)), (2, "commit", write(6, 15, 1, 1)), (4, "solo", write(7, 15, 1, 1))];
    let lanes = [
        ("commit.valid", "commit", 0, 1, When::Always),
        ("commit.id", "commit", 1, 15, When::If("commit")),
        ("solo.valid", "solo", 0, 1, When::Always),
        ("solo.id", "solo", 1, 15, When::If("solo")),
        ("write.valid", "write", 0, 1, When::Always),
        ("write.id", "write", 1, 15, When::If("write")),
    ];
    draw("write_port", WritePort::default(), &stimuli, 7, &lanes)
        .assert_drawn_in(include_str!("../../hdl/src/engine/write_port.rs"));
}

#[test]
fn triangle_store_shows_the_wave_of_its_header() {
    const READS: [usize; 3] = [2, 3, 4];
    const ANSWERS: [usize; 3] = [4, 5, 6];
    let stimuli = [
        (0, "write", write(5, 15, 7, 8)),
        (1, "write", write(5, 4, 0, 9)),
        (2, "read_id", 5),
        (3, "read_id", 5),
        (3, "read_locks", 1),
        (4, "read_id", 5),
    ];
    let lanes = [
        ("write.valid", "write", 0, 1, When::Always),
        ("write.vertices", "write", 16, 1, When::Always),
        ("write.n1", "write", 80, 15, When::If("write")),
        ("read_id", "read_id", 0, 15, When::At(&READS)),
        ("read_locks", "read_locks", 0, 1, When::Always),
        ("v0", "v0", 0, 15, When::At(&ANSWERS)),
        ("n1", "n1", 0, 15, When::At(&ANSWERS)),
        ("was_set", "was_set", 0, 1, When::At(&ANSWERS)),
    ];
    let store = TriangleStore::new(15, 15);
    draw("triangle_store_15", store, &stimuli, 8, &lanes)
        .assert_drawn_in(include_str!("../../hdl/src/mesh/triangle_store.rs"));
}

#[test]
fn vertex_store_shows_the_wave_of_its_header() {
    let stimuli = [(0, "write_enable", 1), (0, "write_id", 3), (0, "write_position", 42), (1, "id0", 3)];
    let lanes = [
        ("write_enable", "write_enable", 0, 1, When::Always),
        ("write_id", "write_id", 0, 15, When::If("write_enable")),
        ("write_position", "write_position", 0, 32, When::If("write_enable")),
        ("id0", "id0", 0, 15, When::At(&[1])),
        ("position0", "position0", 0, 32, When::At(&[3])),
    ];
    draw("vertex_store_14", VertexStore::new(14), &stimuli, 5, &lanes)
        .assert_drawn_in(include_str!("../../hdl/src/mesh/vertex_store.rs"));
}

#[test]
fn visit_reader_shows_the_wave_of_its_header() {
    // Through link 1, so that vertex 1 comes first.
    let stimuli = [
        (0, "token", pack(TOKEN, [1, 0, 0, 0, 0, 30, 5])),
        (2, "v0", 11),
        (2, "v1", 12),
        (2, "n1", 30),
        (4, "position0", 51),
        (4, "position1", 52),
    ];
    let lanes = [
        ("token.f", "token", 20, 15, When::At(&[0])),
        ("n1", "n1", 0, 15, When::At(&[2])),
        ("v0", "v0", 0, 15, When::At(&[2])),
        ("v1", "v1", 0, 15, When::At(&[2])),
        ("turned.v0", "turned", 0, 15, When::At(&[4])),
        ("turned.slot", "turned", 90, 2, When::At(&[4])),
        ("position0", "position0", 0, 32, When::At(&[4])),
        ("position1", "position1", 0, 32, When::At(&[4])),
        ("r0", "r0", 0, 32, When::At(&[5])),
    ];
    let reader = VisitReader::default();
    draw("visit_reader", reader, &stimuli, 7, &lanes)
        .assert_drawn_in(include_str!("../../hdl/src/engine/visit_reader.rs"));
}

#[test]
fn cavity_shows_the_wave_of_its_header() {
    let mut stimuli: Vec<(usize, &'static str, u128)> = vec![];
    for clock in 0..20 {
        stimuli.push((clock, "ring", 6));
        stimuli.push((clock, "is_root", u128::from((1..4).contains(&clock))));
        stimuli.push((clock, "is_cavity", u128::from(clock > 3)));
    }
    stimuli.extend([(1, "root_visits", 1), (2, "root_visits", 2), (3, "root_visits", 1)]);
    // The root's lock, then the three tests and the two that the first of them asks for.
    let visits = [(4, 0, 0, 0), (5, 1, 0, 1), (7, 1, 1, 0), (8, 1, 2, 0), (10, 1, 0, 0), (11, 1, 3, 0)];
    for (clock, rotates, x, conflict) in visits {
        stimuli.push((clock, "done", 1));
        stimuli.push((clock, "token", pack(TOKEN, [rotates, 0, x, 0, 0, 0, 0])));
        stimuli.push((clock, "verdict", pack(VERDICT, [conflict, 0, 0, 0, 0, 0])));
        stimuli.push((clock, "turned", pack(TURNED, [0; 11])));
    }
    let lanes = [
        ("is_root", "is_root", 0, 1, When::Always),
        ("root_visits", "root_visits", 0, 2, When::If("is_root")),
        ("is_cavity", "is_cavity", 0, 1, When::Always),
        ("done", "done", 0, 1, When::Always),
        ("token.rotates", "token", 0, 1, When::If("done")),
        ("token.x", "token", 2, 6, When::If("done")),
        ("conflict", "verdict", 0, 1, When::If("done")),
        ("split", "split", 0, 1, When::Always),
        ("count", "count", 0, 7, When::If("is_cavity")),
        ("nothing_is_out", "nothing_is_out", 0, 1, When::Always),
    ];
    draw("cavity_6", Cavity::new(TINY), &stimuli, 14, &lanes)
        .assert_drawn_in(include_str!("../../hdl/src/engine/cavity.rs"));
}

#[test]
fn visit_pipeline_shows_the_wave_of_its_header() {
    let stimuli = [(0, "push", 1), (0, "bundle", bundle(1, 1, 2)), (18, "read", 1)];
    let lanes = [
        ("push", "push", 0, 1, When::Always),
        ("bundle.x", "bundle", 3, 6, When::If("push")),
        ("done", "done", 0, 1, When::Always),
        ("token.x", "token", 2, 6, When::If("done")),
        ("read", "read", 0, 1, When::Always),
        ("read_done", "read_done", 0, 1, When::Always),
    ];
    let pipeline = VisitPipeline::new(TINY);
    draw("visit_pipeline_tiny", pipeline, &stimuli, 23, &lanes)
        .assert_drawn_in(include_str!("../../hdl/src/engine/visit_pipeline.rs"));
}
