//! Four double-precision numbers at a time, the counterpart of [`super::V8`].

/// Four f64 in registers. A comparison gives a mask: all bits of a lane set, or none. All operations
/// round as IEEE 754 requires.
pub(crate) trait V4: Copy {
    fn splat(value: f64) -> Self;
    /// The first four, or the last.
    fn load(row: &[f64; 8], half: usize) -> Self;
    fn store(self, row: &mut [f64; 8], half: usize);
    fn add(self, other: Self) -> Self;
    fn sub(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    fn div(self, other: Self) -> Self;
    fn lt(self, other: Self) -> Self;
    fn le(self, other: Self) -> Self;
    fn and(self, other: Self) -> Self;
    /// `self` where the mask is set, `other` elsewhere.
    fn select(self, other: Self, mask: Self) -> Self;
    /// Bit `i` is set if lane `i` of a mask is.
    fn bits(self) -> u32;
}

/// Plain Rust.
#[derive(Clone, Copy)]
pub(crate) struct Portable4([f64; 4]);

impl Portable4 {
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self(std::array::from_fn(|i| f(self.0[i], other.0[i])))
    }
}

#[inline(always)]
fn mask(set: bool) -> f64 {
    f64::from_bits(if set { u64::MAX } else { 0 })
}

impl V4 for Portable4 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        Self([value; 4])
    }
    #[inline(always)]
    fn load(row: &[f64; 8], half: usize) -> Self {
        Self(std::array::from_fn(|i| row[4 * (half & 1) + i]))
    }
    #[inline(always)]
    fn store(self, row: &mut [f64; 8], half: usize) {
        for (i, value) in self.0.into_iter().enumerate() {
            row[4 * (half & 1) + i] = value;
        }
    }
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, |a, b| a + b)
    }
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, |a, b| a - b)
    }
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, |a, b| a * b)
    }
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, |a, b| a / b)
    }
    #[inline(always)]
    fn lt(self, other: Self) -> Self {
        self.zip(other, |a, b| mask(a < b))
    }
    #[inline(always)]
    fn le(self, other: Self) -> Self {
        self.zip(other, |a, b| mask(a <= b))
    }
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        self.zip(other, |a, b| f64::from_bits(a.to_bits() & b.to_bits()))
    }
    #[inline(always)]
    fn select(self, other: Self, mask: Self) -> Self {
        Self(std::array::from_fn(|i| if mask.0[i].to_bits() == 0 { other.0[i] } else { self.0[i] }))
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        (0..4).map(|i| u32::from(self.0[i].is_sign_negative()) << i).sum()
    }
}

#[cfg(target_arch = "x86_64")]
pub(super) mod avx2 {
    use std::arch::x86_64::*;

    use super::V4;

    /// Four f64 in an AVX register. Values are created only inside [`crate::simd::V8::run`] of
    /// [`crate::simd::Avx2`], which is reached only on machines with the instructions: that makes
    /// every `unsafe` below sound.
    #[derive(Clone, Copy)]
    pub(crate) struct Four(__m256d);

    /// A method body of intrinsics on registers.
    macro_rules! ops {
        ($($name:ident = $body:expr;)*) => {$(
            #[inline(always)]
            fn $name(self, other: Self) -> Self {
                // SAFETY: on registers only; the machine has AVX2 (see `Four`).
                Self(unsafe { $body(self.0, other.0) })
            }
        )*};
    }

    impl V4 for Four {
        #[inline(always)]
        fn splat(value: f64) -> Self {
            // SAFETY: on registers only; the machine has AVX (see `Four`).
            Self(unsafe { _mm256_set1_pd(value) })
        }
        #[inline(always)]
        fn load(row: &[f64; 8], half: usize) -> Self {
            // SAFETY: four of the eight, from the first or the fifth; they need not be aligned.
            Self(unsafe { _mm256_loadu_pd(row.as_ptr().add(4 * (half & 1))) })
        }
        #[inline(always)]
        fn store(self, row: &mut [f64; 8], half: usize) {
            // SAFETY: four of the eight, from the first or the fifth; they need not be aligned.
            unsafe { _mm256_storeu_pd(row.as_mut_ptr().add(4 * (half & 1)), self.0) };
        }
        ops! {
            add = _mm256_add_pd;
            sub = _mm256_sub_pd;
            mul = _mm256_mul_pd;
            div = _mm256_div_pd;
            lt = _mm256_cmp_pd::<_CMP_LT_OQ>;
            le = _mm256_cmp_pd::<_CMP_LE_OQ>;
            and = _mm256_and_pd;
        }
        #[inline(always)]
        fn select(self, other: Self, mask: Self) -> Self {
            // SAFETY: on registers only; the machine has AVX (see `Four`).
            Self(unsafe { _mm256_blendv_pd(other.0, self.0, mask.0) })
        }
        #[inline(always)]
        fn bits(self) -> u32 {
            // SAFETY: on registers only; the machine has AVX (see `Four`).
            unsafe { _mm256_movemask_pd(self.0) }.cast_unsigned()
        }
    }
}
