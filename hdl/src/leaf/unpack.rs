//! Reads packed bits as a structure, for memories, which store plain bits.
//!
//! Latency: none. There is no logic: both sides are the same wires.

use rust_hdl_core::prelude::*;

/// A structure that can be read back from its packed bits; [`packed!`](crate::packed) implements the trait.
pub trait Unpacked: Synth {
    /// The structure that has these packed bits.
    fn unpacked<const N: usize>(bits: Bits<N>) -> Self;
}

/// A type that can be a field of a packed structure.
pub trait Field: Synth {
    /// The field whose lowest bit is bit `offset` of `bits`.
    fn field<const N: usize>(bits: Bits<N>, offset: usize) -> Self;
}

impl Field for bool {
    fn field<const N: usize>(bits: Bits<N>, offset: usize) -> Self {
        bits.get_bit(offset)
    }
}

impl<const M: usize> Field for Bits<M> {
    fn field<const N: usize>(bits: Bits<N>, offset: usize) -> Self {
        bits.get_bits::<M>(offset)
    }
}

/// Declares structures that travel on one signal and can be read back from their packed bits.
#[macro_export]
macro_rules! packed {
    ($($(#[$about:meta])* pub struct $name:ident { $($(#[$field_about:meta])* pub $field:ident: $kind:ty,)* })*) => {$(
        $(#[$about])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, LogicStruct)]
        pub struct $name { $($(#[$field_about])* pub $field: $kind,)* }

        impl $crate::leaf::unpack::Field for $name {
            fn field<const N: usize>(bits: Bits<N>, offset: usize) -> Self {
                let mut place = offset;
                $(
                    let $field = <$kind as $crate::leaf::unpack::Field>::field(bits, place);
                    place += <$kind as Synth>::BITS;
                )*
                assert!(place <= N, "a structure reaches beyond the bits that it is in");
                Self { $($field,)* }
            }
        }

        impl $crate::leaf::unpack::Unpacked for $name {
            fn unpacked<const N: usize>(bits: Bits<N>) -> Self {
                assert_eq!(<Self as Synth>::BITS, N, "packed bits and structure differ in width");
                <Self as $crate::leaf::unpack::Field>::field(bits, 0)
            }
        }
    )*};
}

#[derive(LogicBlock, Default)]
pub struct Unpack<T: Unpacked, const N: usize> {
    /// The packed fields, the first one in the lowest bits.
    pub bits: Signal<In, Bits<N>>,
    /// The same bits as a structure.
    pub value: Signal<Out, T>,
}

impl<T: Unpacked, const N: usize> Logic for Unpack<T, N> {
    fn update(&mut self) {
        self.value.next = T::unpacked(self.bits.val());
    }

    fn connect(&mut self) {
        self.value.connect();
    }

    fn hdl(&self) -> Verilog {
        Verilog::Custom("always @(*) value = bits;".into())
    }
}
