//! The drawing language: path names, parameters, variables, the walk, chains.
//!
//! [`raw_file`] finds the paths of a drawing; [`bind()`] binds the variables of a raw path and checks every parameter; [`walk()`] orders its
//! segments from the start to the end and groups them into milling chains. This crate knows neither salsa nor files nor
//! G-code. (book: language/layers-and-names to language/q-projects)

pub mod approx;
mod assign;
mod bind;
mod chain;
mod combinations;
mod definition;
mod doubts;
mod effective;
mod element;
mod embedding;
mod faults;
mod geometry;
mod in_force;
mod keep_out;
mod letter;
mod limits;
mod line_type;
mod matrix;
mod mistakes;
mod names;
mod number;
mod path;
mod q_project;
mod raw;
mod read;
mod text;
mod text_circle;
mod values;
mod variables;
mod walk;

pub use bind::{ExaminedPath, bind, examine, regex_reason};
pub use chain::{Chain, ChainSegment, Item, PlacedSubpath, Sweep};
pub use combinations::Combinations;
pub use definition::{AllowedValues, Definition};
pub use doubts::DoubtThresholds;
pub use effective::{PathNumbers, PathOptions, PathRole, Provider, fallback};
pub use element::{Cut, Element, Marker, Origin, Role, Shape, Source};
pub use embedding::{
    Judge, PathHeader, PathSignature, ProbeTop, Restriction, SubpathCall, SweepLimits, with_near_names,
};
pub use geometry::{Arc, Curve, Line, Placement, Xy, direction, on_circle};
pub use in_force::{ElementParameters, Parameter, parameters_in_force};
pub use keep_out::{KeepOut, KeepOutMap, KeepOutPattern, KeepOuts, Way};
pub use letter::Letter;
pub use line_type::{LineType, LineTypeAliases};
pub use matrix::{ElementClass, Use};
pub use names::{
    FilePattern, NameRange, PathKey, PathLayer, PathName, PathPattern, PatternError, RangeTable, SpeltName,
    is_q_project, judge_file_name, q_project_name, tested_by_q_project,
};
pub use number::{parse_integer, parse_number};
pub use path::{
    Bars, ChainParameters, CutParameters, Helix, Hole, Path, Probe, Segment, SegmentKind, Subpath,
    SubpathName, SubpathValue, Turn,
};
pub use q_project::{Component, QProject, QProjectFindings, QProjectLine, judge_q_project, plan_q_project};
pub use raw::{DrawnElements, Language, Position, RawFile, RawPath, SourceMap};
pub use read::{
    AssignedElement, AssignedText, NearNames, ProxyLine, assigned_texts, keep_outs, may_be_stray_text,
    proxy_lines, raw_file, stray_findings,
};
pub use text::{LetterValue, ParameterText, ParameterTexts, TextId};
pub use text_circle::TextCircle;
pub use variables::Bindings;
pub use walk::{WalkedPath, walk, walk_watched};
