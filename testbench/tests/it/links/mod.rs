//! The serial link and the stream link: the driver before simulated boards and cards, models beside pins, the pages.

mod model;
mod page;
mod pcie;
mod stream_top;
mod terminal;
mod vfio;
mod virtual_time;
