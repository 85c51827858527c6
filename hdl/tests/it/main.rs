//! The tests of the hardware that need no yosys, and Verilator for the files of `hdl/integration` only, in one program.
//! Modules mirror the sources; the blocks themselves are tested in the test bench.

mod command;
mod committed;
mod integration;

mod board {
    mod flow;
    mod pages;
    mod sizes;
}

mod export {
    mod config;
}
