//! Runs cores that answer questions beside their model, and compares every root port at every clock: random scripts of
//! insertions and runs of `Locate`, `Interpolate` and `Nearest`, crossed with idle clocks and back-pressure. All
//! answers are compared with the model by commands, which knows no clock.

use incircle_model::CommandModel;
use incircle_protocol::{
    batch_word, command_word, Clear, Config, Located, Meshes, Opcode, Outcome, RunKind, CORE_COORD_BITS, COUNTER_WORDS,
    PADDING, SMALL, TINY,
};
use incircle_testbench::lockstep::{Fault, Job, Lockstep, Mismatch, Stalls, QUESTION_FAULTS};
use incircle_testkit::SplitMix64;

/// A command of a script.
enum Step {
    Clear(Clear),
    /// A batch with a job for each context.
    Batch,
    Insert(Vec<u32>),
    Ask(RunKind, Vec<u32>),
    Counters,
    Hello,
}

impl Step {
    fn words(&self) -> Vec<u32> {
        let with_items = |opcode, items: &[u32]| [&[command_word(opcode), items.len() as u32], items].concat();
        match self {
            Self::Clear(clear) => vec![clear.word()],
            Self::Batch => vec![batch_word(0)],
            Self::Insert(points) => with_items(Opcode::Insert, points),
            Self::Ask(kind, places) => with_items(kind.opcode(), places),
            Self::Counters => vec![command_word(Opcode::Counters)],
            Self::Hello => vec![command_word(Opcode::Hello)],
        }
    }
}

/// Outcome of an item, and its vertices with their weights.
type Finding = (u32, [(u32, u64); 3]);

/// What each item has found, in the order of their numbers. Where a place lies in several records, or a record
/// may begin at any of its vertices, the order of the vertices is not fixed, and on an edge or a vertex only the ratio
/// of the weights is. Of points at one place, that one is a vertex which a context inserted first; so each vertex
/// stands here as the lowest id at its place.
fn findings(kind: RunKind, parts: &[u32], arrived: &[u32]) -> Vec<Finding> {
    let lowest = |id: u32| {
        let same = |&place: &u32| arrived.iter().position(|&other| other == place);
        arrived.get(id as usize).and_then(same).map_or(id, |first| first as u32)
    };
    let mut parts: Vec<&[u32]> = parts.chunks(kind.part_words()).collect();
    parts.sort_unstable_by_key(|part| part[0] & 0xff_ffff);
    let numbers: Vec<u32> = parts.iter().map(|part| part[0] & 0xff_ffff).collect();
    assert_eq!(numbers, (0..parts.len() as u32).collect::<Vec<_>>(), "each item has one part");
    parts
        .iter()
        .map(|part| {
            let (outcome, located) = (part[0] >> 24, Located::from_words(&part[1..]));
            let mut named = [0, 1, 2].map(|place| (lowest(located.vertices[place]), located.weights[place]));
            match outcome {
                outcome if outcome == Outcome::Edge as u32 => named[..2].sort_unstable(),
                outcome if outcome == Outcome::Triangle as u32 => named.sort_unstable(),
                _ => {}
            }
            if outcome != Outcome::Triangle as u32 {
                let divisor = named.iter().fold(0, |divisor, &(_, weight)| common_divisor(divisor, weight)).max(1);
                named = named.map(|(vertex, weight)| (vertex, weight / divisor));
            }
            (outcome, named)
        })
        .collect()
}

fn common_divisor(a: u64, b: u64) -> u64 {
    if b == 0 {
        a
    } else {
        common_divisor(b, a % b)
    }
}

/// Runs of a script without parts, then parts by their outcome, for each kind of [`KINDS`].
type Seen = [[usize; 5]; 3];

const KINDS: [RunKind; 3] = [RunKind::Locate, RunKind::Interpolate, RunKind::Nearest];

/// Runs the script, and compares the answers.
fn run(
    pair: &mut Lockstep,
    config: Config,
    steps: &[Step],
    stalls: Stalls,
    random: &mut SplitMix64,
) -> Result<Seen, Box<Mismatch>> {
    let mut model = CommandModel::new(CORE_COORD_BITS, config.points, config.ring)
        .unwrap_or_else(|error| panic!("{error}"))
        .with_contexts(config.contexts)
        .with_core_runs();
    let mut commands = Vec::new();
    for step in steps {
        commands.extend(step.words());
        commands.extend(vec![PADDING; random.below(3) as usize]);
    }
    model.send(&commands);
    let mut expected = vec![0; 1 << 20];
    let count = model.receive(&mut expected);
    assert!(count < expected.len());
    expected.truncate(count);
    let job = Job { commands, answers: expected.len() };
    let answers = pair.run(&job, stalls, &mut || random.next_u64())?;
    let (mut place, mut seen, mut arrived) = (0, Seen::default(), Vec::new());
    for step in steps {
        assert_eq!(answers[place..place + 2], expected[place..place + 2], "head of an answer");
        let payload = place + 2..place + 2 + answers[place + 1] as usize;
        place = payload.end;
        let (answer, expected) = (&answers[payload.clone()], &expected[payload]);
        match step {
            Step::Ask(kind, _) => {
                let found = findings(*kind, answer, &arrived);
                assert_eq!(found, findings(*kind, expected, &arrived));
                let seen = &mut seen[KINDS.iter().position(|other| other == kind).expect("a kind of the core")];
                seen[0] += usize::from(found.is_empty());
                found.iter().for_each(|(outcome, _)| seen[*outcome as usize] += 1);
            }
            Step::Counters => assert_eq!(answer.len(), COUNTER_WORDS),
            Step::Insert(points) => {
                arrived.extend_from_slice(points);
                assert_eq!(answer, expected);
            }
            Step::Clear(_) | Step::Batch => {
                arrived.clear();
                assert_eq!(answer, expected);
            }
            // The identity says which runs the core has.
            Step::Hello => assert_eq!(answer, expected),
        }
    }
    assert_eq!(place, answers.len());
    Ok(seen)
}

/// Up to this many words of points on a grid of this side.
fn words(random: &mut SplitMix64, most: u64, side: u64) -> Vec<u32> {
    (0..random.below(most + 1)).map(|_| (random.below(side) | random.below(side) << 16) as u32).collect()
}

/// A script about one mesh, or about none.
fn script(random: &mut SplitMix64, config: Config, points: u64, places: u64) -> Vec<Step> {
    let side = [2, 3, 4, 9, 1 << 16][random.below(5) as usize];
    let contexts = random.below(u64::from(config.contexts) + 1) as u32;
    let mut steps = vec![match random.below(9) {
        0 => Step::Batch,
        _ => Step::Clear(Clear { contexts, meshes: Meshes::One, tag: random.bits(8) as u8 }),
    }];
    // The first triangle of a batch would need three points of each job, so nothing is inserted there.
    let is_batch = matches!(steps[0], Step::Batch);
    for _ in 0..1 + random.below(4) {
        if !is_batch && random.once_in(2) {
            steps.push(Step::Insert(words(random, points, side)));
        }
        if random.once_in(4) {
            steps.push(Step::Counters);
        }
        if random.once_in(8) {
            steps.push(Step::Hello);
        }
        let kind = KINDS[random.below(3) as usize];
        steps.push(Step::Ask(kind, words(random, places, side.min((1 << 16) - 2) + 2)));
    }
    steps
}

fn random_scripts(name: &str, config: Config, scripts: usize, points: u64, places: u64) {
    let mut random = SplitMix64::new(71);
    let mut pair = Lockstep::new(name, config, 71).with_core_runs();
    let mut seen = Seen::default();
    for number in 0..scripts {
        if number % 40 == 39 {
            pair = Lockstep::new(name, config, number as u32).with_core_runs();
        }
        let steps = script(&mut random, config, points, places);
        let found = run(&mut pair, config, &steps, Stalls::ALL[number % 9], &mut random);
        let found = found.unwrap_or_else(|mismatch| panic!("{mismatch}"));
        seen.as_flattened_mut().iter_mut().zip(found.as_flattened()).for_each(|(sum, count)| *sum += count);
    }
    // A `Nearest` has one outcome.
    let all = || seen[..2].as_flattened().iter().chain(&seen[2][..2]);
    assert!(
        all().all(|&count| count > scripts / 30),
        "for each kind, runs without parts, then parts by outcome: {seen:?}"
    );
}

#[test]
fn scripts_on_a_tiny_core() {
    random_scripts("core_tiny_questions", TINY, 800, 6, 20);
}

#[test]
fn scripts_on_a_small_core() {
    random_scripts("core_small_questions", SMALL, 200, 120, 150);
}

/// Runs scripts on a core without one of the rules of questions, until a port differs from the model.
#[test]
fn cores_with_a_broken_block_of_questions_are_caught() {
    const CORE: &str = "faulty_core_questions";
    let first_mismatch = |faults: &[&str]| {
        let mut random = SplitMix64::new(72);
        let mut pair = Lockstep::faulty(CORE, TINY, 72, faults).with_core_runs();
        (0..200).find_map(|number| {
            let steps = script(&mut random, TINY, 6, 60);
            run(&mut pair, TINY, &steps, Stalls::ALL[number % 9], &mut random).err().map(|mismatch| (number, mismatch))
        })
    };
    assert!(first_mismatch(&[]).is_none(), "the sound core equals its model");
    for Fault { name, .. } in QUESTION_FAULTS {
        let (number, mismatch) = first_mismatch(&[name]).unwrap_or_else(|| panic!("{name} is not caught"));
        println!("{name}: caught in script {number}, at port {}", mismatch.port);
    }
}
