//! The leaves and the predicates.

use incircle_hdl::leaf::{
    BankedMemory, BlockMemory, DeepFifo, DelayLine, Fifo, FlagDelay, LockMemory, LookupTable, LutMemory, Multiplier,
    PacedMemory, SharedMemory,
};
use incircle_hdl::predicate::{
    CornerPairs, CrossProduct, DotProduct, EdgeSigns, PointDifference, SideDelay, VertexOrder, VisitPredicates,
    WideProduct,
};

use crate::exported::block;
use rust_hdl_core::prelude::*;

/// Name of the root module and Verilog of each block.
pub(crate) fn blocks() -> Vec<(String, String)> {
    vec![
        block(Multiplier::default(), "multiplier"),
        block(BlockMemory::<8, 12>::new(8, 12), "block_memory_8x12"),
        block(BlockMemory::<10, 36>::new(6, 33), "block_memory_6x33"),
        block(BlockMemory::<11, 20>::new(11, 20), "block_memory_11x20"),
        block(BlockMemory::<12, 10>::new(12, 10), "block_memory_12x10"),
        block(BlockMemory::<13, 3>::new(13, 3), "block_memory_13x3"),
        block(BlockMemory::<14, 2>::new(14, 2), "block_memory_14x2"),
        block(PacedMemory::<8, 12>::new(8, 12), "paced_memory_8x12"),
        block(PacedMemory::<10, 36>::new(6, 33), "paced_memory_6x33"),
        block(LutMemory::<4, 8>::new(4, 8), "lut_memory_4x8"),
        block(LutMemory::<6, 40>::new(5, 37), "lut_memory_5x37"),
        block(LookupTable::<4, Bits<40>>::new(|row| (0x7_0302_0177 * row as u64).into()), "lookup_table_4x40"),
        block(BankedMemory::<6, 3, 4, 8>::new(6, 4, 8), "banked_memory_6x4x8"),
        block(BankedMemory::<24, 5, 6, 7>::new(3, 2, 5), "banked_memory_3x2x5"),
        block(LockMemory::<14>::new(14), "lock_memory_14"),
        block(LockMemory::<8>::new(4), "lock_memory_4"),
        block(SharedMemory::<8, 12>::new(8, 12), "shared_memory_8x12"),
        block(SharedMemory::<10, 36>::new(6, 33), "shared_memory_6x33"),
        block(DelayLine::<8>::new(3), "delay_line_3"),
        block(DelayLine::<40>::new(19), "delay_line_19"),
        block(Fifo::<3, 8>::new(3, 8), "fifo_3x8"),
        block(Fifo::<6, 40>::new(2, 37), "fifo_2x37"),
        block(DeepFifo::<8, 8>::new(8, 8), "deep_fifo_8x8"),
        block(DeepFifo::<9, 40>::new(5, 37), "deep_fifo_5x37"),
        block(FlagDelay::new(1), "flag_delay_1"),
        block(FlagDelay::new(2), "flag_delay_2"),
        block(FlagDelay::new(9), "flag_delay_9"),
        block(PointDifference::default(), "point_difference"),
        block(CrossProduct::default(), "cross_product"),
        block(DotProduct::default(), "dot_product"),
        block(WideProduct::default(), "wide_product"),
        block(EdgeSigns::new(2), "edge_signs"),
        block(SideDelay::new(6), "side_delay"),
        block(CornerPairs::default(), "corner_pairs"),
        block(VertexOrder::new(1), "vertex_order"),
        block(VisitPredicates::default(), "visit_predicates"),
    ]
}
