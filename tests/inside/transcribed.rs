//! The scripts in `proofs/` prove what they say of transcriptions. These are the Rust functions' answers, on words that the
//! scripts chose, held to the transcriptions' (`proofs/vectors`).

use crate::fraction::{Fraction, Side};
use crate::number::moment::{Moment, rounded_sum};
use crate::number::pair::Pair;
use crate::number::series::Series;
use crate::search::guess::divided;
use crate::search::{ROUNDING, Taylor, left};
use crate::trigger::ticks::TickScale;

/// The rows of a file: hexadecimal words.
fn rows<const N: usize>(csv: &str) -> impl Iterator<Item = [u64; N]> {
    csv.lines().map(|line| {
        let mut words = line.split(',').map(|word| u64::from_str_radix(word, 16).unwrap());
        let row = core::array::from_fn(|_| words.next().unwrap());
        assert!(words.next().is_none());
        row
    })
}

/// The same, of which all are `f32` by their bits.
fn numbers<const N: usize>(csv: &str) -> impl Iterator<Item = [f32; N]> {
    rows::<N>(csv).map(|row| row.map(|word| f32::from_bits(word as u32)))
}

/// `proofs/pairs.py`
#[test]
fn pairs() {
    let pair = |hi, lo| Pair { hi, lo };
    for row in numbers(include_str!("../../proofs/vectors/pairs.csv")) {
        let [a, al, b, bl, s, sl, m, ml, t, tl, q, ql, difference] = row;
        let (a, b) = (pair(a, al), pair(b, bl));
        assert_eq!(a.plus(b), pair(s, sl));
        assert_eq!(a.minus_loose(b), pair(m, ml));
        assert_eq!(a.times(b), pair(t, tl));
        assert_eq!(a.over(b), pair(q, ql));
        assert_eq!(a.difference(b), difference);
    }
}

/// `proofs/series.py`
#[test]
fn series() {
    for row in numbers::<18>(include_str!("../../proofs/vectors/series.csv")) {
        let c: [Pair; 6] = core::array::from_fn(|k| Pair { hi: row[2 * k], lo: row[2 * k + 1] });
        let [.., x, rest, hi, lo, slope, with_rest] = row;
        let series = Series { c: &c[..5], last: c[5] };
        assert_eq!(series.at(x), Pair { hi, lo });
        assert_eq!(series.slope(x), slope);
        assert_eq!(series.at_pair(Pair { hi: x, lo: rest }), Pair { hi, lo: with_rest });
    }
}

/// `proofs/guess.py`
#[test]
fn quotients() {
    for [x, k, quotient] in rows(include_str!("../../proofs/vectors/guess.csv")) {
        assert_eq!(divided(x as i32, k as i32), quotient as i32);
    }
}

/// `proofs/solve.py`: the slopes, and the bound of what a step leaves.
#[test]
fn bounds() {
    for row in numbers(include_str!("../../proofs/vectors/left.csv")) {
        let [c1, c2, c3, c4, c5, c6, x, moved, missing, s, d1, d2, bound] = row;
        let c = [c1, c2, c3, c4, c5, c6];
        let local = Taylor::new(&c, x);
        assert_eq!([local.d1, local.d2], [d1, d2]);
        assert_eq!(left(&c, &local, moved, missing, s, ROUNDING), bound);
    }
}

/// `proofs/rounding.py`: the exact sums, rounded once; those expected are computed with fractions. The last one is the
/// exception.
#[test]
fn sums() {
    for [base, hi, lo, unit, back, sum] in rows(include_str!("../../proofs/vectors/rounded.csv")) {
        let [base, hi, lo, sum] = [base, hi, lo, sum].map(|word| f32::from_bits(word as u32));
        let found = rounded_sum(base, Pair { hi, lo }, unit as i32, back == 1);
        assert_eq!(found, sum, "{base:e} {hi:e} {lo:e} {unit} {back}");
    }
}

/// `proofs/ticks.py`: the fractions of triggers and pulses' ends.
#[test]
fn fractions() {
    for [odd, more, n, side, a] in rows(include_str!("../../proofs/vectors/fractions.csv")) {
        let [more, a] = [more, a].map(|word| f32::from_bits(word as u32));
        let found = Fraction::new(odd as u32, more, n as u32);
        assert_eq!(found, Fraction { side: Side::end_if(side == 1), a }, "{odd} {more} {n}");
    }
}

/// `proofs/ticks.py`: times in whole units.
#[test]
fn units() {
    for [base, until, hi, lo, own, unit, time] in
        rows(include_str!("../../proofs/vectors/units.csv"))
    {
        let [base, until, hi, lo] = [base, until, hi, lo].map(|word| f32::from_bits(word as u32));
        let (way, back) = (Pair { hi, lo }, until < base);
        let moment = Moment { base, back, way, unit: own as i32, until, evaluations: 0 };
        assert_eq!(moment.in_units(unit as i32), time as i64, "{base:e} {until:e} {hi:e} {lo:e}");
    }
}

/// `proofs/ticks.py`
#[test]
fn ticks() {
    for [start, length, hz, unit, time, tick] in
        rows(include_str!("../../proofs/vectors/ticks.csv"))
    {
        let scale = TickScale::new(start as i64, length, hz as u32, unit as i32);
        assert_eq!(scale.tick(time as i64), tick as u32);
    }
}
