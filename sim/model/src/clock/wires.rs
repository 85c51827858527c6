//! What blocks show each other within a clock: functions of registers and inputs.

use super::command_port::State as CommandState;
use super::context::Phase;
use super::memory::Memory;
use super::pipeline::{Bundle, Completion, Pipeline};
use super::{Inputs, Registers};
use crate::predicate::Point;
use incircle_protocol::Config;

/// The wires of one clock.
#[derive(Clone, Copy, Debug)]
pub(super) struct Wires {
    /// The command word taken at this edge.
    pub word: Option<u32>,
    pub response_ready: bool,
    /// The infinite vertex of this configuration.
    pub infinite: u32,
    /// The visit that completes.
    pub done: Option<Completion>,
    /// The record that a read-out asked for three clocks ago, as answer words.
    pub record_read: Option<[u32; 3]>,
    /// A read-out asks for this record.
    pub read: Option<u32>,
    /// The responder loads its last word.
    pub answer_ends: bool,
    /// No point waits, the context is idle, no lock is held.
    pub is_quiet: bool,
    /// The context takes the waiting point.
    pub takes_point: bool,
    /// The point accepted at this edge.
    pub new_vertex: Option<(u32, Point)>,
    /// The bundle that a completing test asks for: it passes through its edge.
    pub split: Option<Bundle>,
    /// A completing test is in conflict, and the list is full.
    pub overflows: bool,
    /// The bundle that an insertion alone asks for.
    pub solo_push: Option<Bundle>,
    /// The commit writes its last record.
    pub commit_ends: bool,
    /// The insertion alone has gone round.
    pub solo_ends: bool,
    /// An overflowed attempt has no token out any more.
    pub drained: bool,
}

impl Wires {
    pub(super) fn of(was: &Registers, pipeline: &Pipeline, memory: &Memory, inputs: Inputs, config: Config) -> Self {
        let word = (inputs.command_valid && was.command.is_ready(was)).then_some(inputs.command_data);
        let done = pipeline.completion();
        let in_cavity = was.context.phase == Phase::Cavity;
        let conflict = done.filter(|done| in_cavity && done.token.rotates && done.conflict);
        let is_full = was.cavity.count == config.ring;
        let is_idle = was.context.phase == Phase::Idle;
        let takes_point = is_idle && was.command.point_valid;
        let stored = was.command.state == CommandState::Points && was.command.stores_points(was, config);
        Self {
            word,
            response_ready: inputs.response_ready,
            infinite: memory.infinite,
            done,
            record_read: pipeline.record_read().map(|id| memory.record_words(id)),
            read: was.responder.read_request(),
            answer_ends: was.responder.ends(was, inputs.response_ready),
            is_quiet: is_idle && !was.command.point_valid && !was.release.is_busy,
            takes_point,
            new_vertex: word.filter(|_| stored).map(|word| (was.command.arrived, point(word))),
            split: conflict.filter(|_| !is_full).map(|done| was.cavity.split(&done)),
            overflows: conflict.is_some() && is_full,
            solo_push: was.solo.push_request(was),
            commit_ends: was.commit.ends(),
            solo_ends: was.solo.ends(was, done),
            drained: was.context.phase == Phase::Drain && was.cavity.outstanding == 0,
        }
    }
}

/// A point from its word.
pub(super) fn point(word: u32) -> Point {
    Point { x: word & 0xffff, y: word >> 16 }
}
