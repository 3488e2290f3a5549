//! INSERT: a block, or rows and columns of it, at another place. (reference/dxf.md section 4, point 9)

use pathbuild_diagnostic::Point;
use pathbuild_diagnostic::messages::reading::INSERT_SCALED;

use super::is_mirrored;
use crate::Point3;
use crate::encoding::Decoder;
use crate::fields::{BadGroup, Fields};
use crate::placement::Placement;
use crate::trouble::Trouble;

/// An insertion.
#[derive(Clone, Debug)]
pub(crate) struct Insert<'a> {
    /// The block's name as it is spelt here.
    pub(crate) block: Box<str>,
    /// Where; whatever is wrong with that is only of interest if the block holds something that is wanted.
    pub(crate) array: Result<Array, Trouble<'a>>,
}

/// Where the copies of a block go.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Array {
    /// From the block's coordinates, with its base point at the origin, to those of the space, for the first copy.
    first: Placement,
    /// From the first copy to the next in x and in y.
    columns: Steps,
    rows: Steps,
}

#[derive(Clone, Copy, Debug)]
struct Steps {
    count: u32,
    x: f64,
    y: f64,
}

impl<'a> Insert<'a> {
    /// Reads one.
    pub(crate) fn read(fields: &Fields<'a>, decoder: &mut Decoder<'_>) -> Result<Self, Trouble<'a>> {
        let name = fields.get(2).ok_or(BadGroup::Missing { code: 2 })?;
        let block: Box<str> = decoder.decode(name.bytes, name.line).trim().into();
        let array = Array::read(fields, &block);
        Ok(Self { block, array })
    }
}

impl Array {
    fn read<'a>(fields: &Fields<'a>, block: &str) -> Result<Self, Trouble<'a>> {
        let at = fields.point(10)?;
        let object = if is_mirrored(fields)? { Placement::MIRRORED } else { Placement::IDENTITY };
        let [x, y, z] = [scale(fields, 41)?, scale(fields, 42)?, scale(fields, 43)?];
        let Some(scaled) = Placement::scaled_by(x, y, z) else {
            let at = object.point(at);
            let point = Some(Point::new(at.x, at.y));
            return Err(Trouble::LeftOut { message: &INSERT_SCALED, point, block: Some(block.into()) });
        };
        let turned = Placement::turned(fields.number(50)?.unwrap_or(0.0));
        // Copies are set off along the turned axes, but not scaled.
        let direction = object.after(&turned);
        let step = |x: f64, y: f64, count: u32| {
            let (x, y) = direction.direction(x, y);
            Steps { count, x, y }
        };
        Ok(Self {
            first: object.after(&Placement::moved(at)).after(&turned).after(&scaled),
            columns: step(fields.number(44)?.unwrap_or(0.0), 0.0, count(fields, 70)?),
            rows: step(0.0, fields.number(45)?.unwrap_or(0.0), count(fields, 71)?),
        })
    }

    /// The point of insertion.
    pub(crate) fn begin(&self) -> Point {
        let at = self.first.point(Point3::default());
        Point::new(at.x, at.y)
    }

    /// The placement of each copy, for a block with this base point.
    pub(crate) fn copies(self, base: Point3) -> impl Iterator<Item = Placement> {
        let first = self.first.after(&Placement::moved(Point3 { x: -base.x, y: -base.y, z: -base.z }));
        let places = (0..self.rows.count)
            .flat_map(move |row| (0..self.columns.count).map(move |column| (row, column)));
        places.map(move |(row, column)| {
            let [row, column] = [f64::from(row), f64::from(column)];
            let x = self.columns.x * column + self.rows.x * row;
            let y = self.columns.y * column + self.rows.y * row;
            Placement::moved(Point3 { x, y, z: 0.0 }).after(&first)
        })
    }
}

/// A scale, 1 when it is missing.
fn scale<'a>(fields: &Fields<'a>, code: i32) -> Result<f64, BadGroup<'a>> {
    Ok(fields.number(code)?.unwrap_or(1.0))
}

/// A number of copies: one when it is missing or 0.
fn count<'a>(fields: &Fields<'a>, code: i32) -> Result<u32, BadGroup<'a>> {
    let count = fields.whole(code)?.unwrap_or(1).max(1);
    Ok(u32::try_from(count).unwrap_or(u32::MAX))
}
