//! Cutting a clip down to a cell, neighbour by neighbour.

use alloc::vec::Vec;
use core::mem;

use super::clip::Clip;
use super::clipped::ClippedCell;
use super::cut::Cutter;
use super::ring_list::{Item, RingList};
use super::view::{Bend, View};
use crate::point::Point;

/// The rings of one clipped cell, and the memory in which they are made.
pub(crate) struct Clipper<'a> {
    points: &'a [Point],
    clip: &'a Clip,
    cutter: Cutter,
    /// The rings after the cuts so far, and a second list into which the next cut writes.
    rings: RingList,
    spare: RingList,
    /// The rings of the cell, one behind the other, and how many corners each has.
    bends: Vec<Bend>,
    counts: Vec<usize>,
}

impl<'a> Clipper<'a> {
    pub(crate) fn new(points: &'a [Point], clip: &'a Clip) -> Self {
        Self {
            points,
            clip,
            cutter: Cutter::default(),
            rings: RingList::default(),
            spare: RingList::default(),
            bends: Vec::new(),
            counts: Vec::new(),
        }
    }

    pub(super) fn clip(&self) -> &'a Clip {
        self.clip
    }

    /// Forgets the last cell.
    pub(crate) fn clear(&mut self) {
        self.bends.clear();
        self.counts.clear();
    }

    /// Takes a ring as it is.
    pub(super) fn take(&mut self, ring: impl Iterator<Item = Bend>) {
        self.bends.extend(ring);
        self.counts.push(self.bends.len());
    }

    /// Cuts the clip by the border of the cell of `p` with each neighbour. The corners that are left do not depend on
    /// the order of the neighbours, nor on further points whose cells meet that of `p` in a corner alone.
    pub(crate) fn cut(&mut self, p: Point, neighbors: impl Iterator<Item = u32>) {
        self.rings.clear();
        self.rings.items.push(Item::Run([0, self.clip.corners().len() as u32]));
        self.rings.counts.push(1);
        self.cut_rings(p, neighbors);
    }

    /// Cuts rings by the border with each neighbour, and takes what is left as the cell.
    fn cut_rings(&mut self, p: Point, neighbors: impl Iterator<Item = u32>) {
        let view = View { p, points: self.points, clip: self.clip };
        for neighbor in neighbors {
            self.spare.clear();
            self.cutter.cut(&self.rings, view, neighbor, &mut self.spare);
            mem::swap(&mut self.rings, &mut self.spare);
            if self.rings.counts.is_empty() {
                return;
            }
        }
        self.rings.write_out(self.clip, &mut self.bends, &mut self.counts);
    }

    /// The last cell, as that of point `p`, whose index is given.
    pub(crate) fn cell(&self, p: Point, point: u32) -> ClippedCell<'_> {
        ClippedCell { p, point, points: self.points, clip: self.clip, bends: &self.bends, counts: &self.counts }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::voronoi::place::Place;
    use crate::voronoi::tests::{draw, draw_clip, draw_holes, mesh_of, sets};
    use crate::voronoi::view::Side;
    use crate::voronoi::Voronoi;
    use incircle_testkit::SplitMix64;

    /// A clip of many corners in the form of a star around the middle of a square. Every second corner lies nearer to
    /// the middle, by this share of the radius.
    fn star(corners: u32, radius: f64, depth: f64) -> Clip {
        let corner = |k: u32| {
            let angle = f64::from(k) * core::f64::consts::TAU / f64::from(corners);
            let length = radius * (1.0 - depth * f64::from(k % 2));
            [angle.cos(), angle.sin()].map(|share| (radius + length * share) as u32).into()
        };
        Clip::polygon(&(0..corners).map(corner).collect::<Vec<Point>>()).expect("a star")
    }

    /// The rings of a cell of a clipper, with the numbers of their corners.
    fn found(clipper: &Clipper<'_>) -> (Vec<Bend>, Vec<usize>) {
        (clipper.bends.clone(), clipper.counts.clone())
    }

    #[test]
    fn runs_of_corners_are_cut_like_their_corners() {
        let mut random = SplitMix64::new(288);
        let mut several = 0;
        for number in 0..2 * sets() {
            let (clip, points) = match number % 4 {
                0 => (Some(draw_clip(&mut random)), draw(&mut random)),
                1 | 2 => (draw_holes(&mut random), draw(&mut random)),
                _ => {
                    let place = |random: &mut SplitMix64| Point::new(random.below_u32(400), random.below_u32(400));
                    (
                        Some(star(64 + 2 * random.below_u32(100), 200.0, 0.1)),
                        (0..60).map(|_| place(&mut random)).collect(),
                    )
                }
            };
            let Some(clip) = clip else { continue };
            let mesh = mesh_of(&points);
            let voronoi = Voronoi::of(&mesh).expect("a diagram");
            let mut clipper = Clipper::new(&points, &clip);
            for cell in voronoi.cells() {
                let p = points[cell.point() as usize];
                clipper.clear();
                clipper.cut(p, cell.neighbors().iter().copied());
                let by_runs = found(&clipper);
                clipper.clear();
                clipper.rings.clear();
                let bend = |(k, &corner): (usize, &Point)| {
                    Item::One(Bend { place: Place::Corner(corner), side: Side::Clip(k as u32) })
                };
                clipper.rings.items.extend(clip.corners().iter().enumerate().map(bend));
                clipper.rings.counts.extend(clip.rings().map(<[Point]>::len));
                clipper.cut_rings(p, cell.neighbors().iter().copied());
                assert_eq!(by_runs, found(&clipper), "cell {} of {points:?} in {:?}", cell.point(), clip.corners());
                several += usize::from(by_runs.1.len() > 1);
            }
        }
        assert!(several > 0, "no cell of several rings");
    }

    #[test]
    fn few_corners_of_a_large_clip_are_looked_at() {
        let clip = star(20_000, 1e9, 1e-4);
        let mut random = SplitMix64::new(289);
        let points: Vec<Point> =
            (0..4000).map(|_| Point::new(random.below_u32(2_000_000_000), random.below_u32(2_000_000_000))).collect();
        let mesh = mesh_of(&points);
        let voronoi = Voronoi::of(&mesh).expect("a diagram");
        let mut clipper = Clipper::new(&points, &clip);
        let mut cut = 0;
        for cell in voronoi.cells() {
            clipper.clear();
            clipper.cut(points[cell.point() as usize], cell.neighbors().iter().copied());
            cut += usize::from(clipper.bends.iter().any(|bend| matches!(bend.side, Side::Clip(_))));
        }
        assert!(cut > 100, "{cut} cells at the border");
        // A line crosses few edges of the clip, and the tree has 13 levels.
        let most = clipper.rings.items.capacity().max(clipper.spare.items.capacity());
        assert!(most < 2048, "a cell had {most} items of 20000 corners");
    }
}
