//! Runs `VertexStore` in Rust and in Verilog beside plain arrays: all three must agree in every clock.

use crate::rig::cells::cells;
use crate::rig::drawing::{draw, When};
use crate::rig::ids::id;
use crate::rig::stepper::{named_ports, Delay, Expected, Stepper};
use incircle_hdl::mesh::VertexStore;
use incircle_testkit::SplitMix64;

named_ports!([] VertexStore, [write, id0, id1, id2, fetch_id], [corners, fetched], clock);

const CYCLES: usize = 6_000;

fn vertex_store(name: &str, id_bits: u32) {
    let mut numbers = SplitMix64::new(22);
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
    Stepper::new(name, VertexStore::new(id_bits as usize), 1).run(
        &["write_id", "write_point", "write_came", "id0", "id1", "id2", "fetch_id"],
        &["corners_r0", "corners_r1", "corners_r2", "fetched"],
        stimuli,
        |values| {
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
        },
    );
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
    // 16384 words of 32 bits take 32 blocks of 16384 x 1 for each copy, with the fetch port or without.
    assert_eq!(cells("vertex_store_14").block_ram, 3 * 32);
}

#[test]
fn vertex_store_shows_the_wave_of_its_header() {
    let stimuli = [(0, "write_came", 1), (0, "write_id", 3), (0, "write_point", 42), (1, "id0", 3), (2, "fetch_id", 3)];
    let lanes = [
        ("write_enable", "write_came", 0, 1, When::Always),
        ("write_id", "write_id", 0, 15, When::If("write_came")),
        ("write_position", "write_point", 0, 32, When::If("write_came")),
        ("id0", "id0", 0, 15, When::At(&[1])),
        ("fetch_id", "fetch_id", 0, 15, When::At(&[2])),
        ("position0", "corners_r0", 0, 32, When::At(&[3])),
        ("fetched", "fetched", 0, 32, When::At(&[4])),
    ];
    draw("vertex_store_14", VertexStore::new(14), &stimuli, 5, &lanes).assert_drawn_in("vertex_store");
}
