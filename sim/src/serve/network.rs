//! A device on a network, for any program that opens UDP sockets: the software model of the link and of the core, or a
//! board that is simulated at the pins of its PHY. A core with runs is Verilated in both cases.

use std::io::{self, ErrorKind};
use std::net::{SocketAddr, SocketAddrV4, UdpSocket};
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use incircle::transports::parts::is_lost_on_the_way;
use incircle_model::ModelError;
use incircle_protocol::{Config, MAX_HOST_DATAGRAM};
use incircle_testkit::{Network, NetworkFaults};

use super::on_network::{FastDevice, OnNetwork};
use crate::error::SimError;
use crate::network::NetworkBoard;

/// Most datagrams that are taken before the core works.
const BURST: usize = 64;
/// Longest wait for a datagram. A signal to end may have to wait this long.
const NAP: Duration = Duration::from_millis(50);
/// Shortest wait: a timeout of 0 would mean none.
const SHORTEST_NAP: Duration = Duration::from_micros(50);

/// The options of a service.
#[derive(Clone, Debug)]
pub struct NetworkService {
    /// Address and port to listen at. With port 0 the system chooses one.
    pub listen: SocketAddrV4,
    /// Core of the device.
    pub config: Config,
    /// Whether the device has the software model of the link, and not the pins of a board.
    pub is_fast: bool,
    /// Whether the core has runs, for a mesh that lives.
    pub has_runs: bool,
    /// Faults between host and device.
    pub faults: NetworkFaults,
}

/// The figures of a service that has ended.
#[derive(Clone, Copy, Debug, Default)]
pub struct NetworkFigures {
    /// Number of datagrams to the device, those that were lost on the way left out.
    pub to_device: u64,
    /// Number of datagrams to hosts, with those that were lost on the way.
    pub to_host: u64,
    /// Number of faults.
    pub faults: u64,
}

/// The reason why a device cannot be served on a network.
#[derive(Debug, thiserror::Error)]
pub enum NetworkError {
    /// The system refuses a socket.
    #[error(
        "the system refuses a socket at {listen} ({source}): is the port in use, or the address not of this machine?"
    )]
    Socket {
        /// Address to listen at.
        listen: SocketAddrV4,
        /// Error of the system.
        source: io::Error,
    },
    /// The system refuses to set up the socket or to receive.
    #[error("the network fails: {0}")]
    Io(#[from] io::Error),
    /// The core cannot be modelled.
    #[error("{0}")]
    Model(#[from] ModelError),
    /// The board cannot be simulated.
    #[error("{0}")]
    Board(#[from] SimError),
}

/// Serves a device until `stops` is set, and calls `ready` with its address as soon as it listens.
///
/// # Errors
/// The system refuses the socket or a call.
pub fn serve_network(
    service: &NetworkService,
    stops: &AtomicBool,
    ready: impl FnOnce(SocketAddr),
) -> Result<NetworkFigures, NetworkError> {
    let refused = |source| NetworkError::Socket { listen: service.listen, source };
    let socket = UdpSocket::bind(service.listen).map_err(refused)?;
    socket.set_nonblocking(true)?;
    let address = socket.local_addr()?;
    let device: Box<dyn OnNetwork> = match (service.is_fast, service.has_runs) {
        (true, false) => Box::new(FastDevice::new(service.config, address.port())?),
        (true, true) => Box::new(FastDevice::living(service.config, address.port())?),
        (false, false) => Box::new(NetworkBoard::new(service.config)?),
        (false, true) => Box::new(NetworkBoard::living(service.config)?),
    };
    let has_faults = service.faults != NetworkFaults { seed: service.faults.seed, ..NetworkFaults::default() };
    let mut server = Server {
        socket,
        device,
        network: has_faults.then(|| [0, 1].map(|direction| Network::new(&service.faults, 0, direction))),
        origin: Instant::now(),
        figures: NetworkFigures::default(),
    };
    ready(address);
    while !stops.load(Ordering::Relaxed) {
        server.turn()?;
    }
    let faults = server.network.map_or(0, |[down, up]| down.met() + up.met());
    Ok(NetworkFigures { faults, ..server.figures })
}

/// The state of a running service.
struct Server {
    socket: UdpSocket,
    device: Box<dyn OnNetwork>,
    /// The ways to the device and back, if they have faults.
    network: Option<[Network<SocketAddrV4>; 2]>,
    origin: Instant,
    figures: NetworkFigures,
}

impl Server {
    /// Takes what has come, lets the core work, and sends its answers, or waits.
    fn turn(&mut self) -> io::Result<()> {
        self.device.age(self.now());
        let mut is_idle = true;
        for _ in 0..BURST {
            if !self.device.has_room() || !self.take_one()? {
                break;
            }
            is_idle = false;
        }
        self.arrive();
        for _ in 0..self.device.burst() {
            self.device.work();
            while let Some((to, datagram)) = self.device.give() {
                self.figures.to_host += 1;
                self.hand_out(to, &datagram);
            }
            if !self.device.is_at_work() {
                break;
            }
        }
        self.deliver();
        if is_idle && !self.device.is_at_work() {
            return self.wait();
        }
        Ok(())
    }

    /// Nanoseconds since the start.
    fn now(&self) -> u64 {
        u64::try_from(self.origin.elapsed().as_nanos()).unwrap_or(u64::MAX)
    }

    /// Takes a datagram from the socket, if one has come.
    fn take_one(&mut self) -> io::Result<bool> {
        let mut bytes = [0; MAX_HOST_DATAGRAM + 1];
        match self.socket.recv_from(&mut bytes) {
            Ok((length, from)) => {
                self.take_in(from, &bytes[..length]);
                Ok(true)
            }
            Err(error) if means_no_datagram(&error) => Ok(false),
            Err(error) => Err(error),
        }
    }

    /// Puts a datagram on its way to the device. One from port 0 is dropped, since no answer can be sent there.
    fn take_in(&mut self, from: SocketAddr, datagram: &[u8]) {
        let SocketAddr::V4(from) = from else { return };
        if from.port() == 0 {
            return;
        }
        let now = self.now();
        match &mut self.network {
            Some([down, _]) => down.send(now, from, datagram),
            None => {
                self.figures.to_device += 1;
                self.device.take(from, datagram);
            }
        }
    }

    /// Hands the datagrams that have arrived to the device. Each is answered before the next one comes, as on a wire.
    fn arrive(&mut self) {
        let now = self.now();
        let Some([down, up]) = &mut self.network else { return };
        while let Some((from, datagram)) = down.next(now) {
            self.figures.to_device += 1;
            self.device.take(from, &datagram);
            while let Some((to, datagram)) = self.device.give() {
                self.figures.to_host += 1;
                up.send(now, to, &datagram);
            }
        }
    }

    /// Puts a datagram on its way to a host.
    fn hand_out(&mut self, to: SocketAddrV4, datagram: &[u8]) {
        let now = self.now();
        match &mut self.network {
            Some([_, up]) => up.send(now, to, datagram),
            None => self.send(to, datagram),
        }
    }

    /// Sends the datagrams whose way is over.
    fn deliver(&mut self) {
        let now = self.now();
        while let Some((to, datagram)) = self.network.as_mut().and_then(|[_, up]| up.next(now)) {
            self.send(to, &datagram);
        }
    }

    /// Sends a datagram. One that the system does not take is lost, as on a network: no host ends the service of all.
    fn send(&self, to: SocketAddrV4, datagram: &[u8]) {
        let _ = self.socket.send_to(datagram, to);
    }

    /// Waits until a datagram comes from a host or has passed the network.
    fn wait(&mut self) -> io::Result<()> {
        let ways = self.network.iter().flatten();
        let next = ways.filter_map(Network::next_at).min();
        let nap = next.map_or(NAP, |at| Duration::from_nanos(at.saturating_sub(self.now())));
        self.socket.set_read_timeout(Some(nap.clamp(SHORTEST_NAP, NAP)))?;
        self.socket.set_nonblocking(false)?;
        let taken = self.take_one();
        self.socket.set_nonblocking(true)?;
        taken.map(|_| ())
    }
}

/// Whether an error of a receiving socket means no more than that nothing has come, or that one datagram is lost. A
/// host that is gone, or a firewall, may have refused a datagram that was sent earlier.
fn means_no_datagram(error: &io::Error) -> bool {
    matches!(
        error.kind(),
        ErrorKind::WouldBlock
            | ErrorKind::TimedOut
            | ErrorKind::Interrupted
            | ErrorKind::ConnectionRefused
            | ErrorKind::ConnectionReset
            | ErrorKind::PermissionDenied
    ) || is_lost_on_the_way(error)
}

#[cfg(test)]
mod tests;
