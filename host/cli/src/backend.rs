//! Back ends: from names to devices.

use std::path::Path;

use incircle::{Device, Point, MAX_POINTS};

#[cfg(feature = "sim")]
use crate::arguments::ConfigName;
use crate::arguments::{BackendArguments, BackendName};
use crate::failure::Failure;
use crate::grid::failure_of;

/// Fewest points a model is made for.
const LEAST_CAPACITY: usize = 4;

/// Points of one `Insert` command to a simulated core, which takes up to half a second for them: progress and
/// interrupts come between commands.
#[cfg(feature = "sim")]
const SIM_INSERT_CHUNK: usize = 4096;

/// An opened back end.
pub struct Backend {
    /// The device.
    pub device: Device,
    /// Its name in reports: `model` or `sim`.
    pub name: &'static str,
    /// The named configuration of a core.
    pub config: Option<&'static str>,
    /// Points of one `Insert` command.
    pub insert_chunk: usize,
}

/// Opens the back end for these points, or, without points, as large as it gets. A core is taken in the configuration
/// asked for, or else in the smallest that holds the distinct points. Its waveform goes to the file `trace`; other back
/// ends have none.
pub fn open(
    choice: &BackendArguments,
    coord_bits: u32,
    points: Option<&[Point]>,
    trace: Option<&Path>,
) -> Result<Backend, Failure> {
    match choice.backend {
        BackendName::Model => open_model(choice, coord_bits, points.map_or(MAX_POINTS, <[Point]>::len)),
        BackendName::Sim => open_sim(choice, coord_bits, points, trace),
    }
}

fn open_model(choice: &BackendArguments, coord_bits: u32, points: usize) -> Result<Backend, Failure> {
    if choice.config.is_some() {
        return Err(Failure::usage("--config chooses a configuration of the core: it needs --backend sim"));
    }
    let capacity = points.clamp(LEAST_CAPACITY, MAX_POINTS);
    let capacity = u32::try_from(capacity).unwrap_or(u32::MAX);
    let device = Device::model(coord_bits, capacity).map_err(|error| failure_of(&error))?;
    Ok(Backend { device, name: "model", config: None, insert_chunk: incircle::INSERT_CHUNK })
}

#[cfg(not(feature = "sim"))]
fn open_sim(_: &BackendArguments, _: u32, _: Option<&[Point]>, _: Option<&Path>) -> Result<Backend, Failure> {
    Err(Failure::usage(
        "this incircle was built without the simulated core: install Verilator and build it with \
         'cargo build --release --features sim'",
    ))
}

#[cfg(feature = "sim")]
fn open_sim(
    choice: &BackendArguments,
    coord_bits: u32,
    points: Option<&[Point]>,
    trace: Option<&Path>,
) -> Result<Backend, Failure> {
    let config = match points {
        Some(points) => config_for(choice, coord_bits, points)?,
        None => choice.config.unwrap_or(ConfigName::Large).config(),
    };
    Ok(Backend {
        device: crate::sim_backend::open(config, trace)?,
        name: "sim",
        config: Some(config.name),
        insert_chunk: SIM_INSERT_CHUNK,
    })
}

/// The configuration for a job, or why there is none.
#[cfg(feature = "sim")]
fn config_for(
    choice: &BackendArguments,
    coord_bits: u32,
    points: &[Point],
) -> Result<incircle_protocol::Config, Failure> {
    use incircle_protocol::{CORE_COORD_BITS, NAMED};

    if coord_bits > CORE_COORD_BITS {
        return Err(Failure::new(
            crate::failure::Exit::Capacity,
            format!(
                "the core has coordinates of {CORE_COORD_BITS} bits, not {coord_bits}: \
                 give --coord-bits {CORE_COORD_BITS} or --backend model"
            ),
        ));
    }
    let distinct = count_distinct(points);
    let holds = |config: &incircle_protocol::Config| config.points as usize >= distinct;
    let smallest = NAMED.into_iter().find(holds);
    let config = choice.config.map_or(smallest, |name| Some(name.config()));
    config.filter(holds).ok_or_else(|| {
        let all = NAMED.map(|config| format!("{} {}", config.name, config.points)).join(", ");
        let asked = choice.config.map_or("any core", |name| name.config().name);
        let advice = match smallest {
            Some(config) => format!("--config {} or --backend model", config.name),
            None => "--backend model".to_owned(),
        };
        Failure::new(
            crate::failure::Exit::Capacity,
            format!("{distinct} distinct points are more than {asked} holds ({all}): use {advice}"),
        )
    })
}

#[cfg(feature = "sim")]
fn count_distinct(points: &[Point]) -> usize {
    let mut sorted = points.to_vec();
    sorted.sort_unstable();
    sorted.dedup();
    sorted.len()
}
