//! Lock-step, end-to-end and gate tests of incircle.
