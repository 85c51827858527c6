//! Jobs of contexts, first come first served.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | reset forgets all jobs |
//! | `enable`, `job` | in | 1, D | a job comes |
//! | `waits`, `head` | out | 1, D | there is a job; the oldest one |
//! | `takes` | in | 1 | the head is taken at this edge, if there is one |
//!
//! 1. Every context has one job here at most, so there is a place for each.
//!
//! Latency: 1 clock. The job stands in a register first: those who find out that there is one need all of their clock.
//! ```text
//! enable          ___/^^\__/^^^^^\______________
//! job               .  5  .  6  7  .  .  .  .  .
//! takes           /^^^^^^^^^^^\_____/^^\________
//! waits           ______/^^\__/^^^^^^^^^^^^^^^^^
//! head              .  .  5  .  6  6  6  7  7  7
//! ```

use super::CONTEXT_BITS;
use crate::leaf::Fifo;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// A queue of jobs; see the top of this file.
#[derive(LogicBlock)]
pub struct JobQueue<const D: usize> {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Forgets all jobs.
    pub reset: Signal<In, Bit>,
    /// A job comes.
    pub enable: Signal<In, Bit>,
    /// The job.
    pub job: Signal<In, Bits<D>>,
    /// The head is taken.
    pub takes: Signal<In, Bit>,
    /// There is a job.
    pub waits: Signal<Out, Bit>,
    /// The oldest one.
    pub head: Signal<Out, Bits<D>>,
    arrived: DFF<Bit>,
    arrival: DFF<Bits<D>>,
    queue: Fifo<CONTEXT_BITS, D>,
}

impl<const D: usize> JobQueue<D> {
    /// A queue of `2^context_bits` jobs.
    ///
    /// # Panics
    /// If `context_bits` is not in `1..=CONTEXT_BITS`.
    pub fn new(context_bits: usize) -> Self {
        Self {
            clock: Signal::default(),
            reset: Signal::default(),
            enable: Signal::default(),
            job: Signal::default(),
            takes: Signal::default(),
            waits: Signal::default(),
            head: Signal::default(),
            arrived: DFF::default(),
            arrival: DFF::default(),
            queue: Fifo::new(context_bits, D),
        }
    }
}

impl<const D: usize> Default for JobQueue<D> {
    fn default() -> Self {
        Self::new(CONTEXT_BITS)
    }
}

impl<const D: usize> Logic for JobQueue<D> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, arrived, arrival);
        clock!(self, clock, queue);
        self.arrived.d.next = self.enable.val() & (!self.reset.val());
        self.arrival.d.next = self.job.val();
        self.queue.reset.next = self.reset.val();
        self.queue.push.next = self.arrived.q.val();
        self.queue.push_data.next = self.arrival.q.val();
        self.waits.next = self.queue.valid.val();
        self.head.next = self.queue.data.val();
        self.queue.pop.next = self.takes.val() & self.queue.valid.val();
    }
}
