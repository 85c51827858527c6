//! Chooses the bundle that the context pushes.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `looks`, `look_id` | in | 1, 15 | a walk, or the first triangle, wants a look at a record |
//! | `opens`, `root_bundle` | in | 1, Bundle | the root wants its visits |
//! | `split`, `split_bundle` | in | 1, Bundle | a test passed through its edge |
//! | `solo_push`, `solo_bundle` | in | 1, Bundle | an insertion alone wants a visit |
//! | `push`, `bundle` | out | 1, Bundle | the one that asks; at most one does, by the phase of the context |
//!
//! Latency: none (combinational).

use super::Bundle;
use rust_hdl_core::prelude::*;

/// The bundle to push; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct PushChoice {
    /// A look is wanted.
    pub looks: Signal<In, Bit>,
    /// At this record.
    pub look_id: Signal<In, Bits<15>>,
    /// The root wants its visits.
    pub opens: Signal<In, Bit>,
    /// They.
    pub root_bundle: Signal<In, Bundle>,
    /// A test passed through its edge.
    pub split: Signal<In, Bit>,
    /// The visits behind it.
    pub split_bundle: Signal<In, Bundle>,
    /// An insertion alone wants a visit.
    pub solo_push: Signal<In, Bit>,
    /// It.
    pub solo_bundle: Signal<In, Bundle>,
    /// One of them asks.
    pub push: Signal<Out, Bit>,
    /// Its bundle.
    pub bundle: Signal<Out, Bundle>,
}

impl Logic for PushChoice {
    #[hdl_gen]
    fn update(&mut self) {
        self.push.next = self.looks.val() | self.opens.val() | self.split.val() | self.solo_push.val();
        self.bundle.next = self.split_bundle.val();
        if self.opens.val() {
            self.bundle.next = self.root_bundle.val();
        }
        if self.solo_push.val() {
            self.bundle.next = self.solo_bundle.val();
        }
        if self.looks.val() {
            self.bundle.next.is_pair = false;
            self.bundle.next.rotates = false;
            self.bundle.next.locks = false;
            self.bundle.next.x = 0.into();
            self.bundle.next.after = 0.into();
            self.bundle.next.f_entry = 0.into();
            self.bundle.next.f = 0.into();
            self.bundle.next.u = self.look_id.val();
            self.bundle.next.second_x = 0.into();
            self.bundle.next.second_after = 0.into();
            self.bundle.next.second_u = 0.into();
        }
    }
}
