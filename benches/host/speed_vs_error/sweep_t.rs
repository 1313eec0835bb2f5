//! The cdf and the openness at every `t` of a curve.

use shutter_curve::ShutterCurve;

use crate::follower::Follower;
use crate::support::cases::shutter;
use crate::support::oracle::{Curve, Exact, ulp_f32};
use crate::support::promise::{CDF_FLOOR, DENSITY_FLOOR};
use crate::sweep::{CHUNK, SAMPLED, Sweep, in_parts};

/// Nearer to time 0 than this part of a curve that runs across it, nothing moves by 2⁻⁴⁰ of an ulp: there one `f32` of
/// so many is taken, in stretches of neighbours.
const NEXT_TO_0: f64 = 1.0 / (1u128 << 64) as f64;
const TAKEN_NEXT_TO_0: i64 = 16;

/// The `f32` in order: 0 for 0, and from there up and down.
fn place(t: f32) -> i64 {
    let size = i64::from(t.abs().to_bits());
    if t < 0.0 { -size } else { size }
}

fn at(place: i64) -> f32 {
    let size = f32::from_bits(place.unsigned_abs() as u32);
    if place < 0 { -size } else { size }
}

/// Sweeps the cdf and the openness of the curve over every `f32` in its interval.
pub fn sweep(curve: &Curve) -> [Sweep; 2] {
    let (shutter, exact) = (shutter::<8>(curve), Exact::new(curve));
    let (first, last) = (place(curve.open_start()), place(curve.close_end()));
    let length = f64::from(curve.close_end()) - f64::from(curve.open_start());
    let still = if first < 0 && last > 0 { place((NEXT_TO_0 * length) as f32) } else { -1 };
    in_parts(first, last, |from, to| {
        let is_still = from >= -still && to <= still;
        let taken = if is_still { from + CHUNK / TAKEN_NEXT_TO_0 - 1 } else { to };
        part(&shutter, &exact, from, taken.min(to))
    })
}

fn part(shutter: &ShutterCurve, exact: &Exact, from: i64, to: i64) -> [Sweep; 2] {
    let count = (to - from) as u64 + 1;
    let sweep = |function| Sweep { function, count, ..Sweep::default() };
    let [mut cdf, mut openness] = ["cdf", "openness"].map(sweep);
    let (mut steps_back, mut without_floor) = (0, 0.0f64);
    let mut truth = Truth::new(exact.curve(), from);
    let mut last = if at(from) > shutter.open_start() { shutter.cdf(at(from - 1)) } else { 0.0 };
    let mut worst = [from; 2];
    for place in from..=to {
        let t = at(place);
        let got = [shutter.cdf(t), shutter.openness(t)];
        steps_back += u64::from(got[0] < last);
        last = got[0];
        for (sweep, got) in [&mut cdf, &mut openness].into_iter().zip(got) {
            sweep.out_of_range += u64::from(!(0.0..=1.0).contains(&got));
        }
        let [cdfs, opennesses] = truth.around(place);
        let missed = missed(got[0], cdfs);
        let error = missed.0 / ulp_f32(missed.1.max(CDF_FLOOR));
        if error > cdf.error {
            (cdf.error, worst[0]) = (error, place);
        }
        if missed.0 > 0.0 {
            without_floor = without_floor.max(missed.0 / ulp_f32(missed.1));
        }
        let missed = self::missed(got[1], opennesses);
        let error = missed.0 / ulp_f32(missed.1.max(DENSITY_FLOOR));
        if error > openness.error {
            (openness.error, worst[1]) = (error, place);
        }
        if place % SAMPLED == 0 {
            cdf.judge(exact.near(t).cdf_ulp(got[0], CDF_FLOOR));
            openness.judge(exact.near(t).openness_ulp(got[1], DENSITY_FLOOR));
        }
    }
    let [of_cdf, of_openness] = worst.map(at);
    cdf.judge(exact.near(of_cdf).cdf_ulp(shutter.cdf(of_cdf), CDF_FLOOR));
    let got = shutter.openness(of_openness);
    openness.judge(exact.near(of_openness).openness_ulp(got, DENSITY_FLOOR));
    cdf.steps_back = Some(steps_back);
    cdf.without_floor = Some(without_floor);
    [cdf, openness]
}

/// By how much a value misses a range, and the bound that it misses.
fn missed(got: f32, [low, high]: [f64; 2]) -> (f64, f64) {
    let got = f64::from(got);
    if got < low {
        (low - got, low)
    } else if got > high {
        (got - high, high)
    } else if got.is_nan() {
        (f64::INFINITY, 1.0)
    } else {
        (0.0, got)
    }
}

/// The exact values at times that follow each other.
struct Truth {
    follower: Follower,
    /// The cdf and the openness at a time, the one before and the one after: an ulp away where the curve does not run
    /// across time 0, for so far are its neighbours. Half an ulp below a power of two, which only is stricter.
    window: [[f64; 2]; 3],
    /// Where it does, what finds the other two; they move on their own.
    sides: Option<[Follower; 2]>,
}

impl Truth {
    fn new(curve: &Curve, first: i64) -> Self {
        let mut follower = Follower::new(curve);
        let sides = follower.across.is_some().then(|| [Follower::new(curve), Follower::new(curve)]);
        // `around` moves on by one.
        let window = [first - 1, first - 1, first].map(|place| follower.values(at(place).into()));
        Self { follower, window, sides }
    }

    /// The least and the greatest cdf and openness within an ulp of the time at the next `place`.
    fn around(&mut self, place: i64) -> [[f64; 2]; 2] {
        let t = f64::from(at(place));
        let reach = self.follower.ulp(t);
        if let Some([before, after]) = &mut self.sides {
            let middle = self.follower.values(t);
            self.window = [before.values(t - reach), middle, after.values(t + reach)];
        } else {
            let after = self.follower.values(at(place + 1).into());
            self.window = [self.window[1], self.window[2], after];
        }
        let [[a, f], [b, g], [c, h]] = self.window;
        let mut openness = [f.min(g).min(h), f.max(g).max(h)];
        for extremum in self.follower.extrema(t, reach) {
            openness = [openness[0].min(extremum), openness[1].max(extremum)];
        }
        // A shutter's openness is cut to [0, 1].
        [[a.min(b), b.max(c)], openness.map(|f| f.clamp(0.0, 1.0))]
    }
}
