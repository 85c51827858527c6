//! Tests of the living mesh against brute force, after every command of random scripts.

mod brute;
mod changes;
mod constraints;
mod frames;
mod reports;
mod scripts;
mod structure;
