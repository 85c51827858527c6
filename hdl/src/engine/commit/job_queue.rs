//! Queues commit jobs or release jobs, first come, first served: each takes many clocks, and others come meanwhile.
//!
//! 1. Every context has at most one job in a queue, so there is a place for each.
//!
//! Latency: 1 clock. A job first goes into a register, because `enable` comes late in its clock. `takes` may come as
//! late: a job is stored even if it is taken at once, so only the pointer to the oldest job waits for `takes`.
//! ```text
//! enable          ___/^^\__/^^^^^\______________
//! job               .  5  .  6  7  .  .  .  .  .
//! takes           /^^^^^^^^^^^\_____/^^\________
//! waits           ______/^^\__/^^^^^^^^^^^^^^^^^
//! head              .  .  5  .  6  6  6  7  7  7
//! ```

use crate::engine::types::CONTEXT_BITS;
use crate::leaf::{LutMemory, Parameter};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct JobQueue<const D: usize> {
    pub clock: Signal<In, Clock>,
    /// Reset forgets all jobs.
    pub reset: Signal<In, Bit>,
    /// A job enters the queue at this edge.
    pub enable: Signal<In, Bit>,
    pub job: Signal<In, Bits<D>>,
    /// A job waits, and `head` is the oldest one.
    pub waits: Signal<Out, Bit>,
    pub head: Signal<Out, Bits<D>>,
    /// The head is taken at this edge, if there is one.
    pub takes: Signal<In, Bit>,
    arrived: DFF<Bit>,
    arrival: DFF<Bits<D>>,
    jobs: LutMemory<CONTEXT_BITS, D>,
    /// A job waits that came before the one in the register.
    holds_jobs: DFF<Bit>,
    newest: DFF<Bits<CONTEXT_BITS>>,
    oldest: DFF<Bits<CONTEXT_BITS>>,
    pops: Signal<Local, Bit>,
    after_newest: Signal<Local, Bits<CONTEXT_BITS>>,
    after_oldest: Signal<Local, Bits<CONTEXT_BITS>>,
    more_wait: Signal<Local, Bit>,
    one: Parameter<Bits<CONTEXT_BITS>>,
    nothing: Parameter<Bits<CONTEXT_BITS>>,
}

impl<const D: usize> JobQueue<D> {
    /// Builds a queue of `2^context_bits` jobs.
    ///
    /// # Panics
    ///
    /// If `context_bits` is not in `1..=CONTEXT_BITS`.
    pub fn new(context_bits: usize) -> Self {
        Self {
            jobs: LutMemory::new(context_bits, D),
            one: Parameter::new(Bits::from(1)),
            nothing: Parameter::new(Bits::default()),
            ..Self::default()
        }
    }
}

impl<const D: usize> Logic for JobQueue<D> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, arrived, arrival, holds_jobs, newest, oldest);
        clock!(self, clock, jobs);
        self.arrived.d.next = self.enable.val() & (!self.reset.val());
        self.arrival.d.next = self.job.val();
        self.after_newest.next = self.newest.q.val() + self.one.val();
        self.after_oldest.next = self.oldest.q.val() + self.one.val();
        self.more_wait.next = self.after_oldest.val() != self.newest.q.val();
        self.waits.next = self.holds_jobs.q.val() | self.arrived.q.val();
        self.pops.next = self.takes.val() & self.waits.val();
        self.jobs.read_address.next = self.oldest.q.val();
        self.head.next = self.arrival.q.val();
        if self.holds_jobs.q.val() {
            self.head.next = self.jobs.read_data.val();
        }

        self.jobs.write_address.next = self.newest.q.val();
        self.jobs.write_data.next = self.arrival.q.val();
        self.jobs.write_enable.next = self.arrived.q.val();
        if self.arrived.q.val() {
            self.newest.d.next = self.after_newest.val();
            self.holds_jobs.d.next = self.holds_jobs.q.val() | (!self.pops.val());
        }
        if self.pops.val() {
            self.oldest.d.next = self.after_oldest.val();
            if !self.arrived.q.val() {
                self.holds_jobs.d.next = self.more_wait.val();
            }
        }
        if self.reset.val() {
            self.holds_jobs.d.next = false;
            self.newest.d.next = self.nothing.val();
            self.oldest.d.next = self.nothing.val();
        }
    }
}
