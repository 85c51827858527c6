//! The tests of the program `incircle-sim`, in one program. Modules mirror the sources.

mod serve {
    mod pcie;
    mod service;
    mod terminal;
}
