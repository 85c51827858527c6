//! Counts the halves of words that the packer of records keeps for its next beat, and says when a beat is full.
//!
//! 1. A record brings six halves, the vertices of one bring three, and those with short ids two, or four with the rests
//!    of a group. A beat has four.
//! 2. What the last record leaves, or two whole records together, becomes a beat in the next clock.
//!
//! Latency: none from a record to `fills`.

use crate::prelude::*;

/// Number of halves that earlier records left to the next beat.
#[derive(Clone, Copy, Debug, PartialEq, LogicState)]
pub enum KeptNumber {
    /// No half.
    Zero,
    /// One half.
    One,
    /// Two halves.
    Two,
    /// Three halves.
    Three,
    /// As many as the next beat has: no record adds any to it.
    Rest,
}

#[derive(LogicBlock, Default)]
pub struct KeptHalves {
    pub clock: Signal<In, Clock>,
    /// A reset drops the halves.
    pub reset: Signal<In, Bit>,
    /// The payload has the vertices of the records alone; it has them with short ids.
    pub vertices_alone: Signal<In, Bit>,
    pub has_short_ids: Signal<In, Bit>,
    /// A record comes; it is the last one; it brings the rests of its group.
    pub comes: Signal<In, Bit>,
    pub is_last: Signal<In, Bit>,
    pub brings_rests: Signal<In, Bit>,
    /// The last record has come.
    pub all_came: Signal<In, Bit>,
    pub number: Signal<Out, KeptNumber>,
    /// A beat is full, or the kept halves become one: they all leave the packer, or others take their place (`moves`).
    pub fills: Signal<Out, Bit>,
    pub moves: Signal<Out, Bit>,
    /// That beat has two words; it is the last one.
    pub both: Signal<Out, Bit>,
    pub last: Signal<Out, Bit>,
    kept: DFF<KeptNumber>,
    /// The kept halves are more than two.
    many_are_kept: DFF<Bit>,
    /// The number of halves that the record leaves to the next beat.
    leaves: Signal<Local, KeptNumber>,
    leaves_none: Signal<Local, Bit>,
    is_rest: Signal<Local, Bit>,
    takes: Signal<Local, Bit>,
}

impl Logic for KeptHalves {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, kept, many_are_kept);
        self.number.next = self.kept.q.val();
        self.is_rest.next = self.kept.q.val() == KeptNumber::Rest;
        self.takes.next = self.comes.val() | self.is_rest.val();
        self.moves.next = self.takes.val();
        self.fills.next = self.takes.val();
        self.leaves.next = KeptNumber::Zero;
        match self.kept.q.val() {
            KeptNumber::Zero => {
                if !self.brings_rests.val() {
                    self.leaves.next = KeptNumber::Two;
                }
                if self.vertices_alone.val() {
                    self.fills.next = self.comes.val() & self.brings_rests.val();
                    if !self.has_short_ids.val() {
                        self.leaves.next = KeptNumber::Three;
                    }
                }
            }
            KeptNumber::Two => {
                if !self.has_short_ids.val() {
                    self.leaves.next = KeptNumber::One;
                }
                if self.brings_rests.val() {
                    self.leaves.next = KeptNumber::Two;
                }
                if !self.vertices_alone.val() {
                    self.leaves.next = KeptNumber::Rest;
                }
            }
            KeptNumber::Three => {
                self.leaves.next = KeptNumber::Two;
            }
            _ => {}
        }
        self.leaves_none.next = self.leaves.val() == KeptNumber::Zero;
        self.both.next = self.many_are_kept.q.val() | (!self.is_rest.val());
        self.last.next = self.is_last.val() & self.leaves_none.val();
        if self.is_rest.val() {
            self.last.next = self.all_came.val();
        }
        if self.takes.val() {
            self.many_are_kept.d.next =
                (self.leaves.val() == KeptNumber::Three) | (self.leaves.val() == KeptNumber::Rest);
            self.kept.d.next = self.leaves.val();
            if self.is_last.val() & (!self.leaves_none.val()) {
                self.kept.d.next = KeptNumber::Rest;
            }
        }
        if self.reset.val() {
            self.kept.d.next = KeptNumber::Zero;
        }
    }
}
