//! The back end `sim`: the core's Verilog, run by Verilator.

use incircle::Device;
use incircle_protocol::Config;
use incircle_sim::{SimDevice, SimError, SimTransport};

use crate::failure::{printable, Exit, Failure};
use crate::interrupt;
use crate::trace::Trace;

/// Makes a core of this configuration, with or without runs. With `trace` a waveform of all its signals goes to that
/// file, which is complete once the device is dropped.
pub fn open(config: Config, has_runs: bool, trace: Option<Trace<'_>>) -> Result<Device, Failure> {
    let no_device = |error: SimError| match error {
        // Runs are asked for by the address alone, so this error is about a choice of the caller.
        SimError::NoRuns { .. } => Failure::usage(error.to_string()),
        error => Failure::new(Exit::NoDevice, error.to_string()),
    };
    let device = match trace {
        Some(_) if has_runs => {
            return Err(Failure::usage(
                "a simulated core with runs writes no waveform: leave out --trace, or living=yes in the address",
            ));
        }
        None if has_runs => SimDevice::living(config).map_err(no_device)?,
        None => SimDevice::new(config).map_err(no_device)?,
        Some(Trace { path, job }) => {
            let mut device = SimDevice::traced(config).map_err(no_device)?;
            let begun = match job {
                None => device.trace_to(path),
                Some(job) => device.trace_job(path, job),
            };
            begun.map_err(|error| Failure::input(printable(&error.to_string())))?;
            device
        }
    };
    let transport = SimTransport::new(device, config.name).interrupted_by(interrupt::raised);
    Ok(Device::from_transport(Box::new(transport)))
}
