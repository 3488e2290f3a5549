//! Scenes of paths, drawings and programs, and pictures of them.
//!
//! A [`Scene`] is plain data with one JSON form. It is built from a program with the origins of its steps, from a drawing with erroneous
//! paths, or from G-code. Renderers turn it into pictures and pages. This crate does no IO and prints nothing. (book: program/pictures)

mod build;
mod changes;
mod extent;
#[cfg(feature = "pictures")]
mod page;
#[cfg(feature = "pictures")]
mod pdf;
#[cfg(feature = "pictures")]
mod raster;
mod scene;
mod svg;

pub use build::{
    DrawnSource, GcodeSource, GcodeText, MESSAGES_IN_PROGRAM_COORDINATES, Places, ProgramSource, drawn_path,
    findings, finished_part, gcode_path, keep_out, other_layers, outline, program_path,
};
pub use changes::{Change, ChangeKind, ComparedMove, ComparedMoves, Group, compare, groups, moves, phrase};
#[cfg(feature = "pictures")]
pub use page::{LIVE_STYLE, SCRIPT, live_page, page};
#[cfg(feature = "pictures")]
pub use raster::{pdf, png, sheet_pdf};
pub use scene::{
    ArcShape, Bar, BilingualText, Element, ElementKind, EmbeddedPath, Example, Finding, FinishedPart,
    KeepOut, Label, LeftoverMaterial, MoveKind, NativeText, OtherShape, Parameter, Point, ProbeMark,
    ProgramRecord, SCHEMA, Scene, SceneMove, ScenePath, Shape, ShownCheck, Tip, ToolSpan, Totals, VERSION,
};
#[cfg(not(feature = "pictures"))]
pub use svg::sheet_pdf;
pub use svg::{
    FindingPlace, Picture, Sheet, SheetProbe, SheetTool, StockChange, VisibleParts, changes_svg, cutout_svg,
    escaped, has_stock, sheet_html, sheet_svg, stock_change_svg, stock_cutout_svg, svg,
};
