//! The visits that a completion asks for.
//!
//! | port | direction | bits | meaning |
//! |---|---|---|---|
//! | `token`, `turned` | in | | the visit that completes, and its record |
//! | `walk_next` | in | 15 | where a walk goes on |
//! | `entry` | in | 6 | the entry that a split allocates |
//! | `repeats`, `walks_on`, `locates`, `opens`, `splits` | in | 1 | from `VisitCase`, at most one of them high |
//! | `push` | out | 1 | there are visits to make |
//! | `bundle` | out | Bundle | the visits |
//!
//! ```text
//!           c                         c
//!          / \                       ^ \
//!         /   \       split       X /   \ Y       X = (a -> c), Y = (c -> b), both with u behind them
//!        /  u  \     ------->      /     v
//!       a ----> b                 a       b
//!           p                         p
//! ```
//! Latency: none (combinational).

use super::{Bundle, Token, Turned};
use rust_hdl_core::prelude::*;

/// The visits asked for; see the top of this file.
#[derive(LogicBlock, Default)]
pub struct NextVisits {
    /// The visit.
    pub token: Signal<In, Token>,
    /// Its record.
    pub turned: Signal<In, Turned>,
    /// Where a walk goes on.
    pub walk_next: Signal<In, Bits<15>>,
    /// A new entry.
    pub entry: Signal<In, Bits<6>>,
    /// The same visit again.
    pub repeats: Signal<In, Bit>,
    /// The walk goes on.
    pub walks_on: Signal<In, Bit>,
    /// The root is visited under its lock.
    pub locates: Signal<In, Bit>,
    /// Its neighbours are tested.
    pub opens: Signal<In, Bit>,
    /// Both halves of an edge go on.
    pub splits: Signal<In, Bit>,
    /// There are visits.
    pub push: Signal<Out, Bit>,
    /// The visits.
    pub bundle: Signal<Out, Bundle>,
}

impl Logic for NextVisits {
    #[hdl_gen]
    fn update(&mut self) {
        self.push.next =
            self.repeats.val() | self.walks_on.val() | self.locates.val() | self.opens.val() | self.splits.val();
        // The same visit again, but for what each case changes.
        self.bundle.next.is_pair = self.opens.val() | self.splits.val();
        self.bundle.next.is_triple = self.opens.val();
        self.bundle.next.owner = self.token.val().owner;
        self.bundle.next.rotates = self.token.val().rotates | self.opens.val();
        self.bundle.next.locks = self.token.val().locks | self.locates.val();
        self.bundle.next.x = self.token.val().x;
        self.bundle.next.after = self.token.val().after;
        self.bundle.next.f_entry = self.token.val().f_entry;
        self.bundle.next.f = self.token.val().f;
        self.bundle.next.u = self.token.val().u;
        self.bundle.next.second_after = self.token.val().after;
        self.bundle.next.second_u = self.turned.val().n2;
        self.bundle.next.third_u = self.turned.val().n2;
        if self.walks_on.val() {
            self.bundle.next.u = self.walk_next.val();
        }
        if self.splits.val() {
            self.bundle.next.after = self.entry.val();
            self.bundle.next.f_entry = self.entry.val();
            self.bundle.next.f = self.token.val().u;
            self.bundle.next.u = self.turned.val().n1;
        }
        if self.opens.val() {
            self.bundle.next.x = 0.into();
            self.bundle.next.after = 1.into();
            self.bundle.next.f_entry = 0.into();
            self.bundle.next.f = self.token.val().u;
            self.bundle.next.u = self.turned.val().n0;
            self.bundle.next.second_after = 2.into();
            self.bundle.next.second_u = self.turned.val().n1;
        }
    }
}
