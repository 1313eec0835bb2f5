//! Motion blur as a renderer samples it: a bright edge moves across a picture while a soft shutter is open. Each pixel
//! takes its samples at `inverse_cdf` of stratified fractions, and they all count the same.
//!
//! `cargo run --example motion_blur >blur.svg` draws that beside the exact integral, and beside samples at equally
//! spaced times, which give another shutter's blur.

use shutter_curve::{CubicBezier, ShutterCurve, expect};

static SHUTTER: ShutterCurve = expect!(ShutterCurve::new(
    CubicBezier::new([(0.0, 0.0), (0.2, 0.0), (0.3, 1.0), (0.5, 1.0)]),
    CubicBezier::new([(0.5, 1.0), (0.7, 1.0), (0.8, 0.0), (1.0, 0.0)]),
));
const PIXELS: usize = 320;
const SAMPLES: u32 = 64;

/// When the edge reaches a pixel: it crosses the picture while the shutter is open.
fn arrival(pixel: usize) -> f32 {
    (pixel as f32 + 0.5) / PIXELS as f32
}

/// A pixel's light after all of the exposure: what is collected once the edge has come.
fn exact(pixel: usize) -> f32 {
    1.0 - SHUTTER.cdf(arrival(pixel))
}

/// The same by samples at these times, one in each of `n` equal strata.
fn sampled(pixel: usize, n: u32, time: impl Fn(f32) -> f32) -> f32 {
    // Another place in the strata for each pixel: the golden ratio's multiples.
    let place = (pixel as f32 * 0.618_034).fract();
    let times = (0..n).map(|i| time((i as f32 + place) / n as f32));
    times.filter(|t| *t >= arrival(pixel)).count() as f32 / n as f32
}

/// A row of pixels, and its name.
fn draw(row: usize, name: &str, light: impl Fn(usize) -> f32) {
    let top = 70 * row;
    println!("<text x=\"10\" y=\"{}\">{name}</text>", top + 20);
    for pixel in 0..PIXELS {
        // As screens have it.
        let grey = (255.0 * light(pixel).powf(1.0 / 2.2)) as u8;
        let (x, y) = (10 + 2 * pixel, top + 28);
        println!("<rect x=\"{x}\" y=\"{y}\" width=\"2\" height=\"36\" fill=\"rgb({grey},{grey},{grey})\"/>");
    }
}

fn main() {
    eprintln!("samples  largest error at inverse_cdf  at equally spaced times");
    for n in [4, 16, 64, 256] {
        let worst =
            |time: fn(f32) -> f32| (0..PIXELS).map(|p| (sampled(p, n, time) - exact(p)).abs()).fold(0.0, f32::max);
        eprintln!("{n:7} {:29.4} {:24.4}", worst(|u| SHUTTER.inverse_cdf(u)), worst(|u| u));
    }
    println!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"660\" height=\"220\" font-family=\"sans-serif\" \
         font-size=\"14\" shape-rendering=\"crispEdges\">\n<rect width=\"660\" height=\"220\" fill=\"white\"/>"
    );
    draw(0, "exact", exact);
    let name = format!("{SAMPLES} samples a pixel, at inverse_cdf");
    draw(1, &name, |pixel| sampled(pixel, SAMPLES, |u| SHUTTER.inverse_cdf(u)));
    let name = format!("{SAMPLES} samples a pixel, at equally spaced times");
    draw(2, &name, |pixel| sampled(pixel, SAMPLES, |u| u));
    println!("</svg>");
}
