//! A mesh that lives on a device at the end of a bad network: no change is lost, and none is made twice.

use std::cell::RefCell;
use std::rc::Rc;
use std::time::{Duration, Instant};

use crate::common::living::{few_changes_agree, random_changes_agree};
use crate::common::network::{VirtualNetwork, VirtualTransport};
use incircle::udp::UdpFault;
use incircle::{Device, Error, ErrorKind, LivingMesh, Point, Transport};
use incircle_protocol::{answer_head, part_outcome, Clear, Command, Layout, Outcome, RecordRange, RunKind};
use incircle_testkit::NetworkFaults;

const TRIP: Duration = Duration::from_micros(200);
/// Limit for an answer, in virtual time.
const LIMIT: Duration = Duration::from_secs(20);
const LAYOUT: Layout = Layout { point_words: 1, record_words: 3 };

type Shared = Rc<RefCell<VirtualNetwork>>;

fn connect(faults: &str, seed: u64) -> (Shared, Device) {
    let faults = NetworkFaults { seed, ..faults.parse().expect("faults") };
    let network = Rc::new(RefCell::new(VirtualNetwork::living(&faults, TRIP)));
    let device = Device::from_transport(Box::new(transport(&network)));
    (network, device)
}

fn transport(network: &Shared) -> VirtualTransport {
    VirtualTransport { network: Rc::clone(network), limit: LIMIT }
}

/// Compares a device with the processor on a network with these faults, and returns the number of answers that were
/// asked for again.
fn compare(faults: &str, seed: u64) -> u64 {
    let (network, device) = connect(faults, seed);
    random_changes_agree(device, seed);
    let statistics = network.borrow().statistics();
    statistics.repeated
}

#[test]
fn a_sound_network_repeats_nothing() {
    assert_eq!(compare("", 1), 0);
}

#[test]
fn faults_of_the_network_leave_no_trace_in_the_mesh() {
    for (faults, least) in [
        ("loss=0.1", 200),
        ("double=0.2", 0),
        ("swap=0.2", 0),
        ("delay=20", 0),
        ("flip=0.1", 200),
        ("loss=0.05,double=0.05,swap=0.05,delay=5,flip=0.05", 200),
    ] {
        let repeats: u64 = (0..30).map(|seed| compare(faults, seed)).sum();
        println!("{faults}: {repeats} answers were asked for again");
        assert!(repeats >= least, "{faults}: only {repeats} answers were asked for again");
    }
}

/// Loses each datagram to the host in turn. Whichever it is, each change is made once.
#[test]
fn a_change_whose_answer_is_lost_is_made_once() {
    let (network, device) = connect("", 3);
    few_changes_agree(device, "no loss");
    let (datagrams, mut repeats) = (network.borrow().to_host, 0);
    for place in 0..datagrams {
        let (network, device) = connect("", 3);
        network.borrow_mut().loses = Some(place);
        few_changes_agree(device, &format!("datagram {place}"));
        repeats += network.borrow().statistics().repeated;
    }
    // Each of the ten answers behind the greeting is lost once.
    assert!(repeats >= 10, "{repeats} of {datagrams}");
}

/// A square with a point in it, two runs of changes, a run of questions and a read-out, as one job.
fn job() -> Vec<Command<&'static [u32]>> {
    const POINTS: [u32; 5] = [0, 90, 90 | 90 << 16, 90 << 16, 41 | 30 << 16];
    vec![
        Command::Clear(Clear::one_mesh(0)),
        Command::insert(&POINTS, LAYOUT),
        Command::run(RunKind::InsertAs, &[5, 33 | 33 << 16, 6, 60 | 31 << 16], LAYOUT),
        Command::run(RunKind::Nearest, &[42 | 30 << 16], LAYOUT),
        Command::run(RunKind::Delete, &[4, 5], LAYOUT),
        Command::run(RunKind::InsertAs, &[4, 12 | 80 << 16], LAYOUT),
        Command::run(RunKind::Nearest, &[42 | 30 << 16], LAYOUT),
        Command::Insert { count: 1, points: &[70 | 5 << 16] },
        Command::Triangles(RecordRange { first: 0, count: 12 }),
    ]
}

/// Submits this many jobs at once and returns the payloads of all answers, and the number of answers asked for again
/// and of jobs sent again.
fn submitted(jobs: usize, loses: Option<u64>) -> (Vec<Vec<u32>>, u64, u64, u64) {
    let (network, _) = connect("", 4);
    network.borrow_mut().loses = loses;
    let mut transport = transport(&network);
    let commands: Vec<_> = (0..jobs).flat_map(|_| job()).collect();
    transport.submit(&commands, Instant::now()).expect("no fault");
    let payloads = commands.iter().map(|command| {
        let words = command.payload_words(LAYOUT);
        let mut payload = vec![u32::MAX; words as usize];
        let head = answer_head(command.opcode(), words as u32);
        transport.receive(head, &mut payload, Instant::now()).expect("an answer");
        payload
    });
    let payloads = payloads.collect();
    let statistics = network.borrow().statistics();
    let to_host = network.borrow().to_host;
    (payloads, statistics.repeated, statistics.restarted, to_host)
}

/// A run is sent when all answers before it are there, and nothing is sent behind it before its own. So a run that is
/// sent again meets the mesh that it left, and a second insertion at a vertex does not hide the deletion before it.
#[test]
fn runs_of_a_job_wait_for_each_other() {
    let (sound, _, _, datagrams) = submitted(1, None);
    let outcome = |payload: &[u32]| part_outcome(payload[0]);
    assert_eq!(sound.iter().skip(2).take(4).map(|payload| outcome(payload)).collect::<Vec<_>>(), [0, 1, 0, 0]);
    let mut again = 0;
    for place in 0..datagrams {
        let (found, repeated, restarted, _) = submitted(1, Some(place));
        again += repeated + restarted;
        for (index, (found, sound)) in found.iter().zip(&sound).enumerate() {
            let second = match index {
                2 | 5 => Some(Outcome::InUse),
                4 => Some(Outcome::Missing),
                _ => None,
            };
            let is_made = second.is_some_and(|second| found.chunks(2).all(|part| outcome(part) == second as u8));
            assert!(found == sound || is_made && repeated == 1, "datagram {place}, command {index}: {found:x?}");
        }
    }
    assert!(again >= 9, "{again} of {datagrams}");
}

/// A job whose answer is lost while the next job is under way begins again as a whole, with its runs.
#[test]
fn a_job_with_runs_begins_again_behind_the_next_one() {
    let (sound, _, _, datagrams) = submitted(3, None);
    for place in 0..datagrams {
        let (found, repeated, ..) = submitted(3, Some(place));
        let read_out = |payloads: &[Vec<u32>]| [8, 17, 26].map(|index| payloads[index].clone());
        assert_eq!(read_out(&found), read_out(&sound), "datagram {place}");
        assert!(found == sound || repeated > 0, "datagram {place}");
    }
}

#[test]
fn what_the_link_cannot_carry_is_refused() {
    for (command, sentence) in [
        (Command::Run { kind: RunKind::Nearest, count: 180, items: &[7; 180][..] }, "longer than the link takes"),
        (Command::Run { kind: RunKind::InsertAs, count: 1, items: &[7][..] }, "laid out for another device"),
        (Command::Insert { count: 2, points: &[7][..] }, "laid out for another device"),
    ] {
        let (network, _) = connect("", 5);
        let mut transport = transport(&network);
        let head = answer_head(command.opcode(), command.payload_words(LAYOUT) as u32);
        transport.submit(&[command], Instant::now()).expect("the session is not open yet");
        let error = transport.receive(head, &mut [], Instant::now()).expect_err("a fault");
        let fault = error.fault();
        assert!(matches!(fault, Some(UdpFault::Command(why)) if why.contains(sentence)), "{fault:?}");
    }
}

/// The device loses its session, and with it the mesh: in a pause of the program, with a change under way, or because
/// the cable is pulled. The program hears of it, and nothing is done in a session that never had the mesh.
#[test]
fn a_session_that_is_lost_takes_the_mesh_with_it_and_says_so() {
    let points = [[0, 0], [90, 0], [90, 90], [0, 90], [41, 30]].map(Point::from);
    for (kind, sentence) in [
        ("pause", "its memory is empty now"),
        ("under way", "its memory is empty now"),
        ("cable", "the device fell silent in the middle of the job"),
    ] {
        let (network, mut device) = connect("", 6);
        let mut session = device.session().expect("a session");
        let mut mesh = session.living().expect("the device has all runs");
        mesh.insert_all(&points).expect("room");
        match kind {
            "pause" => network.borrow_mut().rest(Duration::from_secs(3)),
            "under way" => network.borrow_mut().forgets_soon(),
            _ => network.borrow_mut().is_cut = true,
        }
        let error = mesh.move_all(&[(4, Point::new(50, 50))]).expect_err("the mesh is gone");
        assert!(matches!(error, Error::Link { .. }) && error.kind() == ErrorKind::Link, "{kind}: {error}");
        assert!(error.to_string().contains(sentence), "{kind}: {error}");
        network.borrow_mut().is_cut = false;
        for error in [mesh.nearest(points[0]).err(), mesh.delete(2).err(), mesh.mesh().err()] {
            assert!(matches!(error, Some(Error::OutOfStep { .. })), "{kind}: {error:?}");
        }
    }
}
