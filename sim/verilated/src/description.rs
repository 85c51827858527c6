//! What a compiled model is: its functions and its ports. Filled in by C++ (`shim.hpp`).
#![allow(unsafe_code)] // The tables are C data; reading them is what this module is for.

use std::ffi::{c_char, c_void, CStr};

/// Which way a port points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// Driven by the program.
    Input,
    /// Driven by the model.
    Output,
}

/// A port of a model's top module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Port {
    /// Name in Verilog.
    pub name: &'static str,
    /// Bits, 1 or more.
    pub width: u32,
    /// Which way it points.
    pub direction: Direction,
}

/// A port of one kind of model, found by name once and used many times.
#[derive(Clone, Copy, Debug)]
pub struct PortId {
    pub(crate) model: &'static ModelDescription,
    pub(crate) index: usize,
    pub(crate) width: u32,
    pub(crate) direction: Direction,
}

impl PortId {
    /// Bits of the port.
    pub fn width(self) -> u32 {
        self.width
    }

    /// Which way the port points.
    pub fn direction(self) -> Direction {
        self.direction
    }

    /// Name of the port in Verilog.
    pub fn name(self) -> &'static str {
        self.model.ports().nth(self.index).map_or("?", |port| port.name)
    }
}

/// No such port.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("model {model} has no port {wanted:?}; its ports are {ports}", ports = .ports.join(", "))]
pub struct PortError {
    /// The model.
    pub model: &'static str,
    /// The name asked for.
    pub wanted: String,
    /// The names there are.
    pub ports: Vec<&'static str>,
}

#[repr(C)]
#[derive(Clone, Copy)]
struct RawPort {
    name: *const c_char,
    width: u32,
    direction: u32,
}

/// A kind of model, as the build side compiled it. Made by C++ only.
#[repr(C)]
pub struct ModelDescription {
    name: *const c_char,
    ports: *const RawPort,
    port_count: usize,
    pub(crate) create: unsafe extern "C" fn(i32, *mut *mut c_void) -> *mut c_void,
    pub(crate) destroy: unsafe extern "C" fn(*mut c_void),
    pub(crate) eval: unsafe extern "C" fn(*mut c_void),
    pub(crate) trace_open: Option<unsafe extern "C" fn(*mut c_void, *const c_char) -> i32>,
    pub(crate) trace_dump: Option<unsafe extern "C" fn(*mut c_void, u64)>,
    pub(crate) trace_flush: Option<unsafe extern "C" fn(*mut c_void) -> i32>,
    pub(crate) trace_close: Option<unsafe extern "C" fn(*mut c_void)>,
}

// SAFETY: a description is constant data of the program and function pointers; nothing in it changes.
unsafe impl Sync for ModelDescription {}

impl std::fmt::Debug for ModelDescription {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("ModelDescription")
            .field("name", &self.name())
            .field("ports", &self.ports().collect::<Vec<_>>())
            .finish_non_exhaustive()
    }
}

impl ModelDescription {
    /// Name of the model.
    pub fn name(&self) -> &'static str {
        // SAFETY: a string constant of the C++ unit.
        unsafe { text(self.name) }
    }

    /// The ports, sorted by name.
    pub fn ports(&self) -> impl ExactSizeIterator<Item = Port> + '_ {
        // SAFETY: `ports` points to a constant table of `port_count` entries and an end mark.
        let ports = unsafe { std::slice::from_raw_parts(self.ports, self.port_count) };
        ports.iter().map(|port| Port {
            // SAFETY: a string constant of the C++ unit.
            name: unsafe { text(port.name) },
            width: port.width,
            direction: match port.direction {
                0 => Direction::Input,
                _ => Direction::Output,
            },
        })
    }

    /// Whether instances can write waveforms.
    pub fn can_trace(&self) -> bool {
        self.trace_open.is_some()
    }

    /// The port of this name.
    ///
    /// # Errors
    /// There is none; the error lists those there are.
    pub fn port(&'static self, name: &str) -> Result<PortId, PortError> {
        let found = self.ports().enumerate().find(|(_, port)| port.name == name);
        let (index, port) = found.ok_or_else(|| PortError {
            model: self.name(),
            wanted: name.to_string(),
            ports: self.ports().map(|port| port.name).collect(),
        })?;
        Ok(PortId { model: self, index, width: port.width, direction: port.direction })
    }
}

/// A C string constant as text; names in Verilog are ASCII.
///
/// # Safety
/// `pointer` is a zero-terminated string that lives as long as the program.
unsafe fn text(pointer: *const c_char) -> &'static str {
    // SAFETY: passed on to the caller.
    unsafe { CStr::from_ptr(pointer) }.to_str().unwrap_or("?")
}
