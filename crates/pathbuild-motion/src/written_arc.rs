//! Arcs as a controller reads them: from rounded numbers. (book: program/gcode)
//!
//! A controller refuses an arc, or runs a wild one, whose centre is not as far from its end as from its start. Start, end and centre are
//! rounded each on its own, which moves them by up to half a unit of the last digit each; together this may be too much, though the arc
//! itself is right. A centre one digit beside the nearest one then fits both ends.

/// An arc in its plane, and how its numbers are written.
pub struct WrittenArc<'r> {
    /// Where it begins, in mm.
    pub from: [f64; 2],
    /// Where it ends, in mm.
    pub to: [f64; 2],
    /// Its centre in mm, as a place or relative to where the arc begins, as `is_absolute` says.
    pub centre: [f64; 2],
    /// A length in mm as the number that is written, in the unit that is written.
    pub length: &'r dyn Fn(f64) -> f64,
    /// The centre is written as a place, not relative to where the arc begins.
    pub is_absolute: bool,
    /// mm in the unit that is written: 1 or 25.4.
    pub unit: f64,
}

impl WrittenArc<'_> {
    /// By how many mm the centre is to be moved so that the written radii at start and end agree: by nothing, or by at most one unit of
    /// the third decimal of a millimetre (the fourth of an inch) along each axis.
    ///
    /// # Errors
    /// The written radii at start and end, where no centre nearby makes them agree. An arc that is wrong before its numbers are rounded
    /// is never made to fit.
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

    /// By how much the radii may differ in the unit that is written, as NIST's RS274/NGC has it.
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

    /// The radii at start and end of what is written with the centre moved, in the unit that is written.
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
