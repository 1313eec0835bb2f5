//! The fractions of the exposure at which triggers and the ends of pulses are due, to 96 bits. A *frame* is the
//! triggers, or the pulses, of one exposure.

use crate::pair::Pair;
use crate::units::{WHOLE_EXPONENT, power_of_two};

/// One end of a pulse. A pulse lies around the middle of its share of the exposure, where its trigger would be: so its
/// ends are half of the pulse before and after that. A trigger is a pulse without length.
#[derive(Clone, Copy)]
pub(crate) struct Edge {
    /// Half of the pulse, in units of 2⁻⁶⁴, and the rest in units of 2⁻⁹⁶.
    half: u64,
    rest: u32,
    /// Is it the later end, where the pulse goes off?
    is_off: bool,
}

impl Edge {
    pub(crate) const TRIGGER: Self = Self { half: 0, rest: 0, is_off: false };
}

/// The fractions `(2i + 1) / 2n` of the exposure.
#[derive(Clone)]
pub(crate) struct Fractions {
    pub(crate) n: u32,
    /// `1 / 2n` in units of 2⁻⁶⁴, rounded down, ...
    half_share: u64,
    /// ... and what is missing of it, in units of 2⁻⁹⁶.
    rest: u32,
}

impl Fractions {
    /// A 64-bit division is slow on a small processor, so there is only this one. `1 / 2n` is too small by at most
    /// 3 · 2⁻⁹⁶.
    // proofs/shares.py: Fractions::new
    pub(crate) fn new(n: u32) -> Self {
        let divisor = n as u64 | (n == 0) as u64;
        let half_share = (1 << 63) / divisor;
        // The rest is the remainder over n, in 2⁻⁹⁶; and 1/n is twice half a share, so it is remainder · half_share ·
        // 2 · 2³² / 2⁶⁴.
        let remainder = (1 << 63) - half_share * divisor;
        Self { n, half_share, rest: ((remainder * half_share) >> 31) as u32 }
    }

    /// The fraction `odd / 2n`, or half a pulse before or after it, in units of 2⁻⁶⁴. In frames that have direct
    /// triggers it is too low by at most two of these; half a pulse is too short by at most two, too. The last pulse's end at 1 becomes
    /// 0, which is in no octave (`proofs/shares.py`).
    #[inline(always)]
    pub(crate) fn in_u64(&self, odd: u32, edge: &Edge) -> u64 {
        // Without the rest it would be too low by up to `odd` units: many ulp of an `f32` of what is left until 1.
        let rest = (self.rest as u64 * odd as u64) >> 32;
        let middle = self.half_share.wrapping_mul(odd as u64).wrapping_add(rest);
        if edge.is_off { middle.wrapping_add(edge.half) } else { middle.wrapping_sub(edge.half) }
    }

    /// The fraction `odd / 2n`, or half a pulse before or after it, counted from its nearer side, in
    /// [`WHOLE`](crate::units::WHOLE), to 2⁻⁴⁵; in frames of more than 2²⁵ pulses that nearly touch, the first end to
    /// 2⁻³⁸ (`proofs/shares.py`).
    pub(crate) fn exactly(&self, odd: u64, edge: &Edge) -> (usize, Pair) {
        let n = self.n as u64;
        let (side, near) =
            if odd < n || odd == n && !edge.is_off { (0, odd) } else { (1, 2 * n - odd) };
        // Word by word: `near` times a number of 96 bits, at most 2⁹⁵.
        let low = near * self.rest as u64;
        let middle = near * (self.half_share as u32 as u64) + (low >> 32);
        let words = (near * (self.half_share >> 32) + (middle >> 32)) << 32 | middle as u32 as u64;
        // Half of the pulse, towards the other side or away from it. It is at most half a share, and `near` counts at
        // least one of these, so no difference is negative.
        let (words, low) = if edge.is_off == (side == 0) {
            let (low, carry) = (low as u32).overflowing_add(edge.rest);
            (words.wrapping_add(edge.half).wrapping_add(carry as u64), low)
        } else {
            let (low, borrow) = (low as u32).overflowing_sub(edge.rest);
            (words.saturating_sub(edge.half).saturating_sub(borrow as u64), low)
        };
        // The 64 bits from the first that is set ...
        let (words, low, down) =
            if words >> 32 == 0 { (words << 32 | low as u64, 0, 32) } else { (words, low, 0) };
        let zeros = words.leading_zeros() & 63;
        let bits = words << zeros | (low as u64) << zeros >> 32;
        // ... of which a pair takes 48.
        let [hi, lo] = [bits >> 40, bits >> 16 & 0xFF_FFFF].map(|half| half as u32 as f32);
        let unit = power_of_two(WHOLE_EXPONENT - 24 - down - zeros as i32);
        (side, Pair { hi: hi * unit, lo: lo * (unit / (1 << 24) as f32) })
    }

    /// The ends of a pulse that takes the part `duty`, above 0 and at most 1, of each share: when it goes on, and off.
    pub(crate) fn edges(&self, duty: f32) -> [Edge; 2] {
        let bits = duty.to_bits();
        let (significand, down) = (bits & 0x7F_FFFF | 1 << 23, 150 - (bits >> 23));
        // Below 2¹²⁰.
        let half_share = (self.half_share as u128) << 32 | self.rest as u128;
        let half = (half_share * significand as u128).checked_shr(down).unwrap_or(0);
        let edge = |is_off| Edge { half: (half >> 32) as u64, rest: half as u32, is_off };
        [edge(false), edge(true)]
    }
}
