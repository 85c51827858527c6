//! The memories of the mesh and the blocks that write into them: Rust behaviour, Verilog and plain arrays agree clock by clock.

mod block_ports;
mod cosimulation;
mod structures;

use cosimulation::{named_ports, Cosimulation, Delay, Expected, NamedPorts, Numbers};
use incircle_hdl::engine::{LinkWrite, RecordWrite, SeedWrites, WritePort};
use incircle_hdl::mesh::{TriangleStore, VertexStore};
use structures::{pack, random, unpack, WRITE};

named_ports!([] TriangleStore, [write, read_id, read_locks, clear_id, clear_enable],
    [v0, v1, v2, n0, n1, n2, was_set], clock);
named_ports!([] VertexStore, [write_id, write_position, write_enable, id0, id1, id2],
    [position0, position1, position2], clock);
named_ports!([] SeedWrites, [step, turns_left, infinite], [write]);
named_ports!([] WritePort, [reset, commit, solo, seed], [write], clock);
named_ports!([] RecordWrite, [id, v0, v1, v2, n0, n1, n2], [write]);
named_ports!([] LinkWrite, [id, slot, value], [write]);

const CYCLES: usize = 6_000;
const ID: u32 = 15;
const LAST_ID: u64 = (1 << ID) - 1;

/// Ids that meet often in their low bits, with anything above them.
fn id(numbers: &mut Numbers, stored_bits: u32) -> u64 {
    let near = [0, LAST_ID - 3][numbers.bits(1) as usize] ^ numbers.bits(2);
    if stored_bits == ID {
        near
    } else {
        near & ((1 << stored_bits) - 1) | numbers.bits(ID) >> stored_bits << stored_bits
    }
}

/// Reads, writes and locks in any mixture; only setting and clearing one lock at one edge is left out, which has no meaning.
fn triangle_stimuli(stored_bits: u32) -> Vec<Vec<u128>> {
    let mut numbers = Numbers::new(21);
    let same = |a: u64, b: u64| (a ^ b) & ((1 << stored_bits) - 1) == 0;
    (0..CYCLES)
        .map(|_| {
            let mut write = random(WRITE, |bits| numbers.bits(bits));
            write[1] = id(&mut numbers, stored_bits);
            let (read, clear) = (id(&mut numbers, stored_bits), id(&mut numbers, stored_bits));
            let (locks, clears) = (numbers.bits(1), numbers.bits(1));
            let locks = if same(read, clear) { locks & !clears } else { locks };
            let numbers = [read, locks, clear, clears].map(u128::from);
            [&[pack(WRITE, write)], &numbers[..]].concat()
        })
        .collect()
}

/// Columns and lock of the record read; nothing where the same edge changes it.
fn triangle_reference(id_bits: u32, vertex_bits: u32) -> impl FnMut(&[u128]) -> Vec<Expected> {
    let last = (1 << id_bits) - 1;
    let mut columns = vec![[None; 6]; last + 1];
    let mut locks = vec![false; last + 1];
    move |values| {
        let write = unpack(WRITE, values[0]);
        let [read, written, cleared] = [values[1], write[1].into(), values[3]].map(|id| id as usize & last);
        let mut seen = columns[read];
        let mut was_set = Some(u128::from(locks[read]));
        for column in 0..6 {
            let enable = write[[2, 2, 2, 3, 4, 5][column]] & write[0];
            if enable == 1 {
                let bits = if column < 3 { vertex_bits } else { id_bits };
                columns[written][column] = Some(u128::from(write[6 + column]) & ((1 << bits) - 1));
                if written == read {
                    seen[column] = None;
                }
            }
        }
        locks[read] |= values[2] == 1;
        if values[4] == 1 {
            locks[cleared] = false;
            if cleared == read {
                was_set = None;
            }
        }
        [&seen[..], &[was_set]].concat()
    }
}

fn triangle_store(name: &str, id_bits: u32, vertex_bits: u32) {
    let mut reference = triangle_reference(id_bits, vertex_bits);
    let mut delay = Delay::new(TriangleStore::LATENCY);
    Cosimulation {
        name,
        rust: TriangleStore::new(id_bits as usize, vertex_bits as usize),
        inputs: &["write", "read_id", "read_locks", "clear_id", "clear_enable"],
        outputs: &["v0", "v1", "v2", "n0", "n1", "n2", "was_set"],
    }
    .run(triangle_stimuli(id_bits), |values| delay.pass(reference(values)).unwrap_or(vec![None; 7]));
}

#[test]
fn triangle_store_writes_records_and_single_links() {
    triangle_store("triangle_store_15", 15, 15);
}

#[test]
fn triangle_store_ignores_what_is_above_its_shape() {
    triangle_store("triangle_store_5_4", 5, 4);
}

fn vertex_store(name: &str, id_bits: u32) {
    let mut numbers = Numbers::new(22);
    let stimuli: Vec<Vec<u64>> = (0..CYCLES)
        .map(|_| {
            let mut ids = [(); 4].map(|()| id(&mut numbers, id_bits));
            ids[1..].rotate_left(1);
            let (position, enable) = (numbers.bits(32), numbers.bits(1));
            vec![ids[0], position, enable, ids[1], ids[2], ids[3]]
        })
        .collect();
    let last = (1 << id_bits) - 1;
    let mut positions: Vec<Expected> = vec![None; last + 1];
    let mut delay = Delay::new(VertexStore::LATENCY);
    Cosimulation {
        name,
        rust: VertexStore::new(id_bits as usize),
        inputs: &["write_id", "write_position", "write_enable", "id0", "id1", "id2"],
        outputs: &["position0", "position1", "position2"],
    }
    .run(stimuli, |values| {
        let written = (values[2] == 1).then_some(values[0] as usize & last);
        let seen = [3, 4, 5].map(|port| {
            let read = values[port] as usize & last;
            positions[read].filter(|_| written != Some(read))
        });
        if let Some(written) = written {
            positions[written] = Some(values[1].into());
        }
        delay.pass(seen.to_vec()).unwrap_or(vec![None; 3])
    });
}

#[test]
fn vertex_store_reads_three_vertices_at_once() {
    vertex_store("vertex_store_14", 14);
}

#[test]
fn vertex_store_ignores_what_is_above_its_shape() {
    vertex_store("vertex_store_3", 3);
}

#[test]
fn seed_writes_are_the_first_triangle_and_its_ghosts() {
    let mut stimuli = vec![];
    for step in 0..8 {
        for turns_left in [0, 1] {
            stimuli.extend([15, 2047, LAST_ID].map(|infinite| vec![step, turns_left, infinite]));
        }
    }
    Cosimulation {
        name: "seed_writes",
        rust: SeedWrites::default(),
        inputs: &["step", "turns_left", "infinite"],
        outputs: &["write"],
    }
    .run(stimuli, |values| {
        let infinite = values[2];
        let (b, c) = if values[1] == 1 { (1, 2) } else { (2, 1) };
        let (id, v, n) = match values[0] {
            0 => (0, [0, 1, 2], [0, 0, 0]),
            1 => (0, [0, b, c], [1, 2, 3]),
            2 => (1, [c, b, infinite], [3, 2, 0]),
            3 => (2, [0, c, infinite], [1, 3, 0]),
            _ => (3, [b, 0, infinite], [2, 1, 0]),
        };
        let write = [1, id, 1, 1, 1, 1, v[0], v[1], v[2], n[0], n[1], n[2]];
        vec![Some(pack(WRITE, write))]
    });
}

#[test]
fn write_port_takes_the_request_there_is() {
    let mut numbers = Numbers::new(23);
    let stimuli: Vec<Vec<u128>> = (0..CYCLES)
        .map(|cycle| {
            let mut requests = [(); 3].map(|()| random(WRITE, |bits| numbers.bits(bits)));
            let valid = numbers.next() % 5;
            for (writer, request) in requests.iter_mut().enumerate() {
                request[0] = u64::from(writer as u64 == valid);
            }
            let reset = cycle == 0 || numbers.once_in(20);
            let requests = requests.map(|request| pack(WRITE, request));
            [&[u128::from(reset)], &requests[..]].concat()
        })
        .collect();
    let mut port: Expected = None;
    Cosimulation {
        name: "write_port",
        rust: WritePort::default(),
        inputs: &["reset", "commit", "solo", "seed"],
        outputs: &["write"],
    }
    .run(stimuli, |values| {
        let seen = port;
        let request = values[1..].iter().find(|request| **request & 1 == 1);
        port = if values[0] == 1 {
            Some(0)
        } else {
            // Without a request the data stay and the write is over.
            request.copied().or(port.map(|write| write & !1))
        };
        vec![seen]
    });
}

fn write_form<U: NamedPorts>(
    name: &str,
    rust: U,
    inputs: &[&str],
    widths: &[u32],
    write: impl Fn(&[u64]) -> [u64; 12],
) {
    let mut numbers = Numbers::new(24);
    let stimuli: Vec<Vec<u64>> =
        (0..CYCLES).map(|_| widths.iter().map(|width| numbers.bits(*width)).collect()).collect();
    Cosimulation { name, rust, inputs, outputs: &["write"] }
        .run(stimuli, |values| vec![Some(pack(WRITE, write(values)))]);
}

#[test]
fn record_write_writes_all_columns() {
    let inputs = ["id", "v0", "v1", "v2", "n0", "n1", "n2"];
    let rust = RecordWrite::default();
    write_form("record_write", rust, &inputs, &[ID; 7], |values| {
        let mut write = [1; 12];
        write[1] = values[0];
        write[6..].copy_from_slice(&values[1..]);
        write
    });
}

#[test]
fn link_write_writes_one_column() {
    let inputs = ["id", "slot", "value"];
    let rust = LinkWrite::default();
    write_form("link_write", rust, &inputs, &[ID, 2, ID], |values| {
        let [id, slot, value] = [values[0], values[1], values[2]];
        let [link0, link1, link2] = [0, 1, 2].map(|column| u64::from(column == slot));
        [1, id, 0, link0, link1, link2, 0, 0, 0, value, value, value]
    });
}
