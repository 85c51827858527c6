//! The visit that an insertion alone makes, by what it does.
//!
//! Latency: none (combinational).

use crate::engine::types::{Bundle, Turned};
use rust_hdl_core::prelude::*;

/// Visits of an insertion alone; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct SoloVisit {
    /// The context.
    pub owner: Signal<In, Bits<5>>,
    /// The triangle that a walk has come to; the star triangle at work.
    pub is_locate: Signal<In, Bit>,
    pub is_fetch: Signal<In, Bit>,
    /// An outer neighbour of the split, the second one; a test if nothing else.
    pub is_mend: Signal<In, Bit>,
    pub is_second: Signal<In, Bit>,
    /// The located triangle, or the one that the walk has come to.
    pub root_id: Signal<In, Bits<15>>,
    pub root: Signal<In, Turned>,
    /// The star triangle at work, the one outside, and the link by which that leads back.
    pub id: Signal<In, Bits<15>>,
    pub outer: Signal<In, Bits<15>>,
    pub back: Signal<In, Bits<15>>,
    /// The visit; it sets no lock.
    pub bundle: Signal<Out, Bundle>,
}

impl Logic for SoloVisit {
    #[hdl_gen]
    fn update(&mut self) {
        self.bundle.next.is_pair = false;
        self.bundle.next.is_triple = false;
        self.bundle.next.owner = self.owner.val();
        self.bundle.next.rotates = (!self.is_fetch.val()) & (!self.is_locate.val());
        self.bundle.next.locks = false;
        self.bundle.next.x = 0.into();
        self.bundle.next.after = 0.into();
        self.bundle.next.f_entry = 0.into();
        self.bundle.next.f = self.back.val();
        self.bundle.next.u = self.outer.val();
        self.bundle.next.second_after = 0.into();
        self.bundle.next.second_u = 0.into();
        self.bundle.next.third_u = 0.into();
        if self.is_fetch.val() {
            self.bundle.next.f = 0.into();
            self.bundle.next.u = self.id.val();
        }
        if self.is_locate.val() {
            self.bundle.next.f = 0.into();
            self.bundle.next.u = self.root_id.val();
        }
        if self.is_mend.val() {
            self.bundle.next.f = self.root_id.val();
            self.bundle.next.u = self.root.val().n1;
            if self.is_second.val() {
                self.bundle.next.u = self.root.val().n2;
            }
        }
    }
}
