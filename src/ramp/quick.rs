//! A quick place for a time on a ramp: what is missing is measured once, and one step makes up for it.
//!
//! Time along a ramp is a cubic. Halley's step from the ramp's end and one more in single precision come to about a
//! thousandth; the step after the measurement leaves the cube of that. A bound of what it leaves
//! ([`left`](crate::search::left)) accepts the place or not: where time nearly stands still, a search has to find it.

use crate::number::pair::{Pair, lost_by_short_product, upper};
use crate::number::units::LAST_PLACE;
use crate::search::{ROUNDING, Taylor, left};

/// The place at which a cubic in pairs, without a constant term, reaches `target`, within `error`.
#[inline(always)]
pub(crate) const fn quick_place(c: [Pair; 3], target: Pair, error: f32) -> Option<Pair> {
    let single = [c[0].hi, c[1].hi, c[2].hi];
    let [c1, c2, _] = single;
    let sought = target.hi;
    let x = sought * c1 / (c1 * c1 + c2 * sought);
    let local = Taylor::new(&single, x);
    let inverse = 1.0 / local.d1;
    let newton = (sought - local.value) * inverse;
    let bend = local.d2 * newton * inverse;
    let x = upper(x + newton * (1.0 - bend * (1.0 - bend)));
    let local = Taylor::new(&single, x);
    let missing = target.difference(value(c, x));
    // One step of Newton's brings the reciprocal of the slope here.
    let inverse = inverse * (2.0 - local.d1 * inverse);
    let newton = missing * inverse;
    let step = newton * (1.0 - local.d2 * newton * inverse);
    let place = Pair::sum(x, step);
    // A cubic has other roots beyond the ramp. What is below 0, too, has greater bits.
    let is_inside = place.hi.to_bits() <= LAST_PLACE.to_bits();
    let left = left(&single, [x, 0.0], &local, missing, step, ROUNDING);
    if is_inside & (left <= 0.75 * error) { Some(place) } else { None }
}

/// The cubic's value where `x` has 12 bits: as [`Series::at`](crate::number::series::Series::at) computes it.
#[inline(always)]
const fn value([c1, c2, c3]: [Pair; 3], x: f32) -> Pair {
    let product = c3.hi * x;
    let lo = c3.lo * x + lost_by_short_product(product, c3.hi, x);
    let sum = Pair::sum(c2.hi, product);
    let lo = lo + (c2.lo + sum.lo);
    let product = sum.hi * x;
    let lo = lo * x + lost_by_short_product(product, sum.hi, x);
    let sum = Pair::sum(c1.hi, product);
    let lo = lo + (c1.lo + sum.lo);
    let product = sum.hi * x;
    Pair { hi: product, lo: lo * x + lost_by_short_product(product, sum.hi, x) }
}
