//! Ports of the operating system: opened, written without blocking, read, and told apart when they cannot be had.

use std::io::{self, Read, Write};
use std::path::Path;
use std::time::Duration;

use incircle_protocol::FIRST_RATE;
use serialport::{ClearBuffer, DataBits, FlowControl, Parity, SerialPort, SerialPortType, StopBits};

use super::fault::SerialFault;
use super::low_latency;

/// Most bytes of one write: a port that says it can be written takes so many without blocking, also when nobody reads
/// at its other end.
const MOST_WRITTEN: usize = 1024;
/// Reads that bring nothing though the port said there is something: more of them in a row mean that the port is gone.
const EMPTY_READS: u32 = 3;
/// Where Linux keeps its pseudo-terminals.
const PSEUDO_TERMINALS: &str = "/dev/pts/";

/// Why a port cannot be opened.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PortFault {
    /// The system has no such port.
    #[error("there is no such port{}", known_ports(ports))]
    Missing {
        /// The ports there are.
        ports: Vec<String>,
    },
    /// The user may not use it.
    #[error(
        "you may not use it: join the group that owns it (often 'sudo usermod -aG dialout $USER', then log in again), or add a udev \
         rule, such as 'SUBSYSTEM==\"tty\", ATTRS{{idVendor}}==\"0403\", TAG+=\"uaccess\"' in /etc/udev/rules.d"
    )]
    NoPermission,
    /// Somebody else uses it.
    #[error("another program uses it: end that first, such as a terminal program or another incircle ('fuser' or 'lsof' says which)")]
    Busy,
    /// It is no terminal.
    #[error("it is no serial port: name a device such as /dev/ttyUSB0 ('incircle devices' lists them)")]
    NoTerminal,
    /// Anything else.
    #[error("{0}: check the adapter, and plug it in again")]
    Other(String),
}

fn known_ports(ports: &[String]) -> String {
    if ports.is_empty() {
        ", and the system knows of none: plug the board in".to_owned()
    } else {
        format!(": choose one of {}", ports.join(", "))
    }
}

/// A port that the system knows of.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PortInfo {
    /// Its name, as [`Device::open`](crate::Device::open) takes it behind `serial:`.
    pub name: String,
    /// What it is, as far as the system knows: `USB 0403:6010 FTDI Dual RS232`.
    pub what: String,
}

/// The serial ports that the system knows of, sorted by name. Pseudo-terminals are not among them.
///
/// # Errors
/// A sentence, where the system cannot list them.
pub fn ports() -> Result<Vec<PortInfo>, PortFault> {
    let found = serialport::available_ports().map_err(|error| PortFault::Other(error.description))?;
    let mut ports: Vec<_> =
        found.into_iter().map(|port| PortInfo { name: port.port_name, what: describe(&port.port_type) }).collect();
    ports.sort_by(|one, other| one.name.cmp(&other.name));
    Ok(ports)
}

fn describe(port: &SerialPortType) -> String {
    match port {
        SerialPortType::UsbPort(usb) => {
            let names = [&usb.manufacturer, &usb.product, &usb.serial_number];
            let names = names.into_iter().flatten().map(|name| format!(" {name}")).collect::<String>();
            format!("USB {:04x}:{:04x}{names}", usb.vid, usb.pid)
        }
        SerialPortType::PciPort => "PCI".to_owned(),
        SerialPortType::BluetoothPort => "Bluetooth".to_owned(),
        SerialPortType::Unknown => "serial port".to_owned(),
    }
}

/// An open port: 8 data bits, no parity, one stop bit, no flow control, and nobody else's.
pub(super) struct Port {
    port: Box<dyn SerialPort>,
    /// What [`Port::set_rate`] has set.
    rate: u32,
    empty_reads: u32,
}

impl Port {
    /// Opens the port at the first rate, and forgets what came before.
    pub fn open(path: &str) -> Result<Self, PortFault> {
        check_kind(path)?;
        let builder = serialport::new(path, FIRST_RATE)
            .data_bits(DataBits::Eight)
            .parity(Parity::None)
            .stop_bits(StopBits::One)
            .flow_control(FlowControl::None)
            // DTR and RTS stay as they are: many boards hang their reset on them, and pseudo-terminals have none.
            .preserve_dtr_on_open()
            .timeout(Duration::ZERO);
        let mut port = builder.open_native().map_err(|error| fault_of(&error))?;
        share_pseudo_terminal(path, &mut port)?;
        low_latency::set(&port);
        let _ = port.clear(ClearBuffer::All);
        Ok(Self { port: Box::new(port), rate: FIRST_RATE, empty_reads: 0 })
    }

    /// The rate that is set.
    pub fn rate(&self) -> u32 {
        self.rate
    }

    /// Sets the rate.
    pub fn set_rate(&mut self, rate: u32) -> Result<(), SerialFault> {
        self.port.set_baud_rate(rate).map_err(|error| SerialFault::Unplugged { reason: error.description })?;
        self.rate = rate;
        Ok(())
    }

    /// Those of `rates` that the port takes. It is at the first rate then.
    pub fn possible(&mut self, rates: &[u32]) -> Result<Vec<u32>, SerialFault> {
        let mut possible = Vec::with_capacity(rates.len());
        for &rate in rates {
            // Some drivers take any rate and set the nearest they have: what differs by a fiftieth is no rate for a
            // UART.
            let is_taken = self.port.set_baud_rate(rate).is_ok();
            if is_taken && self.port.baud_rate().map_or(true, |set| set.abs_diff(rate) <= rate / 50) {
                possible.push(rate);
            }
        }
        self.set_rate(FIRST_RATE)?;
        Ok(possible)
    }

    /// Writes as many bytes as the port takes at once, which may be none.
    pub fn write(&mut self, bytes: &[u8]) -> Result<usize, SerialFault> {
        let bytes = &bytes[..bytes.len().min(MOST_WRITTEN)];
        if bytes.is_empty() {
            return Ok(0);
        }
        self.set_timeout(Duration::ZERO)?;
        match self.port.write(bytes) {
            Ok(written) => Ok(written),
            Err(error) if passes(&error) => Ok(0),
            Err(error) => Err(unplugged(&error)),
        }
    }

    /// Reads what is there, after waiting for at most `timeout` if nothing is.
    pub fn read(&mut self, bytes: &mut [u8], timeout: Duration) -> Result<usize, SerialFault> {
        self.set_timeout(timeout)?;
        match self.port.read(bytes) {
            Ok(0) => {
                self.empty_reads += 1;
                if self.empty_reads >= EMPTY_READS {
                    return Err(SerialFault::Unplugged { reason: "it reads as ended".to_owned() });
                }
                Ok(0)
            }
            Ok(read) => {
                self.empty_reads = 0;
                Ok(read)
            }
            Err(error) if passes(&error) => Ok(0),
            Err(error) => Err(unplugged(&error)),
        }
    }

    fn set_timeout(&mut self, timeout: Duration) -> Result<(), SerialFault> {
        self.port.set_timeout(timeout).map_err(|error| SerialFault::Unplugged { reason: error.description })
    }
}

/// True if it is worth another try.
fn passes(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::TimedOut | io::ErrorKind::WouldBlock | io::ErrorKind::Interrupted)
}

fn unplugged(error: &io::Error) -> SerialFault {
    SerialFault::Unplugged { reason: error.to_string() }
}

/// What exists and is no device of characters is refused before it is opened.
#[cfg(unix)]
fn check_kind(path: &str) -> Result<(), PortFault> {
    use std::os::unix::fs::FileTypeExt;
    match std::fs::metadata(path) {
        Ok(about) if about.file_type().is_char_device() => Ok(()),
        Ok(_) => Err(PortFault::NoTerminal),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Err(missing()),
        Err(error) if error.kind() == io::ErrorKind::PermissionDenied => Err(PortFault::NoPermission),
        Err(error) => Err(PortFault::Other(error.to_string())),
    }
}

#[cfg(not(unix))]
fn check_kind(_: &str) -> Result<(), PortFault> {
    Ok(())
}

fn missing() -> PortFault {
    let ports = ports().unwrap_or_default();
    PortFault::Missing { ports: ports.into_iter().map(|port| port.name).collect() }
}

fn fault_of(error: &serialport::Error) -> PortFault {
    use serialport::ErrorKind;
    match error.kind {
        ErrorKind::Io(io::ErrorKind::PermissionDenied) => PortFault::NoPermission,
        ErrorKind::Io(io::ErrorKind::NotFound) => missing(),
        // The library's name for a lock or an exclusive mark that another program has set.
        ErrorKind::NoDevice => PortFault::Busy,
        // The system's answer to settings of a terminal on what is none.
        ErrorKind::Unknown if error.description == "Not a typewriter" => PortFault::NoTerminal,
        _ => PortFault::Other(error.description.clone()),
    }
}

/// A pseudo-terminal keeps its exclusive mark when the program that set it is killed, and nobody but root could ever
/// open it again. It goes without: the lock that comes with it holds among programs that look for one, and ends with
/// its owner.
#[cfg(unix)]
fn share_pseudo_terminal(path: &str, port: &mut serialport::TTYPort) -> Result<(), PortFault> {
    let is_pseudo = std::fs::canonicalize(path).is_ok_and(|real| is_pseudo_terminal(&real));
    if is_pseudo {
        // A lock that is shared: others ask for one that is not, and are refused.
        port.set_exclusive(false).map_err(|error| fault_of(&error))?;
    }
    Ok(())
}

#[cfg(not(unix))]
fn share_pseudo_terminal<P>(_: &str, _: &mut P) -> Result<(), PortFault> {
    Ok(())
}

#[cfg_attr(not(unix), allow(dead_code))]
fn is_pseudo_terminal(path: &Path) -> bool {
    path.starts_with(PSEUDO_TERMINALS)
}
