//! The address of a context's word in a memory that has the same number of words for each context. The lists of all
//! contexts share such memories.
//!
//! Latency: none; the block has no logic, because both sides are the same wires.

use rust_hdl_core::prelude::*;

#[derive(LogicBlock)]
pub struct ContextAddress<const P: usize, const A: usize> {
    /// The context that the word belongs to.
    pub context_id: Signal<In, Bits<5>>,
    /// The place of the word among those of the context, less than `2^place_bits`.
    pub place: Signal<In, Bits<P>>,
    /// The address `context_id * 2^place_bits + place`.
    pub address: Signal<Out, Bits<A>>,
    wide_context: Signal<Local, Bits<A>>,
    wide_place: Signal<Local, Bits<A>>,
    base: Signal<Local, Bits<A>>,
    place_bits: Constant<Bits<A>>,
}

impl<const P: usize, const A: usize> ContextAddress<P, A> {
    /// Builds the addresses of a memory with `2^place_bits` words for each context.
    ///
    /// # Panics
    ///
    /// If `place_bits` is not in `1..=P`.
    pub fn new(place_bits: usize) -> Self {
        assert!((1..=P).contains(&place_bits), "a word of a context has 1 to {P} bits here, not {place_bits}");
        Self {
            context_id: Signal::default(),
            place: Signal::default(),
            address: Signal::default(),
            wide_context: Signal::default(),
            wide_place: Signal::default(),
            base: Signal::default(),
            place_bits: Constant::new(Bits::from(place_bits as u64)),
        }
    }
}

impl<const P: usize, const A: usize> Default for ContextAddress<P, A> {
    fn default() -> Self {
        Self::new(P)
    }
}

impl<const P: usize, const A: usize> Logic for ContextAddress<P, A> {
    #[hdl_gen]
    fn update(&mut self) {
        self.wide_context.next = bit_cast::<A, 5>(self.context_id.val());
        self.wide_place.next = bit_cast::<A, P>(self.place.val());
        self.base.next = self.wide_context.val() << self.place_bits.val();
        self.address.next = self.base.val() | self.wide_place.val();
    }
}
