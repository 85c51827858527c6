//! Checking the identity of a device.

use incircle_protocol::{
    Identity, MAGIC, MAX_COORD_BITS, MAX_MODEL_POINTS, MIN_CONTEXTS, MIN_COORD_BITS, MIN_POINTS, PROTOCOL_VERSION,
};

use crate::error::{DeviceFault, MAX_DEVICE_CONTEXTS};

/// Refuses an identity that no sound device has. No word of an identity may be used before it passes here.
pub(crate) fn check_identity(identity: &Identity) -> Result<(), DeviceFault> {
    if identity.magic != MAGIC {
        return Err(DeviceFault::Magic { found: identity.magic, expected: MAGIC });
    }
    let (found, expected) = (identity.protocol_version, PROTOCOL_VERSION);
    // A device of an older minor version would lack commands that the host sends, and counters that it expects.
    if found >> 16 != expected >> 16 || found < expected {
        return Err(DeviceFault::ProtocolVersion { found, expected });
    }
    if !(MIN_COORD_BITS..=MAX_COORD_BITS).contains(&identity.coord_bits) {
        return Err(DeviceFault::CoordBits(identity.coord_bits));
    }
    if !(MIN_POINTS..=MAX_MODEL_POINTS).contains(&identity.capacity) {
        return Err(DeviceFault::Capacity(identity.capacity));
    }
    if !(MIN_CONTEXTS..=MAX_DEVICE_CONTEXTS).contains(&identity.contexts) {
        return Err(DeviceFault::Contexts(identity.contexts));
    }
    Ok(())
}
