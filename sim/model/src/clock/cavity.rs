//! The growing cavity: entries of the boundary ring, tokens out, inner triangles.

use super::context::Phase;
use super::memory::{Entry, Memory};
use super::pipeline::{Bundle, Completion, Token};
use super::wires::Wires;
use super::Registers;
use incircle_protocol::Config;

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cavity {
    /// Ring entries.
    pub count: u32,
    /// Visits pushed and not completed.
    pub outstanding: u32,
    /// Bit `y`: one of the two edges that entry `y`'s cavity triangle brought has been passed; the root uses bits 0 and 1.
    half_open: u64,
    pub inner_count: u32,
}

impl Cavity {
    /// The bundle of a conflict: both halves of the edge go on to the triangles behind.
    pub(super) fn split(&self, done: &Completion) -> Bundle {
        let y = self.count as usize;
        let [_, n1, n2] = done.record.n;
        let first = Token { next: y, f_entry: y, f: done.token.u, u: n1, ..done.token };
        Bundle { first, second: Some((n2, y, done.token.next)) }
    }

    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires, memory: &mut Memory, config: Config) {
        let phase = was.context.phase;
        let completes = matches!(phase, Phase::Cavity | Phase::Drain) && wires.done.is_some();
        let pushed = match phase {
            Phase::Root => was.context.root_visits(was),
            _ => wires.split.map_or(0, |bundle| bundle.len()),
        };
        self.outstanding = self.outstanding + pushed - u32::from(completes);
        if phase == Phase::Root {
            self.count = 3;
            self.half_open = 0;
            self.inner_count = 0;
        }
        let Some(done) = wires.done.filter(|done| phase == Phase::Cavity && done.token.rotates) else {
            return;
        };
        if !done.conflict {
            let Completion { token, record, slot, .. } = done;
            memory.entries[token.x] = Entry { a: record.v[2], u: token.u, slot, f: token.f, next: token.next };
        } else if was.cavity.count < config.ring {
            self.count += 1;
            if self.passes_last_edge(done.token.f_entry) {
                memory.inner[was.cavity.inner_count as usize] = done.token.f;
                self.inner_count += 1;
            }
        }
    }

    fn passes_last_edge(&mut self, f_entry: usize) -> bool {
        let bit = 1 << f_entry;
        let half = self.half_open & bit != 0;
        let root_half = f_entry == 0 && half && self.half_open & 2 == 0;
        self.half_open |= bit | u64::from(root_half) << 1;
        half && !root_half
    }
}
