//! The methods under comparison, each behind the same trait.

use std::hint::black_box;

use shutter_curve::ShutterCurve;

use crate::support::baseline::{InverseTable, TextbookNewton};
use crate::support::cases::shutter;
use crate::support::oracle::Curve;
use crate::support::peers::{MonotoneCubicTable, Parts, bracketed, doubles};

pub trait Inverse {
    fn inverse_cdf(&self, u: f32) -> f32;

    /// How often a polynomial of the mass was evaluated for it.
    fn evaluations(&self, _u: f32) -> u32 {
        0
    }

    /// One call after the other, each result kept from being optimised away.
    fn singles(&self, u: &[f32]) {
        for &u in u {
            black_box(self.inverse_cdf(black_box(u)));
        }
    }

    fn slice(&self, u: &[f32], t: &mut [f32]) {
        for (u, t) in u.iter().zip(t) {
            *t = self.inverse_cdf(*u);
        }
    }
}

impl<const CELLS: usize> Inverse for ShutterCurve<CELLS> {
    fn inverse_cdf(&self, u: f32) -> f32 {
        self.inverse_cdf(u)
    }
    fn evaluations(&self, u: f32) -> u32 {
        self.evaluations(u)
    }
    fn slice(&self, u: &[f32], t: &mut [f32]) {
        self.inverse_cdf_slice(u, t);
    }
}

impl Inverse for TextbookNewton {
    fn inverse_cdf(&self, u: f32) -> f32 {
        self.inverse_cdf(u)
    }
    fn evaluations(&self, u: f32) -> u32 {
        self.solve(u).1
    }
}

struct Bracketed(Parts<f32>);

impl Inverse for Bracketed {
    fn inverse_cdf(&self, u: f32) -> f32 {
        self.0.inverse_cdf(u, bracketed).0
    }
    fn evaluations(&self, u: f32) -> u32 {
        self.0.inverse_cdf(u, bracketed).1
    }
}

struct Doubles(Parts<f64>);

impl Inverse for Doubles {
    fn inverse_cdf(&self, u: f32) -> f32 {
        self.0.inverse_cdf(u, doubles).0
    }
    fn evaluations(&self, u: f32) -> u32 {
        self.0.inverse_cdf(u, doubles).1
    }
}

impl<const N: usize> Inverse for InverseTable<N> {
    fn inverse_cdf(&self, u: f32) -> f32 {
        self.inverse_cdf(u)
    }
}

impl<const N: usize> Inverse for MonotoneCubicTable<N> {
    fn inverse_cdf(&self, u: f32) -> f32 {
        self.inverse_cdf(u)
    }
}

pub struct Method {
    pub name: &'static str,
    /// A baseline's name in `docs/cost.md`, the table of cycles, or this crate's number of cells.
    pub cost: &'static str,
    pub is_ours: bool,
    pub bytes: usize,
    pub build: fn(&Curve) -> Box<dyn Inverse>,
}

const fn baseline<T: Inverse>(
    name: &'static str,
    cost: &'static str,
    build: fn(&Curve) -> Box<dyn Inverse>,
) -> Method {
    Method { name, cost, is_ours: false, bytes: size_of::<T>(), build }
}

const fn ours<const CELLS: usize>(name: &'static str, cost: &'static str) -> Method {
    let bytes = size_of::<ShutterCurve<CELLS>>();
    Method { name, cost, is_ours: true, bytes, build: |c| Box::new(shutter::<CELLS>(c)) }
}

/// The place of the textbook Newton, against which times are taken.
pub const TEXTBOOK: usize = 4;
/// The places of the crate's default and of the usual table.
pub const DEFAULT: usize = 2;
pub const TABLE: usize = 6;

/// Tables are made from exact entries, so that only their own error is seen.
pub const METHODS: [Method; 10] = [
    ours::<0>("`CELLS = 0`", "0"),
    ours::<4>("`CELLS = 4`", "4"),
    ours::<8>("`CELLS = 8`", "8"),
    ours::<16>("`CELLS = 16`", "16"),
    baseline::<TextbookNewton>("textbook Newton", "textbook Newton", |c| {
        Box::new(TextbookNewton::new(c.opening, c.closing))
    }),
    baseline::<Bracketed>("bracketed Newton", "", |c| {
        Box::new(Bracketed(Parts::new(c.opening, c.closing)))
    }),
    baseline::<InverseTable<256>>("table of 256", "table", |c| {
        let exact = shutter::<16>(c);
        Box::new(InverseTable::<256>::new(|u| exact.inverse_cdf(u)))
    }),
    baseline::<InverseTable<1024>>("table of 1024", "", |c| {
        let exact = shutter::<16>(c);
        Box::new(InverseTable::<1024>::new(|u| exact.inverse_cdf(u)))
    }),
    baseline::<MonotoneCubicTable<64>>("cubic table of 64", "", |c| {
        let exact = shutter::<16>(c);
        Box::new(MonotoneCubicTable::<64>::new(|u| exact.inverse_cdf(u)))
    }),
    baseline::<Doubles>("Newton in f64", "", |c| {
        Box::new(Doubles(Parts::new(c.opening, c.closing)))
    }),
];
