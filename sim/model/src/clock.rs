//! The core, clock by clock.
