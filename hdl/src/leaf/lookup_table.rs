//! A table of constants: one row for each index.
//!
//! Latency: none (combinational) from index to row.
//!
//! Source: a `case` over the rows that differ from the last one, which synthesis turns into look-up tables. A kernel
//! with a `match` says the same in five times the lines, and cannot take its rows from a constructor.

use rust_hdl_core::prelude::*;

#[derive(LogicBlock)]
pub struct LookupTable<const A: usize, T: Synth> {
    /// Number of the row.
    pub index: Signal<In, Bits<A>>,
    /// The row.
    pub value: Signal<Out, T>,
    _rows: Vec<T>,
}

impl<const A: usize, T: Synth> LookupTable<A, T> {
    /// A table whose row `i` is `row(i)`.
    ///
    /// # Panics
    /// If A is above 16.
    pub fn new(row: impl FnMut(usize) -> T) -> Self {
        assert!(A <= 16, "a table of constants has an index of up to 16 bits, not {A}");
        Self { index: Signal::default(), value: Signal::default(), _rows: (0..1 << A).map(row).collect() }
    }
}

impl<const A: usize, T: Synth> Default for LookupTable<A, T> {
    fn default() -> Self {
        Self::new(|_| T::default())
    }
}

impl<const A: usize, T: Synth> Logic for LookupTable<A, T> {
    fn update(&mut self) {
        self.value.next = self._rows.get(self.index.val().index()).copied().unwrap_or_default();
    }

    fn connect(&mut self) {
        self.value.connect();
    }

    fn hdl(&self) -> Verilog {
        let last = self._rows.last().copied().unwrap_or_default();
        let rows = self._rows.iter().enumerate().filter(|(_, row)| **row != last);
        let rows: String = rows.map(|(index, row)| format!("{A}'d{index}: value = {};\n", row.verilog())).collect();
        Verilog::Custom(format!(
            "always @(*) begin\ncase (index)\n{rows}default: value = {};\nendcase\nend\n",
            last.verilog()
        ))
    }
}
