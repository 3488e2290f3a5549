//! The data model of drawings.

mod entity;
mod layer;
mod options;
mod point;
mod shape;
mod text;

pub use entity::{Change, Entity, Note, NoteKind, Orientation};
pub use layer::{Layer, LayerState};
pub use options::{LineEnds, Options, Part, TextEncoding, Version};
pub use point::Point;
pub(crate) use point::sin_cos;
pub use shape::{
    Arc, Circle, Dimension, Ellipse, Insert, Line, Pair, Polyline, PolylineKind, Shape, Spline, Vertex,
};
pub use text::{Attachment, Direction, Horizontal, MText, Text, Vertical};
