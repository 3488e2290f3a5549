//! Directions of angles in degrees.

/// Cosine and sine of an angle in degrees. Right angles, which most drawings consist of, are exact.
pub(crate) fn cos_sin(degrees: f64) -> (f64, f64) {
    let turned = libm::fmod(degrees, 360.0);
    let turned = if turned < 0.0 { turned + 360.0 } else { turned };
    match turned {
        0.0 | 360.0 => (1.0, 0.0),
        90.0 => (0.0, 1.0),
        180.0 => (-1.0, 0.0),
        270.0 => (0.0, -1.0),
        _ => {
            let (sin, cos) = libm::sincos(turned.to_radians());
            (cos, sin)
        }
    }
}

/// The angle in degrees of a vector of non-zero length.
pub(crate) fn of(x: f64, y: f64) -> f64 {
    libm::atan2(y, x).to_degrees()
}
