//! Drawing a large mesh as a web of light: each pixel has the light of all edges that cross it.
//!
//! A browser's own lines would take ten times as long for 300,000 edges. Where the edges are listed along a curve, the
//! pixels of one edge are in the cache when the next edge comes.

/// Levels of light that have a colour of their own.
const LEVELS: usize = 256;
/// Colours of the darkest, the middle and the brightest level, as red, green and blue.
const KEYS: [[f32; 3]; 3] = [[12.0, 16.0, 23.0], [58.0, 140.0, 190.0], [225.0, 244.0, 255.0]];
/// Bits of a place behind the point.
const PLACE_BITS: u32 = 16;
/// Half a pixel.
const HALF: i32 = 1 << (PLACE_BITS - 1);
/// Bits of the light behind the point.
const LIGHT_BITS: u32 = 5;
/// The longest side of a picture: longer ones do not fit into the bits of a place.
const MOST_PIXELS: usize = 16_384;

/// A place in a picture, in steps of 2^-16 pixels.
pub type Place = [i32; 2];

/// The place of coordinates in pixels.
pub fn place(pixels: [f64; 2]) -> Place {
    pixels.map(|at| (at * f64::from(1 << PLACE_BITS)) as i32)
}

/// A picture that edges are drawn into.
#[derive(Default)]
pub struct Light {
    width: usize,
    height: usize,
    /// The light of each pixel, row by row, in steps of 2^-5 levels. All zero between two pictures.
    heat: Vec<u16>,
    /// The pixels as an `ImageData` of JavaScript has them: red, green, blue, and 255.
    image: Vec<[u8; 4]>,
    colors: Vec<[u8; 4]>,
}

/// The colour of each level of light, from the ground over blue to white.
fn colors() -> Vec<[u8; 4]> {
    let color = |level: usize| {
        let place = 2.0 * level as f32 / (LEVELS - 1) as f32;
        let (first, rest) = if place < 1.0 { (0, place) } else { (1, place - 1.0) };
        let mixed = |channel: usize| {
            let (from, to) = (KEYS[first][channel], KEYS[first + 1][channel]);
            (from + (to - from) * rest).round() as u8
        };
        [mixed(0), mixed(1), mixed(2), 255]
    };
    (0..LEVELS).map(color).collect()
}

impl Light {
    /// Makes room for a picture of this size. False if there is no memory for it, or a side has more than 16,384
    /// pixels.
    pub fn resize(&mut self, width: usize, height: usize) -> bool {
        if (self.width, self.height) == (width, height) {
            return true;
        }
        *self = Self::default();
        if width > MOST_PIXELS || height > MOST_PIXELS {
            return false;
        }
        let pixels = width * height;
        if self.heat.try_reserve_exact(pixels).is_err() || self.image.try_reserve_exact(pixels).is_err() {
            return false;
        }
        self.heat.resize(pixels, 0);
        self.image.resize(pixels, [0; 4]);
        self.colors = colors();
        (self.width, self.height) = (width, height);
        true
    }

    /// The light of an edge on a pixel that it covers: the less, the more points there are.
    pub fn of_an_edge(&self, points: usize) -> u32 {
        let side = self.width.min(self.height).max(1) as f32;
        let layers = 3.0 * (points as f32).sqrt() / side;
        (120.0 / (0.4 + 1.8 * layers) * (1 << LIGHT_BITS) as f32) as u32
    }

    /// Adds the light of the edge between two places, without its last pixel. Pixels outside the picture are left out.
    #[inline(always)]
    pub fn add(&mut self, light: u32, [x0, y0]: Place, [x1, y1]: Place) {
        let (dx, dy) = (x1.wrapping_sub(x0), y1.wrapping_sub(y0));
        // The edge has one place on each row or column of pixels, and gives its light to the two pixels around it.
        let is_steep = dy.wrapping_abs() > dx.wrapping_abs();
        let (from, to, start, run, rise) = if is_steep { (y0, y1, x0, dy, dx) } else { (x0, x1, y0, dx, dy) };
        let (along, across) = if is_steep { (self.width, 1) } else { (1, self.width) };
        let slope = (rise as f32 / run as f32 * (1 << PLACE_BITS) as f32) as i32;
        let first = from.min(to).wrapping_add(HALF) >> PLACE_BITS;
        let last = from.max(to).wrapping_add(HALF) >> PLACE_BITS;
        let ahead = (first << PLACE_BITS).wrapping_add(HALF).wrapping_sub(from);
        let rise = (i64::from(slope) * i64::from(ahead)) >> PLACE_BITS;
        let mut place = start.wrapping_add(rise as i32).wrapping_sub(HALF);
        let mut line = (first as usize).wrapping_mul(along);
        for _ in first..last {
            let rest = (light * (place as u32 & ((1 << PLACE_BITS) - 1))) >> PLACE_BITS;
            let pixel = line.wrapping_add(((place >> PLACE_BITS) as usize).wrapping_mul(across));
            if let Some(heat) = self.heat.get_mut(pixel) {
                *heat = heat.saturating_add((light - rest) as u16);
            }
            if let Some(heat) = self.heat.get_mut(pixel.wrapping_add(across)) {
                *heat = heat.saturating_add(rest as u16);
            }
            place = place.wrapping_add(slope);
            line = line.wrapping_add(along);
        }
    }

    /// Turns the light into colours, and takes it away for the next picture.
    pub fn image(&mut self) -> &[[u8; 4]] {
        for (pixel, heat) in self.image.iter_mut().zip(&mut self.heat) {
            *pixel = self.colors[usize::from(*heat >> LIGHT_BITS).min(LEVELS - 1)];
            *heat = 0;
        }
        &self.image
    }
}
