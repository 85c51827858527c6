//! The visits that open a cavity: the root's lock, then the tests of its three neighbours.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `step` | in | 3 | 0: the lock; 1: the neighbours across edges 0 and 1; 2: the one across edge 2 |
//! | `root_id`, `root` | in | 15, Turned | the located triangle |
//! | `bundle` | out | Bundle | the visits |
//! | `visits` | out | 2 | how many they are |
//!
//! 1. Ring entry `k` is the root's edge opposite its vertex `k`; the entry after it is `k + 1`, modulo 3.
//!
//! Latency: none (combinational).

use super::{Bundle, Turned};
use rust_hdl_core::prelude::*;

/// The visits that open a cavity; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct RootBundle {
    /// Which visits.
    pub step: Signal<In, Bits<3>>,
    /// The located triangle.
    pub root_id: Signal<In, Bits<15>>,
    /// Its record.
    pub root: Signal<In, Turned>,
    /// The visits.
    pub bundle: Signal<Out, Bundle>,
    /// How many.
    pub visits: Signal<Out, Bits<2>>,
    is_lock: Signal<Local, Bit>,
    is_pair: Signal<Local, Bit>,
    lock_step: Signal<Local, Bits<3>>,
    pair_step: Signal<Local, Bits<3>>,
}

impl Logic for RootBundle {
    #[hdl_gen]
    fn update(&mut self) {
        self.lock_step.next = 0.into();
        self.pair_step.next = 1.into();
        self.is_lock.next = self.step.val() == self.lock_step.val();
        self.is_pair.next = self.step.val() == self.pair_step.val();

        // The test across edge 2.
        self.visits.next = 1.into();
        self.bundle.next.is_pair = self.is_pair.val();
        self.bundle.next.rotates = true;
        self.bundle.next.locks = true;
        self.bundle.next.x = 2.into();
        self.bundle.next.after = 0.into();
        self.bundle.next.f_entry = 0.into();
        self.bundle.next.f = self.root_id.val();
        self.bundle.next.u = self.root.val().n2;
        self.bundle.next.second_x = 1.into();
        self.bundle.next.second_after = 2.into();
        self.bundle.next.second_u = self.root.val().n1;
        if self.is_pair.val() {
            self.visits.next = 2.into();
            self.bundle.next.x = 0.into();
            self.bundle.next.after = 1.into();
            self.bundle.next.u = self.root.val().n0;
        }
        if self.is_lock.val() {
            self.bundle.next.rotates = false;
            self.bundle.next.x = 0.into();
            self.bundle.next.after = 0.into();
            self.bundle.next.f = 0.into();
            self.bundle.next.u = self.root_id.val();
        }
    }
}
