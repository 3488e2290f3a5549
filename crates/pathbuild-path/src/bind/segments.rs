//! Elements to segments, each with the parameters it needs.

use pathbuild_diagnostic::messages::{drawing, parameters as messages, walk};
use pathbuild_diagnostic::{Diagnostic, TextFault};

use super::Binder;
use crate::approx::{above, at_least, near};
use crate::element::{Cut, Element, Origin, Role, Shape};
use crate::geometry::{Curve, Xy};
use crate::letter::{ElementClass, Letter};
use crate::path::{
    Bars, ChainParameters, CutSegment, Helix, Hole, Path, Segment, SegmentKind, Subpath, SubpathName,
    SubpathValue, Sweep,
};
use crate::values::{Given, Values};

/// Orders of what does not say N. (spec/50-path-building.md, "Segments")
const UNNUMBERED: f64 = 9998.0;
const BEFORE_ALL: f64 = -1_000_000.0;

impl Binder<'_> {
    pub(super) fn segments(&mut self, tool: Option<f64>) -> Vec<Segment> {
        self.raw.elements.iter().filter_map(|element| self.segment(element, tool)).collect()
    }

    /// An own T of a subpath must be below the path's S, too.
    pub(super) fn add_subpath_surfaces(path: &mut Path) {
        let subpaths = path.segments.iter().filter_map(|segment| match &segment.kind {
            SegmentKind::Subpath(subpath) => Some((segment.origin.clone(), subpath)),
            _ => None,
        });
        let own = subpaths.filter_map(|(origin, subpath)| {
            let (_, fault) = subpath.faults.iter().find(|(letter, _)| *letter == 'T')?;
            Some((origin, subpath.thickness, fault.clone()))
        });
        for (origin, thickness, fault) in own.collect::<Vec<_>>() {
            path.add_surface(origin, thickness, Some(fault));
        }
    }

    fn segment(&mut self, element: &Element, tool: Option<f64>) -> Option<Segment> {
        let class = element.class(tool);
        let text = match element.role {
            Role::SilentSweep | Role::SkippedSubpath => None,
            _ => self.raw.text_of(element.text),
        };
        let has_bars = matches!(class, ElementClass::Support | ElementClass::HelicalSupport);
        let values = self.element_values(&element.origin, text, has_bars);
        let scope = Scope { origin: &element.origin, class, values: &values, tool };
        let (order, kind) = match (element.role, element.shape) {
            (Role::Cut(cut), Shape::Circle { centre, radius }) => self.circle(&scope, cut, centre, radius)?,
            (Role::Cut(cut), Shape::Curve(curve)) => (None, SegmentKind::Cut(self.cut(&scope, cut, curve)?)),
            (Role::Subpath, Shape::Curve(curve)) => {
                let subpath = self.subpath(&values, curve, text.map(crate::ParameterText::whole))?;
                (None, SegmentKind::Subpath(subpath))
            }
            (_, Shape::Curve(curve)) => {
                let height = values.number(Letter::S).number();
                (None, SegmentKind::Sweep(Sweep { start: curve.start(), end: curve.end(), height }))
            }
            (_, Shape::Circle { .. }) => return None,
        };
        let number = values.number(Letter::N).number().unwrap_or(UNNUMBERED);
        Some(Segment { origin: element.origin.clone(), order: order.unwrap_or(number), kind })
    }

    fn cut(&mut self, scope: &Scope<'_>, cut: Cut, curve: Curve) -> Option<CutSegment> {
        let bottom = self.needed(scope, if cut == Cut::Mark { Letter::D } else { Letter::B });
        let bars = if cut == Cut::Support { Some(self.bars(scope, curve.length())?) } else { None };
        let own = scope.values;
        let letters = [Letter::I, Letter::C, Letter::W];
        Some(CutSegment {
            curve,
            cut,
            feed: self.allowed(scope, Letter::F),
            bottom: bottom?,
            bars,
            chain: ChainParameters {
                infeed: self.allowed(scope, Letter::I),
                peck: self.allowed(scope, Letter::C),
                first_depth: self.allowed(scope, Letter::W),
            },
            own_chain_letters: letters
                .into_iter()
                .filter_map(|letter| Some((letter.as_char(), own.fault(letter)?)))
                .collect(),
            comment: own.text(Letter::Q).map(Into::into),
        })
    }

    fn circle(
        &mut self,
        scope: &Scope<'_>,
        cut: Cut,
        centre: Xy,
        radius: f64,
    ) -> Option<(Option<f64>, SegmentKind)> {
        let tool = scope.tool?;
        if near(radius, tool / 2.0) {
            let hole = self.hole(scope, cut, centre)?;
            return Some((Some(BEFORE_ALL), SegmentKind::Hole(hole)));
        }
        if radius < tool / 2.0 {
            let problem =
                Diagnostic::new(&drawing::CIRCLE_TOO_SMALL).with("diameter", 2.0 * radius).with("tool", tool);
            self.report(scope.origin, problem);
            return None;
        }
        let helix = self.helix(scope, cut, centre, radius, tool)?;
        Some((Some(BEFORE_ALL + radius), SegmentKind::Helix(helix)))
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
            self.report(scope.origin, problem);
        }
    }

    /// The bars of a segment of this length, with room for the cutter between each two.
    fn bars(&mut self, scope: &Scope<'_>, length: f64) -> Option<Bars> {
        let (top, bar, distance) =
            (self.needed(scope, Letter::D), self.needed(scope, Letter::P), self.needed(scope, Letter::U));
        let bars = Bars { top: top?, length: bar?, distance: distance? };
        let tool = scope.tool?;
        let count = bars.count(length);
        let gap = length / count - bars.length;
        if count > 0.0 && !at_least(gap, tool) {
            let problem = Diagnostic::new(&walk::NO_ROOM_BETWEEN_BARS)
                .with("count", count)
                .with("gap", gap)
                .with("tool", tool);
            self.report(scope.origin, problem);
        }
        Some(bars)
    }

    fn subpath(&mut self, values: &Values, curve: Curve, text: Option<TextFault>) -> Option<Subpath> {
        let inherited = |letter| values.number(letter).or(self.values.number(letter)).number();
        let own_text = |letter| values.text(letter).map(Box::from);
        let faults = [Letter::T, Letter::O, Letter::M].into_iter();
        let value = |(value, text): &(Box<str>, TextFault)| {
            let mut characters = value.chars();
            let variable = characters.next();
            SubpathValue { variable, value: characters.as_str().into(), text: text.clone() }
        };
        Some(Subpath {
            start: curve.start(),
            end: curve.end(),
            name: self.subpath_name(values, text),
            thickness: inherited(Letter::T)?,
            tool: inherited(Letter::O)?,
            material: own_text(Letter::M).or_else(|| self.path_text(Letter::M)),
            height: values.number(Letter::H).number().unwrap_or(0.0),
            values: values.variables.iter().map(value).collect(),
            faults: faults.filter_map(|letter| Some((letter.as_char(), values.fault(letter)?))).collect(),
        })
    }

    fn subpath_name(&self, values: &Values, text: Option<TextFault>) -> SubpathName {
        let (Some(value), Some(fault)) = (values.text(Letter::Embed), values.fault(Letter::Embed)) else {
            return SubpathName::Missing { text };
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
    fn needed(&mut self, scope: &Scope<'_>, letter: Letter) -> Option<f64> {
        let given = scope.values.number(letter).or(self.values.number(letter));
        if given == Given::Absent {
            let problem = Diagnostic::new(&messages::MISSING)
                .with("letter", letter.as_char())
                .with("element", scope.class.word());
            self.report(scope.origin, problem);
        }
        given.number()
    }

    /// A value that the element or the path may give.
    fn allowed(&self, scope: &Scope<'_>, letter: Letter) -> Option<f64> {
        scope.values.number(letter).or(self.values.number(letter)).number()
    }
}

/// The element whose segment is being made.
struct Scope<'a> {
    origin: &'a Origin,
    class: ElementClass,
    values: &'a Values,
    tool: Option<f64>,
}
