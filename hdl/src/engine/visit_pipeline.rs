//! Everything a visit passes: queue, triangle memory, slot and rotation, vertex memory, predicates, verdict.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | reset forgets all visits; memories keep their contents |
//! | `infinite` | in | 15 | the id of the infinite vertex, a constant |
//! | `push`, `bundle` | in | 1, Bundle | visits to make |
//! | `p` | in | 32 | the context's point, steady while one of its visits is out |
//! | `done` | out | 1 | a visit completes in this clock |
//! | `token`, `turned`, `verdict` | out | | the visit, its record and what it found out |
//! | `read`, `read_id` | in | 1, 15 | a read-out wants a record; only while no visit is out |
//! | `read_done` | out | 1 | the record stands on `v0..n2` and `was_set` |
//! | `write` | in | Write | a write into the triangle memory |
//! | `vertex_id`, `vertex_position`, `vertex_enable` | in | 15, 32, 1 | a write into the vertex memory |
//! | `clear_id`, `clear_enable` | in | 15, 1 | a lock to clear |
//!
//! 1. Every visit takes the same time, so visits complete in the order of their issue, at most one a clock.
//!
//! Latency: `STAGES` = 15 clocks from the issue register to `done`, 16 from `push`. The record is there after 2, the corners after
//! 5, the signs after 14. A read-out takes 3 clocks from `read` to `read_done`.
//!
//! A bundle of two visits, then a read-out:
//! ```text
//! push            /^^\_________________________________________________________________
//! bundle.x          1  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .
//! done            ________________________________________________/^^^^^\______________
//! token.x           .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  1  2  .  .  .  .  .
//! read            ______________________________________________________/^^\___________
//! read_done       _______________________________________________________________/^^\__
//! ```

use super::{Bundle, Issue, Token, Turned, Verdict, VerdictLogic, VisitReader, Write, TOKEN_BITS, TURNED_BITS};
use crate::leaf::{DelayLine, Unpack};
use crate::mesh::{TriangleStore, VertexStore};
use crate::predicate::VisitPredicates;
use incircle_protocol::{triangle_id_bits, vertex_id_bits, Config};
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The visit pipeline; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct VisitPipeline {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Forgets all visits.
    pub reset: Signal<In, Bit>,
    /// The id of the infinite vertex, a constant.
    pub infinite: Signal<In, Bits<15>>,
    /// A bundle enters the queue.
    pub push: Signal<In, Bit>,
    /// The bundle.
    pub bundle: Signal<In, Bundle>,
    /// The point.
    pub p: Signal<In, Bits<32>>,
    /// A visit completes.
    pub done: Signal<Out, Bit>,
    /// The visit.
    pub token: Signal<Out, Token>,
    /// Its record.
    pub turned: Signal<Out, Turned>,
    /// What it found out.
    pub verdict: Signal<Out, Verdict>,
    /// A read-out wants a record.
    pub read: Signal<In, Bit>,
    /// The record.
    pub read_id: Signal<In, Bits<15>>,
    /// It stands on the columns.
    pub read_done: Signal<Out, Bit>,
    /// Column read.
    pub v0: Signal<Out, Bits<15>>,
    /// Column read.
    pub v1: Signal<Out, Bits<15>>,
    /// Column read.
    pub v2: Signal<Out, Bits<15>>,
    /// Column read.
    pub n0: Signal<Out, Bits<15>>,
    /// Column read.
    pub n1: Signal<Out, Bits<15>>,
    /// Column read.
    pub n2: Signal<Out, Bits<15>>,
    /// Lock bit read.
    pub was_set: Signal<Out, Bit>,
    /// A write into the triangle memory.
    pub write: Signal<In, Write>,
    /// Vertex to write.
    pub vertex_id: Signal<In, Bits<15>>,
    /// Its coordinates.
    pub vertex_position: Signal<In, Bits<32>>,
    /// Write it.
    pub vertex_enable: Signal<In, Bit>,
    /// Lock to clear.
    pub clear_id: Signal<In, Bits<15>>,
    /// Clear it.
    pub clear_enable: Signal<In, Bit>,
    issue: Issue,
    triangles: TriangleStore,
    vertices: VertexStore,
    reader: VisitReader,
    predicates: VisitPredicates,
    verdict_logic: VerdictLogic,
    token_bits: Signal<Local, Bits<TOKEN_BITS>>,
    turned_bits: Signal<Local, Bits<TURNED_BITS>>,
    token_delay: DelayLine<TOKEN_BITS>,
    turned_delay: DelayLine<TURNED_BITS>,
    delayed_token: Unpack<Token, TOKEN_BITS>,
    delayed_turned: Unpack<Turned, TURNED_BITS>,
    point: DFF<Bits<32>>,
    /// Bit `k`: the visit issued `k + 1` clocks ago is valid.
    valid: DFF<Bits<15>>,
    read_valid1: DFF<Bit>,
    read_valid2: DFF<Bit>,
    token_register: DFF<Token>,
    turned_register: DFF<Turned>,
    verdict_register: DFF<Verdict>,
    shifted: Signal<Local, Bits<15>>,
    one: Signal<Local, Bits<15>>,
}

impl VisitPipeline {
    /// Clocks from the issue register to `done`: corners, signs, verdict.
    pub const STAGES: usize = VisitReader::LATENCY + VisitPredicates::LATENCY + 1;

    /// The pipeline of a configuration.
    ///
    /// # Panics
    /// If the stages do not add up to the width of the valid register, which is a fault in this source.
    pub fn new(config: Config) -> Self {
        assert_eq!(Self::STAGES, 15, "the valid register has 15 bits");
        let signs = VisitReader::LATENCY + VisitPredicates::LATENCY;
        Self {
            issue: Issue::new(ring_bits(config)),
            triangles: TriangleStore::new(
                triangle_id_bits(config.points) as usize,
                vertex_id_bits(config.points) as usize,
            ),
            vertices: VertexStore::new(vertex_id_bits(config.points) as usize - 1),
            token_delay: DelayLine::new(signs - TriangleStore::LATENCY),
            turned_delay: DelayLine::new(signs - VisitReader::TURNED_LATENCY),
            ..Self::default()
        }
    }
}

/// Address bits of a memory with a word per ring entry.
pub(super) fn ring_bits(config: Config) -> usize {
    (u32::BITS - (config.ring - 1).leading_zeros()) as usize
}

impl Logic for VisitPipeline {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(
            self,
            clock,
            point,
            valid,
            read_valid1,
            read_valid2,
            token_register,
            turned_register,
            verdict_register
        );
        clock!(self, clock, issue, triangles, vertices, reader, predicates, token_delay, turned_delay);
        self.one.next = 1.into();
        self.reader.infinite.next = self.infinite.val();
        self.issue.reset.next = self.reset.val();
        self.issue.push.next = self.push.val();
        self.issue.bundle.next = self.bundle.val();
        self.issue.read.next = self.read.val();
        self.issue.read_id.next = self.read_id.val();

        // Clocks 0 to 2: the record.
        self.triangles.read_id.next = self.issue.token.val().u;
        self.triangles.read_locks.next = self.issue.token_valid.val() & self.issue.token.val().locks;
        self.triangles.write.next = self.write.val();
        self.triangles.clear_id.next = self.clear_id.val();
        self.triangles.clear_enable.next = self.clear_enable.val();
        self.reader.token.next = self.issue.token.val();
        self.reader.v0.next = self.triangles.v0.val();
        self.reader.v1.next = self.triangles.v1.val();
        self.reader.v2.next = self.triangles.v2.val();
        self.reader.n0.next = self.triangles.n0.val();
        self.reader.n1.next = self.triangles.n1.val();
        self.reader.n2.next = self.triangles.n2.val();
        self.reader.was_set.next = self.triangles.was_set.val();
        self.v0.next = self.triangles.v0.val();
        self.v1.next = self.triangles.v1.val();
        self.v2.next = self.triangles.v2.val();
        self.n0.next = self.triangles.n0.val();
        self.n1.next = self.triangles.n1.val();
        self.n2.next = self.triangles.n2.val();
        self.was_set.next = self.triangles.was_set.val();
        self.read_valid1.d.next = self.issue.read_valid.val();
        self.read_valid2.d.next = self.read_valid1.q.val();
        self.read_done.next = self.read_valid2.q.val();

        // Clocks 2 to 5: the corners.
        self.vertices.id0.next = self.triangles.v0.val();
        self.vertices.id1.next = self.triangles.v1.val();
        self.vertices.id2.next = self.triangles.v2.val();
        self.vertices.write_id.next = self.vertex_id.val();
        self.vertices.write_position.next = self.vertex_position.val();
        self.vertices.write_enable.next = self.vertex_enable.val();
        self.reader.position0.next = self.vertices.position0.val();
        self.reader.position1.next = self.vertices.position1.val();
        self.reader.position2.next = self.vertices.position2.val();
        self.point.d.next = self.p.val();

        // Clocks 5 to 14: the signs, and beside them the visit and its record.
        self.predicates.r0.next = self.reader.r0.val();
        self.predicates.r1.next = self.reader.r1.val();
        self.predicates.r2.next = self.reader.r2.val();
        self.predicates.p.next = self.point.q.val();
        self.token_bits.next = self.reader.token_at_record.val().into();
        self.token_delay.data_in.next = self.token_bits.val();
        self.delayed_token.bits.next = self.token_delay.data_out.val();
        self.turned_bits.next = self.reader.turned.val().into();
        self.turned_delay.data_in.next = self.turned_bits.val();
        self.delayed_turned.bits.next = self.turned_delay.data_out.val();

        // Clock 14: the verdict.
        self.verdict_logic.turned.next = self.delayed_turned.value.val();
        self.verdict_logic.e0_negative.next = self.predicates.e0_negative.val();
        self.verdict_logic.e1_negative.next = self.predicates.e1_negative.val();
        self.verdict_logic.e2_negative.next = self.predicates.e2_negative.val();
        self.verdict_logic.e0_zero.next = self.predicates.e0_zero.val();
        self.verdict_logic.e1_zero.next = self.predicates.e1_zero.val();
        self.verdict_logic.e2_zero.next = self.predicates.e2_zero.val();
        self.verdict_logic.e1_below_e0.next = self.predicates.e1_below_e0.val();
        self.verdict_logic.e2_below_e0.next = self.predicates.e2_below_e0.val();
        self.verdict_logic.e2_below_e1.next = self.predicates.e2_below_e1.val();
        self.verdict_logic.incircle_positive.next = self.predicates.incircle_positive.val();
        self.verdict_logic.incircle_zero.next = self.predicates.incircle_zero.val();
        self.verdict_logic.p_before_r0.next = self.predicates.p_before_r0.val();
        self.verdict_logic.p_before_r1.next = self.predicates.p_before_r1.val();
        self.verdict_logic.p_before_r2.next = self.predicates.p_before_r2.val();
        self.verdict_logic.p_equals_r0.next = self.predicates.p_equals_r0.val();
        self.verdict_logic.p_equals_r1.next = self.predicates.p_equals_r1.val();
        self.verdict_logic.p_equals_r2.next = self.predicates.p_equals_r2.val();
        self.verdict_logic.r0_before_r1.next = self.predicates.r0_before_r1.val();
        self.verdict_logic.r0_before_r2.next = self.predicates.r0_before_r2.val();
        self.token_register.d.next = self.delayed_token.value.val();
        self.turned_register.d.next = self.delayed_turned.value.val();
        self.verdict_register.d.next = self.verdict_logic.verdict.val();
        self.token.next = self.token_register.q.val();
        self.turned.next = self.turned_register.q.val();
        self.verdict.next = self.verdict_register.q.val();

        self.shifted.next = self.valid.q.val() << self.one.val();
        self.valid.d.next = self.shifted.val();
        if self.issue.token_valid.val() {
            self.valid.d.next = self.shifted.val() | self.one.val();
        }
        self.done.next = self.valid.q.val().get_bit(14);
        if self.reset.val() {
            self.valid.d.next = 0.into();
            self.read_valid1.d.next = false;
            self.read_valid2.d.next = false;
        }
    }
}
