//! Every lock rule of the living engine is needed: a core without one of them does some script wrong, hangs, or comes
//! into a state that no core can be in. The complete core does all of these scripts right.

use super::scripts::Script;
use crate::common::living::Fault;
use incircle_model::LivingDefect;
use std::panic::{catch_unwind, AssertUnwindSafe};

/// What went wrong in a script without this rule.
#[derive(Clone, Debug)]
enum Symptom {
    Hang,
    Wrong(String),
    Panic,
}

fn symptom(seed: u32, rule: LivingDefect) -> Option<Symptom> {
    let result = catch_unwind(AssertUnwindSafe(|| Script::crowded(seed).run(Some(rule)).err()));
    match result {
        Err(_) => Some(Symptom::Panic),
        Ok(None) => None,
        Ok(Some(Fault::Hang)) => Some(Symptom::Hang),
        Ok(Some(Fault::Wrong(fault))) => Some(Symptom::Wrong(fault)),
    }
}

/// Looks for the first script that a core without this rule does wrong.
fn expect(rule: LivingDefect, most: u32) {
    for seed in 0..most {
        if let Some(found) = symptom(seed, rule) {
            if let Err(fault) = Script::crowded(seed).run(None) {
                panic!("the complete core, script {seed}: {fault:?}");
            }
            println!("{rule:?}, script {seed}: {found:?}");
            return;
        }
    }
    panic!("{rule:?} does not show in {most} scripts");
}

#[test]
#[ignore = "a table for the page"]
fn how_many_scripts_go_wrong_without_each_rule() {
    let scripts = std::env::var("INCIRCLE_SCRIPTS").ok().and_then(|text| text.parse().ok()).unwrap_or(300);
    for rule in LivingDefect::ALL {
        let found: Vec<Symptom> = (0..scripts).filter_map(|seed| symptom(seed, rule)).collect();
        let count = |is: fn(&Symptom) -> bool| found.iter().filter(|&symptom| is(symptom)).count();
        let (hangs, panics) = (count(|s| matches!(s, Symptom::Hang)), count(|s| matches!(s, Symptom::Panic)));
        let wrong = found.len() - hangs - panics;
        println!("{rule:?}: {wrong} wrong, {hangs} hang, {panics} panic, of {scripts}");
    }
}
