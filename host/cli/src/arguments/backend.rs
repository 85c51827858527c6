//! The arguments that choose a back end.

use std::num::NonZeroU32;

use clap::{Args, ValueEnum};
use incircle::DeviceAddress;

use crate::failure::{failure_of, Failure};
use crate::values::{backend_parser, threads_from};

/// The back end that does the work.
#[derive(Clone, Debug, Args)]
pub struct BackendArguments {
    /// Back end
    ///
    /// - cpu: the CPU triangulator, the fastest on a usual computer
    /// - model: the software model of the core
    /// - clock: the model of the core, clock by clock
    /// - sim: the core's Verilog in Verilator; needs a build with `--features sim`
    /// - serial:PORT: a board at a serial port, such as serial:/dev/ttyUSB0
    /// - udp:HOST: a device on the network, such as udp:192.168.1.50; udp:HOST:PORT names its port
    /// - pcie:N: the card N in a PCIe slot; pcie:DIR is a card by the directory of its files
    ///
    /// Choices follow a question mark, as in cpu?threads=2, model?coord-bits=20&capacity=5000,
    /// clock?config=full or serial:/dev/ttyUSB0?baud=12000000.
    ///
    /// Default: 'triangulate' takes 'cpu', or 'model' if --order or --contexts is given.
    /// 'replay' and 'tile local' take 'cpu', and all other commands 'model'.
    ///
    /// 'triangulate' takes several, each with a --backend of its own: they share the work on the set.
    #[arg(long, value_parser = backend_parser(), verbatim_doc_comment)]
    pub backend: Vec<DeviceAddress>,
    /// Threads of the back end 'cpu' (default: one per processor)
    ///
    /// A small set takes fewer: one thread, and one more for every full 16,384 points.
    #[arg(long, value_name = "N", value_parser = threads_from)]
    pub threads: Option<NonZeroU32>,
    /// Core of 'clock' and 'sim'
    ///
    /// Without this option the core is the smallest one that holds the points.
    #[arg(long, value_enum)]
    pub config: Option<ConfigName>,
}

impl BackendArguments {
    /// Whether several back ends are given.
    pub fn is_several(&self) -> bool {
        self.backend.len() > 1
    }

    /// The back end of the arguments, or else the one at the address `default`. Refuses several.
    pub fn or(&self, default: &str) -> Result<DeviceAddress, Failure> {
        match &self.backend[..] {
            [] => default.parse().map_err(|error| failure_of(&error)),
            [only] => Ok(only.clone()),
            several => Err(Failure::usage(format!(
                "{} back ends are given, but this command takes one: leave out all but one --backend",
                several.len()
            ))),
        }
    }
}

/// The named configurations of the core.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ConfigName {
    /// 8 points, 2 contexts
    Tiny,
    /// 1024 points, 16 contexts
    Small,
    /// 8192 points, 16 contexts
    Full,
    /// 16384 points, 24 contexts
    Large,
    /// 2 engines, each with 4096 points, 16 contexts
    Dual,
    /// 4 engines, each with 2048 points, 16 contexts
    Quad,
}

impl ConfigName {
    /// The configuration that has this name.
    pub fn config(self) -> incircle_protocol::Config {
        match self {
            Self::Tiny => incircle_protocol::TINY,
            Self::Small => incircle_protocol::SMALL,
            Self::Full => incircle_protocol::FULL,
            Self::Large => incircle_protocol::LARGE,
            Self::Dual => incircle_protocol::DUAL,
            Self::Quad => incircle_protocol::QUAD,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_configuration_has_its_name() {
        for name in ConfigName::value_variants() {
            let shown = name.to_possible_value().map(|value| value.get_name().to_owned());
            assert_eq!(shown.as_deref(), Some(name.config().name));
        }
    }
}
