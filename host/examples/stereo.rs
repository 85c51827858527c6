//! Depth from two images, as in stereo vision: a few support points are matched between the images, their Delaunay
//! triangulation is made, and each triangle is a plane of disparities.
//!
//! ```text
//! cargo run --release -p incircle --example stereo -- disparities.svg
//! ```
//!
//! The example makes its own pair of images: a slanted wall, a box before it and a slanted board, all with a random
//! texture. The *disparity* of a place is how many pixels farther left it lies in the right image; near things have
//! large ones. The last line says how far the planes are from the true disparities.

use std::error::Error;
use std::fmt::Write;
use std::io::Write as _;
use std::num::NonZeroUsize;

use incircle::interpolate::{Method, Outside, Surface};
use incircle::Point;
use incircle_testkit::SplitMix64;

const WIDTH: usize = 320;
const HEIGHT: usize = 200;
/// The largest disparity that is tried.
const MOST: usize = 40;
/// Pixels between candidates for support points, and pixels from the middle of a window that is compared to its side.
const SPACING: usize = 5;
const REACH: usize = 4;

/// A grey image.
type Image = Vec<[u8; WIDTH]>;

/// The true disparity at a pixel of the left image.
fn truth(x: usize, y: usize) -> f64 {
    let (x, y) = (x as f64, y as f64);
    if (90.0..150.0).contains(&x) && (60.0..140.0).contains(&y) {
        28.0
    } else if (200.0..290.0).contains(&x) && (40.0..160.0).contains(&y) {
        14.0 + (x - 200.0) / 9.0
    } else {
        6.0 + y / 50.0
    }
}

/// Makes the pair: the right image shows each pixel of the left one where it lies there, near ones before far ones.
fn images(random: &mut SplitMix64) -> [Image; 2] {
    let mut noise = || -> Image { (0..HEIGHT).map(|_| [0; WIDTH].map(|_: u8| random.bits(8) as u8)).collect() };
    let (left, mut right) = (noise(), noise());
    for y in 0..HEIGHT {
        let mut nearest = [0; WIDTH];
        for x in 0..WIDTH {
            let disparity = truth(x, y).round() as usize;
            if x >= disparity && disparity >= nearest[x - disparity] {
                nearest[x - disparity] = disparity;
                right[y][x - disparity] = left[y][x];
            }
        }
    }
    [left, right]
}

/// The difference between the windows around two places of one row.
fn difference(left: &Image, right: &Image, y: usize, [x, other]: [usize; 2]) -> u32 {
    let row = |row: usize| -> u32 {
        let (one, two) = (&left[row][x - REACH..=x + REACH], &right[row][other - REACH..=other + REACH]);
        one.iter().zip(two).map(|(a, b)| u32::from(a.abs_diff(*b))).sum()
    };
    (y - REACH..=y + REACH).map(row).sum()
}

/// The disparity at which the windows differ least, if no other disparity but its neighbours comes near.
fn matched(y: usize, candidates: impl Iterator<Item = (usize, u32)>) -> Option<usize> {
    let all: Vec<(usize, u32)> = candidates.collect();
    let &(best, least) = all.iter().min_by_key(|&&(_, difference)| difference)?;
    let rival = all.iter().filter(|(other, _)| other.abs_diff(best) > 1).map(|&(_, difference)| difference).min();
    (y < HEIGHT && rival.is_none_or(|rival| 10 * least < 8 * rival)).then_some(best)
}

/// The support points with their disparities: those on which a search from the left and one from the right agree.
fn support([left, right]: &[Image; 2]) -> (Vec<Point>, Vec<f64>) {
    let (mut points, mut disparities) = (Vec::new(), Vec::new());
    for y in (REACH..HEIGHT - REACH).step_by(SPACING) {
        for x in (REACH..WIDTH - REACH).step_by(SPACING) {
            let there = (0..=MOST.min(x - REACH)).map(|d| (d, difference(left, right, y, [x, x - d])));
            let Some(found) = matched(y, there) else { continue };
            let most = MOST.min(WIDTH - 1 - REACH - (x - found));
            let back = (0..=most).map(|d| (d, difference(left, right, y, [x - found + d, x - found])));
            if matched(y, back) == Some(found) {
                points.push(Point::new(x as u32, (HEIGHT - 1 - y) as u32));
                disparities.push(found as f64);
            }
        }
    }
    (points, disparities)
}

/// A colour from blue for far places to red for near ones.
fn colour(disparity: f64) -> String {
    let share = (disparity / 32.0).clamp(0.0, 1.0);
    let part = |middle: f64| ((1.5 - (4.0 * share - middle).abs()).clamp(0.0, 1.0) * 255.0) as u8;
    format!("#{:02x}{:02x}{:02x}", part(3.0), part(2.0), part(1.0))
}

fn main() -> Result<(), Box<dyn Error>> {
    let output = std::env::args().nth(1).ok_or("give a name for the picture")?;
    let (points, disparities) = support(&images(&mut SplitMix64::new(7)));
    let mesh = incircle::triangulate(&points)?;
    let places: Vec<[f64; 2]> = points.iter().map(|point| [point.x.into(), point.y.into()]).collect();
    let surface = Surface::new(&places, &mesh.triangles, &disparities)?;
    let mut svg =
        format!("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"800\" viewBox=\"0 0 {WIDTH} {HEIGHT}\">\n");
    for corners in &mesh.triangles {
        let mean = corners.iter().map(|&index| disparities[index as usize]).sum::<f64>() / 3.0;
        let corner = |index: &u32| {
            let [x, y] = places[*index as usize];
            format!("{x} {}", HEIGHT as f64 - y)
        };
        let data = corners.iter().map(corner).collect::<Vec<_>>().join("L");
        writeln!(svg, "<path d=\"M{data}Z\" fill=\"{}\" stroke=\"#222\" stroke-width=\".3\"/>", colour(mean))?;
    }
    // The planes at every pixel, beside the truth.
    let pixels: Vec<[usize; 2]> = (0..HEIGHT).flat_map(|y| (0..WIDTH).map(move |x| [x, y])).collect();
    let asked: Vec<[f64; 2]> = pixels.iter().map(|&[x, y]| [x as f64, (HEIGHT - 1 - y) as f64]).collect();
    let found = surface.values(Method::Linear, Outside::Nan, &asked, NonZeroUsize::MIN);
    let known = pixels.iter().zip(&found).filter(|(_, value)| !value.is_nan());
    let errors: Vec<f64> = known.map(|(&[x, y], value)| (value - truth(x, y)).abs()).collect();
    let near = errors.iter().filter(|&&error| error <= 1.0).count();
    // The picture comes last, so that there is none if the line cannot be printed.
    writeln!(
        std::io::stdout(),
        "{} support points, {} planes; {} of {} pixels within 1 of the true disparity",
        points.len(),
        mesh.triangles.len(),
        near,
        errors.len()
    )?;
    Ok(std::fs::write(output, svg + "</svg>\n")?)
}
