//! Blocks that take insertions through their phases, and blocks of the command streams.

use incircle_protocol::{Config, LARGE, MAX_RING, SMALL, TINY};

use crate::exported::block;
use incircle_hdl::cluster::{AnswerCollector, CommandQueue, EngineChoice, JobRouter, WordPlace};
use incircle_hdl::commands::{
    AnswerHead, AnswerWords, ClearCommand, CommandGate, CommandPort, PointSlot, RecordHalves, RecordPacker,
    RecordReads, RecordStream, Responder,
};
use incircle_hdl::engine::{
    AttemptLists, AttemptPoints, AttemptStep, AttemptStore, Attempts, Commit, ContextFlags, Counters, FinishedPoints,
    FreshIds, HoleFill, HoleMerge, HoleRecords, InnerList, JobQueue, KeptEdges, LatePoint, Latencies, LatencyBucket,
    LatencyRange, MovedVertex, NextPoint, NextVisits, PlanTable, Priorities, PushPort, Release, RingReader, Seeder,
    Solo, SoloVisit, SoloWrites, StarId, Starter, VisitCase, Watchdog, WideCounter,
};

/// Name of the root module and Verilog of each block.
pub(crate) fn blocks() -> Vec<(String, String)> {
    // The words `context` and `release` are keywords of SystemVerilog and cannot be names of modules.
    let longest_list = Config { ring: MAX_RING, contexts: 24, ..TINY };
    vec![
        block(Attempts::new(SMALL), "attempts_small"),
        block(AttemptLists::default(), "attempt_lists"),
        block(AttemptPoints::new(SMALL), "attempt_points_small"),
        block(AttemptStep::default(), "attempt_step"),
        block(AttemptStore::new(SMALL), "attempt_store_small"),
        block(Commit::new(TINY), "commit_6"),
        block(Commit::new(longest_list), "commit_64"),
        block(ContextFlags::default(), "context_flags"),
        block(FreshIds::default(), "fresh_ids"),
        block(HoleFill::new(Config { contexts: 8, ring: 32, ..TINY }), "hole_fill"),
        block(HoleMerge::default(), "hole_merge"),
        block(HoleRecords::default(), "hole_records"),
        block(KeptEdges::default(), "kept_edges"),
        block(LatePoint::default(), "late_point"),
        block(MovedVertex::new(Config { contexts: 8, ..TINY }), "moved_vertex"),
        block(InnerList::new(TINY), "inner_list_6"),
        block(InnerList::new(longest_list), "inner_list_64"),
        block(JobQueue::<6>::new(2), "job_queue_2x6"),
        block(NextPoint::default(), "next_point"),
        block(PlanTable::new(LARGE), "plan_table"),
        block(NextVisits::default(), "next_visits"),
        block(Priorities::new(LARGE), "priorities"),
        block(FinishedPoints::default(), "finished_points"),
        block(PushPort::default(), "push_port"),
        block(Release::new(TINY), "release_6"),
        block(Release::new(longest_list), "release_64"),
        block(RingReader::new(TINY), "ring_reader_6"),
        block(RingReader::new(longest_list), "ring_reader_64"),
        block(Starter::new(LARGE), "starter_large"),
        block(Starter::new(SMALL), "starter_small"),
        block(VisitCase::default(), "visit_case"),
        block(StarId::default(), "star_id"),
        block(Solo::default(), "solo"),
        block(SoloVisit::default(), "solo_visit"),
        block(SoloWrites::default(), "solo_writes"),
        block(Seeder::default(), "seeder"),
        block(Counters::default(), "counters"),
        block(WideCounter::<4>::default(), "wide_counter_4"),
        block(LatencyRange::default(), "latency_range"),
        block(LatencyBucket::default(), "latency_bucket"),
        block(Latencies::default(), "latencies"),
        block(Watchdog::default(), "watchdog"),
        block(ClearCommand::default(), "clear_command"),
        block(CommandPort::default(), "command_port"),
        block(CommandGate::default(), "command_gate"),
        block(PointSlot::default(), "point_slot"),
        block(AnswerHead::default(), "answer_head"),
        block(AnswerCollector::default(), "answer_collector"),
        block(CommandQueue::default(), "command_queue"),
        block(EngineChoice::default(), "engine_choice"),
        block(JobRouter::default(), "job_router"),
        block(WordPlace::default(), "word_place"),
        block(AnswerWords::default(), "answer_words"),
        block(Responder::default(), "responder"),
        block(RecordReads::default(), "record_reads"),
        block(RecordStream::default(), "record_stream"),
        block(RecordPacker::default(), "record_packer"),
        block(RecordHalves::default(), "record_halves"),
    ]
}
