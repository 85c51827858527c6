//! The place after one in a ring.
//!
//! Latency: none, the block is combinational.

use crate::engine::types::{ring_bits, RingEntry};
use crate::leaf::Parameter;
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct NextPlace {
    pub place: Signal<In, RingEntry>,
    /// First and last place of the ring.
    pub first: Signal<In, RingEntry>,
    pub last: Signal<In, RingEntry>,
    pub after: Signal<Out, RingEntry>,
    one: Signal<Local, RingEntry>,
    places: Parameter<RingEntry>,
}

impl NextPlace {
    pub fn new(config: Config) -> Self {
        Self { places: Parameter::new(((1u64 << ring_bits(config)) - 1).into()), ..Self::default() }
    }
}

impl Logic for NextPlace {
    #[hdl_gen]
    fn update(&mut self) {
        self.one.next = 1.into();
        self.after.next = (self.place.val() + self.one.val()) & self.places.val();
        if self.place.val() == self.last.val() {
            self.after.next = self.first.val();
        }
    }
}
