//! Gives a byte of the device's addresses, by its index.
//!
//! 1. Indices 0 to 5 are the Ethernet address, 6 to 9 the IPv4 address, 10 and 11 the UDP port, and 12 to 15 the
//!    broadcast address. The first byte on the wire has the lowest index.
//!
//! Latency: none (combinational). Where the addresses are constants, synthesis makes a table of 16 rows of it.
//!
//! Bytes of the addresses 20:21:22:23:24:25, 26.27.28.29, port 30 and 31, broadcast 32.33.34.35 (all decimal):
//! ```text
//! index             0  1  5  6  9 10 11 12 15
//! byte_data        20 21 25 26 29 30 31 32 35
//! ```

use super::types::{Byte, Station};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct OwnBytes {
    pub station: Signal<In, Station>,
    pub index: Signal<In, Bits<4>>,
    pub byte_data: Signal<Out, Byte>,
    mac: Signal<Local, Bits<48>>,
    address: Signal<Local, Bits<32>>,
    port: Signal<Local, Bits<16>>,
    broadcast: Signal<Local, Bits<32>>,
}

impl Logic for OwnBytes {
    #[hdl_gen]
    fn update(&mut self) {
        self.mac.next = self.station.val().mac;
        self.address.next = self.station.val().address;
        self.port.next = self.station.val().port;
        self.broadcast.next = self.station.val().broadcast;
        match self.index.val().index() {
            0 => self.byte_data.next = self.mac.val().get_bits::<8>(40),
            1 => self.byte_data.next = self.mac.val().get_bits::<8>(32),
            2 => self.byte_data.next = self.mac.val().get_bits::<8>(24),
            3 => self.byte_data.next = self.mac.val().get_bits::<8>(16),
            4 => self.byte_data.next = self.mac.val().get_bits::<8>(8),
            5 => self.byte_data.next = self.mac.val().get_bits::<8>(0),
            6 => self.byte_data.next = self.address.val().get_bits::<8>(24),
            7 => self.byte_data.next = self.address.val().get_bits::<8>(16),
            8 => self.byte_data.next = self.address.val().get_bits::<8>(8),
            9 => self.byte_data.next = self.address.val().get_bits::<8>(0),
            10 => self.byte_data.next = self.port.val().get_bits::<8>(8),
            11 => self.byte_data.next = self.port.val().get_bits::<8>(0),
            12 => self.byte_data.next = self.broadcast.val().get_bits::<8>(24),
            13 => self.byte_data.next = self.broadcast.val().get_bits::<8>(16),
            14 => self.byte_data.next = self.broadcast.val().get_bits::<8>(8),
            _ => self.byte_data.next = self.broadcast.val().get_bits::<8>(0),
        }
    }
}
