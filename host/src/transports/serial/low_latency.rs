//! The setting that makes a USB adapter pass bytes on at once, on systems that have it.
//!
//! Adapters collect bytes for a while before they pass them on, 16 ms by default with FTDI's. For short answers that is
//! half of all time. On Linux a flag of the driver brings it down to a millisecond, but the library for ports has
//! no call for it.

/// Sets the port to low latency. A failure is ignored, since only speed is at stake.
#[cfg(target_os = "linux")]
pub(super) fn set(port: &serialport::TTYPort) {
    use std::os::fd::AsRawFd;
    linux::set(port.as_raw_fd());
}

/// Does nothing: this system has no such setting.
#[cfg(not(target_os = "linux"))]
pub(super) fn set<P>(_: &P) {}

#[cfg(target_os = "linux")]
#[allow(unsafe_code)] // two system calls that no safe library offers
mod linux {
    use std::ffi::{c_int, c_long, c_uint, c_ushort};
    use std::os::fd::RawFd;

    /// The flag `ASYNC_LOW_LATENCY` of `linux/tty_flags.h`.
    const LOW_LATENCY: c_int = 1 << 13;

    /// `struct serial_struct` of `linux/serial.h`. On every Linux `unsigned long` is as wide as a pointer.
    #[repr(C)]
    struct SerialStruct {
        kind: c_int,
        line: c_int,
        port: c_uint,
        irq: c_int,
        flags: c_int,
        xmit_fifo_size: c_int,
        custom_divisor: c_int,
        baud_base: c_int,
        close_delay: c_ushort,
        io_type: [u8; 2],
        hub6: c_int,
        closing_wait: c_ushort,
        closing_wait2: c_ushort,
        iomem_base: *mut u8,
        iomem_reg_shift: c_ushort,
        port_high: c_uint,
        iomap_base: c_long,
    }

    pub fn set(port: RawFd) {
        let mut settings = std::mem::MaybeUninit::<SerialStruct>::zeroed();
        // SAFETY: the descriptor is open for as long as the borrowed port, and the call writes at most a
        // `serial_struct`, for which there is room. All bits zero are a valid one, so it may be read
        // whatever the call did.
        let (result, settings) = unsafe {
            let result = libc::ioctl(port, libc::TIOCGSERIAL, settings.as_mut_ptr());
            (result, settings.assume_init_mut())
        };
        if result != 0 || settings.flags & LOW_LATENCY != 0 {
            return;
        }
        settings.flags |= LOW_LATENCY;
        // SAFETY: as above; this call only reads.
        unsafe { libc::ioctl(port, libc::TIOCSSERIAL, std::ptr::from_ref(settings)) };
    }
}
