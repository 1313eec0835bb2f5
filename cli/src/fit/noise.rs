//! How little noise counts as such, and how many samples with noise stand for an independent one.

/// The least standard deviation that counts, as a share of the light: below, rounding and the model's own limits rule.
pub const LEAST: f64 = 1e-5;

/// How many samples stand for an independent one: the power of the residuals at frequency 0 over their variance.
///
/// By an autoregressive model (Yule and Walker's equations, solved by Levinson and Durbin, the order by Akaike's criterion):
/// the sum of the residuals' correlations itself comes out too low, because a fit takes the slowest part of the noise away.
pub fn correlation(residuals: &[f64]) -> f64 {
    let n = residuals.len();
    let lagged = |lag: usize| -> f64 {
        residuals[lag.min(n)..].iter().zip(residuals).map(|(a, b)| a * b).sum()
    };
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
