//! A pipeline for references: a value comes out some clocks after it went in.

use std::collections::VecDeque;

/// Values that come out a number of clocks after they went in.
pub struct Delay<T>(VecDeque<Option<T>>);

impl<T> Delay<T> {
    /// Makes an empty pipeline of this many clock edges.
    pub fn new(edges: usize) -> Self {
        Self((0..edges).map(|_| None).collect())
    }

    /// Takes a value, and returns the value of that many calls ago; `None` at first.
    pub fn pass(&mut self, value: T) -> Option<T> {
        self.0.push_back(Some(value));
        self.0.pop_front().flatten()
    }
}
