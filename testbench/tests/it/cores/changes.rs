//! Runs cores that change a mesh that stands beside their model, and compares every root port at every clock: random
//! scripts of `InsertAs`, `Delete`, `Move`, `Insert` and questions on small grids, crossed with idle clocks and
//! back-pressure. Parts and meshes are compared with the model by commands, which knows no clock.
//!
//! A host puts no vertex and no place twice into one run. Where a script does, the order of the items is the core's
//! own. Then its parts say which items were done, and the model by commands does these alone: the meshes must be equal.

use crate::rig::changes::Rig;
use incircle_model::{ClockModel, Inputs};
use incircle_protocol::{command_word, Clear, Config, Opcode, Outcome, FULL, SMALL, TINY};
use incircle_testbench::lockstep::{Fault, Lockstep, Mismatch, Stalls, CHANGE_FAULTS};
use incircle_testkit::{generate, Distribution};

const CROWD: Config = Config { points: 64, ring: 6, contexts: 8, ..TINY };

fn random_scripts(name: &str, config: Config, scripts: usize, points: u64, items: u64) {
    let mut seen = [0; 16];
    let mut rig = Rig::new(Lockstep::new(name, config, 81), config, 81);
    for number in 0..scripts {
        if number % 20 == 19 {
            rig = Rig::new(Lockstep::new(name, config, number as u32), config, number as u64);
        }
        rig.stalls = Stalls::ALL[number % 9];
        rig.script(points, items).unwrap_or_else(|mismatch| panic!("script {number}: {mismatch}"));
        seen.iter_mut().zip(std::mem::take(&mut rig.seen)).for_each(|(sum, count)| *sum += count);
    }
    println!("{name}: outcomes {seen:?}");
    for outcome in [Outcome::Done, Outcome::Duplicate, Outcome::Missing, Outcome::InUse, Outcome::Full] {
        assert!(seen[outcome as usize] > scripts / 20, "{outcome:?} comes up: {seen:?}");
    }
    // Only meshes of a few points have a vertex without which all others lie on one line.
    let has_few = config.points < 1000;
    assert!(!has_few || seen[Outcome::Flat as usize] > scripts / 50, "vertices that must stay: {seen:?}");
    let refuses_many = config.ring < 10 && config.points > 10;
    assert!(!refuses_many || seen[Outcome::ManyNeighbors as usize] > scripts / 50, "long rings: {seen:?}");
    assert!(seen[15] > scripts / 50, "runs with a vertex or a place twice: {seen:?}");
}

/// A script of [`Rig`].
type Script = fn(&mut Rig) -> Result<(), Box<Mismatch>>;

/// The scripts that show faults: of all commands; of moves of a few vertices, again and again; and of vertices that
/// leave the mesh, and come back where others are.
const MIXED: Script = |rig| rig.script(24, 60);
const OF_FEW: Script = |rig| rig.script_of_few();
const OF_DUPLICATES: Script = |rig| rig.script_of_duplicates();

/// Runs scripts on a core with faults, until a port differs from the model. Returns the number of that script, and the
/// mismatch.
fn first_mismatch(pair: Lockstep, script: Script, scripts: usize) -> Option<(usize, Box<Mismatch>)> {
    let mut rig = Rig::new(pair, CROWD, 85);
    (0..scripts).find_map(|number| {
        rig.stalls = Stalls::ALL[number % 9];
        script(&mut rig).err().map(|mismatch| (number, mismatch))
    })
}

/// Runs scripts on a core without one of the rules of changes.
#[test]
fn cores_with_a_broken_block_of_changes_are_caught() {
    let pair = |faults: &[&str]| Lockstep::faulty("faulty_core_changes", CROWD, 85, faults);
    for script in [MIXED, OF_FEW, OF_DUPLICATES] {
        assert!(first_mismatch(pair(&[]), script, 60).is_none(), "the sound core equals its model");
    }
    let mut missed = Vec::new();
    for Fault { name, .. } in CHANGE_FAULTS {
        let kinds = [(MIXED, 1500), (OF_FEW, 300), (OF_DUPLICATES, 60)];
        let caught = kinds.into_iter().find_map(|(script, count)| first_mismatch(pair(&[name]), script, count));
        match caught {
            Some((number, mismatch)) => println!("{name}: caught in script {number}, at port {}", mismatch.port),
            None => missed.push(name),
        }
    }
    assert!(missed.is_empty(), "not caught: {missed:?}");
}

/// Number of clocks of these commands, until this many words of answers have been taken.
fn clocks(model: &mut ClockModel, words: &[u32], answers: usize) -> usize {
    let (mut rest, mut taken, mut clocks) = (words, 0, 0);
    while !rest.is_empty() || taken < answers {
        let outputs = model.outputs();
        taken += if outputs.response_valid { 1 + usize::from(outputs.response_both) } else { 0 };
        model.clock(Inputs {
            reset: false,
            command_valid: !rest.is_empty(),
            command_data: rest.first().copied().unwrap_or(0),
            response_ready: true,
        });
        if outputs.command_ready && !rest.is_empty() {
            rest = &rest[1..];
        }
        clocks += 1;
    }
    clocks
}

/// Cycles of an `InsertAs` in a run that makes 8,000 points out of this many, in Hilbert order, dealt to 16 contexts.
fn cycles_of_insert_as(mut model: ClockModel, first: usize) -> f64 {
    let points = generate(Distribution::Uniform, 8_000, 16, 1).expect("a set of this size");
    let word = |point: &[u32; 2]| point[0] | point[1] << 16;
    let (standing, new) = points.split_at(first);
    let mut insert = vec![Clear::default().word(), command_word(Opcode::Insert), first as u32];
    insert.extend(standing.iter().map(word));
    clocks(&mut model, &insert, 2 + 7);
    let stored: Vec<incircle::Point> = new.iter().copied().map(incircle::Point::from).collect();
    let order = incircle::order::hilbert(&stored);
    let stretch = order.len() / 16;
    let dealt: Vec<usize> = (0..16 * stretch).map(|item| order[item % 16 * stretch + item / 16] as usize).collect();
    // The first questions bring the contexts to their stretches of the curve.
    let mut ask = vec![command_word(Opcode::Locate), 16];
    ask.extend(dealt[..16].iter().map(|&place| word(&new[place])));
    clocks(&mut model, &ask, 2 + 4 * 16);
    let mut run = vec![command_word(Opcode::InsertAs), dealt.len() as u32];
    run.extend(dealt.iter().flat_map(|&place| [(first + place) as u32, word(&new[place])]));
    clocks(&mut model, &run, 2 + 2 * dealt.len()) as f64 / dealt.len() as f64
}

#[test]
fn insert_as_takes_fewer_than_17_cycles_an_item() {
    let model = || ClockModel::new(FULL).unwrap_or_else(|error| panic!("{error}"));
    for first in [6_000, 4_000] {
        let core = cycles_of_insert_as(model().with_core_runs(), first);
        let living = cycles_of_insert_as(model().with_runs(), first);
        println!(
            "from {first} points on: {core:.2} cycles an item, and {living:.2} with the model of the living engine"
        );
        assert!(
            core < 17.0 && core < living + 1.5,
            "{core:.2} cycles an item, where the living engine takes {living:.2}"
        );
    }
}

/// The netlist that synthesis makes of `small` with runs, cell by cell, in scripts of all commands.
#[test]
#[ignore = "synthesis takes minutes, so the netlist is made only if INCIRCLE_ONLY names it: netlist_living_small"]
fn scripts_on_the_netlist_of_a_core_with_runs() {
    random_scripts("netlist_living_small", SMALL, 40, 120, 100);
}

#[test]
fn scripts_on_a_tiny_core() {
    random_scripts("core_tiny_questions", TINY, 400, 6, 12);
}

#[test]
fn scripts_on_a_crowded_core() {
    random_scripts("core_crowd_questions", CROWD, 400, 24, 60);
}

#[test]
fn scripts_on_a_small_core() {
    random_scripts("core_small_questions", SMALL, 100, 120, 150);
}
