//! Host timing of the public calls beside the usual ways: `cargo bench -p benches --bench host`.

#[path = "speed_vs_error/methods.rs"]
mod methods;
#[path = "../../tests/support/mod.rs"]
mod support;

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use methods::{CURVES, FORWARDS, METHODS, fractions};
use support::oracle::Curve;

fn host(criterion: &mut Criterion) {
    let u = fractions();
    let mut t = vec![0.0; u.len()];
    for (name, opening, closing) in CURVES {
        let curve = Curve::shutter(opening, closing);
        let mut group = criterion.benchmark_group(name);
        group.throughput(Throughput::Elements(u.len() as u64));
        for method in METHODS {
            let inverse = (method.build)(&curve);
            let id = |kind| BenchmarkId::new(method.name.replace('`', ""), kind);
            group.bench_function(id("single"), |bench| bench.iter(|| inverse.singles(&u)));
            group.bench_function(id("slice"), |bench| {
                bench.iter(|| inverse.slice(black_box(&u), black_box(&mut t)));
            });
        }
        let length = curve.close_end() - curve.open_start();
        let times: Vec<f32> = u.iter().map(|u| curve.open_start() + u * length).collect();
        for (name, build) in FORWARDS {
            let forward = build(&curve);
            group.bench_function(name.replace('`', ""), |bench| {
                bench.iter(|| forward(&times, black_box(&mut t)));
            });
        }
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(30).measurement_time(Duration::from_secs(1))
        .warm_up_time(Duration::from_millis(300));
    targets = host
}
criterion_main!(benches);
