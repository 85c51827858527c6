//! The memories of the mesh and the blocks that write into them: Rust behaviour, Verilog and plain arrays agree clock by clock.

use crate::rig::cosimulation::{named_ports, Cosimulation, Delay, Expected, NamedPorts, Numbers};
use crate::rig::structures::{pack, random, unpack, WRITE};
use crate::rig::visit_model::Locks;
use incircle_hdl::engine::{LinkWrite, RecordWrite, SeedWrites, WritePort};
use incircle_hdl::leaf::SharedMemory;
use incircle_hdl::mesh::{LockStore, TriangleStore, VertexStore};
use incircle_testbench::gate::{cell_count, Cells};
use rust_hdl_core::prelude::*;

named_ports!([const A: usize, const D: usize] SharedMemory<A, D>,
    [read_address, shared_address, write_data, write_enable], [read_data, shared_data], clock);
named_ports!([] LockStore, [id, owner, takes, clear_id, clear_enable], [took, foreign, was_set], clock);
named_ports!([] TriangleStore, [write, enables, read_id, vertices_id, links_id, read_locks, owner, clear_id, clear_enable],
    [v0, v1, v2, n0, n1, n2, took, foreign, was_set], clock);
named_ports!([] VertexStore, [write_id, write_position, write_enable, id0, id1, id2, fetch_id],
    [position0, position1, position2, fetched], clock);
named_ports!([] SeedWrites, [step, turns_left, infinite, first_vertex, first_record], [write]);
named_ports!([] WritePort, [reset, commit, solo, seed], [write, enables], clock);
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

/// What the exported block of this name takes in an ECP5.
fn cells(name: &str) -> Cells {
    let blocks = incircle_hdl::export::blocks();
    let (_, verilog) = blocks.iter().find(|block| block.0 == name).expect("a block of this name");
    cell_count(verilog, name).unwrap_or_else(|error| panic!("{error}"))
}

fn shared_memory<const A: usize, const D: usize>(name: &str, address_bits: usize, stored_bits: usize) {
    let mut numbers = Numbers::new(25);
    let stimuli: Vec<Vec<u64>> = (0..CYCLES)
        .map(|_| {
            let [read, shared] = [(); 2].map(|()| numbers.bits(A as u32));
            vec![read, shared, numbers.bits(D as u32), numbers.bits(1)]
        })
        .collect();
    let last = (1 << address_bits) - 1;
    // As neutral Verilog, and with the primitives of the ECP5.
    for name in [name.to_string(), format!("{name}_ecp5")] {
        let mut words: Vec<Expected> = vec![None; last + 1];
        let mut delay = Delay::new(SharedMemory::<A, D>::LATENCY);
        Cosimulation {
            name: &name,
            rust: SharedMemory::<A, D>::new(address_bits, stored_bits),
            inputs: &["read_address", "shared_address", "write_data", "write_enable"],
            outputs: &["read_data", "shared_data"],
        }
        .run(stimuli.clone(), |values| {
            let [read, shared] = [values[0], values[1]].map(|address| address as usize & last);
            let mut seen = vec![words[read], words[shared]];
            if values[3] == 1 {
                seen[1] = None;
                if read == shared {
                    seen[0] = None;
                }
                words[shared] = Some(u128::from(values[2]) & ((1 << stored_bits) - 1));
            }
            delay.pass(seen).unwrap_or(vec![None; 2])
        });
    }
}

#[test]
fn shared_memory_reads_twice_or_reads_and_writes() {
    shared_memory::<8, 12>("shared_memory_8x12", 8, 12);
}

#[test]
fn shared_memory_ignores_what_is_above_its_shape() {
    shared_memory::<10, 36>("shared_memory_6x33", 6, 33);
}

#[test]
fn shared_memory_poisons_what_silicon_leaves_open() {
    let mut memory = SharedMemory::<8, 12>::new(8, 12);
    memory.connect_all();
    for (enable, expected) in [(1, None), (0, None), (0, Some(0x555)), (0, Some(0xfff))] {
        if let Some(word) = expected {
            assert_eq!((memory.get("read_data"), memory.get("shared_data")), (word, word));
        }
        for (port, value) in
            [("read_address", 7), ("shared_address", 7), ("write_data", 0xfff), ("write_enable", enable)]
        {
            memory.set(port, value as u64);
        }
        for high in [false, true] {
            memory.set_clock(high);
            assert!(simulate(&mut memory, 10), "the memory settles");
        }
    }
}

#[test]
fn shared_memory_is_block_ram_without_bypass_logic() {
    let cells = cells("shared_memory_8x12");
    assert_eq!((cells.block_ram, cells.lut4, cells.flip_flops), (1, 0, 2 * 12));
}

/// What happened at the locks, so that a test can say that it all did.
#[derive(Debug, Default)]
struct LockEvents {
    took: usize,
    foreign: usize,
    own: usize,
    met_clear: usize,
    /// The holder took the lock one clock before the visit, two, or three.
    before: [usize; 3],
}

/// Locks as a list of holders: what a visit finds, and then the clear of the same edge.
struct LockReference {
    locks: Locks,
    last: usize,
    last_context: u64,
    /// The locks that the three visits before took, the latest first.
    taken: [Option<usize>; 3],
    events: LockEvents,
}

impl LockReference {
    fn new(id_bits: u32, context_bits: u32) -> Self {
        let last = (1 << id_bits) - 1;
        let last_context = (1 << context_bits) - 1;
        Self { locks: Locks::new(last + 1), last, last_context, taken: [None; 3], events: LockEvents::default() }
    }

    /// took, foreign, `was_set`.
    fn edge(&mut self, id: u64, owner: u64, takes: bool, clear: Option<u64>) -> [Expected; 3] {
        let id = id as usize & self.last;
        let owner = owner & self.last_context;
        let cleared = clear.map(|id| id as usize & self.last);
        let meets = cleared == Some(id);
        let was_set = self.locks.holder(id).is_some();
        let (took, foreign) = if takes { self.locks.take(id, owner, meets) } else { (false, false) };
        if let Some(cleared) = cleared {
            self.locks.clear(cleared);
        }
        let events = &mut self.events;
        events.took += usize::from(took);
        events.foreign += usize::from(foreign && !meets);
        events.own += usize::from(takes && !took && !foreign);
        events.met_clear += usize::from(takes && meets);
        let finds = takes && was_set && !meets;
        for (count, taken) in events.before.iter_mut().zip(self.taken) {
            *count += usize::from(finds && taken == Some(id));
        }
        self.taken = [took.then_some(id), self.taken[0], self.taken[1]];
        let was_set = (!meets).then_some(was_set.into());
        [Some(took.into()), Some(foreign.into()), was_set]
    }

    fn assert_all_happened(&self) {
        let LockEvents { took, foreign, own, met_clear, before } = self.events;
        let counts = [took, foreign, own, met_clear];
        assert!(counts.iter().chain(&before).all(|count| *count > CYCLES / 100), "{:?}", self.events);
    }
}

/// What a visit finds: the lock as it was, and a clock later what became of it.
struct LockDelay {
    was_set: Delay<Expected>,
    became: Delay<[Expected; 2]>,
}

impl Default for LockDelay {
    fn default() -> Self {
        Self { was_set: Delay::new(LockStore::READ_LATENCY), became: Delay::new(LockStore::LATENCY) }
    }
}

impl LockDelay {
    /// took, foreign, `was_set`.
    fn pass(&mut self, [took, foreign, was_set]: [Expected; 3]) -> [Expected; 3] {
        let [took, foreign] = self.became.pass([took, foreign]).unwrap_or([None; 2]);
        [took, foreign, self.was_set.pass(was_set).flatten()]
    }
}

fn lock_store(name: &str, id_bits: u32, context_bits: u32) {
    let mut numbers = Numbers::new(26);
    let stimuli: Vec<Vec<u64>> = (0..CYCLES)
        .map(|cycle| {
            // In turn: visits at every clock, with gaps, with clears at every clock.
            let (gaps, clears) = [(9, 3), (2, 3), (9, 1)][cycle / 100 % 3];
            let owner = (2 * numbers.bits(1)) | (numbers.bits(5) >> context_bits << context_bits);
            let takes = u64::from(!numbers.once_in(gaps));
            let clears = u64::from(numbers.once_in(clears));
            vec![id(&mut numbers, id_bits), owner, takes, id(&mut numbers, id_bits), clears]
        })
        .collect();
    let mut reference = LockReference::new(id_bits, context_bits);
    let mut delay = LockDelay::default();
    Cosimulation {
        name,
        rust: LockStore::new(id_bits as usize, context_bits as usize),
        inputs: &["id", "owner", "takes", "clear_id", "clear_enable"],
        outputs: &["took", "foreign", "was_set"],
    }
    .run(stimuli, |values| {
        let found = reference.edge(values[0], values[1], values[2] == 1, (values[4] == 1).then_some(values[3]));
        delay.pass(found).to_vec()
    });
    reference.assert_all_happened();
}

#[test]
fn lock_store_knows_the_holder_at_every_clock() {
    lock_store("lock_store_15_5", 15, 5);
}

#[test]
fn lock_store_ignores_what_is_above_its_shape() {
    lock_store("lock_store_4_2", 4, 2);
}

/// Reads, writes and locks in any mixture.
fn triangle_stimuli(stored_bits: u32) -> Vec<Vec<u128>> {
    let mut numbers = Numbers::new(21);
    (0..CYCLES)
        .map(|_| {
            let mut write = random(WRITE, |bits| numbers.bits(bits));
            write[1] = id(&mut numbers, stored_bits);
            let (read, clear) = (id(&mut numbers, stored_bits), id(&mut numbers, stored_bits));
            // Only the enables say what is written.
            let enables = (numbers.bits(1) * numbers.bits(4)) | (write[1] << 4) | (write[1] << 19);
            let numbers =
                [enables, read, read, read, numbers.bits(1), numbers.bits(5), clear, numbers.bits(1)].map(u128::from);
            [&[pack(WRITE, write)], &numbers[..]].concat()
        })
        .collect()
}

/// Columns and lock of the record read; nothing where the same edge changes it.
fn triangle_reference(
    id_bits: u32,
    vertex_bits: u32,
    mut locks: LockReference,
) -> impl FnMut(&[u128]) -> Vec<Expected> {
    let last = (1 << id_bits) - 1;
    let mut columns = vec![[None; 6]; last + 1];
    let (mut column_delay, mut lock_delay) = (Delay::new(TriangleStore::LATENCY), LockDelay::default());
    move |values| {
        let write = unpack(WRITE, values[0]);
        let [read, written] = [values[2], write[1].into()].map(|id| id as usize & last);
        let mut seen = columns[read];
        for column in 0..6 {
            if values[1] >> [0, 0, 0, 1, 2, 3][column] & 1 == 1 {
                let bits = if column < 3 { vertex_bits } else { id_bits };
                columns[written][column] = Some(u128::from(write[6 + column]) & ((1 << bits) - 1));
                if written == read {
                    seen[column] = None;
                }
            }
        }
        let [id, takes, owner, cleared, clears] = [2, 5, 6, 7, 8].map(|input| values[input] as u64);
        let lock = locks.edge(id, owner, takes == 1, (clears == 1).then_some(cleared));
        let seen = column_delay.pass(seen).unwrap_or([None; 6]);
        [&seen[..], &lock_delay.pass(lock)].concat()
    }
}

fn triangle_store(name: &str, id_bits: u32, vertex_bits: u32, context_bits: u32) {
    let locks = LockReference::new(id_bits, context_bits);
    let mut reference = triangle_reference(id_bits, vertex_bits, locks);
    Cosimulation {
        name,
        rust: TriangleStore::new(id_bits as usize, vertex_bits as usize, context_bits as usize),
        inputs: &[
            "write",
            "enables",
            "read_id",
            "vertices_id",
            "links_id",
            "read_locks",
            "owner",
            "clear_id",
            "clear_enable",
        ],
        outputs: &["v0", "v1", "v2", "n0", "n1", "n2", "took", "foreign", "was_set"],
    }
    .run(triangle_stimuli(id_bits), |values| reference(values));
}

#[test]
fn triangle_store_writes_records_and_single_links() {
    triangle_store("triangle_store_15_15_5", 15, 15, 5);
}

#[test]
fn triangle_store_ignores_what_is_above_its_shape() {
    triangle_store("triangle_store_5_4_1", 5, 4, 1);
}

fn vertex_store(name: &str, id_bits: u32) {
    let mut numbers = Numbers::new(22);
    let stimuli: Vec<Vec<u64>> = (0..CYCLES)
        .map(|_| {
            let ids = [(); 5].map(|()| id(&mut numbers, id_bits));
            let (position, enable) = (numbers.bits(32), numbers.bits(1));
            vec![ids[0], position, enable, ids[1], ids[2], ids[3], ids[4]]
        })
        .collect();
    let last = (1 << id_bits) - 1;
    let mut positions: Vec<Expected> = vec![None; last + 1];
    let mut delay = Delay::new(VertexStore::LATENCY);
    Cosimulation {
        name,
        rust: VertexStore::new(id_bits as usize),
        inputs: &["write_id", "write_position", "write_enable", "id0", "id1", "id2", "fetch_id"],
        outputs: &["position0", "position1", "position2", "fetched"],
    }
    .run(stimuli, |values| {
        let written = (values[2] == 1).then_some(values[0] as usize & last);
        let mut seen = [3, 4, 5, 6].map(|port| {
            let read = values[port] as usize & last;
            positions[read].filter(|_| written != Some(read))
        });
        if let Some(written) = written {
            positions[written] = Some(values[1].into());
            seen[3] = None;
        }
        delay.pass(seen.to_vec()).unwrap_or(vec![None; 4])
    });
}

#[test]
fn vertex_store_reads_three_vertices_and_fetches_a_fourth() {
    vertex_store("vertex_store_14", 14);
}

#[test]
fn vertex_store_ignores_what_is_above_its_shape() {
    vertex_store("vertex_store_3", 3);
}

#[test]
fn vertex_store_is_three_copies_in_block_ram() {
    // 16384 words of 32 bits: 32 blocks of 16384 x 1 for each copy, with the fetch port as without.
    assert_eq!(cells("vertex_store_14").block_ram, 3 * 32);
}

#[test]
fn seed_writes_are_the_first_triangle_and_its_ghosts() {
    let mut stimuli = vec![];
    for step in 0..8 {
        for turns_left in [0, 1] {
            for job in [0, 1, 7, 23] {
                let infinites = [15, 2047, LAST_ID];
                stimuli.extend(infinites.map(|infinite| vec![step, turns_left, infinite, 3 * job, 4 * job]));
            }
        }
    }
    Cosimulation {
        name: "seed_writes",
        rust: SeedWrites::default(),
        inputs: &["step", "turns_left", "infinite", "first_vertex", "first_record"],
        outputs: &["write"],
    }
    .run(stimuli, |values| {
        let infinite = values[2];
        let (a, first) = (values[3], values[4]);
        let (b, c) = if values[1] == 1 { (a + 1, a + 2) } else { (a + 2, a + 1) };
        let (id, v, n) = match values[0] {
            0 => (0, [a, a + 1, a + 2], [0, 0, 0]),
            1 => (0, [a, b, c], [1, 2, 3]),
            2 => (1, [c, b, infinite], [3, 2, 0]),
            3 => (2, [a, c, infinite], [1, 3, 0]),
            _ => (3, [b, a, infinite], [2, 1, 0]),
        };
        let (id, n) = (first + id, n.map(|n| first + n));
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
    let (mut port, mut copies): (Expected, Expected) = (None, None);
    Cosimulation {
        name: "write_port",
        rust: WritePort::default(),
        inputs: &["reset", "commit", "solo", "seed"],
        outputs: &["write", "enables"],
    }
    .run(stimuli, |values| {
        let (seen, seen_copies) = (port, copies);
        let request = values[1..].iter().find(|request| **request & 1 == 1);
        port = if values[0] == 1 {
            copies = Some(0x7fff << 4 | 0x5555 << 19);
            Some(0)
        } else {
            copies = request.map(|write| (write >> 1 & 0x7fff) << 4 | (write >> 1 & 0x7fff) << 19).or(copies);
            // Without a request the data stay and the write is over.
            request.copied().or(port.map(|write| write & !1))
        };
        // What is written of the write there is.
        let enables = seen.map(|write| if write & 1 == 1 { write >> 16 & 0b1111 } else { 0 });
        vec![seen, enables.zip(seen_copies).map(|(enables, copies)| enables | copies)]
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
