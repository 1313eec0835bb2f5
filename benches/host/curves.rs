//! The curves that are timed.

use crate::support::baseline::Ramp;

/// About a third of the mass in ramps; all of it; none.
pub const CURVES: [(&str, Ramp, Ramp); 3] = [
    (
        "soft",
        [(0.0, 0.0), (0.1, 0.0), (0.15, 1.0), (0.25, 1.0)],
        [(0.75, 1.0), (0.85, 1.0), (0.9, 0.0), (1.0, 0.0)],
    ),
    (
        "all ramp",
        [(0.0, 0.0), (0.18, 0.0), (0.32, 1.0), (0.5, 1.0)],
        [(0.5, 1.0), (0.68, 1.0), (0.82, 0.0), (1.0, 0.0)],
    ),
    ("box", [(0.0, 1.0); 4], [(1.0, 1.0); 4]),
];
