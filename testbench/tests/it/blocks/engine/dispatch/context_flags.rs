//! Runs `ContextFlags` in Rust and in Verilog beside lists of contexts: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::engine::ContextFlags;
use incircle_protocol::MAX_CONTEXTS;
use incircle_testkit::SplitMix64;

named_ports!(
    ContextFlags,
    [reset, clears, built_contexts, outcome, start, released, committed, solo_ends],
    [contexts, takes_priority],
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
    asks_for_priority: bool,
    waits: bool,
    returns_priority: bool,
    overflows: bool,
    starter: Option<u64>,
    released: Option<u64>,
    committed: Option<u64>,
    solo_ends: bool,
}

/// State of one context.
#[derive(Clone, Copy, Debug)]
struct Flags {
    asleep: bool,
    retrying: bool,
    busy: bool,
    began: bool,
    hinted: bool,
}

/// All contexts, the priority, and the context that inserts or waits to insert solo.
#[derive(Clone, Debug)]
struct FlagsReference {
    contexts: Vec<Flags>,
    priority_context: Option<u64>,
    /// Number of foreign locks that the context with the priority has met.
    met: u64,
    solo: Option<u64>,
    /// All contexts rested a clock ago, and none has started since.
    rested: bool,
}

impl FlagsReference {
    fn new(contexts: u64) -> Self {
        let rests = Flags { asleep: true, retrying: false, busy: false, began: false, hinted: false };
        Self { contexts: vec![rests; contexts as usize], priority_context: None, met: 0, solo: None, rested: false }
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
        match self.priority_context {
            None if events.asks_for_priority => (self.priority_context, self.met) = (Some(events.context), 0),
            Some(priority_context) if events.returns_priority && priority_context == events.context => {
                self.priority_context = None
            }
            _ => {}
        }
        self.met += u64::from(events.waits);
        if events.overflows {
            self.solo = self.solo.or(Some(events.context));
        }
        if events.solo_ends {
            if let Some(context) = self.solo.take() {
                self.at(context).retrying = false;
                self.priority_context = self.priority_context.filter(|priority_context| *priority_context != context);
            }
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
        ("asks_for_priority", events.asks_for_priority),
        ("waits", events.waits),
        ("returns_priority", events.returns_priority),
        ("overflows", events.overflows),
        ("start_valid", events.starter.is_some()),
        ("released_valid", events.released.is_some()),
        ("committed_valid", events.committed.is_some()),
        ("solo_ends", events.solo_ends),
    ] {
        block.set(port, value);
    }
    // A context to which nothing happens is named all the same.
    let other = events.context ^ 1;
    block.set("outcome_context", events.context);
    block.set("start_context", events.starter.unwrap_or(other));
    block.set("released_context", events.released.unwrap_or(other));
    block.set("committed_job_context", events.committed.unwrap_or(other));
    block.settle();
    if block.clocks() > 0 {
        block.expect("asleep", reference.set(|flags| flags.asleep));
        block.expect("retrying", reference.set(|flags| flags.retrying));
        block.expect("busy", reference.set(|flags| flags.busy));
        block.expect("began", reference.set(|flags| flags.began));
        block.expect("hinted", reference.set(|flags| flags.hinted));
        block.expect("priority_is_held", reference.priority_context.is_some());
        block.expect("is_urgent", reference.priority_context.is_some() && reference.met >= 8);
        block.expect("solo_valid", reference.solo.is_some());
        block.expect("all_rest", reference.rested);
        block.expect("takes_priority", events.asks_for_priority && reference.priority_context.is_none());
        reference
            .priority_context
            .into_iter()
            .for_each(|priority_context| block.expect("priority_context", priority_context));
        reference.solo.into_iter().for_each(|solo| block.expect("solo_context", solo));
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
    let (will_retry, hands_over, asks_for_priority, overflows) = (flip(2), flip(2), flip(4), flip(12));
    let (ends_solo, gives_back, meets) = (flip(4), flip(8), !flip(8));
    let solo_works = reference.solo.is_some() && reference.rests();
    let mut events =
        Events { reset, clears, context: random.below(reference.contexts.len() as u64), ..Events::default() };
    // No visit of another context completes during a solo insertion.
    if solo_works {
        events.solo_ends = ends_solo;
    } else if let Some(context) = any(reference, random, |flags| !flags.asleep) {
        let is_free = !reference.contexts[context as usize].busy;
        // A context that meets a foreign lock with the priority waits; it neither asks for the priority nor ends.
        let waits = reference.priority_context == Some(context) && meets;
        let sleeps = over && !waits;
        let asks_for_priority = asks_for_priority && !waits;
        events = Events {
            context,
            sleeps,
            will_retry: sleeps && will_retry,
            hands_over: sleeps && hands_over && is_free,
            asks_for_priority,
            waits,
            returns_priority: sleeps && !asks_for_priority && gives_back,
            overflows: overflows && !waits,
            ..events
        };
    }
    if reference.solo.is_none() {
        events.starter = any(reference, random, |flags| flags.asleep);
    }
    events.released = any(reference, random, |flags| flags.busy);
    events.committed = any(reference, random, |flags| flags.busy);
    events
}

#[test]
fn context_flags_are_those_of_lists_of_contexts() {
    let mut random = SplitMix64::new(70);
    let mut seen = [0; 6];
    for contexts in [1, 2, 3, 4, 16, 23, u64::from(MAX_CONTEXTS)] {
        let mut block = Stepper::new("context_flags", ContextFlags::default(), contexts as u32);
        let mut reference = FlagsReference::new(contexts);
        for clock in 0..12_000 {
            let events = Events { reset: clock == 0, ..events(&reference, &mut random) };
            let waits = reference.priority_context.is_some();
            for (seen, happens) in seen.iter_mut().zip([
                events.asks_for_priority && waits,
                events.returns_priority && reference.priority_context == Some(events.context),
                events.solo_ends && reference.priority_context == reference.solo,
                events.overflows && reference.solo.is_some(),
                events.waits && reference.met > 8,
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
            3 => Events { sleeps: true, will_retry: true, asks_for_priority: true, ..base },
            7 => Events { sleeps: true, hands_over: true, returns_priority: true, ..base },
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
            ("asks_for_priority", Cell::Bit(events.asks_for_priority)),
            ("returns_priority", Cell::Bit(events.returns_priority)),
            ("hands_over", Cell::Bit(events.hands_over)),
            ("commit_ends", Cell::Bit(events.committed.is_some())),
            ("released", Cell::Bit(events.released.is_some())),
            ("asleep", set(|flags| flags.asleep)),
            ("retrying", set(|flags| flags.retrying)),
            ("busy", set(|flags| flags.busy)),
            ("began", set(|flags| flags.began)),
            ("hinted", set(|flags| flags.hinted)),
            ("priority_is_held", Cell::Bit(reference.priority_context.is_some())),
            ("all_rest", Cell::Bit(reference.rested)),
        ]);
        reference.edge(&events);
    }
    wave.assert_drawn_in("context_flags");
}
