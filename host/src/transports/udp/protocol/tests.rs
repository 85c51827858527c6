//! The host's half of the link against the software model of a device, without a network between them.

use std::collections::BTreeSet;
use std::net::{Ipv4Addr, SocketAddrV4};

use incircle_model::serial::Instantly;
use incircle_model::udp::UdpModel;
use incircle_protocol::{Clear, DeviceDatagram, DeviceHeader, Layout, RecordRange, UdpLinkConfig, SMALL};

use super::*;

const HOST: SocketAddrV4 = SocketAddrV4::new(Ipv4Addr::new(10, 0, 0, 2), 40_000);
/// Time from one step to the next.
const STEP: Duration = Duration::from_micros(100);
/// The points (0, 0), (4, 0) and (0, 4).
const POINTS: [u32; 3] = [0, 4, 4 << 16];

struct Rig {
    protocol: UdpProtocol,
    board: UdpModel<Instantly>,
    now: Duration,
    /// Sessions that the device had.
    sessions: BTreeSet<u64>,
}

impl Rig {
    fn new() -> Self {
        let core = Instantly::of(SMALL).expect("a named configuration");
        let link =
            UdpLinkConfig { clock_hz: 120_000_000, fifo_bytes: 16_384, silence_ms: 2000, mac: [2, 0, 0, 0, 0, 1] };
        Self {
            protocol: UdpProtocol::new(UdpParams::of_random(1)),
            board: UdpModel::new(link, core.identity(), core),
            now: Duration::ZERO,
            sessions: BTreeSet::new(),
        }
    }

    /// A host and a device with an open session.
    fn opened() -> Self {
        let mut rig = Self::new();
        rig.ask(&[Command::Hello]);
        assert_eq!(rig.answers(1).len(), 1);
        rig
    }

    fn ask(&mut self, commands: &[Command<&[u32]>]) {
        self.protocol.ask(commands, self.now).expect("no fault");
    }

    /// Asks for the mesh of the three points, by three commands.
    fn ask_job(&mut self) {
        let clear = Command::Clear(Clear::one_mesh(0));
        self.ask(&[clear, insert(), Command::Triangles(RecordRange { first: 0, count: 4 })]);
    }

    /// The next answers, as many as are wanted, or those that came within a second.
    fn answers(&mut self, wanted: usize) -> Vec<Answer> {
        let (mut answers, mut out) = (Vec::new(), Vec::new());
        for _ in 0..10_000 {
            answers.extend(std::iter::from_fn(|| self.protocol.take_answer()));
            if answers.len() >= wanted {
                break;
            }
            self.protocol.transmit(self.now, &mut out);
            for datagram in out.drain(..) {
                self.board.take(HOST, false, &datagram);
                self.hear();
            }
            self.now += STEP;
            self.hear();
        }
        answers
    }

    fn hear(&mut self) {
        self.board.work(10_000);
        while let Some((_, datagram)) = self.board.give() {
            self.protocol.receive(&datagram, self.now);
        }
        self.sessions.extend(self.board.session());
    }
}

fn insert() -> Command<&'static [u32]> {
    Command::insert(&POINTS[..], Layout { point_words: 1, record_words: 3 })
}

/// The payload of the answer with the triangles of a job.
fn triangles(answers: &[Answer]) -> Vec<&[u32]> {
    answers.chunks(3).map(|job| &job[2].1[..]).collect()
}

#[test]
fn a_late_busy_does_not_end_the_session() {
    let mut rig = Rig::opened();
    let session = rig.protocol.session;
    let header = DeviceHeader { kind: DeviceDatagram::Busy, status: 1, free: 0, expected: 0, session };
    let mut late = header.to_bytes().to_vec();
    late.extend(crc32fast::hash(&late).to_le_bytes());
    rig.ask_job();
    rig.protocol.receive(&late, rig.now);
    assert_eq!(rig.protocol.check(), Ok(()));
    assert_eq!((rig.answers(3).len(), rig.sessions.len()), (3, 1));
}

#[test]
fn a_job_finds_a_new_session_once_half_of_the_numbers_are_used() {
    for (used, sessions) in [((1 << 31) - 1, 0), (1 << 31, 1), (u64::from(u32::MAX), 1)] {
        let mut rig = Rig::opened();
        rig.protocol.sender = Sender::of_base(used);
        rig.ask_job();
        let answers = rig.answers(if sessions == 0 { 0 } else { 3 });
        assert_eq!((rig.protocol.check(), rig.sessions.len()), (Ok(()), 1 + sessions), "{used} numbers");
        assert_eq!(triangles(&answers).len(), sessions, "{used} numbers");
    }
}

#[test]
fn jobs_ahead_of_each_other_wait_for_the_next_session() {
    let expected = {
        let mut rig = Rig::opened();
        rig.ask_job();
        triangles(&rig.answers(3)).concat()
    };
    // A job has three answers, and one answer of the core came before the first job. With 7 numbers
    // the sessions take 2, 3 and 1 jobs; with 4 they take 1, 2, 2 and 1; with 1 they take none and then 1 each.
    for (most_numbers, sessions) in [(u64::MAX, 1), (7, 3), (4, 4), (1, 7)] {
        let mut rig = Rig::opened();
        rig.protocol.reader.most_numbers = most_numbers;
        (0..6).for_each(|_| rig.ask_job());
        let answers = rig.answers(18);
        assert_eq!(triangles(&answers), vec![&expected[..]; 6], "{most_numbers} numbers");
        assert_eq!(rig.sessions.len(), sessions, "{most_numbers} numbers");
    }
}

#[test]
fn commands_that_need_the_points_in_the_device_stay_in_their_session() {
    let mut rig = Rig::opened();
    rig.protocol.reader.most_numbers = 2;
    rig.ask(&[Command::Clear(Clear::one_mesh(0)), insert()]);
    assert_eq!(rig.answers(2).len(), 2);
    rig.ask(&[Command::Triangles(RecordRange { first: 0, count: 4 })]);
    assert_eq!((rig.answers(1).len(), rig.sessions.len()), (1, 1));
}

#[test]
fn a_mesh_that_stands_when_the_numbers_are_used_up_is_lost_with_a_sentence() {
    for (used, is_left) in [((1 << 31) + 1, true), (u64::from(u32::MAX) - (1 << 20), false)] {
        let mut rig = Rig::opened();
        rig.ask(&[Command::Clear(Clear::one_mesh(0)), insert()]);
        assert_eq!(rig.answers(2).len(), 2);
        rig.protocol.sender = Sender::of_base(used);
        rig.ask(&[Command::Triangles(RecordRange { first: 0, count: 4 })]);
        assert!(rig.answers(1).is_empty(), "the device awaits another number");
        let fault = rig.protocol.check();
        let is_used_up = matches!(fault, Err(UdpFault::Command(why)) if why.contains("used up its 4,294,967,295"));
        assert_eq!((fault.is_ok(), is_used_up), (is_left, !is_left), "{used} numbers: {fault:?}");
    }
}
