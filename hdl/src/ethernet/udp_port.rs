//! The UDP port of the device: Ethernet frames at the pins of a PHY on one side, datagrams as streams of bytes in the
//! clock of the core on the other. The port also answers ARP and echo requests.
//!
//! 1. Received datagrams come as entries, as [`DatagramGate`](super::DatagramGate) describes them: bytes, and an end
//!    that says whether the bytes before it count. Datagrams to send are taken as
//!    [`DatagramQueue`](super::DatagramQueue) describes them.
//! 2. What is not for this device, or not sound, has no effect on anything that comes later.
//! 3. If the reader is slower than the wire, datagrams are lost as a whole. The FIFO holds 2,050 entries.
//! 4. Both resets are held together, at least for four clocks of either.
//!
//! Latency: datagrams of 1,472 bytes go out one in 1,538 clocks of the port, if the writer is as fast. The first byte
//! of a datagram is on the pins about 40 clocks after its last byte was taken.
//!
//! The end of a frame with the payload 60 to 77 and its check sum, and the last entries, at equal clocks:
//! ```text
//! rx_valid        /^^^^^^^^^^^^^^^^^^^^\_________________________________________
//! rx_data          75 76 77  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .
//! entry_valid     /^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^\______________/^^\___________
//! entry[8]        _________________________________  .  .  .  .  ./^^  .  .  .  .
//! entry[7:0]       67 68 69 70 71 72 73 74 75 76 77  .  .  .  .  .  1  .  .  .  .
//! ```
//!
//! The blocks of the port:
//! ```text
//! PHY -> MacIn -> ByteRoles -> FrameMatch, DatagramCheck -> DatagramGate -> AsyncFifo -------> entries
//!                     |              |
//!                     +--------> Responder -> SendChoice -> MacOut -> PHY
//!                                                 |
//! bytes -> DatagramQueue -> DatagramSender -------+
//! ```

use super::byte_roles::ByteRoles;
use super::datagram_check::DatagramCheck;
use super::datagram_gate::DatagramGate;
use super::datagram_queue::DatagramQueue;
use super::datagram_sender::DatagramSender;
use super::frame_match::FrameMatch;
use super::mac_in::MacIn;
use super::mac_out::MacOut;
use super::responder::Responder;
use super::send_choice::SendChoice;
use super::types::{Byte, OnTheWay, Station};
use crate::prelude::*;
use crate::stream::AsyncFifo;

#[derive(LogicBlock, Default)]
pub struct UdpPort {
    /// Clock of the PHY's bytes, 125 MHz, and the reset in this clock.
    pub port_clock: Signal<In, Clock>,
    pub port_reset: Signal<In, Bit>,
    pub station: Signal<In, Station>,
    /// The pins of the PHY, as GMII names them: `rx_dv`, `rx_er`, `rxd`, `tx_en`, `txd`.
    pub rx_valid: Signal<In, Bit>,
    pub rx_error: Signal<In, Bit>,
    pub rx_data: Signal<In, Byte>,
    pub tx_valid: Signal<Out, Bit>,
    pub tx_data: Signal<Out, Byte>,
    /// Clock of the core, and the reset in this clock.
    pub core_clock: Signal<In, Clock>,
    pub core_reset: Signal<In, Bit>,
    /// The oldest entry of received datagrams, which `entry_pop` removes at this edge.
    pub entry_valid: Signal<Out, Bit>,
    pub entry: Signal<Out, Bits<9>>,
    pub entry_pop: Signal<In, Bit>,
    pub on_the_way: Signal<Out, OnTheWay>,
    /// The bytes of datagrams to send; `byte_drops` forgets those of a datagram that has not ended.
    pub byte_valid: Signal<In, Bit>,
    pub byte_ready: Signal<Out, Bit>,
    pub byte_data: Signal<In, Byte>,
    pub byte_is_last: Signal<In, Bit>,
    pub byte_drops: Signal<In, Bit>,
    mac_in: MacIn,
    roles: ByteRoles,
    kinds: FrameMatch,
    check: DatagramCheck,
    gate: DatagramGate,
    entries: AsyncFifo<12, 9>,
    responder: Responder,
    queue: DatagramQueue,
    sender: DatagramSender,
    choice: SendChoice,
    mac_out: MacOut,
}

impl UdpPort {
    /// A port that holds no datagram.
    pub fn new() -> Self {
        Self { entries: AsyncFifo::new(), queue: DatagramQueue::new(), ..Self::default() }
    }
}

impl Logic for UdpPort {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, port_clock, mac_in, roles, kinds, check, gate, responder, sender, choice, mac_out);
        self.mac_in.reset.next = self.port_reset.val();
        self.roles.reset.next = self.port_reset.val();
        self.gate.reset.next = self.port_reset.val();
        self.responder.reset.next = self.port_reset.val();
        self.sender.reset.next = self.port_reset.val();
        self.mac_out.reset.next = self.port_reset.val();
        self.roles.station.next = self.station.val();
        self.responder.station.next = self.station.val();
        self.sender.station.next = self.station.val();

        self.mac_in.data_valid.next = self.rx_valid.val();
        self.mac_in.data_error.next = self.rx_error.val();
        self.mac_in.data.next = self.rx_data.val();
        self.roles.begins.next = self.mac_in.begins.val();
        self.roles.byte_valid.next = self.mac_in.byte_valid.val();
        self.roles.byte_data.next = self.mac_in.byte_data.val();
        self.roles.place.next = self.mac_in.place.val();
        self.roles.ends.next = self.mac_in.ends.val();
        self.roles.is_sound.next = self.mac_in.is_sound.val();
        self.kinds.begins.next = self.roles.frame_begins.val();
        self.kinds.head_valid.next = self.roles.head_valid.val();
        self.kinds.head.next = self.roles.head.val();
        self.check.begins.next = self.roles.frame_begins.val();
        self.check.head_valid.next = self.roles.head_valid.val();
        self.check.head.next = self.roles.head.val();

        self.gate.begins.next = self.roles.frame_begins.val();
        self.gate.head_valid.next = self.roles.head_valid.val();
        self.gate.head.next = self.roles.head.val();
        self.gate.kinds.next = self.kinds.kinds.val();
        self.gate.state.next = self.check.state.val();
        self.gate.ends.next = self.roles.frame_ends.val();
        self.gate.is_sound.next = self.roles.frame_is_sound.val();
        self.gate.is_full.next = self.entries.is_full.val();
        self.entries.write_clock.next = self.port_clock.val();
        self.entries.write_reset.next = self.port_reset.val();
        self.entries.push.next = self.gate.push.val();
        self.entries.push_data.next = self.gate.entry.val();
        self.entries.read_clock.next = self.core_clock.val();
        self.entries.read_reset.next = self.core_reset.val();
        self.entries.pop.next = self.entry_pop.val();
        self.entry_valid.next = self.entries.valid.val();
        self.entry.next = self.entries.data.val();
        self.on_the_way.next.to_the_reader = !self.entries.is_empty.val();
        self.on_the_way.next.from_the_port = !self.entries.is_fetched.val();

        self.responder.frame_begins.next = self.roles.frame_begins.val();
        self.responder.head_valid.next = self.roles.head_valid.val();
        self.responder.head.next = self.roles.head.val();
        self.responder.place.next = self.roles.head_place.val();
        self.responder.asks_address.next =
            self.roles.frame_ends.val() & self.roles.frame_is_sound.val() & self.kinds.kinds.val().is_arp;
        self.responder.asks_echo.next = self.roles.frame_ends.val()
            & self.roles.frame_is_sound.val()
            & self.kinds.kinds.val().is_echo
            & self.check.state.val().header_is_right
            & self.check.state.val().is_whole;

        self.queue.write_clock.next = self.core_clock.val();
        self.queue.write_reset.next = self.core_reset.val();
        self.queue.byte_valid.next = self.byte_valid.val();
        self.queue.byte_data.next = self.byte_data.val();
        self.queue.byte_is_last.next = self.byte_is_last.val();
        self.queue.byte_drops.next = self.byte_drops.val();
        self.byte_ready.next = self.queue.byte_ready.val();
        self.queue.read_clock.next = self.port_clock.val();
        self.queue.read_reset.next = self.port_reset.val();
        self.sender.holds.next = self.queue.holds.val();
        self.sender.length.next = self.queue.length.val();
        self.sender.read_data.next = self.queue.read_data.val();
        self.queue.read_index.next = self.sender.read_index.val();
        self.queue.lets_go.next = self.sender.lets_go.val();

        self.choice.answer_waits.next = self.responder.waits.val();
        self.choice.answer_data.next = self.responder.byte_data.val();
        self.choice.answer_is_last.next = self.responder.byte_is_last.val();
        self.choice.datagram_waits.next = self.sender.waits.val();
        self.choice.datagram_data.next = self.sender.byte_data.val();
        self.choice.datagram_is_last.next = self.sender.byte_is_last.val();
        self.responder.begins.next = self.choice.answer_begins.val();
        self.sender.begins.next = self.choice.datagram_begins.val();
        self.mac_out.waits.next = self.choice.waits.val();
        self.choice.begins.next = self.mac_out.begins.val();
        self.mac_out.byte_data.next = self.choice.byte_data.val();
        self.mac_out.byte_is_last.next = self.choice.byte_is_last.val();
        self.tx_valid.next = self.mac_out.data_valid.val();
        self.tx_data.next = self.mac_out.data.val();
    }
}
