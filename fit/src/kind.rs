//! A frame fitted by one kind of curve: what is left of the samples, and whether a freer kind is worth its parameters.

use crate::bins::Bin;
use crate::noise;
use crate::solve::Solution;

/// A kind's best signal.
#[derive(Clone, Debug)]
pub struct KindFit {
    pub solution: Solution,
    /// What each sample is missed by.
    pub residuals: Vec<f64>,
    /// The sum of their squares.
    pub squares: f64,
}

impl KindFit {
    pub fn new(solution: Solution, samples: &[Bin]) -> Self {
        let residuals = solution.signal.missed(samples);
        let squares = residuals.iter().map(|r| r * r).sum();
        Self { solution, residuals, squares }
    }

    /// The mean of the residuals' squares.
    pub fn variance(&self) -> f64 {
        self.squares / self.residuals.len() as f64
    }

    /// Schwarz's criterion, where so many samples stand for an independent one.
    pub fn bic(&self, correlation: f64) -> f64 {
        let effective = self.residuals.len() as f64 / correlation;
        let variance = self.variance().max(noise::LEAST * noise::LEAST);
        effective * variance.ln() + self.solution.signal.len() as f64 * effective.ln()
    }
}
