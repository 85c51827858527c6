//! Constrained meshes by their definition, for small sets of points of a small grid, and for nothing but comparison.
//!
//! The code shares nothing with the crate: the predicates are those of the test kit.

use std::collections::{BTreeMap, BTreeSet};

use incircle_testkit::{conflicts, orient2d, SplitMix64};

pub type P = [u32; 2];
pub type Edge = [u32; 2];

/// A small graph: points, which may repeat, and constraints of any kind.
pub struct Graph {
    pub points: Vec<P>,
    pub constraints: Vec<Edge>,
}

impl Graph {
    pub fn random(random: &mut SplitMix64, constraints: u64) -> Self {
        let side = [3, 4, 4, 5][random.below(4) as usize];
        let count = 5 + random.below(7) as usize;
        let points: Vec<P> = (0..count).map(|_| [random.below_u32(side), random.below_u32(side)]).collect();
        let any = |random: &mut SplitMix64| random.below(count as u64) as u32;
        let constraints = (0..random.below(constraints)).map(|_| [any(random), any(random)]).collect();
        Self { points, constraints }
    }

    pub fn at(&self, index: u32) -> P {
        self.points[index as usize]
    }

    pub fn lowest(&self, index: u32) -> u32 {
        let of = self.at(index);
        self.points.iter().position(|&point| point == of).expect("the point itself") as u32
    }

    /// The lowest index of each place.
    pub fn distinct(&self) -> Vec<u32> {
        (0..self.points.len() as u32).filter(|&index| self.lowest(index) == index).collect()
    }

    fn turn(&self, a: u32, b: u32, c: u32) -> i128 {
        orient2d(self.at(a), self.at(b), self.at(c)).signum()
    }

    /// Whether the line from `a` to `b` has this point inside.
    fn is_on(&self, [a, b]: Edge, v: u32) -> bool {
        let (p, q, v_) = (self.at(a), self.at(b), self.at(v));
        self.turn(a, b, v) == 0 && p.min(q) < v_ && v_ < p.max(q)
    }

    /// Whether two lines cross inside both, at whatever place.
    pub fn cross(&self, [a, b]: Edge, [c, d]: Edge) -> bool {
        self.turn(a, b, c) * self.turn(a, b, d) < 0 && self.turn(c, d, a) * self.turn(c, d, b) < 0
    }

    /// The pieces of a constraint.
    fn pieces_of(&self, [a, b]: Edge) -> Vec<Edge> {
        let mut on: Vec<u32> = self.distinct().into_iter().filter(|&v| self.is_on([a, b], v)).collect();
        on.extend([self.lowest(a), self.lowest(b)]);
        on.sort_by_key(|&v| self.at(v));
        on.dedup();
        on.windows(2).map(|two| [two[0].min(two[1]), two[0].max(two[1])]).collect()
    }

    /// All pieces with their constraints.
    pub fn pieces(&self) -> BTreeMap<Edge, Vec<u32>> {
        let mut pieces: BTreeMap<Edge, Vec<u32>> = BTreeMap::new();
        for (number, &constraint) in (0..).zip(&self.constraints) {
            for piece in self.pieces_of(constraint) {
                pieces.entry(piece).or_default().push(number);
            }
        }
        pieces
    }

    /// The first crossing: of the constraint with the smallest number that crosses an earlier one, at a place that is
    /// no point.
    pub fn crosses(&self) -> bool {
        let pieces: Vec<Edge> = self.pieces().into_keys().collect();
        pieces.iter().any(|&one| pieces.iter().any(|&other| self.cross(one, other)))
    }

    /// A triangulation with these edges: edges are added in random order as long as none crosses another.
    fn random_start(&self, fixed: &BTreeSet<Edge>, random: &mut SplitMix64) -> BTreeSet<[u32; 3]> {
        let distinct = self.distinct();
        let mut open: Vec<Edge> = Vec::new();
        for (place, &a) in distinct.iter().enumerate() {
            open.extend(distinct[place + 1..].iter().map(|&b| [a, b]));
        }
        open.retain(|&edge| !distinct.iter().any(|&v| self.is_on(edge, v)));
        let mut edges: Vec<Edge> = fixed.iter().copied().collect();
        while !open.is_empty() {
            let edge = open.swap_remove(random.below(open.len() as u64) as usize);
            if !edges.contains(&edge) && !edges.iter().any(|&other| self.cross(edge, other)) {
                edges.push(edge);
            }
        }
        let has = |a: u32, b: u32| edges.contains(&[a.min(b), a.max(b)]);
        let mut triangles = BTreeSet::new();
        for &a in &distinct {
            for &b in distinct.iter().filter(|&&b| b > a && has(a, b)) {
                for &c in distinct.iter().filter(|&&c| c > a && has(a, c) && has(b, c) && self.turn(a, b, c) > 0) {
                    let is_inside = |v: u32| {
                        ![a, b, c].contains(&v)
                            && [(a, b), (b, c), (c, a)].iter().all(|&(p, q)| self.turn(p, q, v) >= 0)
                    };
                    if !distinct.iter().any(|&v| is_inside(v)) {
                        triangles.insert([a, b, c]);
                    }
                }
            }
        }
        triangles
    }

    /// Flips free edges, of all that must be flipped each time any, until none must be.
    pub fn flipped(&self, fixed: &BTreeSet<Edge>, random: &mut SplitMix64) -> Vec<[u32; 3]> {
        let mut triangles = self.random_start(fixed, random);
        loop {
            let sides: BTreeMap<Edge, u32> =
                triangles.iter().flat_map(|&[a, b, c]| [([a, b], c), ([b, c], a), ([c, a], b)]).collect();
            let must_flip = |&([u, v], a): &([u32; 2], u32)| {
                let b = *sides.get(&[v, u])?;
                let is_free = u < v && !fixed.contains(&[u, v]);
                (is_free && conflicts(self.at(u), self.at(v), self.at(a), self.at(b))).then_some([u, v, a, b])
            };
            let all: Vec<[u32; 4]> =
                sides.iter().map(|(&edge, &apex)| (edge, apex)).filter_map(|side| must_flip(&side)).collect();
            if all.is_empty() {
                return triangles.into_iter().collect();
            }
            let [u, v, a, b] = random.pick(&all);
            let sorted = |[a, b, c]: [u32; 3]| match a.min(b).min(c) {
                least if least == a => [a, b, c],
                least if least == b => [b, c, a],
                _ => [c, a, b],
            };
            for old in [[u, v, a], [v, u, b]] {
                assert!(triangles.remove(&sorted(old)));
            }
            for new in [[a, u, b], [b, v, a]] {
                assert!(self.turn(new[0], new[1], new[2]) > 0, "a flip of a quadrilateral that is not convex");
                triangles.insert(sorted(new));
            }
        }
    }
}
