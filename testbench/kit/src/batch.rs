//! Batches of jobs side by side in one memory: their points in the order in which they are sent.

use crate::random32::Random32;
use crate::words;

/// The points of a batch.
#[derive(Clone, Debug)]
pub struct Batch {
    /// Points of each job, with its first three in front.
    pub jobs: Vec<Vec<u32>>,
}

impl Batch {
    /// Makes `jobs` jobs of about `most` points each and of any kind. With `spans` the first three points of each job
    /// span a triangle; without, they may not.
    pub fn random(random: &mut Random32, jobs: u32, most: u32, spans: bool) -> Self {
        let mut made = Vec::new();
        for _ in 0..jobs {
            let count = 3 + random.below(most.max(1));
            let side = random.pick(&[3, 5, 8, 40, 300, 1 << 16]);
            let mut points = match random.below(6) {
                0 => words::stuttering(random, count, side),
                1 => words::parabola(random, count.min(255)),
                2 => words::wheel(random, count),
                _ => words::boxed(random, count, side),
            };
            if spans {
                points = words::started(points);
            }
            made.push(points);
        }
        Self { jobs: made }
    }

    /// All points in the order in which they are sent: three of each job, then one of each job in turn. A job that has
    /// no more points repeats its first one until the last job is sent.
    pub fn points(&self) -> Vec<u32> {
        let mut points: Vec<u32> = self.jobs.iter().flat_map(|job| job[..3].to_vec()).collect();
        let longest = self.jobs.iter().map(Vec::len).max().unwrap_or(0);
        for place in 3..longest {
            points.extend(self.jobs.iter().map(|job| job.get(place).copied().unwrap_or(job[0])));
        }
        points
    }
}
