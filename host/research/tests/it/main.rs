//! The tests of the research package, in one program.

mod command;
mod guides;
mod lloyd;
