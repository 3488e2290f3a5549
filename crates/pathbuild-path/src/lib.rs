//! The drawing language: path names, parameters, variables, the walk, chains.
//!
//! [`raw_file`] finds the paths of a drawing; [`bind()`] binds the variables of a raw path and checks every parameter; [`walk()`] orders
//! its segments from the start to the end and groups them into milling chains. This crate knows neither salsa nor files nor G-code. (book:
//! language/layers-and-names to language/q-projects)

pub mod approx;
mod bind;
mod boxes;
mod chain;
mod changes;
mod disjoint_sets;
mod effective;
mod element;
mod element_parameters;
mod embedding;
mod geometry;
mod keep_out;
mod language;
mod letter;
mod line_type;
mod look_alikes;
mod names;
mod numbers;
mod part;
mod path;
mod q_project;
mod raw;
mod read;
mod text;
mod values;
mod variables;
mod walk;

pub use bind::{PartiallyBoundPath, bind, bind_leniently, regex_reason};
pub use chain::{Chain, ChainSegment, Item, PlacedSubpath, Sweep, WalkedPath};
pub use changes::{DrawnChange, DrawnChanges, DrawnSide, ElementChange, ElementKind, drawn_changes};
pub use effective::{PathNumbers, PathOptions, PathRole, Provider, fallback};
pub use element::{
    Cut, END_RADIUS, Element, Marker, Origin, PROBE_RADIUS, Role, START_RADIUS, Shape, Source, TURN_RADIUS,
    has_diameter_of,
};
pub use element_parameters::{ElementParameters, Parameter, element_parameters};
pub use embedding::{PathHeader, PathSignature, Restriction, SubpathCall, SubpathChecker, with_near_names};
pub use geometry::{Arc, Curve, Line, Placement, Xy, direction};
pub use keep_out::{KeepOut, KeepOutMap, KeepOuts, TipMove};
pub use language::{DoubtThresholds, Language, PathTool, PathTools};
pub use letter::Letter;
pub use letter::{ElementClass, LetterUse};
pub use line_type::{LineType, LineTypeAliases};
pub use look_alikes::near_layer;
pub use names::files::{
    FilePattern, NameRange, PathKey, RangeTable, check_file_name, is_q_project, q_project_name,
    tested_by_q_project,
};
pub use names::{
    CaseSensitiveName, LayerPattern, PathLayer, PathName, PathPattern, PatternError, name_regex,
};
pub use numbers::{parse_integer, parse_number};
pub use part::{
    CutElement, DrawnParts, EarlierCuts, EmbeddedPlace, LeftoverMaterial, LostBar, MAX_WEAK_BRIDGE,
    MilledMove, NeighbourCuts, NeighbourGouge, Part, PartCut, PartFindings, PartRing, PartSettings,
    PartSweep, PathCuts, PlacedCuts, PlacedPart, SeveredPart, StandingBar, THROUGH_HEIGHT, WasteCut,
    check_parts, gouging_moves, largest_displacement,
};
pub use path::{
    Bars, ChainParameters, CutParameters, Helix, Hole, Path, Probe, Segment, SegmentKind, Subpath,
    SubpathName, SubpathValue, Turn,
};
pub use q_project::{Component, QProject, QProjectFindings, QProjectLine, compare_q_project, plan_q_project};
pub use raw::{DrawnElements, Position, RawFile, RawPath, SourceMap};
pub use read::{
    AnyText, AssignedElement, AssignedText, NearNames, ProxyLine, TextCircle, assigned_texts,
    has_text_on_part, is_near_clamps_or_parts, keep_outs, may_be_stray_text, parts, proxy_lines, raw_file,
    stray_findings,
};
pub use text::{LetterValue, ParameterText, ParameterTexts, TextId, as_seen};
pub use values::has_thousands;
pub use variables::{AllowedValues, Bindings, Combinations, Definition};
pub use walk::{walk, walk_with_checkpoints};
