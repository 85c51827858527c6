//! Cores behind stream links, with one context: their answers are then those of the model by commands. A chip of two
//! engines as well.

use incircle_hdl::export;
use incircle_protocol::{Config, SMALL, TINY};

const TOPS: [(&str, Config, u32); 3] = [
    ("stream_tiny_64", Config { contexts: 1, ..TINY }, 64),
    ("stream_dual_tiny_64", Config { contexts: 1, engines: 2, ..TINY }, 64),
    ("stream_small_128", Config { contexts: 1, ..SMALL }, 128),
];

/// Name and Verilog of every device.
pub fn all() -> Vec<(&'static str, String)> {
    TOPS.map(|(name, config, beat_bits)| {
        let verilog = export::stream_top(config, beat_bits, false);
        (name, verilog.unwrap_or_else(|error| panic!("device {name}: {error}")))
    })
    .into()
}
