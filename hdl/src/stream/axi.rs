//! The ports of an AXI bus on the device's side, declared once. Signals have the names that AXI gives them.

use crate::commands::types::Word;
use rust_hdl_core::prelude::*;

/// Address of a register, in bytes.
pub type Address = Bits<12>;
/// Number of a register, which is its address divided by 4.
pub type RegisterIndex = Bits<10>;

/// AXI4-Lite: five channels, each with its own `valid` and `ready`.
#[derive(LogicInterface, Default)]
pub struct AxiLite {
    /// Address of a write.
    pub awvalid: Signal<In, Bit>,
    pub awready: Signal<Out, Bit>,
    pub awaddr: Signal<In, Address>,
    /// Data of a write; `wstrb` says which of the four bytes count.
    pub wvalid: Signal<In, Bit>,
    pub wready: Signal<Out, Bit>,
    pub wdata: Signal<In, Word>,
    pub wstrb: Signal<In, Bits<4>>,
    /// Response to a write.
    pub bvalid: Signal<Out, Bit>,
    pub bready: Signal<In, Bit>,
    pub bresp: Signal<Out, Bits<2>>,
    /// Address of a read.
    pub arvalid: Signal<In, Bit>,
    pub arready: Signal<Out, Bit>,
    pub araddr: Signal<In, Address>,
    /// Response to a read.
    pub rvalid: Signal<Out, Bit>,
    pub rready: Signal<In, Bit>,
    pub rdata: Signal<Out, Word>,
    pub rresp: Signal<Out, Bits<2>>,
}

/// A stream of beats into a block; W is the number of bits of a beat, K = W / 8 the number of bytes.
#[derive(LogicInterface, Default)]
pub struct AxisSink<const W: usize, const K: usize> {
    pub tvalid: Signal<In, Bit>,
    pub tready: Signal<Out, Bit>,
    pub tdata: Signal<In, Bits<W>>,
    /// The bytes that the beat holds.
    pub tkeep: Signal<In, Bits<K>>,
}

/// A stream of beats out of a block; W is the number of bits of a beat, K = W / 8 the number of bytes.
#[derive(LogicInterface, Default)]
pub struct AxisSource<const W: usize, const K: usize> {
    pub tvalid: Signal<Out, Bit>,
    pub tready: Signal<In, Bit>,
    pub tdata: Signal<Out, Bits<W>>,
    /// The bytes that the beat holds, which are all of them.
    pub tkeep: Signal<Out, Bits<K>>,
    /// The beat is the last one of its answer.
    pub tlast: Signal<Out, Bit>,
}
