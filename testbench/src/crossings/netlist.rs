//! The netlist that yosys writes as JSON, with the driver of each bit.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::Value;

/// The driver of a bit.
#[derive(Clone, Debug)]
pub(super) enum Driver {
    /// A port of the design, by its name.
    Port(String),
    /// A register, by its clock.
    Register(String),
    /// A memory: the clocks that write it, and the bits of its read addresses.
    Memory { clocks: BTreeSet<String>, address: BTreeSet<usize> },
    /// Logic, by the bits of its inputs.
    Logic(BTreeSet<usize>),
}

/// A bit that a register, the write port of a memory, or a port of the design takes.
pub(super) struct Receiver {
    pub name: String,
    pub clock: String,
    pub bit: usize,
}

/// A flat design, with all its instances resolved.
#[derive(Default)]
pub(super) struct Netlist {
    drivers: BTreeMap<usize, Driver>,
    registers: Vec<Receiver>,
    outputs: Vec<(String, usize)>,
}

/// Bits of a connection; constants have no number.
fn bits(value: &Value) -> Vec<Option<usize>> {
    let bit = |bit: &Value| bit.as_u64().and_then(|bit| usize::try_from(bit).ok());
    value.as_array().map(|all| all.iter().map(bit).collect()).unwrap_or_default()
}

fn known(value: &Value) -> BTreeSet<usize> {
    bits(value).into_iter().flatten().collect()
}

impl Netlist {
    pub(super) fn read(json: &str) -> Result<Self, String> {
        let all: Value = serde_json::from_str(json).map_err(|error| error.to_string())?;
        let modules = all["modules"].as_object().ok_or("it has no modules")?;
        let is_top = |module: &&Value| !module["attributes"]["top"].is_null();
        let module = modules.values().find(is_top).ok_or("it has no top module")?;
        let names = names(module);
        let mut netlist = Self::default();
        for (name, port) in module["ports"].as_object().ok_or("it has no ports")? {
            for bit in known(&port["bits"]) {
                match port["direction"].as_str() {
                    Some("input") => {
                        netlist.drivers.insert(bit, Driver::Port(name.clone()));
                    }
                    _ => netlist.outputs.push((name.clone(), bit)),
                }
            }
        }
        for (name, cell) in module["cells"].as_object().ok_or("it has no cells")? {
            netlist.add(name, cell, &names)?;
        }
        Ok(netlist)
    }

    fn add(&mut self, name: &str, cell: &Value, names: &BTreeMap<usize, String>) -> Result<(), String> {
        let kind = cell["type"].as_str().ok_or("a cell has no type")?;
        let connections = &cell["connections"];
        let clock = |bit: Option<usize>| {
            bit.and_then(|bit| names.get(&bit).cloned()).ok_or(format!("{name} has a clock without a name"))
        };
        if connections.get("CLK").is_some() && connections.get("Q").is_some() {
            let clock = clock(bits(&connections["CLK"]).first().copied().flatten())?;
            let inputs = bits(&connections["D"]);
            // Enable and reset of a register reach all its bits.
            let others: BTreeSet<usize> = ["EN", "SRST"].iter().flat_map(|port| known(&connections[*port])).collect();
            for (output, input) in bits(&connections["Q"]).into_iter().zip(inputs) {
                let Some(output) = output else { continue };
                self.drivers.insert(output, Driver::Register(clock.clone()));
                let name = names.get(&output).cloned().unwrap_or_else(|| name.to_string());
                for bit in input.into_iter().chain(others.iter().copied()) {
                    self.registers.push(Receiver { name: name.clone(), clock: clock.clone(), bit });
                }
            }
        } else if kind.starts_with("$mem") {
            self.add_memory(name, connections, clock)?;
        } else if connections.get("CLK").is_some() {
            return Err(format!("{name} is a {kind}, which is not known here"));
        } else {
            self.add_logic(cell);
        }
        Ok(())
    }

    fn add_memory(
        &mut self,
        name: &str,
        connections: &Value,
        clock: impl Fn(Option<usize>) -> Result<String, String>,
    ) -> Result<(), String> {
        let writers = bits(&connections["WR_CLK"]).into_iter().map(clock).collect::<Result<Vec<_>, _>>()?;
        for port in ["WR_ADDR", "WR_DATA", "WR_EN"] {
            let inputs = bits(&connections[port]);
            let width = inputs.len() / writers.len().max(1);
            for (place, bit) in inputs.into_iter().enumerate() {
                if let (Some(bit), Some(clock)) = (bit, writers.get(place / width.max(1))) {
                    self.registers.push(Receiver { name: format!("{name}.{port}"), clock: clock.clone(), bit });
                }
            }
        }
        // The read data of every port counts as dependent on all read addresses: too much rather than too little.
        let address = known(&connections["RD_ADDR"]);
        for bit in known(&connections["RD_DATA"]) {
            let clocks = writers.iter().cloned().collect();
            self.drivers.insert(bit, Driver::Memory { clocks, address: address.clone() });
        }
        Ok(())
    }

    fn add_logic(&mut self, cell: &Value) {
        let Some(connections) = cell["connections"].as_object() else { return };
        let is = |port: &str, direction: &str| cell["port_directions"][port].as_str() == Some(direction);
        let inputs: BTreeSet<usize> =
            connections.iter().filter(|(port, _)| is(port, "input")).flat_map(|(_, bits)| known(bits)).collect();
        for (_, outputs) in connections.iter().filter(|(port, _)| is(port, "output")) {
            for output in known(outputs) {
                self.drivers.insert(output, Driver::Logic(inputs.clone()));
            }
        }
    }

    pub(super) fn driver(&self, bit: usize) -> Option<&Driver> {
        self.drivers.get(&bit)
    }

    /// All bits that are taken at a clock edge, and the outputs of the design.
    pub(super) fn receivers(&self, clock_of_port: &impl Fn(&str) -> &'static str) -> Vec<Receiver> {
        let of = |receiver: &Receiver| Receiver {
            name: receiver.name.clone(),
            clock: receiver.clock.clone(),
            bit: receiver.bit,
        };
        let output = |(name, bit): &(String, usize)| Receiver {
            name: name.clone(),
            clock: clock_of_port(name).to_string(),
            bit: *bit,
        };
        self.registers.iter().map(of).chain(self.outputs.iter().map(output)).collect()
    }
}

/// The best name of each bit: the name of a port, or else of the net that lies fewest levels below the top. Names that
/// yosys made up do not count.
fn names(module: &Value) -> BTreeMap<usize, String> {
    let mut names: BTreeMap<usize, String> = BTreeMap::new();
    let ports = module["ports"].as_object();
    let rank = |name: &str| {
        let is_port = ports.is_some_and(|ports| ports.contains_key(name));
        let is_first = name.ends_with(".first") || name.ends_with(".memory.word");
        (!is_port, !is_first, name.matches(['.', '$']).count(), name.len())
    };
    for (name, net) in module["netnames"].as_object().into_iter().flatten() {
        if net["hide_name"].as_u64() == Some(1) {
            continue;
        }
        for bit in known(&net["bits"]) {
            let is_better = names.get(&bit).is_none_or(|kept| rank(name) < rank(kept));
            if is_better {
                names.insert(bit, name.clone());
            }
        }
    }
    names
}
