//! The ports of an AXI bus on the device's side, spelt once. Names of the signals are AXI's own.

use crate::commands::types::Word;
use rust_hdl_core::prelude::*;

/// Address of a register, in bytes.
pub type Address = Bits<12>;
/// Number of a register: its address divided by 4.
pub type RegisterIndex = Bits<10>;

/// AXI4-Lite: five channels, each with a `valid` and a `ready` of its own.
#[derive(LogicInterface, Default)]
pub struct AxiLite {
    /// Address of a write.
    pub awvalid: Signal<In, Bit>,
    pub awready: Signal<Out, Bit>,
    pub awaddr: Signal<In, Address>,
    /// Data of a write, and the bytes of it that count.
    pub wvalid: Signal<In, Bit>,
    pub wready: Signal<Out, Bit>,
    pub wdata: Signal<In, Word>,
    pub wstrb: Signal<In, Bits<4>>,
    /// Answer to a write.
    pub bvalid: Signal<Out, Bit>,
    pub bready: Signal<In, Bit>,
    pub bresp: Signal<Out, Bits<2>>,
    /// Address of a read.
    pub arvalid: Signal<In, Bit>,
    pub arready: Signal<Out, Bit>,
    pub araddr: Signal<In, Address>,
    /// Answer to a read.
    pub rvalid: Signal<Out, Bit>,
    pub rready: Signal<In, Bit>,
    pub rdata: Signal<Out, Word>,
    pub rresp: Signal<Out, Bits<2>>,
}

/// Beats of W bits that a block takes; K is W / 8.
#[derive(LogicInterface, Default)]
pub struct AxisSink<const W: usize, const K: usize> {
    pub tvalid: Signal<In, Bit>,
    pub tready: Signal<Out, Bit>,
    pub tdata: Signal<In, Bits<W>>,
    /// Bytes that the beat has.
    pub tkeep: Signal<In, Bits<K>>,
}

/// Beats of W bits that a block gives; K is W / 8.
#[derive(LogicInterface, Default)]
pub struct AxisSource<const W: usize, const K: usize> {
    pub tvalid: Signal<Out, Bit>,
    pub tready: Signal<In, Bit>,
    pub tdata: Signal<Out, Bits<W>>,
    /// Bytes that the beat has: all.
    pub tkeep: Signal<Out, Bits<K>>,
    /// The beat is the last one of its answer.
    pub tlast: Signal<Out, Bit>,
}
