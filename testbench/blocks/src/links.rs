//! Links in front of the blocks of the serial link, quick to simulate.

use incircle_protocol::LinkConfig;

/// A link that is quick to simulate: under nine clocks a bit at the first rate, short silence, and the smallest FIFO.
pub const QUICK_LINK: LinkConfig = LinkConfig { clock_hz: 1_000_000, fifo_bytes: 2_048, silence_ms: 400 };

/// The same, and forgets its session at once.
pub const HASTY_LINK: LinkConfig = LinkConfig { silence_ms: 20, ..QUICK_LINK };
