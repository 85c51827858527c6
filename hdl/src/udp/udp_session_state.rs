//! The session: whether one is open, and the number of the `Data` datagram that the device awaits. Address, port and
//! number of the session are in [`SenderStore`](super::SenderStore).
//!
//! 1. `forgets` is high while no session is open, and in the first clock of one.
//! 2. `fails` comes only while no datagram is being carried out.
//!
//! Latency: 1 clock from `asks` or `fails` to `session`.
//!
//! A session that takes two `Data`, with a gap before the second one:
//! ```text
//! clock              0  1  2  3  4  5  6  7  8  9 10 11 12
//! asks.opens       ___/^^\________________________________
//! asks.takes       ____________/^^\________/^^\___________
//! asks.gap         __________________/^^\_________________
//! asks.closes      ______________________________/^^\_____
//! session.is_open  ______/^^^^^^^^^^^^^^^^^^^^^^^^^^\_____
//! session.expected   0  0  0  0  0  1  1  1  1  2  2  0  0
//! saw_gap          _____________________/^^^^^\___________
//! forgets          /^^^^^^^^\_______________________/^^^^^
//! ```

use super::types::{DatagramAsks, UdpSession};
use crate::commands::types::Word;
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct UdpSessionState {
    /// After a reset no session is open.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    pub asks: Signal<In, DatagramAsks>,
    /// Silence: the session ends at this edge.
    pub fails: Signal<In, Bit>,
    pub session: Signal<Out, UdpSession>,
    /// Since the last `Data` that was taken, one came behind a gap or without room in the FIFO.
    pub saw_gap: Signal<Out, Bit>,
    /// All that belongs to a session is void.
    pub forgets: Signal<Out, Bit>,
    opened: DFF<Bit>,
    awaited: DFF<Word>,
    gap: DFF<Bit>,
    begins: DFF<Bit>,
    one: Signal<Local, Word>,
}

impl Logic for UdpSessionState {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, opened, awaited, gap, begins);
        self.one.next = 1.into();
        self.session.next.is_open = self.opened.q.val();
        self.session.next.expected = self.awaited.q.val();
        self.saw_gap.next = self.gap.q.val();
        self.forgets.next = self.begins.q.val() | (!self.opened.q.val());
        self.begins.d.next = self.asks.val().opens;
        if self.asks.val().takes {
            self.awaited.d.next = self.awaited.q.val() + self.one.val();
            self.gap.d.next = false;
        }
        if self.asks.val().gap {
            self.gap.d.next = true;
        }
        if self.asks.val().opens {
            self.opened.d.next = true;
        }
        if self.asks.val().closes | self.fails.val() | self.reset.val() {
            self.opened.d.next = false;
            self.awaited.d.next = 0.into();
            self.gap.d.next = false;
        }
    }
}
