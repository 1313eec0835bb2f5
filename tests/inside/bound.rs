//! The samples of a certificate, as integers compute them.

use crate::octave::bound::at;
use crate::support::curves::Rng;

/// As in 128 bits, for coefficients of up to 60 bits and places up to either end.
#[test]
fn a_sample_is_by_words_what_it_is_by_more_bits() {
    let mut rng = Rng::new(92, 0);
    for i in 0..100_000 {
        let c: [i64; 7] = core::array::from_fn(|_| rng.bits() as i64 >> (4 + rng.below(60)));
        let place = match i % 4 {
            0 => 1 << 30,
            1 => -(1 << 30),
            _ => rng.bits() as i32 >> 1,
        };
        let wide = c.iter().rev().fold(0, |value: i128, c| ((value * place as i128) >> 30) + *c as i128);
        assert_eq!(i128::from(at(&c, place)), wide, "{c:?} at {place}");
    }
}
