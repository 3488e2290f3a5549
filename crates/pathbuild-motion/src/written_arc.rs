//! Arcs as a controller reads them, from rounded numbers. (book: program/gcode)
//!
//! A controller rejects an arc, or mills something unexpected, if its centre is not equidistant from its ends. Start, end and centre are
//! rounded separately,
//! each by up to half a unit of the last digit. Together this may be too much even for a correct arc. Then a centre one digit
//! beside the nearest one fits both ends.

/// An arc in its plane, and the notation of its numbers.
pub struct WrittenArc<'r> {
    /// Start in mm.
    pub from: [f64; 2],
    /// End in mm.
    pub to: [f64; 2],
    /// Centre in mm, absolute or relative to the start depending on `is_absolute`.
    pub centre: [f64; 2],
    /// Converts a length in mm to the number that is written, in the output unit.
    pub length: &'r dyn Fn(f64) -> f64,
    /// Whether the centre is absolute instead of relative to the start.
    pub is_absolute: bool,
    /// Length of the output unit in mm: 1 or 25.4.
    pub unit: f64,
}

impl WrittenArc<'_> {
    /// By how many mm to move the centre so that the written radii at both ends agree: by nothing, or by at most one unit of the third
    /// decimal of a
    /// millimetre (the fourth of an inch) along each axis.
    ///
    /// # Errors
    /// The written radii at both ends, if no centre nearby makes them agree. An arc that is wrong before rounding is never adjusted.
    pub fn fit(&self) -> Result<[f64; 2], [f64; 2]> {
        let nearest = self.radii([0.0; 2]);
        if difference(nearest) <= self.tolerance() {
            return Ok([0.0; 2]);
        }
        if difference(self.exact_radii()) > self.tolerance() * self.unit {
            return Err(nearest);
        }
        let digit = self.tolerance() / 2.0 * self.unit;
        let along = || [-digit, 0.0, digit].into_iter();
        let moved = |by: &[f64; 2]| difference(self.radii(*by));
        let beside = along().flat_map(|x| along().map(move |y| [x, y]));
        let best = beside.min_by(|a, b| moved(a).total_cmp(&moved(b)));
        best.filter(|by| moved(by) <= self.tolerance()).ok_or(nearest)
    }

    /// Permitted difference of the radii in the output unit, as in NIST's RS274/NGC.
    fn tolerance(&self) -> f64 {
        if self.unit == 1.0 { 0.002 } else { 0.000_2 }
    }

    fn exact_radii(&self) -> [f64; 2] {
        let origin = if self.is_absolute { [0.0; 2] } else { self.from };
        [self.from, self.to].map(|point| {
            let [x, y] = [0, 1].map(|axis| point[axis] - origin[axis] - self.centre[axis]);
            libm::hypot(x, y)
        })
    }

    /// The radii at both ends in the output unit, after moving the centre and rounding.
    fn radii(&self, by: [f64; 2]) -> [f64; 2] {
        let centre = [0, 1].map(|axis| {
            let origin = if self.is_absolute { 0.0 } else { (self.length)(self.from[axis]) };
            origin + (self.length)(self.centre[axis] + by[axis])
        });
        [self.from, self.to].map(|point| {
            let [x, y] = [0, 1].map(|axis| (self.length)(point[axis]) - centre[axis]);
            libm::hypot(x, y)
        })
    }
}

fn difference(radii: [f64; 2]) -> f64 {
    (radii[0] - radii[1]).abs()
}
