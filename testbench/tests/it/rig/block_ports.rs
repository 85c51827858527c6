//! Ports of a block by name and as numbers: those of its Rust form, and those of its Verilated Verilog. Packed structures travel as
//! one number.

#![allow(dead_code)] // Every test that includes this uses a part of it.

use std::collections::BTreeMap;

use incircle_hdl::engine::{
    Attempt, Bundle, CommitJob, Deal, Entry, Plan, ReleaseJob, Token, Turned, Verdict, Write, WriteEnables,
};
use incircle_hdl::leaf::Unpacked;
use incircle_hdl::link::types::{
    Activity, AnswerProgress, Arrival, Clearing, EngineState, Head, Request, TakenWord, Tally,
};
use incircle_hdl::link::{AnswerBeat, CommandState};
use incircle_hdl::mesh::Record;
use incircle_hdl::serial::types::{AnswerPlace, BytePlace, Contents, FrameHead, Lamps, Receipt, Session};
use incircle_hdl::serial::Asked;
use incircle_hdl::stream::{AnswerEvents, CommandEvents};
use rust_hdl_core::prelude::*;
use verilated::{Model, PortId};

/// Passes a block may take to settle: far more than its depth.
const SETTLING_PASSES: usize = 100;

/// A port value as a number.
pub trait PortValue {
    fn from_number(number: u128) -> Self;
    fn to_number(self) -> u128;
}

impl PortValue for bool {
    fn from_number(number: u128) -> Self {
        number != 0
    }
    fn to_number(self) -> u128 {
        self.into()
    }
}

/// For blocks with several clocks: they are inputs like others there.
impl PortValue for Clock {
    fn from_number(number: u128) -> Self {
        (number != 0).into()
    }
    fn to_number(self) -> u128 {
        self.clk.into()
    }
}

impl<const N: usize> PortValue for Bits<N> {
    fn from_number(number: u128) -> Self {
        let low = Bits::from(number as u64);
        if N > 64 {
            let high: Bits<N> = Bits::from((number >> 64) as u64);
            low | high << 64
        } else {
            low
        }
    }
    fn to_number(self) -> u128 {
        self.to_u128()
    }
}

impl PortValue for CommandState {
    fn from_number(number: u128) -> Self {
        [Self::Command, Self::First, Self::Count, Self::Points, Self::Settle, Self::Answer][number as usize]
    }
    fn to_number(self) -> u128 {
        self as u128
    }
}

/// Structures travel packed, the first field in the lowest bits.
macro_rules! packed_values {
    ($($structure:ty),*) => {$(
        impl PortValue for $structure {
            fn from_number(number: u128) -> Self {
                Self::unpacked(Bits::<{ <$structure as Synth>::BITS }>::from_number(number))
            }
            fn to_number(self) -> u128 {
                Bits::<{ <$structure as Synth>::BITS }>::from(self).to_u128()
            }
        }
    )*};
}
packed_values!(
    Token,
    Bundle,
    Turned,
    Attempt,
    CommitJob,
    ReleaseJob,
    Verdict,
    Entry,
    Write,
    WriteEnables,
    Asked,
    AnswerBeat,
    Deal,
    Plan,
    Activity,
    AnswerProgress,
    Arrival,
    Clearing,
    EngineState,
    Head,
    Request,
    TakenWord,
    Tally,
    Record,
    AnswerEvents,
    CommandEvents,
    AnswerPlace,
    BytePlace,
    Contents,
    FrameHead,
    Lamps,
    Receipt,
    Session
);

/// A block whose ports are reached by name: `reset`, and `command_valid` for the signal `valid` of the interface `command`.
pub trait NamedPorts: Block {
    fn set(&mut self, port: &str, number: impl Into<u128>);
    fn get(&self, port: &str) -> u128;
    /// What a port carries, if the block has the port.
    fn layout(&self, port: &str) -> Option<TypeDescriptor>;
    fn set_clock(&mut self, high: bool);
}

/// What a signal carries.
pub fn layout_of<D: Direction, T: Synth>(_: &Signal<D, T>) -> Option<TypeDescriptor> {
    Some(T::descriptor())
}

/// Some bits of a port.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    pub port: String,
    pub offset: u32,
    pub width: u32,
}

impl Place {
    fn mask(&self) -> u128 {
        u128::MAX.checked_shr(128 - self.width).unwrap_or(0)
    }

    /// These bits of the port's value.
    pub fn part_of(&self, value: u128) -> u128 {
        value >> self.offset & self.mask()
    }

    /// The port's value with these bits replaced.
    pub fn put_into(&self, value: u128, part: u128) -> u128 {
        value & !(self.mask() << self.offset) | part << self.offset
    }
}

/// Names of ports as the tests write them, and of the fields of those that carry a structure: `record_v0`, or `v0` alone where no other
/// port has that name and no other structure a field of it.
pub struct Places(BTreeMap<String, Option<Place>>);

impl Places {
    /// The ports of a model, with what `layout` says that they carry.
    pub fn new(model: &Model, layout: impl Fn(&str) -> Option<TypeDescriptor>) -> Self {
        let ports: Vec<(String, u32)> =
            model.description().ports().map(|port| (plain(port.name), port.width)).collect();
        let mut places = BTreeMap::new();
        for (port, _) in &ports {
            let mut offset = 0;
            for (field, width) in layout(port).map(|layout| fields(&layout)).unwrap_or_default() {
                let place = Place { port: port.clone(), offset, width };
                offset += width;
                places.insert(format!("{port}_{field}"), Some(place.clone()));
                places.entry(field).and_modify(|place| *place = None).or_insert(Some(place));
            }
        }
        let whole = |(port, width): (String, u32)| (port.clone(), Some(Place { port, offset: 0, width }));
        places.extend(ports.into_iter().map(whole));
        Self(places)
    }

    /// Where a name stands; it may be written with dots.
    pub fn find(&self, name: &str) -> Place {
        match self.0.get(&plain(name)) {
            Some(Some(place)) => place.clone(),
            Some(None) => panic!("{name} is a field of several structures"),
            None => panic!("no port {name}; there are {:?}", self.0.keys()),
        }
    }
}

/// The name of a port as tests write it: members of an interface stand behind its name.
pub fn plain(name: &str) -> String {
    name.replace(['$', '.'], "_")
}

/// Names and widths of the fields of a structure, the lowest first, those of inner structures behind the name of the field.
fn fields(layout: &TypeDescriptor) -> Vec<(String, u32)> {
    let TypeKind::Composite(outer) = &layout.kind else { return Vec::new() };
    let one = |field: &TypeField| match &field.kind.kind {
        TypeKind::Bits(width) | TypeKind::Signed(width) => vec![(field.fieldname.clone(), *width as u32)],
        TypeKind::Enum(states) => vec![(field.fieldname.clone(), states.len().next_power_of_two().trailing_zeros())],
        TypeKind::Composite(_) => fields(&field.kind)
            .into_iter()
            .map(|(name, width)| (format!("{}_{name}", field.fieldname), width))
            .collect(),
    };
    outer.iter().flat_map(|field| one(field)).collect()
}

/// Gives a block [`NamedPorts`]: its type, its inputs, its outputs, and `clock` if it has one. A signal of an interface is written
/// with a dot: `command.valid`. Before the type may stand generic
/// parameters in brackets, or none: `[]`.
#[allow(unused_macros)] // As above.
macro_rules! named_ports {
    ([$($generics:tt)*] $block:ty, [$($input:ident $(. $inner:ident)*),*], [$($output:ident $(. $outer:ident)*),*] $(, $clock:ident)?) => {
        impl<$($generics)*> $crate::rig::block_ports::NamedPorts for $block {
            fn set(&mut self, port: &str, number: impl Into<u128>) {
                use $crate::rig::block_ports::PortValue;
                let number = number.into();
                match port {
                    $(concat!(stringify!($input) $(, "_", stringify!($inner))*) => {
                        self.$input$(.$inner)*.next = PortValue::from_number(number);
                    })*
                    _ => panic!("no input {port}"),
                }
            }
            fn get(&self, port: &str) -> u128 {
                use $crate::rig::block_ports::PortValue;
                match port {
                    $(concat!(stringify!($output) $(, "_", stringify!($outer))*) => self.$output$(.$outer)*.val().to_number(),)*
                    _ => panic!("no output {port}"),
                }
            }
            fn layout(&self, port: &str) -> Option<rust_hdl_core::prelude::TypeDescriptor> {
                use $crate::rig::block_ports::layout_of;
                match port {
                    $(concat!(stringify!($input) $(, "_", stringify!($inner))*) => layout_of(&self.$input$(.$inner)*),)*
                    $(concat!(stringify!($output) $(, "_", stringify!($outer))*) => layout_of(&self.$output$(.$outer)*),)*
                    _ => None,
                }
            }
            fn set_clock(&mut self, high: bool) {
                $(self.$clock.next = high.into();)?
                let _ = high;
            }
        }
    };
    ($block:ty, $($ports:tt)*) => {
        $crate::rig::block_ports::named_ports!([] $block, $($ports)*);
    };
}
pub(crate) use named_ports;

/// Settles the Rust form of a block.
pub fn settle(block: &mut impl Block, name: &str) {
    assert!(simulate(block, SETTLING_PASSES), "{name} does not settle");
}

/// Drives an input of the model of any width.
pub fn set_number(model: &mut Model, port: PortId, number: u128) {
    let words: Vec<u32> = (0..port.width().div_ceil(32)).map(|word| (number >> (32 * word)) as u32).collect();
    model.set_wide(port, &words);
}

/// An output of the model as a number.
pub fn number(model: &Model, port: PortId) -> u128 {
    let mut words = vec![0; port.width().div_ceil(32) as usize];
    model.get_wide(port, &mut words);
    words.iter().rev().fold(0, |number, word| number << 32 | u128::from(*word))
}
