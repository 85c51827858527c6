//! Carries out a `Clear`: the mesh is forgotten, and the command says how many contexts work from then on and whether
//! each has a mesh of its own.
//!
//! 1. The low byte of the word is the number of contexts; 0 means all.
//! 2. Bit 8 begins a batch: each of the contexts has a mesh of its own, and the first points are three for each. A batch
//!    of another number of meshes, in bits 15 to 9, is refused.
//! 3. A refused `Clear` changes nothing but the tag, in bits 23 to 16. After a reset there is no batch, and the tag is 0.
//!
//! Latency: 1 clock, 2 to `deal.dealt_from`.

use super::types::{Clearing, TakenWord, Word};
use crate::engine::Deal;
use crate::prelude::*;
use incircle_protocol::{Opcode, CLEAR_BATCH, CLEAR_MESHES_SHIFT, CLEAR_TAG_SHIFT, FIRST_ROUND, MAX_SIDE_BY_SIDE};

#[derive(LogicBlock, Default)]
pub struct ClearCommand {
    /// After a reset all contexts work.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// Number of contexts that the core has; a constant.
    pub built: Signal<In, Bits<5>>,
    /// The word that the core takes from the command stream, if there is one.
    pub taken: Signal<In, TakenWord>,
    pub clearing: Signal<Out, Clearing>,
    /// Number of contexts that work, and which points belong to them.
    pub deal: Signal<Out, Deal>,
    clears: DFF<Bit>,
    working: DFF<Bits<5>>,
    batch: DFF<Bit>,
    dealt: DFF<Bits<7>>,
    refusing: DFF<Bit>,
    tag: DFF<Bits<8>>,
    word: Signal<Local, Word>,
    code: Signal<Local, Bits<8>>,
    asked: Signal<Local, Bits<8>>,
    wide_built: Signal<Local, Bits<8>>,
    is_clear: Signal<Local, Bit>,
    asks_too_much: Signal<Local, Bit>,
    meshes: Signal<Local, Bits<7>>,
    shares_contexts: Signal<Local, Bit>,
    is_impossible: Signal<Local, Bit>,
    is_granted: Signal<Local, Bit>,
    wide_working: Signal<Local, Bits<7>>,
    twice_working: Signal<Local, Bits<7>>,
    clear_code: Signal<Local, Bits<8>>,
    all_contexts: Signal<Local, Bits<8>>,
}

// The kernel holds the numbers as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = assert!(
    Opcode::Clear as u8 == 2
        && CLEAR_BATCH == 1 << 8
        && CLEAR_MESHES_SHIFT == 9
        && MAX_SIDE_BY_SIDE == 127
        && CLEAR_TAG_SHIFT == 16
        && FIRST_ROUND == 16,
    "the numbers of this block follow the protocol"
);

impl Logic for ClearCommand {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, clears, working, batch, dealt, refusing, tag);
        self.clear_code.next = 2.into();
        self.all_contexts.next = 0.into();
        self.clearing.next.clears = self.clears.q.val();
        self.deal.next.contexts = self.working.q.val();
        self.deal.next.is_batch = self.batch.q.val();
        self.deal.next.dealt_from = self.dealt.q.val();
        self.clearing.next.is_refused = self.refusing.q.val();
        self.clearing.next.tag = self.tag.q.val();

        self.word.next = self.taken.val().word;
        self.code.next = self.word.val().get_bits::<8>(24);
        self.asked.next = self.word.val().get_bits::<8>(0);
        self.wide_built.next = bit_cast::<8, 5>(self.built.val());
        self.is_clear.next = self.code.val() == self.clear_code.val();
        self.asks_too_much.next = self.asked.val() > self.wide_built.val();
        self.meshes.next = self.word.val().get_bits::<7>(9);
        self.shares_contexts.next = self.word.val().get_bit(8) & self.meshes.val().any();
        self.is_impossible.next = self.asks_too_much.val() | self.shares_contexts.val();
        self.is_granted.next = self.taken.val().is_command & self.is_clear.val() & (!self.is_impossible.val());
        self.clears.d.next = self.is_granted.val();
        if self.taken.val().is_command {
            self.refusing.d.next = self.is_clear.val() & self.is_impossible.val();
        }
        if self.taken.val().is_command & self.is_clear.val() {
            self.tag.d.next = self.word.val().get_bits::<8>(16);
        }
        if self.is_granted.val() {
            self.batch.d.next = self.word.val().get_bit(8);
            self.working.d.next = self.word.val().get_bits::<5>(0);
            if self.asked.val() == self.all_contexts.val() {
                self.working.d.next = self.built.val();
            }
        }
        self.wide_working.next = bit_cast::<7, 5>(self.working.q.val());
        self.twice_working.next = self.wide_working.val() + self.wide_working.val();
        self.dealt.d.next = 16.into();
        if self.batch.q.val() {
            self.dealt.d.next = self.twice_working.val() + self.wide_working.val();
        }
        if self.reset.val() {
            self.clears.d.next = false;
            self.batch.d.next = false;
            self.tag.d.next = 0.into();
            self.dealt.d.next = 16.into();
            self.working.d.next = self.built.val();
        }
    }
}
