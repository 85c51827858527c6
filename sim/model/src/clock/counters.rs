//! The event counters.

use super::command_port::State as CommandState;
use super::context::Phase;
use super::wires::Wires;
use super::Registers;
use incircle_protocol::{Counter, COUNTER_WORDS};

#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Counters {
    insert_cycles: u64,
    wait_cycles: u64,
    read_cycles: u64,
    pub insertions: u32,
    pub duplicates: u32,
    walk_visits: u32,
    tests: u32,
    cavity_triangles: u32,
    overflows: u32,
    flips: u32,
}

impl Counters {
    pub(super) fn clock(&mut self, was: &Registers, wires: &Wires) {
        let phase = was.context.phase;
        let awaits_point = was.command.state == CommandState::Points && was.command.count != 0 && wires.is_quiet;
        let walked = wires.done.filter(|_| phase == Phase::Walk);
        let tests = wires.done.is_some_and(|done| done.token.rotates && done.token.locks);
        let seeds = phase == Phase::Seed && was.context.seeds();
        self.insert_cycles += u64::from(was.command.inserting);
        self.wait_cycles += u64::from(was.command.inserting && awaits_point);
        self.read_cycles += u64::from(was.command.reading);
        self.insertions += if seeds { 3 } else { u32::from(wires.commit_ends || wires.solo_ends) };
        self.duplicates += u32::from(walked.is_some_and(|done| done.located && done.falls_onto_corner));
        self.walk_visits += u32::from(walked.is_some());
        self.tests += u32::from(tests || was.solo.tests(wires.done));
        if wires.commit_ends {
            self.cavity_triangles += was.cavity.count - 2;
        }
        self.overflows += u32::from(wires.drained);
        self.flips += u32::from(was.solo.flips());
        if was.command.clears {
            *self = Self::default();
        }
    }

    /// The answer to `Counters`.
    pub(super) fn words(&self, refused: u32) -> [u32; COUNTER_WORDS] {
        let mut words = [0; COUNTER_WORDS];
        for (counter, value) in [
            (Counter::InsertCycles, self.insert_cycles),
            (Counter::WaitCycles, self.wait_cycles),
            (Counter::ReadCycles, self.read_cycles),
        ] {
            words[counter as usize] = value as u32;
            words[counter as usize + 1] = (value >> 32) as u32;
        }
        for (counter, value) in [
            (Counter::Insertions, self.insertions),
            (Counter::Duplicates, self.duplicates),
            (Counter::Refused, refused),
            (Counter::WalkVisits, self.walk_visits),
            (Counter::Tests, self.tests),
            (Counter::CavityTriangles, self.cavity_triangles),
            (Counter::Overflows, self.overflows),
            (Counter::Flips, self.flips),
        ] {
            words[counter as usize] = value;
        }
        words
    }
}
