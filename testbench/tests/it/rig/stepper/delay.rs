//! A pipeline in a reference: what goes in comes out some clocks later.

use std::collections::VecDeque;

/// Values that come out a number of clocks after they went in.
pub struct Delay<T>(VecDeque<Option<T>>);

impl<T> Delay<T> {
    /// A pipeline of so many clock edges, empty at first.
    pub fn new(edges: usize) -> Self {
        Self((0..edges).map(|_| None).collect())
    }

    /// The value of that many calls ago; nothing at first.
    pub fn pass(&mut self, value: T) -> Option<T> {
        self.0.push_back(Some(value));
        self.0.pop_front().flatten()
    }
}
