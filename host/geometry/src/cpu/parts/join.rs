//! Parts that are all solved, joined into the mesh of the whole set.

use alloc::vec::Vec;
use core::num::NonZeroUsize;
use core::ops::Range;

use super::super::collect::{self, Known};
use super::super::conquer::Waiting;
use super::super::edges::{is_used, Edges, Half, Halves, HALVES};
use super::super::merge::Part;
use super::super::parallel::in_parallel;
use super::super::subtrees::{divide, join, Own};
use super::super::triangulator::{threads_for, Connectivity};
use super::super::view::{Integers, Narrow, Site, Wide, Widest, Width, NARROW_BITS, WIDE_BITS};
use super::guarded::Guarded;
use super::{Parts, SolvedPart, Unsound};
use crate::pages;

/// Groups of parts for each thread: enough for all threads to end at about the same time.
const GROUPS: usize = 8;

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
    fn of(solved: &[SolvedPart], own: &Parts) -> Self {
        let count = solved.iter().map(SolvedPart::border).sum();
        let mut all = Self {
            sites: pages::with_room(count),
            ids: pages::with_room(count),
            halves: pages::zeros(HALVES * count),
            ranges: Vec::with_capacity(solved.len()),
            parts: Vec::with_capacity(solved.len()),
            holes: Vec::new(),
        };
        for (part, range) in solved.iter().zip(&own.ranges) {
            all.ids.extend(part.vertices.iter().map(|&v| own.ids[range.start + v as usize]));
            all.add(part);
        }
        all
    }

    fn add(&mut self, SolvedPart { sites, rings, .. }: &SolvedPart) {
        let first = self.sites.len();
        let (vertex, by) = (first as u32, (HALVES * first) as u32);
        self.sites.extend_from_slice(sites);
        self.ranges.push(first..self.sites.len());
        // The list is zero behind the half-edges of the part, which is the list of its unused pairs.
        for (slot, &Half { next, previous, end }) in self.halves[HALVES * first..].iter_mut().zip(&rings.halves) {
            *slot = Half { next: next + by, previous: previous + by, end: end + vertex };
        }
        self.holes.extend(rings.holes.iter().map(|e| e + by));
        self.parts.push(Some((rings.part.moved(by), by + rings.halves.len() as u32)));
    }

    /// Joins all parts on up to `threads` threads. The half-edges at holes and at the outside are marked. Returns the
    /// hull.
    fn join<W: Width>(&mut self, threads: usize) -> Result<Vec<u32>, Unsound> {
        let groups = self.groups(threads);
        let joined = self.join_groups::<W>(&groups, threads);
        let ranges: Vec<Range<usize>> = groups.iter().map(|group| self.vertices(group)).collect();
        let Self { sites, ids, halves, holes, .. } = self;
        let mut guarded = Guarded::new(halves, 0);
        let whole = join_in::<W>(&mut guarded, sites, &ranges, &joined).map(|(whole, _)| whole);
        let whole: Part = whole.filter(|whole| !whole.is_vertex).ok_or(Unsound)?;
        for &e in holes.iter() {
            let ends = [e, e ^ 1].map(|e| guarded.half(e).end);
            if is_used(ends) {
                guarded.set_end(e, ends[0] | <[Half]>::GAP);
            }
        }
        let mut hull = Vec::new();
        collect::hull(&mut guarded, ids, whole.leftmost(), &mut hull);
        self.is_closed().then_some(hull).ok_or(Unsound)
    }

    /// Whether all used half-edges lead to half-edges of the list, as those of sound parts do.
    fn is_closed(&self) -> bool {
        let end = self.halves.len() as u32;
        let is_closed =
            |pair: &[Half; 2]| !is_used([pair[0].end, pair[1].end]) || pair.iter().all(|half| half.next < end);
        self.halves.as_chunks::<2>().0.iter().all(is_closed)
    }

    /// Runs of parts that are subtrees, so that each thread can join some by itself.
    fn groups(&self, threads: usize) -> Vec<Range<usize>> {
        let largest = self.ranges.iter().map(Range::len).max().unwrap_or(0);
        // A cut of a range with more vertices than the largest part lies between parts.
        let most = if threads < 2 { self.sites.len() } else { (self.sites.len() / (GROUPS * threads)).max(largest) };
        let mut subtrees = Vec::new();
        divide::<Integers<Widest>>(&self.sites, 0..self.sites.len(), most, &mut subtrees);
        let mut first = 0;
        let group = |subtree: Range<usize>| {
            let last = self.ranges.partition_point(|range| range.end <= subtree.end);
            core::mem::replace(&mut first, last)..last
        };
        subtrees.into_iter().map(group).collect()
    }

    /// The vertices of a run of parts.
    fn vertices(&self, group: &Range<usize>) -> Range<usize> {
        let vertex = |part: usize| self.ranges.get(part).map_or(self.sites.len(), |range| range.start);
        vertex(group.start)..vertex(group.end)
    }

    /// Joins the parts of each group.
    fn join_groups<W: Width>(&mut self, groups: &[Range<usize>], threads: usize) -> Vec<Option<Own>> {
        let vertices: Vec<Range<usize>> = groups.iter().map(|group| self.vertices(group)).collect();
        let Self { sites, ranges, parts, halves, .. } = self;
        let (sites, ranges, parts) = (&*sites, &*ranges, &*parts);
        let mut rest = halves.as_mut_slice();
        let mut tasks = Vec::with_capacity(groups.len());
        for (group, vertices) in groups.iter().zip(&vertices) {
            let own = rest.split_off_mut(..HALVES * vertices.len()).unwrap_or_default();
            tasks.push((group.clone(), Guarded::new(own, (HALVES * vertices.start) as u32)));
        }
        let share = tasks.len().div_ceil(threads).max(1);
        let mut tasks = tasks.into_iter();
        let shares: Vec<Vec<_>> = (0..threads).map(|_| tasks.by_ref().take(share).collect()).collect();
        let joined = in_parallel(shares.into_iter(), |own| {
            let join = |(group, mut halves): (Range<usize>, Guarded<'_>)| {
                join_in::<W>(&mut halves, sites, &ranges[group.clone()], &parts[group])
            };
            own.into_iter().map(join).collect::<Vec<_>>()
        });
        joined.into_iter().flatten().collect()
    }
}

/// Joins consecutive parts, whose half-edges are in this range. Returns `None` if a part is missing, or if the merges
/// took too many steps.
fn join_in<W: Width>(
    halves: &mut Guarded<'_>,
    sites: &[Site],
    ranges: &[Range<usize>],
    parts: &[Option<Own>],
) -> Option<Own> {
    let mut edges = Edges::<Integers<W>, _> { sites, halves, unused: 0 };
    let whole = join(&mut edges, sites, ranges, parts, &mut Waiting::new());
    let unused = edges.unused;
    whole.filter(|_| !halves.is_spent()).map(|whole| (whole, unused))
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
        // A thread takes longer to start than a few thousand points take.
        let share = meshes.len().div_ceil(threads_for(self.points, threads).get()).max(1);
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
    /// A part is missing, twice there or from another set, or the meshes do not fit together.
    pub fn join(self, mut solved: Vec<SolvedPart>, threads: NonZeroUsize) -> Result<Connectivity, Unsound> {
        if let Some(collinear) = self.collinear() {
            return Ok(collinear);
        }
        solved.sort_unstable_by_key(|solved| solved.part);
        if solved.len() != self.count() || solved.iter().enumerate().any(|(place, solved)| solved.part != place) {
            return Err(Unsound);
        }
        if !solved.iter().all(|solved| self.has(solved)) {
            return Err(Unsound);
        }
        let threads = threads_for(self.points, threads).get();
        let mut borders = Borders::of(&solved, &self);
        let bits = u32::BITS - (self.far[0] | self.far[1]).leading_zeros();
        let hull = if bits <= NARROW_BITS {
            borders.join::<Narrow>(threads)
        } else if bits <= WIDE_BITS {
            borders.join::<Wide>(threads)
        } else {
            borders.join::<Widest>(threads)
        }?;
        let count = (2 * self.distinct()).checked_sub(2 + hull.len()).ok_or(Unsound)?;
        let parts = solved.iter().zip(&self.ranges);
        let finals: Vec<Known<'_>> =
            parts.map(|(part, range)| Known { triangles: &part.finals, ids: &self.ids[range.clone()] }).collect();
        let Borders { halves, ids, .. } = borders;
        let triangles = collect::triangles_with(halves, &ids, &finals, self.points, count, threads).ok_or(Unsound)?;
        Ok(Connectivity { triangles, hull, duplicates: self.duplicates })
    }

    /// Whether a solved part is one of this set: it has as many points, and its border is some of them, in their order.
    fn has(&self, solved: &SolvedPart) -> bool {
        self.range(solved.part).is_some_and(|range| {
            let own = &self.sites[range];
            let mut border = solved.vertices.iter().zip(&solved.sites);
            own.len() == solved.count && border.all(|(&v, site)| own.get(v as usize) == Some(site))
        })
    }
}
