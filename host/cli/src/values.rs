//! Parsers of the values of arguments. The error of a wrong value is a sentence for the user.

use std::cmp::Ordering;
use std::net::SocketAddrV4;
use std::num::NonZeroU32;
use std::time::Duration;

use clap::ValueEnum;
use incircle::constraints::Domain;
use incircle::serial::Address;
use incircle::{DeviceAddress, Error, Order, Quantize};
use incircle_protocol::UDP_PORT;
use incircle_testkit::Distribution;

use crate::formats::{Bounds, MeshFormat};
use crate::number::{self, Decimal, Number, MOST_DIGITS_COMPARED};
use crate::script::Recipe;

/// Parses the name of an order. Help and completions show the names.
pub fn order_parser() -> impl clap::builder::TypedValueParser<Value = Order> {
    OrderParser
}

#[derive(Clone)]
struct OrderParser;

impl clap::builder::TypedValueParser for OrderParser {
    type Value = Order;

    fn parse_ref(
        &self,
        command: &clap::Command,
        argument: Option<&clap::Arg>,
        value: &std::ffi::OsStr,
    ) -> Result<Order, clap::Error> {
        clap::builder::StringValueParser::new()
            .try_map(|name| name.parse::<Order>())
            .parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = clap::builder::PossibleValue> + '_>> {
        Some(Box::new(Order::ALL.map(Order::name).into_iter().map(clap::builder::PossibleValue::new)))
    }
}

/// Parses the name of a generated set. Help shows the names with a description of each set.
pub fn distribution_parser() -> impl clap::builder::TypedValueParser<Value = Distribution> {
    use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
    let named = |set: Distribution| PossibleValue::new(set.name()).help(set.description());
    PossibleValuesParser::new(Distribution::ALL.map(named)).try_map(|name| name.parse::<Distribution>())
}

/// Parses the name of a domain. Help shows the names with a description of each.
pub fn domain_parser() -> impl clap::builder::TypedValueParser<Value = Domain> {
    use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
    let named = |domain: Domain| {
        PossibleValue::new(domain.name()).help(match domain {
            Domain::All => "All triangles of the hull",
            Domain::Holes => "Triangles that constraints separate from the outside and from all holes",
            Domain::EvenOdd => "Triangles that an odd number of rings surround",
            Domain::NonZero => "Triangles that rings run around more often in one direction than in the other",
        })
    };
    PossibleValuesParser::new(Domain::ALL.map(named)).try_map(|name| name.parse::<Domain>())
}

/// A set or a script, which `incircle generate` makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Made {
    /// A set of points.
    Set(Distribution),
    /// A script.
    Script(Recipe),
}

/// Parses the name of a generated set or script. Help shows the names with a description of each.
pub fn made_parser() -> impl clap::builder::TypedValueParser<Value = Made> {
    use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
    let sets = Distribution::ALL.map(|set| PossibleValue::new(set.name()).help(set.description()));
    let scripts = Recipe::ALL.map(|recipe| PossibleValue::new(recipe.name()).help(recipe.description()));
    PossibleValuesParser::new(sets.into_iter().chain(scripts)).try_map(|name| {
        let recipe = Recipe::ALL.into_iter().find(|recipe| recipe.name() == name);
        recipe.map_or_else(|| name.parse().map(Made::Set), |recipe| Ok(Made::Script(recipe)))
    })
}

/// Parses the address of a back end. Help and completions show the forms of addresses.
pub fn backend_parser() -> impl clap::builder::TypedValueParser<Value = DeviceAddress> {
    BackendParser
}

#[derive(Clone)]
struct BackendParser;

impl clap::builder::TypedValueParser for BackendParser {
    type Value = DeviceAddress;

    fn parse_ref(
        &self,
        command: &clap::Command,
        argument: Option<&clap::Arg>,
        value: &std::ffi::OsStr,
    ) -> Result<DeviceAddress, clap::Error> {
        clap::builder::StringValueParser::new().try_map(|text| backend_from(&text)).parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = clap::builder::PossibleValue> + '_>> {
        Some(Box::new(DeviceAddress::FORMS.into_iter().map(clap::builder::PossibleValue::new)))
    }
}

/// Parses the address of a device. The error leaves out the address, because clap names the value itself.
fn backend_from(text: &str) -> Result<DeviceAddress, String> {
    text.parse().map_err(|error| match error {
        Error::Address { reason, .. } => reason,
        other => other.to_string(),
    })
}

/// Parses a serial port, with or without choices behind it.
pub fn port_from(text: &str) -> Result<Address, String> {
    Address::parse(text).unwrap_or_else(|| Address::parse_port(text))
}

/// Parses an IPv4 address with a UDP port, or without it for the usual port.
pub fn network_from(text: &str) -> Result<SocketAddrV4, String> {
    let alone = text.parse().map(|address| SocketAddrV4::new(address, UDP_PORT));
    alone.or_else(|_| text.parse()).map_err(|_| "an IPv4 address is needed, such as 192.168.1.255".to_owned())
}

/// Parses the name of a format that a mesh can be read from.
pub fn readable_format_parser() -> impl clap::builder::TypedValueParser<Value = MeshFormat> {
    use clap::builder::{PossibleValuesParser, TypedValueParser};
    let readable = MeshFormat::value_variants().iter().filter(|format| format.is_readable());
    let names = PossibleValuesParser::new(readable.filter_map(MeshFormat::to_possible_value));
    names.try_map(|name| MeshFormat::from_str(&name, false))
}

/// Parses the value of `--quantize`: `fit`, a scale, or a scale with an offset.
pub fn quantize_from(text: &str) -> Result<Quantize, String> {
    if text == "fit" {
        return Ok(Quantize::Fit);
    }
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse::<f64>()).collect();
    let (scale, offset) = match numbers.as_deref() {
        Ok(&[scale]) => (scale, [0.0, 0.0]),
        Ok(&[scale, x, y]) => (scale, [x, y]),
        _ => return Err("give 'fit', a scale, or a scale and an offset 'SCALE,X0,Y0'".to_owned()),
    };
    if scale > 0.0 && scale.is_finite() && offset.iter().all(|value| value.is_finite()) {
        Ok(Quantize::Scale { scale, offset })
    } else {
        Err("the scale must be positive, and all numbers finite".to_owned())
    }
}

/// Parses the value of `--class`: classes of LiDAR points, separated by commas.
pub fn class_from(text: &str) -> Result<u8, String> {
    text.trim().parse().map_err(|_| "give classes from 0 to 255, such as 2,9".to_owned())
}

/// Parses the value of `--bounds`: a rectangle in decimals, which stay as they are written.
pub fn bounds_from(text: &str) -> Result<Bounds, String> {
    let number = |part: &str| match number::parse(part.trim().as_bytes()) {
        Some(Number::Decimal(decimal)) if decimal.digits <= MOST_DIGITS_COMPARED => Some(decimal),
        _ => None,
    };
    let numbers: Option<Vec<Decimal>> = text.split(',').map(number).collect();
    let Some(&[x0, y0, x1, y1]) = numbers.as_deref() else {
        return Err("give four decimals of up to 18 digits 'X0,Y0,X1,Y1'".to_owned());
    };
    let is_low = |low: Decimal, high| number::compare(low.into(), high) != Ordering::Greater;
    if is_low(x0, x1) && is_low(y0, y1) {
        Ok(Bounds { low: [x0, y0], high: [x1, y1] })
    } else {
        Err("the first two numbers are the lowest x and y, the last two the highest".to_owned())
    }
}

/// A parser of whole numbers from `least` to `most`.
pub fn whole_number(least: u32, most: u32) -> impl Fn(&str) -> Result<u32, String> + Clone + Send + Sync + 'static {
    move |text| {
        let number = text.parse().ok().filter(|number| (least..=most).contains(number));
        number.ok_or_else(|| format!("give a whole number from {least} to {most}"))
    }
}

/// Parses a number of bytes, such as `300M`. K, M and G are powers of 1,024.
pub fn bytes_from(text: &str) -> Result<u64, String> {
    const LEAST: u64 = 1 << 16;
    let (number, unit) = match text.as_bytes().last() {
        Some(b'K' | b'k') => (&text[..text.len() - 1], 1 << 10),
        Some(b'M' | b'm') => (&text[..text.len() - 1], 1 << 20),
        Some(b'G' | b'g') => (&text[..text.len() - 1], 1 << 30),
        _ => (text, 1u64),
    };
    let bytes = number.parse::<u64>().ok().and_then(|number| number.checked_mul(unit));
    bytes
        .filter(|&bytes| bytes >= LEAST)
        .ok_or_else(|| "give a number of bytes from 64K, such as 300M or 2G; K, M and G are the units".to_owned())
}

/// Parses a number of threads.
pub fn threads_from(text: &str) -> Result<NonZeroU32, String> {
    text.parse().map_err(|_| {
        format!("give a whole number from 1 to {}, or leave the option out for one thread on each processor", u32::MAX)
    })
}

/// Parses a positive number of seconds.
pub fn seconds_from(text: &str) -> Result<Duration, String> {
    let seconds: f64 = text.parse().map_err(|_| "give seconds, such as 2.5".to_owned())?;
    match Duration::try_from_secs_f64(seconds) {
        Ok(duration) if !duration.is_zero() => Ok(duration),
        _ => Err("give a positive number of seconds, up to 1e19".to_owned()),
    }
}

/// Parses a positive number of megahertz.
pub fn mhz_from(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(mhz) if mhz > 0.0 && mhz.is_finite() => Ok(mhz),
        _ => Err("give a positive number of megahertz".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use incircle::pcie::CardAddress;
    use incircle_protocol::FULL;

    #[test]
    fn quantisation_is_read() {
        assert_eq!(quantize_from("fit"), Ok(Quantize::Fit));
        let scale = Quantize::Scale { scale: 2.0, offset: [-1.5, 0.0] };
        assert_eq!(quantize_from("2,-1.5,0"), Ok(scale));
        for bad in ["", "0", "-1", "nan", "1,2", "fill", "1,inf,0"] {
            assert!(quantize_from(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn bounds_are_decimals_from_low_to_high() {
        let decimal = |steps, digits| Decimal { steps, digits };
        let bounds = Bounds { low: [decimal(-15, 1), decimal(0, 0)], high: [decimal(-15, 1), decimal(1, 18)] };
        assert_eq!(bounds_from("-1.5, 0,-1.50,1e-18"), Ok(bounds));
        for bad in ["", "0,0,1", "0,0,1,1,1", "1,0,0,1", "0,1e-18,1,0", "0,0,1,1e-19", "0,0,1,1e300", "nan,0,1,1"] {
            assert!(bounds_from(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn back_ends_are_names_or_addresses() {
        let serial = Address { port: "/dev/x".to_owned(), baud: 115_200, slow: 9 };
        assert_eq!(backend_from("clock"), Ok(DeviceAddress::Clock { config: None }));
        assert_eq!(backend_from("clock?config=full"), Ok(DeviceAddress::Clock { config: Some(FULL) }));
        assert_eq!(backend_from("serial:/dev/x?baud=115200&slow=9"), Ok(DeviceAddress::Serial(serial.clone())));
        assert_eq!(port_from("/dev/x?baud=115200&slow=9"), Ok(serial.clone()));
        assert_eq!(port_from("serial:/dev/x?baud=115200&slow=9"), Ok(serial));
        assert_eq!(backend_from("pcie:1"), Ok(DeviceAddress::Pcie(CardAddress::of_number(1))));
        for bad in [
            "",
            "serial:",
            "serial",
            "/dev/x",
            "serial:/dev/x?baud=fast",
            "pcie",
            "pcie:",
            "pcie:999",
            "clock?config=9",
        ] {
            assert!(backend_from(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn whole_numbers_have_bounds() {
        let bits = whole_number(8, 31);
        assert_eq!((bits("8"), bits("31")), (Ok(8), Ok(31)));
        for bad in ["", "7", "32", "-1", "1e1", "99999999999999999999"] {
            assert_eq!(bits(bad), Err("give a whole number from 8 to 31".to_owned()), "{bad}");
        }
        assert_eq!(threads_from("3").map(NonZeroU32::get), Ok(3));
        for bad in ["", "0", "-1", "many", "4294967296"] {
            assert!(threads_from(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn bytes_have_units() {
        assert_eq!(bytes_from("65536"), Ok(1 << 16));
        assert_eq!([bytes_from("64K"), bytes_from("3m"), bytes_from("2G")], [Ok(1 << 16), Ok(3 << 20), Ok(2 << 30)]);
        for bad in ["", "G", "0", "65535", "1.5G", "-1G", "99999999999G", "1GB", "\u{2135}"] {
            assert!(bytes_from(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn times_and_frequencies_are_positive() {
        assert_eq!(seconds_from("2.5"), Ok(Duration::from_millis(2500)));
        assert_eq!(mhz_from("62.5"), Ok(62.5));
        for bad in ["", "0", "-1", "nan", "inf", "1e400", "fast"] {
            assert!(seconds_from(bad).is_err(), "{bad}");
            assert!(mhz_from(bad).is_err(), "{bad}");
        }
    }
}
