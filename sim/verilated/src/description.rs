//! The description of a compiled model: its functions and its ports. The C++ of `shim.hpp` fills it in.
#![allow(unsafe_code)] // The tables are C data; reading them is what this module is for.

use std::ffi::{c_char, c_void, CStr};

/// The direction of a port.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// The program drives the port.
    Input,
    /// The model drives the port.
    Output,
}

/// A port of a model's top module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Port {
    /// Name of the port in Verilog.
    pub name: &'static str,
    /// Number of bits, 1 or more.
    pub width: u32,
    /// Direction of the port.
    pub direction: Direction,
}

/// A port of one kind of model, looked up by name once and used many times.
#[derive(Clone, Copy, Debug)]
pub struct PortId {
    pub(crate) model: &'static ModelDescription,
    pub(crate) index: usize,
    pub(crate) width: u32,
    pub(crate) direction: Direction,
}

impl PortId {
    /// Number of bits of the port.
    pub fn width(self) -> u32 {
        self.width
    }

    /// Direction of the port.
    pub fn direction(self) -> Direction {
        self.direction
    }

    /// Name of the port in Verilog.
    pub fn name(self) -> &'static str {
        self.model.ports().nth(self.index).map_or("?", |port| port.name)
    }
}

/// The error of looking up a port that does not exist.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("model {model} has no port {wanted:?}; its ports are {ports}", ports = .ports.join(", "))]
pub struct PortError {
    /// Name of the model.
    pub model: &'static str,
    /// The name that was asked for.
    pub wanted: String,
    /// The names of the ports that exist.
    pub ports: Vec<&'static str>,
}

#[repr(C)]
#[derive(Clone, Copy)]
struct RawPort {
    name: *const c_char,
    width: u32,
    direction: u32,
}

/// A kind of model, as the build side compiled it. Only C++ makes values of this type.
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

    /// Whether instances of the model can write waveforms.
    pub fn can_trace(&self) -> bool {
        self.trace_open.is_some()
    }

    /// The port of this name.
    ///
    /// # Errors
    /// The model has no such port; the error lists the ports that it has.
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
