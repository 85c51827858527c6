//! Runs chips of two and four engines beside their model: every root port is compared at every clock, with jobs of all
//! kinds one behind the other, idle clocks, back-pressure and resets. Each job must get the answers that the model by
//! commands gives to it alone, whatever the order in which the engines give theirs. A chip with a broken engine must
//! say so, and do all other jobs with the other engine.

use std::collections::{BTreeMap, BTreeSet};

use incircle_model::{CommandModel, Defect, Inputs};
use incircle_protocol::{
    answer_engine, answer_opcode, answer_status, answer_tag, command_word, Clear, Config, Layout, Meshes, Opcode,
    Status, CORE_COORD_BITS, PADDING, TINY,
};
use incircle_testbench::lockstep::{Job, Lockstep, Stalls};
use incircle_testkit::SplitMix64;

const DUAL: Config = Config { engines: 2, ..TINY };
const QUAD: Config = Config { points: 16, engines: 4, ..TINY };
/// The chip with a broken engine; engine 1 takes its own locks for those of another context.
const BROKEN: Config = Config { points: 64, ring: 9, engines: 2, ..TINY };

/// An answer, from its header on.
type Answer = Vec<u32>;

/// Divides a stream of words into answers.
fn answers_in(words: &[u32]) -> Vec<Answer> {
    let (mut rest, mut answers) = (words, Vec::new());
    while !rest.is_empty() {
        let (answer, after) = rest.split_at(2 + rest[1] as usize);
        answers.push(answer.to_vec());
        rest = after;
    }
    answers
}

/// The answers that a core alone gives to these commands.
fn alone(commands: &[u32], config: Config) -> Vec<Answer> {
    let model = CommandModel::new(CORE_COORD_BITS, config.points, config.ring).expect("possible");
    let mut model = model.with_contexts(config.contexts);
    model.send(commands);
    let mut words = vec![0; 100_000];
    let count = model.receive(&mut words);
    answers_in(&words[..count])
}

/// An answer without what depends on the engine: its number, the order of the records, and what a clock counts.
fn essence(answer: &Answer, config: Config) -> (u32, u32, Vec<u32>, BTreeSet<[u32; 3]>) {
    let (head, payload) = answer.split_at(2);
    let sorted = |v: [u32; 3]| {
        let least = (0..3).min_by_key(|&place| v[place]).expect("three places");
        [v[least], v[(least + 1) % 3], v[(least + 2) % 3]]
    };
    let layout = Layout::of(CORE_COORD_BITS, config.points);
    let (words, records) = match Opcode::from_u8(answer_opcode(head[0])) {
        Some(Opcode::Triangles) => {
            let count = 2 * payload.len() / 3;
            (vec![], (0..count).map(|place| sorted(layout.vertices_from_words(payload, place))).collect())
        }
        Some(Opcode::Read) => {
            (vec![], payload.chunks(3).map(|words| sorted(layout.record_from_words(words).0)).collect())
        }
        Some(Opcode::Counters | Opcode::Latencies | Opcode::Hello) => (vec![], BTreeSet::new()),
        _ => (payload.to_vec(), BTreeSet::new()),
    };
    (head[0] & 0xffff_00ff, head[1], words, records)
}

/// A job with this tag: its `Clear`, points in pieces, and commands of all kinds behind them.
fn job(random: &mut SplitMix64, tag: u8, config: Config) -> Vec<u32> {
    let contexts = random.below(u64::from(config.contexts) + 2) as u32;
    let meshes = [Meshes::One, Meshes::One, Meshes::OnePerContext][random.below(3) as usize];
    let mut words = vec![Clear { contexts, meshes, tag }.word()];
    // A refused `Clear` leaves the mesh of another job, so the commands behind it must not depend on the mesh.
    let is_refused = contexts > config.contexts;
    let side = [2, 4, 16, 1 << 16][random.below(4) as usize];
    for _ in 0..if is_refused { 0 } else { random.below(3) } {
        let count = random.below(u64::from(config.points) + 3);
        words.extend([command_word(Opcode::Insert), count as u32]);
        words.extend((0..count).map(|_| (random.below(side) | random.below(side) << 16) as u32));
    }
    let answers = alone(&words, config);
    let mut reports = answers.iter().filter(|answer| answer_opcode(answer[0]) == Opcode::Insert as u8);
    let records = reports.next_back().map_or(0, |answer| answer[6]);
    for _ in 0..random.below(5) {
        match random.below(if is_refused { 4 } else { 7 }) {
            0 => words.extend([PADDING, PADDING]),
            1 => words.push(0x2a00_0000),
            2 => words.push(command_word(Opcode::Counters)),
            3 => words.push(command_word(Opcode::Hello)),
            4 => words.extend([command_word(Opcode::Read), 0, records + random.below(2) as u32]),
            _ => words.extend([command_word(Opcode::Triangles), 0, records]),
        }
    }
    words
}

/// Runs jobs, and returns the answers to each in their order.
fn run(pair: &mut Lockstep, jobs: &[Vec<u32>], config: Config, stalls: Stalls, seed: u64) -> BTreeMap<u8, Vec<Answer>> {
    let words = jobs.iter().flat_map(|job| alone(job, config)).map(|answer| answer.len()).sum();
    let mut random = SplitMix64::new(seed);
    let done = pair.run(&Job { commands: jobs.concat(), answers: words }, stalls, &mut || random.next_u64());
    let answers = answers_in(&done.unwrap_or_else(|mismatch| panic!("{mismatch}")));
    let mut by_tag: BTreeMap<u8, Vec<Answer>> = BTreeMap::new();
    for answer in answers {
        by_tag.entry(answer_tag(answer[0])).or_default().push(answer);
    }
    by_tag
}

/// Runs rounds of jobs on a chip, and compares the answers to each job with those to the job alone.
fn jobs_of_all_kinds(name: &str, config: Config, rounds: u64) {
    let mut used = BTreeMap::new();
    for round in 0..rounds {
        let mut random = SplitMix64::new(round);
        let mut pair = Lockstep::new(name, config, round as u32 + 1);
        let jobs: Vec<_> = (0..60).map(|tag| job(&mut random, tag, config)).collect();
        let answers = run(&mut pair, &jobs, config, Stalls::ALL[round as usize % 9], round);
        for (tag, words) in (0..).zip(&jobs) {
            let expected: Vec<_> = alone(words, config).iter().map(|answer| essence(answer, config)).collect();
            let own = &answers[&tag];
            let found: Vec<_> = own.iter().map(|answer| essence(answer, config)).collect();
            assert_eq!(found, expected, "job {tag} of round {round}, {words:x?}");
            let engine = answer_engine(own[0][0]);
            assert!(own.iter().all(|answer| answer_engine(answer[0]) == engine), "one engine for a job");
            *used.entry(engine).or_insert(0) += 1;
        }
    }
    assert_eq!(used.len(), config.engines as usize, "{used:?}");
    assert!(used.values().all(|&jobs| jobs > 5 * rounds), "{used:?}");
    println!("{name}: jobs of each engine {used:?}");
}

#[test]
fn two_engines_do_jobs_of_all_kinds() {
    jobs_of_all_kinds("core_dual_tiny", DUAL, 27);
}

#[test]
fn four_engines_do_jobs_of_all_kinds() {
    jobs_of_all_kinds("core_quad_tiny", QUAD, 27);
}

/// The netlist that synthesis makes for an ECP5, cell by cell.
#[test]
fn the_netlist_of_two_engines_does_jobs_of_all_kinds() {
    jobs_of_all_kinds("netlist_dual_tiny", DUAL, 6);
}

/// Any words whatever, with resets at any clock: the chip and its model agree.
fn words_out_of_place(name: &str, config: Config) {
    let mut random = SplitMix64::new(77);
    let mut pair = Lockstep::new(name, config, 77);
    for turn in 0..120 {
        let words: Vec<u32> = (0..60)
            .flat_map(|_| match random.below(6) {
                0 => vec![random.next_u64() as u32 & 0x0fff_ffff],
                1 => vec![random.below(9) as u32],
                _ => job(&mut random, turn, config),
            })
            // A random number of points would hold up the stream for ever.
            .map(|word| if word >> 8 == 0 { word & 0xf } else { word })
            .collect();
        let mut rest = words.as_slice();
        for _ in 0..random.below(6000) {
            let inputs = Stalls::ALL[usize::from(turn) % 9].inputs(rest, random.next_u64());
            if inputs.command_valid && pair.outputs().command_ready {
                rest = &rest[1..];
            }
            pair.clock(inputs).unwrap_or_else(|mismatch| panic!("{mismatch}"));
        }
        let reset = Inputs { reset: true, command_valid: turn % 2 == 0, response_ready: true, ..Inputs::default() };
        for _ in 0..1 + random.below(3) {
            pair.clock(reset).unwrap_or_else(|mismatch| panic!("{mismatch}"));
        }
    }
    // After a reset, engine 0 answers what comes before the first `Clear`, with the tag 0.
    let hello = vec![command_word(Opcode::Hello)];
    let answers = run(&mut pair, &[hello], config, Stalls::NONE, 1);
    assert_eq!(answers[&0][0][0], 0x0100_0000);
    assert_eq!(answers[&0][0][7], config.engines << 8 | config.contexts);
}

#[test]
fn words_out_of_place_and_resets_on_two_engines() {
    words_out_of_place("core_dual_tiny", DUAL);
}

#[test]
fn words_out_of_place_and_resets_on_four_engines() {
    words_out_of_place("core_quad_tiny", QUAD);
}

/// A job of random points that reads its mesh.
fn whole(random: &mut SplitMix64, tag: u8) -> Vec<u32> {
    let count = 40 + random.below(20);
    let mut words = vec![Clear { contexts: 0, meshes: Meshes::One, tag }.word(), command_word(Opcode::Insert)];
    words.push(count as u32);
    words.extend((0..count).map(|_| random.next_u64() as u32));
    let report = alone(&words, BROKEN);
    words.extend([command_word(Opcode::Triangles), 0, report[1][6]]);
    words
}

#[test]
fn a_broken_engine_says_so_and_the_other_goes_on() {
    let mut random = SplitMix64::new(5);
    let mut pair = Lockstep::new("faulty_core_dual", BROKEN, 5).with_defect_in(1, Defect::TakesOwnForForeign);
    let mut chances = SplitMix64::new(6);
    let jobs: Vec<_> = (0..40).map(|tag| whole(&mut random, tag)).collect();
    let mut rest: &[u32] = &jobs.concat();
    let mut words = Vec::new();
    // Until nothing more comes: a stuck engine answers a read-out of its mesh as it can.
    let mut silent = 0;
    while silent < 200_000 {
        let inputs = Stalls::NONE.inputs(rest, chances.next_u64());
        let outputs = pair.outputs();
        silent += 1;
        if inputs.command_valid && outputs.command_ready {
            (rest, silent) = (&rest[1..], 0);
        }
        if outputs.response_valid {
            silent = 0;
            words.extend(outputs.answer_words());
        }
        pair.clock(inputs).unwrap_or_else(|mismatch| panic!("{mismatch}"));
    }
    assert!(rest.is_empty(), "{} words were not taken", rest.len());
    let answers = answers_in(&words);
    let is_stuck = |answer: &&Answer| answer_status(answer[0]) == Status::Stuck as u8;
    let stuck: Vec<&Answer> = answers.iter().filter(is_stuck).collect();
    assert_eq!(stuck.len(), 1, "one job finds the engine stuck, and no other goes there: {stuck:x?}");
    assert_eq!(answer_engine(stuck[0][0]), 1);
    let lost = answer_tag(stuck[0][0]);
    let after = answers.iter().skip_while(|answer| !is_stuck(answer)).filter(|answer| answer_tag(answer[0]) != lost);
    assert!(after.clone().count() > 20, "{} answers", after.clone().count());
    assert!(after.into_iter().all(|answer| answer_engine(answer[0]) == 0));
    for (tag, job) in (0..).zip(&jobs).filter(|(tag, _)| *tag != lost) {
        let own = answers.iter().filter(|answer| answer_tag(answer[0]) == tag);
        let found: Vec<_> = own.map(|answer| essence(answer, BROKEN)).collect();
        let expected: Vec<_> = alone(job, BROKEN).iter().map(|answer| essence(answer, BROKEN)).collect();
        assert_eq!(found, expected, "job {tag}");
    }
    // After a reset both engines get jobs again.
    pair.clock(Inputs { reset: true, ..Inputs::default() }).unwrap_or_else(|mismatch| panic!("{mismatch}"));
    let few = vec![Clear::one_mesh(0).word(), command_word(Opcode::Insert), 3, 0, 9, 0x9_0000];
    let first = run(&mut pair, &[few], BROKEN, Stalls::NONE, 1);
    let inserted = &first[&0][1];
    assert_eq!((answer_engine(inserted[0]), answer_status(inserted[0])), (1, Status::Ok as u8));
}
