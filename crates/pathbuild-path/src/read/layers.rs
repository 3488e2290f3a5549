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

/// A path layer.
pub(super) struct FoundLayer {
    /// Its path's name as it spells it.
    pub(super) path: PathName,
    /// Which of the drawing's layers it is.
    pub(super) number: usize,
    /// The number of its path's first.
    pub(super) first: usize,
}

/// Finds the path layers of a drawing: in file order, but those of a path behind its first.
pub(super) fn find_path_layers(drawing: &Drawing, pattern: &PathPattern, found: &mut Vec<FoundLayer>) {
    found.clear();
    found.extend(drawing.layers.iter().enumerate().filter_map(|(number, layer)| {
        let path = pattern.layer(&layer.name)?.path;
        Some(FoundLayer { path, number, first: number })
    }));
    found.sort_by(|one, other| one.path.cmp(&other.path));
    for of_path in found.chunk_by_mut(|one, other| one.path == other.path) {
        let first = of_path[0].number;
        for layer in of_path {
            layer.first = first;
        }
    }
    found.sort_by_key(|layer| layer.first);
}
