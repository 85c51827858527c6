//! Says what each byte of a received frame means, by its place, and which byte a frame for this device has there, so
//! that the blocks behind it compare without looking places up.
//!
//! 1. What `MacIn` gives passes through unchanged beside the roles. What it gives in a clock of `reset` does not come
//!    out, but for `is_sound`.
//! 2. The roles of a place are those of all kinds of frames together, because the block does not know which kind the
//!    frame is. All places from 63 on have the same roles.
//! 3. `wanted`, `second` and `broadcast` hold the bytes that a frame for this device has at the place. They mean
//!    nothing where no role compares the byte with them.
//!
//! Latency: 1 clock.
//!
//! The last three bytes of the destination of a datagram, and a byte of its port. The device is 10.7.0.2 in the network
//! with the broadcast address 10.7.0.99:
//! ```text
//! clock             0  1  2  3  4  5  6  7
//! begins          /^^\____________________
//! byte_valid      ___/^^^^^\__/^^^^^\_____
//! place             . 31 32  . 33 34  .  .
//! byte_data         .  7  0  .  2 99  .  .
//! ends            __________________/^^\__
//! frame_begins    ___/^^\_________________
//! head_valid      ______/^^^^^\__/^^^^^\__
//! head.data         .  .  7  0  .  2 99  .
//! tests_address     .  ./^^^^^  ./^^\__  .
//! head.wanted       .  .  7  0  .  2  .  .
//! head.broadcast    .  .  7  0  . 99  .  .
//! frame_ends      _____________________/^^
//! ```
//! Source: the layouts of Ethernet II, IPv4 without options (RFC 791), UDP (RFC 768), ICMP echo (RFC 792) and ARP (RFC
//! 826), as one table of 64 places; the last row is for all places from 63 on.

use super::own_bytes::OwnBytes;
use super::types::{Byte, HeadByte, Place, Roles, Station};
use crate::leaf::LookupTable;
use crate::prelude::*;

crate::packed! {
    /// A row of the table: the roles of a byte, and where the bytes that are wanted come from.
    pub struct RoleRow {
        pub roles: Roles,
        /// The first wanted byte is the one of the device's addresses with the index `wanted`; otherwise it is
        /// `wanted`.
        pub is_own: bool,
        pub wanted: Byte,
        pub second: Byte,
        /// Index in the device's addresses of the byte of the broadcast address.
        pub broadcast: Bits<4>,
    }
}

#[derive(LogicBlock)]
pub struct ByteRoles {
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    pub station: Signal<In, Station>,
    /// The frame from `MacIn`.
    pub begins: Signal<In, Bit>,
    pub byte_valid: Signal<In, Bit>,
    pub byte_data: Signal<In, Byte>,
    pub place: Signal<In, Place>,
    pub ends: Signal<In, Bit>,
    pub is_sound: Signal<In, Bit>,
    /// The same, a clock later.
    pub frame_begins: Signal<Out, Bit>,
    pub head_valid: Signal<Out, Bit>,
    pub head: Signal<Out, HeadByte>,
    pub head_place: Signal<Out, Place>,
    pub frame_ends: Signal<Out, Bit>,
    pub frame_is_sound: Signal<Out, Bit>,
    rows: LookupTable<6, RoleRow>,
    own: OwnBytes,
    own_broadcast: OwnBytes,
    starts: DFF<Bit>,
    gives: DFF<Bit>,
    given: DFF<HeadByte>,
    given_place: DFF<Place>,
    is_over: DFF<Bit>,
    is_good: DFF<Bit>,
    /// The part of the place that only places from 64 on have.
    beyond: Signal<Local, Bits<5>>,
}

impl Default for ByteRoles {
    fn default() -> Self {
        Self {
            clock: Signal::default(),
            reset: Signal::default(),
            station: Signal::default(),
            begins: Signal::default(),
            byte_valid: Signal::default(),
            byte_data: Signal::default(),
            place: Signal::default(),
            ends: Signal::default(),
            is_sound: Signal::default(),
            frame_begins: Signal::default(),
            head_valid: Signal::default(),
            head: Signal::default(),
            head_place: Signal::default(),
            frame_ends: Signal::default(),
            frame_is_sound: Signal::default(),
            rows: LookupTable::new(row),
            own: OwnBytes::default(),
            own_broadcast: OwnBytes::default(),
            starts: DFF::default(),
            gives: DFF::default(),
            given: DFF::default(),
            given_place: DFF::default(),
            is_over: DFF::default(),
            is_good: DFF::default(),
            beyond: Signal::default(),
        }
    }
}

/// First and second wanted byte of a place, where they are no addresses of the device.
fn literals(place: usize) -> (u64, u64) {
    match place {
        12 | 18 => (0x08, [0x08, 0x06][usize::from(place == 18)]),
        13 => (0x00, 0x06),
        14 => (0x45, 0x00),
        15 | 21 => (0x00, 0x01),
        16 => (0x00, 0x08),
        19 => (0x00, 0x04),
        23 => (0x11, 0x01),
        34 => (0x08, 0x00),
        _ => (0x00, 0x00),
    }
}

/// Index in the device's addresses of the byte that a place must hold.
fn own_index(place: usize) -> Option<usize> {
    match place {
        0..=5 => Some(place),
        30..=33 => Some(place - 24),
        36..=37 => Some(place - 26),
        38..=41 => Some(place - 32),
        _ => None,
    }
}

fn row(place: usize) -> RoleRow {
    let at = |places: std::ops::RangeInclusive<usize>| places.contains(&place);
    let roles = Roles {
        tests_mac: at(0..=5),
        tests_group: place == 6,
        tests_ip: at(12..=14) || at(20..=21),
        is_flags: place == 20,
        tests_udp: place == 23 || at(36..=37),
        tests_echo: at(34..=35),
        tests_protocol: place == 23,
        tests_arp: at(12..=21),
        tests_target: at(38..=41),
        tests_address: at(30..=33),
        is_peer: at(6..=11) || at(26..=29) || at(34..=35),
        length_high: place == 16,
        length_low: place == 17,
        length_ends: place == 18,
        udp_high: place == 38,
        udp_low: place == 39,
        counts: place >= 40,
        sums_header: at(14..=33),
        sums_udp: at(16..=17) || place >= 26,
        is_udp_sum: at(40..=41),
        is_payload: place >= 42,
    };
    let (wanted, second) = literals(place);
    RoleRow {
        roles,
        is_own: own_index(place).is_some(),
        wanted: own_index(place).map_or(wanted, |index| index as u64).into(),
        second: second.into(),
        broadcast: (12 + (place as u64 + 2) % 4).into(),
    }
}

impl Logic for ByteRoles {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(self, clock, starts, gives, given, given_place, is_over, is_good);
        self.frame_begins.next = self.starts.q.val();
        self.head_valid.next = self.gives.q.val();
        self.head.next = self.given.q.val();
        self.head_place.next = self.given_place.q.val();
        self.frame_ends.next = self.is_over.q.val();
        self.frame_is_sound.next = self.is_good.q.val();

        self.beyond.next = self.place.val().get_bits::<5>(6);
        self.rows.index.next = self.place.val().get_bits::<6>(0);
        if self.beyond.val().any() {
            self.rows.index.next = 63.into();
        }
        self.own.station.next = self.station.val();
        self.own.index.next = bit_cast::<4, 8>(self.rows.value.val().wanted);
        self.own_broadcast.station.next = self.station.val();
        self.own_broadcast.index.next = self.rows.value.val().broadcast;

        self.given.d.next.data = self.byte_data.val();
        self.given.d.next.roles = self.rows.value.val().roles;
        self.given.d.next.is_low = self.place.val().get_bit(0);
        self.given.d.next.second = self.rows.value.val().second;
        self.given.d.next.broadcast = self.own_broadcast.byte_data.val();
        self.given.d.next.wanted = self.rows.value.val().wanted;
        if self.rows.value.val().is_own {
            self.given.d.next.wanted = self.own.byte_data.val();
        }
        self.given_place.d.next = self.place.val();
        self.starts.d.next = self.begins.val() & (!self.reset.val());
        self.gives.d.next = self.byte_valid.val() & (!self.reset.val());
        self.is_over.d.next = self.ends.val() & (!self.reset.val());
        self.is_good.d.next = self.is_sound.val();
    }
}
