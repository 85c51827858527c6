//! The arguments of a job on a back end.

use std::time::Duration;

use clap::Args;
use incircle::{Options, Order, ProgressListener};

use crate::values::{order_parser, seconds_from, whole_number};

/// The choices for a job that change its time and never the mesh.
#[derive(Debug, Args)]
pub struct JobArguments {
    /// Insertions in flight at once (default: all contexts of the back end)
    ///
    /// The number changes the time, never the mesh.
    #[arg(long, value_name = "N", value_parser = whole_number(1, u32::MAX))]
    pub contexts: Option<u32>,
    /// Insertion order
    ///
    /// The order changes the time, never the mesh. Default: brio-hilbert.
    #[arg(long, value_parser = order_parser())]
    pub order: Option<Order>,
    /// Seconds that a job may take (default: 60, and 0.002 for each point)
    ///
    /// A slow simulated device has more by default.
    #[arg(long, value_name = "SECONDS", value_parser = seconds_from)]
    pub timeout: Option<Duration>,
}

impl JobArguments {
    /// The order of the arguments, or else the default order.
    pub fn order(&self) -> Order {
        self.order.unwrap_or_default()
    }

    /// The library's options for a job whose progress goes to `listener`.
    pub fn options<'a>(&self, listener: ProgressListener<'a>) -> Options<'a> {
        Options::default().timeout(self.timeout).order(self.order()).contexts(self.contexts).progress(listener)
    }

    /// Whether the choices have a meaning only for a back end that inserts points one by one.
    pub fn wants_insertion(&self) -> bool {
        self.order.is_some() || self.contexts.is_some()
    }
}
