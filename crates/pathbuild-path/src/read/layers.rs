//! Which layers belong to which path. (spec/20-paths-and-files.md)

use pathbuild_dxf::Drawing;

use crate::name::{PathName, PathPattern};

/// The path that a layer belongs to.
#[derive(Clone, Copy)]
pub(super) struct Membership {
    /// Which of the drawing's paths.
    pub(super) path: usize,
    /// Which of its layers.
    pub(super) layer: u32,
}

/// The path layers of a drawing, each with its path's name: those of a path behind each other in file order, the paths by name.
pub(super) fn path_layers(drawing: &Drawing, pattern: &PathPattern) -> Vec<(PathName, usize)> {
    let named = drawing.layers.iter().enumerate();
    let named = named.filter_map(|(layer, found)| Some((pattern.layer(&found.name)?.path, layer)));
    let mut named: Vec<(PathName, usize)> = named.collect();
    named.sort();
    named
}
