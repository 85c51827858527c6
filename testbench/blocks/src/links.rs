//! Configurations of the serial link that are quick to simulate.

use incircle_protocol::LinkConfig;

/// A link that is quick to simulate: fewer than nine clocks a bit at the first rate, a
/// short silence, and the smallest FIFO.
pub const QUICK_LINK: LinkConfig = LinkConfig { clock_hz: 1_000_000, fifo_bytes: 2_048, silence_ms: 400 };

/// The quick link with a silence so short that the link forgets its session at once.
pub const HASTY_LINK: LinkConfig = LinkConfig { silence_ms: 20, ..QUICK_LINK };
