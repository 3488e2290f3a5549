//! Checks letters of a start text that have no effect. Most are written out of habit and are harmless; these are not. (book:
//! language/support-bars)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::parameters as messages;

use super::Binder;
use crate::approx::above;
use crate::element::{Cut, Role, Shape};
use crate::geometry::Curve;
use crate::letter::Letter;
use crate::path::SegmentKind;
use crate::read::{Part, Ring, rings};

/// The letters that only apply to support bars.
const BAR_LETTERS: [Letter; 2] = [Letter::P, Letter::U];

impl Binder<'_> {
    /// Reports W of a path without a chain, and missing support bars of an outline.
    pub(super) fn check_habits(&mut self) {
        let is_chain = |element: &crate::element::Element| {
            matches!((element.role, element.shape), (Role::Cut(_), Shape::Curve(_)))
        };
        if self.values.has(Letter::W) && !self.raw.drawn.elements.iter().any(is_chain) {
            let problem = Diagnostic::new(&messages::FIRST_DEPTH_WITHOUT_CHAIN);
            let problem = problem.with("letter", Letter::W.as_char());
            self.report_at_start(self.values.underline(Letter::W, problem));
        }
        if BAR_LETTERS.into_iter().any(|letter| self.values.has(letter)) {
            self.check_bars();
        }
    }

    /// PB212 if there are no bars and the cuts through the material form a ring, so that the part would come loose.
    fn check_bars(&mut self) {
        let elements = &self.raw.drawn.elements;
        if elements.iter().any(|element| element.role == Role::Cut(Cut::Support)) {
            return;
        }
        let outline = self.segments.iter().filter_map(|segment| {
            let SegmentKind::Cut(cut) = segment.kind else { return None };
            let cut = &self.cuts[cut as usize];
            let Shape::Curve(curve) = elements[segment.element as usize].shape else { return None };
            (cut.cut == Cut::Mill && !above(cut.bottom, 0.0)).then_some((segment.element, curve))
        });
        let part = |(entity, curve): (u32, Curve)| Part { curve, group: None, entity: entity as usize };
        let parts: Vec<Part> = outline.map(part).collect();
        let closed = rings(&parts).into_iter().find_map(|ring| match ring {
            Ring::Closed(parts) => parts.iter().map(|part| part.entity).min(),
            Ring::Open { .. } | Ring::Branch { .. } => None,
        });
        let Some(first) = closed else { return };
        let letters = BAR_LETTERS.into_iter().filter(|letter| self.values.has(*letter));
        let letters: pathbuild_diagnostic::Value =
            letters.map(|letter| letter.as_char().to_string()).collect();
        let problem = Diagnostic::new(&messages::LOST_BARS).with("letters", letters);
        let problem = problem.in_path(self.raw.name.as_str());
        self.problems.push(self.raw.drawn.origin(&elements[first]).at(problem));
    }
}
