//! Runs `ClearCommand` in Rust and in Verilog beside lists of what must happen: all three must agree in every clock.

use crate::rig::stepper::bundles::Deal;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::commands::ClearCommand;
use incircle_protocol::{
    batch_word, clear_word, command_meshes, command_starts_batch, command_tag, command_word, Opcode, CLEAR_BATCH,
    CLEAR_TAG_SHIFT, FIRST_ROUND, MAX_CONTEXTS,
};
use incircle_testkit::SplitMix64;

named_ports!(ClearCommand, [reset, built, taken], [clearing, deal], clock);

const CLOCKS: usize = 8000;

#[test]
fn clear_command_is_granted_or_refused() {
    let mut random = SplitMix64::new(33);
    let mut block = Stepper::new("clear_command", ClearCommand::default(), 1);
    let (mut clears, mut contexts, mut is_batch, mut is_refused, mut tag) = (false, 0, false, None, 0);
    // The first vertex that is dealt follows a clock later.
    let mut dealt_from = 0;
    let mut kinds = [0; 4];
    let mut built = 1;
    for clock in 0..CLOCKS {
        let reset = clock == 0 || random.below(300) == 0;
        if reset {
            built = 1 + random.below(MAX_CONTEXTS.into()) as u32;
        }
        let wanted = [0, built, built + 1, random.below(256) as u32][random.below(4) as usize];
        let word = match random.below(5) {
            0 => command_word(Opcode::Insert) | wanted,
            1 => random.next_u64() as u32,
            // Outside a batch, the number of meshes does not count.
            2 => clear_word(wanted) | (random.below(1 << 16) as u32) << 8 & !CLEAR_BATCH,
            3 => batch_word(wanted) | (random.below(1 << 8) as u32) << CLEAR_TAG_SHIFT,
            _ => batch_word(wanted) | (random.below(1 << 16) as u32) << 8,
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
            block.expect("tag", tag);
        }
        if let Some(is_refused) = is_refused {
            block.expect("is_refused", u32::from(is_refused));
        }
        block.edge();
        dealt_from = if is_batch { 3 * u64::from(contexts) } else { FIRST_ROUND.into() };
        let asks = accepts && word >> 24 == Opcode::Clear as u32;
        let number = word & 0xff;
        let shares_contexts = command_starts_batch(word) && command_meshes(word) > 0;
        clears = asks && number <= built && !shares_contexts && !reset;
        if clears {
            contexts = if number == 0 { built } else { number };
            is_batch = command_starts_batch(word);
        }
        if accepts {
            is_refused = Some(asks && (number > built || shares_contexts));
        }
        if asks {
            tag = u32::from(command_tag(word));
            kinds[if shares_contexts {
                3
            } else if number > built {
                2
            } else {
                usize::from(number > 0)
            }] += 1;
        }
        if reset {
            (contexts, is_batch, dealt_from, tag) = (built, false, FIRST_ROUND.into(), 0);
        }
    }
    assert!(kinds.iter().all(|times| *times > 100), "{kinds:?}");
}
