//! Compares the headers of a received frame with what a frame for this device has there, byte by byte.
//!
//! 1. A kind stays true until a byte contradicts it. So `kinds` is final when byte 41 has come; a frame without that
//!    byte is never sound.
//! 2. UDP may come to the device's own address, to the broadcast address of its network, or to 255.255.255.255; echo
//!    requests to its own address alone. A sender that is a group of stations gets nothing.
//! 3. The header of IPv4 has no options, and the datagram is not a fragment. The bit "do not fragment" may have any
//!    value; the reserved bit must be 0.
//!
//! Latency: 1 clock from a byte to the kinds.
//!
//! A frame to all ones, then the type of IPv4, the protocol UDP, and a port that is not the device's (other bytes left
//! out):
//! ```text
//! clock             0  1  2  3  4  5  6  7
//! begins          /^^\____________________
//! head_valid      ___/^^^^^^^^^^^^^^\_____
//! is_to_all         .___/^^^^^^^^^^^^^^^^^
//! is_arp            ./^^^^^^^^\___________
//! is_echo           ./^^\_________________
//! is_udp            ./^^^^^^^^^^^^^^\_____
//! ```

use super::types::{Byte, HeadByte, Kinds, Roles};
use crate::prelude::*;

#[derive(LogicBlock, Default)]
pub struct FrameMatch {
    pub clock: Signal<In, Clock>,
    /// A frame begins, which may still be of any kind.
    pub begins: Signal<In, Bit>,
    /// A byte of the frame.
    pub head_valid: Signal<In, Bit>,
    pub head: Signal<In, HeadByte>,
    pub kinds: Signal<Out, Kinds>,
    udp: DFF<Bit>,
    echo: DFF<Bit>,
    arp: DFF<Bit>,
    mac_is_own: DFF<Bit>,
    mac_is_all: DFF<Bit>,
    address_is_own: DFF<Bit>,
    address_is_network: DFF<Bit>,
    address_is_all: DFF<Bit>,
    ones: Signal<Local, Byte>,
    fragment_bits: Signal<Local, Byte>,
    seen: Signal<Local, Byte>,
    is_wanted: Signal<Local, Bit>,
    is_second: Signal<Local, Bit>,
    is_ones: Signal<Local, Bit>,
    is_broadcast: Signal<Local, Bit>,
    is_group: Signal<Local, Bit>,
    data: Signal<Local, Byte>,
    roles: Signal<Local, Roles>,
    mac_fits: Signal<Local, Bit>,
    address_fits: Signal<Local, Bit>,
    breaks_ip: Signal<Local, Bit>,
    breaks_udp: Signal<Local, Bit>,
    breaks_echo: Signal<Local, Bit>,
    breaks_arp: Signal<Local, Bit>,
}

impl Logic for FrameMatch {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, udp, echo, arp, mac_is_own, mac_is_all);
        dff_setup!(self, clock, address_is_own, address_is_network, address_is_all);
        self.mac_fits.next = self.mac_is_own.q.val() | self.mac_is_all.q.val();
        self.address_fits.next =
            self.address_is_own.q.val() | self.address_is_network.q.val() | self.address_is_all.q.val();
        self.kinds.next.is_udp = self.udp.q.val() & self.mac_fits.val() & self.address_fits.val();
        self.kinds.next.is_echo = self.echo.q.val() & self.mac_is_own.q.val() & self.address_is_own.q.val();
        self.kinds.next.is_arp = self.arp.q.val() & self.mac_fits.val();
        self.kinds.next.is_to_all = (!self.mac_is_own.q.val()) | (!self.address_is_own.q.val());

        self.ones.next = 0xff.into();
        self.roles.next = self.head.val().roles;
        self.data.next = self.head.val().data;
        self.fragment_bits.next = 0xff.into();
        if self.roles.val().is_flags {
            self.fragment_bits.next = 0xbf.into();
        }
        self.seen.next = self.data.val() & self.fragment_bits.val();
        self.is_wanted.next = self.seen.val() == self.head.val().wanted;
        self.is_second.next = self.data.val() == self.head.val().second;
        self.is_ones.next = self.data.val() == self.ones.val();
        self.is_broadcast.next = self.data.val() == self.head.val().broadcast;
        self.is_group.next = self.roles.val().tests_group & self.data.val().get_bit(0);
        self.breaks_ip.next = (self.roles.val().tests_ip & (!self.is_wanted.val())) | self.is_group.val();
        self.breaks_udp.next = self.roles.val().tests_udp & (!self.is_wanted.val());
        self.breaks_echo.next = (self.roles.val().tests_echo & (!self.is_wanted.val()))
            | (self.roles.val().tests_protocol & (!self.is_second.val()));
        self.breaks_arp.next = (self.roles.val().tests_arp & (!self.is_second.val()))
            | (self.roles.val().tests_target & (!self.is_wanted.val()))
            | self.is_group.val();
        if self.head_valid.val() {
            self.udp.d.next = self.udp.q.val() & (!self.breaks_ip.val()) & (!self.breaks_udp.val());
            self.echo.d.next = self.echo.q.val() & (!self.breaks_ip.val()) & (!self.breaks_echo.val());
            self.arp.d.next = self.arp.q.val() & (!self.breaks_arp.val());
            if self.roles.val().tests_mac {
                self.mac_is_own.d.next = self.mac_is_own.q.val() & self.is_wanted.val();
                self.mac_is_all.d.next = self.mac_is_all.q.val() & self.is_ones.val();
            }
            if self.roles.val().tests_address {
                self.address_is_own.d.next = self.address_is_own.q.val() & self.is_wanted.val();
                self.address_is_network.d.next = self.address_is_network.q.val() & self.is_broadcast.val();
                self.address_is_all.d.next = self.address_is_all.q.val() & self.is_ones.val();
            }
        }
        if self.begins.val() {
            self.udp.d.next = true;
            self.echo.d.next = true;
            self.arp.d.next = true;
            self.mac_is_own.d.next = true;
            self.mac_is_all.d.next = true;
            self.address_is_own.d.next = true;
            self.address_is_network.d.next = true;
            self.address_is_all.d.next = true;
        }
    }
}
