//! `incircle info`: what a back end says of itself.

use incircle_protocol::CORE_COORD_BITS;

use crate::arguments::InfoArguments;
use crate::backend;
use crate::failure::Failure;
use crate::grid::failure_of;
use crate::output;

/// Runs the subcommand: opens the back end, greets it and prints its identity.
pub fn run(arguments: &InfoArguments) -> Result<(), Failure> {
    let mut backend = backend::open(&arguments.backend, CORE_COORD_BITS, None, None)?;
    let session = backend.device.session().map_err(|error| failure_of(&error))?;
    let identity = session.identity();
    let [major, minor, patch] = [16, 8, 0].map(|shift| identity.core_version >> shift & 0xff);
    let protocol = identity.protocol_version;
    output::print(&format!(
        "back end {}\nversion {major}.{minor}.{patch}, protocol {}.{}\ncoordinates of {} bits\n{} points\n\
         {} insertions at once\ncavities of up to {} boundary edges\n",
        backend.name,
        protocol >> 16,
        protocol & 0xffff,
        identity.coord_bits,
        identity.capacity,
        identity.contexts,
        identity.ring_capacity
    ))
}
