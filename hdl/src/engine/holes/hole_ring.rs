//! The rings of stars: four copies of the vertices, so that the four of a test can be read at once, and a word of each
//! edge for the writer.
//!
//! Latency: 2 clocks from a place to its vertex or word. An entry can be read from the second clock after it has come.

use crate::engine::attempt::ContextAddress;
use crate::engine::types::{
    context_bits, ring_bits, ContextId, Entry, EntryWrite, RingEntry, RingWord, TestVertices, TriangleId, Visit,
    ENTRY_BITS, RING_ADDRESS_BITS, RING_WORD_BITS, VERTEX_BITS,
};
use crate::leaf::{BlockMemory, Parameter, Unpack};
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct HoleRing {
    pub clock: Signal<In, Clock>,
    /// An edge of a ring; its place may be negative, in six bits.
    pub entry: Signal<In, EntryWrite>,
    /// A visit that may be a test, and the vertices of the test.
    pub visit: Signal<In, Visit>,
    pub vertices: Signal<Out, TestVertices>,
    /// A context and a place, and the word of the edge there.
    pub reader: Signal<In, ContextId>,
    pub place: Signal<In, RingEntry>,
    pub word: Signal<Out, RingWord>,
    written: DFF<EntryWrite>,
    first: BlockMemory<RING_ADDRESS_BITS, VERTEX_BITS>,
    second: BlockMemory<RING_ADDRESS_BITS, VERTEX_BITS>,
    third: BlockMemory<RING_ADDRESS_BITS, VERTEX_BITS>,
    fourth: BlockMemory<RING_ADDRESS_BITS, VERTEX_BITS>,
    words: BlockMemory<RING_ADDRESS_BITS, RING_WORD_BITS>,
    write_at: ContextAddress<ENTRY_BITS, RING_ADDRESS_BITS>,
    first_at: ContextAddress<ENTRY_BITS, RING_ADDRESS_BITS>,
    second_at: ContextAddress<ENTRY_BITS, RING_ADDRESS_BITS>,
    third_at: ContextAddress<ENTRY_BITS, RING_ADDRESS_BITS>,
    fourth_at: ContextAddress<ENTRY_BITS, RING_ADDRESS_BITS>,
    word_at: ContextAddress<ENTRY_BITS, RING_ADDRESS_BITS>,
    kept_edge: Signal<Local, Entry>,
    kept: Signal<Local, RingWord>,
    kept_bits: Signal<Local, Bits<RING_WORD_BITS>>,
    read: Unpack<RingWord, RING_WORD_BITS>,
    places: Parameter<RingEntry>,
    challenger: Signal<Local, TriangleId>,
}

impl HoleRing {
    pub fn new(config: Config) -> Self {
        let bits = ring_bits(config);
        let copy = || BlockMemory::new(context_bits(config) + bits, VERTEX_BITS);
        Self {
            first: copy(),
            second: copy(),
            third: copy(),
            fourth: copy(),
            words: BlockMemory::new(context_bits(config) + bits, RING_WORD_BITS),
            write_at: ContextAddress::new(bits),
            first_at: ContextAddress::new(bits),
            second_at: ContextAddress::new(bits),
            third_at: ContextAddress::new(bits),
            fourth_at: ContextAddress::new(bits),
            word_at: ContextAddress::new(bits),
            places: Parameter::new(((1u64 << bits) - 1).into()),
            ..Self::default()
        }
    }
}

impl Logic for HoleRing {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, written);
        clock!(self, clock, first, second, third, fourth, words);
        self.written.d.next = self.entry.val();
        self.kept_edge.next = self.written.q.val().entry;
        self.write_at.context_id.next = self.written.q.val().context;
        self.write_at.place.next = self.written.q.val().place & self.places.val();
        self.kept.next.vertex = self.kept_edge.val().first_vertex;
        self.kept.next.outside = self.kept_edge.val().outside_record;
        self.kept.next.slot = self.kept_edge.val().slot;
        self.kept.next.record = self.kept_edge.val().cavity_record;
        self.kept_bits.next = self.kept.val().into();
        self.first.write_address.next = self.write_at.address.val();
        self.second.write_address.next = self.write_at.address.val();
        self.third.write_address.next = self.write_at.address.val();
        self.fourth.write_address.next = self.write_at.address.val();
        self.words.write_address.next = self.write_at.address.val();
        self.first.write_data.next = self.kept_edge.val().first_vertex;
        self.second.write_data.next = self.kept_edge.val().first_vertex;
        self.third.write_data.next = self.kept_edge.val().first_vertex;
        self.fourth.write_data.next = self.kept_edge.val().first_vertex;
        self.words.write_data.next = self.kept_bits.val();
        self.first.write_enable.next = self.written.q.val().valid;
        self.second.write_enable.next = self.written.q.val().valid;
        self.third.write_enable.next = self.written.q.val().valid;
        self.fourth.write_enable.next = self.written.q.val().valid;
        self.words.write_enable.next = self.written.q.val().valid;

        // A test has the end of its interval in `after`, the beginning in `entry`, the best apex in `cavity_entry` and
        // the challenger in `cavity_record`.
        self.first_at.context_id.next = self.visit.val().context;
        self.second_at.context_id.next = self.visit.val().context;
        self.third_at.context_id.next = self.visit.val().context;
        self.fourth_at.context_id.next = self.visit.val().context;
        self.first_at.place.next = self.visit.val().after & self.places.val();
        self.second_at.place.next = self.visit.val().entry & self.places.val();
        self.third_at.place.next = self.visit.val().cavity_entry & self.places.val();
        // The challenger of a test stands in the low bits of a field that has an id in other visits.
        self.challenger.next = self.visit.val().cavity_record;
        self.fourth_at.place.next = self.challenger.val().get_bits::<6>(0) & self.places.val();
        self.first.read_address.next = self.first_at.address.val();
        self.second.read_address.next = self.second_at.address.val();
        self.third.read_address.next = self.third_at.address.val();
        self.fourth.read_address.next = self.fourth_at.address.val();
        self.vertices.next.v0 = self.first.read_data.val();
        self.vertices.next.v1 = self.second.read_data.val();
        self.vertices.next.v2 = self.third.read_data.val();
        self.vertices.next.challenger = self.fourth.read_data.val();

        self.word_at.context_id.next = self.reader.val();
        self.word_at.place.next = self.place.val();
        self.words.read_address.next = self.word_at.address.val();
        self.read.bits.next = self.words.read_data.val();
        self.word.next = self.read.value.val();
    }
}
