//! The model of the UDP link, rule by rule.

use super::*;
use crate::link::{Crc32, Instantly};
use incircle_protocol::{clear_word, command_word, Opcode, SMALL};
use std::net::Ipv4Addr;

const LINK: UdpLinkConfig =
    UdpLinkConfig { clock_hz: 125_000_000, fifo_bytes: 16_384, silence_ms: 2000, mac: [2, 0, 0, 0, 0, 1] };
const SESSION: u64 = 0x1122_3344_5566_7788;

fn host(last: u8) -> SocketAddrV4 {
    SocketAddrV4::new(Ipv4Addr::new(192, 168, 1, last), 50_000)
}

fn board() -> UdpModel<Instantly> {
    let core = Instantly::of(SMALL).unwrap();
    UdpModel::new(LINK, core.identity(), core)
}

fn datagram(kind: HostDatagram, number: u32, words: &[u32]) -> ToDevice {
    ToDevice { session: SESSION, kind, number, words: words.to_vec() }
}

/// Sends a datagram, and returns all that come back.
fn ask_from(board: &mut UdpModel<Instantly>, from: SocketAddrV4, asked: &ToDevice) -> Vec<(SocketAddrV4, ToHost)> {
    board.take(from, false, &asked.to_bytes());
    let mut said = Vec::new();
    loop {
        let worked = board.pass(1000);
        match board.give() {
            Some((to, bytes)) => said.push((to, ToHost::from_bytes(&bytes).expect("a datagram"))),
            None if worked < 1000 => return said,
            None => {}
        }
    }
}

fn ask(board: &mut UdpModel<Instantly>, kind: HostDatagram, number: u32, words: &[u32]) -> Vec<ToHost> {
    let said = ask_from(board, host(2), &datagram(kind, number, words));
    said.into_iter().map(|(_, said)| said).collect()
}

fn kinds(said: &[ToHost]) -> Vec<DeviceDatagram> {
    said.iter().map(ToHost::kind).collect()
}

fn opened() -> UdpModel<Instantly> {
    let mut board = board();
    assert_eq!(kinds(&ask(&mut board, HostDatagram::Open, 0, &[])), [DeviceDatagram::Opened]);
    board
}

fn word(body: &[u8], index: usize) -> u32 {
    u32::from_le_bytes(body[4 * index..][..4].try_into().unwrap())
}

#[test]
fn answers_to_strangers_are_never_longer_than_the_question() {
    let mut board = board();
    for kind in [HostDatagram::Hello, HostDatagram::Poll, HostDatagram::Data, HostDatagram::Close] {
        let words = vec![0; if kind == HostDatagram::Hello { 14 } else { usize::from(kind == HostDatagram::Data) }];
        let question = datagram(kind, 0, &words);
        let said = ask_from(&mut board, host(9), &question);
        assert_eq!(said.len(), 1);
        assert!(said[0].1.to_bytes().len() <= question.to_bytes().len());
        assert_eq!((said[0].0, said[0].1.header.session), (host(9), SESSION));
    }
}

#[test]
fn another_host_is_told_busy_and_nothing_else() {
    let mut board = opened();
    for (kind, answer) in
        [(HostDatagram::Open, vec![DeviceDatagram::Busy]), (HostDatagram::Poll, vec![]), (HostDatagram::Close, vec![])]
    {
        let said = ask_from(&mut board, host(3), &datagram(kind, 0, &[]));
        assert!(said.iter().all(|(to, _)| *to == host(3)));
        assert_eq!(said.iter().map(|(_, said)| said.kind()).collect::<Vec<_>>(), answer);
    }
    let other_port = SocketAddrV4::new(*host(2).ip(), 50_001);
    assert_eq!(ask_from(&mut board, other_port, &datagram(HostDatagram::Close, 0, &[])), []);
    let other_session = ToDevice { session: 5, ..datagram(HostDatagram::Open, 0, &[]) };
    assert_eq!(ask_from(&mut board, host(2), &other_session)[0].1.kind(), DeviceDatagram::Busy);
    assert_eq!(board.session(), Some(SESSION));
}

#[test]
fn an_open_that_is_doubled_keeps_the_session() {
    let mut board = opened();
    let hello = [command_word(Opcode::Hello)];
    assert_eq!(
        kinds(&ask(&mut board, HostDatagram::Data, 0, &hello)),
        [DeviceDatagram::Ack, DeviceDatagram::AnswerEnd]
    );
    let again = ask(&mut board, HostDatagram::Open, 0, &[]);
    assert_eq!((kinds(&again), again[0].header.expected), (vec![DeviceDatagram::Opened], 1));
    assert_eq!(kinds(&ask(&mut board, HostDatagram::Close, 0, &[])), [DeviceDatagram::Closed]);
    assert_eq!(kinds(&ask(&mut board, HostDatagram::Close, 0, &[])), [DeviceDatagram::NoSession]);
}

#[test]
fn old_data_is_acknowledged_and_a_gap_named_once() {
    let mut board = opened();
    let hello = [command_word(Opcode::Hello)];
    assert_eq!(kinds(&ask(&mut board, HostDatagram::Data, 1, &hello)), [DeviceDatagram::Nak]);
    assert_eq!(kinds(&ask(&mut board, HostDatagram::Data, 256, &hello)), []);
    assert_eq!(kinds(&ask(&mut board, HostDatagram::Poll, 0, &[])), [DeviceDatagram::Nak]);
    assert_eq!(
        kinds(&ask(&mut board, HostDatagram::Data, 0, &hello)),
        [DeviceDatagram::Ack, DeviceDatagram::AnswerEnd]
    );
    let again = ask(&mut board, HostDatagram::Data, 0, &hello);
    assert_eq!((kinds(&again), again[0].header.expected), (vec![DeviceDatagram::Ack], 1));
    let poll = ask(&mut board, HostDatagram::Poll, 0, &[]);
    assert_eq!((kinds(&poll), word(&poll[0].body, 0)), (vec![DeviceDatagram::Ack], 1));
}

#[test]
fn long_answers_come_in_parts_with_their_index() {
    let mut board = opened();
    let points: Vec<u32> = (0..350).map(|j: u32| (j * 7 % 350) | ((j * j % 1021) << 16)).collect();
    let insert = [&[clear_word(0), command_word(Opcode::Insert), 350][..], &points].concat();
    ask(&mut board, HostDatagram::Data, 0, &insert);
    let said = ask(&mut board, HostDatagram::Data, 1, &[command_word(Opcode::Triangles), 0, 698]);
    let parts = &said[1..];
    assert_eq!(kinds(parts), [DeviceDatagram::Answer, DeviceDatagram::Answer, DeviceDatagram::AnswerEnd]);
    let mut words = Vec::new();
    for part in parts {
        assert_eq!((word(&part.body, 0), word(&part.body, 1)), (2, words.len() as u32 / 4));
        let end = part.body.len() - if part.kind() == DeviceDatagram::AnswerEnd { 4 } else { 0 };
        words.extend(&part.body[8..end]);
    }
    assert_eq!(words.len(), 4 * (2 + 698 * 3 / 2));
    assert_eq!(parts[2].body[parts[2].body.len() - 4..], Crc32::of(&words).to_le_bytes());
}

#[test]
fn silence_ends_the_session_and_strangers_do_not_break_it() {
    let silence = u64::from(LINK.clock_hz) / 1000 * u64::from(LINK.silence_ms);
    let mut board = opened();
    for _ in 0..3 {
        board.pass(silence * 3 / 4);
        assert_eq!(kinds(&ask(&mut board, HostDatagram::Poll, 0, &[])), [DeviceDatagram::Ack]);
    }
    board.pass(silence * 3 / 4);
    ask_from(&mut board, host(3), &datagram(HostDatagram::Open, 0, &[]));
    ask_from(&mut board, host(3), &ToDevice { words: vec![0; 14], ..datagram(HostDatagram::Hello, 0, &[]) });
    board.pass(silence / 4);
    assert_eq!(board.session(), None);
    assert_eq!(kinds(&ask(&mut board, HostDatagram::Poll, 0, &[])), [DeviceDatagram::NoSession]);
}

#[test]
fn what_finds_no_room_is_refused_and_taken_later() {
    let mut board = opened();
    // The core gets no clock, so no word leaves the FIFO.
    let words = [&[command_word(Opcode::Insert), 4096][..], &[7; 358]].concat();
    for number in 0..12 {
        board.take(host(2), false, &datagram(HostDatagram::Data, number, &words).to_bytes());
    }
    let nak = ToHost::from_bytes(&board.give().unwrap().1).unwrap();
    assert_eq!((nak.kind(), nak.header.expected, nak.header.free), (DeviceDatagram::Nak, 11, 16_384 - 11 * 1440));
    board.pass(1000);
    assert_eq!(kinds(&ask(&mut board, HostDatagram::Data, 11, &[1])), [DeviceDatagram::Ack]);
}

#[test]
fn only_a_greeting_may_be_broadcast() {
    let mut board = board();
    board.take(host(2), true, &datagram(HostDatagram::Open, 0, &[]).to_bytes());
    assert!(board.give().is_none() && board.session().is_none());
    board.take(host(2), true, &datagram(HostDatagram::Hello, 0, &[0; 14]).to_bytes());
    assert!(board.give().is_some());
}

#[test]
fn one_answer_outside_the_session_waits_at_a_time() {
    let mut board = board();
    let hello = ToDevice { words: vec![0; 14], ..datagram(HostDatagram::Hello, 0, &[]) };
    board.take(host(3), false, &hello.to_bytes());
    board.take(host(2), false, &datagram(HostDatagram::Open, 0, &[]).to_bytes());
    assert_eq!(board.session(), None);
    assert_eq!(board.give().map(|(to, _)| to), Some(host(3)));
    assert!(board.give().is_none());
}
