//! Host timing of the public calls beside the usual ways: `cargo bench -p benches --bench host`.

mod curves;
#[path = "../../tests/support/mod.rs"]
mod support;

use std::hint::black_box;

use criterion::{BenchmarkGroup, Criterion, Throughput, criterion_group, criterion_main};
use curves::CURVES;
use shutter_curve::{CubicBezier, ShutterCurve};
use support::baseline::{InverseTable, TextbookNewton};
use support::peers::{Parts, animation};

/// So many that no branch predictor learns their order from one round to the next.
const COUNT: usize = 1 << 16;

/// Fractions in no order.
fn fractions() -> Vec<f32> {
    let mut state = 1u32;
    let mut next = || {
        state = state.wrapping_mul(1664525).wrapping_add(1013904223);
        (state >> 8) as f32 / (1 << 24) as f32
    };
    (0..COUNT).map(|_| next()).collect()
}

fn single(
    group: &mut BenchmarkGroup<criterion::measurement::WallTime>,
    name: &str,
    inputs: &[f32],
    call: impl Fn(f32) -> f32,
) {
    group.bench_function(name, |bench| {
        bench.iter(|| {
            for &input in inputs {
                black_box(call(black_box(input)));
            }
        });
    });
}

fn host(criterion: &mut Criterion) {
    let u = fractions();
    let mut out = vec![0.0; COUNT];
    for (name, opening, closing) in CURVES {
        let ramps = (CubicBezier::new(opening), CubicBezier::new(closing));
        let curve = ShutterCurve::new(ramps.0, ramps.1).expect("a good curve");
        let compact = ShutterCurve::<0>::with_cells(ramps.0, ramps.1).expect("a good curve");
        let newton = TextbookNewton::new(opening, closing);
        let table = InverseTable::<256>::new(|u| curve.inverse_cdf(u));
        let parts = Parts::<f32>::new(opening, closing);
        let solve = |ramp: &_, t| animation(ramp, t, 1e-6).unwrap_or(0.0);
        let t: Vec<f32> = u.iter().map(|&u| curve.close_end() * u).collect();

        let mut group = criterion.benchmark_group(name);
        group.throughput(Throughput::Elements(COUNT as u64));
        single(&mut group, "inverse_cdf", &u, |u| curve.inverse_cdf(u));
        single(&mut group, "inverse_cdf, CELLS = 0", &u, |u| compact.inverse_cdf(u));
        single(&mut group, "inverse_cdf, textbook Newton", &u, |u| newton.inverse_cdf(u));
        single(&mut group, "inverse_cdf, 256-entry table", &u, |u| table.inverse_cdf(u));
        group.bench_function("inverse_cdf_slice", |bench| {
            bench.iter(|| curve.inverse_cdf_slice(black_box(&u), black_box(&mut out)));
        });
        single(&mut group, "cdf", &t, |t| curve.cdf(t));
        single(&mut group, "cdf, 8 Newton steps", &t, |t| parts.cdf(t, solve));
        single(&mut group, "opening", &t, |t| curve.opening(t));
        single(&mut group, "opening, 8 Newton steps", &t, |t| parts.openness(t, solve));
        group.finish();
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(30).measurement_time(std::time::Duration::from_secs(1))
        .warm_up_time(std::time::Duration::from_millis(300));
    targets = host
}
criterion_main!(benches);
