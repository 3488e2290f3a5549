//! Open outlines along which paths cut as along the edge of a part: a piece of the outline is missing. (book: language/part)

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::part as messages;
use smol_str::SmolStr;

use super::cuts::{CutIndex, PathCuts};
use super::intervals::offset_curve;
use super::{DrawnParts, Part, may_belong_to};
use crate::boxes::{BoxIndex, square, widened_box};
use crate::geometry::{Curve, Line, Xy};
use crate::keep_out::Outline;

/// An open chain of curves on a layer with parts.
#[derive(Clone, Debug)]
pub(crate) struct OpenOutline {
    /// The paths to which the part may belong, as in [`Part::paths`].
    pub(crate) paths: Option<SmolStr>,
    pub(crate) curves: Vec<Curve>,
    /// The finding about the gap, with its position in the file.
    pub(crate) problem: Diagnostic,
}

/// Minimum share of the length of an open outline along which cuts must run, so that it is taken for the edge of a part.
const MIN_CUT_SHARE: f64 = 0.5;

/// Largest distance of such a cut from where it would cut the edge out, as a share of the cutter's radius. A cut along the line itself does not
/// count.
const MAX_ERROR: f64 = 0.75;

/// Positions on a curve at which the check looks for cuts, as fractions of its length.
const SAMPLE_POSITIONS: [f64; 3] = [1.0 / 6.0, 0.5, 5.0 / 6.0];

impl DrawnParts {
    /// Adds PB219 for each open outline along which these paths cut, and leaves out the parts that it surrounds: they are its openings. Cuts beside
    /// the outline of a part do not count.
    pub(super) fn judge_open_outlines(&mut self, paths: &[PathCuts]) {
        if self.open.is_empty() {
            return;
        }
        let paths: Vec<&PathCuts> = paths.iter().collect();
        let (cuts, edges) = (CutIndex::new(&paths), Edges::new(&self.parts));
        let mut open = std::mem::take(&mut self.open);
        open.retain(|outline| !self.is_reported(outline) && outline.is_cut(&cuts, &edges));
        let surrounded = |part: &Part| open.iter().any(|outline| outline.surrounds(part));
        let mut is_kept = self.parts.iter().map(|part| !surrounded(part)).collect::<Vec<_>>().into_iter();
        self.places.retain({
            let mut is_kept = is_kept.clone();
            move |_| is_kept.next().unwrap_or(true)
        });
        self.parts.retain(|_| is_kept.next().unwrap_or(true));
        self.problems.extend(open.into_iter().map(|outline| outline.problem));
    }

    /// Whether the layer of an outline is reported as one without any closed outline.
    fn is_reported(&self, outline: &OpenOutline) -> bool {
        let layer = &outline.problem.place.layer;
        let mut reported = self.problems.iter();
        reported.any(|known| known.message == &messages::NO_CLOSED_OUTLINE && known.place.layer == *layer)
    }
}

impl OpenOutline {
    /// Whether cuts through the plate run along most of the chain, at a distance of half of O. A straight line is no outline.
    fn is_cut(&self, cuts: &CutIndex<'_>, edges: &Edges<'_>) -> bool {
        let length: f64 = self.curves.iter().map(Curve::length).sum();
        let followed = |curve: &Curve| {
            let places =
                SAMPLE_POSITIONS.iter().filter(|share| self.is_cut_at(curve, **share, cuts, edges)).count();
            curve.length() * places as f64 / SAMPLE_POSITIONS.len() as f64
        };
        self.closing_line().length() < 0.999 * length
            && self.curves.iter().map(followed).sum::<f64>() >= MIN_CUT_SHARE * length
    }

    fn is_cut_at(&self, curve: &Curve, share: f64, cuts: &CutIndex<'_>, edges: &Edges<'_>) -> bool {
        cuts.near(widened_box(curve, 0.0)).any(|number| {
            let cut = &cuts.cuts[number];
            let drawn = cut.element(cuts).supported.as_ref().unwrap_or(&cut.cut.way.curve);
            cuts.contours[cut.path]
                && cuts.may_cut_out(cut)
                && may_belong_to(self.paths.as_ref(), &cuts.paths[cut.path].name)
                && [cut.radius, -cut.radius].into_iter().any(|aside| {
                    let Some(beside) = offset_curve(curve, aside) else { return false };
                    let at = beside.at(share * beside.length());
                    drawn.distance_to(at) < MAX_ERROR * cut.radius && !edges.are_near(at, 2.0 * cut.radius)
                })
        })
    }

    fn closing_line(&self) -> Curve {
        let ends = self.curves.first().map(Curve::start).zip(self.curves.last().map(Curve::end));
        let (start, end) = ends.unwrap_or((Xy::origin(), Xy::origin()));
        Curve::Line(Line { start: end, end: start })
    }

    /// Whether a part lies in the outline, or across its gap.
    fn surrounds(&self, part: &Part) -> bool {
        let border = Outline::new(&[&self.curves[..], &[self.closing_line()]].concat());
        part.rings[0].curves.iter().flat_map(Curve::quarters).any(|at| border.contains(at))
    }
}

/// The outlines of all parts of a drawing.
struct Edges<'p> {
    curves: Vec<&'p Curve>,
    boxes: BoxIndex,
}

impl<'p> Edges<'p> {
    fn new(parts: &'p [Part]) -> Self {
        let rings = parts.iter().flat_map(|part| &part.rings);
        let curves: Vec<&Curve> = rings.flat_map(|ring| &ring.curves).collect();
        Self { boxes: BoxIndex::new(curves.iter().map(|curve| widened_box(curve, 0.0))), curves }
    }

    fn are_near(&self, at: Xy, reach: f64) -> bool {
        self.boxes.near(square(at, reach)).any(|number| self.curves[number].distance_to(at) < reach)
    }
}
