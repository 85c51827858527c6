//! Runs `Priorities` in Rust and in Verilog beside a list of teams: all three must agree in every clock.

use crate::rig::stepper::{named_ports, Cell, Stepper, Wave};
use incircle_hdl::engine::Priorities;
use incircle_protocol::LARGE;
use incircle_testkit::SplitMix64;

named_ports!(Priorities, [planned, early_context, outcome, passed], [holds_priority, takes_priority, may_retry], clock);

/// The context with the priority of a team, and the number of foreign locks that it has met.
type Holder = Option<(u64, u64)>;

/// The block beside the teams.
struct Rig {
    block: Stepper<Priorities>,
    contexts: u64,
    jobs: u64,
    holders: Vec<Holder>,
    /// The contexts of the last two clocks whose visits complete next.
    early: [u64; 2],
}

/// The visit whose consequences come in a clock, and the contexts that are asked about.
#[derive(Clone, Copy, Debug, Default)]
struct Events {
    early: u64,
    passed: u64,
    asks: bool,
    waits: bool,
    returns: bool,
}

impl Rig {
    /// The block with all teams planned.
    fn new(contexts: u64, jobs: u64) -> Self {
        let block = Stepper::new("priorities", Priorities::new(LARGE), 1);
        let mut rig = Self { block, contexts, jobs, holders: vec![], early: [0; 2] };
        rig.plan(contexts, jobs);
        rig
    }

    /// Goes round the contexts once, as the pointer does after a clear.
    fn plan(&mut self, contexts: u64, jobs: u64) {
        (self.contexts, self.jobs, self.holders) = (contexts, jobs, vec![None; jobs as usize]);
        for context in 0..contexts {
            for (port, value) in [("planned_context", context), ("planned_team", context % jobs)] {
                self.block.set(port, value);
            }
            for (port, value) in [("planned_valid", true), ("asks_for_priority", false), ("outcome_waits", false)] {
                self.block.set(port, value);
            }
            self.block.set("returns_priority", false);
            self.block.settle();
            self.block.edge();
        }
        self.block.set("planned_valid", false);
        // Two clocks, until the contexts of completed visits are those of this plan.
        for _ in 0..2 {
            self.clock(Events::default());
        }
    }

    /// The context of the visit whose consequences come now.
    fn context(&self) -> u64 {
        self.early[1]
    }

    fn team(&self, context: u64) -> usize {
        (context % self.jobs) as usize
    }

    fn clock(&mut self, events: Events) {
        let context = self.context();
        for (port, value) in [
            ("early_context", events.early),
            ("outcome_context", context),
            ("passed_context", events.passed),
            ("passed_team", events.passed % self.jobs),
        ] {
            self.block.set(port, value);
        }
        for (port, value) in
            [("asks_for_priority", events.asks), ("outcome_waits", events.waits), ("returns_priority", events.returns)]
        {
            self.block.set(port, value);
        }
        self.block.settle();
        let takes = events.asks && self.holders[self.team(context)].is_none();
        let holds = self.holders[self.team(events.early)].is_some_and(|(holder, _)| holder == events.early);
        let bars = |(holder, met): (u64, u64)| holder != events.passed && met >= 8;
        self.block.expect("holds_priority", holds);
        self.block.expect("takes_priority", takes);
        self.block.expect("may_retry", !self.holders[self.team(events.passed)].is_some_and(bars));
        self.block.edge();
        let team = self.team(context);
        let holder = &mut self.holders[team];
        match holder {
            None if events.asks => *holder = Some((context, 0)),
            Some((of, _)) if events.returns && *of == context => *holder = None,
            Some((_, met)) if events.waits => *met += 1,
            _ => {}
        }
        self.early = [events.early, self.early[0]];
    }
}

#[test]
fn each_team_has_a_priority_of_its_own() {
    let mut random = SplitMix64::new(71);
    let mut seen = [0; 5];
    let mut rig = Rig::new(24, 3);
    for (contexts, jobs) in [(24, 3), (24, 1), (16, 4), (15, 5), (1, 1), (24, 24), (16, 2), (4, 2)] {
        rig.plan(contexts, jobs);
        for _ in 0..6000 {
            let (context, [early, passed]) = (rig.context(), [(); 2].map(|()| random.below(contexts)));
            let holder = rig.holders[rig.team(context)];
            let holds = holder.is_some_and(|(of, _)| of == context);
            let what = random.below(12);
            let events = Events {
                early,
                passed,
                asks: !holds && what < 3,
                waits: holds && what < 8,
                returns: what == 11 || holds && what == 10,
            };
            let barred = rig.holders[rig.team(passed)].is_some_and(|(of, met)| of != passed && met >= 8);
            for (seen, happens) in seen.iter_mut().zip([
                events.asks && holder.is_none(),
                events.asks && holder.is_some(),
                events.returns && holds,
                events.returns && holder.is_some() && !holds,
                barred,
            ]) {
                *seen += usize::from(happens);
            }
            rig.clock(events);
        }
    }
    assert!(seen.iter().all(|seen| *seen > 100), "{seen:?}");
}

#[test]
fn priorities_show_the_wave_of_their_header() {
    let mut rig = Rig::new(4, 2);
    let mut wave = Wave::default();
    for (clock, early) in [0, 1, 0, 0, 2, 0, 0, 1, 0, 2, 0, 0, 0, 0].into_iter().enumerate() {
        let (asks, waits, returns) = (clock == 4, clock == 7, clock == 10);
        let holds = rig.holders[rig.team(early)].is_some_and(|(of, _)| of == early);
        let takes = asks && rig.holders[rig.team(rig.context())].is_none();
        wave.take(&[
            ("early_context", Cell::Number(early.into())),
            ("asks_for_priority", Cell::Bit(asks)),
            ("waits", Cell::Bit(waits)),
            ("returns_priority", Cell::Bit(returns)),
            ("takes_priority", Cell::Bit(takes)),
            ("holds_priority", Cell::Bit(holds)),
        ]);
        rig.clock(Events { early, passed: 0, asks, waits, returns });
    }
    wave.assert_drawn_in("priorities");
}
