//! Shutters, as openness over time: the seven on which the fit was tuned; those that do what no model of it does; and
//! twelve mechanics on which nothing was tuned, mostly by equations of motion, for one honest count.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::generator::{Random, Truth};

/// On which the fit was tuned.
pub const TUNED: [&str; 7] =
    ["box", "straight ramps", "leaf", "iris", "liquid crystal", "symmetric cubics", "random cubics"];
/// On which nothing was tuned.
pub const UNSEEN: [&str; 12] = [
    "cranks", "rollers", "rebound", "coil", "falls", "cine", "snaps", "memory", "crystal", "pockels", "phosphor",
    "slips",
];

const STEPS: usize = 80_000;
/// An integration's step; all its steps last for 20.
const DT: f64 = 1.0 / 4000.0;

/// A motion's places, and how many steps go by in a unit of its time.
struct Path(Vec<f64>, f64);

impl Path {
    /// `step` moves the state on by `DT` and gives the place; the place 1 is first reached at the time 1.
    fn new<S>(mut state: S, mut step: impl FnMut(&mut S) -> f64) -> Self {
        let places: Vec<f64> = (0..STEPS).map(|_| step(&mut state)).collect();
        let unit = places.iter().position(|p| *p >= 1.0 - 1e-9).expect("it arrives");
        Self(places, unit as f64 + 1.0)
    }

    /// A mass from rest at 0 until a stop at 1, if any, which throws it back by a share of its speed.
    fn moved(back: Option<f64>, force: impl Fn(f64, f64) -> f64) -> Self {
        Self::new([0.0, 0.0], |[x, speed]| {
            *speed += force(*x, *speed) * DT;
            *x += *speed * DT;
            if let (Some(back), true) = (back, *x > 1.0) {
                (*x, *speed) = (1.0, -back * *speed);
            }
            *x
        })
    }

    /// Before its first step it is at 0.
    fn at(&self, t: f64) -> f64 {
        let x = (t * self.1).clamp(0.0, STEPS as f64 - 1.0);
        let (k, part) = (x as usize, x.fract());
        let before = if k == 0 { 0.0 } else { self.0[k - 1] };
        before + (self.0[k] - before) * part
    }
}

/// The share of a round pupil of radius 1 within a regular polygon whose sides are so far from the centre.
fn polygon(sides: f64, far: f64) -> f64 {
    let far = far.clamp(0.0, 1.0);
    if far <= (PI / sides).cos() {
        sides * far * far * (PI / sides).tan() / PI
    } else {
        1.0 - sides * (far.acos() - far * (1.0 - far * far).sqrt()) / PI
    }
}

/// A ramp from 0 at 0 to 1 at 1: a cubic Bezier with these inner control points.
fn bezier(z: f64, [x1, y1, x2, y2]: [f64; 4]) -> f64 {
    let cubic = |a: f64, b: f64, p: f64| {
        let r = 1.0 - p;
        3.0 * r * r * p * a + 3.0 * r * p * p * b + p * p * p
    };
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..50 {
        let p = 0.5 * (low + high);
        if cubic(x1, x2, p) < z { low = p } else { high = p }
    }
    cubic(y1, y2, low)
}

/// The uncovered part of a circle behind an edge that has gone so far across it.
fn circle(x: f64) -> f64 {
    let x = x.clamp(0.0, 1.0);
    ((1.0 - 2.0 * x).acos() - (1.0 - 2.0 * x) * 2.0 * (x * (1.0 - x)).sqrt()) / PI
}

/// A leaf's ramp from rest to rest.
fn leaf(z: f64) -> f64 {
    let z = z.clamp(0.0, 1.0);
    circle(z * z * (3.0 - 2.0 * z))
}

/// When a shutter does what, where the trace is from 0 to 1, and what is its own, at random.
pub struct Draw {
    pub start: f64,
    pub length: f64,
    pub a: f64,
    pub b: f64,
    pub own: [f64; 8],
}

impl Draw {
    /// The start and the length within these, the ramps by shares of the length.
    pub fn new([start, length, ramps]: [(f64, f64); 3], random: &mut Random) -> Self {
        let mut within = |(from, to)| random.within(from, to);
        let (start, length) = (within(start), within(length));
        let [a, b] = [0; 2].map(|_| within(ramps) * length);
        Self { start, length, a, b, own: [0; 8].map(|_| within((0.0, 1.0))) }
    }

    /// As those were on which the fit was tuned.
    pub fn tuned(random: &mut Random) -> Self {
        Self::new([(0.15, 0.35), (0.3, 0.5), (0.05, 0.45)], random)
    }

    /// A shutter of this name.
    pub fn shutter(&self, name: &str) -> Truth {
        let Self { start, length, a, b, own } = *self;
        let (open, close, end) = (start + a, start + length - b, start + length);
        let times = [start, open, close, end];
        let [u, v, w, z, ..] = own;
        let plain = |t: f64| leaf((t - start) / a).min(leaf((end - t) / b));
        let swing = (0.05 + 0.05 * u) * length;
        // From a motion that opens, and another that closes.
        let both =
            |opens: &Path, closes: &Path, t: f64| opens.at((t - start) / a).min(1.0 - closes.at((t - close) / b));
        match name {
            "box" => Truth::new(|z| z, |z| z, [start, start, end, end]),
            "straight ramps" => Truth::new(|z| z, |z| z, times),
            // The blades start from rest and uncover a round pupil; they come back at their own pace.
            "leaf" => Truth::new(|z| circle(z.powf(1.0 + u)), |z| circle(z.powf(1.0 + v)), times),
            // A round hole whose radius grows, evenly or with a smooth start.
            "iris" => Truth::new(|z| z.powf(2.0 + u), |z| z.powf(2.0 + v), times),
            // Driven open in an exponential, relaxing in a slower one with a tail of ten time constants.
            "liquid crystal" => {
                let (rise, fall) = ((0.02 + 0.04 * u) * length, (0.03 + 0.05 * v) * length);
                let open = start + 10.0 * rise;
                let close = open.max(start + (0.4 + 0.3 * w) * length);
                let end = (1.0f64 - 2e-2).min(close + 10.0 * fall);
                let (tau, tail) = (rise / (open - start), fall / (end - close));
                Truth::new(|z| 1.0 - (-z / tau).exp(), |z| (-(1.0 - z) / tail).exp(), [start, open, close, end])
            }
            "symmetric cubics" => Truth::new(|t| bezier(t, [u, v, w, z]), |t| bezier(t, [u, v, w, z]), times),
            "random cubics" => {
                let [.., c, d, e, f] = own;
                Truth::new(|t| bezier(t, [u, v, w, z]), |t| bezier(t, [c, d, e, f]), times)
            }
            "plain" => Truth::of(plain),
            // Blades hit their stop and come back a little, some times.
            "bounce" | "deep bounce" => {
                let deep = if name == "bounce" { 0.01 + 0.05 * v } else { 0.1 + 0.25 * v };
                let fades = (0.8 + 1.2 * w) * swing;
                Truth::of(|t| {
                    let since = t - open;
                    let back = deep * (-since / fades).exp() * (PI * since / swing).sin().abs();
                    if (0.0..close - open).contains(&since) { 1.0 - back } else { plain(t) }
                })
            }
            "dip" => {
                let at = open + (0.15 + 0.15 * u) * (close - open);
                let (deep, wide) = (0.05 + 0.04 * v, (0.1 + 0.1 * w) * (close - open));
                Truth::of(|t| plain(t) - deep * (-((t - at) / wide).powi(2)).exp() * f64::from(plain(t) >= 1.0))
            }
            // A magnet draws the blade beyond its place, where it rings until it rests.
            "overshoot" => {
                let (high, decay, fall) = (0.05 + 0.15 * v, (0.6 + 0.9 * w) * swing, (0.02 + 0.03 * z) * length);
                Truth::of(|t| {
                    let (since, late) = ((t - start).max(0.0), (t - close).max(0.0));
                    let fades = (-since / decay).exp();
                    let open = 1.0 - fades * ((1.0 - high) * (PI * since / swing).cos() + high);
                    open.max(0.0) * (-late / fall).exp()
                })
            }
            "reopens" => {
                let (high, wide) = (0.02 + 0.1 * u, (0.05 + 0.07 * v) * length);
                let again = |t: f64| (t - end) / wide - 0.3 - 0.5 * w;
                Truth::of(|t| plain(t) + high * (PI * again(t).clamp(0.0, 1.0)).sin())
            }
            // Two curtains before a round sensor, with an acceleration each.
            "slit" => Truth::of(|t| {
                let curtain = |z: f64, power: f64| circle(z.clamp(0.0, 1.0).powf(0.8 + 0.5 * power));
                curtain((t - start) / a, u) - curtain((t - close) / b, v)
            }),
            // Two time constants in the relaxation, as thick cells have it.
            "thick crystal" | "thicker crystal" => {
                let (rise, fall) = ((0.02 + 0.03 * u) * length, (0.04 + 0.04 * v) * length);
                let slow = if name == "thick crystal" { 2.0 } else { 4.0 + 4.0 * w };
                let share = 0.1 + 0.2 * z;
                Truth::of(|t| {
                    let late = (t - close).max(0.0) / fall;
                    let up = 1.0 - (-(t - start).max(0.0) / rise).exp();
                    up * ((1.0 - share) * (-late).exp() + share * (-late / slow).exp())
                })
            }
            // A leaf that hardly moves when it is nearly closed.
            "creeps" => Truth::of(|t| {
                let late = (t - close).max(0.0) / b;
                let down = 0.85 * (1.0 - late).max(0.0).powi(2) + 0.15 * (-late / (0.5 + u)).exp();
                leaf((t - start) / a) * if late > 0.0 { down } else { 1.0 }
            }),
            // The lamp warms up, or the blades sag.
            "sinks" => {
                let by = 0.005 + 0.015 * u;
                Truth::of(|t| plain(t) * (1.0 - by * ((t - open) / (close - open)).clamp(0.0, 1.0)))
            }
            // A dip of a hundredth for a fifth of the time.
            "shallow dip" => {
                let half = 0.1 * length;
                let at = open + half + u * (close - open - 2.0 * half);
                Truth::of(|t| plain(t) - 0.01 * f64::from((t - at).abs() < half))
            }
            // Straight-edged leaves on cranks, which overlap when closed, before a round pupil.
            "cranks" => {
                let ring = |drag: f64| Path::moved(Some(0.0), |x, speed| 1.0 - 0.5 * x - drag * speed);
                let (opens, closes, turn) = (ring(1.5 * u), ring(1.5 * v), PI * (0.45 + 0.45 * w));
                let lift = |x: f64| 1.0 - (x * turn).cos() + 0.15 * (x * turn).sin().powi(2);
                let (hidden, sides) = (0.05 + 0.15 * z, 3.0 + (5.0 * z).floor());
                Truth::of(|t| {
                    let lifted = lift(both(&opens, &closes, t)) / lift(1.0);
                    polygon(sides, (1.1 + hidden) * lifted - hidden)
                })
            }
            // Cloth curtains on rollers, braked at their ends, with a slit that is narrower than the gate.
            "rollers" => {
                let curtain = |brake: f64| {
                    let held = move |x: f64| if x > 0.86 { brake } else { 0.0 };
                    Path::moved(Some(0.0), move |x, speed| 1.0 - 0.4 * x - held(x) * speed)
                };
                let (first, second) = (curtain(3.0 + 6.0 * u), curtain(3.0 + 6.0 * v));
                let (start, travel) = (start.min(0.29) - 0.03, 0.5 * length + 0.08);
                let (late, faster) = (0.55 + 0.2 * z, 0.94 + 0.12 * w);
                let gate = |x: f64| (x - 0.08).max(0.0) / 0.92;
                Truth::of(|t| {
                    let z = (t - start) / travel;
                    (gate(first.at(z)) - gate(second.at((z - late) * faster))).max(0.0)
                })
            }
            // Metal curtains that strike their stops and come back, farther than their overlap hides.
            "rebound" => {
                let curtain = |back: f64| Path::moved(Some(back), |_, speed| 1.0 - 0.6 * speed);
                let (first, second) = (curtain(0.1 + 0.4 * u), curtain(0.3 + 0.3 * v));
                let gate = |x: f64| ((x - 0.02) / 0.96).clamp(0.0, 1.0);
                Truth::of(|t| {
                    let opened = gate(first.at((t - start) / (0.7 * a)));
                    (opened - gate(second.at((t - close) / (0.5 * b)))).max(0.0)
                })
            }
            // A blade on a moving coil, with its inductance and back EMF, and a rubber stop.
            "coil" => {
                let blade = |lag: f64, loss: f64| {
                    Path::new([0.0, 0.0, 0.0], move |[x, speed, current]| {
                        *current += (1.0 - *current - 0.6 * *speed) / lag * DT;
                        let deep = *x - 1.0;
                        let rubber = 250.0 * deep + 2.0 * loss * 250f64.sqrt() * *speed;
                        *speed += (*current - if deep > 0.0 { rubber.max(0.0) } else { 0.0 }) * DT;
                        *x += *speed * DT;
                        *x
                    })
                };
                let (opens, closes) = (blade(0.2 + u, 0.15 + 0.5 * w), blade(0.2 + v, 0.25 + 0.4 * w));
                let (arm, b) = (1.4 + 2.5 * z, 0.6 * b);
                Truth::of(|t| {
                    let x = opens.at((t - start) / a).min(1.0 - closes.at((t - close) / b));
                    let angle = (1.0 / arm).asin() * 1.08 * (2.0 * x.clamp(0.0, 1.0) - 1.0);
                    circle(0.5 + 0.5 * arm * angle.sin())
                })
            }
            // A plate with a slot that falls past a square beam.
            "falls" => {
                let (above, slot) = (0.05 + 1.5 * u, 1.4 + 2.0 * v);
                let (from, to) = (f64::sqrt(above), f64::sqrt(above + slot + 1.0));
                Truth::of(|t| {
                    let fallen = (from + (to - from) * ((t - start) / length).max(0.0)).powi(2) - from.powi(2);
                    fallen.clamp(0.0, 1.0) - (fallen - slot).clamp(0.0, 1.0)
                })
            }
            // The sector of a cine camera's disc before a rectangular gate.
            "cine" => {
                // The gate is 1 high, and begins so far from the axis.
                let (axis, wide, slower) = (0.5 + 1.5 * u, 0.7 + z, 0.12 * (w - 0.5));
                let (half, sector) = ((0.5 / axis).atan(), 1.5 + 3.0 * v);
                let edge = |angle: f64| {
                    let slope = angle.clamp(-half, half).tan();
                    let strip = |k: i32| (axis + wide * (f64::from(k) + 0.5) / 32.0) * slope + 0.5;
                    (0..32).map(|k| strip(k).clamp(0.0, 1.0)).sum::<f64>() / 32.0
                };
                Truth::of(|t| {
                    let z = ((t - start) / length).clamp(0.0, 1.0);
                    let turned = (z + slower * z * (1.0 - z)) * (sector + 1.0) * 2.0 * half - half;
                    (edge(turned) - edge(turned - 2.0 * half * sector)).max(0.0)
                })
            }
            // A microscopic plate that a voltage snaps to its stop, and that rings when let go.
            "snaps" => {
                let (pull, damping, hidden) = (0.36 + 0.4 * u, 0.7 + 0.6 * v, 0.06 + 0.1 * w);
                let spring = |x: f64, speed: f64| -x - damping * speed;
                let electric = |x: f64, speed| pull / (1.3 - x).powi(2) + spring(x, speed);
                let snaps = Path::moved(Some(0.3), electric);
                // Seen from the other end.
                let freed = Path::moved(None, |x, speed| 1.0 - x - damping * speed);
                let (close, unit) = (start + 0.65 * length, 0.08 * length + 0.05 * b);
                Truth::of(|t| {
                    let x = snaps.at((t - start) / a).min(1.0 - freed.at((t - close) / unit));
                    (x.abs() - hidden).max(0.0) / (1.0 - hidden)
                })
            }
            // A wire of shape memory, with its latent heat.
            "memory" => {
                let wire = |goal: f64| {
                    Path::new(0.0, move |x| {
                        *x += (goal - *x) / (1.0 + w * FRAC_PI_2 * (PI * *x).sin()) * DT;
                        *x = f64::min(*x, 1.0);
                        0.5 - 0.5 * (PI * *x).cos()
                    })
                };
                let (heats, cools) = (wire(1.5 + 3.0 * u), wire(1.1 + 0.6 * v));
                Truth::of(|t| both(&heats, &cools, t))
            }
            // A ferroelectric liquid crystal, driven both ways.
            "crystal" => {
                let cell = |first: f64, bias: f64| {
                    Path::new(first, move |angle: &mut f64| {
                        *angle += angle.sin() * (1.0 + bias * angle.cos()) * DT;
                        (FRAC_PI_2 * (0.5 - 0.5 * angle.cos())).sin().powi(2)
                    })
                };
                let (opens, closes) = (cell(0.04 + 0.1 * u, w - 0.5), cell(0.04 + 0.1 * v, z - 0.5));
                Truth::of(|t| both(&opens, &closes, t))
            }
            // A Pockels cell whose crystal rings.
            "pockels" => {
                let (lag, share, damping) = (0.05 + 0.15 * u, 0.2 + 0.3 * v, 0.8 + 1.2 * w);
                let cell = Path::new([0.0, 0.0, 0.0], |[volts, strain, speed]| {
                    *volts += (1.0 - *volts) / lag * DT;
                    *speed += (36.0 * (*volts - *strain) - damping * *speed) * DT;
                    *strain += *speed * DT;
                    (1.0 - share) * *volts + share * *strain
                });
                let unit = (0.008 + 0.012 * z) * length;
                Truth::of(|t| {
                    let turned = cell.at((t - start) / unit) - cell.at((t - close) / unit);
                    (FRAC_PI_2 * turned).sin().powi(2)
                })
            }
            // A gated image intensifier: its gain droops, its phosphor recombines by pairs.
            "phosphor" => {
                let (tau, quench) = ((0.015 + 0.025 * u) * length, 0.3 + 0.7 * v);
                let (droop, off) = (0.02 + 0.1 * w, start + 0.7 * length);
                let (mut n, mut at, step) = (0.0, Vec::with_capacity(STEPS), 1.0 / STEPS as f64);
                for k in 0..STEPS {
                    let since = k as f64 * step - start;
                    let gain = 1.0 - droop * (1.0 - (-since / (0.3 * length)).exp());
                    let lit = if since > 0.0 && since + start < off { gain } else { 0.0 };
                    n += (lit - n * n - quench * n) * step / tau;
                    at.push(n * n);
                }
                let peak = at.iter().copied().fold(0.0, f64::max);
                let glow = Path(at, STEPS as f64);
                Truth::of(|t| (glow.at(t) / peak).min(1.0))
            }
            // An iris whose ring sticks and slips on a soft drive.
            "slips" => {
                let ring = |sticks: f64, inert: f64| {
                    Path::new([0.0, 0.0, 0.0], move |[x, speed, drive]| {
                        *drive = f64::min(*drive + DT, 1.5);
                        let pull = *drive - *x;
                        if *speed > 0.0 || pull > 0.1 + sticks {
                            *speed = f64::max(*speed + (pull - 0.1) / inert.powi(2) * DT, 0.0);
                        }
                        *x = f64::min(*x + *speed * DT, 1.0);
                        *x
                    })
                };
                let (opens, closes) = (ring(0.03 + 0.1 * u, 0.02 + 0.05 * w), ring(0.03 + 0.1 * v, 0.02 + 0.05 * z));
                Truth::of(|t| ((1.2 * both(&opens, &closes, t)).sin() / 1.2f64.sin()).powi(2))
            }
            _ => panic!("no shutter is called {name}"),
        }
    }
}
