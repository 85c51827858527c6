//! The insertion engine: points in, triangle records kept, many insertions in flight on one pipeline.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `clock`, `reset` | in | 1 | reset forgets everything but the memories, and sweeps the locks |
//! | `infinite`, `ring`, `last_id`, `all`, `patience` | in | 15, 7, 15, 24, 22 | parameters, constants |
//! | `contexts` | in | 5 | contexts that work; changes only with `clears` |
//! | `clears` | in | 1 | forget the mesh at this edge; only while quiet |
//! | `came`, `came_id`, `point`, `arrived` | in | 1, 15, 32, 15 | a point is stored at this edge; points that have come |
//! | `read`, `read_id`, `read_done`, `v0..n2`, `was_set` | in, out | | read-out of a record; only while quiet |
//! | `seeded`, `collinear`, `records` | out | 1, 1, 15 | state of the mesh |
//! | `is_quiet`, `stuck`, `sweeps` | out | 1 | every point is finished; nothing is finished any more; locks are being swept |
//! | `write` | out | Write | the write port of the triangle memory |
//! | `seeds` ... `cavity_triangles` | out | | events at this edge, for the counters |
//!
//! ```text
//!           +----------------------- visits, one to three a push <-----------------------+
//!           v                                                                           |
//! Starter --+-> VisitPipeline -> completion -> Attempts --- ring --> RingReader -> Commit -> WritePort -> memory
//!    ^                              |          |      \--- locks --> Release -> lock memory           ^
//!    +---- ContextFlags <-----------+----------+                                                      |
//!                                   +-> Solo (alone), Seeder (the first triangle) --------------------+
//! ```
//! Latency: see the blocks.

use super::{
    Attempts, Bundle, Commit, ContextFlags, Progress, Release, RingReader, Seeder, Solo, Starter, VisitPipeline,
    Watchdog, Write, WritePort,
};
use incircle_protocol::Config;
use rust_hdl_core::prelude::*;
use rust_hdl_widgets::prelude::*;

/// The engine; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct InsertionEngine {
    /// Clock.
    pub clock: Signal<In, Clock>,
    /// Forgets everything but the memories.
    pub reset: Signal<In, Bit>,
    /// The infinite vertex.
    pub infinite: Signal<In, Bits<15>>,
    /// Entries of a boundary list.
    pub ring: Signal<In, Bits<7>>,
    /// The highest record id.
    pub last_id: Signal<In, Bits<15>>,
    /// Contexts that are built, a bit each.
    pub all: Signal<In, Bits<24>>,
    /// Clocks without a finished point.
    pub patience: Signal<In, Bits<22>>,
    /// Contexts that work.
    pub contexts: Signal<In, Bits<5>>,
    /// Forget the mesh.
    pub clears: Signal<In, Bit>,
    /// A point is stored.
    pub came: Signal<In, Bit>,
    /// Its vertex id.
    pub came_id: Signal<In, Bits<15>>,
    /// Its coordinates.
    pub point: Signal<In, Bits<32>>,
    /// Points that have come.
    pub arrived: Signal<In, Bits<15>>,
    /// A read-out wants a record.
    pub read: Signal<In, Bit>,
    /// The record.
    pub read_id: Signal<In, Bits<15>>,
    /// The time.
    pub now: Signal<In, Bits<22>>,
    /// The first triangle stands.
    pub seeded: Signal<Out, Bit>,
    /// The first three points are collinear.
    pub collinear: Signal<Out, Bit>,
    /// Records of the mesh.
    pub records: Signal<Out, Bits<15>>,
    /// Every point is finished, and no lock is held.
    pub is_quiet: Signal<Out, Bit>,
    /// Nothing is finished any more.
    pub stuck: Signal<Out, Bit>,
    /// The lock memory is being cleared after reset.
    pub sweeps: Signal<Out, Bit>,
    /// The record read stands on the columns.
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
    /// The write port of the triangle memory.
    pub write: Signal<Out, Write>,
    /// What happens at this edge.
    pub events: Signal<Out, Events>,
    starter: Starter,
    flags: ContextFlags,
    attempts: Attempts,
    pipeline: VisitPipeline,
    rings: RingReader,
    commit: Commit,
    solo: Solo,
    seeder: Seeder,
    lock_release: Release,
    write_port: WritePort,
    progress: Progress,
    watchdog: Watchdog,
    pushes: DFF<Bit>,
    pushed: DFF<Bundle>,
    outcome_is_live: Signal<Local, Bit>,
    first_vertex: Signal<Local, Bits<15>>,
}
