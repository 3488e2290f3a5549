//! Where in a program findings about two of its paths are reported.

use pathbuild_diagnostic::{Diagnostic, TraceStep};
use pathbuild_toolpath::StepOrigin;

use crate::db::Db;
use crate::queries::programs::TracedProgram;

/// The occurrences of paths in a program.
#[derive(Clone, Copy)]
pub(super) struct Occurrences<'t> {
    pub(super) db: &'t dyn Db,
    pub(super) traced: &'t TracedProgram,
}

impl<'t> Occurrences<'t> {
    /// The innermost path that contains both an element and another path, and its element that leads to the former.
    pub(super) fn common(self, mut at: StepOrigin, other: u32) -> (u32, Option<u32>) {
        let around_other: Vec<u32> = self.outwards(other).collect();
        while !around_other.contains(&at.occurrence) {
            let Some(parent) = self.parent(at.occurrence) else { break };
            at = parent;
        }
        (at.occurrence, at.element)
    }

    /// A path and the paths around it, from the inside out.
    pub(super) fn outwards(self, occurrence: u32) -> impl Iterator<Item = u32> + 't {
        let parent = move |inner: &u32| self.parent(*inner).map(|outer| outer.occurrence);
        std::iter::successors(Some(occurrence), parent)
    }

    fn parent(self, occurrence: u32) -> Option<StepOrigin> {
        self.traced.trace.occurrences[occurrence as usize].parent
    }

    /// Places a finding at an element of a path, or at the path's start.
    pub(super) fn at_element(self, occurrence: u32, element: Option<u32>, found: Diagnostic) -> Diagnostic {
        let part = &self.traced.parts[self.traced.trace.occurrences[occurrence as usize].id];
        let found = found.in_file(part.file.path(self.db)).in_path(part.path.name.as_str());
        let element = element.and_then(|element| part.path.drawn.elements.get(element as usize));
        let origin =
            element.map_or(part.path.start_origin.clone(), |element| part.path.drawn.origin(element));
        Diagnostic { trace: self.embeddings_leading_to(occurrence), ..origin.at(found) }
    }

    /// The embeddings that lead to a path, outermost first.
    fn embeddings_leading_to(self, occurrence: u32) -> Vec<TraceStep> {
        let step = |inner: u32| {
            let StepOrigin { occurrence, element } = self.parent(inner)?;
            let part = &self.traced.parts[self.traced.trace.occurrences[occurrence as usize].id];
            let element = part.path.drawn.elements.get(element? as usize)?;
            Some(TraceStep {
                file: part.file.path(self.db).clone(),
                path: part.path.name.as_str().into(),
                point: part.path.drawn.origin(element).point,
            })
        };
        let mut steps: Vec<TraceStep> = self.outwards(occurrence).filter_map(step).collect();
        steps.reverse();
        steps
    }
}
