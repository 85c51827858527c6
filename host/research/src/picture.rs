//! `draw`: draws an order as a line from each point to the next.

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args;
use incircle::Point;
use incircle_testkit::{generate, Distribution};

use crate::order::Order;
use crate::orders::{write, Failure};

/// Arguments of `draw`.
#[derive(Clone, Debug, Args)]
pub struct PictureArguments {
    /// Set
    #[arg(value_name = "SET")]
    pub set: Distribution,
    /// Points of the set
    #[arg(short, value_name = "N", default_value_t = 1024)]
    pub n: u32,
    /// Order
    #[arg(long, value_parser = order_from)]
    pub order: Order,
    /// Bits of a coordinate
    #[arg(long, value_name = "BITS", default_value_t = 16, value_parser = clap::value_parser!(u32).range(1..=31))]
    pub coord_bits: u32,
    /// Seed of the set
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    /// File for the picture
    #[arg(short, long, value_name = "FILE.svg")]
    pub output: PathBuf,
}

fn order_from(name: &str) -> Result<Order, String> {
    let names = || Order::all().into_iter().map(Order::name).collect::<Vec<_>>().join(", ");
    Order::named(name).ok_or_else(|| format!("the orders are {}", names()))
}

/// Units of the picture along the longer side of the points' bounding box, and of the margin around the box.
const CANVAS: f64 = 10_000.0;
const MARGIN: f64 = 250.0;

/// Runs the subcommand, which writes one picture.
///
/// # Errors
/// The file cannot be written, or the set cannot be made.
pub fn picture(arguments: &PictureArguments) -> Result<(), Failure> {
    let PictureArguments { set, n, order, coord_bits, seed, ref output } = *arguments;
    let points: Vec<Point> = generate(set, n as usize, coord_bits, seed)?.into_iter().map(Point::from).collect();
    let order_of_points: Vec<Point> = order.order(&points).into_iter().map(|index| points[index as usize]).collect();
    let title = format!("{n} points, {set}, in the order {}", order.name());
    write(output, &drawing(&order_of_points, &title))
}

fn drawing(points: &[Point], title: &str) -> String {
    let bound = |get: fn(&Point) -> u32| (points.iter().map(get).min(), points.iter().map(get).max());
    let ((left, right), (bottom, top)) = (bound(|p| p.x), bound(|p| p.y));
    let [left, right, bottom, top] = [left, right, bottom, top].map(Option::unwrap_or_default);
    let scale = CANVAS / f64::from((right - left).max(top - bottom).max(1));
    let [width, height] = [right - left, top - bottom].map(|side| f64::from(side) * scale + 2.0 * MARGIN);
    let mut text = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width:.0} {height:.0}\">\n<title>{title}</title>\n\
         <polyline fill=\"none\" stroke=\"#2a8c98\" stroke-width=\"20\" points=\""
    );
    for point in points {
        let x = f64::from(point.x - left) * scale + MARGIN;
        let y = height - f64::from(point.y - bottom) * scale - MARGIN;
        // Writing to a string cannot fail.
        let _ = write!(text, "{x:.0},{y:.0} ");
    }
    text + "\"/>\n</svg>\n"
}
