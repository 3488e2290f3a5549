//! Which layers belong to which path. (book: language/layers-and-names)

use pathbuild_dxf::{Drawing, Layer};

use crate::name::{PathName, PathPattern};

/// The path layers of a drawing.
pub(super) struct PathLayers {
    /// In file order, but those of a path behind its first.
    found: Vec<FoundLayer>,
    /// By the number of the layer.
    memberships: Vec<Option<Membership>>,
}

/// A path layer.
pub(super) struct FoundLayer {
    /// Its path's name as it spells it.
    pub(super) path: PathName,
    /// Which of the drawing's layers it is.
    pub(super) number: usize,
    /// The number of its path's first.
    first: usize,
}

/// The path that a layer belongs to.
#[derive(Clone, Copy)]
pub(super) struct Membership {
    /// Which of the drawing's paths.
    pub(super) path: usize,
    /// Which of its layers.
    pub(super) layer: u32,
}

impl PathLayers {
    /// Those of a drawing.
    pub(super) fn find(drawing: &Drawing, pattern: &PathPattern) -> Self {
        let layer = |(number, layer): (usize, &Layer)| {
            let path = pattern.layer(&layer.name)?.path;
            Some(FoundLayer { path, number, first: number })
        };
        let mut found: Vec<FoundLayer> = drawing.layers.iter().enumerate().filter_map(layer).collect();
        found.sort_by(|one, other| one.path.cmp(&other.path));
        for of_path in found.chunk_by_mut(|one, other| one.path == other.path) {
            let first = of_path[0].number;
            for layer in of_path {
                layer.first = first;
            }
        }
        found.sort_by_key(|layer| layer.first);
        let mut memberships = vec![None; drawing.layers.len()];
        for (path, layers) in by_path(&found).enumerate() {
            for (layer, found) in (0_u32..).zip(layers) {
                memberships[found.number] = Some(Membership { path, layer });
            }
        }
        Self { found, memberships }
    }

    /// The layers of each path, in order of first appearance.
    pub(super) fn by_path(&self) -> impl Iterator<Item = &[FoundLayer]> {
        by_path(&self.found)
    }

    /// The path that a layer belongs to; `None` for a layer that is no path layer.
    pub(super) fn membership(&self, layer: u32) -> Option<Membership> {
        self.memberships[layer as usize]
    }
}

fn by_path(found: &[FoundLayer]) -> impl Iterator<Item = &[FoundLayer]> {
    found.chunk_by(|one, other| one.first == other.first)
}
