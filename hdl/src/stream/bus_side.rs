//! The half of the stream link in the clock of the bus: the AXI ports, the registers, and the bus's ends of both FIFOs.
//!
//! 1. All is in the bus's clock. A signal from the core's clock goes into a `Synchroniser` and nowhere else.

use super::answer_watch::AnswerWatch;
use super::axi::{AxiLite, AxisSink, AxisSource};
use super::beat_gate::BeatGate;
use super::register_block::RegisterBlock;
use super::reset_request::ResetRequest;
use crate::leaf::{Parameter, Synchroniser};
use crate::prelude::*;
use incircle_protocol::Config;

#[derive(LogicBlock, Default)]
pub struct BusSide<const W: usize, const K: usize, const E: usize> {
    /// The bus's clock and its reset, active low.
    pub clock: Signal<In, Clock>,
    pub bus_reset_n: Signal<In, Bit>,
    pub s_axis: AxisSink<W, K>,
    pub m_axis: AxisSource<W, K>,
    pub s_axi: AxiLite,
    /// The writer's side of the command FIFO.
    pub push: Signal<Out, Bit>,
    pub push_data: Signal<Out, Bits<W>>,
    pub is_full: Signal<In, Bit>,
    pub is_fetched: Signal<In, Bit>,
    /// The reader's side of the answer FIFO; the highest bit of an entry marks the last beat of an answer.
    pub entry_valid: Signal<In, Bit>,
    pub entry: Signal<In, Bits<E>>,
    pub pop: Signal<Out, Bit>,
    pub is_empty: Signal<In, Bit>,
    /// A reset of the core's side is wanted; a register, for the core's clock.
    pub request: Signal<Out, Bit>,
    /// Three registers in the core's clock: the core's side is in reset; `core_beat` toggles while that clock runs; the
    /// core's side holds words or is at work.
    pub reply: Signal<In, Bit>,
    pub core_beat: Signal<In, Bit>,
    pub core_busy: Signal<In, Bit>,
    /// The bus's side of both FIFOs is in reset.
    pub resets: Signal<Out, Bit>,
    gate: BeatGate<K>,
    watch: AnswerWatch<W>,
    registers: RegisterBlock,
    resetting: ResetRequest,
    reply_seen: Synchroniser<Bit>,
    beat_seen: Synchroniser<Bit>,
    busy_seen: Synchroniser<Bit>,
    /// The flag from the core's side comes late. Two more clocks of busy cover a beat that has left one side and is not
    /// yet seen on the other.
    busy_before: DFF<Bit>,
    busy_earlier: DFF<Bit>,
    reset: Signal<Local, Bit>,
    is_busy: Signal<Local, Bit>,
    last_mark: Signal<Local, Bits<E>>,
    is_last: Signal<Local, Bit>,
    all_bytes: Parameter<Bits<K>>,
    mark: Parameter<Bits<E>>,
}

impl<const W: usize, const K: usize, const E: usize> BusSide<W, K, E> {
    /// The bus's side of a core of this configuration.
    ///
    /// # Panics
    /// If K is not W / 8, or E not W + 1.
    pub fn new(config: Config) -> Self {
        assert!(K == W / 8 && E == W + 1, "a beat of {W} bits has {} bytes and makes entries of {} bits", W / 8, W + 1);
        let one: Bits<E> = Bits::from(1);
        Self {
            registers: RegisterBlock::new(config, W),
            all_bytes: Parameter::new(Bits::<K>::mask()),
            mark: Parameter::new(one << W as u64),
            ..Self::default()
        }
    }

    /// The bus's side of a core with runs of this configuration.
    ///
    /// # Panics
    /// As [`new`](Self::new).
    pub fn with_runs(config: Config) -> Self {
        Self { registers: RegisterBlock::with_runs(config, W), ..Self::new(config) }
    }
}

impl<const W: usize, const K: usize, const E: usize> Logic for BusSide<W, K, E> {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, busy_before, busy_earlier);
        clock!(self, clock, gate, watch, registers, resetting, reply_seen, beat_seen, busy_seen);

        AxiLite::link(&mut self.s_axi, &mut self.registers.s_axi);

        // Only `bus_reset_n` resets the registers and counters; a reset by the control register must leave
        // them as they are.
        self.reset.next = !self.bus_reset_n.val();
        self.gate.reset.next = self.reset.val();
        self.watch.reset.next = self.reset.val();
        self.registers.reset.next = self.reset.val();
        self.resetting.reset.next = self.reset.val();
        self.resetting.asks.next = self.registers.asks_reset.val();
        self.request.next = self.resetting.request.val();
        self.reply_seen.sent.next = self.reply.val();
        self.resetting.reply.next = self.reply_seen.received.val();
        self.beat_seen.sent.next = self.core_beat.val();
        self.resetting.core_beat.next = self.beat_seen.received.val();
        self.resets.next = self.reset.val() | self.resetting.resets.val();
        self.watch.resets.next = self.resetting.resets.val();
        self.registers.resets.next = self.resetting.resets.val();
        self.registers.core_runs.next = self.resetting.core_runs.val();

        // A beat that lacks bytes is taken like any other, or it would block the stream; `BeatGate` drops it.
        self.gate.s_axis_tvalid.next = self.s_axis.tvalid.val();
        self.gate.s_axis_tkeep.next = self.s_axis.tkeep.val();
        self.gate.is_full.next = self.is_full.val();
        self.s_axis.tready.next = !self.is_full.val();
        self.push.next = self.gate.push.val();
        self.push_data.next = self.s_axis.tdata.val();
        self.registers.commands.next = self.gate.events.val();

        self.last_mark.next = self.entry.val() & self.mark.val();
        self.is_last.next = self.last_mark.val().any();
        self.m_axis.tvalid.next = self.entry_valid.val();
        self.m_axis.tdata.next = bit_cast::<W, E>(self.entry.val());
        self.m_axis.tkeep.next = self.all_bytes.val();
        self.m_axis.tlast.next = self.is_last.val();
        self.pop.next = self.entry_valid.val() & self.m_axis.tready.val();
        self.watch.m_axis_tvalid.next = self.entry_valid.val();
        self.watch.m_axis_tready.next = self.m_axis.tready.val();
        self.watch.m_axis_tdata.next = bit_cast::<W, E>(self.entry.val());
        self.watch.m_axis_tlast.next = self.is_last.val();
        self.registers.answers.next = self.watch.events.val();

        self.busy_seen.sent.next = self.core_busy.val();
        self.is_busy.next = (!self.is_fetched.val()) | self.busy_seen.received.val() | (!self.is_empty.val());
        self.busy_before.d.next = self.is_busy.val();
        self.busy_earlier.d.next = self.busy_before.q.val();
        self.registers.is_busy.next = self.is_busy.val() | self.busy_before.q.val() | self.busy_earlier.q.val();
    }
}
