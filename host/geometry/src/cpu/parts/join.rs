//! Parts that are all solved, joined into the mesh of the whole set.

use alloc::vec::Vec;
use core::num::NonZeroUsize;
use core::ops::Range;

use super::super::collect;
use super::super::conquer::Waiting;
use super::super::edges::{is_used, Edges, Half, Halves, HALVES};
use super::super::merge::Part;
use super::super::parallel::in_parallel;
use super::super::subtrees::{join, Own};
use super::super::triangulator::{threads_for, Connectivity};
use super::super::view::{Integers, Narrow, Site, Wide, Widest, Width, NARROW_BITS, WIDE_BITS};
use super::guarded::Guarded;
use super::{Parts, SolvedPart, Unsound};
use crate::pages;

/// The borders of all parts in one list.
struct Borders {
    sites: Vec<Site>,
    ids: Vec<u32>,
    halves: Vec<Half>,
    /// The vertices of each part.
    ranges: Vec<Range<usize>>,
    parts: Vec<Option<Own>>,
    /// The half-edges that have final triangles to their left.
    holes: Vec<u32>,
}

impl Borders {
    fn of(solved: &[SolvedPart]) -> Self {
        let count = solved.iter().map(SolvedPart::border).sum();
        let mut all = Self {
            sites: pages::with_room(count),
            ids: pages::with_room(count),
            halves: pages::zeros(HALVES * count),
            ranges: Vec::with_capacity(solved.len()),
            parts: Vec::with_capacity(solved.len()),
            holes: Vec::new(),
        };
        solved.iter().for_each(|part| all.add(part));
        all
    }

    fn add(&mut self, SolvedPart { sites, ids, rings, .. }: &SolvedPart) {
        let first = self.sites.len();
        let (vertex, by) = (first as u32, (HALVES * first) as u32);
        self.sites.extend_from_slice(sites);
        self.ids.extend_from_slice(ids);
        self.ranges.push(first..self.sites.len());
        // The list is zero behind the half-edges of the part, which is the list of its unused pairs.
        for (slot, &Half { next, previous, end }) in self.halves[HALVES * first..].iter_mut().zip(&rings.halves) {
            *slot = Half { next: next + by, previous: previous + by, end: end + vertex };
        }
        self.holes.extend(rings.holes.iter().map(|e| e + by));
        self.parts.push(Some((rings.part.moved(by), by + rings.halves.len() as u32)));
    }

    /// Joins all parts. The half-edges at holes and at the outside are marked. Returns the hull.
    fn join<W: Width>(&mut self) -> Result<Vec<u32>, Unsound> {
        let Self { sites, ids, halves, ranges, parts, holes } = self;
        let mut guarded = Guarded::new(halves);
        let mut edges = Edges::<Integers<W>, _> { sites, halves: &mut guarded, unused: 0 };
        let whole = join(&mut edges, sites, ranges, parts, &mut Waiting::new()).filter(|whole| !whole.is_vertex);
        let whole: Part = whole.filter(|_| !guarded.is_spent()).ok_or(Unsound)?;
        for &e in holes.iter() {
            let ends = [e, e ^ 1].map(|e| guarded.half(e).end);
            if is_used(ends) {
                guarded.set_end(e, ends[0] | <[Half]>::GAP);
            }
        }
        let mut hull = Vec::new();
        collect::hull(&mut guarded, ids, whole.leftmost(), &mut hull);
        Ok(hull)
    }
}

/// The triangles and the hull of a part; see [`Parts::solved`].
type PartMesh = (Vec<[u32; 3]>, Vec<u32>);

impl Parts {
    /// Joins the meshes of all parts, in the order of the parts: the triangles and the hull of each. See
    /// [`Parts::solved`] and [`Parts::join`], which this function calls on up to `threads` threads.
    ///
    /// # Errors
    /// The errors of both functions.
    pub fn join_meshes(self, meshes: Vec<PartMesh>, threads: NonZeroUsize) -> Result<Connectivity, Unsound> {
        let share = meshes.len().div_ceil(threads.get()).max(1);
        let mut meshes = meshes.into_iter().enumerate();
        let shares = core::iter::from_fn(|| Some(meshes.by_ref().take(share).collect::<Vec<_>>()));
        let shares: Vec<_> = shares.take_while(|share| !share.is_empty()).collect();
        let solve = |own: Vec<(usize, PartMesh)>| -> Result<Vec<SolvedPart>, Unsound> {
            // A mesh is dropped as soon as it is taken, to save memory.
            own.into_iter().map(|(part, (triangles, hull))| self.solved(part, triangles, &hull)).collect()
        };
        let solved = in_parallel(shares.into_iter(), solve);
        let solved: Vec<Vec<SolvedPart>> = solved.into_iter().collect::<Result<_, _>>()?;
        self.join(solved.into_iter().flatten().collect(), threads)
    }

    /// Joins the meshes of all parts, given in any order, into the canonical mesh of the whole set, on up to `threads`
    /// threads.
    ///
    /// # Errors
    /// A part is missing or twice there, or the meshes do not fit together.
    pub fn join(self, mut solved: Vec<SolvedPart>, threads: NonZeroUsize) -> Result<Connectivity, Unsound> {
        if let Some(collinear) = self.collinear() {
            return Ok(collinear);
        }
        solved.sort_unstable_by_key(|solved| solved.part);
        if solved.len() != self.count() || solved.iter().enumerate().any(|(place, solved)| solved.part != place) {
            return Err(Unsound);
        }
        let mut borders = Borders::of(&solved);
        let bits = u32::BITS - (self.far[0] | self.far[1]).leading_zeros();
        let hull = if bits <= NARROW_BITS {
            borders.join::<Narrow>()
        } else if bits <= WIDE_BITS {
            borders.join::<Wide>()
        } else {
            borders.join::<Widest>()
        }?;
        let count = (2 * self.distinct()).checked_sub(2 + hull.len()).ok_or(Unsound)?;
        let finals: Vec<Vec<[u32; 3]>> = solved.into_iter().map(|solved| solved.finals).collect();
        let threads = threads_for(self.points, threads).get();
        let Borders { halves, ids, .. } = borders;
        let triangles = collect::triangles_with(halves, &ids, &finals, self.points, count, threads).ok_or(Unsound)?;
        Ok(Connectivity { triangles, hull, duplicates: self.duplicates })
    }
}
