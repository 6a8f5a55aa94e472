//! Double-double arithmetic.

/// An unevaluated sum of two f64 that do not overlap: about 32 decimal digits. Dekker 1971, "A
/// floating-point technique for extending the available precision"; Knuth's two-sum. Without fused
/// operations, so results are the same on all machines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct DoubleDouble {
    pub(crate) high: f64,
    pub(crate) low: f64,
}

impl DoubleDouble {
    pub(crate) const ZERO: Self = Self { high: 0.0, low: 0.0 };

    #[inline]
    pub(crate) fn of(value: f64) -> Self {
        Self { high: value, low: 0.0 }
    }

    /// The exact sum of two f64.
    #[inline]
    pub(crate) fn sum(a: f64, b: f64) -> Self {
        let high = a + b;
        let part = high - a;
        Self { high, low: (a - (high - part)) + (b - part) }
    }

    /// The exact product of two f64 (without overflow below 1e300).
    #[inline]
    pub(crate) fn product(a: f64, b: f64) -> Self {
        let high = a * b;
        let ((a1, a2), (b1, b2)) = (halves(a), halves(b));
        Self { high, low: ((a1 * b1 - high) + a1 * b2 + a2 * b1) + a2 * b2 }
    }

    #[inline]
    pub(crate) fn add(self, other: Self) -> Self {
        let sum = Self::sum(self.high, other.high);
        Self::sum(sum.high, sum.low + self.low + other.low)
    }

    #[inline]
    pub(crate) fn sub(self, other: Self) -> Self {
        self.add(Self { high: -other.high, low: -other.low })
    }

    #[inline]
    pub(crate) fn mul(self, other: Self) -> Self {
        let product = Self::product(self.high, other.high);
        Self::sum(product.high, product.low + (self.high * other.low + self.low * other.high))
    }

    /// The quotient, by two steps of long division.
    #[inline]
    pub(crate) fn div(self, other: Self) -> Self {
        let first = self.high / other.high;
        let rest = self.sub(other.mul(Self::of(first)));
        let second = rest.high / other.high;
        Self::sum(first, second)
    }

    /// The square root of a number that is not negative.
    #[inline]
    pub(crate) fn sqrt(self) -> Self {
        if self.high <= 0.0 {
            return Self::ZERO;
        }
        let root = self.high.sqrt();
        let rest = self.sub(Self::product(root, root));
        Self::sum(root, rest.high / (2.0 * root))
    }
}

/// Veltkamp's split into 26 and 27 bits.
#[inline]
fn halves(value: f64) -> (f64, f64) {
    let scaled = 134_217_729.0 * value;
    let high = scaled - (scaled - value);
    (high, value - high)
}

#[cfg(test)]
mod tests {
    use super::DoubleDouble;

    #[test]
    fn what_an_f64_loses_is_kept() {
        let tiny = DoubleDouble::sum(1.0, 1e-20).sub(DoubleDouble::of(1.0));
        assert_eq!((tiny.high, tiny.low), (1e-20, 0.0));
        let e = libm::pow(2f64, -30.0);
        // (1 + e)(1 - e) - 1 = -e²
        let rest = DoubleDouble::product(1.0 + e, 1.0 - e).sub(DoubleDouble::of(1.0));
        assert_eq!(rest.high, -e * e);
    }

    #[test]
    fn roots_and_quotients_come_back() {
        let two = DoubleDouble::of(2.0);
        let off = two.sqrt().mul(two.sqrt()).sub(two);
        assert!(off.high.abs() < 1e-30, "{off:?}");
        let third = DoubleDouble::of(1.0).div(DoubleDouble::of(3.0));
        let off = third.mul(DoubleDouble::of(3.0)).sub(DoubleDouble::of(1.0));
        assert!(off.high.abs() < 1e-31, "{off:?}");
    }
}
