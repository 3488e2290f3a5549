//! Which layers belong to which path. (spec/20-paths-and-files.md)

use pathbuild_dxf::{Drawing, Geometry};

use crate::name::{PathName, PathPattern};

/// The path that a layer belongs to.
#[derive(Clone, Copy)]
pub(super) struct Membership {
    /// Which of the drawing's paths.
    pub(super) path: usize,
    /// Which of its layers.
    pub(super) layer: u32,
}

/// How much is on a layer.
#[derive(Clone, Copy, Default)]
pub(crate) struct Count {
    pub(crate) texts: usize,
    pub(crate) circles: usize,
    pub(crate) lines: usize,
    pub(crate) arcs: usize,
}

impl Count {
    /// What is no text.
    pub(crate) fn others(self) -> usize {
        self.circles + self.lines + self.arcs
    }
}

/// The path layers of a drawing, each with its path's name: those of a path behind each other in file order, the paths by name.
pub(super) fn path_layers(drawing: &Drawing, pattern: &PathPattern) -> Vec<(PathName, usize)> {
    let named = drawing.layers.iter().enumerate();
    let named = named.filter_map(|(layer, found)| Some((pattern.layer(&found.name)?.path, layer)));
    let mut named: Vec<(PathName, usize)> = named.collect();
    named.sort();
    named
}

/// How much is on each layer.
pub(super) fn counts(drawing: &Drawing) -> Vec<Count> {
    let mut counts = vec![Count::default(); drawing.layers.len()];
    for entity in &drawing.entities {
        let count = &mut counts[entity.layer as usize];
        match entity.geometry {
            Geometry::Text(_) | Geometry::MText(_) => count.texts += 1,
            Geometry::Circle(_) => count.circles += 1,
            Geometry::Line(_) => count.lines += 1,
            Geometry::Arc(_) => count.arcs += 1,
        }
    }
    counts
}
