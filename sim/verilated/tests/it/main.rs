//! The tests of the binding, in one test program whose modules mirror the sources.

mod model;
