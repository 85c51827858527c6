//! The head of the answer to a run.
//!
//! 1. An answer has four words for each item of a `Locate` (8), ten for each item of an `Interpolate` (9), and two for
//!    each item of a `Nearest` (10) or an `InsertAs` (11). The answer to a run that is refused, with another status
//!    than 0, is its head alone.
//! 2. A run is too long if the words of its answer cannot be counted in 32 bits.
//!
//! Latency: none, the block is combinational.

use super::types::RunHead;
use crate::commands::types::Word;
use incircle_protocol::{Opcode, RunKind};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct RunAnswer {
    /// The opcode of the run, the number of its items, its status, and the low half of the header.
    pub code: Signal<In, Bits<8>>,
    pub count: Signal<In, Word>,
    pub status: Signal<In, Bits<3>>,
    pub signature: Signal<In, Bits<16>>,
    pub is_too_long: Signal<Out, Bit>,
    /// The answer begins at this edge.
    pub gives: Signal<In, Bit>,
    pub head: Signal<Out, RunHead>,
    wide_status: Signal<Local, Word>,
    shifted_status: Signal<Local, Word>,
    wide_code: Signal<Local, Word>,
    shifted_code: Signal<Local, Word>,
    is_weighed: Signal<Local, Bit>,
    is_short: Signal<Local, Bit>,
    most: Signal<Local, Word>,
    one: Signal<Local, Word>,
    two: Signal<Local, Word>,
    three: Signal<Local, Word>,
    status_shift: Signal<Local, Word>,
    code_shift: Signal<Local, Word>,
}

// The kernel holds the numbers as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = {
    let words = [RunKind::Locate.part_words(), RunKind::Interpolate.part_words(), RunKind::Nearest.part_words()];
    assert!(words[0] == 4 && words[1] == 10 && words[2] == 2, "the numbers of this block follow the protocol");
    assert!(RunKind::InsertAs.part_words() == words[2], "four kinds of parts have two words");
    assert!(RunKind::Delete.part_words() == words[2], "four kinds of parts have two words");
    assert!(RunKind::Move.part_words() == words[2], "four kinds of parts have two words");
    assert!(Opcode::Delete as u8 & Opcode::Move as u8 & 4 == 4, "a third bit of the opcode decides");
    let most = [u32::MAX / words[0] as u32, u32::MAX / words[1] as u32, u32::MAX / words[2] as u32];
    assert!(most[0] == 1_073_741_823 && most[1] == 429_496_729, "the most items that can be counted");
    assert!(most[2] == 2_147_483_647, "the most items that can be counted");
    assert!(Opcode::Locate as u8 & 3 == 0 && Opcode::Interpolate as u8 & 3 == 1, "two bits of the opcode decide");
    assert!(Opcode::Nearest as u8 & 3 == 2 && Opcode::InsertAs as u8 & 3 == 3, "two bits of the opcode decide");
};

impl Logic for RunAnswer {
    #[hdl_gen]
    fn update(&mut self) {
        self.one.next = 1.into();
        self.two.next = 2.into();
        self.three.next = 3.into();
        self.status_shift.next = 16.into();
        self.code_shift.next = 24.into();
        self.is_short.next = self.code.val().get_bit(1) | self.code.val().get_bit(2);
        self.is_weighed.next = self.code.val().get_bit(0) & (!self.is_short.val());
        self.most.next = 1073741823.into();
        self.head.next.length = self.count.val() << self.two.val();
        self.head.next.last_beat = 1.into();
        if self.is_weighed.val() {
            self.most.next = 429496729.into();
            self.head.next.length = (self.count.val() << self.three.val()) + (self.count.val() << self.one.val());
            self.head.next.last_beat = 4.into();
        }
        if self.is_short.val() {
            self.most.next = 2147483647.into();
            self.head.next.length = self.count.val() << self.one.val();
            self.head.next.last_beat = 0.into();
        }
        self.is_too_long.next = self.most.val() < self.count.val();

        self.wide_code.next = bit_cast::<32, 8>(self.code.val());
        self.shifted_code.next = self.wide_code.val() << self.code_shift.val();
        self.wide_status.next = bit_cast::<32, 3>(self.status.val());
        self.shifted_status.next = self.wide_status.val() << self.status_shift.val();
        self.head.next.valid = self.gives.val();
        self.head.next.header =
            self.shifted_code.val() | self.shifted_status.val() | bit_cast::<32, 16>(self.signature.val());
        self.head.next.parts = self.count.val();
        if self.status.val().any() {
            self.head.next.length = 0.into();
            self.head.next.parts = 0.into();
        }
    }
}
