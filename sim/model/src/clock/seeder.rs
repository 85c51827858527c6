//! Writes the first triangle and its three ghost triangles; in a batch, one after the other for each job.
//!
//! Hardware twin: the block `Seeder`.

use super::memory::Write;
use super::wires::{Registers, Wires};

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Seeder {
    /// Whether every job has its first triangle.
    pub seeded: bool,
    /// The job whose first triangle is made next, or was made last.
    job: u32,
    pub collinear: bool,
    /// Whether the points of the job's first triangle have come, as known a clock ago.
    pub has_triple: bool,
    /// Step 0 is the look at the first three points; steps 1 to 4 write the records.
    pub step: u32,
    turns_left: bool,
    pub write: Write,
}

impl Seeder {
    /// Whether no first triangle is being made, and none can be made from the points that have come.
    pub(super) fn has_no_start(&self) -> bool {
        (!self.has_triple || self.collinear) && self.step == 0
    }

    /// Whether the last ghost triangle is written at this edge.
    pub(super) fn seeds(&self) -> bool {
        self.step == 4
    }

    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires) {
        let inf = wires.infinite;
        self.has_triple = was.command.arrived >= 3 * was.seeder.job + 3;
        let (a, first) = (3 * was.seeder.job, 4 * was.seeder.job);
        let (b, c) = if was.seeder.turns_left { (a + 1, a + 2) } else { (a + 2, a + 1) };
        let record = |k: u32, v, n: [u32; 3]| Write::record(first + k, v, n.map(|k| first + k));
        self.write.valid = false;
        match was.seeder.step {
            0 => self.look(was, wires),
            1 => self.write = record(0, [a, b, c], [1, 2, 3]),
            2 => self.write = record(1, [c, b, inf], [3, 2, 0]),
            3 => self.write = record(2, [a, c, inf], [1, 3, 0]),
            _ => {
                self.write = record(3, [b, a, inf], [2, 1, 0]);
                let is_last = was.seeder.job + 1 == was.command.jobs;
                self.seeded = is_last;
                self.job += u32::from(!is_last);
                self.step = 0;
            }
        }
        if was.seeder.step != 0 && was.seeder.step != 4 {
            self.step += 1;
        }
        if was.command.clears {
            self.seeded = false;
            self.job = 0;
            self.has_triple = false;
            self.collinear = false;
        }
    }

    fn look(&mut self, was: &Registers, wires: &Wires) {
        let (a, first) = (3 * self.job, 4 * self.job);
        if was.command.came && was.command.came_id == a {
            // The look at the first three points is a visit, which needs a record with their vertices.
            self.write = Write::record(first, [a, a + 1, a + 2], [first; 3]);
        }
        let looks = wires.outcome.is_some_and(|outcome| outcome.looks);
        if let Some(done) = wires.done.filter(|_| looks) {
            self.turns_left = done.turn > 0;
            self.collinear = done.turn == 0;
            self.step = u32::from(done.turn != 0);
        }
    }
}
