//! The session: whether one is open, its number, and the number of the `Data` frame that the device awaits.
//!
//! 1. `forgets` is high for at least one clock when a session begins, even if one was open before.
//! 2. An `Open` in the very clock of `fails` opens a session.
//! 3. `settles` stays high for 7 clocks after a change, so that number, credit and digest in the header of a frame
//!    belong to the same moment.
//!
//! Latency: 1 clock from `asked` or `fails` to `open`.

use super::frame_judge::Asked;
use super::types::{Byte, Session};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct SessionState {
    /// After a reset no session is open.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// The request of a frame, and the session that the frame names.
    pub asked: Signal<In, Asked>,
    pub session: Signal<In, Byte>,
    /// Silence or a break: the session ends at this edge.
    pub fails: Signal<In, Bit>,
    pub open: Signal<Out, Session>,
    /// Since the last `Data` that was taken, one came behind a gap or without room in the FIFO.
    pub saw_gap: Signal<Out, Bit>,
    /// All that belongs to a session is void: no session is open, or one begins.
    pub forgets: Signal<Out, Bit>,
    /// A change has not settled: no frame to the host may begin.
    pub settles: Signal<Out, Bit>,
    opened: DFF<Bit>,
    session_number: DFF<Byte>,
    awaited: DFF<Byte>,
    gap: DFF<Bit>,
    begins: DFF<Bit>,
    settling: DFF<Bits<3>>,
    one: Signal<Local, Byte>,
    one_clock: Signal<Local, Bits<3>>,
}

impl Logic for SessionState {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, opened, session_number, awaited, gap, begins, settling);
        self.one.next = 1.into();
        self.one_clock.next = 1.into();
        self.open.next.is_open = self.opened.q.val();
        self.open.next.number = self.session_number.q.val();
        self.open.next.expected = self.awaited.q.val();
        self.saw_gap.next = self.gap.q.val();
        self.forgets.next = self.begins.q.val() | (!self.opened.q.val());
        self.settles.next = self.settling.q.val().any();

        if self.settling.q.val().any() {
            self.settling.d.next = self.settling.q.val() - self.one_clock.val();
        }
        if self.asked.val().hears {
            self.settling.d.next = 7.into();
        }
        if self.asked.val().takes {
            self.awaited.d.next = self.awaited.q.val() + self.one.val();
            self.gap.d.next = false;
        }
        if self.asked.val().gap {
            self.gap.d.next = true;
        }
        if self.asked.val().closes | self.fails.val() | self.reset.val() {
            self.opened.d.next = false;
            self.session_number.d.next = 0.into();
            self.awaited.d.next = 0.into();
            self.gap.d.next = false;
            self.settling.d.next = 7.into();
        }
        self.begins.d.next = self.asked.val().opens;
        if self.asked.val().opens & (!self.reset.val()) {
            self.opened.d.next = true;
            self.session_number.d.next = self.session.val();
            self.awaited.d.next = 0.into();
            self.gap.d.next = false;
        }
    }
}
