//! A queue of items for each context, and the order in which contexts begin.
//!
//! Hardware twin: the block `ItemQueues`.

use super::signals::Item;
use std::collections::VecDeque;

/// Most items that wait for a context.
const DEPTH: usize = 32;

#[derive(Clone, Debug)]
pub(super) struct ItemQueues {
    /// Whether a context has no item.
    idle: Vec<bool>,
    waiting: Vec<VecDeque<Item>>,
    /// The items that the memory gives in this clock and in the next.
    fetched: [Option<(usize, Item)>; 2],
    /// The item on offer before, which joins the line in this clock, and the line of items that begin, each with its
    /// context.
    joined: Option<(usize, Item)>,
    beginners: VecDeque<(usize, Item)>,
}

impl ItemQueues {
    pub(super) fn new(contexts: usize) -> Self {
        Self {
            idle: vec![true; contexts],
            waiting: vec![VecDeque::new(); contexts],
            fetched: [None; 2],
            joined: None,
            beginners: VecDeque::new(),
        }
    }

    /// Whether no context has an item.
    pub(super) fn rests(&self) -> bool {
        self.idle.iter().all(|&idle| idle)
    }

    /// The first item in the line, with its context. An item that joins the line stands in it at once.
    pub(super) fn first(&self) -> Option<(usize, Item)> {
        self.beginners.front().copied().or(self.fetched[0]).or(self.joined)
    }

    /// Simulates one edge, with an item on offer and a context whose item ends. The first item may leave the line.
    /// Returns whether the item on offer is taken.
    pub(super) fn clock(&mut self, offer: Option<(usize, Item)>, ends: Option<usize>, leaves: bool) -> bool {
        let [comes, comes_next] = self.fetched;
        let begins = offer.filter(|&(context, _)| self.idle[context] && comes_next.is_none());
        let stores = offer.filter(|&(context, _)| {
            !self.idle[context] && self.waiting[context].len() < DEPTH && ends != Some(context)
        });
        self.beginners.extend(comes.or(self.joined));
        self.joined = begins;
        if leaves {
            self.beginners.pop_front();
        }
        if let Some((context, _)) = begins {
            self.idle[context] = false;
        }
        let fetched = ends.and_then(|context| {
            let item = self.waiting[context].pop_front();
            self.idle[context] = item.is_none();
            Some((context, item?))
        });
        self.fetched = [comes_next, fetched];
        if let Some((context, item)) = stores {
            self.waiting[context].push_back(item);
        }
        begins.is_some() || stores.is_some()
    }
}
