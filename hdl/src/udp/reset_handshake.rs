//! Resets both sides of a device with two clocks: the core's side leaves its reset after the port's side has been in
//! reset for 8 of its own clocks, however long the clock of the port stands.
//!
//! 1. A `reset` of 4 clocks of the core begins a reset, also while another reset is under way.
//! 2. `core_resets` is 1 until the reset has ended on the port's side. Both pointers of a FIFO between the clocks are
//!    therefore cleared before either side uses it.
//! 3. A reset that has begun does not end on either side while `reset` is 1.
//! 4. The registers have no reset of their own. They begin at 0, as those of an FPGA do. From other contents they come
//!    to rest as well, but the first reset may then be shorter on the port's side.
//!
//! Latency: 3 clocks of the core from `reset` to `core_resets`, perhaps one more. With both clocks running, a short
//! reset takes 14 to 16 clocks of the port and 9 to 12 of the core.
//!
//! A reset of four clocks at equal clocks:
//! ```text
//! clock             0  1  2  3  4  5  6  7  8  9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25
//! reset           ___/^^^^^^^^^^^\______________________________________________________________
//! core_resets     ____________/^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^\_____
//! port_resets     _____________________/^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^\_________________
//! ```
//!
//! Source: the handshake of four phases, in which each of two flags waits for the other.

use crate::leaf::Synchroniser;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct ResetHandshake {
    pub core_clock: Signal<In, Clock>,
    pub port_clock: Signal<In, Clock>,
    /// Begins a reset; may change at any time.
    pub reset: Signal<In, Bit>,
    /// The core's side is in reset; a register of the core's clock.
    pub core_resets: Signal<Out, Bit>,
    /// The port's side is in reset; a register of the port's clock.
    pub port_resets: Signal<Out, Bit>,
    reset_seen: Synchroniser<Bit>,
    request_seen: Synchroniser<Bit>,
    reply_seen: Synchroniser<Bit>,
    /// A reset was asked for and has not begun: an earlier one has to end first.
    is_wanted: DFF<Bit>,
    is_requested: DFF<Bit>,
    core_is_resetting: DFF<Bit>,
    /// Clocks of the port that the request has lasted, without those of whole rounds of eight.
    clocks: DFF<Bits<3>>,
    is_replied: DFF<Bit>,
    most: Signal<Local, Bits<3>>,
    one: Signal<Local, Bits<3>>,
    begins: Signal<Local, Bit>,
}

impl ResetHandshake {
    /// Clocks of the port from the request to the reply.
    pub const PORT_CLOCKS: u32 = 8;
}

impl Logic for ResetHandshake {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, core_clock, is_wanted, is_requested, core_is_resetting);
        dff_setup!(self, port_clock, clocks, is_replied);
        clock!(self, core_clock, reset_seen, reply_seen);
        clock!(self, port_clock, request_seen);
        self.most.next = 7.into();
        self.one.next = 1.into();
        self.reset_seen.sent.next = self.reset.val();
        self.request_seen.sent.next = self.is_requested.q.val();
        self.reply_seen.sent.next = self.is_replied.q.val();

        self.begins.next = self.is_wanted.q.val() & (!self.is_requested.q.val()) & (!self.reply_seen.received.val());
        if self.reset_seen.received.val() & (!self.is_requested.q.val()) {
            self.is_wanted.d.next = true;
        }
        if self.begins.val() {
            self.is_wanted.d.next = false;
            self.is_requested.d.next = true;
        }
        // A request that ended earlier could leave the port's side without a reset.
        if self.is_requested.q.val() & self.reply_seen.received.val() & (!self.reset_seen.received.val()) {
            self.is_requested.d.next = false;
        }
        self.core_is_resetting.d.next = self.reset_seen.received.val()
            | self.is_wanted.q.val()
            | self.is_requested.q.val()
            | self.reply_seen.received.val();
        self.core_resets.next = self.core_is_resetting.q.val();

        self.clocks.d.next = self.clocks.q.val() + self.one.val();
        if self.clocks.q.val() == self.most.val() {
            self.is_replied.d.next = true;
        }
        if !self.request_seen.received.val() {
            self.clocks.d.next = 0.into();
            self.is_replied.d.next = false;
        }
        // The reply falls one clock after the port's side has left its reset, so the core's side leaves its own later.
        self.port_resets.next = self.request_seen.received.val();
    }
}
