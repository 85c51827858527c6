//! Proves by synthesis that each leaf of the core maps to the primitive it is meant for, and to nothing else.

use crate::rig::cells::{cells, cells_with};
use incircle_testbench::gate::Cells;

#[test]
fn multiplier_is_one_dsp_block() {
    assert_eq!(cells("multiplier").multipliers, 1);
}

#[test]
fn multiplier_as_a_primitive_needs_no_register_outside() {
    let cells = cells_with("`define INCIRCLE_ECP5\n", "multiplier");
    assert_eq!((cells.multipliers, cells.flip_flops), (1, 0));
}

#[test]
fn memories_are_block_ram_without_bypass_logic() {
    let shapes = [
        ("block_memory_8x12", 12),
        ("block_memory_6x33", 33),
        ("paced_memory_8x12", 12),
        ("paced_memory_6x33", 33),
        ("lock_memory_14", 1),
    ];
    for (name, output_bits) in shapes {
        let cells = cells(name);
        assert_eq!((cells.block_ram, cells.lut4), (1, 0), "{name}");
        assert_eq!(cells.flip_flops, output_bits, "{name} has its output register and no other");
    }
}

#[test]
fn memories_as_primitives_are_block_ram_and_nothing_else() {
    let shapes = [
        ("block_memory_8x12", 1),
        ("block_memory_6x33", 2),
        ("block_memory_11x20", 3),
        ("block_memory_12x10", 3),
        ("block_memory_13x3", 2),
        ("block_memory_14x2", 2),
        ("paced_memory_8x12", 1),
        ("paced_memory_6x33", 2),
        ("shared_memory_8x12", 1),
        ("shared_memory_6x33", 2),
        ("lock_memory_14", 1),
        ("lock_memory_4", 1),
    ];
    for (name, block_ram) in shapes {
        let cells = cells_with("`define INCIRCLE_ECP5\n", name);
        assert_eq!(cells, Cells { block_ram, ..Cells::default() }, "{name}");
    }
}

#[test]
fn deep_fifo_is_block_ram_behind_two_banks_in_luts() {
    let cells = cells("deep_fifo_5x37");
    // Each bank takes ten slices of four bits, and one more slice holds the bit that tells the banks apart.
    assert_eq!((cells.block_ram, cells.distributed_ram), (2, 21));
}

#[test]
fn small_memory_is_distributed_ram() {
    let cells = cells("lut_memory_4x8");
    assert_eq!((cells.distributed_ram, cells.flip_flops), (2, 0));
}
