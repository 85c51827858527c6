//! Sets of points with constraints on a tenth of them: contours and street nets.

use incircle_testkit::SplitMix64;

/// Bits of a coordinate: few enough that doubles hold the points exactly, and many enough that ties are rare.
pub(super) const BITS: u32 = 31;
const SIDE: f64 = (1u64 << BITS) as f64;
/// Points on a contour, and contours around one hill.
const RING: usize = 32;
const RINGS: usize = 3;

/// The kinds of plans.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    /// Three closed wavy lines around each of many hills.
    Contours,
    /// A net of crooked streets that meet at crossings, four at a time.
    Streets,
}

impl Kind {
    pub(super) const ALL: [Self; 2] = [Self::Contours, Self::Streets];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Contours => "contours",
            Self::Streets => "streets",
        }
    }
}

/// Points and constraints.
pub(super) struct Set {
    pub points: Vec<[f64; 2]>,
    pub constraints: Vec<[u32; 2]>,
}

impl Set {
    /// About `n` points, of which those on constraints come first. The number of constraints is a tenth of `n`.
    pub(super) fn new(kind: Kind, n: usize, seed: u64) -> Self {
        let mut random = SplitMix64::new(seed);
        let mut set = Self { points: Vec::with_capacity(n), constraints: Vec::new() };
        match kind {
            Kind::Contours => set.add_contours(n / 10, &mut random),
            Kind::Streets => set.add_streets(n / 10, &mut random),
        }
        while set.points.len() < n {
            let point = [(); 2].map(|()| random.below(1 << BITS) as f64);
            set.points.push(point);
        }
        set.shuffle(&mut random);
        set
    }

    /// Numbers the points at random, as those of a file that knows nothing of constraints.
    fn shuffle(&mut self, random: &mut SplitMix64) {
        let mut order: Vec<u32> = (0..self.points.len() as u32).collect();
        random.shuffle(&mut order);
        let mut place = vec![0; order.len()];
        (0u32..).zip(&order).for_each(|(new, &old)| place[old as usize] = new);
        self.points = order.iter().map(|&old| self.points[old as usize]).collect();
        self.constraints.iter_mut().flatten().for_each(|end| *end = place[*end as usize]);
    }

    fn push(&mut self, x: f64, y: f64) -> u32 {
        self.points.push([x.round().clamp(0.0, SIDE - 1.0), y.round().clamp(0.0, SIDE - 1.0)]);
        self.points.len() as u32 - 1
    }

    fn add_contours(&mut self, count: usize, random: &mut SplitMix64) {
        let hills = count.div_ceil(RING * RINGS);
        let columns = (hills as f64).sqrt().ceil() as usize;
        let cell = SIDE / columns as f64;
        for hill in 0..hills {
            let middle = [hill % columns, hill / columns].map(|place| (place as f64 + 0.5) * cell);
            let wave = random.below(1000) as f64 / 100.0;
            for ring in 0..RINGS {
                let first = self.points.len() as u32;
                for step in 0..RING {
                    let angle = step as f64 / RING as f64 * std::f64::consts::TAU;
                    let radius = cell * (0.15 + 0.1 * ring as f64) * (1.0 + 0.15 * (3.0 * angle + wave).sin());
                    self.push(middle[0] + radius * angle.cos(), middle[1] + radius * angle.sin());
                }
                let end = first + RING as u32;
                self.constraints.extend((first..end).map(|k| [k, if k + 1 == end { first } else { k + 1 }]));
            }
        }
    }

    fn add_streets(&mut self, count: usize, random: &mut SplitMix64) {
        let columns = ((count / 2) as f64).sqrt().round().max(2.0) as usize;
        let cell = SIDE / columns as f64;
        let mut crooked = || 0.25 + random.below(1000) as f64 / 2000.0;
        let crossings: Vec<[f64; 2]> = (0..columns * columns)
            .map(|k| [(k % columns) as f64 + crooked(), (k / columns) as f64 + crooked()].map(|place| place * cell))
            .collect();
        crossings.iter().for_each(|&[x, y]| {
            self.push(x, y);
        });
        for k in 0..columns * columns {
            if k % columns + 1 < columns {
                self.constraints.push([k as u32, k as u32 + 1]);
            }
            if k / columns + 1 < columns {
                self.constraints.push([k as u32, (k + columns) as u32]);
            }
        }
    }
}
