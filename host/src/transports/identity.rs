//! Checking the identity of a device.

use incircle_protocol::{
    Identity, MAGIC, MAX_COORD_BITS, MAX_MODEL_POINTS, MIN_CONTEXTS, MIN_COORD_BITS, MIN_POINTS,
    OLDEST_PROTOCOL_VERSION, PROTOCOL_VERSION,
};

use crate::error::{DeviceFault, MAX_DEVICE_CONTEXTS, MAX_DEVICE_ENGINES};

/// Refuses an identity that no sound device has. No word of an identity may be used before it passes here.
pub(crate) fn check_identity(identity: &Identity) -> Result<(), DeviceFault> {
    if identity.magic != MAGIC {
        return Err(DeviceFault::Magic { found: identity.magic, expected: MAGIC });
    }
    let (found, expected) = (identity.protocol_version, PROTOCOL_VERSION);
    // An older device would lack commands that the host sends, and counters that it expects.
    if found >> 16 > expected >> 16 || found < OLDEST_PROTOCOL_VERSION {
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
    // Version 1.2 knows one engine: its answers have neither tags nor another order.
    let most = if found >> 16 < 2 { 1 } else { MAX_DEVICE_ENGINES };
    if !(1..=most).contains(&identity.engines) {
        return Err(DeviceFault::Engines(identity.engines));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle_protocol::CORE_VERSION;

    #[test]
    fn version_1_2_has_one_engine() {
        let identity = |protocol_version, engines| Identity {
            magic: MAGIC,
            protocol_version,
            core_version: CORE_VERSION,
            coord_bits: MIN_COORD_BITS,
            capacity: MIN_POINTS,
            contexts: 1,
            engines,
            ring_capacity: 32,
            features: 0,
        };
        for version in [1 << 16 | 2, 1 << 16 | 3] {
            assert_eq!(check_identity(&identity(version, 1)), Ok(()));
            assert_eq!(check_identity(&identity(version, 2)), Err(DeviceFault::Engines(2)));
        }
        for version in [2 << 16, 2 << 16 | 1] {
            assert_eq!(check_identity(&identity(version, 4)), Ok(()));
        }
    }
}
