//! One running instance of a model: its ports, its clock and its time.
#![allow(unsafe_code)] // Ports are memory of a C++ object; a call per access would cost more than the model.

use std::ffi::c_void;
use std::ptr::NonNull;
use std::sync::{Mutex, PoisonError};

use crate::description::{Direction, ModelDescription, PortError, PortId};

/// Verilator draws random state from a generator that all threads reseed together. Instances are therefore made one at
/// a time, so that equal seeds give equal states.
static CONSTRUCTION: Mutex<()> = Mutex::new(());

/// Name of the input that passes the others on, in models that were built with `fast_clocks`.
const APPLY: &str = "inputs$apply";

/// Half a clock in nanoseconds of the waveform.
const HALF_CLOCK: u64 = 5;

/// An instance of a Verilated model: ports to set and read, and a time that passes on request.
///
/// An input keeps its value until it is set again. An output has its value as of the last [`Model::eval`] or
/// [`Model::clock`]. Access to a port of up to 64 bits costs one memory access and a few comparisons.
#[derive(Debug)]
pub struct Model {
    description: &'static ModelDescription,
    handle: NonNull<c_void>,
    addresses: Vec<*mut c_void>,
    clock: Option<PortId>,
    /// The input [`APPLY`], if the model has it.
    apply: Option<PortId>,
    /// Whether an input was set since the last evaluation.
    is_changed: bool,
    time: u64,
    pub(crate) tracing: bool,
}

// SAFETY: an instance has its own context, and every call into it first makes that context the thread's own.
unsafe impl Send for Model {}

impl Model {
    /// An instance whose registers and memories are zero unless the Verilog gives them an initial value.
    /// All inputs are 0.
    pub fn new(description: &'static ModelDescription) -> Self {
        Self::create(description, 0)
    }

    /// An instance with random registers and memories, which are the same for the same seed. Only a model that was
    /// built with `random_initial_state` differs from [`Model::new`]. All inputs are 0.
    pub fn randomized(description: &'static ModelDescription, seed: u32) -> Self {
        // Seed 0 means zero state in C++, so this seed maps to another number.
        let seed = i32::from_ne_bytes(seed.to_ne_bytes());
        Self::create(description, if seed == 0 { i32::MIN } else { seed })
    }

    /// Replaces the instance by a new one with random registers and memories; see [`Model::randomized`]. Inputs are 0
    /// again, and an open trace ends.
    pub fn randomize(&mut self, seed: u32) {
        *self = Self::randomized(self.description, seed);
    }

    fn create(description: &'static ModelDescription, seed: i32) -> Self {
        let mut addresses = vec![std::ptr::null_mut(); description.ports().len()];
        let _one_at_a_time = CONSTRUCTION.lock().unwrap_or_else(PoisonError::into_inner);
        // SAFETY: `create` fills in one address per port, and `addresses` has that many places.
        let handle = unsafe { (description.create)(seed, addresses.as_mut_ptr()) };
        // C++ `new` ends the program rather than return null, as the functions of the shim let no exception out.
        let handle = NonNull::new(handle).expect("C++ gives an instance or ends the program");
        let [clock, apply] = ["clock", APPLY].map(|name| description.port(name).ok());
        let mut model =
            Self { description, handle, addresses, clock, apply, is_changed: true, time: 0, tracing: false };
        if apply.is_some() {
            // The first evaluation of a model sees no edges, so the inputs can pass in the second only.
            model.settle();
        }
        for port in description.ports() {
            // The random generator has filled the inputs as well.
            if let (Direction::Input, Ok(id)) = (port.direction, model.port(port.name)) {
                model.write_wide(id, &vec![0; words_of(port.width)]);
            }
        }
        model.eval();
        model
    }

    /// The kind of model that this is an instance of.
    pub fn description(&self) -> &'static ModelDescription {
        self.description
    }

    /// The port of this name. A caller looks it up once and keeps the result.
    ///
    /// # Errors
    /// The model has no such port; the error lists the ports that it has.
    pub fn port(&self, name: &str) -> Result<PortId, PortError> {
        self.description.port(name)
    }

    /// Sets an input. The model sees the value at the next [`Model::eval`] or [`Model::clock`].
    ///
    /// # Panics
    /// The port belongs to another kind of model, is an output, or is wider than 64 bits, or `value` needs more bits
    /// than the port has; or the port is the clock of a model with `fast_clocks`.
    #[inline]
    pub fn set(&mut self, port: PortId, value: u64) {
        self.check_set(port);
        self.is_changed |= self.get(port) != value;
        self.write(port, value);
    }

    /// Refuses the ports that a model with `fast_clocks` drives itself.
    #[inline]
    fn check_set(&self, port: PortId) {
        if let (Some(apply), Some(clock)) = (self.apply, self.clock) {
            let is_driven = port.index == apply.index || port.index == clock.index;
            assert!(!is_driven, "port {} of a model with fast clocks: only Model::clock drives it", port.name());
        }
    }

    #[inline]
    fn write(&mut self, port: PortId, value: u64) {
        let address = self.input(port);
        assert!(
            port.width <= 64 && (port.width == 64 || value >> port.width == 0),
            "port {} of {} bits cannot take the value {value:#x}",
            port.name(),
            port.width
        );
        // SAFETY: Verilator keeps a port of this width in a variable of this type, aligned, at this address, for as
        // long as the instance lives; no C++ runs now, and `&mut self` is the only access.
        unsafe {
            match port.width {
                0..=8 => address.cast::<u8>().write(value as u8),
                9..=16 => address.cast::<u16>().write(value as u16),
                17..=32 => address.cast::<u32>().write(value as u32),
                _ => address.cast::<u64>().write(value),
            }
        }
    }

    /// Reads a port: an input as it was set, an output as of the last evaluation.
    ///
    /// # Panics
    /// The port belongs to another kind of model or is wider than 64 bits.
    #[inline]
    pub fn get(&self, port: PortId) -> u64 {
        let address = self.address(port);
        assert!(port.width <= 64, "port {} of {} bits: read it with get_wide", port.name(), port.width);
        // SAFETY: as in `set`; nobody writes while `&self` is borrowed.
        unsafe {
            match port.width {
                0..=8 => u64::from(address.cast::<u8>().read()),
                9..=16 => u64::from(address.cast::<u16>().read()),
                17..=32 => u64::from(address.cast::<u32>().read()),
                _ => address.cast::<u64>().read(),
            }
        }
    }

    /// Sets an input of any width; word 0 holds bits 31..0.
    ///
    /// # Panics
    /// The conditions of [`Model::set`], and `words` of another length than the port's bits fill.
    pub fn set_wide(&mut self, port: PortId, words: &[u32]) {
        self.check_set(port);
        self.is_changed = true;
        self.write_wide(port, words);
    }

    fn write_wide(&mut self, port: PortId, words: &[u32]) {
        assert!(
            words.len() == words_of(port.width),
            "port {} has {} bits, {} words, not {}",
            port.name(),
            port.width,
            words_of(port.width),
            words.len()
        );
        if port.width <= 64 {
            let high = words.get(1).map_or(0, |&word| u64::from(word) << 32);
            let low = words.first().map_or(0, |&word| u64::from(word));
            return self.write(port, high | low);
        }
        let address = self.input(port).cast::<u32>();
        let spare = words.len() as u32 * 32 - port.width;
        assert!(
            words.last().is_some_and(|last| spare == 0 || last >> (32 - spare) == 0),
            "port {} of {} bits cannot take the words {words:x?}",
            port.name(),
            port.width
        );
        // SAFETY: as in `set`; a port wider than 64 bits is an array of `words_of(width)` 32-bit words.
        unsafe { std::ptr::copy_nonoverlapping(words.as_ptr(), address, words.len()) }
    }

    /// Reads a port of any width into as many words as its bits fill; word 0 receives bits 31..0.
    ///
    /// # Panics
    /// The port belongs to another kind of model, or `words` has another length than the port's bits fill.
    pub fn get_wide(&self, port: PortId, words: &mut [u32]) {
        assert!(
            words.len() == words_of(port.width),
            "port {} has {} bits, {} words, not {}",
            port.name(),
            port.width,
            words_of(port.width),
            words.len()
        );
        if port.width <= 64 {
            let value = self.get(port);
            for (place, shift) in words.iter_mut().zip([0, 32]) {
                *place = (value >> shift) as u32;
            }
            return;
        }
        let address = self.address(port).cast::<u32>();
        // SAFETY: as in `set_wide`.
        unsafe { std::ptr::copy_nonoverlapping(address, words.as_mut_ptr(), words.len()) }
    }

    /// Updates all outputs from the current inputs. No time passes.
    #[inline]
    pub fn eval(&mut self) {
        if let Some(apply) = self.apply {
            if !self.is_changed {
                return;
            }
            self.write(apply, 1 - self.get(apply));
        }
        self.is_changed = false;
        self.settle();
    }

    #[inline]
    fn settle(&mut self) {
        // SAFETY: the handle is a live instance of this description.
        unsafe { (self.description.eval)(self.handle.as_ptr()) }
    }

    /// Simulates one clock on the input `clock`: a rising edge that sees the inputs as they are set, then the falling
    /// edge. In the waveform, ten nanoseconds pass.
    ///
    /// # Panics
    /// The model has no input `clock`.
    #[inline]
    pub fn clock(&mut self) {
        match self.clock {
            Some(clock) => self.clock_on(clock),
            None => panic!("model {} has no input `clock`: name one with clock_on", self.description.name()),
        }
    }

    /// Simulates one clock on this input; see [`Model::clock`].
    ///
    /// # Panics
    /// The port belongs to another kind of model, or is no input of one bit. A model with `fast_clocks` has no clock
    /// but `clock`.
    #[inline]
    pub fn clock_on(&mut self, clock: PortId) {
        if self.tracing {
            // Otherwise the waveform would show the inputs changing at the rising edge.
            self.eval();
            self.dump_at(self.time + 1);
        }
        if self.apply.is_some() {
            self.eval();
        }
        self.write(clock, 1);
        self.settle();
        self.dump_at(self.time + HALF_CLOCK);
        self.write(clock, 0);
        self.settle();
        self.time += 2 * HALF_CLOCK;
        self.dump_at(self.time);
    }

    /// Nanoseconds that have passed in the waveform.
    pub fn time(&self) -> u64 {
        self.time
    }

    pub(crate) fn dump_at(&mut self, time: u64) {
        if let (true, Some(dump)) = (self.tracing, self.description.trace_dump) {
            // SAFETY: the handle is live, and `tracing` says that its trace is open.
            unsafe { dump(self.handle.as_ptr(), time) }
        }
    }

    pub(crate) fn handle(&mut self) -> *mut c_void {
        self.handle.as_ptr()
    }

    #[inline]
    fn input(&self, port: PortId) -> *mut c_void {
        assert!(port.direction == Direction::Input, "port {} is an output and cannot be set", port.name());
        self.address(port)
    }

    #[inline]
    fn address(&self, port: PortId) -> *mut c_void {
        // The address must belong to a port of this width, or the accesses above would be unsound.
        assert!(
            std::ptr::eq(port.model, self.description),
            "port {} belongs to model {}, not to {}",
            port.name(),
            port.model.name(),
            self.description.name()
        );
        self.addresses[port.index]
    }
}

impl Drop for Model {
    fn drop(&mut self) {
        // SAFETY: the handle is live, and nobody uses it after this.
        unsafe { (self.description.destroy)(self.handle.as_ptr()) }
    }
}

/// Number of words that this many bits fill.
fn words_of(width: u32) -> usize {
    width.div_ceil(32) as usize
}
