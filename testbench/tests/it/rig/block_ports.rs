//! Reaches the ports of a block by name and as numbers, in its Rust form and in its Verilated Verilog.
//! A packed structure is one number.

use std::collections::BTreeMap;

use incircle_hdl::cluster::types::{EngineFlags, OfferedBeat, RoutedWord};
use incircle_hdl::commands::types::{Activity, AnswerProgress, Clearing, Halves, Head, Request, TakenWord, Tally};
use incircle_hdl::commands::{AnswerBeat, CommandState};
use incircle_hdl::engine::{Arrival, EngineState};
use incircle_hdl::engine::{
    Attempt, Beyond, Bundle, Carried, Case, ChangeEvents, CommitJob, CommitRequest, Committed, Completion,
    ContextState, Deal, Entry, EntryWrite, Events, FillEnd, FillJob, FillRequest, Follow, Following, Held, HoleCame,
    HoleOf, InnerWrite, LockClear, LockWrite, Moving, NearVerdict, Outcome, Passed, Plan, PlanWrite, Planned, Pointer,
    Position, Push, RecordRead, ReleaseJob, ReleaseRequest, Released, RingHead, RingWord, SeedProgress, SoloPhase,
    SoloProgress, SoloStart, SoloTurn, StarTriangle, Start, Step, Turned, Upcoming, Verdict, Visit, VisitEvents, Write,
    WriteEnables,
};
use incircle_hdl::ethernet::types::{DatagramState, HeadByte, HeaderRow, Kinds, OnTheWay, Station};
use incircle_hdl::leaf::Unpacked;
use incircle_hdl::living::types::{ContextEnd, DealtItem, Finding, Launch, PartCame, RunHead, Standing};
use incircle_hdl::mesh::{ReadRecord, Record};
use incircle_hdl::predicate::{Corners, EdgeFlags, NearSigns, OrderFlags, PairFlags, Sides, Signs, Weights};
use incircle_hdl::serial::types::{AnswerPlace, BytePlace, Contents, FifoRoom, FrameHead, Lamps, Receipt, Session};
use incircle_hdl::serial::Asked;
use incircle_hdl::stream::{AnswerEvents, CommandEvents};
use incircle_hdl::udp::types::{
    DatagramAsks, DatagramHead, DatagramState as LinkState, DatagramVerdict, PartIndex, UdpSession,
};
use rust_hdl_core::prelude::*;
use verilated::{Model, PortId};

/// Passes that a block may take to settle, far more than its depth.
const SETTLING_PASSES: usize = 100;

/// Value of a whole port: its low 128 bits and its high 128 bits.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Whole {
    pub low: u128,
    pub high: u128,
}

impl From<u128> for Whole {
    fn from(low: u128) -> Self {
        Self { low, high: 0 }
    }
}

impl Whole {
    /// Returns 64 of the bits: the quarter at this place, of four.
    fn quarter(self, place: u32) -> u64 {
        let half = if place < 2 { self.low } else { self.high };
        (half >> (64 * (place % 2))) as u64
    }

    /// Returns the value with this quarter filled in, which was zero before.
    fn with_quarter(mut self, place: u32, quarter: u64) -> Self {
        let half = if place < 2 { &mut self.low } else { &mut self.high };
        *half |= u128::from(quarter) << (64 * (place % 2));
        self
    }
}

/// A value of a port that can be turned into a number and back.
pub trait PortValue {
    fn from_number(number: Whole) -> Self;
    fn to_number(self) -> Whole;
}

impl PortValue for bool {
    fn from_number(number: Whole) -> Self {
        number.low != 0
    }
    fn to_number(self) -> Whole {
        u128::from(self).into()
    }
}

/// In blocks with several clocks, the clocks are inputs like all others.
impl PortValue for Clock {
    fn from_number(number: Whole) -> Self {
        (number.low != 0).into()
    }
    fn to_number(self) -> Whole {
        u128::from(self.clk).into()
    }
}

impl<const N: usize> PortValue for Bits<N> {
    fn from_number(number: Whole) -> Self {
        let mut bits = Bits::from(number.quarter(0));
        for place in 1..N.div_ceil(64) as u32 {
            let part: Self = Bits::from(number.quarter(place));
            bits = bits | part << u64::from(64 * place);
        }
        bits
    }
    fn to_number(self) -> Whole {
        if N <= 128 {
            return self.to_u128().into();
        }
        let quarter = |place: u32| self.get_bits::<64>((64 * place) as usize).to_u128() as u64;
        (0..N.div_ceil(64) as u32).fold(Whole::default(), |whole, place| whole.with_quarter(place, quarter(place)))
    }
}

impl PortValue for CommandState {
    fn from_number(number: Whole) -> Self {
        [Self::Command, Self::First, Self::Count, Self::Points, Self::Settle, Self::Answer][number.low as usize]
    }
    fn to_number(self) -> Whole {
        (self as u128).into()
    }
}

/// Structures are packed, with the first field in the lowest bits.
macro_rules! packed_values {
    ($($structure:ty),*) => {$(
        impl PortValue for $structure {
            fn from_number(number: Whole) -> Self {
                Self::unpacked(Bits::<{ <$structure as Synth>::BITS }>::from_number(number))
            }
            fn to_number(self) -> Whole {
                Bits::<{ <$structure as Synth>::BITS }>::from(self).to_number()
            }
        }
    )*};
}
packed_values!(
    ChangeEvents,
    FillEnd,
    FillJob,
    FillRequest,
    RingWord,
    HoleCame,
    HoleOf,
    Carried,
    Moving,
    EngineFlags,
    OfferedBeat,
    RoutedWord,
    Visit,
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
    Planned,
    Activity,
    AnswerProgress,
    Arrival,
    Clearing,
    EngineState,
    Halves,
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
    FifoRoom,
    FrameHead,
    Lamps,
    Receipt,
    Session,
    Beyond,
    Case,
    CommitRequest,
    Committed,
    Completion,
    ContextState,
    Corners,
    EdgeFlags,
    EntryWrite,
    Events,
    Follow,
    Following,
    Held,
    InnerWrite,
    LockClear,
    LockWrite,
    NearSigns,
    NearVerdict,
    OrderFlags,
    Outcome,
    PairFlags,
    Passed,
    PlanWrite,
    Pointer,
    Position,
    Push,
    ReadRecord,
    RecordRead,
    ReleaseRequest,
    Released,
    RingHead,
    SeedProgress,
    Sides,
    Signs,
    Station,
    OnTheWay,
    DatagramAsks,
    Weights,
    DatagramHead,
    DatagramState,
    DatagramVerdict,
    HeadByte,
    HeaderRow,
    Kinds,
    LinkState,
    PartIndex,
    UdpSession,
    SoloPhase,
    SoloProgress,
    SoloStart,
    SoloTurn,
    ContextEnd,
    DealtItem,
    Finding,
    Launch,
    PartCame,
    RunHead,
    Standing,
    StarTriangle,
    Start,
    Step,
    Upcoming,
    VisitEvents
);

/// A block whose ports are reached by name: `reset`, or `command_valid` for the
/// signal `valid` of the interface `command`.
pub trait NamedPorts: Block {
    fn set(&mut self, port: &str, number: Whole);
    fn get(&self, port: &str) -> Whole;
    /// Layout of a port's value, if the block has the port.
    fn layout(&self, port: &str) -> Option<TypeDescriptor>;
    fn set_clock(&mut self, high: bool);
}

/// Layout of a signal's value.
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
        u128::MAX.checked_shr(128 - self.width.min(128)).unwrap_or(0)
    }

    /// Returns these bits of the port's value; there are at most 128 of them.
    pub fn part_of(&self, value: Whole) -> u128 {
        let part = match self.offset {
            0 => value.low,
            1..128 => value.low >> self.offset | value.high << (128 - self.offset),
            _ => value.high >> (self.offset - 128),
        };
        part & self.mask()
    }

    /// Returns the port's value with these bits replaced.
    pub fn put_into(&self, value: Whole, part: u128) -> Whole {
        if self.width > 128 {
            return Whole::from(part);
        }
        let moved = |bits: u128| match self.offset {
            0 => Whole::from(bits),
            1..128 => Whole { low: bits << self.offset, high: bits >> (128 - self.offset) },
            _ => Whole { low: 0, high: bits << (self.offset - 128) },
        };
        let (hole, part) = (moved(self.mask()), moved(part & self.mask()));
        Whole { low: value.low & !hole.low | part.low, high: value.high & !hole.high | part.high }
    }
}

/// Places of ports and of fields, by the names that tests use. A field of a structure is called `record_v0`, or `v0`
/// alone if no other port has that name and no other structure has such a field.
pub struct Places(BTreeMap<String, Option<Place>>);

impl Places {
    /// Collects the ports of a model; `layout` says which structure each of them carries.
    pub fn new(model: &Model, layout: impl Fn(&str) -> Option<TypeDescriptor>) -> Self {
        let ports: Vec<(String, u32)> =
            model.description().ports().map(|port| (plain(port.name), port.width)).collect();
        let (mut places, mut wholes) = (BTreeMap::new(), Vec::new());
        for (port, _) in &ports {
            for (field, offset, width) in layout(port).map(|layout| fields(&layout, 0)).unwrap_or_default() {
                let place = Place { port: port.clone(), offset, width };
                wholes.push((plain(&format!("{port}_{field}")), Some(place.clone())));
                // A name with a dot is always a field, even if a port has the other form of that name.
                wholes.push((format!("{port}.{field}"), Some(place.clone())));
                // The field by itself, and without the structures around it.
                for (start, _) in
                    std::iter::once((0, "")).chain(field.match_indices('.').map(|(at, dot)| (at + 1, dot)))
                {
                    let name = plain(&field[start..]);
                    places.entry(name).and_modify(|place| *place = None).or_insert(Some(place.clone()));
                }
            }
        }
        let whole = |(port, width): (String, u32)| (port.clone(), Some(Place { port, offset: 0, width }));
        places.extend(wholes);
        places.extend(ports.into_iter().map(whole));
        Self(places)
    }

    /// Finds a port, or a field of its structure. The name may be written with dots. `name[low+:width]`
    /// stands for some of the bits.
    pub fn find(&self, name: &str) -> Place {
        let Some((name, range)) = name.strip_suffix(']').and_then(|part| part.split_once('[')) else {
            return self.whole(name);
        };
        let number = |digits: &str| digits.parse::<u32>().expect("a number");
        let (low, width) = range.split_once("+:").expect("a range as [low+:width]");
        let (place, low, width) = (self.whole(name), number(low), number(width));
        assert!(low + width <= place.width, "{name} has {} bits, not {low} + {width}", place.width);
        Place { offset: place.offset + low, width, ..place }
    }

    fn whole(&self, name: &str) -> Place {
        match self.0.get(name).or_else(|| self.0.get(&plain(name))) {
            Some(Some(place)) => place.clone(),
            Some(None) => panic!("{name} is a field of several structures"),
            None => panic!("no port {name}; there are {:?}", self.0.keys()),
        }
    }
}

/// Name of a port as tests write it: members of an interface stand behind the interface's name.
pub fn plain(name: &str) -> String {
    name.replace(['$', '.'], "_")
}

/// Name, place and width of each field of a structure. Fields of inner structures stand behind the name
/// of their field and a dot.
fn fields(layout: &TypeDescriptor, start: u32) -> Vec<(String, u32, u32)> {
    let TypeKind::Composite(outer) = &layout.kind else { return Vec::new() };
    let mut found = Vec::new();
    let mut offset = start;
    for field in outer {
        let width = width_of(&field.kind);
        found.push((field.fieldname.clone(), offset, width));
        let inner = fields(&field.kind, offset).into_iter();
        found.extend(inner.map(|(name, offset, width)| (format!("{}.{name}", field.fieldname), offset, width)));
        offset += width;
    }
    found
}

/// Number of bits of a value.
fn width_of(layout: &TypeDescriptor) -> u32 {
    match &layout.kind {
        TypeKind::Bits(width) | TypeKind::Signed(width) => *width as u32,
        TypeKind::Enum(states) => states.len().next_power_of_two().trailing_zeros(),
        TypeKind::Composite(fields) => fields.iter().map(|field| width_of(&field.kind)).sum(),
    }
}

/// Implements [`NamedPorts`] for a block: its type, its inputs, its outputs, and `clock` if it has one. A signal
/// of an interface is written with a dot: `command.valid`. Generic parameters stand in brackets before the type,
/// or `[]` if there are none.
macro_rules! named_ports {
    (
        [$($generics:tt)*] $block:ty,
        [$($input:ident $(. $inner:ident)*),*],
        [$($output:ident $(. $outer:ident)*),*]
        $(, $clock:ident)?
    ) => {
        impl<$($generics)*> $crate::rig::block_ports::NamedPorts for $block {
            fn set(&mut self, port: &str, number: $crate::rig::block_ports::Whole) {
                use $crate::rig::block_ports::PortValue;
                match port {
                    $(concat!(stringify!($input) $(, "_", stringify!($inner))*) => {
                        self.$input$(.$inner)*.next = PortValue::from_number(number);
                    })*
                    _ => panic!("no input {port}"),
                }
            }
            fn get(&self, port: &str) -> $crate::rig::block_ports::Whole {
                use $crate::rig::block_ports::PortValue;
                match port {
                    $(concat!(stringify!($output) $(, "_", stringify!($outer))*) => {
                        self.$output$(.$outer)*.val().to_number()
                    })*
                    _ => panic!("no output {port}"),
                }
            }
            fn layout(&self, port: &str) -> Option<rust_hdl_core::prelude::TypeDescriptor> {
                use $crate::rig::block_ports::layout_of;
                match port {
                    $(concat!(stringify!($input) $(, "_", stringify!($inner))*) => {
                        layout_of(&self.$input$(.$inner)*)
                    })*
                    $(concat!(stringify!($output) $(, "_", stringify!($outer))*) => {
                        layout_of(&self.$output$(.$outer)*)
                    })*
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

/// Drives an input of the model, of any width.
pub fn set_number(model: &mut Model, port: PortId, number: Whole) {
    let word = |place: u32| (number.quarter(place / 2) >> (32 * (place % 2))) as u32;
    let words: Vec<u32> = (0..port.width().div_ceil(32)).map(word).collect();
    model.set_wide(port, &words);
}

/// Reads an output of the model as a number.
pub fn number(model: &Model, port: PortId) -> Whole {
    let mut words = vec![0; port.width().div_ceil(32) as usize];
    model.get_wide(port, &mut words);
    let quarter =
        |place: u32, word: u32| Whole::default().with_quarter(place / 2, u64::from(word) << (32 * (place % 2)));
    (0..).zip(words).fold(Whole::default(), |whole, (place, word)| {
        let part = quarter(place, word);
        Whole { low: whole.low | part.low, high: whole.high | part.high }
    })
}
