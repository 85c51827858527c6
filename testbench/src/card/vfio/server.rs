//! A card behind a socket that speaks vfio-user, the protocol by which a process offers a PCI device to another.

use std::fs::File;
use std::io;
use std::os::unix::net::UnixStream;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use vfio_bindings::bindings::vfio::{
    vfio_region_info, VFIO_IRQ_INFO_EVENTFD, VFIO_IRQ_INFO_NORESIZE, VFIO_PCI_CONFIG_REGION_INDEX,
    VFIO_PCI_MSIX_IRQ_INDEX, VFIO_PCI_NUM_IRQS, VFIO_PCI_NUM_REGIONS, VFIO_REGION_INFO_FLAG_READ,
    VFIO_REGION_INFO_FLAG_WRITE,
};
use vfio_user::{DmaMapFlags, DmaUnmapFlags, Error, IrqInfo, Server, ServerBackend, ServerRegion};

use super::bridge::{Bridge, MakeCard};
use super::numbers::{config, DMA_BAR, DMA_BYTES, USER_BAR, USER_BYTES, VECTORS};

/// Numbers the sockets, so that no two cards share one.
static SERVED: AtomicU32 = AtomicU32::new(0);
/// Longest sleep of a card that has nothing to do.
const NAP: Duration = Duration::from_millis(100);

/// A card that is served to one host after another, until it is dropped.
pub struct VfioCard {
    path: PathBuf,
    shared: Arc<Shared>,
}

/// The card with its bridge, as its own thread and the server share it.
struct Shared {
    bridge: Mutex<Bridge>,
    changed: Condvar,
    /// Number of the host's messages that wait for the card.
    waiting: AtomicU32,
    /// The card serves no further host.
    ends: AtomicBool,
    /// The card has left the bus.
    is_gone: AtomicBool,
}

impl Shared {
    fn lock(&self) -> MutexGuard<'_, Bridge> {
        self.bridge.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Answers a message of the host. The crate's server ends a connection only when the host does, so a card that
    /// leaves the bus unwinds out of the server.
    fn answer<T>(&self, answer: impl FnOnce(&mut Bridge) -> T) -> T {
        if self.is_gone.load(Ordering::Acquire) {
            std::panic::resume_unwind(Box::new("the card has left the bus"));
        }
        self.waiting.fetch_add(1, Ordering::AcqRel);
        let mut bridge = self.lock();
        self.waiting.fetch_sub(1, Ordering::AcqRel);
        let answer = answer(&mut bridge);
        self.changed.notify_all();
        answer
    }

    /// Lets the card's own time pass, in a thread of its own.
    fn live(&self) {
        let mut bridge = self.lock();
        while !self.ends.load(Ordering::Acquire) {
            if bridge.step() {
                drop(bridge);
                // A message that waits comes first; otherwise a busy card would take its lock again and again.
                while self.waiting.load(Ordering::Acquire) > 0 {
                    std::thread::yield_now();
                }
                bridge = self.lock();
            } else {
                bridge = self.changed.wait_timeout(bridge, NAP).unwrap_or_else(PoisonError::into_inner).0;
            }
        }
    }

    fn serve(self: &Arc<Self>, server: &Server) {
        while !self.ends.load(Ordering::Acquire) {
            let ended = server.run(&mut Messages(Arc::clone(self)));
            self.lock().forget();
            // Any other error concerns the connection of that host only.
            if matches!(ended, Err(Error::SocketAccept(_))) {
                return;
            }
        }
    }
}

impl VfioCard {
    /// Serves a card at a socket of its own.
    ///
    /// # Errors
    /// The socket cannot be made.
    pub fn new(make: MakeCard) -> Result<Self, Error> {
        let number = SERVED.fetch_add(1, Ordering::Relaxed);
        let path = std::env::temp_dir().join(format!("incircle-vfio-{}-{number}", std::process::id()));
        let server = Server::new(&path, true, irqs(), regions())?;
        let shared = Arc::new(Shared {
            bridge: Mutex::new(Bridge::new(make)),
            changed: Condvar::new(),
            waiting: AtomicU32::new(0),
            ends: AtomicBool::new(false),
            is_gone: AtomicBool::new(false),
        });
        let (living, serving) = (Arc::clone(&shared), Arc::clone(&shared));
        std::thread::spawn(move || living.live());
        std::thread::spawn(move || serving.serve(&server));
        Ok(Self { path, shared })
    }

    /// The path of the socket.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Lets the card leave the bus: the host's next message finds the connection closed.
    pub fn vanish(&self) {
        self.shared.is_gone.store(true, Ordering::Release);
    }
}

impl Drop for VfioCard {
    /// Closes the connection of a host that is still there.
    fn drop(&mut self) {
        self.vanish();
        self.shared.ends.store(true, Ordering::Release);
        self.shared.changed.notify_all();
        // A connection wakes a server that waits for a host. If there is no such server, nobody needs to be woken.
        let _ = UnixStream::connect(&self.path);
        // The server removes the file as well when it ends, but the process may end before that.
        let _ = std::fs::remove_file(&self.path);
    }
}

/// All regions that a PCI device can have; those without a size do not exist.
fn regions() -> Vec<ServerRegion> {
    let size = |index| match index {
        USER_BAR => USER_BYTES,
        DMA_BAR => DMA_BYTES,
        VFIO_PCI_CONFIG_REGION_INDEX => config::BYTES as u64,
        _ => 0,
    };
    let region = |index| {
        let size = size(index);
        let flags = if size > 0 { VFIO_REGION_INFO_FLAG_READ | VFIO_REGION_INFO_FLAG_WRITE } else { 0 };
        let argsz = size_of::<vfio_region_info>() as u32;
        let region_info = vfio_region_info { argsz, flags, index, cap_offset: 0, size, offset: 0 };
        ServerRegion { region_info, sparse_areas: Vec::new(), mmap_fd: None }
    };
    (0..VFIO_PCI_NUM_REGIONS).map(region).collect()
}

/// All kinds of interrupts that a PCI device can have; the card has one of them.
fn irqs() -> Vec<IrqInfo> {
    let irq = |index| {
        let count = if index == VFIO_PCI_MSIX_IRQ_INDEX { VECTORS as u32 } else { 0 };
        let flags = if count > 0 { VFIO_IRQ_INFO_EVENTFD | VFIO_IRQ_INFO_NORESIZE } else { 0 };
        IrqInfo { index, flags, count }
    };
    (0..VFIO_PCI_NUM_IRQS).map(irq).collect()
}

/// Handles the messages of a host.
struct Messages(Arc<Shared>);

fn invalid(error: impl std::error::Error + Send + Sync + 'static) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidInput, error)
}

impl ServerBackend for Messages {
    fn region_read(&mut self, region: u32, offset: u64, data: &mut [u8]) -> io::Result<()> {
        self.0.answer(|bridge| bridge.read(region, offset, data));
        Ok(())
    }

    fn region_write(&mut self, region: u32, offset: u64, data: &[u8]) -> io::Result<()> {
        self.0.answer(|bridge| bridge.write(region, offset, data));
        Ok(())
    }

    fn dma_map(
        &mut self,
        flags: DmaMapFlags,
        offset: u64,
        address: u64,
        size: u64,
        fd: Option<File>,
    ) -> io::Result<()> {
        self.0.answer(|bridge| bridge.memory.map(flags, (address, size), fd, offset)).map_err(invalid)
    }

    fn dma_unmap(&mut self, flags: DmaUnmapFlags, address: u64, size: u64) -> io::Result<()> {
        self.0.answer(|bridge| {
            if flags.contains(DmaUnmapFlags::UNMAP_ALL) {
                bridge.memory.clear();
                return Ok(());
            }
            bridge.memory.unmap((address, size)).map_err(invalid)
        })
    }

    fn reset(&mut self) -> io::Result<()> {
        self.0.answer(Bridge::reset);
        Ok(())
    }

    fn set_irqs(&mut self, index: u32, flags: u32, start: u32, count: u32, fds: Vec<File>) -> io::Result<()> {
        if index != VFIO_PCI_MSIX_IRQ_INDEX {
            // The card has no other kind of interrupt, so there is nothing to set.
            return Ok(());
        }
        self.0.answer(|bridge| {
            let set = bridge.interrupts.set(flags, (start, count), fds).map_err(invalid);
            bridge.deliver();
            set
        })
    }
}
