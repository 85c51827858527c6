//! Goes on to the next interval of a hole when the apex of one is known: two clocks for each, one hole at a time.
//!
//! Hardware twin: the block `HoleFill`.

use super::hole::{Base, Hole};
use super::writer::{Job, Writer};
use crate::clock::memory::Memory;
use crate::clock::release_job::ReleaseJob;
use crate::clock::visit::Bundle;
use std::collections::VecDeque;

/// A deletion whose hole is full.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct FillEnd {
    pub context: usize,
    /// Whether no triangle would be left, so that nothing was written.
    pub is_flat: bool,
    pub locks: u32,
    hole: Hole,
}

impl FillEnd {
    /// The release of the locks of the context, if its item ends without a change.
    pub(in super::super) fn release(&self) -> Option<ReleaseJob> {
        self.is_flat.then_some(ReleaseJob { context: self.context, locks: self.locks })
    }
}

/// The next step for the hole at work.
#[derive(Clone, Copy, Debug)]
enum Work {
    /// The apex of the interval is known.
    Step(usize, Hole),
    /// The ends of the next interval are known, and its first test is looked for.
    Look(usize, Hole),
    /// A test is asked for.
    Push(usize, Hole),
    End(FillEnd),
}

#[derive(Clone, Debug)]
pub(super) struct Fill {
    /// The hole that comes to the queue in this clock.
    arrival: Option<(usize, Hole)>,
    queue: VecDeque<(usize, Hole)>,
    /// The first hole in line, which is at work in the clock after the one before it.
    follower: Option<(usize, Hole)>,
    work: Option<Work>,
    /// Intervals of each context that wait.
    waiting: Vec<Vec<(usize, usize)>>,
}

impl Fill {
    pub(super) fn new(contexts: usize) -> Self {
        Self {
            arrival: None,
            queue: VecDeque::new(),
            follower: None,
            work: None,
            waiting: vec![vec![(0, 0); 16]; contexts],
        }
    }

    pub(super) fn push_request(&self) -> Option<Bundle> {
        match self.work {
            Some(Work::Push(context, hole)) => Some(hole.test(context)),
            _ => None,
        }
    }

    pub(super) fn end_request(&self) -> Option<FillEnd> {
        match self.work {
            Some(Work::End(end)) => Some(end),
            _ => None,
        }
    }

    /// A ring is complete, or the apex of an interval is known.
    pub(super) fn arrives(&mut self, context: usize, hole: Hole) {
        self.arrival = Some((context, hole));
    }

    pub(super) fn clock(&mut self, pushes: bool, ends: bool, holes: &mut [Hole], writer: &mut Writer, memory: &Memory) {
        self.queue.extend(self.arrival.take());
        let is_open = self.follower.is_none();
        self.work = match self.work {
            Some(Work::Step(context, hole)) if !writer.is_full() => Some(self.step(context, hole, writer)),
            Some(Work::Look(context, hole)) => Some(go_on(context, hole)),
            Some(Work::Push(context, hole)) if pushes => {
                holes[context] = hole;
                self.follow()
            }
            Some(Work::End(end)) if ends => {
                if !end.is_flat {
                    writer.push(Job::end(end.context, &end.hole, memory.point_id[end.context]));
                }
                self.follow()
            }
            None => self.follow(),
            work => work,
        };
        if is_open {
            self.follower = self.queue.pop_front();
        }
    }

    /// The work on the first hole in line.
    fn follow(&mut self) -> Option<Work> {
        self.follower.take().map(|(context, hole)| match hole.is_new {
            true => Work::Look(context, hole.looked_at()),
            false => go_on(context, hole),
        })
    }

    /// Puts the triangle on the base of the interval, and goes on to the next one.
    fn step(&mut self, context: usize, hole: Hole, writer: &mut Writer) -> Work {
        let apex = hole.apex.unwrap_or(0);
        let (i, j) = (hole.i, hole.j);
        let [left, right] = [hole.next(i) != apex, hole.next(apex) != j];
        if hole.is_dry && left {
            // A triangle stands below the ghost triangle, so the hole can be filled.
            return Work::Look(context, hole.wet());
        }
        if !hole.is_dry {
            writer.push(Job::triangle(context, &hole, apex));
        }
        let mut hole = hole;
        if left && right {
            self.waiting[context][hole.depth] = (apex, j);
            hole.depth += 1;
        }
        match (left, right) {
            (true, _) => Work::Look(context, hole.interval(i, apex, Base::End)),
            (false, true) => Work::Look(context, hole.interval(apex, j, Base::Beginning)),
            (false, false) if hole.depth > 0 => {
                hole.depth -= 1;
                let (i, j) = self.waiting[context][hole.depth];
                Work::Look(context, hole.interval(i, j, Base::Beginning))
            }
            (false, false) => Work::End(FillEnd { context, is_flat: hole.is_dry, locks: hole.locks, hole }),
        }
    }
}

fn go_on(context: usize, hole: Hole) -> Work {
    match hole.apex {
        Some(_) => Work::Step(context, hole),
        None => Work::Push(context, hole),
    }
}
