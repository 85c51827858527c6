//! The registers behind an AXI4-Lite port: the identity of the device, control, status, errors and counters.
//!
//! 1. `protocol/STREAM.md` lists the registers and their bits. All bits that can be written are in the low byte.
//! 2. An error stays until the host clears it, and an error that comes in the clock of its clearing stays too. The
//!    header of the last failed answer stays until `reset`.
//!
//! Latency: that of [`RegisterPort`]; 1 clock from an event to its register.

use super::axi::{AxiLite, RegisterIndex};
use super::device_identity::DeviceIdentity;
use super::events::{AnswerEvents, CommandEvents};
use super::register_port::RegisterPort;
use super::traffic::Traffic;
use crate::commands::types::Word;
use crate::prelude::*;
use incircle_protocol::{Config, StreamRegister};

#[derive(LogicBlock, Default)]
pub struct RegisterBlock {
    /// The bus's clock and reset.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    pub s_axi: AxiLite,
    /// Inputs of the status register: a reset is under way; the core's clock runs; the link holds words or the
    /// core is at work.
    pub resets: Signal<In, Bit>,
    pub core_runs: Signal<In, Bit>,
    pub is_busy: Signal<In, Bit>,
    /// Events on the two streams.
    pub commands: Signal<In, CommandEvents>,
    pub answers: Signal<In, AnswerEvents>,
    /// The host writes a reset to the control register at this edge.
    pub asks_reset: Signal<Out, Bit>,
    port: RegisterPort,
    identity: DeviceIdentity,
    traffic: Traffic,
    was_dropped: DFF<Bit>,
    has_failed: DFF<Bit>,
    fault: DFF<Word>,
    read_index: Signal<Local, RegisterIndex>,
    write_index: Signal<Local, RegisterIndex>,
    writes_control: Signal<Local, Bit>,
    writes_errors: Signal<Local, Bit>,
    writes_low: Signal<Local, Bit>,
    runs_bit: Signal<Local, Word>,
    busy_bit: Signal<Local, Word>,
    resets_bit: Signal<Local, Word>,
    error_bit: Signal<Local, Word>,
    control: Signal<Local, Word>,
    dropped_bit: Signal<Local, Word>,
    failed_bit: Signal<Local, Word>,
    control_index: Signal<Local, RegisterIndex>,
    errors_index: Signal<Local, RegisterIndex>,
}

// The kernel holds the offsets as literals, because rust-hdl allows no constants there. A changed protocol fails here.
const _: () = assert!(
    StreamRegister::Control.offset() == 4 * 16
        && StreamRegister::Status.offset() == 4 * 17
        && StreamRegister::Errors.offset() == 4 * 18
        && StreamRegister::Fault.offset() == 4 * 19,
    "the offsets of this block follow the protocol"
);

impl RegisterBlock {
    /// The registers of a core of this configuration behind streams with beats of `beat_bits` bits.
    pub fn new(config: Config, beat_bits: usize) -> Self {
        Self { identity: DeviceIdentity::new(config, beat_bits), ..Self::default() }
    }

    /// The registers of a core with runs of this configuration behind such streams.
    pub fn with_runs(config: Config, beat_bits: usize) -> Self {
        Self { identity: DeviceIdentity::with_runs(config, beat_bits), ..Self::default() }
    }
}

impl Logic for RegisterBlock {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, was_dropped, has_failed, fault);
        clock!(self, clock, port, traffic);
        AxiLite::link(&mut self.s_axi, &mut self.port.s_axi);
        self.port.reset.next = self.reset.val();
        self.control_index.next = 16.into();
        self.errors_index.next = 18.into();

        // Events come behind the writes that clear them, so that an error in the very clock of its
        // clearing is not lost.
        self.write_index.next = self.port.write_address.val().get_bits::<10>(2);
        self.writes_control.next = self.write_index.val() == self.control_index.val();
        self.writes_errors.next = self.write_index.val() == self.errors_index.val();
        self.port.write_is_known.next = self.writes_control.val() | self.writes_errors.val();
        self.writes_low.next = self.port.write_enable.val() & self.port.write_bytes.val().get_bit(0);
        self.asks_reset.next =
            self.writes_low.val() & self.writes_control.val() & self.port.write_data.val().get_bit(0);
        if self.writes_low.val() & self.writes_errors.val() & self.port.write_data.val().get_bit(0) {
            self.was_dropped.d.next = false;
        }
        if self.writes_low.val() & self.writes_errors.val() & self.port.write_data.val().get_bit(1) {
            self.has_failed.d.next = false;
        }
        if self.commands.val().dropped {
            self.was_dropped.d.next = true;
        }
        if self.answers.val().failed {
            self.has_failed.d.next = true;
            self.fault.d.next = self.answers.val().header;
        }
        if self.reset.val() {
            self.was_dropped.d.next = false;
            self.has_failed.d.next = false;
            self.fault.d.next = 0.into();
        }

        // Each bit is a word with the bit in its place, so that a read only joins words.
        self.runs_bit.next = 0.into();
        self.busy_bit.next = 0.into();
        self.resets_bit.next = 0.into();
        self.error_bit.next = 0.into();
        self.control.next = 0.into();
        self.dropped_bit.next = 0.into();
        self.failed_bit.next = 0.into();
        if self.core_runs.val() & (!self.resets.val()) {
            self.runs_bit.next = 1.into();
        }
        if self.is_busy.val() {
            self.busy_bit.next = 2.into();
        }
        if self.resets.val() {
            self.resets_bit.next = 4.into();
            self.control.next = 1.into();
        }
        if self.was_dropped.q.val() | self.has_failed.q.val() {
            self.error_bit.next = 8.into();
        }
        if self.was_dropped.q.val() {
            self.dropped_bit.next = 1.into();
        }
        if self.has_failed.q.val() {
            self.failed_bit.next = 2.into();
        }

        // The identity and the counters each give 0 for an index that is not theirs, so their values can be joined.
        self.read_index.next = self.port.read_address.val().get_bits::<10>(2);
        self.identity.index.next = self.read_index.val();
        self.traffic.reset.next = self.reset.val();
        self.traffic.commands.next = self.commands.val();
        self.traffic.answers.next = self.answers.val();
        self.traffic.index.next = self.read_index.val();
        self.traffic.reads.next = self.port.read_enable.val();
        self.port.read_is_known.next = true;
        match self.read_index.val().index() {
            16 => {
                self.port.read_data.next = self.control.val();
            }
            17 => {
                self.port.read_data.next =
                    self.runs_bit.val() | self.busy_bit.val() | self.resets_bit.val() | self.error_bit.val()
            }
            18 => {
                self.port.read_data.next = self.dropped_bit.val() | self.failed_bit.val();
            }
            19 => {
                self.port.read_data.next = self.fault.q.val();
            }
            _ => {
                self.port.read_data.next = self.identity.value.val() | self.traffic.value.val();
                self.port.read_is_known.next = self.identity.is_known.val() | self.traffic.is_known.val();
            }
        }
    }
}
