//! The blocks of runs on a mesh that stands.

use incircle_protocol::{Config, FULL, TINY};

use crate::exported::block;
use incircle_hdl::living::{
    ChangeEnds, ItemQueues, LatePoints, NearSearch, NextItem, PartQueue, QuestionStep, Questions, ReturnLine, RunGate,
    RunPort, StandingView, VertexCheck,
};

/// Name of the root module and Verilog of each block.
pub(crate) fn blocks() -> Vec<(String, String)> {
    let most_contexts = Config { contexts: 24, ..TINY };
    vec![
        block(ItemQueues::new(TINY), "living_item_queues_2"),
        block(ItemQueues::new(most_contexts), "living_item_queues_24"),
        block(NearSearch::new(most_contexts), "living_near_search"),
        block(NextItem::default(), "living_next_item"),
        block(QuestionStep::new(most_contexts), "living_question_step"),
        block(PartQueue::default(), "living_part_queue"),
        block(ReturnLine::new(Config { contexts: 8, ..TINY }), "return_line"),
        block(RunPort::default(), "living_run_port"),
        block(RunGate::default(), "living_run_gate"),
        block(StandingView::default(), "living_standing_view"),
        block(ChangeEnds::new(TINY), "living_change_ends"),
        block(LatePoints::default(), "living_late_points"),
        block(VertexCheck::new(TINY), "living_vertex_check"),
        block(Questions::new(TINY), "living_questions_2"),
        block(Questions::new(FULL), "living_questions_16"),
    ]
}
