//! Runs `ClearCommand` in Rust and in Verilog beside lists of what must happen: all three must agree in every clock.

use crate::rig::command_reference::check;
use crate::rig::stepper::bundles::Deal;
use crate::rig::stepper::{named_ports, Stepper};
use incircle_hdl::commands::ClearCommand;
use incircle_protocol::{
    clear_word, command_tag, command_word, Opcode, CLEAR_BATCH, CLEAR_MESHES_SHIFT, CLEAR_TAG_SHIFT, MAX_CONTEXTS,
};
use incircle_testkit::SplitMix64;

named_ports!(ClearCommand, [reset, built, taken], [clearing, deal], clock);

const CLOCKS: usize = 40_000;

/// The state that the block must have.
#[derive(Default)]
struct Reference {
    clears: bool,
    contexts: u32,
    jobs: u32,
    /// The first vertex that is dealt follows a clock later.
    dealt_from: u64,
    is_refused: Option<bool>,
    tag: u8,
    /// Contexts and jobs of a `Clear` that is being checked, and the number of clocks to go.
    checked: Option<(u32, u32, u32)>,
}

impl Reference {
    /// Passes an edge at which a word is taken, if there is one. Returns what becomes of a `Clear`, as a number.
    fn edge(&mut self, word: Option<u32>, built: u32) -> Option<usize> {
        self.dealt_from = 3 * u64::from(self.jobs);
        self.clears = false;
        match self.checked.take() {
            Some((contexts, jobs, 1)) if contexts.is_multiple_of(jobs) => {
                (self.contexts, self.jobs, self.clears) = (contexts, jobs, true);
                return Some(if jobs == 1 { 0 } else { 1 + usize::from(contexts > jobs) });
            }
            Some((_, _, 1)) => {
                self.is_refused = Some(true);
                return Some(3);
            }
            Some((contexts, jobs, clocks)) => self.checked = Some((contexts, jobs, clocks - 1)),
            None => {}
        }
        let word = word?;
        let (is_clear, asked) = (word >> 24 == Opcode::Clear as u32, word & 0xff);
        self.is_refused = Some(is_clear && asked > built);
        if is_clear {
            self.tag = command_tag(word);
        }
        if is_clear && asked <= built {
            self.checked = Some(check(if asked == 0 { built } else { asked }, word));
        }
        (is_clear && asked > built).then_some(4)
    }
}

#[test]
fn clear_command_is_granted_or_refused() {
    let mut random = SplitMix64::new(33);
    let mut block = Stepper::new("clear_command", ClearCommand::default(), 1);
    let mut reference = Reference::default();
    let (mut kinds, mut built) = ([0; 5], 1);
    for clock in 0..CLOCKS {
        let reset = clock == 0 || random.below(300) == 0;
        if reset {
            built = 1 + random.below(MAX_CONTEXTS.into()) as u32;
        }
        let wanted = [0, built, built + 1, random.below(256) as u32][random.below(4) as usize];
        let jobs = [0, 1, 2 + random.below(3) as u32, 1 + random.below(8) as u32, random.below(128) as u32];
        let jobs = jobs[random.below(5) as usize];
        let rest = jobs << CLEAR_MESHES_SHIFT | (random.below(1 << 8) as u32) << CLEAR_TAG_SHIFT;
        let word = match random.below(4) {
            0 => command_word(Opcode::Insert) | wanted,
            1 => random.next_u64() as u32,
            // Outside a batch, the number of jobs does not count.
            2 => clear_word(wanted) | rest,
            _ => clear_word(wanted) | CLEAR_BATCH | rest,
        };
        // The core takes no other command while one is at work.
        let accepts = reference.checked.is_none() && random.below(2) == 0;
        block.set("reset", reset);
        block.set("built", built);
        block.set("is_command", accepts);
        block.set("word", word);
        block.settle();
        if clock > 1 {
            block.expect("clears", reference.clears);
            block.expect("is_checking", reference.checked.is_some());
            block.expect("tag", u32::from(reference.tag));
            let Reference { contexts, jobs, dealt_from, .. } = reference;
            block.expect("deal", Deal { contexts: contexts.into(), jobs: jobs.into(), dealt_from }.bits());
        }
        if let Some(is_refused) = reference.is_refused {
            block.expect("is_refused", u32::from(is_refused));
        }
        block.edge();
        let fate = reference.edge(accepts.then_some(word), built);
        if reset {
            let Reference { is_refused, .. } = reference;
            reference = Reference { contexts: built, jobs: 1, dealt_from: 3, is_refused, ..Reference::default() };
        } else if let Some(fate) = fate {
            kinds[fate] += 1;
        }
    }
    assert!(kinds.iter().all(|times| *times > 100), "{kinds:?}");
}
