//! What simulated boards have; the build script reads this file too.

use incircle_protocol::{Config, LinkConfig, SMALL};

/// The link of a simulated board: that of a real one, but for its silence, which would take minutes to simulate.
pub const fn board_link(config: Config) -> LinkConfig {
    let fifo_bytes = if config.points <= SMALL.points { 4096 } else { 16_384 };
    LinkConfig { clock_hz: 125_000_000, fifo_bytes, silence_ms: 200 }
}
