//! Draws an image as dots of one size: points are drawn by chance where the image is dark, and Lloyd's relaxation with
//! the image as its density spreads them evenly.
//!
//! ```text
//! cargo run --release -p incircle --example stipple -- testbench/data/camera.pgm dots.svg          # 4,000 dots
//! cargo run --release -p incircle --example stipple -- testbench/data/camera.pgm dots.svg 9000 80  # and 80 steps
//! ```
//!
//! The image is a PGM file of bytes (`P5`). The command `incircle lloyd --density` also reads PNG and JPEG.

use std::error::Error;
use std::fmt::Write;
use std::io::Write as _;
use std::num::NonZeroUsize;

use incircle::lloyd::{relax_weighted, Density, Relaxed, Stop};
use incircle::voronoi::Clip;
use incircle::Point;
use incircle_testkit::SplitMix64;

/// Steps of the grid in a pixel.
const STEPS: u32 = 4096;

/// An image of weights, the uppermost row first: 0 for white.
struct Image {
    columns: usize,
    rows: usize,
    weights: Vec<u16>,
}

/// Reads a PGM file of bytes, with a header of four words and without comments.
fn read(file: &str) -> Result<Image, Box<dyn Error>> {
    let bytes = std::fs::read(file)?;
    let (mut at, mut words) = (0, Vec::new());
    while words.len() < 4 {
        let length = bytes[at..].iter().position(u8::is_ascii_whitespace).ok_or("the header is cut off")?;
        words.push(std::str::from_utf8(&bytes[at..at + length])?);
        at += length + 1;
    }
    let [kind, columns, rows, most] = [words[0], words[1], words[2], words[3]];
    if (kind, most) != ("P5", "255") {
        return Err(format!("{file} is no PGM file of bytes").into());
    }
    let (columns, rows): (usize, usize) = (columns.parse()?, rows.parse()?);
    // The square makes light greys lighter: without it they would have as many dots as the eye expects of darker ones.
    let weight = |&grey: &u8| (255 - u16::from(grey)).pow(2);
    let weights: Vec<u16> = bytes[at..].iter().take(columns * rows).map(weight).collect();
    if weights.len() < columns * rows {
        return Err("pixels are missing".into());
    }
    Ok(Image { columns, rows, weights })
}

/// Draws places by chance, each pixel as often as it weighs.
fn draw(image: &Image, count: usize, random: &mut SplitMix64) -> Vec<Point> {
    let (width, height) = (image.columns as u32 * STEPS, image.rows as u32 * STEPS);
    let mut points = Vec::new();
    while points.len() < count {
        let (x, y) = (random.below_u32(width), random.below_u32(height));
        let row = image.rows - 1 - (y / STEPS) as usize;
        let weight = image.weights[row * image.columns + (x / STEPS) as usize];
        if random.below(1 << 16) < u64::from(weight) {
            points.push(Point::new(x, y));
        }
    }
    points
}

/// The dots as one path of an SVG picture, whose y grows downwards.
fn picture(image: &Image, points: &[Point]) -> String {
    let mut path = String::new();
    for point in points {
        let place = |value: u32| f64::from(value) / f64::from(STEPS);
        // Writing to a string cannot fail.
        let _ = write!(path, "M{:.1} {:.1}h0", place(point.x), image.rows as f64 - place(point.y));
    }
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"480\" viewBox=\"0 0 {} {}\">\n<rect width=\"100%\" \
         height=\"100%\" fill=\"#fff\"/>\n<path d=\"{path}\" stroke=\"#111\" stroke-width=\"1.5\" \
         stroke-linecap=\"round\"/>\n</svg>\n",
        image.columns, image.rows
    )
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, output, numbers @ ..] = &arguments[..] else {
        return Err("give an image and a name for the picture".into());
    };
    let number = |place: usize, usual: usize| numbers.get(place).map_or(Ok(usual), |text| text.parse());
    let (count, iterations) = (number(0, 4000)?, number(1, 40)?);
    let image = read(file)?;
    let corner = Point::new(image.columns as u32 * STEPS, image.rows as u32 * STEPS);
    let clip = Clip::rectangle(Point::new(0, 0), corner)?;
    let density = Density::over(&clip, image.columns, &image.weights)?;
    let start = draw(&image, count, &mut SplitMix64::new(1));
    let stop = Stop { iterations: u32::try_from(iterations)?, when_still: false };
    let threads = std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN);
    let relaxed = relax_weighted(start, &clip, &density, stop, threads)?;
    // The picture comes last, so that there is none if the line cannot be printed.
    let Relaxed { points, iterations, moved, .. } = &relaxed;
    writeln!(std::io::stdout(), "{count} dots after {iterations} steps; {moved} moved in the last")?;
    Ok(std::fs::write(output, picture(&image, points))?)
}
