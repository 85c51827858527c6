//! The living engine, clock by clock.

mod scripts;
