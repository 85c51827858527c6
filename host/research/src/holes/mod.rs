//! `holes`: counts the tests of ways to fill the hole that a deleted vertex leaves, by its number of neighbours.
//!
//! Rows of small numbers are vertices inside the hull of uniform points. Those of large numbers are wheels: a hub with
//! points on a circle around it, rounded to the grid, whose neighbours are all points. All ways must give the same
//! triangles.

mod patch;
mod ring;
mod ways;

use std::collections::BTreeMap;

use clap::Args;
use incircle_geometry::{Point, Triangulation};
use incircle_testkit::SplitMix64;

use crate::orders::{print, Failure};
use ring::{Ring, Tests};
use ways::Way;

/// Arguments of `holes`.
#[derive(Clone, Debug, Args)]
pub struct HolesArguments {
    /// Uniform points
    #[arg(short, value_name = "N", default_value_t = 100_000, value_parser = clap::value_parser!(u32).range(3..))]
    pub n: u32,
    /// Wheels of each size
    #[arg(long, value_name = "N", default_value_t = 200)]
    pub wheels: u32,
    /// Seed; one seed gives the same points on every machine
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
}

/// Side of the grid, and neighbours of the hubs of the wheels.
const SIDE: u32 = 1 << 30;
const WHEELS: [usize; 8] = [6, 8, 12, 16, 24, 32, 64, 128];

/// Runs the subcommand: a row for each number of neighbours.
///
/// # Errors
/// Two ways give different triangles.
pub fn holes(arguments: &HolesArguments) -> Result<(), Failure> {
    let mut random = SplitMix64::new(arguments.seed);
    print("tests a deletion: orient2d + incircle, in brackets their multiplications\n")?;
    let points: Vec<Point> = random.points(arguments.n as usize, SIDE);
    let mut rows: BTreeMap<usize, Vec<Ring>> = BTreeMap::new();
    let rings = rings(&points)?;
    print(&row(&format!("uniform, all {}", rings.len()), &rings, &mut random)?)?;
    for ring in rings {
        rows.entry(ring.len()).or_default().push(ring);
    }
    for (degree, rings) in rows {
        print(&row(&format!("uniform, {degree} neighbours"), &rings, &mut random)?)?;
    }
    for degree in WHEELS {
        let rings: Vec<Ring> = (0..arguments.wheels).map(|_| wheel(degree, &mut random)).collect();
        print(&row(&format!("wheel, {degree} neighbours"), &rings, &mut random)?)?;
    }
    Ok(())
}

/// The rings around all points inside the hull.
fn rings(points: &[Point]) -> Result<Vec<Ring>, Failure> {
    let mesh = Triangulation::from(points.iter().copied())?;
    let mut rings = Vec::new();
    for index in mesh.vertices() {
        let around: Vec<Point> = mesh.neighbors(index)?.filter_map(|index| mesh.point(index)).collect();
        // A vertex of the hull has one triangle fewer than neighbours.
        if around.len() > 2 && mesh.star(index)?.count() == around.len() {
            rings.push(Ring::new(points[index as usize], around));
        }
    }
    Ok(rings)
}

/// A ring of points on a circle, in random places.
fn wheel(degree: usize, random: &mut SplitMix64) -> Ring {
    let center = f64::from(SIDE / 2);
    let mut angles: Vec<f64> = Vec::new();
    // The hub must be inside the hull.
    let is_open = |angles: &[f64]| {
        let gap = |k: usize| (angles[(k + 1) % degree] - angles[k]).rem_euclid(std::f64::consts::TAU);
        angles.is_empty() || (0..degree).any(|k| gap(k) > 3.0)
    };
    while is_open(&angles) {
        angles = (0..degree).map(|_| std::f64::consts::TAU * random.unit()).collect();
        angles.sort_by(f64::total_cmp);
    }
    let at = |value: f64| (center * (1.0 + 0.9 * value)).round() as u32;
    let points = angles.iter().map(|angle| Point::new(at(angle.cos()), at(angle.sin()))).collect();
    Ring::new(Point::new(SIDE / 2, SIDE / 2), points)
}

/// The mean numbers of tests of all ways.
fn row(name: &str, rings: &[Ring], random: &mut SplitMix64) -> Result<String, Failure> {
    let mut text = format!("{name:24}{:7} holes", rings.len());
    let mut expected = Vec::new();
    for way in Way::ALL {
        let mut sum = Tests::default();
        let mut found = Vec::new();
        for ring in rings {
            let mut ring = ring.clone();
            found.push(way.fill(&mut ring, random));
            sum.orient2d += ring.tests.orient2d;
            sum.incircle += ring.tests.incircle;
        }
        if way != Way::GiftWrapping && found != expected {
            return Err(format!("{} gives other triangles: {name}", way.name()).into());
        }
        expected = found;
        let mean = |count: u64| count as f64 / rings.len().max(1) as f64;
        let (orient2d, incircle) = (mean(sum.orient2d), mean(sum.incircle));
        text += &format!("  {} {orient2d:.1} + {incircle:.1} ({:.0})", way.name(), mean(way.multiplications(sum)));
    }
    Ok(text + "\n")
}
