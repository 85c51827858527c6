//! Checking the greeting of a device.

use incircle_protocol::{
    UdpGreeting, MAX_FIFO_BYTES, MAX_SILENCE_MS, MIN_FIFO_BYTES, UDP_LINK_MAGIC, UDP_LINK_VERSION,
};

use super::codec::Message;
use super::fault::UdpFault;
use crate::transports::identity::check_identity;

/// Shortest silence, in milliseconds, that a device is believed to have.
const LEAST_SILENCE_MS: u32 = 20;

/// The greeting in a message.
///
/// # Errors
/// The greeting is not one of a sound device.
pub(super) fn checked_greeting(message: &Message<'_>) -> Result<UdpGreeting, UdpFault> {
    let mut words = message.words();
    let words = std::array::from_fn(|_| words.next().unwrap_or(0));
    let greeting = UdpGreeting::from_words(words);
    let UdpGreeting { magic, link_version: found, fifo_bytes, silence_ms, .. } = greeting;
    if magic != UDP_LINK_MAGIC {
        return Err(UdpFault::Magic { found: magic, expected: UDP_LINK_MAGIC });
    }
    let expected = UDP_LINK_VERSION;
    if found >> 16 != expected >> 16 || found < expected {
        return Err(UdpFault::Version { found, expected });
    }
    for (what, found, least, most) in [
        ("bytes of FIFO", fifo_bytes, MIN_FIFO_BYTES, MAX_FIFO_BYTES),
        ("milliseconds of silence", silence_ms, LEAST_SILENCE_MS, MAX_SILENCE_MS),
    ] {
        if !(least..=most).contains(&found) {
            return Err(UdpFault::Greeting { what, found, least, most });
        }
    }
    check_identity(&greeting.identity)?;
    Ok(greeting)
}
