//! Least squares: the parameters of a signal that pass its bins most closely.
//!
//! Levenberg and Marquardt's method with bounds: a parameter that lies on its bound and would leave it stands still for
//! a step; where a step would leave a bound, it ends on it, and the other parameters make up for that. What the misses'
//! own curvature adds is learnt from how the gradient changes, by the symmetric rank-one update.

use crate::bins::Bin;
use crate::curve::Whole;
use crate::signal::Signal;

const STEPS: usize = 150;
/// The sum of squares has stopped falling where a step lowers it by less than this share.
const LITTLE: f64 = 1e-8;

/// What is minimised: squares of what the bins miss, and of what the control numbers miss of a straight ramp's.
#[derive(Clone, Debug)]
pub struct Problem {
    pub bins: Vec<Bin>,
    /// By how much a control number counts that is 1 away.
    pub prior: f64,
    /// What the curve is to keep beside that, where the question is what this would cost.
    pub held: Option<Held>,
}

/// A quantity of the whole curve that is to have a value.
#[derive(Clone, Copy, Debug)]
pub struct Held {
    pub whole: Whole,
    pub target: f64,
    /// By how much a miss of 1 counts.
    pub weight: f64,
}

/// A signal with its sum of squares and the normal equations there.
#[derive(Clone, Debug)]
pub struct Solution {
    pub signal: Signal,
    pub cost: f64,
    /// `JᵀJ`, up to its diagonal: it is symmetric.
    pub normal: Vec<Vec<f64>>,
    /// `Jᵀr`, what lowers the sum pointing against it.
    pub gradient: Vec<f64>,
}

impl Solution {
    /// Adds the square of a miss that moves so with the parameters, from the `first` on.
    fn add(&mut self, weight: f64, miss: f64, moves: &[f64], first: usize) {
        self.cost += weight * miss * miss;
        for (i, row) in self.normal.iter_mut().enumerate().skip(first) {
            let weighted = weight * moves[i];
            if weighted != 0.0 {
                self.gradient[i] += weighted * miss;
                for (cell, m) in row[first..=i].iter_mut().zip(&moves[first..]) {
                    *cell += weighted * m;
                }
            }
        }
    }

    /// The normal matrix of some parameters alone, in their order; above its diagonal it counts for nothing.
    pub fn normal_of(&self, places: &[usize]) -> Vec<Vec<f64>> {
        places.iter().map(|i| places.iter().map(|j| self.normal[*i][*j]).collect()).collect()
    }

    /// The parameters that are on no bound which they would leave.
    pub fn moving(&self) -> Vec<usize> {
        let (packed, bounds) = (self.signal.pack(), self.signal.bounds());
        let outward = |k: usize| {
            let (low, high) = bounds[k];
            packed[k] <= low && self.gradient[k] > 0.0 || packed[k] >= high && self.gradient[k] < 0.0
        };
        (0..packed.len()).filter(|k| !outward(*k)).collect()
    }
}

impl Problem {
    /// The signal as it is.
    pub fn at(&self, signal: &Signal) -> Solution {
        let n = signal.len();
        let (normal, gradient, mut moves) = (vec![vec![0.0; n]; n], vec![0.0; n], vec![0.0; n]);
        let mut solution = Solution { signal: *signal, cost: 0.0, normal, gradient };
        let mut means = signal.means();
        for bin in &self.bins {
            let (mean, first) = means.over(bin.from, bin.to, &mut moves);
            solution.add(bin.samples, mean - bin.mean, &moves, first);
        }
        let packed = signal.pack();
        for (k, straight) in signal.controls() {
            moves.fill(0.0);
            moves[k] = 1.0;
            solution.add(self.prior, packed[k] - straight, &moves, k);
        }
        if let Some(Held { whole, target, weight }) = self.held {
            let (value, each) = whole(&signal.curve);
            moves.fill(0.0);
            signal.kind.gather(&each, &mut moves);
            solution.add(weight, value - target, &moves, 0);
        }
        solution
    }

    /// The best signal near `start`.
    pub fn minimise(&self, start: &Signal) -> Solution {
        let mut here = self.at(start);
        let n = here.gradient.len();
        let straight = vec![vec![0.0; n]; n];
        let (mut bend, mut damping, mut idle) = (straight.clone(), 1e-3, 0);
        for _ in 0..STEPS {
            let to = step(&here, &bend, damping).or_else(|| step(&here, &straight, damping));
            let next = to.map(|to| self.at(&start.unpack(&to)));
            if let Some(next) = &next {
                learn(&mut bend, &here, next);
            }
            match next {
                Some(next) if next.cost < here.cost => {
                    let gain = (here.cost - next.cost) / here.cost;
                    here = next;
                    damping = f64::max(damping * 0.4, 1e-12);
                    idle = if gain < LITTLE { idle + 1 } else { 0 };
                }
                _ => {
                    damping *= 8.0;
                    idle += usize::from(damping > 1e4);
                }
            }
            if idle > 1 {
                break;
            }
        }
        here
    }
}

/// The parameters a damped step on.
fn step(here: &Solution, bend: &[Vec<f64>], damping: f64) -> Option<Vec<f64>> {
    let (from, bounds) = (here.signal.pack(), here.signal.bounds());
    let cell = |i: usize, j: usize| {
        let stiff = if i == j { damping * here.normal[i][i] + 1e-12 } else { 0.0 };
        here.normal[i.max(j)][i.min(j)] + bend[i][j] + stiff
    };
    let (mut to, mut free) = (from.clone(), here.moving());
    loop {
        let matrix = free.iter().map(|i| free.iter().map(|j| cell(*i, *j)).collect()).collect();
        let moved = |i: usize| (0..from.len()).map(|j| cell(i, j) * (to[j] - from[j])).sum::<f64>();
        let right: Vec<f64> = free.iter().map(|i| -here.gradient[*i] - moved(*i)).collect();
        let by = Cholesky::new(matrix)?.solve(&right);
        let mut inside = Vec::new();
        for (k, by) in free.iter().zip(by) {
            let (k, (low, high)) = (*k, bounds[*k]);
            to[k] = (from[k] + by).clamp(low, high);
            if to[k] == from[k] + by {
                inside.push(k);
            }
        }
        if inside.is_empty() || inside.len() == free.len() {
            return Some(to);
        }
        inside.iter().for_each(|k| to[*k] = from[*k]);
        free = inside;
    }
}

/// Corrects the curvature that is not in the normal equations by a step.
fn learn(bend: &mut [Vec<f64>], here: &Solution, next: &Solution) {
    let by: Vec<f64> = next.signal.pack().iter().zip(here.signal.pack()).map(|(to, from)| to - from).collect();
    let told = |i: usize| {
        let row = bend[i].iter().enumerate();
        let along = row.map(|(j, bend)| (next.normal[i.max(j)][i.min(j)] + bend) * by[j]).sum::<f64>();
        next.gradient[i] - here.gradient[i] - along
    };
    let rest: Vec<f64> = (0..by.len()).map(told).collect();
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let along = product(&rest, &by);
    if along.abs() > 1e-8 * (product(&rest, &rest) * product(&by, &by)).sqrt() {
        for (row, a) in bend.iter_mut().zip(&rest) {
            row.iter_mut().zip(&rest).for_each(|(cell, b)| *cell += a * b / along);
        }
    }
}

/// The normal equations of rows: a weight, what the row's numbers are multiplied by, and what that is to be.
pub fn normal_equations<const N: usize>(rows: impl Iterator<Item = (f64, [f64; N], f64)>) -> (Vec<Vec<f64>>, [f64; N]) {
    let (mut normal, mut right) = (vec![vec![0.0; N]; N], [0.0; N]);
    for (weight, row, value) in rows {
        for (i, x) in row.iter().enumerate() {
            right[i] += weight * x * value;
            normal[i].iter_mut().zip(row).for_each(|(sum, y)| *sum += weight * x * y);
        }
    }
    (normal, right)
}

/// `A = L Lᵀ` of a symmetric, positive matrix, which is read up to its diagonal.
pub struct Cholesky {
    lower: Vec<Vec<f64>>,
}

impl Cholesky {
    /// None where the matrix is not positive.
    pub fn new(mut a: Vec<Vec<f64>>) -> Option<Self> {
        for j in 0..a.len() {
            for i in j..a.len() {
                let sum: f64 = (0..j).map(|k| a[i][k] * a[j][k]).sum();
                let rest = a[i][j] - sum;
                if i > j {
                    a[i][j] = rest / a[j][j];
                } else if rest > 0.0 && rest.is_finite() {
                    a[j][j] = rest.sqrt();
                } else {
                    return None;
                }
            }
        }
        Some(Self { lower: a })
    }

    /// The same where the samples do not tell the parameters apart: their diagonal is raised until they are, so that
    /// each has a variance, however large.
    pub fn stiffened(a: &[Vec<f64>]) -> Self {
        let largest = a.iter().enumerate().map(|(k, row)| row[k]).fold(f64::MIN_POSITIVE, f64::max);
        let raised = |by: f64| {
            let mut a = a.to_vec();
            for (k, row) in a.iter_mut().enumerate() {
                row[k] = row[k] * (1.0 + by) + 1e-6 * by * largest;
            }
            Self::new(a)
        };
        let found = (0..6).find_map(|k| raised(1e-10 * 100f64.powi(k)));
        // A diagonal alone has a root: that of the numbers that are none is left out.
        found.unwrap_or_else(|| {
            let mut lower = vec![vec![0.0; a.len()]; a.len()];
            lower.iter_mut().enumerate().for_each(|(k, row)| row[k] = largest.sqrt());
            Self { lower }
        })
    }

    /// The `x` of `A x = right`.
    pub fn solve(&self, right: &[f64]) -> Vec<f64> {
        let (l, n) = (&self.lower, right.len());
        let mut x = right.to_vec();
        for i in 0..n {
            let sum: f64 = (0..i).map(|k| l[i][k] * x[k]).sum();
            x[i] = (x[i] - sum) / l[i][i];
        }
        for i in (0..n).rev() {
            let sum: f64 = (i + 1..n).map(|k| l[k][i] * x[k]).sum();
            x[i] = (x[i] - sum) / l[i][i];
        }
        x
    }
}
