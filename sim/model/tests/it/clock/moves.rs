//! A core with moves in random scripts on grids full of ties, in 1 to 16 contexts, against the model by commands.

use crate::common::living::{Fault, Pair};
use crate::living::scripts::Script;
use incircle_model::ClockModel;
use incircle_protocol::{Config, RunKind};

/// The kinds of runs that scripts choose from: moves as often as all others together.
pub const KINDS: [RunKind; 8] = [
    RunKind::Locate,
    RunKind::Nearest,
    RunKind::InsertAs,
    RunKind::Delete,
    RunKind::Move,
    RunKind::Move,
    RunKind::Move,
    RunKind::Move,
];

fn core(config: Config) -> ClockModel {
    ClockModel::new(config).expect("a core that can be built").with_questions()
}

fn run(seeds: std::ops::Range<u32>) {
    for seed in seeds {
        let mut script = Script::new(seed);
        script.kinds = &KINDS;
        let config = script.config();
        match script.run_on(Pair::of(config, core(config))) {
            Ok(_) => {}
            Err(Fault::Hang) => panic!("script {seed} hangs"),
            Err(Fault::Wrong(fault)) => panic!("script {seed}: {fault}"),
        }
    }
}

#[test]
fn hundreds_of_scripts_agree_with_the_model_by_commands() {
    run(0..400);
}

/// `INCIRCLE_SCRIPTS` says how many scripts run.
#[test]
#[ignore = "takes as long as the variable INCIRCLE_SCRIPTS says"]
fn many_scripts_agree_with_the_model_by_commands() {
    let scripts = std::env::var("INCIRCLE_SCRIPTS").ok().and_then(|text| text.parse().ok());
    run(1000..1000 + scripts.unwrap_or(10_000));
}
