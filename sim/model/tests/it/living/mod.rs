//! The living engine, clock by clock.

mod defects;
pub mod scripts;
