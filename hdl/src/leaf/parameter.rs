//! A constant of a block that its constructor sets, such as the size of a memory.
//!
//! A `Parameter` is rust-hdl's `Constant` with a `Default`, so that a block may derive `Default` and its constructor
//! names only what differs: `Self { size: Parameter::new(12.into()), ..Self::default() }`. A parameter that no
//! constructor sets counts as an open signal, and the export refuses the design.

use rust_hdl_core::prelude::*;

#[derive(Clone, Copy, Debug)]
pub struct Parameter<T: Synth> {
    constant: Constant<T>,
    is_set: bool,
}

impl<T: Synth> Parameter<T> {
    /// A parameter of this value.
    pub fn new(value: T) -> Self {
        Self { constant: Constant::new(value), is_set: true }
    }

    /// Value of the parameter, also in kernels.
    pub fn val(&self) -> T {
        self.constant.val()
    }
}

impl<T: Synth> Default for Parameter<T> {
    fn default() -> Self {
        Self { constant: Constant::new(T::default()), is_set: false }
    }
}

impl<T: Synth> Logic for Parameter<T> {
    fn update(&mut self) {}
}

impl<T: Synth> Atom for Parameter<T> {
    fn bits(&self) -> usize {
        T::BITS
    }

    fn connected(&self) -> bool {
        self.is_set
    }

    fn changed(&self) -> bool {
        false
    }

    fn kind(&self) -> AtomKind {
        AtomKind::Constant
    }

    fn descriptor(&self) -> TypeDescriptor {
        T::descriptor()
    }

    fn vcd(&self) -> VCDValue {
        self.val().vcd()
    }

    fn verilog(&self) -> VerilogLiteral {
        self.val().verilog()
    }

    fn id(&self) -> usize {
        self.constant.id()
    }

    fn constraints(&self) -> Vec<PinConstraint> {
        Vec::new()
    }
}

impl<T: Synth> Block for Parameter<T> {
    fn connect_all(&mut self) {}

    fn update_all(&mut self) {}

    fn has_changed(&self) -> bool {
        false
    }

    fn accept(&self, name: &str, probe: &mut dyn Probe) {
        probe.visit_atom(name, self);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::{verilog, ExportError};

    #[derive(LogicBlock, Default)]
    struct Shown {
        pub value: Signal<Out, Bits<4>>,
        amount: Parameter<Bits<4>>,
    }

    impl Logic for Shown {
        #[hdl_gen]
        fn update(&mut self) {
            self.value.next = self.amount.val();
        }
    }

    #[test]
    fn a_parameter_that_no_constructor_sets_is_refused() {
        let export = |mut block: Shown| {
            block.connect_all();
            verilog(&block, "shown")
        };
        assert_eq!(export(Shown::default()), Err(ExportError::OpenSignals(vec!["uut$amount".into()])));
        let set = Shown { amount: Parameter::new(3.into()), ..Shown::default() };
        assert!(export(set).is_ok_and(|text| text.contains("localparam  amount = 4'h3;")));
    }
}
