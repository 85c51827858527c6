//! The blocks that carry insertions through their phases, and the command streams.

use incircle_protocol::SMALL;

use super::block;
use crate::engine::{
    AttemptStep, Attempts, ContextFlags, Counters, NextPoint, NextVisits, Progress, Seeder, Solo, SoloVisit,
    SoloWrites, StarId, Starter, VisitCase, WideCounter,
};
use crate::link::{AnswerWords, CommandGate, CommandPort, PointSlot, RecordWords, Responder};

/// The name of each root module, and its Verilog.
pub(super) fn control_blocks() -> Vec<(String, String)> {
    // `context` and `release` alone are words of SystemVerilog.
    vec![
        block(Attempts::new(SMALL), "attempts_small"),
        block(AttemptStep::default(), "attempt_step"),
        block(ContextFlags::default(), "context_flags"),
        block(NextPoint::default(), "next_point"),
        block(NextVisits::default(), "next_visits"),
        block(Progress::default(), "progress"),
        block(Starter::new(SMALL), "starter_small"),
        block(VisitCase::default(), "visit_case"),
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
