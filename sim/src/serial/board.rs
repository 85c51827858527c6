//! The parameters of simulated boards, in a file that the build script reads too.

use incircle_protocol::{Config, LinkConfig, SMALL};

/// The serial link of a simulated board: that of a real board with a shorter silence, because the real silence would
/// take minutes to simulate.
pub const fn board_link(config: Config) -> LinkConfig {
    let fifo_bytes = if config.points <= SMALL.points { 4096 } else { 16_384 };
    LinkConfig { clock_hz: 125_000_000, fifo_bytes, silence_ms: 200 }
}
