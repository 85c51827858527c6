//! The tests of the program `incircle-sim`, in one test program whose modules mirror the sources.

mod serve {
    mod network;
    mod pcie;
    mod service;
    mod terminal;
}
