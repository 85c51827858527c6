//! All pairs of segments that cross, by a sweep from left to right.
//!
//! The sweep keeps the lines that it has met and not left yet in their order from the lowest to the highest. All ends
//! of lines have whole coordinates, so it stops at whole x only. Two lines that cross change places at the next whole
//! x, and directly before that they are neighbours, or others cross between them at the same stop. So it is enough to
//! ask every two lines that become neighbours whether they cross, and at which stop. Then neighbours that have to be in
//! the other order change places, in any sequence, until there are none: each change is one crossing (Bentley and
//! Ottmann, *Algorithms for reporting and counting geometric intersections*, 1979, here without an order of the
//! crossings between two stops, so that no fraction is compared with another).
//!
//! Lines that cross at a whole x are in the old order up to there, and in the new one from there on. Lines along one
//! straight line, which never cross, are in the order of their numbers. Vertical lines are not in the list: each asks
//! for the lines between its ends.

use alloc::collections::BinaryHeap;
use alloc::vec::{self, Vec};
use core::cmp::Reverse;
use core::iter::Peekable;

use super::pixels::Segment;
use super::status::Status;

/// A pair of neighbours that cross: the whole x at which they change places, whether they cross at that x itself and
/// not before, and the lower and the upper line.
type Event = Reverse<(u32, bool, u32, u32)>;

/// The state of the sweep.
struct Sweep<'a, T> {
    /// The segments, each from left to right.
    lines: &'a [Segment],
    status: Status,
    events: BinaryHeap<Event>,
    /// Gets the numbers of two lines that cross.
    take: T,
}

/// Calls `take` with the numbers of every two segments that cross inside both. O((n + k) log n) for `n` segments and
/// `k` crossings, and a move of up to n/64 numbers every 64 insertions.
///
/// # Errors
/// Those of `take`, which end the search.
pub(super) fn each_crossing<E>(segments: &[Segment], take: impl FnMut(u32, u32) -> Result<(), E>) -> Result<(), E> {
    let lines: Vec<Segment> = segments.iter().map(Segment::rightward).collect();
    let [left, right] = [0, 1].map(|end| {
        let lines = &lines;
        move |&number: &u32| lines[number as usize].0[end].x
    });
    let is_wide = |line: &Segment| line.0[0].x < line.0[1].x;
    let is_upright = |line: &Segment| line.0[0].x == line.0[1].x && line.0[0].y < line.0[1].y;
    let [mut starts, mut ends] = [numbers(&lines, is_wide, left), numbers(&lines, is_wide, right)];
    let mut upright = numbers(&lines, is_upright, left);
    let mut sweep = Sweep { lines: &lines, status: Status::new(lines.len()), events: BinaryHeap::new(), take };
    loop {
        // After the last end the list is empty, and so are the events.
        let next = [starts.peek().map(left), ends.peek().map(right), upright.peek().map(left), sweep.next_event()];
        let Some(x) = next.into_iter().flatten().min() else { return Ok(()) };
        sweep.exchange(x, false)?;
        while let Some(line) = ends.next_if(|line| right(line) == x) {
            sweep.leave(line);
        }
        sweep.exchange(x, true)?;
        while let Some(line) = upright.next_if(|line| left(line) == x) {
            sweep.pass(line)?;
        }
        while let Some(line) = starts.next_if(|line| left(line) == x) {
            sweep.meet(line);
        }
    }
}

/// The numbers of some lines, in the order of a coordinate.
fn numbers(
    lines: &[Segment],
    choose: impl Fn(&Segment) -> bool,
    x: impl Fn(&u32) -> u32,
) -> Peekable<vec::IntoIter<u32>> {
    let all = (0u32..).zip(lines).filter(|(_, line)| choose(line));
    let mut own: Vec<u32> = all.map(|(number, _)| number).collect();
    own.sort_unstable_by_key(x);
    own.into_iter().peekable()
}

impl<E, T: FnMut(u32, u32) -> Result<(), E>> Sweep<'_, T> {
    fn next_event(&self) -> Option<u32> {
        self.events.peek().map(|Reverse((x, ..))| *x)
    }

    fn line(&self, number: u32) -> &Segment {
        &self.lines[number as usize]
    }

    /// Exchanges neighbours that cross at this x (`is_at`), or else strictly between this x and the whole x before.
    fn exchange(&mut self, x: u32, is_at: bool) -> Result<(), E> {
        while let Some(&Reverse((next, at, lower, upper))) = self.events.peek() {
            if (next, at) != (x, is_at) {
                break;
            }
            self.events.pop();
            // Other lines may have come between both, and the pair may have changed places already.
            if self.status.is_above(lower, upper) {
                (self.take)(lower, upper)?;
                self.status.swap(lower, upper);
                self.look(self.status.below(upper), Some(upper));
                self.look(Some(lower), self.status.above(lower));
            }
        }
        Ok(())
    }

    /// Takes a line out of the list.
    fn leave(&mut self, line: u32) {
        let (below, above) = (self.status.below(line), self.status.above(line));
        self.status.remove(line);
        self.look(below, above);
    }

    /// Puts a line into the list.
    fn meet(&mut self, line: u32) {
        let lines = self.lines;
        let own = &lines[line as usize];
        self.status.insert(line, |other| {
            let (segment, start) = (&lines[other as usize], own.0[0]);
            let turn = segment.side(start).cmp(&0).then_with(|| own.rises_above(segment));
            turn.then_with(|| line.cmp(&other)).is_gt()
        });
        self.look(self.status.below(line), Some(line));
        self.look(Some(line), self.status.above(line));
    }

    /// Finds the crossings of a vertical line.
    fn pass(&mut self, line: u32) -> Result<(), E> {
        let ([low, high], lines) = (self.line(line).0, self.lines);
        let met = self.status.not_below(|other| lines[other as usize].side(low) >= 0);
        for other in met.take_while(|&other| lines[other as usize].side(high) > 0) {
            (self.take)(line, other)?;
        }
        Ok(())
    }

    /// Notes the crossing of two lines that have become neighbours.
    fn look(&mut self, below: Option<u32>, above: Option<u32>) {
        let (Some(lower), Some(upper)) = (below, above) else { return };
        let (one, other) = (self.line(lower), self.line(upper));
        if one.rises_above(other).is_gt() && one.crosses(other) {
            let (x, is_at) = one.stop(other);
            self.events.push(Reverse((x, is_at, lower, upper)));
        }
    }
}
