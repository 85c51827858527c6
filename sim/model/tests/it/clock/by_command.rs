//! The model clock by clock against the model by commands: the same answers, the same mesh, and all locks released.
//!
//! Ids depend on the order in which insertions finish, so meshes are compared in their canonical form.

use crate::common::bench::{limit, Answer, Answers, Bench, Stalls};
use crate::common::mesh_check::{canonical, records_of};
use crate::common::{sets, Random};
use incircle_model::CommandModel;
use incircle_protocol::{
    clear_word, command_word, latency_bucket, latency_of_bucket, Config, Counter, Identity, Layout, Opcode, Status,
    COUNTER_WORDS, LATENCY_BUCKETS, PADDING,
};

/// A job: the number of contexts that work, and the points of each `Insert`.
struct Job {
    contexts: u32,
    pieces: Vec<Vec<u32>>,
}

impl Job {
    fn points(&self) -> Vec<u32> {
        self.pieces.concat()
    }

    /// A `Clear` for this many contexts, and an `Insert` for each piece.
    fn words(&self, contexts: u32) -> Vec<u32> {
        let mut words = vec![clear_word(contexts)];
        for piece in &self.pieces {
            words.extend([command_word(Opcode::Insert), piece.len() as u32]);
            words.extend(piece);
        }
        words
    }

    /// A random job of any kind, with as many points as fit the core or a few more.
    fn random(config: Config, random: &mut Random) -> Self {
        let most = config.points.min(300);
        let count = 1 + random.below(most + most / 4);
        let side = random.pick(&[2, 3, 4, 5, 8, 40, 300, 1 << 16]);
        let points = match random.below(8) {
            0 => sets::stuttering(random, count, side),
            1 => sets::parabola(random, count.min(255)),
            2 => sets::wheel(random, count),
            3 => {
                // The points lie on one line, or nearly so.
                let mut points: Vec<u32> = (0..count).map(|_| random.below(side) * 0x1_0001).collect();
                points.extend(sets::boxed(random, count / 4, side));
                points
            }
            _ => sets::boxed(random, count, side),
        };
        let mut pieces = vec![points];
        for _ in 0..random.pick(&[0, 0, 1, 3]) {
            let last = pieces.pop().unwrap_or_default();
            let (a, b) = last.split_at(random.below(last.len() as u32 + 1) as usize);
            pieces.extend([a.to_vec(), b.to_vec()]);
        }
        Self { contexts: random.below(config.contexts + 1), pieces }
    }
}

/// The answers of the model by commands.
fn expected(model: &mut CommandModel, words: &[u32]) -> Vec<Answer> {
    model.send(words);
    let mut answers = Answers::default();
    let mut word = [0];
    while model.receive(&mut word) == 1 {
        answers.take(word[0]);
    }
    answers.whole
}

/// Runs a job on both models and compares them; returns the counters.
fn compare(bench: &mut Bench, job: &Job, stalls: Stalls, random: &mut Random) -> Answer {
    let config = bench.config;
    let mut model = CommandModel::new(16, config.points, config.ring).unwrap();
    let points = job.points();
    let what = || format!("{config:?}, {} contexts, pieces {:x?}", job.contexts, job.pieces);
    // The model by commands has one context.
    let wanted = expected(&mut model, &job.words(0));
    let most = 4 * limit(points.len());
    let mut run = |words: &[u32], count| match bench.run(words, count, stalls, most, random) {
        Ok(answers) => answers,
        Err(hang) => panic!("stuck: {}, {}", hang.0, what()),
    };
    assert_eq!(run(&job.words(job.contexts), wanted.len()), wanted, "{}", what());
    let count = model.mesh().records().len() as u32;
    let past = run(&[command_word(Opcode::Read), 0, count + 1], 1);
    assert!(past[0].is(Status::BadRange) && past[0].payload.is_empty());
    let read = run(&[command_word(Opcode::Read), 0, count], 1).swap_remove(0);
    let records: Vec<[u32; 3]> = read.payload.chunks_exact(3).map(|words| [words[0], words[1], words[2]]).collect();
    assert!(read.is(Status::Ok));
    let triangles = run(&[PADDING, command_word(Opcode::Triangles), 0, count], 1).swap_remove(0);
    let layout = Layout::of(16, config.points);
    assert_eq!(Some(triangles.payload.len() as u32), layout.triangles_words(count), "{}", what());
    for (place, record) in records.iter().enumerate() {
        let vertices = layout.vertices_from_words(&triangles.payload, place);
        assert_eq!(vertices, layout.record_from_words(record).0, "record {place}, {}", what());
    }
    if count > 0 {
        let arrived = &points[..points.len().min(config.points as usize)];
        let found = canonical(&records, arrived, config.points).unwrap_or_else(|fault| panic!("{fault}, {}", what()));
        let right = canonical(&records_of(model.mesh(), config.points), arrived, config.points);
        assert_eq!(Ok(found), right, "{}", what());
    }
    let all_locks = (0..2 * config.points).all(|id| bench.core.record_words(id)[0] >> 31 == 0);
    assert!(all_locks, "a lock is left, {}", what());
    bench.counters().unwrap()
}

/// Checks the relations between the counters that hold after every job that made a mesh, whatever the timing.
fn check_counters(bench: &mut Bench, job: &Job, counters: &Answer) {
    let latencies = {
        let words = [command_word(Opcode::Latencies)];
        bench.run(&words, 1, Stalls::default(), 1000, &mut Random(0)).unwrap().swap_remove(0).payload
    };
    assert_eq!((counters.payload.len(), latencies.len()), (COUNTER_WORDS, LATENCY_BUCKETS));
    let of = |counter: Counter| counters.counter(counter);
    let what = || format!("{counters:?}, {latencies:?}, {} contexts, pieces {:x?}", job.contexts, job.pieces);
    let expect = |holds: bool, rule: &str| assert!(holds, "{rule}: {}", what());
    let insertions = of(Counter::Insertions);
    let commits: u64 = latencies.iter().map(|&count| u64::from(count)).sum();
    let solo = insertions - 3 - commits;
    let (flips, tests) = (of(Counter::Flips), of(Counter::Tests));
    let (walks, roots, cavities) = (of(Counter::WalkVisits), of(Counter::RootVisits), of(Counter::CavityTriangles));
    let sent = job.points().len() as u64;
    expect(insertions + of(Counter::Duplicates) + of(Counter::Refused) == sent, "every point has one fate");
    expect(solo <= of(Counter::Overflows), "no solo insertion without an overflow");
    expect(walks >= insertions - 3 + of(Counter::Duplicates), "every point is walked to");
    expect(roots >= commits, "every cavity has a root");
    expect(cavities >= commits && tests >= cavities + 2 * commits, "every edge of a boundary is tested");
    expect(tests >= cavities + 2 * commits + 2 * flips + 3 * solo, "two tests a flip, and three");

    // One visit is that of the first three points. A solo insertion has a visit of its root, two neighbours to correct,
    // and a visit for each triangle of its star.
    let visits = 1 + walks + roots + tests;
    match of(Counter::Overflows) {
        0 => expect(of(Counter::IssueCycles) == visits, "every visit is counted"),
        _ => expect(of(Counter::IssueCycles) >= visits + 6 * solo + flips, "a solo insertion looks at its star"),
    }
    // The writes are the first triangle and its ghosts, the records of stars, and at most one
    // neighbour for each record.
    let stars = cavities + 2 * commits;
    let splits = 5 * solo + 3 * flips;
    let writes = of(Counter::WriteCycles);
    expect(writes >= 5 + stars + splits, "every record of a star is written");
    expect(writes <= 5 + 2 * stars + splits + flips + 3 * solo, "no more than a link for each");
    expect(of(Counter::CommitCycles) >= stars + commits, "a commit writes once a clock, but for its first");
    expect(of(Counter::ReleaseCycles) <= roots + tests, "only locks that were taken are released");
    expect(of(Counter::ReleaseCycles) >= 2 * commits, "and those are");
    let busiest = [Counter::WaitCycles, Counter::IssueCycles, Counter::WriteCycles, Counter::CommitCycles]
        .map(&of)
        .into_iter()
        .max();
    expect(busiest <= Some(of(Counter::InsertCycles)), "nothing is counted twice in a clock");
    expect(2 * of(Counter::ReadCycles) >= 3 * (2 * insertions - 2), "two words a clock are read");
    expect(of(Counter::PrioritiesTaken) <= of(Counter::Aborts), "only who aborts takes the priority");

    let (least, most) = (of(Counter::LatencyMin) as u32, of(Counter::LatencyMax) as u32);
    let first = latencies.iter().position(|&count| count != 0).map(latency_of_bucket);
    let last = latencies.iter().rposition(|&count| count != 0);
    expect(least <= most && (most == 0) == (commits == 0), "a latency for every commit");
    expect(first.is_none_or(|first| latency_bucket(least) == latency_bucket(first)), "the least is in its bucket");
    expect(last.is_none_or(|last| latency_bucket(most) == last), "the most is in its bucket");
    if job.contexts == 1 || bench.config.contexts == 1 {
        expect(of(Counter::Aborts) == 0, "one context meets no foreign lock");
        expect(solo == of(Counter::Overflows), "and each overflow leads to a solo insertion");
    }
}

#[test]
fn answers_as_the_model_by_commands() {
    let mut random = Random(3);
    let mut seen = [0u64; COUNTER_WORDS];
    for ring in [3, 6, 9, 32, 64] {
        for contexts in [1, 2, 3, 4, 5, 7, 8, 12, 16, 17, 20, 23, 24] {
            for (points, jobs) in [(4, 8), (8, 20), (16, 10), (32, 8), (64, 16), (256, 8), (1024, 4)] {
                let config = Config { name: "test", points, ring, contexts, engines: 1 };
                let mut bench = Bench::new(config);
                for turn in 0..jobs {
                    let job = Job::random(config, &mut random);
                    let stalls = [(0, 0), (2, 3), (5, 2), (40, 40)][turn % 4];
                    let stalls = Stalls { idle: stalls.0, full: stalls.1, beat: 0 };
                    let counters = compare(&mut bench, &job, stalls, &mut random);
                    if counters.counter(Counter::Insertions) >= 3 {
                        check_counters(&mut bench, &job, &counters);
                    }
                    for (sum, value) in seen.iter_mut().zip(&counters.payload) {
                        *sum += u64::from(*value);
                    }
                }
            }
        }
    }
    let least = |counter: Counter, count: u64| {
        let found = seen[counter as usize];
        assert!(found >= count, "{counter:?} only {found} times");
    };
    least(Counter::Insertions, 40_000);
    least(Counter::Duplicates, 15_000);
    least(Counter::Refused, 20_000);
    least(Counter::Overflows, 15_000);
    least(Counter::Aborts, 20_000);
    least(Counter::RootRetries, 300);
    least(Counter::Revisits, 8000);
    least(Counter::PrioritiesTaken, 3000);
}

#[test]
fn stands_with_every_number_of_contexts() {
    let mut random = Random(5);
    for contexts in 1..=24 {
        let config = Config { name: "test", points: 512, ring: 32, contexts, engines: 1 };
        let mut bench = Bench::new(config);
        let points = sets::boxed(&mut random, 400, 1 << 16);
        for active in 0..=contexts {
            let job = Job { contexts: active, pieces: vec![points.clone()] };
            let counters = compare(&mut bench, &job, Stalls::default(), &mut random);
            check_counters(&mut bench, &job, &counters);
        }
    }
}

#[test]
fn refuses_what_it_does_not_know_and_goes_on() {
    let config = Config { name: "test", points: 64, ring: 6, contexts: 5, engines: 1 };
    let mut random = Random(6);
    let mut bench = Bench::new(config);
    let mut run = |words: &[u32]| {
        let stalls = Stalls { idle: 3, full: 3, beat: 0 };
        bench.run(words, 1, stalls, 20_000, &mut random).unwrap().swap_remove(0)
    };
    let points = sets::boxed(&mut Random(7), 60, 1 << 16);
    let insert: Vec<u32> = [command_word(Opcode::Insert), 60].into_iter().chain(points.iter().copied()).collect();
    assert!(run(&insert).is(Status::Ok));
    let before = run(&[command_word(Opcode::Counters)]);
    for word in [1, 0x0800_0000, 0x2a00_0003, 0xffff_ffff, 0x8000_0000] {
        let answer = run(&[word]);
        let opcode = (word >> 24) as u8;
        assert_eq!(answer, Answer { opcode, status: Status::UnknownOpcode as u8, payload: Vec::new() });
    }
    for contexts in [6, 24, 25, 255, 1000] {
        let answer = run(&[clear_word(contexts)]);
        let opcode = Opcode::Clear as u8;
        assert_eq!(answer, Answer { opcode, status: Status::BadContexts as u8, payload: Vec::new() });
    }
    assert_eq!(run(&[command_word(Opcode::Counters)]), before, "nothing was cleared");
    let nothing = run(&[command_word(Opcode::Insert), 0]);
    assert!(nothing.is(Status::Ok) && nothing.report().inserted == 60);
    assert!(run(&[clear_word(5)]).is(Status::Ok));
    let nothing = run(&[command_word(Opcode::Insert), 0]);
    assert!(nothing.is(Status::Ok) && nothing.report().arrived == 0);
    let hello = run(&[command_word(Opcode::Hello)]);
    let identity = Identity::from_words(hello.payload[..].try_into().unwrap());
    let parameters = (identity.capacity, identity.ring_capacity, identity.contexts, identity.coord_bits);
    assert_eq!(parameters, (64, 6, 5, 16));
}

#[test]
fn reset_in_mid_job_leaves_nothing_behind() {
    let mut random = Random(8);
    for contexts in [1, 2, 8, 24] {
        let config = Config { name: "test", points: 128, ring: 9, contexts, engines: 1 };
        let mut bench = Bench::new(config);
        for _ in 0..25 {
            let side = random.pick(&[5, 40, 1 << 16]);
            let points = sets::boxed(&mut random, 128, side);
            let mut words = vec![clear_word(0), command_word(Opcode::Insert), 128];
            words.extend(points);
            let clocks = u64::from(random.below(6000));
            // The job may end before the limit or not; both are fine.
            let _ = bench.run(&words, 2, Stalls::default(), clocks, &mut random);
            bench.reset();
            let job = Job::random(config, &mut random);
            compare(&mut bench, &job, Stalls::default(), &mut random);
        }
    }
}

/// A host in step with the pointer that goes round the contexts must not keep any of them from its turn.
#[test]
fn no_beat_of_the_host_slows_the_core_down() {
    let mut random = Random(9);
    let points = sets::boxed(&mut random, 480, 1 << 16);
    for contexts in [2, 3, 4, 8, 12, 16, 24] {
        let mut bench = Bench::new(Config { name: "test", points: 512, ring: 32, contexts, engines: 1 });
        let mut cycles = |beat: u64| {
            let job = Job { contexts: 0, pieces: vec![points.clone()] };
            let stalls = Stalls { beat, ..Stalls::default() };
            compare(&mut bench, &job, stalls, &mut random).counter(Counter::InsertCycles)
        };
        let in_every_clock = cycles(0);
        for beat in 1..=2 * u64::from(contexts) {
            let found = cycles(beat);
            let most = in_every_clock + in_every_clock / 3;
            assert!(
                found < most,
                "{contexts} contexts, a word every {beat} clocks: {found} and {in_every_clock} cycles"
            );
        }
    }
}
