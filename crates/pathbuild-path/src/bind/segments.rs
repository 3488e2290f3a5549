//! Elements to segments, each with the parameters it needs.

use std::sync::Arc;

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::{drawing, parameters as messages, walk};

use super::{At, Binder};
use crate::approx::{above, near};
use crate::element::{Cut, Element, Role, Shape};
use crate::geometry::{Curve, Xy};
use crate::letter::{ElementClass, Letter};
use crate::path::{Helix, Hole, Path, Segment, SegmentKind, Subpath, SubpathName, SubpathValue};
use crate::text::{ParameterText, Piece};
use crate::values::{Given, Values};

/// Orders of what does not say N. (spec/50-path-building.md, "Segments")
pub(super) const UNNUMBERED: f64 = 9998.0;
const BEFORE_ALL: f64 = -1_000_000.0;

impl Binder<'_> {
    pub(super) fn segments(&mut self, tool: Option<f64>) -> Vec<Segment> {
        let raw = self.raw;
        let mut segments = Vec::with_capacity(raw.drawn.elements.len());
        for (number, element) in (0_u32..).zip(&raw.drawn.elements) {
            if let Some((order, kind)) = self.segment(element, tool) {
                segments.push(Segment { element: number, order, kind });
            }
        }
        segments
    }

    /// An own T of a subpath must be below the path's S, too.
    pub(super) fn add_subpath_surfaces(path: &mut Path) {
        let subpaths = path.segments.iter().filter_map(|segment| match &segment.kind {
            SegmentKind::Subpath(subpath) => Some((segment, subpath)),
            _ => None,
        });
        let own = subpaths.filter_map(|(segment, subpath)| {
            let origin = path.origin(segment);
            let says = path.drawn.text(subpath.text).is_some_and(|text| text.letters.contains(Letter::T));
            says.then_some((origin, subpath.thickness, subpath.text))
        });
        for (origin, thickness, text) in own.collect::<Vec<_>>() {
            path.add_surface(origin, thickness, text);
        }
    }

    /// What an element is in the path, with its order at a star.
    fn segment(&mut self, element: &Element, tool: Option<f64>) -> Option<(f64, SegmentKind)> {
        if let (Role::Cut(cut), Shape::Curve(curve)) = (element.role, &element.shape) {
            return self.cut(element, cut, curve, tool);
        }
        if let Role::SilentSweep | Role::SkippedSubpath = element.role {
            // A text that one has is not read.
            return Some((UNNUMBERED, SegmentKind::Sweep { height: None }));
        }
        let (class, text) = (element.class(tool), self.raw.drawn.text(element.text));
        let values = self.element_values(At::Element(element), text, class == ElementClass::HelicalSupport);
        let scope = Scope { element, class, values: &values, tool };
        let order = || values.number(Letter::N).number().unwrap_or(UNNUMBERED);
        match (element.role, element.shape) {
            (Role::Cut(cut), Shape::Circle { centre, radius }) => self.circle(&scope, cut, centre, radius),
            (Role::Subpath, Shape::Curve(curve)) => {
                let subpath = self.subpath(element, &values, curve)?;
                Some((order(), SegmentKind::Subpath(Box::new(subpath))))
            }
            (_, Shape::Curve(_)) => {
                Some((order(), SegmentKind::Sweep { height: values.number(Letter::S).number() }))
            }
            (_, Shape::Circle { .. }) => None,
        }
    }

    fn circle(&mut self, scope: &Scope<'_>, cut: Cut, centre: Xy, radius: f64) -> Option<(f64, SegmentKind)> {
        let tool = scope.tool?;
        if near(radius, tool / 2.0) {
            let hole = self.hole(scope, cut, centre)?;
            return Some((BEFORE_ALL, SegmentKind::Hole(Arc::new(hole))));
        }
        if radius < tool / 2.0 {
            let problem =
                Diagnostic::new(&drawing::CIRCLE_TOO_SMALL).with("diameter", 2.0 * radius).with("tool", tool);
            self.report(At::Element(scope.element), problem);
            return None;
        }
        let helix = self.helix(scope, cut, centre, radius, tool)?;
        Some((BEFORE_ALL + radius, SegmentKind::Helix(Arc::new(helix))))
    }

    fn hole(&mut self, scope: &Scope<'_>, cut: Cut, centre: Xy) -> Option<Hole> {
        let bottom = self.needed(scope, if cut == Cut::Mark { Letter::D } else { Letter::B })?;
        Some(Hole {
            centre,
            bottom,
            feed: self.allowed(scope, Letter::F),
            peck: self.allowed(scope, Letter::C),
            comment: scope.values.text(Letter::Q).map(Into::into),
        })
    }

    fn helix(&mut self, scope: &Scope<'_>, cut: Cut, centre: Xy, radius: f64, tool: f64) -> Option<Helix> {
        self.check_size(scope, radius, tool);
        let infeed = self.needed(scope, Letter::I);
        let bottom = self.needed(scope, if cut == Cut::Mark { Letter::D } else { Letter::B });
        let bars = if cut == Cut::Support {
            let inner = radius - tool / 2.0;
            Some(self.bars(scope, 2.0 * std::f64::consts::PI * inner)?)
        } else {
            None
        };
        let bottom = bottom?;
        Some(Helix {
            centre,
            radius,
            bottom: bars.map_or(bottom, |bars| bars.top),
            bars: bars.map(|bars| (bottom, bars)),
            feed: self.allowed(scope, Letter::F),
            infeed: infeed?,
            comment: scope.values.text(Letter::Q).map(Into::into),
        })
    }

    fn check_size(&mut self, scope: &Scope<'_>, radius: f64, tool: f64) {
        let largest = match self.values.number(Letter::A) {
            Given::Absent => 4.0 * tool,
            Given::Number(largest) => largest,
            Given::Faulty => return,
        };
        if above(2.0 * radius, largest) {
            let problem =
                Diagnostic::new(&walk::HELIX_TOO_LARGE).with("diameter", 2.0 * radius).with("limit", largest);
            self.report(At::Element(scope.element), problem);
        }
    }

    fn subpath(&mut self, element: &Element, values: &Values<'_>, curve: Curve) -> Option<Subpath> {
        let inherited = |letter| values.number(letter).or(self.values.number(letter)).number();
        let own_text = |letter| values.text(letter).map(Box::from);
        let value = |(value, piece): (&str, &Piece)| {
            let mut characters = value.chars();
            let variable = characters.next();
            let text = values.underlined(piece);
            SubpathValue { variable, value: characters.as_str().into(), text }
        };
        Some(Subpath {
            start: curve.start(),
            end: curve.end(),
            name: self.subpath_name(values, self.raw.drawn.text(element.text)),
            thickness: inherited(Letter::T)?,
            tool: inherited(Letter::O)?,
            material: own_text(Letter::M).or_else(|| self.path_text(Letter::M)),
            height: values.number(Letter::H).number().unwrap_or(0.0),
            values: values.variables().map(value).collect(),
            text: element.text,
        })
    }

    fn subpath_name(&self, values: &Values<'_>, text: Option<ParameterText<'_>>) -> SubpathName {
        let (Some(value), Some(fault)) = (values.text(Letter::Embed), values.fault(Letter::Embed)) else {
            return SubpathName::Missing { text: text.map(ParameterText::whole) };
        };
        match self.language.path_pattern.find(value) {
            None => SubpathName::Invalid { value: value.into(), text: fault },
            Some((name, range)) => {
                let has_more = range.len() < value.len();
                SubpathName::Found { name, text: fault, has_more: has_more.then(|| value.into()) }
            }
        }
    }

    /// A value that the element or the path must give: PB201 where neither does.
    pub(super) fn needed(&mut self, scope: &Scope<'_>, letter: Letter) -> Option<f64> {
        let given = scope.values.number(letter).or(self.values.number(letter));
        if given == Given::Absent {
            let problem = Diagnostic::new(&messages::MISSING)
                .with("letter", letter.as_char())
                .with("element", scope.class.word());
            self.report(At::Element(scope.element), problem);
        }
        given.number()
    }

    /// A value that the element or the path may give.
    pub(super) fn allowed(&self, scope: &Scope<'_>, letter: Letter) -> Option<f64> {
        scope.values.number(letter).or(self.values.number(letter)).number()
    }
}

/// The element whose segment is being made.
pub(super) struct Scope<'a> {
    pub(super) element: &'a Element,
    pub(super) class: ElementClass,
    pub(super) values: &'a Values<'a>,
    pub(super) tool: Option<f64>,
}
