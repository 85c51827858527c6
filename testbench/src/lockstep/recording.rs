//! The inputs of a run, so that its last clocks can be shown once more.

use std::collections::VecDeque;

use incircle_model::Inputs;

/// Number of clocks that are kept, in 32 MiB. A run of fewer clocks can be replayed.
pub const KEPT: usize = 1 << 22;

/// The last inputs of a run, at most a fixed number of them.
#[derive(Debug)]
pub(super) struct Recording {
    inputs: VecDeque<Inputs>,
    limit: usize,
    /// Number of inputs that were dropped because more came than are kept.
    dropped: u64,
}

impl Recording {
    /// Makes an empty recording that keeps `limit` clocks.
    pub(super) fn keeping(limit: usize) -> Self {
        Self { inputs: VecDeque::new(), limit, dropped: 0 }
    }

    /// Notes a clock. The oldest one makes room.
    pub(super) fn note(&mut self, inputs: Inputs) {
        if self.inputs.len() == self.limit {
            self.inputs.pop_front();
            self.dropped += 1;
        }
        self.inputs.push_back(inputs);
    }

    /// All inputs since the start, or `None` if some were dropped.
    pub(super) fn whole(&self) -> Option<&VecDeque<Inputs>> {
        (self.dropped == 0).then_some(&self.inputs)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn inputs(command_data: u32) -> Inputs {
        Inputs { command_data, ..Inputs::default() }
    }

    #[test]
    fn a_long_run_takes_no_more_memory_than_a_short_one() {
        let mut recording = Recording::keeping(100);
        (0..100).for_each(|clock| recording.note(inputs(clock)));
        let room = recording.inputs.capacity();
        assert_eq!(recording.whole().map(VecDeque::len), Some(100));
        (100..100_000).for_each(|clock| recording.note(inputs(clock)));
        assert_eq!((recording.inputs.len(), recording.inputs.capacity()), (100, room));
        assert_eq!(recording.inputs.front().map(|inputs| inputs.command_data), Some(99_900));
        assert!(recording.whole().is_none(), "the run cannot be replayed from its start any more");
    }
}
