//! Tests of the scripts that `incircle generate` makes.

use crate::common::Scratch;
use serde_json::Value;

fn report(scratch: &Scratch, options: &str) -> Value {
    let run = scratch.run(&format!("replay {options} --json")).ok();
    serde_json::from_str(&run.stdout).expect("JSON")
}

#[test]
fn made_scripts_are_replayed_and_verified() {
    let scratch = Scratch::new();
    for (recipe, length) in [("drift", "--frames 8"), ("tracks", "--frames 40"), ("churn", "--commands 3000")] {
        for numbers in ["whole", "signed", "decimal", "f32", "double"] {
            let made = scratch.run(&format!("generate {recipe} -n 70 --numbers {numbers} {length} -o s.txt")).ok();
            assert_eq!((made.stdout.as_str(), made.stderr.as_str()), ("", ""));
            scratch.run("replay s.txt -o m.ele --answers a.txt -q").ok();
            scratch.run("verify s.txt m.ele --script -q").ok();
            if numbers != "double" {
                scratch.run("replay s.txt -o d.ele --answers b.txt --backend model -q").ok();
                assert!(
                    scratch.read("m.ele") == scratch.read("d.ele") && scratch.read("a.txt") == scratch.read("b.txt")
                );
            }
        }
    }
}

#[test]
fn made_scripts_have_the_commands_that_they_promise() {
    let scratch = Scratch::new();
    scratch.run("generate drift -n 50 --frames 6 -o s.txt").ok();
    let drift = report(&scratch, "s.txt -o m.ele");
    let commands = serde_json::json!({ "insert": 50, "delete": 0, "move": 300, "locate": 0, "nearest": 0, "constrain": 0, "unconstrain": 0 });
    assert_eq!((&drift["commands"], &drift["living"]), (&commands, &50.into()));
    scratch.run("generate tracks -n 80 --frames 30 -o s.txt").ok();
    let tracks = report(&scratch, "s.txt -o m.ele");
    assert_eq!((&tracks["living"], &tracks["commands"]["locate"]), (&80.into(), &300.into()));
    let count = |name: &str| tracks["commands"][name].as_u64().expect("a count");
    assert_eq!(count("insert"), count("delete") + 80);
    assert_eq!(count("move") + count("delete"), 30 * 80);
    assert!(count("delete") > 20, "{tracks}");
    scratch.run("generate churn -n 90 -o s.txt").ok();
    let churn = report(&scratch, "s.txt -o m.ele");
    let all: u64 = ["insert", "delete", "move", "locate", "nearest"]
        .iter()
        .filter_map(|name| churn["commands"][name].as_u64())
        .sum();
    assert_eq!(all, 1800);
    assert!((60..120).contains(&churn["living"].as_u64().expect("a count")), "{churn}");
}

#[test]
fn one_seed_makes_one_script() {
    let scratch = Scratch::new();
    for recipe in ["drift", "tracks", "churn"] {
        let made = |seed: u32| scratch.run(&format!("generate {recipe} -n 20 --seed {seed} -o -")).ok().stdout;
        assert_eq!(made(1), made(1));
        assert_ne!(made(1), made(2));
    }
    // The first lines are those of every machine.
    let made = scratch.run("generate drift -n 2 --frames 1 --seed 1234567 -o -").ok().stdout;
    assert!(made.starts_with("# drift: 2 points, 1 frame, seed 1234567\ninsert 22942 11379\n"), "{made}");
    assert_eq!(made.lines().count(), 6);
}

#[test]
fn small_scripts_are_possible() {
    let scratch = Scratch::new();
    for recipe in ["drift", "tracks", "churn"] {
        for n in [0, 1, 2] {
            for bits in [1, 31] {
                scratch.run(&format!("generate {recipe} -n {n} --bits {bits} -o s.txt")).ok();
                scratch.run("replay s.txt -o m.ele -q").ok();
                scratch.run("verify s.txt m.ele --script -q").ok();
            }
        }
    }
}

#[test]
fn wrong_choices_are_refused() {
    let scratch = Scratch::new();
    for (arguments, part) in [
        ("churn -n 5 --frames 5 -o s.txt", "churn has no frames: give --commands"),
        ("drift -n 5 --commands 5 -o s.txt", "drift is made in frames: give --frames"),
        ("tracks -n 5 --commands 5 -o s.txt", "tracks is made in frames: give --frames"),
        ("uniform -n 5 --frames 5 -o s.csv", "uniform is a set of points: leave them out"),
        ("uniform -n 5 --commands 5 -o s.csv", "uniform is a set of points: leave them out"),
        ("drift -n 5 -o s.csv", "drift is a script, which is text"),
        ("drift -n 5 -o s.svg", "a name such as drift.txt"),
        ("drift -n 5 --format csv -o s.txt", "drift is a script, which is text"),
        ("churn -n 5 --order hilbert -o s.txt", "churn is a script, which is text"),
        ("drift -n 5 --numbers double --bits 8 -o s.txt", "--bits 8"),
        ("drift -n 100000 --frames 100000 -o s.txt", "more than the 4294967295 that a script may have"),
        ("tracks -n 536870911 --frames 4294967295 -o s.txt", "more than the 4294967295 that a script may have"),
        ("churn -n 600000000 --commands 5 -o s.txt", "536870911"),
    ] {
        scratch.run(&format!("generate {arguments}")).fails(2, &[part]);
    }
    assert!(scratch.files().is_empty());
}
