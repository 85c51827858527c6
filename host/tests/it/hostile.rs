//! Devices that lie: every lie ends in a typed error, never in a panic, a hang or wrong memory use.

use std::cell::Cell;
use std::rc::Rc;
use std::time::Duration;

use crate::common::liar::Liar;
use crate::common::Random;
use incircle::{Device, DeviceFault, Error, ErrorKind, Options, Point, Solution, VerifyError};
use incircle_protocol::{answer_header, Opcode, Status};

fn points() -> Vec<Point> {
    Random(11).points(40, 1 << 8)
}

fn run(liar: Liar) -> Result<Solution, Error> {
    let mut device = Device::from_transport(Box::new(liar));
    let mut session = device.session()?;
    session.triangulate(&points())
}

/// The fault with which a lie is found out.
fn fault(lie: impl FnMut(Opcode, &mut Vec<u32>) + 'static) -> DeviceFault {
    found_out(Liar::new(16, lie))
}

fn found_out(liar: Liar) -> DeviceFault {
    match run(liar) {
        Err(Error::Device { fault, .. }) => fault,
        other => panic!("not found out: {other:?}"),
    }
}

/// The fault with which a lie is found out where the host reads whole records.
fn fault_of_records(lie: impl FnMut(Opcode, &mut Vec<u32>) + 'static) -> DeviceFault {
    found_out(Liar::new(16, lie).with_links())
}

/// Changes one word of the answers to one command.
fn word(
    of: Opcode,
    place: usize,
    change: impl Fn(u32) -> u32 + 'static,
) -> impl FnMut(Opcode, &mut Vec<u32>) + 'static {
    move |opcode, answer| {
        if opcode == of {
            answer[place] = change(answer[place]);
        }
    }
}

/// The lie of a device that also leaves out the feature of short ids, so that ids come in 16 bits.
fn without_short_ids(
    mut lie: impl FnMut(Opcode, &mut Vec<u32>) + 'static,
) -> impl FnMut(Opcode, &mut Vec<u32>) + 'static {
    move |opcode, answer| {
        if opcode == Opcode::Hello {
            answer[2 + 6] &= 0xffff;
        }
        lie(opcode, answer);
    }
}

#[test]
fn an_honest_device_passes() {
    let mesh = run(Liar::new(16, |_, _| {})).expect("an honest mesh");
    crate::common::assert_right(&mesh);
    assert_eq!(mesh.report.backend, "liar");
}

/// A device sends short ids only if it says that it can, so older devices are read as before.
#[test]
fn a_device_without_short_ids_is_read_in_16_bits() {
    let mesh = run(Liar::new(16, |_, _| {})).expect("an honest mesh").mesh;
    let words = Rc::new(Cell::new([0; 2]));
    let (short, long) = (Rc::clone(&words), Rc::clone(&words));
    let liars = [
        Liar::new(16, move |opcode, answer| {
            if opcode == Opcode::Triangles {
                short.set([short.get()[0] + answer[1], short.get()[1]]);
            }
        }),
        Liar::new(
            16,
            without_short_ids(move |opcode, answer| {
                if opcode == Opcode::Triangles {
                    long.set([long.get()[0], long.get()[1] + answer[1]]);
                }
            }),
        ),
    ];
    for liar in liars {
        assert_eq!(run(liar).expect("an honest mesh").mesh, mesh);
    }
    // 40 points have 78 records: a word each with ids of 10 bits, and a word and a half with those of 16.
    assert_eq!(words.get(), [78, 117]);
}

#[test]
fn lies_about_the_identity() {
    let hello = |place: usize, value: u32| fault(word(Opcode::Hello, 2 + place, move |_| value));
    assert!(matches!(hello(0, 0xdead_beef), DeviceFault::Magic { found: 0xdead_beef, .. }));
    for version in [0, 1 << 16, 1 << 16 | 1, 3 << 16] {
        assert!(matches!(hello(1, version), DeviceFault::ProtocolVersion { found, .. } if found == version));
    }
    for bits in [0, 32, u32::MAX] {
        assert_eq!(hello(3, bits), DeviceFault::CoordBits(bits));
    }
    for capacity in [0, 3, 1 << 30, u32::MAX] {
        assert_eq!(hello(4, capacity), DeviceFault::Capacity(capacity));
    }
    // The word has contexts in its low byte and engines above it.
    for engines in [0, 1, 255] {
        assert_eq!(hello(5, engines << 8), DeviceFault::Contexts(0));
    }
    for engines in [257, u32::MAX >> 8] {
        assert_eq!(hello(5, engines << 8 | 1), DeviceFault::Engines(engines));
    }
}

#[test]
fn a_larger_minor_version_is_welcome() {
    let mesh = run(Liar::new(16, word(Opcode::Hello, 3, |version| version + 7)));
    assert!(mesh.is_ok());
}

#[test]
fn contexts_that_are_claimed_and_not_there_are_found_out() {
    // The model behind the lie has one context, and refuses to clear for more.
    let found = fault(word(Opcode::Hello, 2 + 5, |_| 255));
    assert_eq!(
        found,
        DeviceFault::Status {
            status: Status::BadContexts as u8,
            meaning: "the contexts that were asked for are more than it has, or the jobs do not divide them",
        }
    );
}

#[test]
fn absurd_latencies_are_no_more_than_absurd() {
    let mesh = run(Liar::new(16, |opcode, answer| {
        if matches!(opcode, Opcode::Latencies | Opcode::Counters) {
            answer[2..].fill(u32::MAX);
        }
    }));
    let report = mesh.expect("an honest mesh").report;
    assert_eq!(report.latencies.map(|latencies| latencies.insertions), Some(128 * u64::from(u32::MAX)));
}

#[test]
fn an_absurd_capacity_takes_no_memory() {
    // A device for a billion points has wide records. The model behind the lie has narrow ones, and that shows.
    let found = fault(without_short_ids(word(Opcode::Hello, 2 + 4, |_| (1 << 30) - 1)));
    assert!(matches!(found, DeviceFault::PayloadLength { .. }), "{found}");
    // Short ids have the same form in both, but not the infinite vertex.
    let found = fault(word(Opcode::Hello, 2 + 4, |_| (1 << 30) - 1));
    assert!(matches!(found, DeviceFault::VertexOutOfRange { vertex: 127, .. }), "{found}");
}

#[test]
fn wrong_headers_and_lengths() {
    let header = |change: fn(u32) -> u32| fault(word(Opcode::Clear, 0, change));
    assert!(matches!(header(|h| h ^ 1 << 24), DeviceFault::Header { opcode: 2, .. }));
    assert!(matches!(header(|h| h ^ 1), DeviceFault::Header { .. }));
    assert!(matches!(header(|h| h | 200 << 16), DeviceFault::Header { .. }));
    for length in [0, 1, 4, 6, u32::MAX] {
        let found = fault(word(Opcode::Insert, 1, move |_| length));
        assert_eq!(found, DeviceFault::PayloadLength { found: length, expected: 5 });
    }
}

#[test]
fn every_failure_status_is_reported() {
    for status in
        [Status::UnknownOpcode, Status::BadRange, Status::Collinear, Status::Full, Status::BadContexts, Status::Stuck]
    {
        let found = fault(move |opcode, answer| {
            if opcode == Opcode::Insert {
                answer[0] = answer_header(opcode as u8, status);
            }
        });
        assert!(matches!(found, DeviceFault::Status { status: s, .. } if s == status as u8));
    }
}

#[test]
fn wrong_counts() {
    for place in 0..5 {
        for change in [|n: u32| n + 1, |n: u32| n.wrapping_sub(1)] {
            let found = fault(word(Opcode::Insert, 2 + place, change));
            assert!(matches!(found, DeviceFault::Count { .. }), "{found}");
        }
    }
}

#[test]
fn wrong_records() {
    let record = |place: usize, change: fn(u32) -> u32| fault_of_records(word(Opcode::Read, 2 + 3 * 5 + place, change));
    assert_eq!(record(0, |w| w | 1 << 31), DeviceFault::Locked { record: 5 });
    type Change = fn(u32) -> u32;
    let spare: [(usize, Change); 4] =
        [(0, |w| w | 1 << 30), (0, |w| w | 3 << 30), (1, |w| w | 1 << 31), (2, |w| w | 1 << 30)];
    for (place, change) in spare {
        let found = record(place, change);
        assert!(matches!(found, DeviceFault::SpareBits { record: 5, place: p, .. } if p == place), "{found}");
    }
    let outside = record(1, |w| w & !0x7fff | 63);
    assert!(matches!(outside, DeviceFault::VertexOutOfRange { record: 5, vertex: 63, points: 40 }));
    let outside = record(1, |w| w & 0x7fff | 78 << 15);
    assert!(matches!(outside, DeviceFault::NeighborOutOfRange { record: 5, neighbor: 78, .. }));
}

#[test]
fn wrong_packed_triangles() {
    // The vertices of record 5 are the half words 15, 16 and 17: the high half of word 7, and both halves of word 8.
    let vertex =
        |place: usize, change: fn(u32) -> u32| fault(without_short_ids(word(Opcode::Triangles, 2 + place, change)));
    let outside = vertex(7, |w| w & 0xffff | 63 << 16);
    assert!(matches!(outside, DeviceFault::VertexOutOfRange { record: 5, vertex: 63, points: 40 }), "{outside}");
    let outside = vertex(8, |w| w | 0xffff);
    assert!(matches!(outside, DeviceFault::VertexOutOfRange { record: 5, vertex: 0xffff, .. }), "{outside}");
    let twice = vertex(8, |w| w >> 16 | w & 0xffff_0000);
    assert_eq!(twice, DeviceFault::RepeatedVertex { record: 5 });
    let shorter = |opcode, answer: &mut Vec<u32>| {
        if opcode == Opcode::Triangles {
            answer[1] -= 1;
        }
    };
    for found in [fault(without_short_ids(shorter)), fault(shorter)] {
        assert!(matches!(found, DeviceFault::PayloadLength { .. }), "{found}");
    }
}

#[test]
fn wrong_short_ids() {
    // With 40 points an id has 10 bits, and the vertices of record 5 are in word 5.
    let vertices = |change: fn(u32) -> u32| fault(word(Opcode::Triangles, 2 + 5, change));
    let outside = vertices(|w| w & !(0x3ff << 10) | 63 << 10);
    assert!(matches!(outside, DeviceFault::VertexOutOfRange { record: 5, vertex: 63, points: 40 }), "{outside}");
    let outside = vertices(|w| w | 0x3ff << 20);
    assert!(matches!(outside, DeviceFault::VertexOutOfRange { record: 5, vertex: 0x3ff, .. }), "{outside}");
    let twice = vertices(|w| w & !0x3ff | w >> 10 & 0x3ff);
    assert_eq!(twice, DeviceFault::RepeatedVertex { record: 5 });
}

/// The fault with which changed records are found out. Most such lies show only in the mesh as a whole.
fn records(change: impl Fn(&mut [[u32; 3]]) + 'static) -> DeviceFault {
    fault_of_records(move |opcode, answer| {
        if opcode == Opcode::Read {
            let (records, _) = answer[2..].as_chunks_mut::<3>();
            change(records);
        }
    })
}

fn is_ghost(record: &[u32; 3]) -> bool {
    record.iter().any(|word| word & 0x7fff == 127)
}

#[test]
fn wrong_meshes() {
    let finite = |records: &[[u32; 3]]| records.iter().position(|r| !is_ghost(r)).expect("a triangle");
    let ghost = |records: &[[u32; 3]]| records.iter().position(is_ghost).expect("a ghost");
    let found = records(move |r| r[finite(r)].swap(0, 1));
    assert!(matches!(found, DeviceFault::Orientation { .. }), "{found}");
    let found = records(move |r| r[finite(r)][1] = r[finite(r)][0]);
    assert!(matches!(found, DeviceFault::RepeatedVertex { .. }), "{found}");
    let found = records(move |r| r[ghost(r)] = r[finite(r)]);
    assert!(matches!(found, DeviceFault::OpenHull { .. }), "{found}");
    let found = records(move |r| r[finite(r)] = r[ghost(r)]);
    assert!(matches!(found, DeviceFault::OpenHull { .. }), "{found}");
    let found = records(|r| {
        let triangle = r.iter().copied().find(|record| !is_ghost(record)).expect("a triangle");
        r.iter_mut().filter(|record| !is_ghost(record)).for_each(|record| *record = triangle);
    });
    assert!(matches!(found, DeviceFault::Area { .. }), "{found}");
    let found = records(|r| r.iter_mut().filter(|record| is_ghost(record)).for_each(|ghost| ghost.reverse()));
    assert!(matches!(found, DeviceFault::Area { .. }), "{found}");
}

/// Flips the edge between the only two triangles of a mesh, and leaves the neighbours as they are.
fn flip_the_inner_edge(records: &mut [[u32; 3]]) {
    let vertices = |record: &[u32; 3]| record.map(|word| word & 0x7fff);
    let mut triangles = records.iter_mut().filter(|record| !is_ghost(record));
    let one = triangles.next().expect("a triangle");
    let other = triangles.next().expect("two triangles");
    let (mut v, w) = (vertices(one), vertices(other));
    let apex = (0..3).find(|&k| !w.contains(&v[k])).expect("an apex");
    v.rotate_left(apex);
    let across = w.into_iter().find(|id| !v.contains(id)).expect("an apex");
    let turned = [[v[0], v[1], across], [v[0], across, v[2]]];
    for (record, turned) in [one, other].into_iter().zip(turned) {
        for (word, vertex) in record.iter_mut().zip(turned) {
            *word = *word & !0x7fff | vertex;
        }
    }
}

#[test]
fn a_well_formed_mesh_of_another_kind_is_left_to_the_validator() {
    let liar = Liar::new(16, |opcode, answer| {
        if opcode == Opcode::Read {
            flip_the_inner_edge(answer[2..].as_chunks_mut::<3>().0);
        }
    });
    let mut device = Device::from_transport(Box::new(liar.with_links()));
    let mut session = device.session().expect("greeted");
    let points = [(0, 0), (10, 1), (19, 16), (1, 9)].map(Point::from);
    let solution = session.triangulate(&points).expect("well formed");
    let found = solution.mesh.verify().expect_err("not Delaunay");
    assert!(matches!(found, VerifyError::NotDelaunay { .. }), "{found}");
}

#[test]
fn short_answers_are_timeouts_and_the_session_ends() {
    use Opcode::{Clear, Counters, Hello, Insert, Latencies, Read, Triangles};
    for opcode in [Hello, Clear, Insert, Read, Counters, Latencies, Triangles] {
        let liar = Liar::new(16, move |asked, answer| {
            if asked == opcode {
                answer.pop();
            }
        });
        let result = run(if opcode == Read { liar.with_links() } else { liar });
        let error = result.expect_err("cut short");
        assert_eq!(error.kind(), ErrorKind::Timeout, "{error}");
    }
    let mut device = Device::from_transport(Box::new(Liar::new(16, |asked, answer| {
        if asked == Opcode::Counters {
            answer.clear();
        }
    })));
    let mut session = device.session().expect("greeted");
    assert!(session.triangulate(&points()).is_err());
    let error = session.triangulate(&points()).expect_err("out of step");
    assert_eq!(error.kind(), ErrorKind::Link);
}

#[test]
fn a_slow_device_does_not_pass_its_deadline_unnoticed() {
    let mut liar = Liar::new(16, |_, _| {});
    liar.silent_for = Duration::from_millis(30);
    let mut device = Device::from_transport(Box::new(liar));
    let mut session = device.session().expect("greeted");
    let options = Options::default().timeout(Duration::from_millis(20));
    let error = session.triangulate_with(&points(), &options).expect_err("too slow");
    assert_eq!(error.kind(), ErrorKind::Timeout);
}

#[test]
fn noise_in_any_word_never_panics() {
    let mut random = Random(12);
    let honest = run(Liar::new(16, |_, _| {})).expect("an honest mesh");
    let mut wrong = 0;
    for round in 0..3000u64 {
        let mut noise = Random(random.next());
        let bits = if round % 2 == 0 { 16 } else { 20 };
        let target = noise.below(7) + 1;
        let lie = move |opcode: Opcode, answer: &mut Vec<u32>| {
            if opcode as u32 == target {
                let place = noise.below(answer.len() as u32) as usize;
                answer[place] ^= match noise.below(3) {
                    0 => noise.next() as u32,
                    1 => 1 << noise.below(32),
                    _ => noise.below(64),
                };
            }
        };
        let liar = Liar::new(bits, lie);
        match run(if target == Opcode::Read as u32 { liar.with_links() } else { liar }) {
            // A lie about a neighbour, a counter or a version leaves the mesh right. The validator finds any other lie.
            Ok(solution) if solution.mesh.triangles == honest.mesh.triangles => {}
            Ok(solution) => assert!(solution.mesh.verify().is_err()),
            Err(_) => wrong += 1,
        }
    }
    assert!(wrong > 1000, "{wrong}");
}
