//! All tests of the test bench in one program: linking the Verilated models takes longer than most of the tests.

mod blocks;
mod boards;
mod cores;
mod gates;
mod links;
mod project;
mod rig;
