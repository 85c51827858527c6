//! Scripts that `incircle generate` makes. They are written while they are made; only the living points are kept.

use std::io::{self, Write};

use incircle_testkit::{Distribution, SplitMix64};

use crate::failure::{counted, Failure};
use crate::numbers::doubles::DoubleSet;
use crate::numbers::{signed, Double, NumberKind, Single, SixDigits};

/// Frames of a script, unless they are chosen.
const USUAL_FRAMES: u32 = 60;
/// Commands of `churn` for each point, unless they are chosen.
const USUAL_CHURN: u64 = 20;
/// In each frame, one in this many features vanishes by chance.
const LIFE: u64 = 60;
/// The number of frames after which the camera pans in another direction.
const TURN: u32 = 20;
/// The most commands of a script.
const MOST_COMMANDS: u64 = u32::MAX as u64;

/// The rules by which scripts are made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Recipe {
    /// All points move a small step in every frame.
    Drift,
    /// Points appear, move and vanish, as the features that a camera tracks.
    Tracks,
    /// All commands, in random order.
    Churn,
}

impl Recipe {
    /// All recipes.
    pub const ALL: [Self; 3] = [Self::Drift, Self::Tracks, Self::Churn];

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Drift => "drift",
            Self::Tracks => "tracks",
            Self::Churn => "churn",
        }
    }

    /// A description of the script, for the help.
    pub fn description(self) -> &'static str {
        match self {
            Self::Drift => "a script: all points move a small step in every frame",
            Self::Tracks => "a script: points appear, move and vanish, as features that a camera tracks",
            Self::Churn => "a script: all commands in random order, with about N living points",
        }
    }

    /// The number of frames, or of commands for [`Churn`](Self::Churn): the chosen one, or else the usual one. A choice
    /// that the recipe does not have is refused, and so is a script of more than 2^32 - 1 commands.
    pub fn length(self, n: u32, frames: Option<u32>, commands: Option<u32>) -> Result<u64, Failure> {
        let name = self.name();
        let (length, total) = match (self, frames, commands) {
            (Self::Churn, Some(_), _) => {
                return Err(Failure::usage("churn has no frames: give --commands, or leave --frames out"));
            }
            (Self::Drift | Self::Tracks, _, Some(_)) => {
                return Err(Failure::usage(format!("{name} is made in frames: give --frames instead of --commands")));
            }
            (Self::Churn, ..) => {
                let length = commands.map_or(USUAL_CHURN * u64::from(n), u64::from);
                (length, length)
            }
            _ => {
                let frames = u64::from(frames.unwrap_or(USUAL_FRAMES));
                // A frame of `tracks` has a change and an eighth of a question for each point, and a new point for each
                // that vanishes, which may be all of them.
                let each = if self == Self::Tracks { 3 } else { 1 };
                (frames, u64::from(n) * (1 + each * frames) + frames)
            }
        };
        if total > MOST_COMMANDS {
            let option = if self == Self::Churn { "--commands" } else { "--frames" };
            return Err(Failure::usage(format!(
                "this script could have {total} commands, more than the {MOST_COMMANDS} that a script may have: choose \
                 a smaller -n or {option}"
            )));
        }
        Ok(length)
    }

    /// Writes the script of about as many living points as `start`, at whose places the first points appear. `length`
    /// is the number of frames or commands.
    pub fn write(self, start: &[[u32; 2]], length: u64, to: &mut ScriptWriter<'_>) -> io::Result<()> {
        let points = counted(start.len(), "point");
        let unit = if self == Self::Churn { "command" } else { "frame" };
        writeln!(to.out, "# {}: {points}, {}, seed {}", self.name(), counted(length as usize, unit), to.seed)?;
        match self {
            Self::Drift => write_drift(start, length as u32, to),
            Self::Tracks => write_tracks(start, length as u32, to),
            Self::Churn => write_churn(start, length, to),
        }
    }
}

/// The destination of a script, and the kind of numbers in which its places are written.
pub struct ScriptWriter<'a> {
    out: &'a mut dyn Write,
    numbers: NumberKind,
    /// Bits of the grid on which the script is made.
    bits: u32,
    doubles: DoubleSet,
    seed: u64,
    random: SplitMix64,
}

impl<'a> ScriptWriter<'a> {
    /// Makes a writer of a script on the grid of `bits` bits, 1 to 31.
    pub fn new(numbers: NumberKind, bits: u32, seed: u64, out: &'a mut dyn Write) -> Self {
        let doubles = DoubleSet::new(Distribution::Uniform, seed);
        // The first points are drawn from the seed itself.
        Self { out, numbers, bits, doubles, seed, random: SplitMix64::new(!seed) }
    }

    /// Writes a command that ends with a place.
    fn place(&mut self, command: std::fmt::Arguments<'_>, point: [u32; 2]) -> io::Result<()> {
        let bits = self.bits;
        match self.numbers {
            NumberKind::Whole => self.row(command, point),
            NumberKind::Signed => self.row(command, signed(point, bits)),
            NumberKind::Decimal => self.row(command, signed(point, bits).map(SixDigits)),
            NumberKind::F32 => self.row(command, signed(point, bits).map(|steps| Single::new(steps, bits))),
            NumberKind::Double => self.row(command, self.doubles.place(point).map(Double)),
        }
    }

    fn row<N: std::fmt::Display>(&mut self, command: std::fmt::Arguments<'_>, [x, y]: [N; 2]) -> io::Result<()> {
        writeln!(self.out, "{command} {x} {y}")
    }

    /// A place of the grid, each with equal chance.
    fn anywhere(&mut self) -> [u32; 2] {
        [0, 1].map(|_| self.random.bits(self.bits) as u32)
    }

    /// A step of up to `most` in both directions.
    fn step(&mut self, most: i64) -> i64 {
        self.random.below(2 * most as u64 + 1) as i64 - most
    }

    /// A tenth of the mean distance of `count` points, at least 1.
    fn short(&self, count: usize) -> i64 {
        ((1i64 << self.bits) / (10 * (count.max(1) as i64).isqrt())).max(1)
    }

    /// The place of a point after a step; `None` outside the grid.
    fn moved(&self, point: [u32; 2], by: [i64; 2]) -> Option<[u32; 2]> {
        let [x, y] = [0, 1].map(|axis| i64::from(point[axis]) + by[axis]);
        let is_inside = |value: i64| (0..1i64 << self.bits).contains(&value);
        (is_inside(x) && is_inside(y)).then_some([x as u32, y as u32])
    }
}

/// In every frame each coordinate changes by up to a tenth of the mean distance. Points that would leave the grid stay.
fn write_drift(start: &[[u32; 2]], frames: u32, to: &mut ScriptWriter<'_>) -> io::Result<()> {
    let mut points = start.to_vec();
    for &point in start {
        to.place(format_args!("insert"), point)?;
    }
    let most = to.short(points.len());
    for frame in 1..=frames {
        writeln!(to.out, "# frame {frame}")?;
        for (index, point) in points.iter_mut().enumerate() {
            let by = [to.step(most), to.step(most)];
            *point = to.moved(*point, by).unwrap_or(*point);
            to.place(format_args!("move {index}"), *point)?;
        }
    }
    Ok(())
}

/// In every frame all features move with the camera, and a little by themselves. One in [`LIFE`] vanishes, and so do
/// those that leave the image; as many appear. Then a question is asked for every eighth feature.
fn write_tracks(start: &[[u32; 2]], frames: u32, to: &mut ScriptWriter<'_>) -> io::Result<()> {
    let mut features: Vec<(u32, [u32; 2])> = Vec::new();
    let mut next = 0;
    let mut appear = |features: &mut Vec<(u32, [u32; 2])>, place, to: &mut ScriptWriter<'_>| {
        features.push((next, place));
        next += 1;
        to.place(format_args!("insert"), place)
    };
    for &place in start {
        appear(&mut features, place, to)?;
    }
    let most = to.short(start.len());
    let mut pan = [0; 2];
    for frame in 1..=frames {
        writeln!(to.out, "# frame {frame}")?;
        if frame % TURN == 1 {
            pan = [to.step(3 * most), to.step(3 * most)];
        }
        let mut kept = Vec::with_capacity(features.len());
        for (index, place) in features {
            let by = [pan[0] + to.step(most), pan[1] + to.step(most)];
            match to.moved(place, by).filter(|_| !to.random.once_in(LIFE)) {
                Some(place) => {
                    kept.push((index, place));
                    to.place(format_args!("move {index}"), place)?;
                }
                None => writeln!(to.out, "delete {index}")?,
            }
        }
        features = kept;
        while features.len() < start.len() {
            let place = to.anywhere();
            appear(&mut features, place, to)?;
        }
        ask(start.len().div_ceil(8), to)?;
    }
    Ok(())
}

/// Asks what `count` random places are.
fn ask(count: usize, to: &mut ScriptWriter<'_>) -> io::Result<()> {
    for _ in 0..count {
        let place = to.anywhere();
        to.place(format_args!("locate"), place)?;
    }
    Ok(())
}

/// A third of the commands inserts or deletes, so that about as many points live as in `start`; a third moves, half of
/// that by a short step; a third asks.
fn write_churn(start: &[[u32; 2]], commands: u64, to: &mut ScriptWriter<'_>) -> io::Result<()> {
    let mut living: Vec<(u32, [u32; 2])> = Vec::new();
    let mut next = 0u32;
    let most = to.short(start.len());
    for _ in 0..commands {
        let chosen = to.random.below(living.len() as u64) as usize;
        let old = living.get(chosen).map(|&(_, place)| place);
        // One place in 16 is that of a living point, so there are duplicates.
        let place = old.filter(|_| to.random.once_in(16)).unwrap_or_else(|| to.anywhere());
        match (to.random.below(6), old) {
            (4, _) => to.place(format_args!("locate"), place)?,
            (5, _) => to.place(format_args!("nearest"), place)?,
            (2 | 3, Some(old)) => {
                let by = [to.step(most), to.step(most)];
                let near = to.moved(old, by).filter(|_| to.random.once_in(2));
                let (index, moved) = (living[chosen].0, near.unwrap_or(place));
                living[chosen].1 = moved;
                to.place(format_args!("move {index}"), moved)?;
            }
            (0 | 1, Some(_)) if to.random.below(2 * start.len() as u64) < living.len() as u64 => {
                let (index, _) = living.swap_remove(chosen);
                writeln!(to.out, "delete {index}")?;
            }
            _ => {
                // The first places are those of the set.
                let place = start.get(next as usize).copied().unwrap_or(place);
                living.push((next, place));
                next += 1;
                to.place(format_args!("insert"), place)?;
            }
        }
    }
    Ok(())
}
