//! Runs `ClearCommand` in Rust and in Verilog beside lists of what must happen: all three must agree in every clock.

use crate::rig::stepper::bundles::Deal;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::commands::ClearCommand;
use incircle_protocol::{clear_word, command_starts_batch, command_word, Opcode, FIRST_ROUND, MAX_CONTEXTS};
use incircle_testkit::SplitMix64;

named_ports!(ClearCommand, [reset, built, taken], [clearing, deal], clock);

const CLOCKS: usize = 8000;

#[test]
fn clear_command_is_granted_or_refused() {
    let mut random = SplitMix64::new(33);
    let mut block = Stepper::new("clear_command", ClearCommand::default(), 1);
    let (mut clears, mut contexts, mut is_batch, mut is_refused) = (false, 0, false, None);
    // The first vertex that is dealt follows a clock later.
    let mut dealt_from = 0;
    let mut kinds = [0; 3];
    let mut built = 1;
    for clock in 0..CLOCKS {
        let reset = clock == 0 || random.below(300) == 0;
        if reset {
            built = 1 + random.below(MAX_CONTEXTS.into()) as u32;
        }
        let wanted = [0, built, built + 1, random.below(256) as u32][random.below(4) as usize];
        let word = match random.below(3) {
            0 => command_word(Opcode::Insert) | wanted,
            1 => random.next_u64() as u32,
            // Of the bits between the opcode and the low byte only the lowest counts, so the others are random.
            _ => clear_word(wanted) | (random.below(1 << 16) as u32) << 8,
        };
        let accepts = random.below(2) == 0;
        block.set("reset", reset);
        block.set("built", built);
        block.set("is_command", accepts);
        block.set("word", word);
        block.settle();
        if clock > 1 {
            block.expect("clears", clears);
            let deal = Deal { contexts: contexts.into(), is_batch, dealt_from };
            block.expect("deal", deal.bits());
        }
        if let Some(is_refused) = is_refused {
            block.expect("is_refused", u32::from(is_refused));
        }
        block.edge();
        dealt_from = if is_batch { 3 * u64::from(contexts) } else { FIRST_ROUND.into() };
        let asks = accepts && word >> 24 == Opcode::Clear as u32;
        let number = word & 0xff;
        clears = asks && number <= built && !reset;
        if clears {
            contexts = if number == 0 { built } else { number };
            is_batch = command_starts_batch(word);
        }
        if accepts {
            is_refused = Some(asks && number > built);
        }
        if asks {
            kinds[if number > built { 2 } else { usize::from(number > 0) }] += 1;
        }
        if reset {
            (contexts, is_batch, dealt_from) = (built, false, FIRST_ROUND.into());
        }
    }
    assert!(kinds.iter().all(|times| *times > 100), "{kinds:?}");
}
