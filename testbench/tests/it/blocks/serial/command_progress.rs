//! Runs `CommandProgress` in Rust and in Verilog beside plain code: all three must agree.

use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::serial::CommandProgress;
use incircle_testkit::SplitMix64;

named_ports!(CommandProgress, [reset, takes, word, offers_last, takes_answer, answer_ended], [is_busy], clock);

/// A core and a link that sends its answers, as the block sees them.
#[derive(Default)]
struct Traffic {
    /// Arguments that the command at work still awaits.
    arguments: Option<u64>,
    /// Clocks until the command is done.
    working: Option<u64>,
    /// The last word of an answer is on offer and not taken yet.
    offers: bool,
    /// The last word was taken, and its frame is not over.
    is_sent: bool,
    begun: u64,
    ended: u64,
}

#[test]
fn a_command_is_under_way_until_its_answer_has_ended() {
    let mut random = SplitMix64::new(4);
    let mut block = Stepper::new("serial_command_progress", CommandProgress::default(), 1);
    let mut core = Traffic::default();
    let (mut rested, mut two_deep, mut paddings) = (0, 0, 0);
    for clock in 0..40_000 {
        let reset = clock == 0 || random.below(2000) == 0;
        // The core takes words of the next command once it has offered the last answer to its end.
        let awaits = core.working.is_none();
        let takes = awaits && random.below([2, 20][clock / 5000 % 2]) == 0;
        let is_command = takes && core.arguments.is_none();
        let word = if random.below(3) == 0 { 0 } else { 1 + random.below(1 << 31) as u32 };
        // A link takes the word on offer only after it has ended the answer before.
        let takes_answer = !core.is_sent && random.below(4) == 0;
        let ends = core.is_sent && random.below(6) == 0;
        for (port, bit) in [
            ("reset", reset),
            ("takes", takes),
            ("offers_last", core.offers),
            ("takes_answer", takes_answer),
            ("answer_ended", ends),
        ] {
            block.set(port, bit);
        }
        block.set("word", word);
        block.settle();
        let under_way = core.begun - core.ended;
        if clock > 0 {
            block.expect("is_busy", under_way > 0);
        }
        rested += u32::from(under_way == 0);
        two_deep += u32::from(core.is_sent && core.offers && core.arguments.is_some());
        block.edge();
        if reset {
            core = Traffic::default();
            continue;
        }
        core.ended += u64::from(ends);
        core.is_sent &= !ends;
        if core.offers && takes_answer {
            (core.offers, core.is_sent) = (false, true);
        }
        if is_command && word == 0 {
            paddings += 1;
        } else if is_command {
            core.begun += 1;
            core.arguments = Some(random.below(4));
        } else if takes {
            core.arguments = core.arguments.map(|left| left - 1);
        }
        if core.arguments == Some(0) {
            (core.arguments, core.working) = (None, Some(random.below(8)));
        }
        // The core offers nothing until its last offer is taken.
        match core.working {
            Some(0) if !core.offers => (core.working, core.offers) = (None, true),
            Some(left) => core.working = Some(left.saturating_sub(1)),
            None => {}
        }
    }
    assert!(rested > 500 && two_deep > 100 && paddings > 100, "{rested} at rest, {two_deep} deep, {paddings} paddings");
}
