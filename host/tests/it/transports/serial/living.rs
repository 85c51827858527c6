//! A mesh that lives on a board at the end of a bad line: no change is lost, and none is made twice.

use std::cell::Cell;
use std::rc::Rc;
use std::time::Instant;

use crate::common::living::{few_changes_agree, random_changes_agree};
use crate::common::rig::{Fate, Rig};
use incircle::transports::parts::Params;
use incircle::transports::{AnswerHead, Capabilities};
use incircle::{Device, Transport, TransportError};
use incircle_protocol::{Command, CORE_RUNS, FEATURE_RUNS};
use incircle_testkit::SplitMix64;

/// A line that tells how many commands have been sent again.
struct Told {
    rig: Rig,
    repeats: Rc<Cell<u64>>,
}

impl Transport for Told {
    fn name(&self) -> String {
        self.rig.name()
    }

    fn submit(&mut self, commands: &[Command<&[u32]>], deadline: Instant) -> Result<(), TransportError> {
        let done = self.rig.submit(commands, deadline);
        self.repeats.set(self.rig.repeats());
        done
    }

    fn receive(
        &mut self,
        head: AnswerHead,
        payload: &mut [u32],
        deadline: Instant,
    ) -> Result<AnswerHead, TransportError> {
        self.rig.receive(head, payload, deadline)
    }

    fn capabilities(&self) -> Capabilities {
        self.rig.capabilities()
    }

    fn repeats(&self) -> u64 {
        self.rig.repeats()
    }
}

/// A board with these runs, on a line that spoils one frame in `rarity`.
fn rig(runs: u32, seed: u64, rarity: u64) -> Rig {
    let mut rig = Rig::new(Params::with_rate(12_000_000), 4096);
    rig.board = rig.board.with_runs(runs);
    let mut random = SplitMix64::new(seed);
    rig.faults = Box::new(move |_, _| match random.below(rarity) {
        0 => random.pick(&[Fate::Lost, Fate::Changed, Fate::Twice, Fate::Overtaken]),
        _ => Fate::Passes,
    });
    rig
}

/// Makes random changes and asks questions, and compares the board with the processor. Returns the number of commands
/// that were sent again.
fn compare(runs: u32, seed: u64, rarity: u64) -> u64 {
    let repeats = Rc::new(Cell::new(0));
    let told = Told { rig: rig(runs, seed, rarity), repeats: Rc::clone(&repeats) };
    random_changes_agree(Device::from_transport(Box::new(told)), seed);
    repeats.get()
}

#[test]
fn a_sound_line_repeats_nothing() {
    for runs in [CORE_RUNS, FEATURE_RUNS] {
        assert_eq!(compare(runs, 1, u64::MAX), 0);
    }
}

#[test]
fn faults_of_the_line_leave_no_trace_in_the_mesh() {
    for runs in [CORE_RUNS, FEATURE_RUNS] {
        let repeats: u64 = (0..30).map(|seed| compare(runs, seed, 12)).sum();
        assert!(repeats > 100, "only {repeats} commands were sent again");
    }
}

/// The answer to a change is lost, whichever frame of it is. The change is made once.
#[test]
fn a_change_whose_answer_is_lost_is_made_once() {
    for place in 0..60 {
        let mut rig = Rig::new(Params::with_rate(12_000_000), 4096);
        rig.board = rig.board.with_runs(FEATURE_RUNS);
        rig.faults = Box::new(move |to_host, frame| if to_host && frame == place { Fate::Lost } else { Fate::Passes });
        few_changes_agree(Device::from_transport(Box::new(rig)), &format!("frame {place}"));
    }
}
