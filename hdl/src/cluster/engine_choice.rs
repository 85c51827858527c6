//! Chooses the next engine in turn: for a job, or for an answer.
//!
//! 1. The engines form a circle. The search begins behind `current` and ends with `current` itself. The choice is the
//!    first engine that is free and not stuck. If all engines are stuck, it is the first that is free.
//!
//! Latency: 1 clock.

use super::types::EngineFlags;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct EngineChoice {
    pub clock: Signal<In, Clock>,
    /// After a reset there is no choice until the clock after.
    pub reset: Signal<In, Bit>,
    /// The engine behind which the search begins: that of the present job, or of the last answer.
    pub current: Signal<In, Bits<2>>,
    /// The engine may be chosen (`free`): for the router, because it owes no answer; for the collector, because it
    /// offers one. The engine has said `Stuck`, or is not there (`stuck`).
    pub free: Signal<In, EngineFlags>,
    pub stuck: Signal<In, EngineFlags>,
    /// The choice, if there is one.
    pub target: Signal<Out, Bits<2>>,
    pub has_target: Signal<Out, Bit>,
    next_engine: DFF<Bits<2>>,
    is_there: DFF<Bit>,
    all_are_stuck: Signal<Local, Bit>,
    can0: Signal<Local, Bit>,
    can1: Signal<Local, Bit>,
    can2: Signal<Local, Bit>,
    can3: Signal<Local, Bit>,
}

impl Logic for EngineChoice {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, next_engine, is_there);
        self.target.next = self.next_engine.q.val();
        self.has_target.next = self.is_there.q.val();
        self.all_are_stuck.next =
            self.stuck.val().engine0 & self.stuck.val().engine1 & self.stuck.val().engine2 & self.stuck.val().engine3;
        self.can0.next = self.free.val().engine0 & (self.all_are_stuck.val() | (!self.stuck.val().engine0));
        self.can1.next = self.free.val().engine1 & (self.all_are_stuck.val() | (!self.stuck.val().engine1));
        self.can2.next = self.free.val().engine2 & (self.all_are_stuck.val() | (!self.stuck.val().engine2));
        self.can3.next = self.free.val().engine3 & (self.all_are_stuck.val() | (!self.stuck.val().engine3));
        self.is_there.d.next = self.can0.val() | self.can1.val() | self.can2.val() | self.can3.val();
        self.next_engine.d.next = self.current.val();
        match self.current.val().index() {
            0 => {
                if self.can1.val() {
                    self.next_engine.d.next = 1.into();
                } else if self.can2.val() {
                    self.next_engine.d.next = 2.into();
                } else if self.can3.val() {
                    self.next_engine.d.next = 3.into();
                }
            }
            1 => {
                if self.can2.val() {
                    self.next_engine.d.next = 2.into();
                } else if self.can3.val() {
                    self.next_engine.d.next = 3.into();
                } else if self.can0.val() {
                    self.next_engine.d.next = 0.into();
                }
            }
            2 => {
                if self.can3.val() {
                    self.next_engine.d.next = 3.into();
                } else if self.can0.val() {
                    self.next_engine.d.next = 0.into();
                } else if self.can1.val() {
                    self.next_engine.d.next = 1.into();
                }
            }
            _ => {
                if self.can0.val() {
                    self.next_engine.d.next = 0.into();
                } else if self.can1.val() {
                    self.next_engine.d.next = 1.into();
                } else if self.can2.val() {
                    self.next_engine.d.next = 2.into();
                }
            }
        }
        if self.reset.val() {
            self.is_there.d.next = false;
        }
    }
}
