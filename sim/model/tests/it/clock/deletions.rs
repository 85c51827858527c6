//! A core with deletions in random scripts on grids full of ties, in 1 to 16 contexts, against the model by commands.

use crate::common::living::Pair;
use crate::living::scripts::{agree, many};
use incircle_model::ClockModel;
use incircle_protocol::{Config, RunKind};

/// The kinds of runs that scripts choose from: deletions twice as often as each other kind.
pub const KINDS: [RunKind; 5] =
    [RunKind::Locate, RunKind::Nearest, RunKind::InsertAs, RunKind::Delete, RunKind::Delete];

fn core(config: Config) -> Pair {
    Pair::of(config, ClockModel::new(config).expect("a core that can be built").with_core_runs())
}

#[test]
fn hundreds_of_scripts_agree_with_the_model_by_commands() {
    agree(0..400, &KINDS, core);
}

/// `INCIRCLE_SCRIPTS` says how many scripts run.
#[test]
#[ignore = "takes as long as the variable INCIRCLE_SCRIPTS says"]
fn many_scripts_agree_with_the_model_by_commands() {
    agree(many(), &KINDS, core);
}
