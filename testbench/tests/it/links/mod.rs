//! Tests of the serial link, the UDP link and the stream link: the driver in front of simulated boards and cards,
//! models beside pins, and the pages.

mod chip;
mod ether;
mod model;
mod page;
mod pcie;
mod stream_top;
mod terminal;
mod vfio;
mod virtual_time;
