//! Delays data by a fixed number of clocks in a ring of LUT memory, where registers for each stage would be too many.
//!
//! 1. There is no reset and no valid bit. The output is arbitrary until `stages` edges have passed; users carry a valid
//!    bit beside the data.
//!
//! Latency: data that are valid before edge 1 are on the output after edge `stages`.
//!
//! Source: one counter addresses the write; another, `stages - 1` behind, addresses a read into a register. Up to 16
//! stages, one slice of an ECP5 keeps 4 bits. Block RAM is scarce, lies far from most logic, and would be nearly empty.

use super::lut_memory::LutMemory;
use crate::prelude::*;

/// Number of bits of the counter; the ring uses as many of them as it needs.
const COUNTER_BITS: usize = 6;

#[derive(LogicBlock)]
pub struct DelayLine<const D: usize> {
    pub clock: Signal<In, Clock>,
    /// The data to delay, read at every edge.
    pub data_in: Signal<In, Bits<D>>,
    /// Value of `data_in` `stages` edges ago.
    pub data_out: Signal<Out, Bits<D>>,
    ring: LutMemory<COUNTER_BITS, D>,
    position: DFF<Bits<COUNTER_BITS>>,
    oldest: DFF<Bits<COUNTER_BITS>>,
    delayed: DFF<Bits<D>>,
    one: Constant<Bits<COUNTER_BITS>>,
    distance_before: Constant<Bits<COUNTER_BITS>>,
}

impl<const D: usize> DelayLine<D> {
    /// Least number of stages; for fewer, plain registers will do.
    pub const MIN_STAGES: usize = 3;
    /// Largest number of stages that the counter can address.
    pub const MAX_STAGES: usize = 1 << COUNTER_BITS;

    /// A delay of `stages` clocks.
    ///
    /// # Panics
    /// If `stages` is not in `MIN_STAGES..=MAX_STAGES`.
    pub fn new(stages: usize) -> Self {
        let (fewest, most) = (Self::MIN_STAGES, Self::MAX_STAGES);
        assert!((fewest..=most).contains(&stages), "a delay line has {fewest} to {most} stages, not {stages}");
        // The register behind the memory is one stage; so the read is this many places behind the write.
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
        // `oldest` is a register: by the time it is used, the counter is one further.
        self.oldest.d.next = self.position.q.val() - self.distance_before.val();
        self.ring.write_address.next = self.position.q.val();
        self.ring.write_data.next = self.data_in.val();
        self.ring.write_enable.next = true;
        self.ring.read_address.next = self.oldest.q.val();
        self.delayed.d.next = self.ring.read_data.val();
        self.data_out.next = self.delayed.q.val();
    }
}
