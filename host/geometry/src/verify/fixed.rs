//! The validator's pieces of constraints: each constraint is cut at all points on it.
//!
//! A sweep goes over the points from left to right, in lexicographic order, and keeps the constraints that it has met
//! and not left, from the lowest to the highest. Constraints that overlap are one strand. At each point the strands
//! through it end a piece there, and those that go on begin the next. O(n log n) for points and constraints, however
//! many of them overlap or meet at one point.
//!
//! Where constraints cross, the strands lose their order. No wrong mesh is accepted because of that: pieces then are
//! missing or pass through points, so either the end of a constraint is not found, or some piece is no edge of any
//! mesh.

use alloc::vec;
use alloc::vec::Vec;
use core::cmp::Ordering;

use super::error::VerifyError;
use super::exact::ExactPoint;
use super::sites::Sites;
use super::strands::{Gap, Strand, Strands};

/// An edge that constraints fix. `from` is the lexicographically smaller end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Piece {
    pub from: u32,
    pub to: u32,
    /// The number of constraints of the boundary along the piece.
    pub count: i64,
    /// The same, with those that run from `to` to `from` counted down.
    pub turns: i64,
}

/// The piece at a place, or directly below it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Under {
    /// The place is on this piece.
    On(usize),
    /// The place is on no piece, and this is the next one below.
    Piece(usize),
    /// The place is on no piece, and there is none below.
    Nothing,
}

/// The pieces of all constraints, and where they lie.
pub(super) struct Pieces {
    /// Each piece once.
    pub list: Vec<Piece>,
    /// The piece directly below each point from which pieces run to the right and none to the left.
    pub under: Vec<Under>,
    /// The piece at each mark, or directly below it.
    pub marks: Vec<Under>,
}

/// Constraints with the same ends, by the ranks of these points in lexicographic order.
#[derive(Clone, Copy)]
struct Line {
    ranks: [u32; 2],
    count: i64,
    turns: i64,
    /// The number of one of these constraints.
    constraint: usize,
}

/// A constraint, or a strand, that leaves a point to the right.
#[derive(Clone, Copy)]
struct Leaving {
    strand: Strand,
    /// Whether the strand comes from the left.
    goes_on: bool,
}

struct Sweep<'a, P> {
    sites: &'a Sites<'a, P>,
    strands: Strands,
    /// The lines, by their first ends and by their last ones, of which the first have been met.
    starts: &'a [Line],
    ends: &'a [Line],
    pieces: Pieces,
}

/// Cuts constraints into pieces. The first `boundary` constraints bound the domain. `marks` are places of which it is
/// asked what lies under them.
pub(super) fn pieces<P: ExactPoint>(
    sites: &Sites<'_, P>,
    constraints: &[[u32; 2]],
    boundary: usize,
    marks: &[P],
) -> Result<Pieces, VerifyError> {
    let starts = lines(sites, constraints, boundary)?;
    let mut ends = starts.clone();
    ends.sort_unstable_by_key(|line| line.ranks[1]);
    let mut order: Vec<usize> = (0..marks.len()).collect();
    order.sort_unstable_by(|&one, &other| marks[one].compare(&marks[other]));
    let mut order = order.into_iter().peekable();
    let pieces = Pieces {
        list: Vec::new(),
        under: vec![Under::Nothing; sites.points.len()],
        marks: vec![Under::Nothing; marks.len()],
    };
    let mut sweep = Sweep { sites, strands: Strands::default(), starts: &starts, ends: &ends, pieces };
    for (rank, &point) in (0u32..).zip(&sites.distinct) {
        let at = sites.at(point);
        while let Some(mark) = order.next_if(|&mark| marks[mark].compare(&at).is_lt()) {
            sweep.pieces.marks[mark] = sweep.under(marks[mark]);
        }
        let met = sweep.meet(rank, point)?;
        while let Some(mark) = order.next_if(|&mark| marks[mark].compare(&at).is_eq()) {
            sweep.pieces.marks[mark] = met.map_or_else(|| sweep.under(at), Under::On);
        }
    }
    Ok(sweep.pieces)
}

/// The constraints from left to right, sorted by their first ends. Those between equal points are left out, and those
/// with the same ends are one.
fn lines<P: ExactPoint>(
    sites: &Sites<'_, P>,
    constraints: &[[u32; 2]],
    boundary: usize,
) -> Result<Vec<Line>, VerifyError> {
    let mut ranks = vec![0; sites.points.len()];
    (0..).zip(&sites.distinct).for_each(|(rank, &point)| ranks[point as usize] = rank);
    let mut lines = Vec::with_capacity(constraints.len());
    for (constraint, ends) in constraints.iter().enumerate() {
        let mut own = [0; 2];
        for (rank, &index) in own.iter_mut().zip(ends) {
            let points = sites.points.len();
            let lowest = sites.lowest.get(index as usize);
            *rank = ranks[*lowest.ok_or(VerifyError::ConstraintOutOfRange { constraint, index, points })? as usize];
        }
        let [from, to] = own;
        let count = i64::from(constraint < boundary);
        let turns = if from > to { -count } else { count };
        if from != to {
            lines.push(Line { ranks: [from.min(to), from.max(to)], count, turns, constraint });
        }
    }
    lines.sort_unstable_by_key(|line| line.ranks);
    lines.dedup_by(|later, kept| {
        let is_same = later.ranks == kept.ranks;
        if is_same {
            kept.count += later.count;
            kept.turns += later.turns;
        }
        is_same
    });
    Ok(lines)
}

/// The lines at the front of a list whose end this is. They are taken off the list.
fn split<'a>(lines: &mut &'a [Line], end: usize, rank: u32) -> &'a [Line] {
    let (own, rest) = lines.split_at(lines.iter().take_while(|line| line.ranks[end] == rank).count());
    *lines = rest;
    own
}

impl<P: ExactPoint> Sweep<'_, P> {
    /// The gap below all strands that are on a place or above it.
    fn gap(&self, q: P) -> Gap {
        self.strands.find(|strand| strand.side(self.sites, q).is_gt())
    }

    fn under(&self, q: P) -> Under {
        let gap = self.gap(q);
        match self.strands.above(gap).filter(|strand| strand.side(self.sites, q).is_eq()) {
            Some(strand) => Under::On(strand.piece),
            None => self.strands.below(gap).map_or(Under::Nothing, |strand| Under::Piece(strand.piece)),
        }
    }

    /// Goes over a point. Returns one of the pieces at it.
    fn meet(&mut self, rank: u32, point: u32) -> Result<Option<usize>, VerifyError> {
        let q = self.sites.at(point);
        let (new, ending) = (split(&mut self.starts, 0, rank), split(&mut self.ends, 1, rank));
        let mut gap = self.gap(q);
        let mut arriving: Vec<Strand> = Vec::new();
        while let Some(&strand) = self.strands.above(gap).filter(|strand| strand.side(self.sites, q).is_eq()) {
            self.pieces.list[strand.piece].to = point;
            arriving.push(strand);
            gap = self.strands.remove(gap);
        }
        if arriving.is_empty() {
            let below = self.strands.below(gap);
            self.pieces.under[point as usize] = below.map_or(Under::Nothing, |strand| Under::Piece(strand.piece));
        }
        for line in ending {
            self.end(line, &mut arriving, q)?;
        }
        let any = arriving.first().map(|strand| strand.piece);
        let leaving = self.leaving(point, &arriving, new);
        // Of edges that do not cross there are fewer than three for each point.
        if self.pieces.list.len() + leaving.len() > 3 * self.sites.distinct.len() {
            let constraint = new.iter().chain(self.ends).next().map_or(0, |line| line.constraint);
            return Err(VerifyError::ConstraintsCross { constraint });
        }
        let first = self.pieces.list.len();
        let any = any.or((!leaving.is_empty()).then_some(first));
        for mut strand in leaving {
            strand.piece = self.pieces.list.len();
            let Strand { count, turns, .. } = strand;
            self.pieces.list.push(Piece { from: point, to: point, count, turns });
            gap = self.strands.insert(gap, strand);
        }
        Ok(any)
    }

    /// Takes a line that ends at a point out of its strand, one of those that arrive there in rising order.
    fn end(&self, line: &Line, arriving: &mut [Strand], q: P) -> Result<(), VerifyError> {
        let start = self.sites.at(self.sites.distinct[line.ranks[0] as usize]);
        let side = |strand: &Strand| P::orient2d(self.sites.at(strand.line[0]), q, start);
        let place = arriving.partition_point(|strand| side(strand).is_gt());
        let found = arriving.get_mut(place).filter(|strand| side(strand).is_eq() && strand.lines > 0);
        let strand = found.ok_or(VerifyError::ConstraintsCross { constraint: line.constraint })?;
        strand.lines -= 1;
        strand.count -= line.count;
        strand.turns -= line.turns;
        Ok(())
    }

    /// The strands that leave a point, in rising order: those that go on, and those of new lines. Strands of one
    /// direction are one.
    fn leaving(&self, point: u32, arriving: &[Strand], new: &[Line]) -> Vec<Strand> {
        let going = arriving.iter().filter(|strand| strand.lines > 0);
        let going = going.map(|&strand| Leaving { strand, goes_on: true });
        let new = new.iter().map(|line| {
            let to = self.sites.distinct[line.ranks[1] as usize];
            let strand =
                Strand { line: [point, to], lines: 1, count: line.count, turns: line.turns, piece: usize::MAX };
            Leaving { strand, goes_on: false }
        });
        let mut all: Vec<Leaving> = going.chain(new).collect();
        all.sort_by(|one, other| self.compare(point, one, other));
        all.dedup_by(|later, kept| {
            let is_same = self.compare(point, later, kept).is_eq();
            if is_same {
                kept.strand.lines += later.strand.lines;
                kept.strand.count += later.strand.count;
                kept.strand.turns += later.strand.turns;
            }
            is_same
        });
        all.into_iter().map(|leaving| leaving.strand).collect()
    }

    /// Compares the directions in which two strands leave a point, from the lowest on.
    fn compare(&self, point: u32, one: &Leaving, other: &Leaving) -> Ordering {
        let turn = |a: u32, b: u32, c: u32| P::orient2d(self.sites.at(a), self.sites.at(b), self.sites.at(c));
        let ([a, b], [c, d]) = (one.strand.line, other.strand.line);
        match (one.goes_on, other.goes_on) {
            // What comes from above goes on below.
            (true, true) => turn(a, point, c),
            (true, false) => turn(a, point, d).reverse(),
            (false, true) => turn(c, point, b),
            (false, false) => turn(point, b, d).reverse(),
        }
    }
}

/// Checks that the constraints of the boundary begin as often as they end at each point, or, if it only matters how
/// many there are, that their number at each point is even. Pieces then do the same, as each goes from point to point.
pub(super) fn check_closed<P: ExactPoint>(
    sites: &Sites<'_, P>,
    boundary: &[[u32; 2]],
    is_directed: bool,
) -> Result<(), VerifyError> {
    let mut ends = vec![[0usize; 2]; sites.points.len()];
    for pair in boundary {
        for (side, &index) in pair.iter().enumerate() {
            ends[sites.lowest[index as usize] as usize][side] += 1;
        }
    }
    for (point, [begin, end]) in (0..).zip(ends) {
        if is_directed && begin != end {
            return Err(VerifyError::Unbalanced { point, begin, end });
        }
        if (begin + end) % 2 != 0 {
            return Err(VerifyError::Open { point, count: begin + end });
        }
    }
    Ok(())
}
