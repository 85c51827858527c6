//! The bucket of a latency: eight buckets to an octave from 16 clocks on. The first one takes all latencies below 18,
//! the last one all from 2^20 - 2^16 on. The buckets between are an eighth of their latencies wide at most, so short
//! and long insertions are told apart equally well.
//!
//! 1. The highest bit that is set gives the octave, the three bits below it the place in the octave.
//!
//! Latency: 2 clocks, because registers stand behind the step of eight octaves and behind that of four.

use crate::engine::types::Clocks;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct LatencyBucket {
    pub clock: Signal<In, Clock>,
    /// The latency, in clocks.
    pub latency: Signal<In, Clocks>,
    /// The number of the bucket: four bits of the octave, then three of the place in it.
    pub bucket: Signal<Out, Bits<7>>,
    /// The latency from bit 1 up, shifted until its highest bit that is set stands at the top.
    from8: Signal<Local, Bits<19>>,
    from4: DFF<Bits<19>>,
    from2: DFF<Bits<19>>,
    from1: Signal<Local, Bits<19>>,
    top: Signal<Local, Bits<19>>,
    /// The steps of eight, four, two octaves and one.
    octave8: DFF<Bits<7>>,
    octave4: Signal<Local, Bits<7>>,
    high_octave: DFF<Bits<7>>,
    octave2: Signal<Local, Bits<7>>,
    octave1: Signal<Local, Bits<7>>,
    place: Signal<Local, Bits<7>>,
    was_far: DFF<Bit>,
    is_far: DFF<Bit>,
    eight: Signal<Local, Bits<19>>,
    four: Signal<Local, Bits<19>>,
    two: Signal<Local, Bits<19>>,
    one: Signal<Local, Bits<19>>,
}

impl Logic for LatencyBucket {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, from4, octave8, was_far, from2, high_octave, is_far);
        self.eight.next = 8.into();
        self.four.next = 4.into();
        self.two.next = 2.into();
        self.one.next = 1.into();
        self.was_far.d.next = self.latency.val().get_bit(20) | self.latency.val().get_bit(21);
        self.is_far.d.next = self.was_far.q.val();
        self.from8.next = self.latency.val().get_bits::<19>(1);

        self.octave8.d.next = 0.into();
        self.from4.d.next = self.from8.val() << self.eight.val();
        if self.from8.val().get_bits::<8>(11).any() {
            self.octave8.d.next = 64.into();
            self.from4.d.next = self.from8.val();
        }
        self.octave4.next = 0.into();
        self.from2.d.next = self.from4.q.val() << self.four.val();
        if self.from4.q.val().get_bits::<4>(15).any() {
            self.octave4.next = 32.into();
            self.from2.d.next = self.from4.q.val();
        }
        self.high_octave.d.next = self.octave8.q.val() | self.octave4.val();
        self.octave2.next = 0.into();
        self.from1.next = self.from2.q.val() << self.two.val();
        if self.from2.q.val().get_bits::<2>(17).any() {
            self.octave2.next = 16.into();
            self.from1.next = self.from2.q.val();
        }
        self.octave1.next = 0.into();
        self.top.next = self.from1.val() << self.one.val();
        if self.from1.val().get_bit(18) {
            self.octave1.next = 8.into();
            self.top.next = self.from1.val();
        }

        // Below 16 clocks no bit comes to the top, so the bucket is the first.
        self.place.next = bit_cast::<7, 3>(self.top.val().get_bits::<3>(15));
        self.bucket.next = 0.into();
        if self.top.val().get_bit(18) {
            self.bucket.next = self.high_octave.q.val() | self.octave2.val() | self.octave1.val() | self.place.val();
        }
        if self.is_far.q.val() {
            self.bucket.next = 127.into();
        }
    }
}
