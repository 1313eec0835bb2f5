//! How figures are written.

/// A figure as one reads it.
pub fn number(x: f64) -> String {
    match x.abs() {
        _ if !x.is_finite() => "∞".into(),
        0.0 => "0".into(),
        ..0.01 | 1e6.. => {
            let text = format!("{x:.1e}");
            let (digits, exponent) = text.split_once('e').expect("an exponent");
            format!("{digits}·10<sup>{exponent}</sup>")
        }
        ..0.1 => format!("{x:.3}"),
        ..10.0 => format!("{x:.2}"),
        ..100.0 => format!("{x:.1}"),
        _ => format!("{x:.0}"),
    }
}
