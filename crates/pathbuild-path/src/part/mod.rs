//! Finished parts: their outlines, and the check that the cuts of a drawing leave them as drawn. In this module, the plate is the material from which
//! parts are cut, with its lower face at Z 0, and not the machine's plate below it. (book: language/part)

mod bars;
mod check;
mod cuts;
mod displacement;
mod enclosure;
mod gouge;
mod intervals;
mod leftover;
mod lines;
mod loose;
mod neighbours;
mod open;
mod prepared;
mod waste;

use pathbuild_diagnostic::messages::part as messages;
use pathbuild_diagnostic::{Diagnostic, Place, Point, Value};
use smol_str::SmolStr;

use crate::geometry::{Curve, Placement, Xy};
use crate::names::{LayerPattern, PathName};

pub(crate) use intervals::{Stretch, add_stretches_within, join_stretches};
pub(crate) use loose::first_enclosing;
pub(crate) use open::OpenOutline;
use prepared::{PreparedPart, Side};

pub use bars::LostBar;
pub use check::{PartFindings, check_parts};
pub use cuts::{CutElement, EmbeddedPlace, PartCut, PartSweep, PathCuts, StandingBar, THROUGH_HEIGHT};
pub use displacement::largest_displacement;
pub use gouge::{MilledMove, gouging_moves};
pub use leftover::LeftoverMaterial;
pub use loose::MAX_WEAK_BRIDGE;
pub use neighbours::{NeighbourCuts, NeighbourGouge, PlacedCuts, SeveredPart};
pub use waste::{EarlierCuts, WasteCut};

/// Settings of the part check.
#[derive(Clone, Debug)]
pub struct PartSettings {
    /// The layers with finished parts.
    pub pattern: LayerPattern,
    /// Distance in mm by which a cut may miss the outline on either side.
    pub tolerance: f64,
    /// Whether something other than support bars holds the parts.
    pub is_held_otherwise: bool,
}

/// A finished part: its outermost ring and the openings inside it.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// The layer of the outermost ring.
    pub layer: SmolStr,
    /// The paths to which the part may belong: the name captured by the pattern, in upper case and with points. `None` if the pattern captures
    /// nothing.
    pub paths: Option<SmolStr>,
    /// The outermost ring, counterclockwise, then the openings, clockwise: the material is on the left.
    pub rings: Vec<PartRing>,
}

/// A closed ring of curves: the outer edge of a part, or an opening.
#[derive(Clone, Debug, PartialEq)]
pub struct PartRing {
    /// The curves of the ring, in order. Each begins at the end of the previous curve.
    pub curves: Vec<Curve>,
    /// Indices of the openings around this ring, from the outermost.
    pub around: Vec<usize>,
}

fn placed_part(part: &Part, placement: &Placement) -> Part {
    let ring = |ring: &PartRing| PartRing {
        curves: ring.curves.iter().map(|curve| placement.place_curve(curve)).collect(),
        around: ring.around.clone(),
    };
    Part { rings: part.rings.iter().map(ring).collect(), ..part.clone() }
}

/// The parts of a drawing, with findings about their outlines.
#[derive(Clone, Debug, Default)]
pub struct DrawnParts {
    /// The parts in file order.
    pub parts: Vec<Part>,
    /// For each part, the places of its rings in the file.
    pub places: Vec<Vec<Place>>,
    /// The open outlines that are findings only if paths cut along them; see [`DrawnParts::judge_outlines`].
    pub(crate) open: Vec<OpenOutline>,
    /// Findings about outlines (PB219), with their positions in the file.
    pub problems: Vec<Diagnostic>,
}

impl Part {
    /// Returns the index of the outermost opening that contains a ring, or of the ring itself if none does. Rings of the same nest are alternatives,
    /// of which only one must be cut: for example, a hole and the core hole of its thread.
    pub fn nest(&self, ring: usize) -> usize {
        self.rings[ring].around.first().copied().unwrap_or(ring)
    }

    /// Whether a point lies in an opening of the part.
    pub fn has_opening_at(&self, at: Point) -> bool {
        matches!(PreparedPart::new(self).side(Xy::new(at.x.0, at.y.0)), Side::Openings(_))
    }

    /// Whether the part may belong to a path.
    pub fn may_belong_to(&self, path: &PathName) -> bool {
        may_belong_to(self.paths.as_ref(), path)
    }

    /// Returns PB220 for the layer of the part if it names a path that its drawing does not have. `paths` are the paths of the drawing.
    pub fn missing_path(&self, paths: &[PathCuts]) -> Option<Diagnostic> {
        let name = self.paths.as_ref()?;
        if paths.is_empty() || paths.iter().any(|path| self.may_belong_to(&path.name)) {
            return None;
        }
        let others = (paths.len() > MAX_LISTED_PATHS).then_some("...");
        let listed = paths.iter().take(MAX_LISTED_PATHS).map(|path| path.name.as_str()).chain(others);
        let problem = Diagnostic::new(&messages::LAYER_WITHOUT_PATH).quoting("layer", &*self.layer);
        Some(problem.quoting("name", &**name).with("names", listed.collect::<Value>()))
    }
}

/// Largest number of paths that a message lists.
const MAX_LISTED_PATHS: usize = 5;

/// Whether an outline may belong to a path. If the pattern captures no name, it may belong to any path; otherwise, to paths with the captured name,
/// possibly followed by letters.
fn may_belong_to(captured: Option<&SmolStr>, path: &PathName) -> bool {
    let Some(name) = captured else { return true };
    let path = path.canonical();
    path.strip_prefix(name.as_str()).is_some_and(|rest| rest.chars().all(char::is_alphabetic))
}

/// A finished part as placed in a program.
#[derive(Clone, Debug)]
pub struct PlacedPart<'d> {
    /// The part as drawn.
    pub drawn: &'d Part,
    /// The material that is left at the part's outline, as drawn.
    pub left: &'d [LeftoverMaterial],
    /// The stretches of the part's outlines that the cutter does not reach, as drawn.
    pub corners: &'d [Curve],
    /// The centre lines of the support bars that the cuts of the part's own path remove, as drawn.
    pub lost_bars: &'d [Curve],
    /// The centre lines of the support bars that the paths of a project cut away from each other, in the program's coordinates. The program's
    /// first part lists all of them.
    pub bars_lost_to_neighbours: Vec<Curve>,
    /// The stretches on which cuts enter the part, in the program's coordinates.
    pub gouges: Vec<Curve>,
    /// Whether nothing holds the part once it is cut.
    pub is_loose: bool,
    /// Half the diameter of the cutter in mm.
    pub radius: f64,
    /// The part's placement in the program.
    pub placement: Placement,
    /// Z of the part's upper face in mm.
    pub top: f64,
    /// Distance in mm by which a cut may miss the part's outline.
    pub tolerance: f64,
}
