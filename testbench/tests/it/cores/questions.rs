//! Runs cores that answer questions beside their model, and compares every root port at every clock: random scripts of
//! insertions and runs of `Locate`, crossed with idle clocks and back-pressure. All answers are compared with the model
//! by commands, which knows no clock.

use incircle_model::CommandModel;
use incircle_protocol::{
    batch_word, command_word, Clear, Config, Meshes, Opcode, Outcome, CORE_COORD_BITS, COUNTER_WORDS, PADDING, SMALL,
    TINY,
};
use incircle_testbench::lockstep::{Job, Lockstep, Stalls};
use incircle_testkit::SplitMix64;

/// A command of a script.
enum Step {
    Clear(Clear),
    /// A batch with a job for each context.
    Batch,
    Insert(Vec<u32>),
    Locate(Vec<u32>),
    Counters,
}

impl Step {
    fn words(&self) -> Vec<u32> {
        let with_items = |opcode, items: &[u32]| [&[command_word(opcode), items.len() as u32], items].concat();
        match self {
            Self::Clear(clear) => vec![clear.word()],
            Self::Batch => vec![batch_word(0)],
            Self::Insert(points) => with_items(Opcode::Insert, points),
            Self::Locate(places) => with_items(Opcode::Locate, places),
            Self::Counters => vec![command_word(Opcode::Counters)],
        }
    }
}

/// Outcome and vertices of each item, in the order of their numbers. Where a place lies in several records, or a record
/// may begin at any of its vertices, the order of the vertices is not fixed. Of points at one place, that one is a
/// vertex which a context inserted first; so each vertex stands here as the lowest id at its place.
fn findings(parts: &[u32], arrived: &[u32]) -> Vec<(u32, [u32; 3])> {
    let lowest = |id: u32| {
        let same = |&place: &u32| arrived.iter().position(|&other| other == place);
        arrived.get(id as usize).and_then(same).map_or(id, |first| first as u32)
    };
    let mut parts: Vec<&[u32]> = parts.chunks(4).collect();
    parts.sort_unstable_by_key(|part| part[0] & 0xff_ffff);
    let numbers: Vec<u32> = parts.iter().map(|part| part[0] & 0xff_ffff).collect();
    assert_eq!(numbers, (0..parts.len() as u32).collect::<Vec<_>>(), "each item has one part");
    parts
        .iter()
        .map(|part| {
            let (outcome, mut vertices) = (part[0] >> 24, [part[1], part[2], part[3]].map(lowest));
            match outcome {
                outcome if outcome == Outcome::Edge as u32 => vertices[..2].sort_unstable(),
                outcome if outcome == Outcome::Triangle as u32 => vertices.sort_unstable(),
                _ => {}
            }
            (outcome, vertices)
        })
        .collect()
}

/// Runs the script, and compares the answers.
fn run(pair: &mut Lockstep, config: Config, steps: &[Step], stalls: Stalls, random: &mut SplitMix64) -> [usize; 5] {
    let mut model = CommandModel::new(CORE_COORD_BITS, config.points, config.ring)
        .unwrap_or_else(|error| panic!("{error}"))
        .with_contexts(config.contexts)
        .with_runs();
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
    let answers = pair.run(&job, stalls, &mut || random.next_u64()).unwrap_or_else(|mismatch| panic!("{mismatch}"));
    let (mut place, mut seen, mut arrived) = (0, [0; 5], Vec::new());
    for step in steps {
        assert_eq!(answers[place..place + 2], expected[place..place + 2], "head of an answer");
        let payload = place + 2..place + 2 + answers[place + 1] as usize;
        place = payload.end;
        let (answer, expected) = (&answers[payload.clone()], &expected[payload]);
        match step {
            Step::Locate(_) => {
                let found = findings(answer, &arrived);
                assert_eq!(found, findings(expected, &arrived));
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
        }
    }
    assert_eq!(place, answers.len());
    seen
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
        steps.push(Step::Locate(words(random, places, side.min((1 << 16) - 2) + 2)));
    }
    steps
}

fn random_scripts(name: &str, config: Config, scripts: usize, points: u64, places: u64) {
    let mut random = SplitMix64::new(71);
    let mut pair = Lockstep::new(name, config, 71).with_questions();
    let mut seen = [0; 5];
    for number in 0..scripts {
        if number % 40 == 39 {
            pair = Lockstep::new(name, config, number as u32).with_questions();
        }
        let steps = script(&mut random, config, points, places);
        let found = run(&mut pair, config, &steps, Stalls::ALL[number % 9], &mut random);
        seen.iter_mut().zip(found).for_each(|(sum, count)| *sum += count);
    }
    assert!(seen.iter().all(|&count| count > scripts / 20), "runs without parts, then parts by outcome: {seen:?}");
}

#[test]
fn scripts_on_a_tiny_core() {
    random_scripts("core_tiny_questions", TINY, 800, 6, 20);
}

#[test]
fn scripts_on_a_small_core() {
    random_scripts("core_small_questions", SMALL, 200, 120, 150);
}
