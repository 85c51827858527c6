//! The living engine, clock by clock.

mod defects;
mod scripts;
