//! The upper word of a product by halves, held to the product.

use crate::octave::times_high_by_halves;

#[test]
fn the_upper_word_of_a_product_by_halves() {
    let near = |word: i32| (-3..=3).map(move |more| word.wrapping_add(more));
    let edges = (0..32).map(|k| 1i32 << k).chain([0, -1, 0xFFFF, -0xFFFF, 0x7FFF_8000]);
    let scattered = (0..2000).map(|k: i32| k.wrapping_mul(0x9E37_79B9u32 as i32));
    let words: Vec<i32> = edges.flat_map(near).chain(scattered).collect();
    for &a in &words {
        for &x in &words {
            let exact = ((a as i64 * x as i64) >> 32) as i32;
            assert_eq!(times_high_by_halves(a, x), exact, "{a} * {x}");
        }
    }
}
