//! Finds what crosses between the clocks of a design: every register that depends on another clock,
//! in the netlist that yosys makes.
//!
//! A crossing is sound in two cases. One is a bit of a register that goes, with nothing in between, into the first cell
//! of a [`Synchroniser`](incircle_hdl::leaf::Synchroniser). The other is a word of a
//! [`DualClockMemory`](incircle_hdl::leaf::DualClockMemory) on the way into that memory's read register, with an
//! address of the reader's clock. Anything else is a fault.

mod netlist;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use incircle_hdl::leaf::Synchroniser;

use crate::gate::{self, GateError};
use netlist::{Driver, Netlist};

/// The kind of a crossing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Way {
    /// A register drives the first cell of a synchroniser.
    Synchroniser,
    /// A memory is written by one clock and read by another.
    Memory,
    /// Any other crossing, which is a fault.
    Fault,
}

/// A register that depends on another clock.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Crossing {
    /// The clock that the value comes from.
    pub from: String,
    /// The clock of the register.
    pub to: String,
    /// The kind of the crossing.
    pub way: Way,
    /// Name of the register, or of the port of the design.
    pub receiver: String,
    /// Number of bits that cross.
    pub bits: usize,
}

impl fmt::Display for Crossing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let way = match self.way {
            Way::Synchroniser => "synchroniser",
            Way::Memory => "memory",
            Way::Fault => "NEITHER SYNCHRONISER NOR MEMORY",
        };
        write!(f, "{} -> {}: {}, {} bits, {way}", self.from, self.to, self.receiver, self.bits)
    }
}

/// Returns every crossing of the design `top`, sorted. `clock_of_port` names the clock to which
/// each port of the design belongs.
///
/// # Errors
/// Yosys is missing or refuses the text, or its netlist cannot be read.
pub fn crossings(
    verilog: &str,
    top: &str,
    clock_of_port: impl Fn(&str) -> &'static str,
) -> Result<Vec<Crossing>, GateError> {
    let json = gate::netlist(verilog, top)?;
    let netlist =
        Netlist::read(&json).map_err(|reason| GateError::Report { tool: "yosys", top: top.to_string(), reason })?;
    let mut found: BTreeMap<(String, String, Way, String), usize> = BTreeMap::new();
    let mut search = Search { netlist: &netlist, clock_of_port: &clock_of_port, cones: BTreeMap::new() };
    for receiver in netlist.receivers(&clock_of_port) {
        let sources = search.sources(receiver.bit);
        for clock in sources.keys().filter(|clock| **clock != receiver.clock) {
            let way = search.way(&receiver.name, receiver.bit, &sources, clock);
            *found.entry((clock.clone(), receiver.clock.clone(), way, receiver.name.clone())).or_default() += 1;
        }
    }
    let crossing = |((from, to, way, receiver), bits)| Crossing { from, to, way, receiver, bits };
    Ok(found.into_iter().map(crossing).collect())
}

/// The clock to which a port of the stream link, or of the top around it, belongs. The ports towards the core, or
/// towards the engines of a chip, have the clock of the core.
pub fn stream_port_clock(port: &str) -> &'static str {
    let is_of_core = ["core", "command", "response", "write", "device"].iter().any(|prefix| port.starts_with(prefix));
    if is_of_core {
        "core_clock"
    } else {
        "bus_clock"
    }
}

/// Kinds of sources that a bit has in one clock: registers or ports, and words of a memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Seen {
    registers: bool,
    memories: bool,
}

/// The clocks on which a bit depends, each with the kinds of its sources.
type Sources = BTreeMap<String, Seen>;

/// The search through a netlist, with the sources of every bit seen so far in `cones`.
struct Search<'a, F> {
    netlist: &'a Netlist,
    clock_of_port: &'a F,
    cones: BTreeMap<usize, Sources>,
}

impl<F: Fn(&str) -> &'static str> Search<'_, F> {
    /// The clocks on which a bit depends through logic, without a register in between.
    fn sources(&mut self, bit: usize) -> Sources {
        if let Some(known) = self.cones.get(&bit) {
            return known.clone();
        }
        let mut all = Sources::new();
        match self.netlist.driver(bit) {
            None => {}
            Some(Driver::Port(name)) => all.entry((self.clock_of_port)(name).to_string()).or_default().registers = true,
            Some(Driver::Register(clock)) => all.entry(clock.clone()).or_default().registers = true,
            Some(Driver::Memory { clocks, address }) => {
                for clock in clocks {
                    all.entry(clock.clone()).or_default().memories = true;
                }
                self.join(&mut all, address);
            }
            Some(Driver::Logic(inputs)) => {
                // An empty entry first, so that a loop that yosys may have left ends the search.
                self.cones.insert(bit, Sources::new());
                self.join(&mut all, inputs);
            }
        }
        self.cones.insert(bit, all.clone());
        all
    }

    fn join(&mut self, all: &mut Sources, bits: &BTreeSet<usize>) {
        for bit in bits {
            for (clock, seen) in self.sources(*bit) {
                let entry = all.entry(clock).or_default();
                entry.registers |= seen.registers;
                entry.memories |= seen.memories;
            }
        }
    }

    fn way(&self, receiver: &str, bit: usize, sources: &Sources, clock: &str) -> Way {
        let last = receiver.rsplit('.').next().unwrap_or(receiver);
        let driver = self.netlist.driver(bit);
        if matches!(driver, Some(Driver::Register(from)) if from == clock) && last == Synchroniser::<bool>::FIRST_CELL {
            return Way::Synchroniser;
        }
        let only_words = sources.get(clock).is_some_and(|seen| seen.memories && !seen.registers);
        if receiver.ends_with(".memory.word") && only_words {
            return Way::Memory;
        }
        Way::Fault
    }
}
