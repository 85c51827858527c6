//! The lattice of all inputs together: one step for all coordinates, and the place from which steps are counted.

use incircle::{Lattice, Point, Step};

use crate::failure::Failure;
use crate::points::{Coordinates, Unit};

/// Steps of this magnitude or more are refused, as in one file of doubles. The bound is below 2^63, so the steps of an
/// offset fit 64 bits.
const MOST_STEPS: i128 = 9_200_000_000_000_000_000;

/// The words of one kind of numbers in [`Extent::to_words`]: whether there are any, the step, and four sides of 128
/// bits.
const KIND_WORDS: usize = 10;
/// The kinds of numbers in [`Extent::to_words`]. A word behind them says whether a decimal is no double.
const KINDS: usize = 3;

/// The length of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Length {
    /// Ten to the power of minus this number.
    Decimal(u32),
    /// Two to the power of this number, which is 0 or less.
    Binary(i32),
}

/// The lattice of a set, as far as tiles need it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ground {
    /// The length of a step.
    pub length: Length,
    /// The smallest x and y of all points, in steps.
    pub offset: [i128; 2],
    /// Bits of the larger span, at most 32.
    pub bits: u32,
}

/// The least and the greatest coordinates, in steps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Span {
    low: [i128; 2],
    high: [i128; 2],
}

impl Span {
    fn with(self, other: Self) -> Self {
        Self {
            low: [0, 1].map(|axis| self.low[axis].min(other.low[axis])),
            high: [0, 1].map(|axis| self.high[axis].max(other.high[axis])),
        }
    }

    /// The span in steps that are shorter by a factor; `None` if the numbers become too large.
    fn times(self, factor: Option<i128>) -> Option<Self> {
        let scaled = |value: i128| match value {
            0 => Some(0),
            _ => value.checked_mul(factor?).filter(|steps| steps.abs() < MOST_STEPS),
        };
        let both = |[x, y]: [i128; 2]| Some([scaled(x)?, scaled(y)?]);
        Some(Self { low: both(self.low)?, high: both(self.high)? })
    }
}

/// The spans of the pieces seen so far. Each kind of numbers has the shortest step that one of its pieces needs.
///
/// [`Extent::to_words`] and [`Extent::add_words`] carry the spans from one process to another.
#[derive(Clone, Copy, Debug, Default)]
pub struct Extent {
    decimal: Option<(u32, Span)>,
    binary: Option<(i32, Span)>,
    /// The span of the decimals as multiples of a power of two, as long as all are such multiples.
    alike: Option<(i32, Span)>,
    /// Whether a decimal is no multiple of a power of two that doubles have.
    has_no_double: bool,
}

impl Extent {
    /// Adds the points of a piece. Points that have no lattice are refused.
    pub fn add(&mut self, piece: &Coordinates) -> Result<(), Failure> {
        let added = match piece {
            Coordinates::Steps { steps, unit } => {
                self.add_alike(piece, unit);
                self.add_steps(steps, unit)
            }
            Coordinates::Doubles(points) => self.add_doubles(points),
        };
        added.ok_or_else(no_lattice)
    }

    fn add_steps(&mut self, steps: &[[i64; 2]], unit: &Unit) -> Option<()> {
        let values = steps.iter().map(|&point| decimal(unit, point));
        match values.map(|at| Span { low: at, high: at }).reduce(Span::with) {
            Some(span) => self.add_decimal(unit.digits, span),
            None => Some(()),
        }
    }

    /// Notes decimals as multiples of a power of two. In a text, a number with many digits may make doubles of a piece,
    /// and all other pieces are decimals.
    fn add_alike(&mut self, piece: &Coordinates, unit: &Unit) {
        if self.has_no_double {
            return;
        }
        let added = match piece {
            Coordinates::Steps { steps, .. } if unit.digits == 0 => {
                let values = steps.iter().map(|&point| decimal(unit, point));
                Some(values.map(|at| Span { low: at, high: at }).reduce(Span::with).map(|span| (0, span)))
            }
            _ if piece.count_no_doubles() > 0 => None,
            _ => lattice_of(&piece.doubles()),
        };
        let joined =
            added.and_then(|added| added.map_or(Some(self.alike), |added| joined(self.alike, added).map(Some)));
        (self.alike, self.has_no_double) = (joined.flatten(), joined.is_none());
    }

    fn add_decimal(&mut self, added: u32, span: Span) -> Option<()> {
        let (digits, old) = self.decimal.unwrap_or((added, span));
        let finest = digits.max(added);
        let old = old.times(10i128.checked_pow(finest - digits))?;
        self.decimal = Some((finest, old.with(span.times(10i128.checked_pow(finest - added))?)));
        Some(())
    }

    fn add_doubles(&mut self, points: &[[f64; 2]]) -> Option<()> {
        match lattice_of(points)? {
            Some((exponent, span)) => self.add_binary(exponent, span),
            None => Some(()),
        }
    }

    fn add_binary(&mut self, exponent: i32, span: Span) -> Option<()> {
        self.binary = Some(joined(self.binary, (exponent, span))?);
        Some(())
    }

    /// The spans as numbers of 64 bits, for another process.
    pub fn to_words(&self) -> Vec<u64> {
        let mut words = Vec::with_capacity(KINDS * KIND_WORDS + 1);
        let mut add = |step: Option<u64>, span: Span| {
            words.extend([u64::from(step.is_some()), step.unwrap_or(0)]);
            let values = [span.low, span.high].into_iter().flatten().map(i128::cast_unsigned);
            words.extend(values.flat_map(|value| [value as u64, (value >> u64::BITS) as u64]));
        };
        let nothing = Span { low: [0; 2], high: [0; 2] };
        add(self.decimal.map(|(digits, _)| digits.into()), self.decimal.map_or(nothing, |(_, span)| span));
        for kind in [self.binary, self.alike] {
            let exponent = kind.map(|(exponent, _)| exponent.cast_unsigned().into());
            add(exponent, kind.map_or(nothing, |(_, span)| span));
        }
        words.push(self.has_no_double.into());
        words
    }

    /// Adds the points of another process, from its [`Extent::to_words`].
    ///
    /// # Errors
    /// The points have no lattice in common with those that were added before. Missing words count as 0.
    pub fn add_words(&mut self, words: &[u64]) -> Result<(), Failure> {
        let word = |place: usize| words.get(place).copied().unwrap_or(0);
        let value = |place: usize| (u128::from(word(place)) | u128::from(word(place + 1)) << u64::BITS).cast_signed();
        let span = |first: usize| Span {
            low: [value(first + 2), value(first + 4)],
            high: [value(first + 6), value(first + 8)],
        };
        let decimal = if word(0) == 1 { self.add_decimal(word(1) as u32, span(0)) } else { Some(()) };
        let power_at = |first: usize| {
            let exponent = (word(first + 1) as u32).cast_signed();
            (word(first) == 1).then(|| (exponent, span(first)))
        };
        let binary = power_at(KIND_WORDS).map_or(Some(()), |(exponent, span)| self.add_binary(exponent, span));
        let alike = power_at(2 * KIND_WORDS).map_or(Some(self.alike), |added| joined(self.alike, added).map(Some));
        self.has_no_double |= word(KINDS * KIND_WORDS) == 1 || alike.is_none();
        self.alike = alike.flatten();
        decimal.and(binary).ok_or_else(no_lattice)
    }

    /// The lattice of all points. Sets whose numbers have no common step, or that span 2^32 steps or more, are refused.
    pub fn ground(&self) -> Result<Ground, Failure> {
        let (length, span) = match (self.decimal, self.binary) {
            (None, None) => return Ok(Ground { length: Length::Decimal(0), offset: [0; 2], bits: 0 }),
            (Some((digits, span)), None) => (Length::Decimal(digits), span),
            (None, Some((exponent, span))) => (Length::Binary(exponent), span),
            (Some((digits, decimal)), Some((0, whole))) => {
                let whole = whole.times(10i128.checked_pow(digits)).ok_or_else(no_lattice)?;
                (Length::Decimal(digits), decimal.with(whole))
            }
            (Some(_), Some(binary)) => {
                let alike = self.alike.filter(|_| !self.has_no_double);
                let (exponent, span) = alike.and_then(|alike| joined(Some(binary), alike)).ok_or_else(no_lattice)?;
                (Length::Binary(exponent), span)
            }
        };
        let spans = [0, 1].map(|axis| span.high[axis].abs_diff(span.low[axis]));
        let bits = u128::BITS - (spans[0] | spans[1]).leading_zeros();
        if bits > u32::BITS {
            return Err(Failure::input(format!(
                "the points need {bits} bits in their common steps, and tiles and 'verify --memory' take at most 32: \
                 round the points, or work in one memory"
            )));
        }
        Ok(Ground { length, offset: span.low, bits })
    }
}

impl Ground {
    /// Adds the points of a piece to a list, laid onto the grid. `None` if a point is not on the lattice, which means
    /// that the input has changed.
    pub fn lay(&self, piece: &Coordinates, grid: &mut Vec<Point>) -> Option<()> {
        match piece {
            Coordinates::Steps { unit, .. } if unit.digits > 0 && matches!(self.length, Length::Binary(_)) => {
                if piece.count_no_doubles() > 0 {
                    return None;
                }
                self.lay(&Coordinates::Doubles(piece.doubles().into_owned()), grid)?;
            }
            Coordinates::Steps { steps, unit } => {
                let factor = match self.length {
                    Length::Decimal(digits) => 10i128.checked_pow(digits.checked_sub(unit.digits)?)?,
                    Length::Binary(exponent) => power_of_two(0, exponent)?,
                };
                for &point in steps {
                    grid.push(self.place(decimal(unit, point), factor)?);
                }
            }
            Coordinates::Doubles(points) if !points.is_empty() => {
                let (lattice, own) = Lattice::of_doubles(points)?;
                let exponent = exponent_of(&lattice);
                let factor = match self.length {
                    Length::Decimal(digits) => 10i128.checked_pow(digits).filter(|_| exponent == 0)?,
                    Length::Binary(finest) => power_of_two(exponent, finest)?,
                };
                for point in own {
                    grid.push(self.place(lattice.steps(point).map(i128::from), factor)?);
                }
            }
            Coordinates::Doubles(_) => {}
        }
        Some(())
    }

    #[inline]
    fn place(&self, value: [i128; 2], factor: i128) -> Option<Point> {
        let steps = |axis: usize| u32::try_from(value[axis].checked_mul(factor)? - self.offset[axis]).ok();
        Some(Point::new(steps(0)?, steps(1)?))
    }
}

/// The coordinates of a point in units of the last digit.
#[inline]
fn decimal(unit: &Unit, point: [i64; 2]) -> [i128; 2] {
    [0, 1].map(|axis| i128::from(point[axis]) * i128::from(unit.factor) + unit.offset[axis])
}

/// The step and the span of doubles; `Some(None)` if there are none, and `None` if they have no lattice.
fn lattice_of(points: &[[f64; 2]]) -> Option<Option<(i32, Span)>> {
    if points.is_empty() {
        return Some(None);
    }
    let (lattice, grid) = Lattice::of_doubles(points)?;
    let most = grid.iter().fold([0; 2], |most: [u32; 2], point| [most[0].max(point.x), most[1].max(point.y)]);
    let low = lattice.offset.map(i128::from);
    let span = Span { low, high: [0, 1].map(|axis| low[axis] + i128::from(most[axis])) };
    Some(Some((exponent_of(&lattice), span)))
}

/// Both spans in the shorter of both steps; `None` if the numbers become too large.
fn joined(old: Option<(i32, Span)>, (exponent, span): (i32, Span)) -> Option<(i32, Span)> {
    let (coarse, old) = old.unwrap_or((exponent, span));
    let finest = coarse.min(exponent);
    let old = old.times(power_of_two(coarse, finest))?;
    Some((finest, old.with(span.times(power_of_two(exponent, finest))?)))
}

fn exponent_of(lattice: &Lattice) -> i32 {
    match lattice.step {
        Step::Binary { exponent } => exponent,
        _ => 0,
    }
}

/// The number of steps of `2^fine` in one step of `2^coarse`; `None` if there are more than 2^64.
fn power_of_two(coarse: i32, fine: i32) -> Option<i128> {
    let shift = u32::try_from(i64::from(coarse) - i64::from(fine)).ok().filter(|&shift| shift <= 64)?;
    Some(1 << shift)
}

fn no_lattice() -> Failure {
    Failure::input(
        "the points lie on no common lattice of at most 32 bits, which tiles and 'verify --memory' need: round the points, \
         or work in one memory",
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whole(steps: &[[i64; 2]], digits: u32) -> Coordinates {
        Coordinates::Steps { steps: steps.to_vec(), unit: Unit::of_digits(digits) }
    }

    fn ground(pieces: &[Coordinates]) -> Result<(Length, u32, Vec<[u32; 2]>), Failure> {
        let mut extent = Extent::default();
        pieces.iter().try_for_each(|piece| extent.add(piece))?;
        let ground = extent.ground()?;
        // Processes that each saw some of the pieces find the same lattice.
        let mut together = Extent::default();
        for piece in pieces {
            let mut alone = Extent::default();
            alone.add(piece)?;
            together.add_words(&alone.to_words())?;
        }
        assert_eq!(together.ground()?, ground);
        let mut grid = Vec::new();
        pieces.iter().for_each(|piece| ground.lay(piece, &mut grid).expect("the points are on the lattice"));
        Ok((ground.length, ground.bits, grid.iter().map(|point| [point.x, point.y]).collect()))
    }

    #[test]
    fn one_step_fits_all_pieces() {
        let halves = Coordinates::Doubles(vec![[0.5, -1.0]]);
        let quarters = Coordinates::Doubles(vec![[0.25, 4.0], [0.0, 0.0]]);
        let found = ground(&[halves.clone(), quarters, whole(&[[1, -1]], 0)]).expect("quarters");
        assert_eq!(found, (Length::Binary(-2), 5, vec![[2, 0], [1, 20], [0, 4], [4, 0]]));
        let found = ground(&[whole(&[[15, 0]], 1), whole(&[[-3, 7]], 0), Coordinates::Doubles(vec![[2.0, 1.0]])]);
        assert_eq!(found, Ok((Length::Decimal(1), 7, vec![[45, 0], [0, 70], [50, 10]])));
        // Decimals that are doubles have a lattice in common with doubles, and others have none.
        let found = ground(&[whole(&[[15, 0]], 1), halves.clone()]);
        assert_eq!(found, Ok((Length::Binary(-1), 2, vec![[2, 2], [0, 0]])));
        assert!(ground(&[whole(&[[14, 0]], 1), halves]).is_err());
        assert_eq!(ground(&[]), Ok((Length::Decimal(0), 0, vec![])));
    }

    #[test]
    fn spans_end_at_32_bits() {
        assert!(ground(&[whole(&[[i64::MIN, 0], [i64::MIN + (1 << 32) - 1, 5]], 0)]).is_err(), "beyond 9.2e18");
        assert!(ground(&[whole(&[[-7, 0]], 0), whole(&[[(1 << 32) - 8, 5]], 0)]).is_ok());
        let failure = ground(&[whole(&[[-7, 0]], 0), whole(&[[(1 << 32) - 7, 5]], 0)]).expect_err("33 bits");
        assert!(failure.message.contains("33 bits"), "{failure}");
        assert!(ground(&[Coordinates::Doubles(vec![[0.1, 0.0], [1.0, 0.0]])]).is_err());
        let far = [Coordinates::Doubles(vec![[1e18, 0.0]]), Coordinates::Doubles(vec![[0.5, 0.0]])];
        assert!(ground(&far).is_err());
    }
}
