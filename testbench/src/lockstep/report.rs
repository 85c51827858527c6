//! The report of a mismatch: clock, port, both values, and the last events.

use incircle_model::{Inputs, Outputs};
use std::collections::VecDeque;
use std::fmt;

/// Number of events kept for the report.
const KEPT: usize = 24;

/// The first port that differs, and what led to it.
#[derive(Debug)]
pub struct Mismatch {
    /// Number of clocks since the start.
    pub clock: u64,
    /// Name of the port.
    pub port: &'static str,
    /// Value of the model.
    pub expected: u64,
    /// Value of the core.
    pub found: u64,
    /// Activity of the model at that clock.
    pub doing: String,
    events: Vec<String>,
}

impl fmt::Display for Mismatch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(
            f,
            "clock {}: port {} is {:#x}, the model says {:#x}",
            self.clock, self.port, self.found, self.expected
        )?;
        writeln!(f, "the model is at: {}", self.doing)?;
        write!(f, "last events:\n  {}", self.events.join("\n  "))
    }
}

impl std::error::Error for Mismatch {}

/// The last events: words taken on either stream, writes, resets.
#[derive(Debug, Default)]
pub(super) struct History {
    events: VecDeque<(u64, Inputs, Outputs)>,
}

impl History {
    /// Notes the events of a clock, if there are any.
    pub(super) fn note(&mut self, clock: u64, inputs: Inputs, outputs: Outputs) {
        let takes = inputs.command_valid && outputs.command_ready;
        let gives = inputs.response_ready && outputs.response_valid;
        if !(inputs.reset || takes || gives || outputs.write.valid) {
            return;
        }
        if self.events.len() == KEPT {
            self.events.pop_front();
        }
        self.events.push_back((clock, inputs, outputs));
    }

    pub(super) fn mismatch(
        &self,
        clock: u64,
        port: &'static str,
        expected: u64,
        found: u64,
        doing: String,
    ) -> Mismatch {
        let events = self.events.iter().map(describe).collect();
        Mismatch { clock, port, expected, found, doing, events }
    }
}

fn describe((clock, inputs, outputs): &(u64, Inputs, Outputs)) -> String {
    let mut text = format!("{clock}:");
    if inputs.reset {
        text += " reset";
    }
    if inputs.command_valid && outputs.command_ready {
        text += &format!(" command {:08x}", inputs.command_data);
    }
    if inputs.response_ready && outputs.response_valid {
        outputs.answer_words().for_each(|word| text += &format!(" answer {word:08x}"));
    }
    let write = outputs.write;
    if write.valid {
        text += &format!(" write {} links {:?} {:?}", write.id, write.links, write.record);
    }
    text
}
