#![allow(missing_docs)]
//! tmp
mod generator;
use generator::*;
use shutter::fit::{errors, frame::FrameFit, signal::Kind};
use shutter::trace::{Light, Trace, pulses};

struct Row {
    shutter: Shutter,
    rms: f64,
    max: f64,
    kind: Kind,
    cover: Vec<bool>,
    z: Vec<f64>,
    area: bool,
    eff: bool,
    ms: f64,
    tau: f64,
    n: usize,
}

fn one(shutter: Shutter, dist: Disturbance, seed: u64) -> Option<Row> {
    let mut random = Random::new(seed);
    let case = case(shutter, dist, &mut random);
    let t0 = std::time::Instant::now();
    let trace = Trace { times: case.times.clone(), values: case.values.clone() };
    let p = match pulses(&trace, Light::Auto) {
        Ok(p) => p,
        Err(e) => {
            println!("{shutter:?} {seed}: {e}");
            return None;
        }
    };
    if p.frames.len() != 1 {
        println!("{shutter:?} {seed} frames {}", p.frames.len());
    }
    let fit = FrameFit::new(&p, &p.frames[0]);
    let kind = Kind::ALL.into_iter().min_by(|a, b| fit.bic(*a).total_cmp(&fit.bic(*b))).unwrap();
    let (area, eff, triggers) = errors::results(&fit, kind, 16);
    let ms = t0.elapsed().as_secs_f64() * 1e3;
    let a = case.truth.exposure();
    let mut e = vec![];
    let mut cover = vec![];
    let mut z = vec![];
    for (i, m) in triggers.iter().enumerate() {
        let want = case.truth.trigger((i as f64 + 0.5) / 16.0);
        let got = fit.units.seconds(m.value) / case.scale;
        let err = (got - want) / a;
        let se = m.error * fit.units.pulse() / case.scale / a;
        e.push(err);
        cover.push(err.abs() <= 1.96 * se);
        z.push(err / se);
    }
    let rms = (e.iter().map(|e| e * e).sum::<f64>() / 16.0).sqrt();
    let max = e.iter().fold(0.0, |m: f64, e| m.max(e.abs()));
    let got = area.value * fit.units.pulse() / case.scale;
    let se = area.error * fit.units.pulse() / case.scale;
    if std::env::var("SHOW").is_ok() {
        println!(
            "  {seed} n {} err/h {:?} z {:?}",
            trace.times.len(),
            [0, 7, 15].map(|k| (e[k] * a * trace.times.len() as f64 * 100.0).round() / 100.0),
            [0, 4, 7, 12, 15].map(|k| (z[k] * 100.0).round() / 100.0)
        );
    }
    if std::env::var("SHOW").is_ok()
        && dist == Disturbance::Hum
        && kind == Kind::Free
        && matches!(shutter, Shutter::Trapezoid | Shutter::Symmetric)
    {
        println!("HUM {shutter:?} {seed} tau {:.2}", fit.correlation);
        for k in Kind::ALL {
            let f = &fit.kinds[k as usize];
            println!(
                "   HUM {k:?} rms {:.5} bic {:.1} hum {:?} drift {:?} {:?}",
                (f.squares / f.residuals.len() as f64).sqrt(),
                fit.bic(k),
                f.solution.signal.hum,
                f.solution.signal.drift,
                f.solution.signal.curve.times()
            );
        }
    }
    Some(Row {
        shutter,
        rms,
        max,
        kind,
        cover,
        z,
        area: (got - a).abs() <= 1.96 * se,
        eff: (eff.value - case.truth.efficiency()).abs() <= 1.96 * eff.error + 1e-4,
        ms,
        tau: fit.correlation,
        n: trace.times.len(),
    })
}

#[test]
#[ignore]
fn table() {
    let per: u64 = std::env::var("PER").ok().and_then(|s| s.parse().ok()).unwrap_or(30);
    for dist in [Disturbance::White, Disturbance::Coloured, Disturbance::Hum, Disturbance::Drift] {
        println!("== {dist:?}");
        let mut all = vec![];
        for shutter in SHUTTERS {
            let mut rows: Vec<Row> = (0..per)
                .filter_map(|s| one(shutter, dist, s * 100 + shutter as u64 * 7 + dist as u64))
                .collect();
            report(&format!("{shutter:?}"), &mut rows);
            all.append(&mut rows);
        }
        report("all", &mut all);
    }
}
fn report(name: &str, rows: &mut Vec<Row>) {
    let q = |v: &mut Vec<f64>, p: f64| {
        v.sort_by(f64::total_cmp);
        v[((v.len() - 1) as f64 * p) as usize] * 100.0
    };
    let mut rms: Vec<f64> = rows.iter().map(|r| r.rms).collect();
    let mut max: Vec<f64> = rows.iter().map(|r| r.max).collect();
    let n = rows.len() as f64;
    let kinds = Kind::ALL.map(|k| rows.iter().filter(|r| r.kind == k).count());
    let cover =
        rows.iter().map(|r| r.cover.iter().filter(|c| **c).count() as f64 / 16.0).sum::<f64>() / n;
    let area = rows.iter().filter(|r| r.area).count() as f64 / n;
    let eff = rows.iter().filter(|r| r.eff).count() as f64 / n;
    let ms = rows.iter().map(|r| r.ms).sum::<f64>() / n;
    println!(
        "{name:14} n {n} rms med {:.3} 90% {:.3} max med {:.3} 90% {:.3} worst {:.2} kinds {kinds:?} cover {:.3} area {:.3} eff {:.3} ms {ms:.0} tau {:.2}",
        q(&mut rms, 0.5),
        q(&mut rms, 0.9),
        q(&mut max, 0.5),
        q(&mut max, 0.9),
        q(&mut max, 1.0),
        cover,
        area,
        eff,
        rows.iter().map(|r| r.tau).sum::<f64>() / n
    );
}
