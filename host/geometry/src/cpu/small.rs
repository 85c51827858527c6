//! The CPU triangulator for many sets one after the other, in memory that is kept from set to set.

use alloc::boxed::Box;
use alloc::vec::Vec;

use core::marker::PhantomData;

use bytemuck::{Pod, Zeroable};

use super::collect;
use super::conquer::{conquer, Waiting};
use super::edges::{Edges, Half, Halves, SiteList, HALVES};
use super::small_collect::SmallCollect;
use super::small_sites::SmallSites;
use super::triangulator::{check, is_collinear, Error};
use super::view::{Integers, Narrow, Site, Wide, Widest, Width, NARROW_BITS, WIDE_BITS};
use crate::mesh::Mesh;
use crate::pages;
use crate::point::Point;

/// One half of an edge of a small set.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
struct Short {
    next: u16,
    previous: u16,
    end: u16,
    /// Fills up eight bytes, for which processors compute addresses without a multiplication.
    zero: u16,
}

/// Numbers of half-edges with 16 bits.
const SHORTS: usize = 1 << 16;

/// Numbers of 16 bits can only be indices of this list, so no access needs a check of the index.
impl Halves for [Short; SHORTS] {
    const MASK: u32 = 0xffff;
    const GAP: u32 = 1 << 15;

    #[inline(always)]
    fn half(&self, e: u32) -> Half {
        let Short { next, previous, end, .. } = self[usize::from(e as u16)];
        Half { next: next.into(), previous: previous.into(), end: end.into() }
    }

    #[inline(always)]
    fn put(&mut self, e: u32, Half { next, previous, end }: Half) {
        let half = &mut self[usize::from(e as u16)];
        (half.next, half.previous, half.end) = (next as u16, previous as u16, end as u16);
    }

    #[inline(always)]
    fn set_next(&mut self, e: u32, next: u32) {
        self[usize::from(e as u16)].next = next as u16;
    }

    #[inline(always)]
    fn set_previous(&mut self, e: u32, previous: u32) {
        self[usize::from(e as u16)].previous = previous as u16;
    }

    #[inline(always)]
    fn set_end(&mut self, e: u32, end: u32) {
        self[usize::from(e as u16)].end = end as u16;
    }
}

/// Sites, of which all numbers of 16 bits are indices.
impl SiteList<Site> for [Site; SHORTS] {
    #[inline(always)]
    fn site(&self, v: u32) -> Site {
        self[usize::from(v as u16)]
    }
}

/// The CPU triangulator with memory of its own.
#[derive(Debug, Default)]
pub struct Triangulator {
    sites: SmallSites,
    short: Option<Box<[Short; SHORTS]>>,
    table: Option<Box<[Site; SHORTS]>>,
    long: Vec<Half>,
    waiting: Waiting,
    collect: SmallCollect,
}

impl Triangulator {
    /// Makes a triangulator without any memory yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Computes.
    ///
    /// # Errors
    /// There are more than [`MAX_POINTS`](crate::MAX_POINTS) points.
    pub fn triangulate_into(&mut self, points: &[Point], mesh: &mut Mesh) -> Result<(), Error> {
        check(points.len())?;
        mesh.points.clear();
        mesh.points.extend_from_slice(points);
        mesh.duplicates.clear();
        match self.sites.sort(points, &mut mesh.duplicates) {
            ..=NARROW_BITS => self.connect::<Narrow>(mesh),
            ..=WIDE_BITS => self.connect::<Wide>(mesh),
            _ => self.connect::<Widest>(mesh),
        }
        Ok(())
    }

    fn connect<W: Width>(&mut self, mesh: &mut Mesh) {
        let Self { sites: SmallSites { sites, ids, .. }, table, short, long, waiting, collect } = self;
        if is_collinear::<Integers<W>>(sites) {
            mesh.triangles.clear();
            mesh.hull.clear();
            mesh.hull.extend_from_slice(ids);
            mesh.hull.sort_unstable_by_key(|&id| mesh.points[id as usize]);
            return;
        }
        let room = HALVES * sites.len();
        if room <= SHORTS {
            let halves = &mut **short.get_or_insert_with(|| {
                pages::zeros(SHORTS).into_boxed_slice().try_into().unwrap_or_else(|_| unreachable!())
            });
            let table = &mut **table.get_or_insert_with(|| {
                pages::zeros(SHORTS).into_boxed_slice().try_into().unwrap_or_else(|_| unreachable!())
            });
            table[..sites.len()].copy_from_slice(sites);
            halves[..room].fill(Short::zeroed());
            finish::<W, _, _>(table, sites, ids, halves, waiting, collect, mesh);
        } else {
            long.clear();
            long.resize(room, Half::zeroed());
            finish::<W, _, _>(sites.as_slice(), sites, ids, long.as_mut_slice(), waiting, collect, mesh);
        }
    }
}

fn finish<W: Width, H: Halves + ?Sized, S: SiteList<Site> + ?Sized>(
    sites: &S,
    places: &[Site],
    ids: &[u32],
    halves: &mut H,
    waiting: &mut Waiting,
    collect: &mut SmallCollect,
    mesh: &mut Mesh,
) {
    let mut edges = Edges::<Integers<W>, H, S> { kernel: PhantomData, sites, halves, unused: 0 };
    let Some(whole) = conquer(&mut edges, places, waiting, &mut |_| true) else {
        return;
    };
    collect::hull(halves, ids, whole.leftmost(), &mut mesh.hull);
    let count = 2 * ids.len() - 2 - mesh.hull.len();
    collect.triangles(halves, ids, mesh.points.len(), count, &mut mesh.triangles);
}
