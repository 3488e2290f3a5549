use super::cursor::{Cursor, Parsed};
use super::shapes::one;
use super::statement::ParsedEntities;
use pathbuild_draw::model::{Ellipse, Point, Shape, Spline};

/// `centre P major X,Y ratio R [from A to B]`
pub(crate) fn ellipse(cursor: &mut Cursor) -> Parsed<ParsedEntities> {
    cursor.keyword("centre")?;
    let centre = cursor.point("the centre")?;
    cursor.keyword("major")?;
    cursor.base = Some(Point::default());
    let major = cursor.point("the longer half axis as a vector")?;
    cursor.keyword("ratio")?;
    let ratio = cursor.length("the ratio of the axes")?;
    let (start, end) = if cursor.take("from") {
        let start = cursor.number("an angle in degrees")?;
        cursor.keyword("to")?;
        (start, cursor.number("an angle in degrees")?)
    } else {
        (0.0, 360.0)
    };
    Ok(one(Shape::Ellipse(Ellipse { centre, major, ratio, start, end }), Some(centre)))
}

/// `[degree N] control P ... [knots K ...] [weights W ...] [closed]` or `fit P ...`
pub(crate) fn spline(cursor: &mut Cursor) -> Parsed<ParsedEntities> {
    let degree = if cursor.take("degree") { cursor.integer("degree")? } else { 3 };
    let mut spline = Spline {
        degree,
        control: Vec::new(),
        knots: Vec::new(),
        weights: Vec::new(),
        fit: Vec::new(),
        closed: false,
    };
    if cursor.take("fit") {
        spline.fit = cursor.points("a point on the curve")?;
    } else {
        cursor.keyword("control")?;
        spline.control = cursor.points("a control point")?;
        let least = usize::from(degree) + 1;
        if spline.control.len() < least {
            return Err(
                cursor.error(format!("a spline of degree {degree} needs at least {least} control points"))
            );
        }
        spline.knots = clamped_knots(spline.control.len(), usize::from(degree));
    }
    if cursor.take("knots") {
        spline.knots = numbers(cursor, "a knot")?;
    }
    if cursor.take("weights") {
        spline.weights = numbers(cursor, "a weight")?;
    }
    spline.closed = cursor.take("closed");
    let end = spline.control.last().or(spline.fit.last()).copied();
    Ok(one(Shape::Spline(spline), end))
}

fn numbers(cursor: &mut Cursor, what: &str) -> Parsed<Vec<f64>> {
    let mut numbers = Vec::new();
    while cursor.is_at_number() {
        numbers.push(cursor.number(what)?);
    }
    Ok(numbers)
}

/// Knots of a curve that begins and ends at its outer control points.
fn clamped_knots(control: usize, degree: usize) -> Vec<f64> {
    let spans = control - degree;
    (0..=control + degree).map(|index| index.saturating_sub(degree).min(spans) as f64).collect()
}
