//! INSERT: places a block, or rows and columns of it. (book: reference/dxf)

use std::sync::Arc;

use pathbuild_diagnostic::messages::drawing::INSERT_SCALED;
use pathbuild_diagnostic::{Handle, Point};
use smol_str::SmolStr;

use crate::Point3;
use crate::encoding::Decoder;
use crate::faults::EntityError;
use crate::fields::{BadGroup, Fields};
use crate::placement::Placement;
use crate::shapes::is_mirrored;

#[derive(Clone, Debug)]
pub(crate) struct Insert<'a> {
    /// The block's name as spelt in this INSERT.
    pub(crate) block: SmolStr,
    /// The placement of the copies. A fault in it matters only if the block draws on a wanted layer.
    pub(crate) array: Result<Array, EntityError<'a>>,
    /// The extension dictionary, which may hold a clipping boundary.
    pub(crate) dictionary: Option<Handle>,
}

/// The placement of the copies of a block, computed on demand because most blocks draw on no wanted layer.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Array {
    /// Insertion point in object coordinates.
    at: Point3,
    is_mirrored: bool,
    scaled: Placement,
    /// Rotation in degrees.
    turn: f64,
    columns: Steps,
    rows: Steps,
}

/// Number of copies in one direction and their distance.
#[derive(Clone, Copy, Debug)]
struct Steps {
    count: u32,
    distance: f64,
}

impl<'a> Insert<'a> {
    pub(crate) fn read(fields: &Fields<'a>, decoder: &mut Decoder<'_>) -> Result<Self, EntityError<'a>> {
        let name = fields.get(2).ok_or(BadGroup::Missing { code: 2 })?;
        let block: SmolStr = decoder.decode(name.bytes, name.line).trim().into();
        let array = Array::read(fields, &block);
        Ok(Self { block, array, dictionary: fields.dictionary() })
    }
}

impl Array {
    fn read<'a>(fields: &Fields<'a>, block: &str) -> Result<Self, EntityError<'a>> {
        fields.check_visibility()?;
        let at = fields.point(10)?;
        let is_mirrored = is_mirrored(fields)?;
        let [x, y, z] = [scale(fields, 41)?, scale(fields, 42)?, scale(fields, 43)?];
        let Some(scaled) = Placement::scaled_by(x, y, z) else {
            let at = object_placement(is_mirrored).point(at);
            let point = Some(Point::new(at.x, at.y));
            return Err(EntityError::LeftOut {
                message: &INSERT_SCALED,
                point,
                block: Some(block.into()),
                layers: Arc::default(),
            });
        };
        Ok(Self {
            at,
            is_mirrored,
            scaled,
            turn: fields.number(50)?.unwrap_or(0.0),
            columns: Steps::read(fields, 44, 70)?,
            rows: Steps::read(fields, 45, 71)?,
        })
    }

    /// Returns the insertion point, in the coordinates of the space that contains the INSERT.
    pub(crate) fn insertion_point(&self) -> Point {
        let at = self.first().point(Point3::default());
        Point::new(at.x, at.y)
    }

    /// Returns the placement of the first copy. It maps the block's coordinates, with the base point at the origin, to those of the space that
    /// contains the INSERT.
    fn first(&self) -> Placement {
        let moved = object_placement(self.is_mirrored).composed_after(&Placement::translated(self.at));
        moved.composed_after(&Placement::rotated(self.turn)).composed_after(&self.scaled)
    }

    /// Returns the placements of all copies of a block with this base point.
    pub(crate) fn copies(self, base: Point3) -> impl Iterator<Item = Placement> {
        let first = self.first().composed_after(&Placement::translated(Point3 {
            x: -base.x,
            y: -base.y,
            z: -base.z,
        }));
        // The grid of copies is turned but not scaled.
        let direction = object_placement(self.is_mirrored).composed_after(&Placement::rotated(self.turn));
        let column_step = direction.direction(self.columns.distance, 0.0);
        let row_step = direction.direction(0.0, self.rows.distance);
        let places = (0..self.rows.count)
            .flat_map(move |row| (0..self.columns.count).map(move |column| (row, column)));
        places.map(move |(row, column)| {
            let [row, column] = [f64::from(row), f64::from(column)];
            let x = column_step.0 * column + row_step.0 * row;
            let y = column_step.1 * column + row_step.1 * row;
            Placement::translated(Point3 { x, y, z: 0.0 }).composed_after(&first)
        })
    }
}

impl Steps {
    fn read<'a>(fields: &Fields<'a>, distance: i32, count: i32) -> Result<Self, BadGroup<'a>> {
        Ok(Self { distance: fields.number(distance)?.unwrap_or(0.0), count: self::count(fields, count)? })
    }
}

/// Returns the placement that maps object coordinates to those of the space that contains the INSERT.
fn object_placement(is_mirrored: bool) -> Placement {
    if is_mirrored { Placement::MIRRORED } else { Placement::IDENTITY }
}

/// Reads an optional scale, 1 by default.
fn scale<'a>(fields: &Fields<'a>, code: i32) -> Result<f64, BadGroup<'a>> {
    Ok(fields.number(code)?.unwrap_or(1.0))
}

/// Reads a number of copies; a missing number or one below 1 means a single copy.
fn count<'a>(fields: &Fields<'a>, code: i32) -> Result<u32, BadGroup<'a>> {
    let count = fields.whole_number(code)?.unwrap_or(1).max(1);
    Ok(u32::try_from(count).unwrap_or(u32::MAX))
}
