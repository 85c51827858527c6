//! Numbers as they are written in a text, without rounding if the digits fit 64 bits.
//!
//! A text such as `-101.473911` is a decimal, and most decimals are no double. So a number is read as a whole number of
//! steps of a power of ten, which is exact. Only a number of more than 18 or 19 digits becomes the nearest double.

use std::cmp::Ordering;
use std::fmt;

/// Decimals with more digits behind the point than this are read as doubles. No double but 0 is nearest to a step of
/// more digits, and reports tell the length of steps as doubles.
const MOST_DIGITS: u32 = 323;
/// Numbers with more digits behind the point than this are shown with an exponent.
const MOST_DIGITS_SHOWN: u32 = 25;
/// The most digits behind the point of a decimal with which coordinates are compared.
pub const MOST_DIGITS_COMPARED: u32 = 18;
/// The number of decimal digits that always fit 64 bits.
const SAFE_LEN: usize = 18;

/// A number as it is written in a text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Number {
    /// A decimal, exactly.
    Decimal(Decimal),
    /// The nearest double of a whole number that is written without an exponent and is beyond 64 bits.
    Beyond(Nearest),
    /// The nearest double of any other number. Infinities and NaN are among them.
    Double(Nearest),
}

/// The double that is nearest to a number of a text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// The double.
    pub value: f64,
    /// Whether the double is the number, and not only near to it.
    pub is_exact: bool,
}

impl Number {
    /// The number `steps * 10^-digits`, which is a decimal if its shortest form fits 64 bits.
    pub fn of_decimal(mut steps: i128, mut digits: u32) -> Self {
        while digits > 0 && steps % 10 == 0 {
            (steps, digits) = (steps / 10, if steps == 0 { 0 } else { digits - 1 });
        }
        match i64::try_from(steps) {
            Ok(steps) => Self::Decimal(Decimal { steps, digits }),
            Err(_) => Self::Double(Nearest { value: nearest(steps, digits), is_exact: is_double(steps, digits) }),
        }
    }

    /// The double that is nearest to the number.
    pub fn nearest(self) -> Nearest {
        match self {
            Self::Decimal(Decimal { steps, digits }) => {
                let steps = i128::from(steps);
                Nearest { value: nearest(steps, digits), is_exact: is_double(steps, digits) }
            }
            Self::Beyond(nearest) | Self::Double(nearest) => nearest,
        }
    }
}

/// The decimal `steps * 10^-digits`. The number of digits is the smallest possible one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Decimal {
    /// The decimal in steps.
    pub steps: i64,
    /// Digits behind the point.
    pub digits: u32,
}

impl Decimal {
    /// The decimal with as few digits behind the point as it needs.
    fn shortest(mut steps: i64, mut digits: u32) -> Self {
        while digits > 0 && steps % 10 == 0 {
            if steps == 0 {
                return Self { steps, digits: 0 };
            }
            steps /= 10;
            digits -= 1;
        }
        Self { steps, digits }
    }
}

/// Reads a text as a number; `None` if the text is no number. Numbers are the texts that the standard library reads as
/// doubles, without spaces around them.
pub fn parse(text: &[u8]) -> Option<Number> {
    short(text).map(Number::Decimal).or_else(|| long(text))
}

/// Reads a decimal without an exponent that has at most 18 digits, which is the usual case.
fn short(text: &[u8]) -> Option<Decimal> {
    leading(text).filter(|(_, rest)| rest.is_empty()).map(|(decimal, _)| decimal)
}

/// Reads a decimal without an exponent at the start of a text, and returns the rest of the text as well. If a
/// decimal has more than 18 digits, the rest begins with some of them.
#[inline]
pub fn leading(text: &[u8]) -> Option<(Decimal, &[u8])> {
    let (sign, unsigned) = match text {
        [b'-', rest @ ..] => (-1, rest),
        _ => (1, text),
    };
    let (whole, rest) = digits(unsigned, SAFE_LEN, 0);
    let len = unsigned.len() - rest.len();
    match rest {
        [b'.', behind @ ..] => {
            let (steps, rest) = digits(behind, SAFE_LEN - len, whole);
            let places = behind.len() - rest.len();
            (len + places > 0).then(|| (Decimal::shortest(sign * steps, places as u32), rest))
        }
        _ => (len > 0).then_some((Decimal { steps: sign * whole, digits: 0 }, rest)),
    }
}

/// Reads up to `most` digits at the start of a text behind those of `steps`, and returns the rest of the text as well.
#[inline]
fn digits(text: &[u8], most: usize, mut steps: i64) -> (i64, &[u8]) {
    let most = most.min(text.len());
    for (index, byte) in text[..most].iter().enumerate() {
        let digit = byte.wrapping_sub(b'0');
        if digit > 9 {
            return (steps, &text[index..]);
        }
        steps = steps * 10 + i64::from(digit);
    }
    (steps, &text[most..])
}

/// Reads any number. The standard library decides what is a number.
fn long(text: &[u8]) -> Option<Number> {
    let value: f64 = std::str::from_utf8(text).ok()?.parse().ok()?;
    if let Some(decimal) = value.is_finite().then(|| exact(text)).flatten() {
        return Some(Number::Decimal(decimal));
    }
    let nearest = Nearest { value, is_exact: value.is_finite() && is_written_out(text, value) };
    Some(if is_whole(text) { Number::Beyond(nearest) } else { Number::Double(nearest) })
}

/// The most digits of a double that is written out in full.
const LONGEST_DOUBLE: usize = 767;

/// Whether a valid number is equal to the double that is nearest to it.
fn is_written_out(text: &[u8], value: f64) -> bool {
    let number = significant(text);
    let digit = |steps: i128, digit: &u8| steps.checked_mul(10)?.checked_add(i128::from(digit - b'0'));
    let places = u32::try_from(number.0.len() as i64 - 1 - number.1);
    if let (Some(steps), Ok(places)) = (number.0.iter().try_fold(0, digit), places) {
        return value != 0.0 && is_double(steps, places);
    }
    // A text of few digits rarely passes the first comparison, which is much quicker than that of all digits.
    let is_equal = |digits: usize| significant(format!("{value:.digits$e}").as_bytes()) == number;
    value != 0.0 && number.0.len() <= LONGEST_DOUBLE && is_equal(number.0.len()) && is_equal(LONGEST_DOUBLE)
}

/// The digits of a valid number without zeros at either end, and the power of ten of the first digit.
fn significant(text: &[u8]) -> (Vec<u8>, i64) {
    let mut parts = text.splitn(2, |byte| byte.eq_ignore_ascii_case(&b'e'));
    let mantissa = parts.next().unwrap_or_default();
    let exponent = parts.next().and_then(|text| std::str::from_utf8(text).ok()?.parse().ok()).unwrap_or(0i64);
    let point = mantissa.iter().position(|&byte| byte == b'.').unwrap_or(mantissa.len());
    let whole = mantissa[..point].iter().filter(|byte| byte.is_ascii_digit()).count();
    let digits = mantissa.iter().copied().filter(u8::is_ascii_digit);
    let zeros = digits.clone().take_while(|&digit| digit == b'0').count();
    let mut digits: Vec<u8> = digits.skip(zeros).collect();
    digits.truncate(digits.iter().rposition(|&digit| digit != b'0').map_or(0, |last| last + 1));
    (digits, exponent.saturating_add(whole as i64 - zeros as i64 - 1))
}

/// Whether a number is written as digits alone, perhaps with a sign.
fn is_whole(text: &[u8]) -> bool {
    text.strip_prefix(b"-").or(text.strip_prefix(b"+")).unwrap_or(text).iter().all(u8::is_ascii_digit)
}

/// The decimal of a valid number, if its steps fit 64 bits.
fn exact(text: &[u8]) -> Option<Decimal> {
    let is_negative = text.starts_with(b"-");
    let unsigned = text.strip_prefix(b"-").or(text.strip_prefix(b"+")).unwrap_or(text);
    let mut parts = unsigned.splitn(2, |byte| byte.eq_ignore_ascii_case(&b'e'));
    let mut mantissa = parts.next()?.splitn(2, |&byte| byte == b'.');
    let exponent: i64 = parts.next().map_or(Some(0), |text| std::str::from_utf8(text).ok()?.parse().ok())?;
    let whole = mantissa.next()?;
    let fraction = mantissa.next().unwrap_or_default();
    let fraction = &fraction[..fraction.len() - fraction.iter().rev().take_while(|&&byte| byte == b'0').count()];
    let mut steps = 0i64;
    for byte in whole.iter().chain(fraction) {
        let digit = i64::from(byte - b'0');
        // Negative numbers are counted down, because the smallest one has no positive counterpart.
        let digit = if is_negative { -digit } else { digit };
        steps = steps.checked_mul(10)?.checked_add(digit)?;
    }
    if steps == 0 {
        return Some(Decimal { steps: 0, digits: 0 });
    }
    let digits = i64::try_from(fraction.len()).ok()?.checked_sub(exponent)?;
    if digits >= 0 {
        let decimal = Decimal::shortest(steps, u32::try_from(digits).ok()?);
        return (decimal.digits <= MOST_DIGITS).then_some(decimal);
    }
    let power = 10i64.checked_pow(u32::try_from(-digits).ok()?)?;
    Some(Decimal { steps: steps.checked_mul(power)?, digits: 0 })
}

/// The least multiple of a positive step whose nearest double is `value` or above, counted in steps. For up to 10^15
/// steps: a quotient of doubles alone would lose multiples by its rounding, such as 0.3 / 0.1.
pub fn multiple_from(value: f64, step: Decimal) -> f64 {
    let near = (value / Number::Decimal(step).nearest().value).round();
    let at = |multiple: f64| nearest(multiple as i128 * i128::from(step.steps), step.digits);
    [near - 1.0, near].into_iter().find(|&multiple| at(multiple) >= value).unwrap_or(near + 1.0)
}

/// The greatest multiple of a positive step whose nearest double is `value` or below. See [`multiple_from`].
pub fn multiple_to(value: f64, step: Decimal) -> f64 {
    0.0 - multiple_from(-value, step)
}

/// The double that is nearest to `steps * 10^-digits`.
pub fn nearest(steps: i128, digits: u32) -> f64 {
    const EXACT: i128 = 1 << 53;
    if (-EXACT..=EXACT).contains(&steps) && digits <= 22 {
        // Both operands are exact, so the quotient is rounded once.
        return steps as f64 / 10f64.powi(digits as i32);
    }
    // The standard library rounds every text correctly.
    format!("{steps}e-{digits}").parse().unwrap_or_default()
}

/// Whether `steps * 10^-digits` is a double.
pub fn is_double(steps: i128, digits: u32) -> bool {
    if steps == 0 {
        return true;
    }
    // The number is a multiple of a power of two only if `5^digits` divides the steps. 5^54 is the last below 2^127.
    let multiple = match i64::try_from(steps) {
        Ok(steps) if digits <= 27 => {
            let power = 5i64.pow(digits);
            (steps % power == 0).then(|| i128::from(steps / power))
        }
        _ => 5i128.checked_pow(digits).filter(|power| steps % power == 0).map(|power| steps / power),
    };
    // The power of two is at least 2^-54, far above the smallest double.
    multiple.is_some_and(|number| number.unsigned_abs() >> number.trailing_zeros() < 1 << f64::MANTISSA_DIGITS)
}

/// Compares a coordinate, exactly, with a decimal of up to [`MOST_DIGITS_COMPARED`] digits behind the point.
pub fn compare(coordinate: Coordinate, with: Decimal) -> Ordering {
    match coordinate {
        Coordinate::Double(value) => compare_double(value, with),
        Coordinate::Decimal { steps, digits } => {
            let common = digits.max(with.digits);
            // The other decimal is below 2^63 * 10^18 in the common steps, so a value that overflows is farther from
            // zero.
            let steps = 10i128.checked_pow(common - digits).and_then(|power| steps.checked_mul(power)).ok_or(steps);
            let with = i128::from(with.steps) * 10i128.pow(common - with.digits);
            steps.map_or_else(|beyond| beyond.cmp(&0), |steps| steps.cmp(&with))
        }
    }
}

/// Compares a double, exactly, with a decimal of up to [`MOST_DIGITS_COMPARED`] digits behind the point.
fn compare_double(value: f64, with: Decimal) -> Ordering {
    let nearest = nearest(i128::from(with.steps), with.digits);
    if value != nearest || value == 0.0 {
        // No double lies between a decimal and the double that is nearest to it.
        return value.total_cmp(&nearest);
    }
    // The double is mantissa * 2^exponent. Neither side of the comparison exceeds about steps * 2^53, which fits.
    let bits = value.to_bits();
    let mantissa = i128::from(bits & ((1 << 52) - 1) | 1 << 52) * if value < 0.0 { -1 } else { 1 };
    let exponent = ((bits >> 52) & 0x7ff) as i32 - 1075;
    let (left, right) = (mantissa * 10i128.pow(with.digits), i128::from(with.steps));
    if exponent < 0 {
        left.cmp(&(right << -exponent))
    } else {
        (left << exponent).cmp(&right)
    }
}

/// A coordinate in the numbers of its file, to be shown or written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Coordinate {
    /// The decimal `steps * 10^-digits`.
    Decimal {
        /// The decimal in steps.
        steps: i128,
        /// Digits behind the point.
        digits: u32,
    },
    /// A double, shown in the fewest digits that tell it from all others.
    Double(f64),
}

impl From<Decimal> for Coordinate {
    fn from(Decimal { steps, digits }: Decimal) -> Self {
        Self::Decimal { steps: steps.into(), digits }
    }
}

impl fmt::Display for Coordinate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Double(value) if value == 0.0 || (1e-7..1e17).contains(&value.abs()) => write!(f, "{value}"),
            Self::Double(value) => write!(f, "{value:e}"),
            Self::Decimal { steps, digits: 0 } => write!(f, "{steps}"),
            Self::Decimal { steps, digits } if digits > MOST_DIGITS_SHOWN => write!(f, "{steps}e-{digits}"),
            Self::Decimal { mut steps, mut digits } => {
                while digits > 0 && steps % 10 == 0 {
                    steps /= 10;
                    digits -= 1;
                }
                let power = 10u128.pow(digits);
                let (whole, fraction) = (steps.unsigned_abs() / power, steps.unsigned_abs() % power);
                let sign = if steps < 0 { "-" } else { "" };
                match digits {
                    0 => write!(f, "{sign}{whole}"),
                    _ => write!(f, "{sign}{whole}.{fraction:0width$}", width = digits as usize),
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
