//! A fast, tolerant DXF reader that never fails.
//!
//! [`read`] turns the bytes of a drawing into the few kinds of entities that the drawing language knows, in file order and world
//! coordinates, with resolved line types and decoded texts, together with everything that was wrong. It does no IO. Line numbers and
//! handles are kept beside the entities, so that edits which only shift them do not disturb later stages. (book: reference/dxf)

mod binary;
mod block_prefilter;
mod blocks;
mod clips;
mod collect;
mod drawing;
mod encoding;
mod entities;
mod faults;
mod fields;
mod file;
mod groups;
mod header;
mod layers;
mod model;
mod names;
mod number;
mod pairs;
mod placement;
mod shapes;

pub use drawing::{
    Arc, Circle, Drawing, Entity, Fault, Geometry, HorizontalAlign, Label, Layer, LayoutObstacle, Line,
    MText, OmittedCurve, Options, Origin, Point3, Text, TextTest, Units, VerticalAlign,
};

/// Reads a drawing.
pub fn read(bytes: &[u8], options: &Options<'_>) -> Drawing {
    let mut drawing = Drawing::default();
    read_into(&mut drawing, bytes, options);
    drawing
}

/// Reads into an existing drawing and reuses its memory.
pub fn read_into(drawing: &mut Drawing, bytes: &[u8], options: &Options<'_>) {
    drawing.clear();
    if let Err(diagnostic) = file::read_file(drawing, bytes, options) {
        drawing.clear();
        drawing.diagnostics.push(*diagnostic);
    }
}
