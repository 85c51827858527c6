//! What a `Clear` asks for: that the mesh is forgotten, and how many contexts work from then on.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | after reset all contexts work |
//! | `built` | in | 5 | contexts that the core has, a constant |
//! | `accepts`, `word` | in | 1, 32 | a command word is taken |
//! | `clears` | out | 1 | forget the mesh at this edge |
//! | `contexts` | out | 5 | contexts that work |
//! | `is_refused` | out | 1 | the last command is a `Clear` that asks for more contexts than there are |
//!
//! 1. The low byte of the word is the number of contexts; 0 is all.
//! 2. A `Clear` that is refused changes nothing.
//!
//! Latency: 1 clock.

use incircle_protocol::Opcode;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// What a `Clear` asks for; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct ClearCommand {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// All contexts work.
    pub reset: Signal<In, Bit>,
    /// Contexts that the core has.
    pub built: Signal<In, Bits<5>>,
    /// A command word is taken.
    pub accepts: Signal<In, Bit>,
    /// It.
    pub word: Signal<In, Bits<32>>,
    /// Forget the mesh.
    pub clears: Signal<Out, Bit>,
    /// Contexts that work.
    pub contexts: Signal<Out, Bits<5>>,
    /// The last command is a `Clear` for too many.
    pub is_refused: Signal<Out, Bit>,
    clearing: DFF<Bit>,
    working: DFF<Bits<5>>,
    refusing: DFF<Bit>,
    code: Signal<Local, Bits<8>>,
    asked: Signal<Local, Bits<8>>,
    wide_built: Signal<Local, Bits<8>>,
    is_clear: Signal<Local, Bit>,
    asks_too_much: Signal<Local, Bit>,
    is_granted: Signal<Local, Bit>,
    clear_code: Signal<Local, Bits<8>>,
    all_contexts: Signal<Local, Bits<8>>,
}

// The kernel names the opcode by number, because rust-hdl takes literals only; a change in the protocol must come here.
const _: () = assert!(Opcode::Clear as u8 == 2, "the opcode of this block follows the protocol");

impl Logic for ClearCommand {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, clearing, working, refusing);
        self.clear_code.next = 2.into();
        self.all_contexts.next = 0.into();
        self.clears.next = self.clearing.q.val();
        self.contexts.next = self.working.q.val();
        self.is_refused.next = self.refusing.q.val();

        self.code.next = self.word.val().get_bits::<8>(24);
        self.asked.next = self.word.val().get_bits::<8>(0);
        self.wide_built.next = bit_cast::<8, 5>(self.built.val());
        self.is_clear.next = self.code.val() == self.clear_code.val();
        self.asks_too_much.next = self.asked.val() > self.wide_built.val();
        self.is_granted.next = self.accepts.val() & self.is_clear.val() & (!self.asks_too_much.val());
        self.clearing.d.next = self.is_granted.val();
        if self.accepts.val() {
            self.refusing.d.next = self.is_clear.val() & self.asks_too_much.val();
        }
        if self.is_granted.val() {
            self.working.d.next = self.word.val().get_bits::<5>(0);
            if self.asked.val() == self.all_contexts.val() {
                self.working.d.next = self.built.val();
            }
        }
        if self.reset.val() {
            self.clearing.d.next = false;
            self.working.d.next = self.built.val();
        }
    }
}
