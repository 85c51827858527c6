//! Carries out a `Clear`: the mesh is forgotten, and the command says how many contexts work from then on, and on how
//! many jobs.
//!
//! 1. The low byte of the word is the number of contexts; 0 means all.
//! 2. Bit 8 begins a batch of as many jobs as bits 15 to 9 say; 0 means one for each context. Outside a batch there is
//!    one job.
//! 3. A number of jobs that does not divide that of the contexts is refused, and so are more contexts than there are. A
//!    refused `Clear` changes nothing but the tag, in bits 23 to 16. After a reset there is no batch, and the tag is 0.
//! 4. To divide, the block subtracts the number of jobs from the number of contexts, once a clock (`is_checking`),
//!    until no more contexts are left than there are jobs. If the two numbers are then equal, the `Clear` is granted.
//!
//! Latency: 2 clocks from the word to `clears`, and one more for each further context of a team in a batch; 1 more to
//! `deal.dealt_from`.

use super::types::{Clearing, TakenWord, Word};
use crate::engine::Deal;
use crate::prelude::*;
use incircle_protocol::{Opcode, CLEAR_BATCH, CLEAR_MESHES_SHIFT, CLEAR_TAG_SHIFT, MAX_SIDE_BY_SIDE};

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
    /// Numbers of contexts that work and of jobs, and which points belong to them.
    pub deal: Signal<Out, Deal>,
    clears: DFF<Bit>,
    working: DFF<Bits<5>>,
    jobs: DFF<Bits<5>>,
    dealt: DFF<Bits<7>>,
    refusing: DFF<Bit>,
    tag: DFF<Bits<8>>,
    /// The numbers that are being checked (the number of jobs is 0 unless `names_jobs`), and the contexts that are
    /// left.
    checking: DFF<Bit>,
    wanted: DFF<Bits<5>>,
    wanted_jobs: DFF<Bits<7>>,
    is_batch: DFF<Bit>,
    names_jobs: DFF<Bit>,
    left: DFF<Bits<5>>,
    word: Signal<Local, Word>,
    code: Signal<Local, Bits<8>>,
    asked: Signal<Local, Bits<8>>,
    wide_built: Signal<Local, Bits<8>>,
    is_clear: Signal<Local, Bit>,
    asks_too_much: Signal<Local, Bit>,
    is_granted: Signal<Local, Bit>,
    named_jobs: Signal<Local, Bits<7>>,
    checked_jobs: Signal<Local, Bits<7>>,
    wide_left: Signal<Local, Bits<7>>,
    rest: Signal<Local, Bits<7>>,
    is_reached: Signal<Local, Bit>,
    is_passed: Signal<Local, Bit>,
    wide_jobs: Signal<Local, Bits<7>>,
    twice_jobs: Signal<Local, Bits<7>>,
    clear_code: Signal<Local, Bits<8>>,
    all_contexts: Signal<Local, Bits<8>>,
}

// The kernel holds the numbers as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = assert!(
    Opcode::Clear as u8 == 2
        && CLEAR_BATCH == 1 << 8
        && CLEAR_MESHES_SHIFT == 9
        && MAX_SIDE_BY_SIDE == 127
        && CLEAR_TAG_SHIFT == 16,
    "the numbers of this block follow the protocol"
);

impl Logic for ClearCommand {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, clears, working, jobs, dealt, refusing, tag);
        dff_setup!(self, clock, checking, wanted, wanted_jobs, is_batch, names_jobs, left);
        self.clear_code.next = 2.into();
        self.all_contexts.next = 0.into();
        self.clearing.next.clears = self.clears.q.val();
        self.clearing.next.is_checking = self.checking.q.val();
        self.clearing.next.is_refused = self.refusing.q.val();
        self.clearing.next.tag = self.tag.q.val();
        self.deal.next.contexts = self.working.q.val();
        self.deal.next.jobs = self.jobs.q.val();
        self.deal.next.dealt_from = self.dealt.q.val();

        self.word.next = self.taken.val().word;
        self.code.next = self.word.val().get_bits::<8>(24);
        self.asked.next = self.word.val().get_bits::<8>(0);
        self.named_jobs.next = self.word.val().get_bits::<7>(9);
        self.wide_built.next = bit_cast::<8, 5>(self.built.val());
        self.is_clear.next = self.code.val() == self.clear_code.val();
        self.asks_too_much.next = self.asked.val() > self.wide_built.val();
        if self.taken.val().is_command & self.is_clear.val() {
            self.tag.d.next = self.word.val().get_bits::<8>(16);
        }
        if self.taken.val().is_command {
            self.refusing.d.next = self.is_clear.val() & self.asks_too_much.val();
            self.checking.d.next = self.is_clear.val() & (!self.asks_too_much.val());
            self.is_batch.d.next = self.word.val().get_bit(8);
            self.wanted_jobs.d.next = self.named_jobs.val();
            self.names_jobs.d.next = self.named_jobs.val().any();
            self.wanted.d.next = self.word.val().get_bits::<5>(0);
            self.left.d.next = self.word.val().get_bits::<5>(0);
            if self.asked.val() == self.all_contexts.val() {
                self.wanted.d.next = self.built.val();
                self.left.d.next = self.built.val();
            }
        }

        self.checked_jobs.next = self.wanted_jobs.q.val();
        if !self.names_jobs.q.val() {
            self.checked_jobs.next = bit_cast::<7, 5>(self.wanted.q.val());
        }
        if !self.is_batch.q.val() {
            self.checked_jobs.next = 1.into();
        }
        // A comparison behind the difference would limit the clock of the core.
        self.wide_left.next = bit_cast::<7, 5>(self.left.q.val());
        self.rest.next = self.wide_left.val() - self.checked_jobs.val();
        self.is_reached.next = (self.checked_jobs.val() == self.wide_left.val()) | (!self.is_batch.q.val());
        self.is_passed.next = self.checked_jobs.val() > self.wide_left.val();
        self.is_granted.next = self.checking.q.val() & self.is_reached.val();
        self.clears.d.next = self.is_granted.val();
        if self.checking.q.val() {
            self.left.d.next = self.rest.val().get_bits::<5>(0);
            self.checking.d.next = (!self.is_reached.val()) & (!self.is_passed.val());
            self.refusing.d.next = (!self.is_reached.val()) & self.is_passed.val();
        }
        if self.is_granted.val() {
            self.working.d.next = self.wanted.q.val();
            self.jobs.d.next = self.checked_jobs.val().get_bits::<5>(0);
        }
        self.wide_jobs.next = bit_cast::<7, 5>(self.jobs.q.val());
        self.twice_jobs.next = self.wide_jobs.val() + self.wide_jobs.val();
        self.dealt.d.next = self.twice_jobs.val() + self.wide_jobs.val();
        if self.reset.val() {
            self.clears.d.next = false;
            self.checking.d.next = false;
            self.jobs.d.next = 1.into();
            self.tag.d.next = 0.into();
            self.dealt.d.next = 3.into();
            self.working.d.next = self.built.val();
        }
    }
}
