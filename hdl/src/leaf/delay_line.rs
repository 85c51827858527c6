//! Data delayed by a few clocks, kept in a ring buffer of LUTs.
//!
//! 1. There is no reset and no valid bit. The output is arbitrary until `stages` edges have passed; users carry a valid bit beside.
//!
//! Latency: data that stands before edge 1 is on the output after edge `stages`.
//!
//! Source: a counter writes, and another one `stages - 1` behind it reads into a register. Up to 16 stages a slice in an ECP5 keeps 4 bits;
//! block RAM is dear, lies far from everything, and would be nearly empty.

use super::lut_memory::LutMemory;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// Bits of the counter; the ring uses as many of them as it needs.
const COUNTER_BITS: usize = 6;

/// A delay; see the top of this file.
#[derive(LogicBlock)]
pub struct DelayLine<const D: usize> {
    pub clock: Signal<In, Clock>,
    /// Taken at every edge.
    pub data_in: Signal<In, Bits<D>>,
    /// `data_in` of `stages` edges ago.
    pub data_out: Signal<Out, Bits<D>>,
    ring: LutMemory<COUNTER_BITS, D>,
    position: DFF<Bits<COUNTER_BITS>>,
    oldest: DFF<Bits<COUNTER_BITS>>,
    delayed: DFF<Bits<D>>,
    one: Constant<Bits<COUNTER_BITS>>,
    distance_before: Constant<Bits<COUNTER_BITS>>,
}

impl<const D: usize> DelayLine<D> {
    /// Fewest stages; plain registers do for fewer.
    pub const MIN_STAGES: usize = 3;
    /// Most stages that the counter can tell apart.
    pub const MAX_STAGES: usize = 1 << COUNTER_BITS;

    /// A delay of `stages` clocks.
    ///
    /// # Panics
    /// If `stages` is not in `MIN_STAGES..=MAX_STAGES`.
    pub fn new(stages: usize) -> Self {
        let (fewest, most) = (Self::MIN_STAGES, Self::MAX_STAGES);
        assert!((fewest..=most).contains(&stages), "a delay line has {fewest} to {most} stages, not {stages}");
        // The register behind the memory is one stage; the word read is this far behind the one written.
        let distance = stages - 1;
        Self {
            clock: Signal::default(),
            data_in: Signal::default(),
            data_out: Signal::default(),
            ring: LutMemory::new(clog2(distance + 1), D),
            position: DFF::default(),
            oldest: DFF::default(),
            delayed: DFF::default(),
            one: Constant::new(Bits::from(1)),
            distance_before: Constant::new(Bits::from(distance as u64 - 1)),
        }
    }
}

impl<const D: usize> Default for DelayLine<D> {
    fn default() -> Self {
        Self::new(Self::MIN_STAGES)
    }
}

impl<const D: usize> Logic for DelayLine<D> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, position, oldest, delayed);
        clock!(self, clock, ring);
        self.position.d.next = self.position.q.val() + self.one.val();
        // The counter will be one further when this is used.
        self.oldest.d.next = self.position.q.val() - self.distance_before.val();
        self.ring.write_address.next = self.position.q.val();
        self.ring.write_data.next = self.data_in.val();
        self.ring.write_enable.next = true;
        self.ring.read_address.next = self.oldest.q.val();
        self.delayed.d.next = self.ring.read_data.val();
        self.data_out.next = self.delayed.q.val();
    }
}
