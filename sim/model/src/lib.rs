//! Bit-exact software model of the incircle core.
