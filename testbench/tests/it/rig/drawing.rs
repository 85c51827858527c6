//! Draws the wave of a block under given inputs.

use std::collections::BTreeMap;
use std::ops::Range;

use crate::rig::block_ports::NamedPorts;
use crate::rig::stepper::{Cell, Stepper, Wave};
use incircle_testbench::blocks;
use verilated::Direction;

/// Clocks in which a lane shows a value.
#[derive(Clone, Copy)]
pub enum When {
    Always,
    /// Clocks in which bit 0 of this port is set.
    If(&'static str),
    /// These clocks and no others.
    At(&'static [usize]),
}

/// A line of a wave: its name, its port, lowest bit and width, and its clocks. A single bit is drawn as a level.
pub type Lane = (&'static str, &'static str, u32, u32, When);

/// Values of inputs in some clocks: clock, port, value. In all other clocks an input is zero.
pub type Stimuli = [(usize, &'static str, u128)];

/// Clocks with `reset` and nothing else before a wave. They are as many as a visit takes through the lock store, which
/// does not forget its visits at reset.
const CLOCKS_BEFORE: usize = 4;

/// Runs `clocks` clocks after [`CLOCKS_BEFORE`], and draws them.
pub fn draw<U: NamedPorts>(name: &'static str, rust: U, stimuli: &Stimuli, clocks: usize, lanes: &[Lane]) -> Wave {
    draw_range(name, rust, stimuli, 0..clocks, lanes)
}

/// Runs all clocks up to the end of `drawn` after [`CLOCKS_BEFORE`], and draws those in `drawn`.
pub fn draw_range<U: NamedPorts>(
    name: &'static str,
    rust: U,
    stimuli: &Stimuli,
    drawn: Range<usize>,
    lanes: &[Lane],
) -> Wave {
    let ports = blocks::model(name).description().ports();
    let inputs: Vec<&'static str> =
        ports.filter(|port| port.direction == Direction::Input && port.name != "clock").map(|port| port.name).collect();
    let mut stepper = Stepper::new(name, rust, 1);
    let mut wave = Wave::default();
    for input in &inputs {
        stepper.set(input, u128::from(*input == "reset"));
    }
    for _ in 0..CLOCKS_BEFORE {
        stepper.settle();
        stepper.edge();
    }
    for clock in 0..drawn.end {
        let mut driven: BTreeMap<_, _> = inputs.iter().map(|input| (*input, 0)).collect();
        driven.extend(stimuli.iter().map(|(_, input, _)| (*input, 0)));
        let now = stimuli.iter().filter(|(at, ..)| *at == clock);
        driven.extend(now.map(|(_, input, value)| (*input, *value)));
        for (input, value) in &driven {
            stepper.set(input, *value);
        }
        stepper.settle();
        // An output may mean nothing before the drawing begins.
        if !drawn.contains(&clock) {
            stepper.edge();
            continue;
        }
        let value = |port: &str, low: u32, width: u32| {
            let mask = ((1 << width) - 1) << low;
            let driven = driven.get(port).map(|value| value & mask);
            driven.unwrap_or_else(|| stepper.get_masked(port, mask)) >> low
        };
        let cells: Vec<_> = lanes
            .iter()
            .map(|(name, port, low, width, when)| {
                let shows = match when {
                    When::Always => true,
                    When::If(flag) => value(flag, 0, 1) == 1,
                    When::At(clocks) => clocks.contains(&clock),
                };
                let cell = match (shows, width) {
                    (false, _) => Cell::Open,
                    (true, 1) => Cell::Bit(value(port, *low, 1) == 1),
                    (true, _) => Cell::Number(value(port, *low, *width)),
                };
                (*name, cell)
            })
            .collect();
        wave.take(&cells);
        stepper.edge();
    }
    wave
}
