//! The blocks that carry insertions through their phases, and the command streams.

use super::block;
use crate::engine::{Counters, Seeder, Solo, SoloVisit, SoloWrites, StarId, WideCounter};
use crate::link::{AnswerWords, CommandGate, CommandPort, PointSlot, RecordWords, Responder};

/// The name of each root module, and its Verilog.
pub(super) fn control_blocks() -> Vec<(String, String)> {
    // `context` and `release` alone are words of SystemVerilog.
    vec![
        block(StarId::default(), "star_id"),
        block(Solo::default(), "solo"),
        block(SoloVisit::default(), "solo_visit"),
        block(SoloWrites::default(), "solo_writes"),
        block(Seeder::default(), "seeder"),
        block(Counters::default(), "counters"),
        block(WideCounter::<4>::default(), "wide_counter_4"),
        block(CommandPort::default(), "command_port"),
        block(CommandGate::default(), "command_gate"),
        block(PointSlot::default(), "point_slot"),
        block(AnswerWords::default(), "answer_words"),
        block(Responder::default(), "responder"),
        block(RecordWords::default(), "record_words"),
    ]
}
