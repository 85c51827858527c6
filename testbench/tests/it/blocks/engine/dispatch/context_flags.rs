//! Runs `ContextFlags` in Rust and in Verilog beside lists of contexts: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::engine::ContextFlags;
use incircle_protocol::MAX_CONTEXTS;
use incircle_testkit::SplitMix64;

named_ports!(
    ContextFlags,
    [reset, clears, built_contexts, outcome, start, released, committed, solo_ends, solo_context],
    [contexts],
    clock
);

/// Events of a clock; contexts are numbers.
#[derive(Clone, Copy, Debug, Default)]
struct Events {
    reset: bool,
    clears: bool,
    /// The context whose visit completes; the fields below say what that leads to.
    context: u64,
    sleeps: bool,
    will_retry: bool,
    hands_over: bool,
    overflows: bool,
    starter: Option<u64>,
    released: Option<u64>,
    committed: Option<u64>,
    /// The context whose solo insertion ends.
    solo: Option<u64>,
}

/// State of one context.
#[derive(Clone, Copy, Debug)]
struct Flags {
    asleep: bool,
    retrying: bool,
    busy: bool,
    began: bool,
    hinted: bool,
    /// The context inserts solo, or waits for that.
    solo: bool,
}

/// All contexts.
#[derive(Clone, Debug)]
struct FlagsReference {
    contexts: Vec<Flags>,
    /// All contexts rested a clock ago, and none has started since.
    rested: bool,
}

impl FlagsReference {
    fn new(contexts: u64) -> Self {
        let rests = Flags { asleep: true, retrying: false, busy: false, began: false, hinted: false, solo: false };
        Self { contexts: vec![rests; contexts as usize], rested: false }
    }

    fn set(&self, flag: impl Fn(&Flags) -> bool) -> u64 {
        (0..).zip(&self.contexts).fold(0, |set, (place, flags)| set | u64::from(flag(flags)) << place)
    }

    fn rests(&self) -> bool {
        self.contexts.iter().all(|flags| flags.asleep && !flags.busy)
    }

    fn at(&mut self, context: u64) -> &mut Flags {
        &mut self.contexts[context as usize]
    }

    fn edge(&mut self, events: &Events) {
        self.rested = self.rests() && events.starter.is_none();
        if events.reset || events.clears {
            *self = Self::new(self.contexts.len() as u64);
            return;
        }
        let context = self.at(events.context);
        context.asleep |= events.sleeps;
        context.retrying |= events.will_retry;
        context.busy |= events.hands_over;
        context.solo |= events.overflows;
        if let Some(context) = events.starter {
            let starter = self.at(context);
            (starter.asleep, starter.retrying, starter.began) = (false, false, true);
        }
        if let Some(context) = events.released {
            self.at(context).busy = false;
        }
        if let Some(context) = events.committed {
            self.at(context).hinted = true;
        }
        if let Some(context) = events.solo {
            let ended = self.at(context);
            (ended.retrying, ended.solo) = (false, false);
        }
    }
}

/// Runs one clock of the block and the lists; nothing is compared in the first one.
fn flags_clock(block: &mut Stepper<ContextFlags>, reference: &mut FlagsReference, events: &Events) {
    block.set("built_contexts", (1u64 << reference.contexts.len()) - 1);
    for (port, value) in [
        ("reset", events.reset),
        ("clears", events.clears),
        ("sleeps", events.sleeps),
        ("will_retry", events.will_retry),
        ("hands_over", events.hands_over),
        ("overflows", events.overflows),
        ("start_valid", events.starter.is_some()),
        ("released_valid", events.released.is_some()),
        ("committed_valid", events.committed.is_some()),
        ("solo_ends", events.solo.is_some()),
    ] {
        block.set(port, value);
    }
    // A context to which nothing happens is named all the same.
    let other = events.context ^ 1;
    block.set("outcome_context", events.context);
    block.set("start_context", events.starter.unwrap_or(other));
    block.set("released_context", events.released.unwrap_or(other));
    block.set("committed_job_context", events.committed.unwrap_or(other));
    block.set("solo_context", events.solo.unwrap_or(other));
    block.settle();
    if block.clocks() > 0 {
        block.expect("asleep", reference.set(|flags| flags.asleep));
        block.expect("retrying", reference.set(|flags| flags.retrying));
        block.expect("busy", reference.set(|flags| flags.busy));
        block.expect("began", reference.set(|flags| flags.began));
        block.expect("hinted", reference.set(|flags| flags.hinted));
        let solo = reference.set(|flags| flags.solo);
        block.expect("solo", solo);
        block.expect("solo_valid", solo != 0);
        block.expect("all_rest", reference.rested);
    }
    block.edge();
    reference.edge(events);
}

/// Returns a random context if the condition holds for it.
fn any(reference: &FlagsReference, random: &mut SplitMix64, holds: impl Fn(&Flags) -> bool) -> Option<u64> {
    let context = random.below(reference.contexts.len() as u64);
    holds(&reference.contexts[context as usize]).then_some(context)
}

/// Events that can come together: many at once, for the same context and for others.
fn events(reference: &FlagsReference, random: &mut SplitMix64) -> Events {
    let mut flip = |times: u64| random.below(times) == 0;
    let (reset, clears, over) = (flip(900), flip(900), flip(2));
    let (will_retry, hands_over, overflows, ends_solo) = (flip(2), flip(2), flip(12), flip(4));
    let solo_is_asked = reference.set(|flags| flags.solo) != 0;
    let mut events =
        Events { reset, clears, context: random.below(reference.contexts.len() as u64), ..Events::default() };
    // No visit of another context completes during a solo insertion.
    if solo_is_asked && reference.rests() {
        events.solo = any(reference, random, |flags| flags.solo && ends_solo);
    } else if let Some(context) = any(reference, random, |flags| !flags.asleep) {
        let is_free = !reference.contexts[context as usize].busy;
        events = Events {
            context,
            sleeps: over,
            will_retry: over && will_retry,
            hands_over: over && hands_over && is_free,
            overflows,
            ..events
        };
    }
    if !solo_is_asked {
        events.starter = any(reference, random, |flags| flags.asleep);
    }
    events.released = any(reference, random, |flags| flags.busy);
    events.committed = any(reference, random, |flags| flags.busy);
    events
}

#[test]
fn context_flags_are_those_of_lists_of_contexts() {
    let mut random = SplitMix64::new(70);
    let mut seen = [0; 3];
    for contexts in [1, 2, 3, 4, 16, 23, u64::from(MAX_CONTEXTS)] {
        let mut block = Stepper::new("context_flags", ContextFlags::default(), contexts as u32);
        let mut reference = FlagsReference::new(contexts);
        for clock in 0..12_000 {
            let events = Events { reset: clock == 0, ..events(&reference, &mut random) };
            let asking = reference.set(|flags| flags.solo).count_ones();
            for (seen, happens) in seen.iter_mut().zip([
                events.solo.is_some() && asking > 1,
                events.overflows && asking > 0,
                events.sleeps && events.starter.is_some() && events.released.is_some() && events.committed.is_some(),
            ]) {
                *seen += usize::from(happens);
            }
            flags_clock(&mut block, &mut reference, &events);
        }
    }
    assert!(seen.iter().all(|seen| *seen > 20), "{seen:?}");
}

#[test]
fn context_flags_show_the_wave_of_their_header() {
    let mut block = Stepper::new("context_flags", ContextFlags::default(), 1);
    let mut reference = FlagsReference::new(2);
    flags_clock(&mut block, &mut reference, &Events { reset: true, ..Events::default() });
    let context = 1;
    let base = Events { context, ..Events::default() };
    let mut wave = Wave::default();
    for clock in 0..14 {
        let events = match clock {
            1 | 5 => Events { starter: Some(context), ..base },
            3 => Events { sleeps: true, will_retry: true, ..base },
            7 => Events { sleeps: true, hands_over: true, ..base },
            9 => Events { committed: Some(context), ..base },
            11 => Events { released: Some(context), ..base },
            _ => base,
        };
        flags_clock(&mut block, &mut reference.clone(), &events);
        let set = |flag: fn(&Flags) -> bool| Cell::Number(reference.set(flag).into());
        wave.take(&[
            ("starts", Cell::Bit(events.starter.is_some())),
            ("sleeps", Cell::Bit(events.sleeps)),
            ("will_retry", Cell::Bit(events.will_retry)),
            ("hands_over", Cell::Bit(events.hands_over)),
            ("commit_ends", Cell::Bit(events.committed.is_some())),
            ("released", Cell::Bit(events.released.is_some())),
            ("asleep", set(|flags| flags.asleep)),
            ("retrying", set(|flags| flags.retrying)),
            ("busy", set(|flags| flags.busy)),
            ("began", set(|flags| flags.began)),
            ("hinted", set(|flags| flags.hinted)),
            ("all_rest", Cell::Bit(reference.rested)),
        ]);
        reference.edge(&events);
    }
    wave.assert_drawn_in("context_flags");
}
