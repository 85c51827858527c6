//! `incircle info`: what a back end says of itself.

use incircle_protocol::CORE_COORD_BITS;

use crate::arguments::{BackendName, InfoArguments};
use crate::backend;
use crate::failure::{counted, Failure};
use crate::grid::failure_of;
use crate::output;

/// Runs the subcommand: opens the back end, greets it and prints its identity.
pub fn run(arguments: &InfoArguments) -> Result<(), Failure> {
    let mut backend = backend::open(&arguments.backend, CORE_COORD_BITS, None, None)?;
    let session = backend.device.session().map_err(|error| failure_of(&error))?;
    let identity = session.identity();
    let [major, minor, patch] = [16, 8, 0].map(|shift| identity.core_version >> shift & 0xff);
    let protocol = identity.protocol_version;
    let protocol = format!("protocol {}.{}", protocol >> 16, protocol & 0xffff);
    let holds = format!("coordinates of {} bits\n{} points", identity.coord_bits, identity.capacity);
    let contexts = identity.contexts;
    output::print(&if arguments.backend.name() == BackendName::Cpu {
        format!("back end cpu\nversion {major}.{minor}.{patch}\n{holds}\n{}\n", counted(contexts as usize, "thread"))
    } else {
        format!(
            "back end {}\nversion {major}.{minor}.{patch}, {protocol}\n{holds}\n{contexts} insertions at once\n\
             cavities of up to {} boundary edges\n",
            backend.name, identity.ring_capacity
        )
    })
}
