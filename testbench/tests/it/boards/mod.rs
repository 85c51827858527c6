//! Tests of the boards' tops, and of the files that belong to one board.

mod acorn;
mod tops;
mod tops_on_network;
