//! When to trigger: equal shares of the exposure, as times, as timer ticks, as a checked schedule.

use crate::error::ScheduleError;
use crate::profile::Profile;
use crate::shutter::ShutterCurve;
use crate::wide::Wide;

/// Intervals of more ticks are beyond what a direct polynomial places to a quarter of a tick.
const DIRECT_TICKS: u32 = 1 << 24;
/// The most ticks an interval may have.
const MOST_TICKS: u32 = 1 << 31;

impl<const CELLS: usize> ShutterCurve<CELLS> {
    /// The `n` times that split the exposure evenly, each in the middle of its share:
    /// `inverse_cdf((i + 1/2) / n)`; never a step back.
    pub fn trigger_times(&self, n: u32) -> impl ExactSizeIterator<Item = f32> {
        (0..n).map(move |i| self.inverse_cdf((i as f32 + 0.5) / n as f32))
    }

    /// So many triggers are sure to keep `min_gap` between their exact times: `max(1, floor(A / min_gap))`, since
    /// the openness is at most 1; a curve that never fully opens may take more. `u32::MAX` where nothing is
    /// required, that is a gap of 0, below, or NaN.
    pub const fn max_triggers(&self, min_gap: f32) -> u32 {
        if min_gap <= 0.0 || min_gap.is_nan() {
            return u32::MAX;
        }
        // The cast rounds down and saturates.
        let most = (self.profile.area / min_gap as f64) as u32;
        if most > 1 { most } else { 1 }
    }

    /// The `n` trigger times in ticks of a timer that runs at `tick_hz`, counted from
    /// [`open_start`](Self::open_start), for times in seconds; never a step back. Add the timer's own base
    /// with `wrapping_add`.
    ///
    /// Each is rounded to the nearest tick of a time within 1/4 tick of the exact one, so it is at most
    /// 3/4 tick from that, for intervals of any length up to 2³¹ ticks: above 2²⁴, the direct polynomials are
    /// left aside for the solver, which places to a thousandth of a tick. Only where the openness touches 0 between the
    /// ends, so that many times have next to the same exposure, it is this that is kept, to 2⁻³⁸.
    ///
    /// # Errors
    /// A rate of 0, or one at which the interval has more than 2³¹ ticks.
    pub fn trigger_ticks(
        &self,
        n: u32,
        tick_hz: u32,
    ) -> Result<impl ExactSizeIterator<Item = u32>, ScheduleError> {
        let ticks = Ticks::new(&self.profile, n, tick_hz)?;
        Ok((0..n).map(move |i| ticks.at(i)))
    }

    /// A checked schedule: the ticks of [`trigger_ticks`](Self::trigger_ticks), no two closer than
    /// `min_gap` ticks.
    ///
    /// # Errors
    /// More triggers than `N`; a gap not kept, with how many triggers would keep it; and those of
    /// [`trigger_ticks`](Self::trigger_ticks).
    #[cfg(feature = "heapless-v0_9")]
    pub fn schedule<const N: usize>(
        &self,
        n: u32,
        tick_hz: u32,
        min_gap: u32,
    ) -> Result<heapless::Vec<u32, N>, ScheduleError> {
        let mut schedule = heapless::Vec::new();
        if n as usize > N {
            return Err(ScheduleError::CapacityExceeded);
        }
        let ticks = Ticks::new(&self.profile, n, tick_hz)?;
        for i in 0..n {
            let tick = ticks.at(i);
            if schedule.last().is_some_and(|last| tick - last < min_gap) {
                return Err(ScheduleError::GapTooSmall { most: self.most(n, tick_hz, min_gap)? });
            }
            let _ = schedule.push(tick);
        }
        Ok(schedule)
    }

    /// So many triggers keep `min_gap`, and one more does not, where `n` do not: by bisection, in log2(n) schedules.
    #[cfg(feature = "heapless-v0_9")]
    #[cold]
    #[inline(never)]
    fn most(&self, n: u32, tick_hz: u32, min_gap: u32) -> Result<u32, ScheduleError> {
        let (mut keep, mut fail) = (1, n);
        while fail - keep > 1 {
            let middle = keep + (fail - keep) / 2;
            let mut last = None;
            let keeps = self.trigger_ticks(middle, tick_hz)?.all(|tick| {
                let gap = last.map_or(u32::MAX, |last| tick - last);
                last = Some(tick);
                gap >= min_gap
            });
            *(if keeps { &mut keep } else { &mut fail }) = middle;
        }
        Ok(keep)
    }
}

/// What places the triggers of one frame.
struct Ticks<'a, const CELLS: usize> {
    profile: &'a Profile<CELLS>,
    n: u32,
    rate: Wide,
    /// `1 / 2n` in units of 2⁻⁶⁴.
    share: u64,
    plateau: [u32; 2],
    direct: Option<Direct>,
}

impl<'a, const CELLS: usize> Ticks<'a, CELLS> {
    fn new(profile: &'a Profile<CELLS>, n: u32, tick_hz: u32) -> Result<Self, ScheduleError> {
        if tick_hz == 0 {
            return Err(ScheduleError::TickRateZero);
        }
        let rate = Wide::new(tick_hz as u64, 0);
        let start = profile.start_in_units(0);
        let length = (profile.start_in_units(1) - start) as u64;
        let ticks = Wide::new(length, profile.unit()).times(rate);
        if ticks.exceeds(Wide::new(MOST_TICKS as u64, 0)) {
            return Err(ScheduleError::TickRateTooHigh);
        }
        // A 64-bit division is dear on a small processor, so only this one is made.
        let share = if n == 0 { 0 } else { (1 << 63) / n as u64 };
        let plateau = profile.plateau_in_words();
        let direct = if ticks.exceeds(Wide::new(DIRECT_TICKS as u64, 0)) {
            None
        } else {
            Direct::new(start, length, Wide::new(1, profile.unit()).times(rate))
        };
        Ok(Self { profile, n, rate, share, plateau, direct })
    }

    /// The tick of trigger `i`, at the fraction `(2i + 1) / 2n`.
    #[inline(always)]
    fn at(&self, i: u32) -> u32 {
        let odd = 2 * i as u64 + 1;
        if let Some(direct) = &self.direct
            && let Some(time) = self.profile.direct(odd.wrapping_mul(self.share), self.plateau)
        {
            return direct.tick(time);
        }
        self.exact(odd)
    }

    /// The same by the exact way; out of line, so that the direct one saves no registers for it.
    #[cold]
    #[inline(never)]
    fn exact(&self, odd: u64) -> u32 {
        let n = self.n;
        let (side, near) = if odd <= n as u64 { (0, odd) } else { (1, 2 * n as u64 - odd) };
        let a = half_reciprocal(n).times(Wide::new(near, 0));
        let delay = self.profile.delay(side, a).times(self.rate);
        // In halves of a tick, so that the last bit rounds.
        ((delay.in_units(-1) + 1) >> 1) as u32
    }
}

/// From times in the profile's unit to ticks, in fixed point.
struct Direct {
    start: i64,
    /// What brings a time after the start down to 31 bits, and the ticks in a unit of these, which count 2⁻⁶⁴.
    down: u32,
    factor: u64,
}

impl Direct {
    /// For an interval that starts at `start` and is `length` long, in units of so many `ticks`; none where these are
    /// next to none.
    fn new(start: i64, length: u64, ticks: Wide) -> Option<Self> {
        let down = 33u32.saturating_sub(length.leading_zeros());
        let factor = ticks.in_units(-64 - down as i32) as u64;
        (factor >> 32 != 0).then_some(Self { start, down, factor })
    }

    #[inline(always)]
    fn tick(&self, time: i64) -> u32 {
        let delay = time.wrapping_sub(self.start);
        if delay < 0 {
            return 0;
        }
        // `down` is below 32; where it is 0, so is the upper word.
        let delay = delay as u64;
        let high = ((delay >> 32) as u32) << (self.down.wrapping_neg() & 31);
        let delay = (high | delay as u32 >> (self.down & 31)) as u64;
        let low = (delay * (self.factor as u32 as u64)) >> 32;
        ((delay * (self.factor >> 32) + low + (1 << 31)) >> 32) as u32
    }
}

/// `1 / 2n`, to 2⁻⁶², for `n` above 0.
fn half_reciprocal(n: u32) -> Wide {
    let n = n as u64 | (n == 0) as u64;
    let (whole, rest) = ((1 << 63) / n, (1 << 63) % n);
    Wide::new(whole, -64).plus(Wide::new((rest << 32) / n, -96))
}
