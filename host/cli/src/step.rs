//! The steps of grids and of contour lines: positive decimals, and their multiples in a range.

use crate::failure::{quoted, Failure};
use crate::number::{self, Decimal, Number};

/// Multiples of more steps than this are not told from their neighbours by doubles with certainty.
const MOST_STEPS: f64 = 1e15;

/// A step as a user wrote it.
pub struct Step {
    /// The length of the step.
    pub decimal: Decimal,
    /// The option and its value, for messages.
    name: String,
}

impl Step {
    /// Reads the step of an option such as `--grid`, for which `example` is a good value.
    ///
    /// # Errors
    /// The text is no positive number, or its digits do not fit 64 bits.
    pub fn read(option: &str, text: &str, example: &str) -> Result<Self, Failure> {
        let name = format!("{option} {}", quoted(text.as_bytes()));
        let refuse = |why: &str| Failure::input(format!("{name} {why}, such as {example}"));
        match number::parse(text.trim().as_bytes()) {
            Some(Number::Decimal(decimal @ Decimal { steps: 1.., .. })) => Ok(Self { decimal, name }),
            Some(Number::Decimal(Decimal { steps: 0, .. })) => Err(refuse("is zero: give a positive step")),
            Some(Number::Decimal(_)) => Err(refuse("is negative: give a positive step")),
            Some(Number::Double(nearest) | Number::Beyond(nearest)) if nearest.value.is_finite() => {
                Err(refuse(match nearest.value {
                    ..0.0 => "is negative: give a positive step",
                    0.0 => "is too small to be told from zero: give a larger step",
                    _ => "needs more than 64 bits: give a step of up to 18 digits, leading zeros not counted",
                }))
            }
            Some(_) => Err(refuse("is not finite: give a positive step")),
            None => Err(refuse("is not a number: give a positive step")),
        }
    }

    /// The first and the last multiple between two values, both included, in steps. The first is greater than the last
    /// if no multiple lies there.
    ///
    /// # Errors
    /// The values lie too many steps from zero.
    pub fn multiples(&self, low: f64, high: f64, what: &str) -> Result<[i64; 2], Failure> {
        let length = self.times(1);
        let farthest = (low / length).abs().max((high / length).abs());
        if farthest > MOST_STEPS {
            return Err(self.refuse(&format!(
                "is too small for the {what}, which lie up to {farthest:.3e} steps from zero, and {MOST_STEPS:e} is \
                 the most"
            )));
        }
        let ends = [number::multiple_from(low, self.decimal), number::multiple_to(high, self.decimal)];
        Ok(ends.map(|end| end as i64))
    }

    /// A failure that tells why the step is too small.
    pub fn refuse(&self, why: &str) -> Failure {
        Failure::input(format!("{} {why}: give a larger step", self.name))
    }

    /// The double nearest to a number of steps.
    pub fn times(&self, steps: i64) -> f64 {
        number::nearest(i128::from(steps) * i128::from(self.decimal.steps), self.decimal.digits)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str) -> String {
        Step::read("--grid", text, "0.5").err().map_or_else(String::new, |failure| failure.message)
    }

    #[test]
    fn each_wrong_step_has_its_sentence() {
        for (text, why) in [
            ("0", "--grid '0' is zero: give a positive step, such as 0.5"),
            ("-0.0", "is zero"),
            ("-1", "--grid '-1' is negative: give a positive step, such as 0.5"),
            ("-1e30", "is negative"),
            ("wide", "--grid 'wide' is not a number: give a positive step, such as 0.5"),
            ("", "is not a number"),
            ("nan", "is not finite"),
            ("1e999", "is not finite"),
            (
                "1e19",
                "--grid '1e19' needs more than 64 bits: give a step of up to 18 digits, leading zeros not counted, such \
                 as 0.5",
            ),
            ("12345678901234567890", "needs more than 64 bits"),
            ("0.12345678901234567891", "needs more than 64 bits"),
            ("1e-400", "is too small to be told from zero"),
        ] {
            assert!(message(text).contains(why), "{text}: {}", message(text));
        }
        for good in ["1e18", "9223372036854775807", "0.000000000000000001", " 7 ", "1e-300", "+2.50"] {
            assert_eq!(message(good), "", "{good}");
        }
    }

    #[test]
    fn multiples_lie_in_their_range() {
        let multiples = |text: &str, low, high| {
            let step = Step::read("--contours", text, "10").expect("a step");
            step.multiples(low, high, "values").map_err(|failure| failure.message)
        };
        assert_eq!(multiples("0.1", 0.0, 0.3), Ok([0, 3]));
        assert_eq!(multiples("2", -3.0, 3.5), Ok([-1, 1]));
        assert_eq!(multiples("7", 1.0, 6.0), Ok([1, 0]));
        assert_eq!(
            multiples("1", 1e16, 1e16 + 8.0),
            Err("--contours '1' is too small for the values, which lie up to 1.000e16 steps from zero, and 1e15 is the \
                 most: give a larger step"
                .to_owned())
        );
    }
}
