//! What is measured: each the call and nothing else, never inlined.

use firmware::baseline::{InverseTable, TextbookNewton};
use firmware::{TICK_HZ, TRIGGERS};
use shutter_curve::{CubicBezier, CurveError, ScheduleError, ShutterCurve};

#[inline(never)]
pub fn measured_inverse_cdf<const C: usize>(curve: &ShutterCurve<C>, u: f32) -> f32 {
    curve.inverse_cdf(u)
}

#[inline(never)]
pub fn measured_cdf<const C: usize>(curve: &ShutterCurve<C>, t: f32) -> f32 {
    curve.cdf(t)
}

#[inline(never)]
pub fn measured_opening<const C: usize>(curve: &ShutterCurve<C>, t: f32) -> f32 {
    curve.opening(t)
}

#[inline(never)]
pub fn measured_tick_step(ticks: &mut impl Iterator<Item = u32>) -> Option<u32> {
    ticks.next()
}

#[inline(never)]
pub fn measured_schedule<const C: usize>(
    curve: &ShutterCurve<C>,
    ticks: &mut [u32; TRIGGERS as usize],
    gap: u32,
) -> Result<(), ScheduleError> {
    curve.schedule_into(ticks, TICK_HZ, gap)
}

#[inline(never)]
pub fn measured_construct<const C: usize>(
    opening: CubicBezier,
    closing: CubicBezier,
) -> Result<ShutterCurve<C>, CurveError> {
    ShutterCurve::with_cells(opening, closing)
}

#[inline(never)]
pub fn measured_newton(curve: &TextbookNewton, u: f32) -> f32 {
    curve.inverse_cdf(u)
}

#[inline(never)]
pub fn measured_table(table: &InverseTable<256>, u: f32) -> f32 {
    table.inverse_cdf(u)
}
