//! How little noise counts as such, how many samples with noise stand for an independent one, and how mean squares are
//! compared.

/// The least standard deviation that counts, as a share of the light: below, rounding and the model's own limits rule.
pub const LEAST: f64 = 1e-5;

/// So many blocks show the noise's slow end.
const BLOCKS: usize = 16;

/// How many samples stand for an independent one: the power of the residuals at frequency 0 over their variance.
///
/// By an autoregressive model (Yule and Walker's equations, solved by Levinson and Durbin, the order by Akaike's
/// criterion): the sum of the residuals' correlations itself comes out too low, because a fit takes the slowest part of
/// the noise away.
pub fn correlation(residuals: &[f64]) -> f64 {
    let n = residuals.len();
    let lagged = |lag: usize| -> f64 { residuals[lag.min(n)..].iter().zip(residuals).map(|(a, b)| a * b).sum() };
    let squares = lagged(0);
    if squares <= 0.0 {
        return 1.0;
    }
    let most = (10.0 * (n as f64).log10()) as usize;
    let rho: Vec<f64> = (0..=most).map(|lag| lagged(lag) / squares).collect();
    let (mut weights, mut left): (Vec<f64>, f64) = (Vec::new(), 1.0);
    let (mut best, mut least) = (1.0, 0.0);
    for order in 1..=most {
        let known: f64 = weights.iter().zip(rho[1..order].iter().rev()).map(|(w, r)| w * r).sum();
        let next = (rho[order] - known) / left;
        let turned: Vec<f64> = weights.iter().rev().map(|w| next * w).collect();
        weights.iter_mut().zip(turned).for_each(|(w, t)| *w -= t);
        weights.push(next);
        left *= 1.0 - next * next;
        if left <= 0.0 {
            break;
        }
        let criterion = n as f64 * left.ln() + 2.0 * order as f64;
        if criterion < least {
            least = criterion;
            best = left / (1.0 - weights.iter().sum::<f64>()).powi(2);
        }
    }
    // Fewer than twenty independent samples would tell nothing of a curve with twelve parameters.
    best.clamp(1.0, (n as f64 / 20.0).max(1.0))
}

/// The same where it counts what such a model does not see, as 1/f noise has it: by means over long blocks.
pub fn slow_correlation(residuals: &[f64]) -> f64 {
    let n = residuals.len();
    let length = (n / BLOCKS).max(1);
    let slow = length as f64 * mean_square(&blocks(residuals, length));
    let most = (n as f64 / 20.0).max(1.0);
    correlation(residuals).max((slow / mean_square(residuals).max(f64::MIN_POSITIVE)).min(most))
}

/// Means of `length` neighbours.
pub fn blocks(values: &[f64], length: usize) -> Vec<f64> {
    values.chunks_exact(length).map(mean).collect()
}

/// The mean; of none 0.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// By how much each is above their mean.
pub fn from_mean(values: &[f64]) -> Vec<f64> {
    let mean = mean(values);
    values.iter().map(|v| v - mean).collect()
}

pub fn mean_square(values: &[f64]) -> f64 {
    values.iter().map(|v| v * v).sum::<f64>() / values.len().max(1) as f64
}

/// Half the mean square of what neighbours differ by.
pub fn fast(values: &[f64]) -> f64 {
    let differ: Vec<f64> = values.windows(2).map(|pair| pair[1] - pair[0]).collect();
    0.5 * mean_square(&differ)
}

/// The ratio of two mean squares that is as unlikely as a normal number: the other way round.
pub fn ratio_of(sigma: f64, (above, below): (f64, f64)) -> f64 {
    let (a, b, s) = (2.0 / (9.0 * above), 2.0 / (9.0 * below), sigma * sigma);
    let (p, q, r) = ((1.0 - b).powi(2) - s * b, (1.0 - a) * (1.0 - b), (1.0 - a).powi(2) - s * a);
    // Of few samples no ratio is that unlikely.
    let root = (q * q - p * r).max(0.0).sqrt();
    if p > 0.0 { ((q + root) / p).powi(3) } else { f64::INFINITY }
}

/// A ratio of two mean squares in standard deviations of a normal number of the same chance (Wilson and Hilferty).
pub fn normal_of(ratio: f64, (above, below): (f64, f64)) -> f64 {
    let (a, b) = (2.0 / (9.0 * above), 2.0 / (9.0 * below));
    let cube = ratio.max(0.0).cbrt();
    ((1.0 - b) * cube - (1.0 - a)) / (a + b * cube * cube).sqrt()
}
