//! A signed product of 34 x 34 bits from four multipliers.
//!
//! 1. The block takes new factors at every edge. There is no reset.
//! 2. Bits 34 and 35 of a factor repeat its sign, as a sum of two products of differences leaves them.
//!
//! Latency: factors that are valid before edge 1 give their product after edge 5: edges 1 to 3 for the multipliers, 4
//! for the sum of the middle products, 5 for the product.
//!
//! Source: with limbs `a = h * 2^17 + l`, `l` unsigned and `h` signed, `a * b = h h' * 2^34 + (h l' + l h') * 2^17 + l
//! l'`. `h h'` is at most `2^32` and `l l'` below `2^34`, so the two lie side by side in 68 bits without a carry
//! between them. The middle is at most `2 * 2^16 * 2^17 = 2^34`, so 36 bits hold it.

use crate::leaf::Multiplier;
use crate::prelude::*;

#[derive(LogicBlock)]
pub struct WideProduct {
    pub clock: Signal<In, Clock>,
    /// The two factors, in two's complement, each in `-2^33 .. 2^33`.
    pub a: Signal<In, Bits<36>>,
    pub b: Signal<In, Bits<36>>,
    /// The product `a * b`, in two's complement.
    pub product: Signal<Out, Bits<68>>,
    high_by_high: Multiplier,
    high_by_low: Multiplier,
    low_by_high: Multiplier,
    low_by_low: Multiplier,
    a_shifted: Signal<Local, Bits<36>>,
    a_high: Signal<Local, Bits<18>>,
    a_low: Signal<Local, Bits<17>>,
    a_low_wide: Signal<Local, Bits<18>>,
    b_shifted: Signal<Local, Bits<36>>,
    b_high: Signal<Local, Bits<18>>,
    b_low: Signal<Local, Bits<17>>,
    b_low_wide: Signal<Local, Bits<18>>,
    upper: DFF<Bits<34>>,
    middle: DFF<Bits<36>>,
    lower: DFF<Bits<34>>,
    middle_wide: Signal<Local, Bits<51>>,
    upper_wide: Signal<Local, Bits<51>>,
    upper_shifted: Signal<Local, Bits<51>>,
    lower_part: Signal<Local, Bits<17>>,
    lower_wide: Signal<Local, Bits<51>>,
    outer: Signal<Local, Bits<51>>,
    product_high: DFF<Bits<51>>,
    product_low: DFF<Bits<17>>,
    product_high_wide: Signal<Local, Bits<68>>,
    product_high_shifted: Signal<Local, Bits<68>>,
    product_low_wide: Signal<Local, Bits<68>>,
    middle_sign: Constant<Bits<51>>,
}

impl WideProduct {
    /// Number of clock edges from factors to product.
    pub const LATENCY: usize = Multiplier::LATENCY + 2;
}

impl Default for WideProduct {
    fn default() -> Self {
        Self {
            clock: Signal::default(),
            a: Signal::default(),
            b: Signal::default(),
            product: Signal::default(),
            high_by_high: Multiplier::default(),
            high_by_low: Multiplier::default(),
            low_by_high: Multiplier::default(),
            low_by_low: Multiplier::default(),
            a_shifted: Signal::default(),
            a_high: Signal::default(),
            a_low: Signal::default(),
            a_low_wide: Signal::default(),
            b_shifted: Signal::default(),
            b_high: Signal::default(),
            b_low: Signal::default(),
            b_low_wide: Signal::default(),
            upper: DFF::default(),
            middle: DFF::default(),
            lower: DFF::default(),
            middle_wide: Signal::default(),
            upper_wide: Signal::default(),
            upper_shifted: Signal::default(),
            lower_part: Signal::default(),
            lower_wide: Signal::default(),
            outer: Signal::default(),
            product_high: DFF::default(),
            product_low: DFF::default(),
            product_high_wide: Signal::default(),
            product_high_shifted: Signal::default(),
            product_low_wide: Signal::default(),
            // Bits 36 to 50, which must become ones when a negative middle sum is widened.
            middle_sign: Constant::new(Bits::<51>::mask() << 36),
        }
    }
}

impl Logic for WideProduct {
    #[hdl_gen]
    fn update(&mut self) {
        clock!(self, clock, high_by_high, high_by_low, low_by_high, low_by_low);
        clock!(self, clock, upper, middle, lower, product_high, product_low);

        // Edges 1 to 3: a low limb is unsigned, so a zero above its 17 bits makes it a signed factor of 18.
        self.a_shifted.next = self.a.val() >> 17;
        self.a_high.next = bit_cast::<18, 36>(self.a_shifted.val());
        self.a_low.next = self.a.val().get_bits::<17>(0);
        self.a_low_wide.next = bit_cast::<18, 17>(self.a_low.val());
        self.b_shifted.next = self.b.val() >> 17;
        self.b_high.next = bit_cast::<18, 36>(self.b_shifted.val());
        self.b_low.next = self.b.val().get_bits::<17>(0);
        self.b_low_wide.next = bit_cast::<18, 17>(self.b_low.val());
        self.high_by_high.a.next = self.a_high.val();
        self.high_by_high.b.next = self.b_high.val();
        self.high_by_low.a.next = self.a_high.val();
        self.high_by_low.b.next = self.b_low_wide.val();
        self.low_by_high.a.next = self.a_low_wide.val();
        self.low_by_high.b.next = self.b_high.val();
        self.low_by_low.a.next = self.a_low_wide.val();
        self.low_by_low.b.next = self.b_low_wide.val();

        // Edge 4: only the middle products need an addition here; the outer ones lie side by side and wait.
        self.upper.d.next = bit_cast::<34, 36>(self.high_by_high.product.val());
        self.middle.d.next = self.high_by_low.product.val() + self.low_by_high.product.val();
        self.lower.d.next = bit_cast::<34, 36>(self.low_by_low.product.val());

        // Edge 5: the sum begins at bit 17; the lowest 17 bits come from `l l'` alone and pass unchanged.
        self.middle_wide.next = bit_cast::<51, 36>(self.middle.q.val());
        if self.middle.q.val().get_bit(35) {
            self.middle_wide.next = self.middle_wide.val() | self.middle_sign.val();
        }
        self.upper_wide.next = bit_cast::<51, 34>(self.upper.q.val());
        self.upper_shifted.next = self.upper_wide.val() << 17;
        self.lower_part.next = self.lower.q.val().get_bits::<17>(17);
        self.lower_wide.next = bit_cast::<51, 17>(self.lower_part.val());
        self.outer.next = self.upper_shifted.val() | self.lower_wide.val();
        self.product_high.d.next = self.outer.val() + self.middle_wide.val();
        self.product_low.d.next = self.lower.q.val().get_bits::<17>(0);

        self.product_high_wide.next = bit_cast::<68, 51>(self.product_high.q.val());
        self.product_high_shifted.next = self.product_high_wide.val() << 17;
        self.product_low_wide.next = bit_cast::<68, 17>(self.product_low.q.val());
        self.product.next = self.product_high_shifted.val() | self.product_low_wide.val();
    }
}
