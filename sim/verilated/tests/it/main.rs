//! The tests of the binding, in one program. Modules mirror the sources.

mod model;
