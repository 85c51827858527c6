//! Runs `TriangleStore` in Rust and in Verilog beside plain arrays: all three must agree in every clock.

use super::lock_store::{LockDelay, LockReference};
use crate::rig::drawing::{draw, When};
use crate::rig::ids::id;
use crate::rig::stepper::bundles::{column_write, pack, random_fields, unpack, WRITE};
use crate::rig::stepper::{named_ports, Delay, Expected, Stepper};
use incircle_hdl::mesh::TriangleStore;
use incircle_testkit::SplitMix64;

named_ports!(
    [] TriangleStore,
    [write, enables, read_id, vertices_id, links_id, read_locks, context_id, clear],
    [record, took, foreign],
    clock
);

const CYCLES: usize = 6_000;

/// Reads, writes and locks in any mixture.
fn triangle_stimuli(stored_bits: u32) -> Vec<Vec<u128>> {
    let mut numbers = SplitMix64::new(21);
    (0..CYCLES)
        .map(|_| {
            let mut write = random_fields(WRITE, &mut numbers);
            write[1] = id(&mut numbers, stored_bits);
            let (read, clear) = (id(&mut numbers, stored_bits), id(&mut numbers, stored_bits));
            // Only the enables decide what is written.
            let enables = (numbers.bits(1) * numbers.bits(4)) | (write[1] << 4) | (write[1] << 19);
            let numbers =
                [enables, read, read, read, numbers.bits(1), numbers.bits(5), clear, numbers.bits(1)].map(u128::from);
            [&[pack(WRITE, write)], &numbers[..]].concat()
        })
        .collect()
}

/// Columns and lock of the record that is read; `None` where the same edge changes them.
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
        let [id, takes, context, cleared, clears] = [2, 5, 6, 7, 8].map(|input| values[input] as u64);
        let lock = locks.edge(id, context, takes == 1, (clears == 1).then_some(cleared));
        let seen = column_delay.pass(seen).unwrap_or([None; 6]);
        [&seen[..], &lock_delay.pass(lock)].concat()
    }
}

fn triangle_store(name: &str, id_bits: u32, vertex_bits: u32, context_bits: u32) {
    let locks = LockReference::new(id_bits, context_bits);
    let mut reference = triangle_reference(id_bits, vertex_bits, locks);
    Stepper::new(name, TriangleStore::new(id_bits as usize, vertex_bits as usize, context_bits as usize), 1).run(
        &[
            "write",
            "enables",
            "read_id",
            "vertices_id",
            "links_id",
            "read_locks",
            "context_id",
            "clear_id",
            "clear_valid",
        ],
        &["record_v0", "record_v1", "record_v2", "record_n0", "record_n1", "record_n2", "took", "foreign", "was_set"],
        triangle_stimuli(id_bits),
        |values| reference(values),
    );
}

#[test]
fn triangle_store_writes_records_and_single_links() {
    triangle_store("triangle_store_15_15_5", 15, 15, 5);
}

#[test]
fn triangle_store_ignores_what_is_above_its_shape() {
    triangle_store("triangle_store_5_4_1", 5, 4, 1);
}

#[test]
fn triangle_store_shows_the_wave_of_its_header() {
    const READS: [usize; 3] = [2, 3, 4];
    const ANSWERS: [usize; 3] = [4, 5, 6];
    const KNOWN: [usize; 7] = [1, 2, 3, 4, 5, 6, 7];
    let stimuli = [
        (0, "write", column_write(5, 15, 7, 8)),
        (0, "enables", 15 | 5 << 4 | 5 << 19),
        (1, "write", column_write(5, 4, 0, 9)),
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
        ("v0", "record_v0", 0, 15, When::At(&ANSWERS)),
        ("n1", "record_n1", 0, 15, When::At(&ANSWERS)),
        ("took", "took", 0, 1, When::At(&KNOWN)),
        ("was_set", "was_set", 0, 1, When::At(&ANSWERS)),
    ];
    let store = TriangleStore::new(15, 15, 5);
    draw("triangle_store_15_15_5", store, &stimuli, 8, &lanes).assert_drawn_in("triangle_store");
}
