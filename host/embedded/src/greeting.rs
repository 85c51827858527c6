//! The check of a greeting. No word of a greeting is used before.

use incircle_protocol::{
    Greeting, LINK_MAGIC, LINK_VERSION, MAGIC, MAX_COORD_BITS, MAX_MODEL_POINTS, MAX_SILENCE_MS, MIN_COORD_BITS,
    MIN_FIFO_BYTES, MIN_POINTS, OLDEST_PROTOCOL_VERSION, PROTOCOL_VERSION,
};

use crate::error::Fault;

/// Shortest silence in milliseconds that a device is believed to have.
const LEAST_SILENCE: u32 = 20;
/// Largest minor version, added to a major version.
const ANY_MINOR: u32 = 0xffff;
/// Most contexts that an identity can state.
const MOST_CONTEXTS: u32 = 255;

/// Refuses a greeting of a device that this driver does not serve.
pub(crate) fn check(greeting: &Greeting) -> Result<(), Fault> {
    let core = &greeting.identity;
    for (what, found, least, most) in [
        ("mark of the link", greeting.magic, LINK_MAGIC, LINK_MAGIC),
        ("version of the link", greeting.link_version, LINK_VERSION, LINK_VERSION | ANY_MINOR),
        ("bytes of the FIFO", greeting.fifo_bytes, MIN_FIFO_BYTES, u32::MAX),
        ("milliseconds of silence", greeting.silence_ms, LEAST_SILENCE, MAX_SILENCE_MS),
        ("mark of the core", core.magic, MAGIC, MAGIC),
        ("version of the protocol", core.protocol_version, OLDEST_PROTOCOL_VERSION, PROTOCOL_VERSION | ANY_MINOR),
        ("bits of a coordinate", core.coord_bits, MIN_COORD_BITS, MAX_COORD_BITS),
        ("number of points", core.capacity, MIN_POINTS, MAX_MODEL_POINTS),
        ("number of contexts", core.contexts, 1, MOST_CONTEXTS),
    ] {
        if !(least..=most).contains(&found) {
            return Err(Fault::Greeting { what, found, least, most });
        }
    }
    Ok(())
}
