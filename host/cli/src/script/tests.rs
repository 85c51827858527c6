//! Tests that no bytes make the reader of scripts, or a replay, panic.

use incircle::Triangulation;
use incircle_testkit::SplitMix64;

use super::{play, read, Film, Recipe, Script, ScriptWriter, FORMS};
use crate::lattice::{self, Numbers};
use crate::memory::Memory;
use crate::numbers::NumberKind;
use crate::progress::CountMeter;

/// Bytes that have a meaning in a script.
const SPICE: &[u8] = b"0123456789-+.eE \t\r\n#insertdelmovlca\xff\x00";

/// Replaces, inserts or removes one to four bytes, or pieces of up to 20 bytes from elsewhere.
fn spoil(sample: &[u8], random: &mut SplitMix64) -> Vec<u8> {
    let mut bytes = sample.to_vec();
    for _ in 0..=random.below(4) {
        let place = random.below(bytes.len() as u64 + 1) as usize;
        let byte = random.pick(SPICE);
        match random.below(8) {
            0 => bytes.truncate(place),
            1 | 2 => bytes.insert(place, byte),
            3 if place < bytes.len() => drop(bytes.remove(place)),
            4 => {
                let from = random.below(bytes.len() as u64 + 1) as usize;
                let piece: Vec<u8> = bytes[from..].iter().take(20).copied().collect();
                bytes.splice(place..place, piece);
            }
            _ if place < bytes.len() => bytes[place] = byte,
            _ => bytes.push(byte),
        }
    }
    bytes
}

/// Replays a script with a film, and checks that its counts agree.
fn replay(script: &Script) {
    let laid = lattice::lay(&script.places, None).expect("a lattice or doubles");
    let mut film = Film::plan(script, Some(7)).expect("few points");
    let meter = CountMeter::new(0, "", "", true);
    let played = match &laid.numbers {
        Numbers::Grid(points) => play(script, points, &mut Triangulation::new(), Some(&mut film), true, &meter),
        Numbers::Whole(points) => play(script, points, &mut Triangulation::new(), Some(&mut film), true, &meter),
        Numbers::Doubles(points) => play(script, points, &mut Triangulation::new(), Some(&mut film), true, &meter),
    };
    let played = played.expect("the reader checked all commands");
    let counts = script.counts();
    assert_eq!(played.answers.len(), counts[3] + counts[4]);
    assert_eq!(script.living().len(), counts[0] - counts[1]);
    assert_eq!(
        film.frames.last().map(|frame| (frame.commands, frame.living)),
        Some((script.commands.len(), script.living().len()))
    );
}

#[test]
fn spoilt_scripts_never_panic() {
    let mut random = SplitMix64::new(8);
    for (recipe, numbers) in
        [(Recipe::Churn, NumberKind::Whole), (Recipe::Tracks, NumberKind::Double), (Recipe::Drift, NumberKind::Decimal)]
    {
        let mut sample = Vec::new();
        let start: Vec<[u32; 2]> = (0..6).map(|k| [k * k, 3 * k]).collect();
        let mut writer = ScriptWriter::new(numbers, 6, 1, &mut sample);
        recipe.write(&start, 4 + 40 * u64::from(recipe == Recipe::Churn), &mut writer).expect("memory can be written");
        let mut refused = 0;
        for _ in 0..4000 {
            match read(&spoil(&sample, &mut random), Memory::ENDLESS) {
                Ok(script) => replay(&script),
                Err(failure) => {
                    refused += 1;
                    assert!(!failure.message.contains('\n') && failure.message.len() < 300, "{failure}");
                }
            }
        }
        assert!((500..3900).contains(&refused), "{recipe:?}: {refused} were refused");
    }
}

#[test]
fn more_places_than_memory_are_refused() {
    let script = "insert 1 2\n".repeat(10);
    let failure = read(script.as_bytes(), Memory::of_bytes(2000)).expect_err("ten places of 224 bytes");
    assert!(failure.message.contains("more than 8 points"), "{failure}");
}

#[test]
fn the_form_of_a_command_is_its_name() {
    let script = read(
        b"insert 1 2\nmove 0 1 2\nlocate 1 2\nnearest 1 2\nconstrain 0 0\nunconstrain 0\ndelete 0\n",
        Memory::ENDLESS,
    );
    let script = script.expect("a script");
    let names: Vec<&str> = script.commands.iter().map(|command| FORMS[command.form()].0).collect();
    assert_eq!(names, ["insert", "move", "locate", "nearest", "constrain", "unconstrain", "delete"]);
    let with_index = |command: &super::Command| FORMS[command.form()].1.contains('X') == command.has_place();
    assert!(script.commands.iter().all(with_index));
}
