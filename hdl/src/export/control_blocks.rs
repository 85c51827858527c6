//! The blocks that carry insertions through their phases, and the command streams.

use incircle_protocol::{Config, MAX_RING, TINY};

use super::block;
use crate::engine::{
    Commit, Context, Counters, PhaseMachine, PushChoice, Release, Seeder, Solo, SoloVisit, SoloWrites, StarId,
    WideCounter,
};
use crate::link::{AnswerWords, CommandGate, CommandPort, PointSlot, RecordWords, Responder};

/// The name of each root module, and its Verilog.
pub(super) fn control_blocks() -> Vec<(String, String)> {
    let longest_list = Config { ring: MAX_RING, ..TINY };
    // `context` and `release` alone are words of SystemVerilog.
    vec![
        block(Commit::default(), "commit"),
        block(StarId::default(), "star_id"),
        block(Solo::default(), "solo"),
        block(SoloVisit::default(), "solo_visit"),
        block(SoloWrites::default(), "solo_writes"),
        block(Context::default(), "insertion_context"),
        block(PhaseMachine::default(), "phase_machine"),
        block(PushChoice::default(), "push_choice"),
        block(Seeder::default(), "seeder"),
        block(Counters::default(), "counters"),
        block(WideCounter::<4>::default(), "wide_counter_4"),
        block(Release::new(TINY), "release_6"),
        block(Release::new(longest_list), "release_64"),
        block(CommandPort::default(), "command_port"),
        block(CommandGate::default(), "command_gate"),
        block(PointSlot::default(), "point_slot"),
        block(AnswerWords::default(), "answer_words"),
        block(Responder::default(), "responder"),
        block(RecordWords::default(), "record_words"),
    ]
}
