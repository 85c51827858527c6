//! The waves in the headers of the blocks that a visit passes are what Rust and Verilog show.

use std::collections::BTreeMap;

use crate::rig::block_ports::NamedPorts;
use crate::rig::stepper::{Cell, Stepper, Wave};
use crate::rig::structures::{pack, BUNDLE, TOKEN, TURNED, WRITE};
use incircle_hdl::engine::{Issue, VisitJudge, VisitPipeline, VisitReader, WritePort};
use incircle_hdl::mesh::{LockStore, TriangleStore, VertexStore};
use incircle_protocol::TINY;
use incircle_testbench::blocks;
use verilated::Direction;

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

/// A bundle of context 1 from these ring entries.
fn bundle(entries: &[u64]) -> u128 {
    let [is_pair, is_triple] = [2, 3].map(|visits| u64::from(entries.len() >= visits));
    let [x, x2, x3] = [0, 1, 2].map(|place| entries.get(place).copied().unwrap_or(0));
    pack(BUNDLE, [is_pair, is_triple, 1, 1, 0, x, x2, 0, 0, 0, x3, 0, 0])
}

#[test]
fn issue_shows_the_wave_of_its_header() {
    let stimuli = [
        (1, "push", 1),
        (1, "bundle", bundle(&[1, 2, 3])),
        (2, "push", 1),
        (2, "bundle", bundle(&[4])),
        (6, "read", 1),
        (6, "read_id", 9),
    ];
    let lanes = [
        ("push", "push", 0, 1, When::Always),
        ("bundle.x", "bundle", 9, 6, When::If("push")),
        ("token_valid", "token_valid", 0, 1, When::Always),
        ("token.x", "token", 7, 6, When::If("token_valid")),
        ("read", "read", 0, 1, When::Always),
        ("read_valid", "read_valid", 0, 1, When::Always),
        ("token.u", "token", 40, 15, When::If("read_valid")),
    ];
    draw("issue_5", Issue::new(5), &stimuli, 9, &lanes).assert_drawn_in("issue");
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
        ("enables.link1", "enables", 2, 1, When::Always),
    ];
    draw("write_port", WritePort::default(), &stimuli, 7, &lanes).assert_drawn_in("write_port");
}

#[test]
fn lock_store_shows_the_wave_of_its_header() {
    const VISITS: [usize; 5] = [0, 1, 2, 4, 5];
    const KNOWN: [usize; 8] = [1, 2, 3, 4, 5, 6, 7, 8];
    let mut stimuli = vec![(4, "clear_id", 5), (4, "clear_enable", 1)];
    for (clock, owner) in VISITS.into_iter().zip([3, 4, 3, 4, 4]) {
        stimuli.extend([(clock, "id", 5), (clock, "owner", owner), (clock, "takes", 1)]);
    }
    let lanes = [
        ("id", "id", 0, 15, When::At(&VISITS)),
        ("owner", "owner", 0, 5, When::At(&VISITS)),
        ("takes", "takes", 0, 1, When::Always),
        ("clear_enable", "clear_enable", 0, 1, When::Always),
        ("took", "took", 0, 1, When::At(&KNOWN)),
        ("foreign", "foreign", 0, 1, When::At(&KNOWN)),
    ];
    draw("lock_store_15_5", LockStore::new(15, 5), &stimuli, 9, &lanes).assert_drawn_in("lock_store");
}

#[test]
fn triangle_store_shows_the_wave_of_its_header() {
    const READS: [usize; 3] = [2, 3, 4];
    const ANSWERS: [usize; 3] = [4, 5, 6];
    const KNOWN: [usize; 7] = [1, 2, 3, 4, 5, 6, 7];
    let stimuli = [
        (0, "write", write(5, 15, 7, 8)),
        (0, "enables", 15 | 5 << 4 | 5 << 19),
        (1, "write", write(5, 4, 0, 9)),
        (1, "enables", 4 | 5 << 4 | 5 << 19),
        (3, "read_locks", 1),
    ];
    let ids = ["read_id", "vertices_id", "links_id"];
    let reads = READS.iter().flat_map(|clock| ids.map(|port| (*clock, port, 5)));
    let stimuli: Vec<_> = stimuli.into_iter().chain(reads).collect();
    let lanes = [
        ("vertex columns", "enables", 0, 1, When::Always),
        ("link column 1", "enables", 2, 1, When::Always),
        ("write.n1", "write", 80, 15, When::If("write")),
        ("read_id", "read_id", 0, 15, When::At(&READS)),
        ("read_locks", "read_locks", 0, 1, When::Always),
        ("v0", "v0", 0, 15, When::At(&ANSWERS)),
        ("n1", "n1", 0, 15, When::At(&ANSWERS)),
        ("took", "took", 0, 1, When::At(&KNOWN)),
        ("was_set", "was_set", 0, 1, When::At(&ANSWERS)),
    ];
    let store = TriangleStore::new(15, 15, 5);
    draw("triangle_store_15_15_5", store, &stimuli, 8, &lanes).assert_drawn_in("triangle_store");
}

#[test]
fn vertex_store_shows_the_wave_of_its_header() {
    let stimuli =
        [(0, "write_enable", 1), (0, "write_id", 3), (0, "write_position", 42), (1, "id0", 3), (2, "fetch_id", 3)];
    let lanes = [
        ("write_enable", "write_enable", 0, 1, When::Always),
        ("write_id", "write_id", 0, 15, When::If("write_enable")),
        ("write_position", "write_position", 0, 32, When::If("write_enable")),
        ("id0", "id0", 0, 15, When::At(&[1])),
        ("fetch_id", "fetch_id", 0, 15, When::At(&[2])),
        ("position0", "position0", 0, 32, When::At(&[3])),
        ("fetched", "fetched", 0, 32, When::At(&[4])),
    ];
    draw("vertex_store_14", VertexStore::new(14), &stimuli, 5, &lanes).assert_drawn_in("vertex_store");
}

#[test]
fn visit_reader_shows_the_wave_of_its_header() {
    // Through link 1, so that vertex 1 comes first.
    let stimuli = [
        (0, "token", pack(TOKEN, [0, 1, 0, 0, 0, 0, 30, 5])),
        (2, "v0", 11),
        (2, "v1", 12),
        (2, "n1", 30),
        (2, "again", 1),
        (3, "took", 1),
        (4, "position0", 51),
    ];
    let lanes = [
        ("token.f", "token", 25, 15, When::At(&[0])),
        ("n1", "n1", 0, 15, When::At(&[2])),
        ("v0", "v0", 0, 15, When::At(&[2])),
        ("v1", "v1", 0, 15, When::At(&[2])),
        ("again", "again", 0, 1, When::Always),
        ("took", "took", 0, 1, When::Always),
        ("turned.v0", "turned", 0, 15, When::At(&[5])),
        ("turned.slot", "turned", 90, 2, When::At(&[5])),
        ("turned.again", "turned", 94, 1, When::At(&[5])),
        ("turned.took", "turned", 92, 1, When::At(&[5])),
        ("position0", "position0", 0, 32, When::At(&[4])),
        ("r0", "r0", 0, 32, When::At(&[5])),
    ];
    let reader = VisitReader::default();
    draw("visit_reader", reader, &stimuli, 7, &lanes).assert_drawn_in("visit_reader");
}

#[test]
fn visit_judge_shows_the_wave_of_its_header() {
    let mut turned = [0; 13];
    turned[3] = 9;
    let stimuli = [(0, "r0", 2), (0, "r1", 6), (0, "r2", 4), (0, "p", 6), (10, "turned", pack(TURNED, turned))];
    let lanes = [
        ("r0", "r0", 0, 32, When::At(&[0])),
        ("r1", "r1", 0, 32, When::At(&[0])),
        ("r2", "r2", 0, 32, When::At(&[0])),
        ("p", "p", 0, 32, When::At(&[0])),
        ("turned.n0", "turned", 45, 15, When::At(&[10])),
        ("walk_next", "verdict", 5, 15, When::At(&[10])),
        ("corner", "verdict", 2, 1, When::At(&[10])),
    ];
    draw("visit_judge", VisitJudge::default(), &stimuli, 12, &lanes).assert_drawn_in("visit_judge");
}

#[test]
fn visit_pipeline_shows_the_wave_of_its_header() {
    let stimuli = [(0, "push", 1), (0, "bundle", bundle(&[1, 2])), (19, "read", 1)];
    let lanes = [
        ("push", "push", 0, 1, When::Always),
        ("bundle.owner", "bundle", 2, 5, When::If("push")),
        ("bundle.x", "bundle", 9, 6, When::If("push")),
        ("is_issuing", "is_issuing", 0, 1, When::Always),
        ("done", "done", 0, 1, When::Always),
        ("token.owner", "token", 0, 5, When::If("done")),
        ("token.x", "token", 7, 6, When::If("done")),
        ("read", "read", 0, 1, When::Always),
        ("read_done", "read_done", 0, 1, When::Always),
    ];
    let pipeline = VisitPipeline::new(TINY);
    draw("visit_pipeline_tiny", pipeline, &stimuli, 24, &lanes).assert_drawn_in("visit_pipeline");
}
