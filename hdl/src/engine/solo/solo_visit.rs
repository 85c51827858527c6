//! The visit that a solo insertion makes in each phase.
//!
//! Latency: none, the block is combinational.

use super::star_state::{SoloPhase, StarTriangle};
use crate::engine::types::{Bundle, ContextId, TriangleId, Turned};
use rust_hdl_core::prelude::*;

#[derive(LogicBlock, Default)]
pub struct SoloVisit {
    /// The context of the insertion.
    pub context_id: Signal<In, ContextId>,
    /// The phase. Unless the phase is to locate, mend or fetch, the visit is that of a test. A mend visits neighbour 1
    /// of the located record, or neighbour 2 (`is_second`).
    pub phase: Signal<In, SoloPhase>,
    pub is_second: Signal<In, Bit>,
    /// The located record, or the one that the walk has come to.
    pub root_id: Signal<In, TriangleId>,
    pub root: Signal<In, Turned>,
    /// The star record at work.
    pub triangle: Signal<In, StarTriangle>,
    /// The visit, which takes no lock.
    pub bundle: Signal<Out, Bundle>,
}

impl Logic for SoloVisit {
    #[hdl_gen]
    fn update(&mut self) {
        self.bundle.next.is_pair = false;
        self.bundle.next.is_triple = false;
        self.bundle.next.context = self.context_id.val();
        self.bundle.next.rotates = (!self.phase.val().is_fetch) & (!self.phase.val().is_locate);
        self.bundle.next.locks = false;
        self.bundle.next.entry = 0.into();
        self.bundle.next.after = 0.into();
        self.bundle.next.cavity_entry = 0.into();
        self.bundle.next.cavity_record = self.triangle.val().back;
        self.bundle.next.record = self.triangle.val().outer;
        self.bundle.next.second_after = 0.into();
        self.bundle.next.second_record = 0.into();
        self.bundle.next.third_record = 0.into();
        if self.phase.val().is_fetch {
            self.bundle.next.cavity_record = 0.into();
            self.bundle.next.record = self.triangle.val().id;
        }
        if self.phase.val().is_locate {
            self.bundle.next.cavity_record = 0.into();
            self.bundle.next.record = self.root_id.val();
        }
        if self.phase.val().is_mend {
            self.bundle.next.cavity_record = self.root_id.val();
            self.bundle.next.record = self.root.val().n1;
            if self.is_second.val() {
                self.bundle.next.record = self.root.val().n2;
            }
        }
    }
}
