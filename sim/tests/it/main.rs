//! The tests of the program `incircle-sim`, in one test program whose modules mirror the sources.

mod living;
mod own_test;
mod painter;
mod serve {
    mod network;
    mod pcie;
    pub mod service;
    mod tap;
    mod terminal;
}
