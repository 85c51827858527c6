//! Everything a visit passes: queue, triangle memory and locks, slot and rotation, vertex memory, predicates, verdict.
//!
//! 1. Every visit takes the same time, so visits complete in the order of their issue, at most one a clock.
//! 2. A visit whose record is written in the clock in which it is issued, or is not written yet, completes with `turned.again` (L7). Then
//!    vertices, links and slot of `turned` and the whole `verdict` are arbitrary; `took` and `foreign` hold all the same.
//! 3. A visit is judged against the point that its context has 4 clocks after its issue. The user changes that point only while none
//!    of the context's visits is out.
//! 4. A read-out never meets a write of its record at one edge: the user reads only while nothing is at work.
//!
//! Latency: `STAGES` = 16 clocks from the issue register to `done`, 17 from `push`, and 18 round the loop with the register that
//! drives `push`. The record is there after 2, the corners after 5, the signs after 15. A read-out takes 3 clocks from `read` to
//! `read_done`.
//!
//! A bundle of two visits of context 1, then a read-out:
//! ```text
//! push            /^^\____________________________________________________________________
//! bundle.owner      1  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .
//! bundle.x          1  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .
//! is_issuing      ___/^^^^^\______________________________________________________________
//! done            ___________________________________________________/^^^^^\______________
//! token.owner       .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  1  1  .  .  .  .  .
//! token.x           .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  .  1  2  .  .  .  .  .
//! read            _________________________________________________________/^^\___________
//! read_done       __________________________________________________________________/^^\__
//! ```

use super::issue::Issue;
use super::visit_judge::VisitJudge;
use super::visit_reader::VisitReader;
use crate::engine::types::{
    context_bits, ring_bits, Bundle, Token, Turned, Verdict, Write, WriteEnables, CONTEXT_BITS, TOKEN_BITS, TURNED_BITS,
};
use crate::leaf::{DelayLine, LutMemory, Unpack};
use crate::mesh::{TriangleStore, VertexStore};
use incircle_protocol::{triangle_id_bits, vertex_id_bits, Config};
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The visit pipeline; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct VisitPipeline {
    /// Reset forgets all visits; memories keep their contents.
    pub clock: Signal<In, Clock>,
    pub reset: Signal<In, Bit>,
    /// The id of the infinite vertex, a constant.
    pub infinite: Signal<In, Bits<15>>,
    /// Records from this id on are not written yet.
    pub records: Signal<In, Bits<15>>,
    /// Visits to make.
    pub push: Signal<In, Bit>,
    pub bundle: Signal<In, Bundle>,
    /// The point that a context inserts from now on.
    pub position_owner: Signal<In, Bits<5>>,
    pub position: Signal<In, Bits<32>>,
    pub position_enable: Signal<In, Bit>,
    /// A visit reads its record in this clock.
    pub is_issuing: Signal<Out, Bit>,
    /// A visit completes in this clock.
    pub done: Signal<Out, Bit>,
    pub token: Signal<Out, Token>,
    pub turned: Signal<Out, Turned>,
    pub verdict: Signal<Out, Verdict>,
    pub early_done: Signal<Out, Bit>,
    pub early_token: Signal<Out, Token>,
    pub early_turned: Signal<Out, Turned>,
    /// A read-out wants a record; only while no visit is out.
    pub read: Signal<In, Bit>,
    pub read_id: Signal<In, Bits<15>>,
    /// The record stands on `v0..n2` and `was_set`.
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
    /// A write into the triangle memory, and the columns that it writes.
    pub write: Signal<In, Write>,
    pub enables: Signal<In, WriteEnables>,
    /// A write into the vertex memory.
    pub vertex_id: Signal<In, Bits<15>>,
    pub vertex_position: Signal<In, Bits<32>>,
    pub vertex_enable: Signal<In, Bit>,
    /// A vertex read, 2 clocks later; only at an edge without such a write.
    pub fetch_id: Signal<In, Bits<15>>,
    pub fetched: Signal<Out, Bits<32>>,
    /// A lock to clear.
    pub clear_id: Signal<In, Bits<15>>,
    pub clear_enable: Signal<In, Bit>,
    issue: Issue,
    triangles: TriangleStore,
    vertices: VertexStore,
    reader: VisitReader,
    judge: VisitJudge,
    positions: LutMemory<CONTEXT_BITS, 32>,
    is_written: Signal<Local, Bit>,
    is_torn: Signal<Local, Bit>,
    /// The visit in clocks 1 and 2 must look again.
    again1: DFF<Bit>,
    again2: DFF<Bit>,
    /// The context of the visit in clocks 3 and 4.
    owner3: DFF<Bits<5>>,
    owner4: DFF<Bits<5>>,
    token_bits: Signal<Local, Bits<TOKEN_BITS>>,
    turned_bits: Signal<Local, Bits<TURNED_BITS>>,
    token_delay: DelayLine<TOKEN_BITS>,
    turned_delay: DelayLine<TURNED_BITS>,
    delayed_token: Unpack<Token, TOKEN_BITS>,
    delayed_turned: Unpack<Turned, TURNED_BITS>,
    /// The record in clock 15.
    judged: DFF<Turned>,
    point: DFF<Bits<32>>,
    /// Bit `k`: the visit issued `k + 1` clocks ago is valid.
    valid: DFF<Bits<16>>,
    read_valid1: DFF<Bit>,
    read_valid2: DFF<Bit>,
    token_register: DFF<Token>,
    turned_register: DFF<Turned>,
    verdict_register: DFF<Verdict>,
    shifted: Signal<Local, Bits<16>>,
    one: Signal<Local, Bits<16>>,
}

impl VisitPipeline {
    /// Clocks from the issue register to `done`: corners, signs, verdict.
    pub const STAGES: usize = VisitReader::LATENCY + VisitJudge::LATENCY + 1;

    /// The pipeline of a configuration.
    ///
    /// # Panics
    /// If the stages do not add up to the width of the valid register, which is a fault in this source.
    pub fn new(config: Config) -> Self {
        assert_eq!(Self::STAGES, 16, "the valid register has 16 bits");
        let signs = VisitReader::LATENCY + VisitJudge::LATENCY;
        Self {
            issue: Issue::new(context_bits(config) + ring_bits(config)),
            triangles: TriangleStore::new(
                triangle_id_bits(config.points) as usize,
                vertex_id_bits(config.points) as usize,
                context_bits(config),
            ),
            positions: LutMemory::new(context_bits(config), 32),
            vertices: VertexStore::new(vertex_id_bits(config.points) as usize - 1),
            token_delay: DelayLine::new(signs - TriangleStore::LATENCY),
            turned_delay: DelayLine::new(signs - VisitReader::TURNED_LATENCY - 1),
            ..Self::default()
        }
    }
}

impl Logic for VisitPipeline {
    #[hdl_gen]
    fn update(&mut self) {
        dff_setup!(
            self,
            clock,
            again1,
            again2,
            owner3,
            owner4,
            point,
            valid,
            read_valid1,
            read_valid2,
            judged,
            token_register,
            turned_register,
            verdict_register
        );
        clock!(self, clock, issue, triangles, vertices, reader, positions, judge, token_delay, turned_delay);
        self.one.next = 1.into();
        self.reader.infinite.next = self.infinite.val();
        self.issue.reset.next = self.reset.val();
        self.issue.push.next = self.push.val();
        self.issue.bundle.next = self.bundle.val();
        self.issue.read.next = self.read.val();
        self.issue.read_id.next = self.read_id.val();
        self.is_issuing.next = self.issue.token_valid.val();

        // Clock 0, L7: a record that is not written yet, or being written, does not count.
        self.is_written.next = self.issue.token.val().u < self.records.val();
        self.is_torn.next = self.write.val().valid & (self.write.val().id == self.issue.token.val().u);
        self.again1.d.next = self.is_torn.val() | (!self.is_written.val());
        self.again2.d.next = self.again1.q.val();

        // Clocks 0 to 2: the record.
        self.triangles.read_id.next = self.issue.token.val().u;
        self.triangles.vertices_id.next = self.issue.vertices_id.val();
        self.triangles.links_id.next = self.issue.links_id.val();
        self.triangles.read_locks.next = self.issue.token_valid.val() & self.issue.token.val().locks;
        self.triangles.owner.next = self.issue.token.val().owner;
        self.triangles.write.next = self.write.val();
        self.triangles.enables.next = self.enables.val();
        self.triangles.clear_id.next = self.clear_id.val();
        self.triangles.clear_enable.next = self.clear_enable.val();
        self.reader.token.next = self.issue.token.val();
        self.reader.v0.next = self.triangles.v0.val();
        self.reader.v1.next = self.triangles.v1.val();
        self.reader.v2.next = self.triangles.v2.val();
        self.reader.n0.next = self.triangles.n0.val();
        self.reader.n1.next = self.triangles.n1.val();
        self.reader.n2.next = self.triangles.n2.val();
        self.reader.took.next = self.triangles.took.val();
        self.reader.foreign.next = self.triangles.foreign.val();
        self.reader.again.next = self.again2.q.val();
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

        // Clocks 2 to 5: the corners, and the point.
        self.vertices.id0.next = self.triangles.v0.val();
        self.vertices.id1.next = self.triangles.v1.val();
        self.vertices.id2.next = self.triangles.v2.val();
        self.vertices.write_id.next = self.vertex_id.val();
        self.vertices.write_position.next = self.vertex_position.val();
        self.vertices.write_enable.next = self.vertex_enable.val();
        self.reader.position0.next = self.vertices.position0.val();
        self.reader.position1.next = self.vertices.position1.val();
        self.reader.position2.next = self.vertices.position2.val();
        self.vertices.fetch_id.next = self.fetch_id.val();
        self.fetched.next = self.vertices.fetched.val();
        self.owner3.d.next = self.reader.token_at_record.val().owner;
        self.owner4.d.next = self.owner3.q.val();
        self.positions.write_address.next = self.position_owner.val();
        self.positions.write_data.next = self.position.val();
        self.positions.write_enable.next = self.position_enable.val();
        self.positions.read_address.next = self.owner4.q.val();
        self.point.d.next = self.positions.read_data.val();

        // Clocks 5 to 15: the signs, and beside them the visit and its record.
        self.judge.r0.next = self.reader.r0.val();
        self.judge.r1.next = self.reader.r1.val();
        self.judge.r2.next = self.reader.r2.val();
        self.judge.p.next = self.point.q.val();
        self.token_bits.next = self.reader.token_at_record.val().into();
        self.token_delay.data_in.next = self.token_bits.val();
        self.delayed_token.bits.next = self.token_delay.data_out.val();
        self.turned_bits.next = self.reader.turned.val().into();
        self.turned_delay.data_in.next = self.turned_bits.val();
        self.delayed_turned.bits.next = self.turned_delay.data_out.val();

        // Clock 14: the record comes out of the delay. Clock 15: the verdict.
        self.judged.d.next = self.delayed_turned.value.val();
        self.judge.turned.next = self.judged.q.val();
        self.token_register.d.next = self.delayed_token.value.val();
        self.turned_register.d.next = self.judged.q.val();
        self.verdict_register.d.next = self.judge.verdict.val();
        self.early_done.next = self.valid.q.val().get_bit(14);
        self.early_token.next = self.delayed_token.value.val();
        self.early_turned.next = self.judged.q.val();
        self.token.next = self.token_register.q.val();
        self.turned.next = self.turned_register.q.val();
        self.verdict.next = self.verdict_register.q.val();

        self.shifted.next = self.valid.q.val() << self.one.val();
        self.valid.d.next = self.shifted.val();
        if self.issue.token_valid.val() {
            self.valid.d.next = self.shifted.val() | self.one.val();
        }
        self.done.next = self.valid.q.val().get_bit(15);
        if self.reset.val() {
            self.valid.d.next = 0.into();
            self.read_valid1.d.next = false;
            self.read_valid2.d.next = false;
        }
    }
}
