//! Eight single-precision numbers at a time.
//!
//! [`V8`] is the small set of operations in which traversal, triangle test and builder are written,
//! once for every kind of processor: [`Portable`] is plain Rust, [`Avx2`] the same with x86-64
//! vector registers. Every operation but [`V8::mul_add_about`] rounds as IEEE 754 requires, so both
//! give the same bits. The only unsafe code of this crate is here.

#![allow(unsafe_code, reason = "vector instructions; each use states why it is sound")]

mod simd4;

use periplus_geometry::DVec3;

use crate::bvh::MAX_PENDING_CHILD_COUNT;
use crate::traversal::PendingChildren;

pub(crate) use simd4::V4;

/// Eight f32 in memory, aligned for a vector load.
#[repr(C, align(32))]
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Row(pub(crate) [f32; 8]);

/// Eight f32 in registers. A comparison gives a mask: all bits of a lane set, or none.
pub(crate) trait V8: Copy {
    /// Four double-precision numbers with the same instructions.
    type Four: V4;

    /// All lanes the same.
    fn splat(value: f32) -> Self;
    fn load(row: &Row) -> Self;
    fn store(self) -> Row;
    fn add(self, other: Self) -> Self;
    fn sub(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    fn div(self, other: Self) -> Self;
    /// Lane-wise minimum; `other` where a lane is NaN.
    fn min(self, other: Self) -> Self;
    /// Lane-wise maximum; `other` where a lane is NaN.
    fn max(self, other: Self) -> Self;
    /// `self * a + b`, rounded once or twice: use only where a margin covers the difference.
    fn mul_add_about(self, a: Self, b: Self) -> Self;
    fn le(self, other: Self) -> Self;
    fn and(self, other: Self) -> Self;
    fn or(self, other: Self) -> Self;
    /// `self` where the mask is set, `other` elsewhere.
    fn select(self, other: Self, mask: Self) -> Self;
    /// Lanes 4 to 7, then 0 to 3.
    fn swap_halves(self) -> Self;
    /// Minimum of all lanes, if no lane is NaN.
    fn min_lane(self) -> f32;
    /// Bit `i` is set if lane `i` of a mask is.
    fn bits(self) -> u32;
    /// Rounds towards zero. Every lane must be within ±2³¹.
    fn truncate(self) -> [i32; 8];

    /// Subtracts an origin from eight points and rounds: a vector for each coordinate.
    fn transpose(points: [&DVec3; 8], origin: DVec3) -> [Self; 3];

    /// Pushes the children whose lane in the mask `hits` is set. `order` holds three bits for each
    /// position, the child that comes first in the lowest.
    fn push(hits: Self, enter: Self, words: &Row, order: u32, pending: &mut PendingChildren);
    /// Removes the children that are entered beyond `limit`; the others keep their order.
    fn cull(pending: &mut PendingChildren, limit: f32);

    /// Prefetches the five cache lines from an address on, which need not be valid.
    fn prefetch(address: *const u8);

    /// Runs a task with this type's instructions enabled throughout, as a separate function. Everything
    /// inside a task is inlined, so a part with several callers is a separate task, or it is compiled once
    /// for each of them.
    fn run<T: Task>(task: T) -> T::Output;

    /// [`Self::run`] for a task that needs more registers than the machine may have. The task is compiled
    /// twice.
    #[inline(always)]
    fn run_with_most_registers<T: Task>(task: T) -> T::Output {
        Self::run(task)
    }
}

/// Broadcasts three values to all lanes.
#[inline(always)]
pub(crate) fn splat3<V: V8>(values: [f32; 3]) -> [V; 3] {
    [V::splat(values[0]), V::splat(values[1]), V::splat(values[2])]
}

/// A task compiled once for every kind of processor.
pub(crate) trait Task {
    type Output;
    fn run<V: V8>(self) -> Self::Output;
}

/// Runs a task with the best instructions of this machine. Implementations of [`Task::run`] must be
/// `#[inline(always)]` down to the vector operations, or they lose their target features; this rules
/// out closures with vector operations, which cannot be annotated.
#[inline]
pub(crate) fn dispatch<T: Task>(task: T) -> T::Output {
    #[cfg(target_arch = "x86_64")]
    if !force_portable() && has_avx2() {
        return Avx2::run(task);
    }
    Portable::run(task)
}

#[cfg(target_arch = "x86_64")]
#[inline]
fn has_avx2() -> bool {
    is_x86_feature_detected!("avx2")
        && is_x86_feature_detected!("fma")
        && is_x86_feature_detected!("bmi1")
        && is_x86_feature_detected!("lzcnt")
        && is_x86_feature_detected!("popcnt")
}

#[cfg(all(not(test), target_arch = "x86_64"))]
#[inline(always)]
fn force_portable() -> bool {
    false
}

#[cfg(all(not(test), target_arch = "x86_64"))]
#[inline(always)]
fn force_avx2() -> bool {
    false
}

#[cfg(test)]
thread_local! {
    static PORTABLE: std::cell::Cell<bool> = const { std::cell::Cell::new(false) };
    static AVX2: std::cell::Cell<bool> = const { std::cell::Cell::new(false) };
}

#[cfg(all(test, target_arch = "x86_64"))]
fn force_avx2() -> bool {
    AVX2.get()
}

/// Runs `work` without the instructions of AVX-512.
#[cfg(test)]
pub(crate) fn without_avx512<R>(work: impl FnOnce() -> R) -> R {
    AVX2.set(true);
    let result = work();
    AVX2.set(false);
    result
}

#[cfg(test)]
fn force_portable() -> bool {
    PORTABLE.get()
}

/// Runs `work` without vector instructions.
#[cfg(test)]
pub(crate) fn without_vectors<R>(work: impl FnOnce() -> R) -> R {
    PORTABLE.set(true);
    let result = work();
    PORTABLE.set(false);
    result
}

/// Plain Rust; compilers vectorise it for their target processor.
#[derive(Clone, Copy)]
pub(crate) struct Portable([f32; 8]);

impl Portable {
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f32, f32) -> f32) -> Self {
        Self(std::array::from_fn(|i| f(self.0[i], other.0[i])))
    }
}

#[inline(always)]
fn mask(set: bool) -> f32 {
    f32::from_bits(if set { u32::MAX } else { 0 })
}

impl V8 for Portable {
    type Four = simd4::Portable4;

    #[inline(always)]
    fn splat(value: f32) -> Self {
        Self([value; 8])
    }
    #[inline(always)]
    fn load(row: &Row) -> Self {
        Self(row.0)
    }
    #[inline(always)]
    fn store(self) -> Row {
        Row(self.0)
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
    fn min(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }
    #[inline(always)]
    fn mul_add_about(self, a: Self, b: Self) -> Self {
        self.mul(a).add(b)
    }
    #[inline(always)]
    fn le(self, other: Self) -> Self {
        self.zip(other, |a, b| mask(a <= b))
    }
    #[inline(always)]
    fn and(self, other: Self) -> Self {
        self.zip(other, |a, b| f32::from_bits(a.to_bits() & b.to_bits()))
    }
    #[inline(always)]
    fn or(self, other: Self) -> Self {
        self.zip(other, |a, b| f32::from_bits(a.to_bits() | b.to_bits()))
    }
    #[inline(always)]
    fn select(self, other: Self, mask: Self) -> Self {
        Self(std::array::from_fn(|i| if mask.0[i].to_bits() == 0 { other.0[i] } else { self.0[i] }))
    }
    #[inline(always)]
    fn swap_halves(self) -> Self {
        Self(std::array::from_fn(|i| self.0[i ^ 4]))
    }
    #[inline(always)]
    fn min_lane(self) -> f32 {
        let mut min_lane = self.0[0];
        for &value in &self.0[1..] {
            min_lane = if value < min_lane { value } else { min_lane };
        }
        min_lane
    }
    #[inline(always)]
    fn bits(self) -> u32 {
        (0..8).map(|i| (self.0[i].to_bits() >> 31) << i).sum()
    }
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "that is what it does")]
    fn truncate(self) -> [i32; 8] {
        self.0.map(|value| value as i32)
    }
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "single precision is the point")]
    fn transpose(points: [&DVec3; 8], origin: DVec3) -> [Self; 3] {
        let mut rows = [Self([0.0; 8]); 3];
        for (lane, &point) in points.into_iter().enumerate() {
            let point = point - origin;
            rows[0].0[lane] = point.x as f32;
            rows[1].0[lane] = point.y as f32;
            rows[2].0[lane] = point.z as f32;
        }
        rows
    }
    #[inline(always)]
    fn push(hits: Self, enter: Self, words: &Row, order: u32, pending: &mut PendingChildren) {
        let bits = hits.bits();
        for position in 0..8 {
            let child = (order >> (3 * position)) as usize & 7;
            if bits >> child & 1 != 0 {
                let height = pending.height.min(MAX_PENDING_CHILD_COUNT);
                pending.distances[height] = enter.0[child];
                pending.words[height] = words.0[child].to_bits();
                pending.height = height + 1;
            }
        }
    }
    #[inline(always)]
    fn cull(pending: &mut PendingChildren, limit: f32) {
        let mut kept = 0;
        for index in 0..pending.height.min(MAX_PENDING_CHILD_COUNT) {
            pending.distances[kept] = pending.distances[index];
            pending.words[kept] = pending.words[index];
            kept += usize::from(pending.distances[index] <= limit);
        }
        pending.height = kept;
    }
    #[inline(always)]
    fn prefetch(_: *const u8) {}
    // Not inlined into `dispatch`, whose stack frame would otherwise include this one.
    #[inline(never)]
    fn run<T: Task>(task: T) -> T::Output {
        task.run::<Self>()
    }
}

#[cfg(target_arch = "x86_64")]
pub(crate) use avx2::Avx2;

#[cfg(target_arch = "x86_64")]
mod avx2 {
    use std::arch::x86_64::*;

    use periplus_geometry::DVec3;

    use super::{MAX_PENDING_CHILD_COUNT, PendingChildren, Row, Task, V8};

    /// For each mask of eight bits the positions of the set bits, in order.
    static SET_BITS: [[u8; 8]; 256] = {
        let mut table = [[0; 8]; 256];
        let mut mask = 0;
        while mask < 256 {
            let (mut bit, mut count) = (0_u8, 0);
            while bit < 8 {
                if mask >> bit & 1 != 0 {
                    table[mask][count] = bit;
                    count += 1;
                }
                bit += 1;
            }
            mask += 1;
        }
        table
    };

    /// Returns the lanes of the set bits of a mask, in order.
    #[inline(always)]
    fn set_lanes(mask: i32) -> __m256i {
        let row = &SET_BITS[mask as usize & 255];
        // SAFETY: the row is eight readable bytes; the machine has AVX2 (see `Avx2`).
        unsafe { _mm256_cvtepu8_epi32(_mm_loadl_epi64(row.as_ptr().cast())) }
    }

    /// Eight f32 in an AVX register. Values of this type come to be only inside [`V8::run`], which
    /// [`super::dispatch`] reaches only on machines that have the instructions: that makes every
    /// `unsafe` below sound, as these intrinsics ask for nothing else.
    #[derive(Clone, Copy)]
    pub(crate) struct Avx2(__m256);

    /// A method body of intrinsics on registers.
    macro_rules! ops {
        ($($name:ident($($arg:ident),*) = $body:expr;)*) => {$(
            #[inline(always)]
            fn $name(self $(, $arg: Self)*) -> Self {
                $(let $arg = $arg.0;)*
                // SAFETY: on registers only; the machine has AVX2 and FMA (see `Avx2`).
                Self(unsafe { $body(self.0 $(, $arg)*) })
            }
        )*};
    }

    impl V8 for Avx2 {
        type Four = super::simd4::avx2::Four;

        #[inline(always)]
        fn splat(value: f32) -> Self {
            // SAFETY: on registers only; the machine has AVX (see `Avx2`).
            Self(unsafe { _mm256_set1_ps(value) })
        }
        #[inline(always)]
        fn load(row: &Row) -> Self {
            // SAFETY: a `Row` is 32 readable bytes, aligned to 32.
            Self(unsafe { _mm256_load_ps(row.0.as_ptr()) })
        }
        #[inline(always)]
        fn store(self) -> Row {
            let mut row = Row([0.0; 8]);
            // SAFETY: a `Row` is 32 writable bytes, aligned to 32.
            unsafe { _mm256_store_ps(row.0.as_mut_ptr(), self.0) };
            row
        }
        ops! {
            add(other) = _mm256_add_ps;
            sub(other) = _mm256_sub_ps;
            mul(other) = _mm256_mul_ps;
            div(other) = _mm256_div_ps;
            min(other) = _mm256_min_ps;
            max(other) = _mm256_max_ps;
            mul_add_about(a, b) = _mm256_fmadd_ps;
            le(other) = _mm256_cmp_ps::<_CMP_LE_OQ>;
            and(other) = _mm256_and_ps;
            or(other) = _mm256_or_ps;
        }
        #[inline(always)]
        fn select(self, other: Self, mask: Self) -> Self {
            // SAFETY: on registers only; the machine has AVX (see `Avx2`).
            Self(unsafe { _mm256_blendv_ps(other.0, self.0, mask.0) })
        }
        #[inline(always)]
        fn swap_halves(self) -> Self {
            // SAFETY: on registers only; the machine has AVX (see `Avx2`).
            Self(unsafe { _mm256_permute2f128_ps::<1>(self.0, self.0) })
        }
        #[inline(always)]
        fn min_lane(self) -> f32 {
            // SAFETY: on registers only; the machine has AVX (see `Avx2`).
            unsafe {
                let halves =
                    _mm_min_ps(_mm256_castps256_ps128(self.0), _mm256_extractf128_ps::<1>(self.0));
                let pairs = _mm_min_ps(halves, _mm_movehl_ps(halves, halves));
                _mm_cvtss_f32(_mm_min_ss(pairs, _mm_movehdup_ps(pairs)))
            }
        }
        #[inline(always)]
        fn bits(self) -> u32 {
            // SAFETY: on registers only; the machine has AVX (see `Avx2`).
            unsafe { _mm256_movemask_ps(self.0) }.cast_unsigned()
        }
        #[inline(always)]
        fn truncate(self) -> [i32; 8] {
            let mut result = [0_i32; 8];
            // SAFETY: the target is 32 writable bytes; the unaligned store asks for no more.
            unsafe {
                _mm256_storeu_si256(result.as_mut_ptr().cast(), _mm256_cvttps_epi32(self.0));
            }
            result
        }
        #[inline(always)]
        fn transpose(points: [&DVec3; 8], origin: DVec3) -> [Self; 3] {
            // SAFETY: on registers only; the machine has AVX2 (see `Avx2`).
            unsafe {
                let origin = _mm256_setr_pd(origin.x, origin.y, origin.z, 0.0);
                /// A macro, as closures are compiled without the instructions.
                macro_rules! single {
                    ($point:ident) => {{
                        let point = _mm256_setr_pd($point.x, $point.y, $point.z, 0.0);
                        _mm256_cvtpd_ps(_mm256_sub_pd(point, origin))
                    }};
                }
                let [a, b, c, d, e, f, g, h] = points;
                let (a, b, c, d) = (single!(a), single!(b), single!(c), single!(d));
                let (e, f, g, h) = (single!(e), single!(f), single!(g), single!(h));
                let (ab, cd) = (_mm_unpacklo_ps(a, b), _mm_unpacklo_ps(c, d));
                let (ef, gh) = (_mm_unpacklo_ps(e, f), _mm_unpacklo_ps(g, h));
                let x = _mm256_set_m128(_mm_movelh_ps(ef, gh), _mm_movelh_ps(ab, cd));
                let y = _mm256_set_m128(_mm_movehl_ps(gh, ef), _mm_movehl_ps(cd, ab));
                let (ab, cd) = (_mm_unpackhi_ps(a, b), _mm_unpackhi_ps(c, d));
                let (ef, gh) = (_mm_unpackhi_ps(e, f), _mm_unpackhi_ps(g, h));
                let z = _mm256_set_m128(_mm_movelh_ps(ef, gh), _mm_movelh_ps(ab, cd));
                [Self(x), Self(y), Self(z)]
            }
        }
        #[inline(always)]
        fn push(hits: Self, enter: Self, words: &Row, order: u32, pending: &mut PendingChildren) {
            let height = pending.height.min(MAX_PENDING_CHILD_COUNT);
            // SAFETY: a `Row` is 32 readable bytes, aligned to 32. The targets are eight entries each
            // from `height` on, and the arrays have eight more than `MAX_PENDING_CHILD_COUNT`; the unaligned
            // stores ask for no more. The machine has AVX2 (see `Avx2`).
            unsafe {
                let order = _mm256_set1_epi32(order.cast_signed());
                // Only the lowest three bits of an index count.
                let order = _mm256_srlv_epi32(order, _mm256_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21));
                let mask = _mm256_movemask_ps(_mm256_permutevar8x32_ps(hits.0, order));
                let lanes = _mm256_permutevar8x32_epi32(order, set_lanes(mask));
                let words = _mm256_load_ps(words.0.as_ptr());
                let words = _mm256_permutevar8x32_ps(words, lanes);
                let enter = _mm256_permutevar8x32_ps(enter.0, lanes);
                _mm256_storeu_ps(pending.distances.as_mut_ptr().add(height), enter);
                _mm256_storeu_ps(pending.words.as_mut_ptr().add(height).cast(), words);
                pending.height = height + mask.count_ones() as usize;
            }
        }
        #[inline(always)]
        fn cull(pending: &mut PendingChildren, limit: f32) {
            let height = pending.height.min(MAX_PENDING_CHILD_COUNT);
            let (mut read, mut kept) = (0, 0);
            while read < height {
                // SAFETY: `kept <= read < height <= MAX_PENDING_CHILD_COUNT`, and the arrays have eight more
                // entries; loads and stores are unaligned. The machine has AVX2 (see `Avx2`).
                unsafe {
                    let distances = pending.distances.as_mut_ptr();
                    let words = pending.words.as_mut_ptr();
                    let own = _mm256_loadu_ps(distances.add(read));
                    let own_words = _mm256_loadu_si256(words.add(read).cast());
                    let near = _mm256_cmp_ps::<_CMP_LE_OQ>(own, _mm256_set1_ps(limit));
                    let used = (1 << (height - read).min(8)) - 1;
                    let mask = _mm256_movemask_ps(near) & used;
                    let lanes = set_lanes(mask);
                    let own = _mm256_permutevar8x32_ps(own, lanes);
                    let own_words = _mm256_permutevar8x32_epi32(own_words, lanes);
                    _mm256_storeu_ps(distances.add(kept), own);
                    _mm256_storeu_si256(words.add(kept).cast(), own_words);
                    kept += mask.count_ones() as usize;
                }
                read += 8;
            }
            pending.height = kept;
        }
        #[inline(always)]
        fn prefetch(address: *const u8) {
            const CACHE_LINE_BYTES: usize = 64;
            for line in 0..5 {
                let line = address.cast::<i8>().wrapping_add(line * CACHE_LINE_BYTES);
                // SAFETY: a hint, which reads nothing, at any address.
                unsafe { _mm_prefetch::<_MM_HINT_T0>(line) };
            }
        }
        #[inline(always)]
        fn run<T: Task>(task: T) -> T::Output {
            // SAFETY: `dispatch` saw that the machine has these instructions.
            unsafe { run(task) }
        }
        #[inline(always)]
        fn run_with_most_registers<T: Task>(task: T) -> T::Output {
            if has_avx512() {
                // SAFETY: the machine has these instructions.
                unsafe { run_avx512(task) }
            } else {
                // SAFETY: `dispatch` saw that the machine has these instructions.
                unsafe { run(task) }
            }
        }
    }

    #[inline(always)]
    fn has_avx512() -> bool {
        !super::force_avx2()
            && is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512vl")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512bw")
            && is_x86_feature_detected!("bmi2")
    }

    /// [`run`] with more registers and with numbers broadcast from memory within an operation. The
    /// vectors are the same, and so are the results.
    #[inline(never)]
    #[target_feature(enable = "avx2,fma,bmi1,bmi2,lzcnt,popcnt,avx512f,avx512vl,avx512dq,avx512bw")]
    fn run_avx512<T: Task>(task: T) -> T::Output {
        task.run::<Avx2>()
    }

    #[inline(never)]
    #[target_feature(enable = "avx2,fma,bmi1,lzcnt,popcnt")]
    fn run<T: Task>(task: T) -> T::Output {
        task.run::<Avx2>()
    }
}

#[cfg(all(test, target_arch = "x86_64"))]
mod tests {
    use proptest::prelude::*;

    use super::*;

    struct Every(Row, Row, Row);

    impl Task for Every {
        type Output = Vec<[u32; 8]>;
        #[inline(always)]
        fn run<V: V8>(self) -> Self::Output {
            let (a, b, c) = (V::load(&self.0), V::load(&self.1), V::load(&self.2));
            let mask = a.le(c);
            let values = [
                a.add(b),
                a.sub(b),
                a.mul(b),
                a.div(b),
                a.min(b),
                a.max(b),
                a.le(b),
                mask,
                a.and(b),
                a.or(b),
                a.swap_halves(),
                a.select(b, mask),
                V::splat(self.0.0[3]),
            ];
            let mut all: Vec<_> = values.iter().map(|v| v.store().0.map(canonical)).collect();
            all.push([mask.bits(); 8]);
            all
        }
    }

    /// NaN payloads may differ.
    fn canonical(value: f32) -> u32 {
        if value.is_nan() { f32::NAN.to_bits() } else { value.to_bits() }
    }

    fn row() -> impl Strategy<Value = Row> {
        prop::array::uniform8(prop_oneof![any::<f32>(), (-4_i8..4).prop_map(f32::from)])
            .prop_map(Row)
    }

    /// Pushes twice, culls, and transposes points: what is left on the stack, and the rows.
    struct Stacked {
        enter: Row,
        limits: Row,
        order: u32,
        limit: f32,
        points: [[f64; 3]; 8],
    }

    impl Task for Stacked {
        type Output = (Vec<(u32, u32)>, Vec<(u32, u32)>, [[u32; 8]; 3]);
        #[inline(always)]
        fn run<V: V8>(self) -> Self::Output {
            let words = Row([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
            let mut pending = PendingChildren::EMPTY;
            pending.restart();
            let enter = V::load(&self.enter);
            let hits = enter.le(V::load(&self.limits));
            V::push(hits, enter, &words, self.order, &mut pending);
            V::push(hits, enter.add(enter), &words, self.order, &mut pending);
            let pushed = entries(&pending);
            V::cull(&mut pending, self.limit);
            let points = self.points.map(DVec3::from_array);
            let rows = V::transpose(points.each_ref(), DVec3::new(1.0, 0.1, -0.3));
            (pushed, entries(&pending), rows.map(|row| row.store().0.map(f32::to_bits)))
        }
    }

    fn entries(pending: &PendingChildren) -> Vec<(u32, u32)> {
        let distances = pending.distances.iter().map(|distance| distance.to_bits());
        distances.zip(pending.words).take(pending.height).collect()
    }

    struct Least(Row);

    impl Task for Least {
        type Output = f32;
        #[inline(always)]
        fn run<V: V8>(self) -> f32 {
            V::load(&self.0).min_lane()
        }
    }

    proptest! {
        #[test]
        fn the_least_of_eight(values in prop::array::uniform8(-1e30_f32..1e30)) {
            let min_lane = values.iter().copied().fold(f32::INFINITY, f32::min);
            prop_assert_eq!(Portable::run(Least(Row(values))), min_lane);
            if super::has_avx2() {
                prop_assert_eq!(Avx2::run(Least(Row(values))), min_lane);
            }
        }

        #[test]
        fn stacks_and_rows_are_the_same(
            enter in prop::array::uniform8(0.0_f32..9.0),
            limits in prop::array::uniform8(0.0_f32..9.0),
            order in Just([0_u32, 1, 2, 3, 4, 5, 6, 7]).prop_shuffle(),
            limit in 0.0_f32..18.0,
            points in prop::array::uniform8(prop::array::uniform3(-9.0_f64..9.0)),
        ) {
            let order = order.iter().rev().fold(0, |packed, &child| packed << 3 | child);
            let (enter, limits) = (Row(enter), Row(limits));
            let task = || Stacked { enter, limits, order, limit, points };
            let (pushed, kept, rows) = Portable::run(task());
            prop_assert!(kept.iter().all(|&(distance, _)| f32::from_bits(distance) <= limit));
            if super::has_avx2() {
                prop_assert_eq!(Avx2::run(task()), (pushed, kept, rows));
            }
        }

        #[test]
        fn vectors_and_plain_rust_give_the_same_bits(a in row(), b in row(), c in row()) {
            if super::has_avx2() {
                prop_assert_eq!(Avx2::run(Every(a, b, c)), Portable::run(Every(a, b, c)));
            }
        }
    }
}
