//! How many datagrams a second one thread of the host carries, against a device that answers at once with zeros.

use std::net::{Ipv4Addr, SocketAddr, UdpSocket};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use incircle::udp::{UdpAddress, UdpTransport};
use incircle::Transport;
use incircle_model::serial::core_identity;
use incircle_protocol::{
    answer_head, Clear, Command, CommandReader, DeviceDatagram, DeviceHeader, HostDatagram, HostHeader, Layout,
    RecordRange, UdpGreeting, FULL, STATUS_OPEN, UDP_LINK_MAGIC, UDP_LINK_VERSION,
};

/// Bytes of the FIFO that the device claims.
const FIFO_BYTES: u32 = 16_384;

fn greeting() -> UdpGreeting {
    UdpGreeting {
        magic: UDP_LINK_MAGIC,
        link_version: UDP_LINK_VERSION,
        clock_hz: 120_000_000,
        fifo_bytes: FIFO_BYTES,
        silence_ms: 2000,
        mac: [2, 0, 0, 0, 0, 1],
        identity: core_identity(FULL),
    }
}

/// A device that takes what comes in order, and whose answers are zeros behind their heads.
#[derive(Default)]
struct Null {
    session: u64,
    expected: u32,
    answers: u32,
    taken: crc32fast::Hasher,
    reader: CommandReader,
}

impl Null {
    fn datagram(&self, kind: DeviceDatagram, body: impl IntoIterator<Item = u32>) -> Vec<u8> {
        let (free, expected, session) = (FIFO_BYTES as u16, self.expected, self.session);
        let header = DeviceHeader { kind, status: STATUS_OPEN, free, expected, session };
        let mut bytes = header.to_bytes().to_vec();
        bytes.extend(body.into_iter().flat_map(u32::to_le_bytes));
        let crc = crc32fast::hash(&bytes);
        bytes.extend(crc.to_le_bytes());
        bytes
    }

    /// Answers a datagram of the host, whose check sum is taken to be right.
    fn answer(&mut self, datagram: &[u8]) -> Vec<Vec<u8>> {
        let (header, rest) = datagram.split_first_chunk().expect("a header");
        let HostHeader { kind, number, session } = HostHeader::from_bytes(*header).expect("a kind");
        match kind {
            HostDatagram::Hello => {
                self.session = session;
                vec![self.datagram(DeviceDatagram::Hello, greeting().to_words())]
            }
            HostDatagram::Open => {
                *self = Self { session, ..Self::default() };
                vec![self.datagram(DeviceDatagram::Opened, [])]
            }
            HostDatagram::Close => vec![self.datagram(DeviceDatagram::Closed, [])],
            HostDatagram::Poll => vec![self.ack()],
            HostDatagram::Data if number != self.expected => vec![self.ack()],
            HostDatagram::Data => {
                let words = &rest[..rest.len() - 4];
                self.expected += 1;
                self.taken.update(words);
                let mut said = vec![self.ack()];
                for word in words.chunks_exact(4) {
                    let word = u32::from_le_bytes(word.try_into().expect("a word"));
                    if let Some(Ok(command)) = self.reader.take(word) {
                        said.push(self.zeros(&command));
                    }
                }
                said
            }
        }
    }

    fn ack(&self) -> Vec<u8> {
        self.datagram(DeviceDatagram::Ack, [self.answers, self.taken.clone().finalize()])
    }

    fn zeros(&mut self, command: &Command<()>) -> Vec<u8> {
        let layout = Layout::of(16, FULL.points);
        let payload = command.payload_words(layout) as u32;
        let words = answer_head(command.opcode(), payload).into_iter().chain((0..payload).map(|_| 0));
        let mut digest = crc32fast::Hasher::new();
        words.clone().for_each(|word| digest.update(&word.to_le_bytes()));
        let body = [self.answers, 0].into_iter().chain(words).chain([digest.finalize()]);
        self.answers += 1;
        self.datagram(DeviceDatagram::AnswerEnd, body)
    }
}

/// The figure: `cargo test --release -p incircle --test it udp::pace -- --ignored --nocapture` on an idle machine.
#[test]
#[ignore = "measures the machine"]
fn one_thread_carries_many_datagrams() {
    let socket = UdpSocket::bind((Ipv4Addr::LOCALHOST, 0)).expect("a socket");
    socket.set_read_timeout(Some(Duration::from_millis(20))).expect("a timeout");
    let Ok(SocketAddr::V4(address)) = socket.local_addr() else { panic!("an IPv4 address") };
    let stops = AtomicBool::new(false);
    std::thread::scope(|scope| {
        scope.spawn(|| {
            let (mut device, mut bytes) = (Null::default(), [0; 2000]);
            while !stops.load(Ordering::Relaxed) {
                if let Ok((length, from)) = socket.recv_from(&mut bytes) {
                    for datagram in device.answer(&bytes[..length]) {
                        socket.send_to(&datagram, from).expect("sent");
                    }
                }
            }
        });
        measure(&UdpAddress { host: address.ip().to_string(), port: address.port() });
        stops.store(true, Ordering::Relaxed);
    });
}

/// Does a thousand read-outs, and prints how many datagrams passed in a second.
fn measure(address: &UdpAddress) {
    let mut transport = UdpTransport::open(address).expect("a socket");
    let range = RecordRange { first: 0, count: 16_000 };
    let job = [Command::Clear(Clear::one_mesh(0)), Command::Triangles(range)];
    let heads = job.each_ref().map(|command: &Command<&[u32]>| {
        answer_head(command.opcode(), command.payload_words(Layout::of(16, FULL.points)) as u32)
    });
    let mut payload = vec![0; heads[1][1] as usize];
    let deadline = Instant::now() + Duration::from_secs(60);
    transport.submit(&job, deadline).expect("sent");
    let mut begun = Instant::now();
    for run in 0..1000 {
        transport.submit(&job, deadline).expect("sent");
        transport.receive(heads[0], &mut [], deadline).expect("an answer");
        assert_eq!(transport.receive(heads[1], &mut payload, deadline).expect("an answer")[1], heads[1][1]);
        if run == 0 {
            begun = Instant::now();
        }
    }
    let (took, counts) = (begun.elapsed().as_secs_f64(), transport.statistics());
    let rate = (counts.sent + counts.received) as f64 / took;
    println!(
        "{rate:.0} datagrams/s, {:.0} MB/s of answers; {counts:?}",
        1000.0 * 4.0 * payload.len() as f64 / took / 1e6
    );
}
