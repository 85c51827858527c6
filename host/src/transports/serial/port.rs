//! Serial ports of the operating system: listing, opening, reading, and writing without blocking.

use std::io::{self, Read, Write};
use std::path::Path;
use std::time::Duration;

use incircle_protocol::FIRST_RATE;
use serialport::{ClearBuffer, DataBits, FlowControl, Parity, SerialPort, SerialPortType, StopBits};

use super::fault::SerialFault;
use super::low_latency;

/// Most bytes of one write. A port that is ready takes this many without blocking, even when nobody reads
/// at its other end.
const MOST_WRITTEN: usize = 1024;
/// Empty reads in a row, from a port that was ready to be read, that show that the port is gone.
const EMPTY_READS: u32 = 3;
/// Directory in which Linux keeps its pseudo-terminals.
const PSEUDO_TERMINALS: &str = "/dev/pts/";

/// The reason why a serial port cannot be opened.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PortFault {
    /// The system has no such port.
    #[error("there is no such port{}", known_ports(ports))]
    Missing {
        /// Names of the ports that the system has.
        ports: Vec<String>,
    },
    /// The user has no permission to use the port.
    #[error(
        "you may not use it: join the group that owns it (often 'sudo usermod -aG dialout $USER', then log in again), \
         or add a udev rule, such as 'SUBSYSTEM==\"tty\", ATTRS{{idVendor}}==\"0403\", TAG+=\"uaccess\"' \
         in /etc/udev/rules.d"
    )]
    NoPermission,
    /// Another program uses the port.
    #[error(
        "another program uses it: end that program first, such as a terminal program or another incircle \
         ('fuser' or 'lsof' says which)"
    )]
    Busy,
    /// The path names something else than a terminal.
    #[error("it is no serial port: name a device such as /dev/ttyUSB0 ('incircle devices' lists them)")]
    NoTerminal,
    /// The system refused for another reason, which is given.
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

/// A serial port that the system knows of, as [`ports`] lists them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PortInfo {
    /// Name of the port, as [`Device::open`](crate::Device::open) takes it behind `serial:`.
    pub name: String,
    /// Description of the adapter, as far as the system knows, such as `USB 0403:6010 FTDI Dual RS232`.
    pub what: String,
}

/// Lists the serial ports that the system knows of, sorted by name. Pseudo-terminals are not among them.
///
/// # Errors
/// [`PortFault::Other`] if the system cannot list them.
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

/// An open port, for this program alone: 8 data bits, no parity, one stop bit, no flow control.
pub(super) struct Port {
    port: Box<dyn SerialPort>,
    /// Rate in bits per second that was set last.
    rate: u32,
    empty_reads: u32,
}

impl Port {
    /// Opens the port at the first rate, and drops the bytes that came before.
    pub fn open(path: &str) -> Result<Self, PortFault> {
        check_kind(path)?;
        let builder = serialport::new(path, FIRST_RATE)
            .data_bits(DataBits::Eight)
            .parity(Parity::None)
            .stop_bits(StopBits::One)
            .flow_control(FlowControl::None)
            // DTR and RTS stay as they are: on many boards they drive the reset, and pseudo-terminals have none.
            .preserve_dtr_on_open()
            .timeout(Duration::ZERO);
        let mut port = builder.open_native().map_err(|error| fault_of(&error))?;
        share_pseudo_terminal(path, &mut port)?;
        low_latency::set(&port);
        let _ = port.clear(ClearBuffer::All);
        Ok(Self { port: Box::new(port), rate: FIRST_RATE, empty_reads: 0 })
    }

    /// The rate of the port in bits per second.
    pub fn rate(&self) -> u32 {
        self.rate
    }

    /// Sets the rate of the port, in bits per second.
    pub fn set_rate(&mut self, rate: u32) -> Result<(), SerialFault> {
        self.port.set_baud_rate(rate).map_err(|error| SerialFault::Unplugged { reason: error.description })?;
        self.rate = rate;
        Ok(())
    }

    /// The rates among `rates` that the port takes. Afterwards the port is at the first rate.
    pub fn possible(&mut self, rates: &[u32]) -> Result<Vec<u32>, SerialFault> {
        let mut possible = Vec::with_capacity(rates.len());
        for &rate in rates {
            // Some drivers take any rate and set the nearest one that they have. A UART cannot follow a rate that is
            // off by more than a fiftieth.
            let is_taken = self.port.set_baud_rate(rate).is_ok();
            if is_taken && self.port.baud_rate().map_or(true, |set| set.abs_diff(rate) <= rate / 50) {
                possible.push(rate);
            }
        }
        self.set_rate(FIRST_RATE)?;
        Ok(possible)
    }

    /// Writes as many bytes as the port takes without blocking, which may be none.
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

    /// Reads the bytes that are there. If there are none, waits for at most `timeout`.
    pub fn read(&mut self, bytes: &mut [u8], timeout: Duration) -> Result<usize, SerialFault> {
        self.set_timeout(timeout)?;
        match self.port.read(bytes) {
            Ok(0) => {
                self.empty_reads += 1;
                if self.empty_reads >= EMPTY_READS {
                    return Err(SerialFault::Unplugged { reason: "it has nothing more to read".to_owned() });
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

/// Whether a call that failed with this error is worth another try.
fn passes(error: &io::Error) -> bool {
    matches!(error.kind(), io::ErrorKind::TimedOut | io::ErrorKind::WouldBlock | io::ErrorKind::Interrupted)
}

fn unplugged(error: &io::Error) -> SerialFault {
    SerialFault::Unplugged { reason: error.to_string() }
}

/// Refuses a path that exists but is no character device, before it is opened.
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
        // The library reports a lock, or an exclusive mark, of another program in this way.
        ErrorKind::NoDevice => PortFault::Busy,
        // The system answers so when the settings of a terminal are asked of something that is not a terminal.
        ErrorKind::Unknown if error.description == "Not a typewriter" => PortFault::NoTerminal,
        _ => PortFault::Other(error.description.clone()),
    }
}

/// Takes the exclusive mark off a pseudo-terminal. The mark would stay after this program is killed, and then only root
/// could open the terminal again. The lock that comes with the mark remains: programs that look for a lock respect it,
/// and it ends with its holder.
#[cfg(unix)]
fn share_pseudo_terminal(path: &str, port: &mut serialport::TTYPort) -> Result<(), PortFault> {
    let is_pseudo = std::fs::canonicalize(path).is_ok_and(|real| is_pseudo_terminal(&real));
    if is_pseudo {
        // The lock becomes a shared one. Other programs ask for an exclusive lock and are refused.
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
