//! The digest of a session: the check sum over all words that the device has taken, by which the host finds a fault
//! beyond the network. [`PayloadDigest`](crate::serial::PayloadDigest) at a byte a clock.
//!
//! Latency: 1 clock from `commits`; `commits` comes a clock or more after the last `push`.
//!
//! Two bytes that count, and one that does not. The state is shown by its lowest six bits:
//! ```text
//! clock             0  1  2  3  4  5  6  7  8  9 10
//! begins          /^^\______________/^^\_____/^^\__
//! push            ___/^^^^^\___________/^^\________
//! push_data         . 49 50  .  .  .  . 51  .  .  .
//! commits         ____________/^^\_________________
//! state[5:0]       63 63 63 63 63 50 50 50 50 50 50
//! ```

use crate::commands::types::Word;
use crate::ethernet::ByteCrc;
use crate::prelude::*;
use crate::serial::types::Byte;

#[derive(LogicBlock, Default)]
pub struct DatagramDigest {
    pub clock: Signal<In, Clock>,
    /// A reset begins the digest anew.
    pub reset: Signal<In, Bit>,
    /// Forget the bytes that do not count yet.
    pub begins: Signal<In, Bit>,
    /// Take one more byte, which does not count until `commits`.
    pub push: Signal<In, Bit>,
    pub push_data: Signal<In, Byte>,
    /// All bytes that were pushed count.
    pub commits: Signal<In, Bit>,
    /// State of the check sum over all bytes that count.
    pub state: Signal<Out, Word>,
    /// The inverse of the state, as in [`ByteCrc`].
    committed: DFF<Word>,
    counts: Signal<Local, Word>,
    crc: ByteCrc,
}

const _: () = assert!(ByteCrc::FIRST == 0xffff_ffff, "the reset of this block follows the check sum");

impl Logic for DatagramDigest {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, committed);
        clock!(self, clock, crc);
        self.counts.next = !self.committed.q.val();
        self.state.next = self.counts.val();
        self.crc.sets.next = self.begins.val();
        self.crc.start.next = self.counts.val();
        self.crc.takes.next = self.push.val();
        self.crc.byte_data.next = self.push_data.val();
        if self.commits.val() {
            self.committed.d.next = !self.crc.state.val();
        }
        if self.reset.val() {
            self.committed.d.next = 0.into();
        }
    }
}
