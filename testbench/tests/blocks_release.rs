//! The release of locks: Rust, Verilog and a list of what is still to be cleared agree clock by clock.

mod block_ports;
mod stepper;

use std::collections::VecDeque;

use incircle_cli::generate::SplitMix64;
use incircle_hdl::engine::Release;
use incircle_protocol::{Config, MAX_RING, TINY};
use stepper::bundles::{turned, Visit};
use stepper::{named_ports, Cell, Stepper, Wave};

named_ports!(
    Release,
    [reset, last_id, takes_locks, done, token, turned, starts],
    [is_busy, sweeps, clear_id, clear_enable],
    clock
);

/// The release as a list of what it has to do.
#[derive(Default)]
struct ReleaseReference {
    to_sweep: VecDeque<u64>,
    to_free: VecDeque<u64>,
    log: Vec<u64>,
    shown: Option<u64>,
}

/// Inputs of a clock.
struct Visiting {
    takes_locks: bool,
    done: bool,
    locks: bool,
    was_set: bool,
    u: u64,
    starts: bool,
    reset: bool,
}

impl ReleaseReference {
    fn edge(&mut self, inputs: &Visiting, last_id: u64) {
        self.shown = self.to_sweep.pop_front().or_else(|| self.to_free.pop_front());
        if inputs.takes_locks && inputs.done && inputs.locks && !inputs.was_set {
            self.log.push(inputs.u);
        }
        if inputs.starts && self.to_free.is_empty() {
            self.to_free = self.log.drain(..).collect();
        }
        if inputs.reset {
            *self = Self { to_sweep: (0..=last_id).collect(), ..Self::default() };
        }
    }
}

/// One clock of both.
fn release_clock(block: &mut Stepper<Release>, reference: &mut ReleaseReference, inputs: &Visiting, last_id: u64) {
    let visit = Visit { locks: inputs.locks, u: inputs.u, f: inputs.u ^ 0x7fff, ..Visit::default() };
    block.set("last_id", last_id);
    block.set("reset", inputs.reset);
    block.set("takes_locks", inputs.takes_locks);
    block.set("done", inputs.done);
    block.set("token", visit.token());
    block.set("turned", turned([inputs.u; 3], [0x7fff; 3], 2, inputs.was_set, [true; 3]));
    block.set("starts", inputs.starts);
    block.settle();
    if block.clocks() > 0 {
        block.expect("sweeps", !reference.to_sweep.is_empty());
        block.expect("is_busy", !reference.to_free.is_empty());
        block.expect("clear_enable", reference.shown.is_some());
        if let Some(id) = reference.shown {
            block.expect("clear_id", id);
        }
    }
    block.edge();
    reference.edge(inputs, last_id);
}

fn release(name: &'static str, config: Config, last_id: u64) {
    let mut random = SplitMix64::new(2);
    let mut block = Stepper::new(name, Release::new(config), 1);
    let mut reference = ReleaseReference::default();
    let most = 2 * config.ring as usize - 2;
    let (mut resets, mut fullest) = (0, 0);
    for clock in 0..8000 {
        let works = !reference.to_sweep.is_empty() || !reference.to_free.is_empty();
        let logged = reference.log.len();
        // A burst of visits, then the release: now and then of a full log.
        let is_full = logged == most;
        let starts = !works && logged > 0 && (is_full || random.below(150) == 0);
        let reset = clock == 0 || random.below(700) == 0;
        let inputs = Visiting {
            takes_locks: !works && !is_full && !starts && random.below(8) != 0,
            done: random.below(4) != 0,
            locks: random.below(8) != 0,
            was_set: random.below(4) == 0,
            u: random.below(1 << 15),
            starts,
            reset,
        };
        resets += usize::from(reset);
        fullest = fullest.max(logged);
        release_clock(&mut block, &mut reference, &inputs, last_id);
    }
    assert!(resets > 3 && fullest == most, "{resets} {fullest}");
}

#[test]
fn release_frees_what_was_locked() {
    release("release_6", TINY, 15);
}

#[test]
fn release_holds_the_locks_of_the_longest_list() {
    let config = Config { ring: MAX_RING, ..TINY };
    release("release_64", config, 300);
}

#[test]
fn release_shows_the_wave_of_its_header() {
    let mut block = Stepper::new("release_6", Release::new(TINY), 1);
    let mut reference = ReleaseReference::default();
    let mut wave = Wave::default();
    for clock in 0..15 {
        let inputs = Visiting {
            takes_locks: true,
            done: (7..9).contains(&clock),
            locks: true,
            was_set: false,
            u: clock + 20,
            starts: clock == 10,
            reset: clock == 0,
        };
        let (frees, sweeps) = (!reference.to_free.is_empty(), !reference.to_sweep.is_empty());
        let shown = reference.shown;
        release_clock(&mut block, &mut reference, &inputs, 3);
        wave.take(&[
            ("reset", Cell::Bit(inputs.reset)),
            ("sweeps", Cell::Bit(sweeps)),
            ("done", Cell::Bit(inputs.done)),
            ("token.u", if inputs.done { Cell::Number(inputs.u.into()) } else { Cell::Open }),
            ("starts", Cell::Bit(inputs.starts)),
            ("is_busy", Cell::Bit(frees)),
            ("clear_enable", Cell::Bit(shown.is_some())),
            ("clear_id", shown.map_or(Cell::Open, |id| Cell::Number(id.into()))),
        ]);
    }
    wave.assert_drawn_in(include_str!("../../hdl/src/engine/release.rs"));
}
