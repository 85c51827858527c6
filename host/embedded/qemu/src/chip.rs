//! The chip: a Stellaris LM3S6965 as QEMU emulates it. A library for this chip would stand in place of this file.
#![allow(unsafe_code, reason = "registers and the stack have addresses, and the debugger is called by an instruction")]

use core::arch::asm;
use core::cell::UnsafeCell;
use core::convert::Infallible;
use core::fmt;
use core::ptr::{addr_of, addr_of_mut, read_volatile, write_volatile};
use core::sync::atomic::{AtomicU32, Ordering};

use embedded_io::{ErrorType, Read, ReadReady, Write};
use incircle_embedded::Clock;

use crate::Lists;

/// Clock of the processor after reset, in Hz.
const CLOCK_HZ: u32 = 12_500_000;
/// Factor by which the simulated board is slower than a real one: its link counts time so much more slowly.
const SLOW: u32 = match u32::from_str_radix(env!("INCIRCLE_SLOW"), 10) {
    Ok(slow) => slow,
    Err(_) => 1,
};

/// Registers of the serial port UART0, a PL011.
const UART: usize = 0x4000_c000;
const UART_DATA: usize = UART;
const UART_FLAGS: usize = UART + 0x18;
const UART_LINE: usize = UART + 0x2c;
const UART_CONTROL: usize = UART + 0x30;
/// Flag: no received byte waits.
const RECEIVE_EMPTY: u32 = 1 << 4;
/// Flag: there is no room for a byte to be sent.
const SEND_FULL: u32 = 1 << 5;
/// Eight bits with FIFOs of 16 bytes.
const EIGHT_BITS: u32 = 3 << 5 | 1 << 4;
/// The port sends and receives.
const ENABLED: u32 = 1 << 9 | 1 << 8 | 1;

/// Registers of the system timer.
const TIMER_CONTROL: usize = 0xe000_e010;
const TIMER_RELOAD: usize = 0xe000_e014;
/// The timer runs from the processor's clock and interrupts.
const TIMER_ON: u32 = 7;

/// Value with which the unused stack is filled.
const PAINT: u32 = 0x7061_696e;

/// Milliseconds of the link since the start.
static MILLISECONDS: AtomicU32 = AtomicU32::new(0);

fn get(register: usize) -> u32 {
    // SAFETY: the addresses are those of registers that may be read at any time.
    unsafe { read_volatile(register as *const u32) }
}

fn set(register: usize, value: u32) {
    // SAFETY: the addresses are those of registers, which no variable shares.
    unsafe { write_volatile(register as *mut u32, value) }
}

extern "C" fn tick() {
    MILLISECONDS.fetch_add(1, Ordering::Relaxed);
}

extern "C" fn fault() {
    exit()
}

#[no_mangle]
extern "C" fn reset() -> ! {
    crate::main()
}

/// The words that stand behind the first stack pointer in the flash.
#[repr(C)]
struct Vectors {
    reset: extern "C" fn() -> !,
    /// The exceptions, of which the last is the system timer.
    exceptions: [extern "C" fn(); 14],
}

/// Static variables need no start: QEMU's memory is zero, and the linker refuses other first values.
#[used]
#[link_section = ".vectors"]
static VECTORS: Vectors = Vectors {
    reset,
    exceptions: [fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, tick],
};

/// Lets the system timer interrupt every millisecond of the link.
pub fn start_clock() {
    set(TIMER_RELOAD, CLOCK_HZ / 1000 * SLOW - 1);
    set(TIMER_CONTROL, TIMER_ON);
}

/// The clock of the driver.
#[derive(Clone, Copy)]
pub struct Ticks;

impl Ticks {
    pub fn count(self) -> u32 {
        MILLISECONDS.load(Ordering::Relaxed)
    }
}

impl Clock for Ticks {
    fn milliseconds(&mut self) -> u32 {
        self.count()
    }
}

/// The serial port to the board.
pub struct Uart(());

impl Uart {
    pub fn new() -> Self {
        set(UART_LINE, EIGHT_BITS);
        set(UART_CONTROL, ENABLED);
        Self(())
    }
}

impl ErrorType for Uart {
    type Error = Infallible;
}

impl Read for Uart {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize, Infallible> {
        let Some(place) = buffer.first_mut() else { return Ok(0) };
        while get(UART_FLAGS) & RECEIVE_EMPTY != 0 {}
        *place = get(UART_DATA) as u8;
        Ok(1)
    }
}

impl ReadReady for Uart {
    fn read_ready(&mut self) -> Result<bool, Infallible> {
        Ok(get(UART_FLAGS) & RECEIVE_EMPTY == 0)
    }
}

impl Write for Uart {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, Infallible> {
        let Some(&byte) = bytes.first() else { return Ok(0) };
        while get(UART_FLAGS) & SEND_FULL != 0 {}
        set(UART_DATA, byte.into());
        Ok(1)
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        Ok(())
    }
}

/// Calls the debugger, which QEMU plays.
fn call(operation: u32, argument: usize) {
    // SAFETY: QEMU reads the argument and writes nothing but the register of the result.
    unsafe { asm!("bkpt 0xab", inout("r0") operation => _, in("r1") argument) }
}

/// Prints text over semihosting, a block at a time.
pub struct Semihosting {
    block: [u8; 128],
    length: usize,
}

impl Semihosting {
    /// Operation of the debugger: print the bytes up to a zero.
    const WRITE: u32 = 0x04;

    pub const fn new() -> Self {
        Self { block: [0; 128], length: 0 }
    }

    fn flush(&mut self) {
        if let Some(end) = self.block.get_mut(self.length) {
            *end = 0;
        }
        call(Self::WRITE, self.block.as_ptr() as usize);
        self.length = 0;
    }
}

impl fmt::Write for Semihosting {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for byte in text.bytes() {
            if self.length == self.block.len() - 1 {
                self.flush();
            }
            if let Some(place) = self.block.get_mut(self.length) {
                *place = byte;
                self.length += 1;
            }
        }
        Ok(())
    }
}

impl Drop for Semihosting {
    fn drop(&mut self) {
        self.flush();
    }
}

/// Ends the emulator.
pub fn exit() -> ! {
    const EXIT: u32 = 0x18;
    const ENDED: usize = 0x2_0026;
    loop {
        call(EXIT, ENDED);
    }
}

struct Memory(UnsafeCell<Lists>);

// SAFETY: only `with_lists` uses it, which is called once.
unsafe impl Sync for Memory {}

static MEMORY: Memory = Memory(UnsafeCell::new(Lists::EMPTY));

/// Lends the lists of the job. Called once.
pub fn with_lists(job: impl FnOnce(&mut Lists)) {
    // SAFETY: the only call, so no other reference lives.
    job(unsafe { &mut *MEMORY.0.get() });
}

extern "C" {
    /// End of the static variables, which is the end of the stack. The linker script defines it.
    static mut stack_end: u32;
}

fn stack_pointer() -> usize {
    let pointer: usize;
    // SAFETY: the instruction only reads a register.
    unsafe { asm!("mov {}, sp", out(reg) pointer) }
    pointer
}

/// Fills the unused stack with a pattern.
pub fn paint_stack() {
    // SAFETY: the memory from the end of the stack up to some bytes below the present pointer is used by nothing.
    unsafe {
        let mut place = addr_of_mut!(stack_end);
        while (place as usize) < stack_pointer() - 256 {
            write_volatile(place, PAINT);
            place = place.add(1);
        }
    }
}

/// Most bytes of the stack that were used since it was filled.
pub fn deepest_stack() -> usize {
    const TOP: usize = 0x2001_0000;
    // SAFETY: the whole stack may be read.
    unsafe {
        let mut place = addr_of!(stack_end);
        while (place as usize) < TOP && read_volatile(place) == PAINT {
            place = place.add(1);
        }
        TOP - place as usize
    }
}
