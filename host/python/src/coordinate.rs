//! Single coordinates as numbers of Python, without rounding.

use pyo3::prelude::*;
use pyo3::types::PyFloat;

use crate::error::bad_input;

/// A type of numbers that a coordinate of Python can become.
pub trait Coordinate: Sized + Copy {
    /// The name of the type in numpy.
    const NAME: &'static str;

    /// The number of an integer; `None` if the type does not hold it.
    fn of_integer(value: i128) -> Option<Self>;

    /// The number of a double; `None` if the type does not hold it.
    fn of_double(value: f64) -> Option<Self>;
}

macro_rules! whole {
    ($($number:ty: $name:literal),*) => {$(
        impl Coordinate for $number {
            const NAME: &'static str = $name;

            fn of_integer(value: i128) -> Option<Self> {
                value.try_into().ok()
            }

            fn of_double(value: f64) -> Option<Self> {
                // The conversion cuts off and saturates at the ends of 128 bits, which none of the types reaches.
                let whole = value as i128;
                (whole as f64 == value).then(|| Self::of_integer(whole)).flatten()
            }
        }
    )*};
}

whole!(i32: "int32", i64: "int64", u32: "uint32");

impl Coordinate for f64 {
    const NAME: &'static str = "float64";

    fn of_integer(value: i128) -> Option<Self> {
        // A double beyond 128 bits saturates on the way back, and differs.
        let double = value as f64;
        (double as i128 == value).then_some(double)
    }

    fn of_double(value: f64) -> Option<Self> {
        Some(value)
    }
}

impl Coordinate for f32 {
    const NAME: &'static str = "float32";

    fn of_integer(value: i128) -> Option<Self> {
        f64::of_integer(value).and_then(Self::of_double)
    }

    fn of_double(value: f64) -> Option<Self> {
        let single = value as f32;
        // A number that is none stays one, and the library refuses it.
        (f64::from(single) == value || value.is_nan()).then_some(single)
    }
}

/// A coordinate of a place, from any number of Python or numpy.
pub fn coordinate<T: Coordinate>(axis: char, value: &Bound<'_, PyAny>) -> PyResult<T> {
    let exact = if let Ok(double) = value.cast::<PyFloat>() {
        T::of_double(double.extract()?)
    } else if let Ok(integer) = value.extract::<i128>() {
        T::of_integer(integer)
    } else {
        let double: f64 = value.extract()?;
        // Python compares numbers of different types exactly.
        if value.eq(double)? {
            T::of_double(double)
        } else {
            None
        }
    };
    let (py, name) = (value.py(), T::NAME);
    let text = || value.repr().map_or_else(|_| String::from("a number"), |text| text.to_string());
    exact.ok_or_else(|| bad_input(py, &format!("the {axis} of the place is {}, which {name} cannot hold", text())))
}
