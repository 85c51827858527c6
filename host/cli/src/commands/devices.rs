//! `incircle devices`: lists the serial ports and the PCIe cards of this machine, or the devices on the network.

use std::net::SocketAddrV4;
use std::time::Duration;

use incircle::pcie::{self, CardInfo, PcieTransport};
use incircle::serial::{self, Address, PortInfo};
use incircle::{udp, Identity};

use crate::arguments::DevicesArguments;
use crate::failure::{counted, printable, Exit, Failure};
use crate::output;

/// Time for the answer at a port. A device that a killed program left at a high rate answers after two seconds.
const GREET_TIMEOUT: Duration = Duration::from_secs(4);

/// Time for the answers of devices on the network.
const DISCOVER_TIME: Duration = Duration::from_secs(1);

/// Runs the subcommand. Each port and card has a line with its description by the system, and with `--greet`
/// also with its answer.
pub fn run(arguments: &DevicesArguments) -> Result<(), Failure> {
    if let Some(to) = arguments.network {
        return list_network(to);
    }
    let ports = serial::ports()
        .map_err(|fault| Failure::new(Exit::NoDevice, format!("the serial ports cannot be listed: {fault}")))?;
    let cards = pcie::cards();
    if ports.is_empty() && cards.is_empty() {
        output::note("the system knows of no serial port and of no PCIe card; pseudo-terminals are not listed");
    }
    for card in cards {
        let there = if arguments.greet { format!(": {}", greet_card(&card)) } else { String::new() };
        output::print(&printable(&format!("{} ({}){there}", card.address, card.what)))?;
        output::print("\n")?;
    }
    for port in ports {
        let there = if arguments.greet { format!(": {}", greet(&port)) } else { String::new() };
        output::print(&printable(&format!("{} ({}){there}", port.name, port.what)))?;
        output::print("\n")?;
    }
    Ok(())
}

/// Lists the devices that answer a greeting to this address.
fn list_network(to: SocketAddrV4) -> Result<(), Failure> {
    let found = udp::discover(&[to], DISCOVER_TIME);
    let found = found.map_err(|fault| Failure::new(Exit::NoDevice, fault.to_string()))?;
    if found.is_empty() {
        output::note(&format!("no device answers a greeting to {to}: a device in another network needs its address"));
    }
    for device in found {
        let (identity, mac) =
            (device.greeting.identity, device.greeting.mac.map(|byte| format!("{byte:02x}")).join(":"));
        let state = if device.is_busy { ", busy" } else { "" };
        output::print(&printable(&format!(
            "{} ({mac}): incircle, {} points of {} bits, {} at once{state}",
            device.address,
            identity.capacity,
            identity.coord_bits,
            insertions_of(&identity)
        )))?;
        output::print("\n")?;
    }
    Ok(())
}

/// How many insertions a device has in progress at a time, in words.
fn insertions_of(identity: &Identity) -> String {
    counted(identity.contexts as usize, "insertion")
}

/// The description of a card by its registers, or the reason why it has none.
fn greet_card(card: &CardInfo) -> String {
    match PcieTransport::open(&card.address).and_then(|mut card| card.registers()) {
        Ok(registers) => {
            let identity = registers.identity;
            format!(
                "incircle, {} points of {} bits, {} at once, beats of {} bits",
                identity.capacity,
                identity.coord_bits,
                insertions_of(&identity),
                registers.beat_bits
            )
        }
        Err(error) => error.to_string(),
    }
}

/// The description of the device at a port by its answer, or the reason why there is none.
fn greet(port: &PortInfo) -> String {
    match serial::greet(&Address::of_port(&*port.name), GREET_TIMEOUT) {
        Ok(greeting) => {
            let identity = greeting.identity;
            format!(
                "incircle, {} points of {} bits, {} at once, up to {} bits per second",
                identity.capacity,
                identity.coord_bits,
                insertions_of(&identity),
                greeting.max_rate
            )
        }
        Err(error) => error.to_string(),
    }
}
