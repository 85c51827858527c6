//! Tells where in a command a word stands, and whether it begins one.
//!
//! 1. `begins` depends on registers only. The other outputs say what kind of command a word is that begins one.
//!
//! Latency: none (combinational) from `word` to the outputs, 1 clock from `passes` to what they say of the next word.

use crate::commands::types::Word;
use crate::prelude::*;
use incircle_protocol::{Opcode, PADDING};

/// The place of a word in its command.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum Place {
    /// The word is a command.
    Command,
    /// The word is the id of the first record of a read-out.
    First,
    /// The word is the number of records or of points.
    Count,
    /// The word is a point.
    Points,
}

#[derive(LogicBlock, Default)]
pub struct WordPlace {
    pub clock: Signal<In, Clock>,
    /// After a reset the next word begins a command.
    pub reset: Signal<In, Bit>,
    /// The word, which passes at this edge.
    pub word: Signal<In, Word>,
    pub passes: Signal<In, Bit>,
    /// The word begins a command; it is padding; it is a `Clear`.
    pub begins: Signal<Out, Bit>,
    pub is_padding: Signal<Out, Bit>,
    pub is_clear: Signal<Out, Bit>,
    place: DFF<Place>,
    /// The command whose words come is an `Insert`.
    inserts: DFF<Bit>,
    /// Number of points to come, and whether it is one.
    left: DFF<Word>,
    is_last: DFF<Bit>,
    is_at_begin: Signal<Local, Bit>,
    code: Signal<Local, Bits<8>>,
    clear_code: Signal<Local, Bits<8>>,
    insert_code: Signal<Local, Bits<8>>,
    read_code: Signal<Local, Bits<8>>,
    packed_code: Signal<Local, Bits<8>>,
    one: Signal<Local, Word>,
    two: Signal<Local, Word>,
}

// The kernel holds the opcodes as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = assert!(
    Opcode::Clear as u8 == 2
        && Opcode::Insert as u8 == 3
        && Opcode::Read as u8 == 4
        && Opcode::Triangles as u8 == 7
        && PADDING == 0,
    "the opcodes of this block follow the protocol"
);

impl Logic for WordPlace {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, place, inserts, left, is_last);
        self.clear_code.next = 2.into();
        self.insert_code.next = 3.into();
        self.read_code.next = 4.into();
        self.packed_code.next = 7.into();
        self.one.next = 1.into();
        self.two.next = 2.into();
        self.code.next = self.word.val().get_bits::<8>(24);
        self.is_at_begin.next = self.place.q.val() == Place::Command;
        self.begins.next = self.is_at_begin.val();
        self.is_padding.next = self.is_at_begin.val() & (!self.word.val().any());
        self.is_clear.next = self.is_at_begin.val() & (self.code.val() == self.clear_code.val());
        if self.passes.val() {
            match self.place.q.val() {
                Place::Command => {
                    self.inserts.d.next = self.code.val() == self.insert_code.val();
                    if self.code.val() == self.insert_code.val() {
                        self.place.d.next = Place::Count;
                    }
                    if (self.code.val() == self.read_code.val()) | (self.code.val() == self.packed_code.val()) {
                        self.place.d.next = Place::First;
                    }
                }
                Place::First => {
                    self.place.d.next = Place::Count;
                }
                Place::Count => {
                    self.left.d.next = self.word.val();
                    self.is_last.d.next = self.word.val() == self.one.val();
                    self.place.d.next = Place::Command;
                    if self.inserts.q.val() & self.word.val().any() {
                        self.place.d.next = Place::Points;
                    }
                }
                Place::Points => {
                    self.left.d.next = self.left.q.val() - self.one.val();
                    self.is_last.d.next = self.left.q.val() == self.two.val();
                    if self.is_last.q.val() {
                        self.place.d.next = Place::Command;
                    }
                }
                _ => {
                    self.place.d.next = Place::Command;
                }
            }
        }
        if self.reset.val() {
            self.place.d.next = Place::Command;
        }
    }
}
