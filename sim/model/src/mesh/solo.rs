//! Solo insertion, in constant memory, for cavities whose boundary is longer than the list: split the root, then flip
//! once round the star (the flips of Lawson 1977, in the order of the star).
//!
//! Hardware twin: the blocks of `hdl/src/engine/solo/`.

use super::record::Record;
use super::Mesh;
use crate::predicate::Point;

/// The current triangle of the star: `v = (p, a, b)`, `n = (outer, after, before)`.
struct Star {
    id: u32,
    a: u32,
    b: u32,
    outer: u32,
    after: u32,
    before: u32,
    /// The neighbour that `outer` names across this edge: the id of the triangle that was flipped away last, or `id`.
    back: u32,
}

impl Mesh {
    /// Inserts `p`, whose point `root` holds, with `2 * flips + 3` tests.
    pub(super) fn insert_solo(&mut self, p: u32, position: Point, root: u32) {
        let old = self.records[root as usize];
        self.split(p, root, &old);
        let first = old.v[1];
        let mut star = self.star_at(root);
        loop {
            self.counts.tests += 1;
            let slot = self.records[star.outer as usize].slot_of(star.back);
            let u = self.records[star.outer as usize].rotated(slot);
            if self.in_conflict(&u, position) {
                self.flip(p, &mut star, &u);
                continue;
            }
            if star.back != star.id {
                self.records[star.outer as usize].n[slot] = star.id;
            }
            if star.b == first {
                return;
            }
            star = self.star_at(star.after);
        }
    }

    /// Replaces `root` by three triangles at `p`, and corrects the neighbours outside at once.
    fn split(&mut self, p: u32, root: u32, old: &Record) {
        let (second, third) = (self.new_record(), self.new_record());
        let [v0, v1, v2] = old.v;
        self.records[root as usize] = Record { v: [p, v1, v2], n: [old.n[0], second, third] };
        self.records[second as usize] = Record { v: [p, v2, v0], n: [old.n[1], third, root] };
        self.records[third as usize] = Record { v: [p, v0, v1], n: [old.n[2], root, second] };
        for (outer, id) in [(old.n[1], second), (old.n[2], third)] {
            let slot = self.records[outer as usize].slot_of(root);
            self.records[outer as usize].n[slot] = id;
        }
    }

    fn star_at(&self, id: u32) -> Star {
        let Record { v, n } = self.records[id as usize];
        Star { id, a: v[1], b: v[2], outer: n[0], after: n[1], before: n[2], back: id }
    }

    /// Flips the edge between the current triangle and `u`, which is rotated so that its apex comes first. The id of
    /// `u` becomes the next triangle of the star.
    fn flip(&mut self, p: u32, star: &mut Star, u: &Record) {
        self.counts.flips += 1;
        let apex = u.v[0];
        let flipped = star.outer;
        self.records[star.id as usize] = Record { v: [p, star.a, apex], n: [u.n[1], flipped, star.before] };
        self.records[flipped as usize] = Record { v: [p, apex, star.b], n: [u.n[2], star.after, star.id] };
        self.records[star.after as usize].n[2] = flipped;
        (star.b, star.outer, star.after, star.back) = (apex, u.n[1], flipped, flipped);
    }
}
