//! The exchange in `protocol/UDP.md` is that of the model of the UDP link, byte by byte, and the tables of the page
//! have the numbers of the crate.

use std::collections::BTreeSet;
use std::net::{Ipv4Addr, SocketAddrV4};

use incircle_model::serial::core_identity;
use incircle_model::udp::{ToDevice, ToHost, UdpModel};
use incircle_model::ClockModel;
use incircle_protocol::{
    DeviceDatagram, HostDatagram, UdpLinkConfig, DATAGRAM_HEADER_BYTES, MAX_DATAGRAM_WORDS, MAX_DEVICE_DATAGRAM,
    MAX_HOST_DATAGRAM, SILENCE_MS, SMALL, UDP_ANSWER_WORDS, UDP_GREETING_WORDS, UDP_LINK_MAGIC, UDP_LINK_VERSION,
    UDP_PORT,
};
use incircle_testkit::{exchange_datagrams, Datagram};

/// The text of the page.
const PAGE: &str = include_str!("../../../../../protocol/UDP.md");

/// The link of the device that the page shows.
const LINK: UdpLinkConfig =
    UdpLinkConfig { clock_hz: 120_000_000, fifo_bytes: 16_384, silence_ms: 2000, mac: [2, 0, 0, 0x69, 0x43, 1] };

/// Number of clocks between two looks whether the device says something.
const SLICE: u64 = 100;

/// The address of the host with this letter.
fn address(letter: char) -> SocketAddrV4 {
    let last = if letter == 'A' { 2 } else { 3 };
    SocketAddrV4::new(Ipv4Addr::new(192, 168, 1, last), 50_000)
}

fn hex(bytes: &[u8]) -> String {
    let bytes: Vec<_> = bytes.iter().map(|byte| format!("{byte:02x}")).collect();
    bytes.join(" ")
}

/// Everything that the device says until it is quiet.
fn listen(board: &mut UdpModel<ClockModel>) -> Vec<(SocketAddrV4, Vec<u8>)> {
    let mut said = Vec::new();
    loop {
        said.extend(std::iter::from_fn(|| board.give()));
        if board.pass(SLICE) < SLICE && !board.is_at_work() {
            said.extend(std::iter::from_fn(|| board.give()));
            return said;
        }
    }
}

#[test]
fn the_model_says_what_the_page_shows() {
    let core = ClockModel::new(SMALL).expect("a named configuration");
    let mut board = UdpModel::new(LINK, core_identity(SMALL), core);
    let shown = exchange_datagrams(PAGE);
    let mut rest = shown.as_slice();
    while let Some((question, behind)) = rest.split_first() {
        assert!(question.goes_to_device, "two answers where one is due");
        board.take(address(question.host), false, &question.bytes);
        let said = listen(&mut board);
        let count = behind.iter().take_while(|datagram| !datagram.goes_to_device).count();
        let (answers, behind) = behind.split_at(count);
        let shown = |Datagram { host, bytes, .. }: &Datagram| (address(*host), hex(bytes));
        let expected: Vec<_> = answers.iter().map(shown).collect();
        let said: Vec<_> = said.iter().map(|(to, bytes)| (*to, hex(bytes))).collect();
        assert_eq!(said, expected, "answer to {}", hex(&question.bytes));
        rest = behind;
    }
    assert_eq!(board.session(), None);
}

#[test]
fn the_exchange_shows_the_kinds_of_datagrams() {
    let (mut asked, mut said) = (BTreeSet::new(), BTreeSet::new());
    for Datagram { goes_to_device, bytes, .. } in exchange_datagrams(PAGE) {
        if goes_to_device {
            // One datagram of the exchange is broken on purpose.
            asked.extend(ToDevice::from_bytes(&bytes).map(|datagram| datagram.kind as u8));
        } else {
            said.insert(ToHost::from_bytes(&bytes).expect("a datagram").kind() as u8);
        }
    }
    assert_eq!(asked, BTreeSet::from([1, 2, 4, 5, 6]));
    // `Answer` is missing, since such an answer would fill the page.
    assert_eq!(said, BTreeSet::from([0x81, 0x82, 0x83, 0x84, 0x86, 0x87, 0x88, 0x89]));
}

#[test]
fn the_tables_and_the_prose_have_the_numbers_of_the_crate() {
    let thousands = |number: usize| format!("{},{:03}", number / 1000, number % 1000);
    let mut pieces: Vec<String> = Vec::new();
    pieces.extend((0..=255).filter_map(HostDatagram::from_u8).map(|it| format!("| {:02x} | `{it:?}` |", it as u8)));
    pieces.extend((0..=255).filter_map(DeviceDatagram::from_u8).map(|it| format!("| {:02x} | `{it:?}` |", it as u8)));
    pieces.extend([
        format!("Link version {}.{}.", UDP_LINK_VERSION >> 16, UDP_LINK_VERSION & 0xffff),
        format!("(`{UDP_LINK_MAGIC:08x}`)"),
        format!("port {UDP_PORT}"),
        format!("{DATAGRAM_HEADER_BYTES} bytes"),
        format!("1 to {MAX_DATAGRAM_WORDS} words"),
        format!("{UDP_GREETING_WORDS} words"),
        format!("{} bytes", thousands(MAX_HOST_DATAGRAM)),
        format!("{} bytes", thousands(MAX_DEVICE_DATAGRAM)),
        format!("{} words", thousands(UDP_ANSWER_WORDS)),
        "Two seconds without a valid datagram".to_owned(),
    ]);
    assert_eq!(SILENCE_MS, 2000);
    for piece in pieces {
        assert!(PAGE.contains(&piece), "not said: {piece}");
    }
}
