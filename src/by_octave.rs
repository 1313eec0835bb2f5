//! The cdf by an octave: its polynomial gives a time by `u`, and here it is inverted.
//!
//! A guess is rounded to an `f32`, `u`. It is the answer if the time lies between those of the middles between `u` and
//! either neighbour, by the polynomial as [`inverse_cdf`](Plan::inverse_cdf) evaluates it. So nothing has to be known
//! of the guess. What is not answered so and lies next to a middle is settled by the same times
//! ([`Plan::time_between`]): so the order holds whichever way answers.
// docs/proofs.md: `cdf` never steps back

use crate::octave::{self, FINER, Octave, times_high};
use crate::plan::Plan;
use crate::units::TOP_STEP;

const HALF: u32 = 0.5f32.to_bits();
const ONE: u32 = 1.0f32.to_bits();
/// One more in the exponent, in the bits of an `f32`.
const BINADE: u32 = 1 << 23;
/// Octaves are looked through from this one where the time is beyond its middle, which saves comparisons, else from the
/// first one.
const SKIP: usize = 4;

impl<const CELLS: usize> Plan<CELLS> {
    /// The cdf at a time on a ramp, if an octave's polynomial gives it.
    #[inline(always)]
    pub(crate) fn cdf_by_octave(&self, ramp: usize, t: f32) -> Option<f32> {
        if CELLS == 0 || self.runs_across_0() {
            return None;
        }
        let time = self.in_units(t)?;
        let (side, index) = self.octave_about(ramp, time)?;
        let octave = self.octaves[side & 1].get(index)?;
        // The time from the middle, in the unit of the coefficients, rounded down. A factor is at most 2³⁰; the mask is for
        // the 0 of an octave without a polynomial.
        let way = time.wrapping_sub(octave.middle) >> (octave.factor.trailing_zeros() & 31);
        if way != way as i32 as i64 || !octave.exists() {
            return None;
        }
        // From side 0, `P(x) <= y` says that `t` is not before the time of `x`. From side 1, whose factor is negative, `t`
        // is before that if `P(x) < -way`, which is `P(x) <= !way`: there `P(x) <= y` says so.
        let y = way as i32 ^ -(side as i32);
        let doubled = octave.inverted(y);
        // The octave is (top / 2, top], and `a` and `end`, its top, count 2⁻³¹ of its power of two: so they fit a word.
        // The way from the octave's start, in 2⁻³² as positions, fits one, too.
        let top = octave::top(self.tops[side & 1][ramp & 1]).wrapping_sub((index as u32) << 23);
        let power_bits = top & !(BINADE - 1);
        let eighths = (top / TOP_STEP) & 7;
        let end = (8 + eighths) << 28;
        let since_start = doubled.wrapping_add((8 - eighths) << 28);
        let a = (end >> 1) + (since_start >> 1);
        // Neighbouring `f32` are 2 to this apart, in 2⁻³¹ of the power of two: 2⁸ from that on, and 2⁷ below. On the later
        // side they are those of `u`, from 1/2 to 1. Where they are more than 2²⁴ apart an octave holds few.
        let apart = if side == 0 { 7 + (a >> 31) } else { (7 + 127) - power_bits / BINADE };
        if apart > 24 {
            return None;
        }
        // One number for two: the distance in 2⁻³¹, as `a` counts, and half of the distance in 2⁻³², as positions count.
        let [distance, half] = [1 << apart; 2];
        let n = (a + (distance >> 1)) >> apart;
        // From side 0 `n` is a significand with its leading one, which adds a binade to the bits: one is taken off
        // again. Below the power of two it is two, for the lesser exponent.
        let bits = if side == 0 {
            (power_bits - 2 * BINADE + n).wrapping_add((a >> 31) * BINADE)
        } else {
            ONE - n
        };
        // Both neighbours have to be served by this polynomial, too: on this ramp, in this octave, and on this side.
        // And where the power of two is between them they are not equally far.
        let leaves_ramp = if ramp == 0 {
            bits >= self.last.wrapping_sub(self.count)
        } else {
            bits <= self.last + 1
        };
        if leaves_ramp {
            return None;
        }
        let leaves_octave = (n + 1) << apart > end || (n - 1) << apart <= end >> 1;
        let leaves_side = if side == 0 { bits >= HALF } else { bits <= HALF + 1 };
        let position = n << apart << 1;
        if leaves_octave || leaves_side || position == 0 {
            return None;
        }
        // The coefficients are loaded anew, or the compiler would spill them; once for both evaluations.
        let octave = core::hint::black_box(octave);
        let low = octave.polynomial(octave.ahead_of_center(position.wrapping_sub(half) as i32));
        let high = octave.polynomial(octave.ahead_of_center(position.wrapping_add(half) as i32));
        ((low <= y) & (y < high)).then_some(f32::from_bits(bits))
    }

    /// A time in units, as [`fixed`](crate::units::fixed) has it, if they are less than 2⁶³ and no fewer than 2³¹.
    // proofs/cdf.py
    #[inline(always)]
    fn in_units(&self, t: f32) -> Option<i64> {
        let (bits, sign) = (t.to_bits(), (t.to_bits() as i32 >> 31) as i64);
        let up = (bits >> 23 & 0xFF).wrapping_add(1).wrapping_sub(self.scale.to_bits() >> 23);
        if up > 31 {
            return None;
        }
        let word = bits << 8 | 1 << 31;
        let units = ((word >> 1 >> (31 - up)) as i64) << 32 | (word << up) as i64;
        Some((units ^ sign).wrapping_sub(sign))
    }

    /// Polynomials are then less exact than `f32` next to 0 are dense. By integers, because a processor waits for a
    /// comparison of floats; no time here is -0.0.
    #[inline(always)]
    fn runs_across_0(&self) -> bool {
        let [start, end] = [0, 1].map(|side| self.exposure.outer(side).to_bits() as i32);
        start < 0 && end > 0
    }

    /// The time, in units, of the middle between the `f32` with these bits and the next one, if one polynomial serves
    /// both.
    pub(crate) fn time_between(&self, bits: u32) -> Option<i64> {
        let both = [bits, bits.wrapping_add(1)].map(f32::from_bits);
        let [before_last, next_before_last] = both.map(|u| self.before_last(u));
        let [(side, a), (other, b)] = both.map(Self::nearer);
        let is_one_ramp = side == other && before_last >> 31 == next_before_last >> 31;
        let on_line = before_last < self.count || next_before_last < self.count;
        if self.runs_across_0() || !is_one_ramp || on_line {
            return None;
        }
        let ramp = (before_last >> 31) as usize;
        let (octave, a) = self.look_up(side, ramp, a)?;
        let (same, b) = self.look_up(side, ramp, b)?;
        let [a, b] = [a, b].map(octave::doubled);
        let middle = a.wrapping_add(b.wrapping_sub(a) >> 1);
        let is_served = core::ptr::eq(octave, same) && octave.exists();
        is_served.then(|| octave.time(octave.ahead_of_center(middle)))
    }

    /// The side and the index of the octave in which a time on a ramp probably is.
    #[inline(always)]
    fn octave_about(&self, ramp: usize, time: i64) -> Option<(usize, usize)> {
        let high = |time: i64| (time >> 32) as i32;
        // Only where 1/2 is on the ramp, both sides may have octaves there.
        let is_split =
            if ramp == 0 { self.last.wrapping_sub(self.count) > HALF } else { self.last < HALF };
        let side = if is_split {
            let [first, second] = [self.octaves[0].first()?, self.octaves[1].first()?];
            (high(time) > (high(first.middle) >> 1) + (high(second.middle) >> 1)) as usize
        } else {
            ramp & 1
        };
        // By upper words. From the later side times are mirrored, so that they fall from octave to octave.
        let back = -(side as i32);
        let octaves = &self.octaves[side & 1];
        let middle = |index: usize| octaves.get(index).map(|octave| high(octave.middle) ^ back);
        let t = high(time) ^ back;
        let mut index = if middle(SKIP).is_some_and(|middle| t < middle) { SKIP } else { 0 };
        let (mut before, mut here) = (i32::MAX, middle(index)?);
        while let Some(next) = middle(index + 1) {
            // Two octaves meet a third of the way, in fractions, from the next one's middle to this one's. In time it is
            // somewhat more: here three eighths.
            let way = here.wrapping_sub(next);
            if t >= next.wrapping_add(way >> 2).wrapping_add(way >> 3) {
                return Some((side, index));
            }
            (index, before, here) = (index + 1, here, next);
        }
        // The last one ends nearer to its middle than half the distance to the middle before.
        let is_near = before == i32::MAX || t >= here.wrapping_sub(before.wrapping_sub(here) >> 1);
        is_near.then_some((side, index))
    }
}

/// 1 in fixed point with 27 bits after the point, where quotients of coefficients may be up to 16.
const FIXED_ONE: i32 = 1 << 27;

/// The product of two numbers in fixed point.
#[inline(always)]
fn times_fixed(a: i32, b: i32) -> i32 {
    times_high(a << 5, b)
}

/// Nearly 2⁵⁹ / divisor, for divisors of 29 to 32 bits: `times_high` of a number and this is their quotient in fixed
/// point. It takes one division of 32 bits, and 13 to 15 of its bits are right.
#[inline(always)]
fn reciprocal(divisor: u32) -> i32 {
    u32::MAX.checked_div(divisor >> 15).unwrap_or(0).wrapping_shl(12) as i32
}

impl Octave {
    /// Nearly the position, doubled where it has to be, at which the polynomial is `y`. By integers, which are quick
    /// without an FPU, too; where one overflows, the guess is wrong, as any guess may be.
    #[inline(always)]
    fn inverted(&self, y: i32) -> u32 {
        let [c8, c7, c6, c5, c4, c3, c2, c1] = self.c;
        // The series of the inverse from the middle: with `n = y / c1` and `rk = ck / c1` it is `n - r2 n² + (2 r2² - r3)
        // n³ - (r4 + 5 r2 (r2² - r3)) n⁴`. `1 / c1` is refined by a step of Newton's.
        let inverse = reciprocal(c1 as u32);
        let excess = times_high(c1, inverse).wrapping_sub(FIXED_ONE);
        let inverse = inverse.wrapping_sub(times_fixed(excess, inverse));
        let [n, r2, r3, r4] = [y, c2, c3, c4].map(|c| times_high(c, inverse));
        let square = times_fixed(r2, r2);
        let bend = square.wrapping_sub(r3);
        let third = r4.wrapping_add(times_fixed(r2, bend).wrapping_mul(5));
        let second = square.wrapping_add(bend).wrapping_sub(times_fixed(n, third));
        let first = r2.wrapping_sub(times_fixed(n, second));
        let x = n.wrapping_sub(times_fixed(times_fixed(n, n), first)) << 5;
        // And one step of Newton's, with value and slope by synthetic division.
        let mul = |a: i32| times_high(a, x);
        let (mut value, mut slope) = (c8, c8);
        for c in [c7, c6, c5, c4, c3, c2, c1] {
            value = mul(value).wrapping_add(c);
            slope = mul(slope).wrapping_add(value);
        }
        // A slope may fill 32 bits. The product with what is missing counts 2⁻³², as `x` does.
        let missing = y.wrapping_sub(mul(value));
        let x = x.wrapping_add(times_fixed(missing, reciprocal(slope as u32)));
        (x >> (self.center & FINER)).wrapping_add(self.center as i32) as u32
    }
}
