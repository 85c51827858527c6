//! The first triangle and its three ghosts.

use super::memory::Write;
use super::wires::Wires;
use super::Registers;

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Seeder {
    pub seeded: bool,
    pub collinear: bool,
    /// 0: the look at the triple; 1 to 4: the records.
    pub step: u32,
    turns_left: bool,
    pub write: Write,
}

impl Seeder {
    /// The last ghost is written at this edge.
    pub(super) fn seeds(&self) -> bool {
        self.step == 4
    }

    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires) {
        let inf = wires.infinite;
        let (b, c) = if was.seeder.turns_left { (1, 2) } else { (2, 1) };
        self.write.valid = false;
        match was.seeder.step {
            0 => self.look(was, wires),
            1 => self.write = Write::record(0, [0, b, c], [1, 2, 3]),
            2 => self.write = Write::record(1, [c, b, inf], [3, 2, 0]),
            3 => self.write = Write::record(2, [0, c, inf], [1, 3, 0]),
            _ => {
                self.write = Write::record(3, [b, 0, inf], [2, 1, 0]);
                self.seeded = true;
                self.step = 0;
            }
        }
        if was.seeder.step != 0 && was.seeder.step != 4 {
            self.step += 1;
        }
        if was.command.clears {
            self.seeded = false;
            self.collinear = false;
        }
    }

    fn look(&mut self, was: &Registers, wires: &Wires) {
        if was.command.came && was.command.came_id == 0 {
            // The look at the triple needs a record with the first three vertices.
            self.write = Write::record(0, [0, 1, 2], [0; 3]);
        }
        let looks = wires.outcome.is_some_and(|outcome| outcome.looks);
        if let Some(done) = wires.done.filter(|_| looks) {
            self.turns_left = done.turn > 0;
            self.collinear = done.turn == 0;
            self.step = u32::from(done.turn != 0);
        }
    }
}
