//! The plateau's line in doubles, which answers faster on a processor that has them: for one `u` and for a slice, to
//! the same bits.

use crate::plan::Plan;

/// Does the processor have doubles? One of 64 bits does.
const DOUBLES: bool = cfg!(target_pointer_width = "64");

/// 2¹² units.
const SLACK: f64 = 4096.0;

/// The plateau's line, `t = base + A u`.
///
/// In doubles the time is within four roundings of the exact one, each at most 2⁸ of the plan's units of time, of which
/// a time has at most 2⁶²; in units it is within one. So the two are less than [`SLACK`] units apart, and if all within
/// the slack rounds to one `f32`, that is the answer of both.
struct Line {
    base: f64,
    slope: f64,
    slack: f64,
    /// The plateau in `u`: above the first, up to the second.
    from: f32,
    to: f32,
}

impl Line {
    #[inline(always)]
    fn new<const CELLS: usize>(plan: &Plan<CELLS>) -> Self {
        let ([base, slope, unit], [from, to]) = (plan.line(), plan.served_by_line());
        Self { base, slope, slack: SLACK * unit, from, to }
    }

    /// The time, and whether it is the answer.
    #[inline(always)]
    fn at(&self, u: f32) -> (f32, bool) {
        let time = self.base + self.slope * u as f64;
        let (least, greatest) = ((time - self.slack) as f32, (time + self.slack) as f32);
        (least, (u > self.from) & (u <= self.to) & (least == greatest))
    }
}

/// [`Plan::inverse_cdf`], the plateau by doubles where there are any: the same bits.
#[inline]
pub(crate) fn inverse_cdf<const CELLS: usize>(plan: &Plan<CELLS>, u: f32) -> f32 {
    if DOUBLES {
        let (time, is_right) = Line::new(plan).at(u);
        if is_right {
            return time;
        }
    }
    plan.inverse_cdf(u)
}

/// [`inverse_cdf`] of each `u` into the `t` beside it.
///
/// A processor cannot predict which section a `u` falls into, and a miss costs it more than the answer. So a first pass
/// gives each `u` the plateau's answer, several at a time. A second lists, without a branch, those `u` that are not on
/// it, and a third answers these.
pub(crate) fn inverse_cdf_slice<const CELLS: usize>(plan: &Plan<CELLS>, u: &[f32], t: &mut [f32]) {
    if !DOUBLES {
        for (u, t) in u.iter().zip(t) {
            *t = plan.inverse_cdf(*u);
        }
        return;
    }
    const CHUNK: usize = 128;
    let line = Line::new(plan);
    // Not zipped, because that would divide by a chunk's length, which built for size is no constant: a possible panic.
    let mut chunks = t.chunks_mut(CHUNK);
    for u in u.chunks(CHUNK) {
        let Some(t) = chunks.next() else { return };
        let mut right = [0u32; CHUNK];
        for ((u, t), right) in u.iter().zip(&mut *t).zip(&mut right) {
            let (time, is_right) = line.at(*u);
            (*t, *right) = (time, is_right as u32);
        }
        let (mut list, mut listed) = ([0u8; CHUNK], 0);
        for (i, right) in right.iter().take(u.len()).enumerate() {
            list[listed % CHUNK] = i as u8;
            listed += 1 - *right as usize;
        }
        // `get`, because an index could panic: the compiler does not know that each number is a place of both slices.
        for i in list.iter().take(listed) {
            if let (Some(u), Some(t)) = (u.get(*i as usize), t.get_mut(*i as usize)) {
                *t = plan.inverse_cdf(*u);
            }
        }
    }
}
