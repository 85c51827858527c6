//! The tests of the hardware that need neither Verilator nor yosys, in one program. Modules mirror the sources; the
//! blocks themselves are tested in the test bench.

mod command;
mod committed;

mod board {
    mod flow;
    mod pages;
    mod sizes;
}

mod export {
    mod config;
}
