//! Converts drawings in text form to programs.

use pathbuild_dxf::Options;
use pathbuild_path::{
    Bindings, Language, LineTypeAliases, Path, PathOptions, PathPattern, SegmentKind, SubpathName,
    WalkedPath, bind, raw_file, walk,
};
use pathbuild_testkit::sheet;
use pathbuild_toolpath::{
    Comment, Count, FoldPaths, Names, PlannedMove, Program, ProgramStep, fold, own_moves,
};

/// The paths of a drawing, which may embed each other.
struct PathsOfDrawing(Vec<(Path, WalkedPath)>);

impl FoldPaths for PathsOfDrawing {
    type Id = usize;

    fn path(&self, id: usize) -> &Path {
        &self.0[id].0
    }

    fn walked(&self, id: usize) -> &WalkedPath {
        &self.0[id].1
    }

    fn embedded(&self, id: usize, segment: usize) -> Option<usize> {
        let SegmentKind::Subpath(subpath) = &self.path(id).segments[segment].kind else { return None };
        let SubpathName::Found { name, .. } = &subpath.name else { return None };
        self.0.iter().position(|(path, _)| path.name == *name)
    }
}

pub(crate) const OPTIONS: PathOptions =
    PathOptions { feed: Some(100.0), sweep_height: Some(10.0), probe_feed: None, compatible: false };

pub(crate) const COMPATIBLE: PathOptions = PathOptions { compatible: true, ..OPTIONS };

/// Returns the program of the first path of a drawing.
#[track_caller]
pub(crate) fn program(drawing: &str) -> Program {
    program_with(drawing, OPTIONS)
}

#[track_caller]
pub(crate) fn program_with(drawing: &str, options: PathOptions) -> Program {
    fold(&drawn(drawing), 0, "1234.1P.dxf", options, 0)
}

/// Returns the estimated number of moves of the first path of a drawing.
#[track_caller]
pub(crate) fn estimate(drawing: &str) -> u64 {
    let PathsOfDrawing(paths) = drawn(drawing);
    own_moves(&paths[0].0, &paths[0].1)
}

#[track_caller]
fn drawn(drawing: &str) -> PathsOfDrawing {
    let sheet = sheet(drawing).unwrap_or_else(|faults| panic!("{faults:?} in\n{drawing}"));
    let language = Language {
        path_pattern: PathPattern::default(),
        keep_out: None,
        part: None,
        line_types: LineTypeAliases::default(),
        text_limit: 65_536,
        doubts: pathbuild_path::DoubtThresholds::default(),
        tools: pathbuild_path::PathTools::default(),
        join_tolerance: 0.0,
    };
    let reading = Options {
        note_text: None,
        keep_layer: &|layer| language.path_pattern.layer(layer).is_some(),
        units: pathbuild_dxf::Units::Header,
        approximate_curves: 0.0,
        max_entities: 10_000,
        max_text: 65_536,
        compatible: false,
    };
    let file = raw_file(&pathbuild_dxf::read(&sheet.to_dxf(), &reading), &language);
    let walked = |raw: &pathbuild_path::RawPath| {
        let (path, found) = bind(raw, &Bindings::check_values(&raw.definitions), &language);
        let path = path.unwrap_or_else(|| panic!("{:?} {found:?} in\n{drawing}", raw.diagnostics));
        let walked = walk(&path, 0.0);
        assert!(!walked.items.is_empty(), "{:?} in\n{drawing}", walked.diagnostics);
        (path, walked)
    };
    PathsOfDrawing(file.paths.iter().map(|(raw, _)| walked(raw)).collect())
}

/// Returns a drawing of a path with these parameters and its start at (0, 0).
pub(crate) fn path(parameters: &str, statements: &str) -> String {
    format!("layer 1234.1P\nstart 0,0 \"{parameters}\"\n{statements}")
}

/// Returns the moves of the first path of a drawing.
#[track_caller]
pub(crate) fn moves(drawing: &str) -> Vec<String> {
    shown(&program(drawing), false)
}

/// Returns the moves, with Q comments and the comments of subpaths.
#[track_caller]
pub(crate) fn moves_and_comments(drawing: &str) -> Vec<String> {
    shown(&program(drawing), true)
}

pub(crate) fn shown(program: &Program, with_comments: bool) -> Vec<String> {
    let show = |step: &ProgramStep| match step {
        ProgramStep::Move { to, .. } => Some(motion(to)),
        ProgramStep::Comment(shown) if with_comments => comment(shown, &program.names),
        ProgramStep::Comment(_) => None,
    };
    program.steps.iter().filter_map(show).collect()
}

fn comment(comment: &Comment, names: &Names) -> Option<String> {
    match comment {
        Comment::Question(text) => Some(format!("Q {}", names.get(*text))),
        Comment::StartSubpath(name) => Some(format!("START {}", names.get(*name))),
        Comment::EndSubpath(name) => Some(format!("END {}", names.get(*name))),
        Comment::Element { .. } | Comment::Pass { .. } => None,
    }
}

fn motion(motion: &PlannedMove) -> String {
    match motion {
        PlannedMove::Sweep { to } => format!("S {},{}", short(to.x), short(to.y)),
        PlannedMove::Lift { z } => format!("L {}", short(z.z)),
        PlannedMove::Drill { z, .. } => format!("D {}", short(z.z)),
        PlannedMove::Line { to, z, .. } => format!("M {},{} {}", short(to.x), short(to.y), short(z.z)),
        PlannedMove::Arc { clockwise, to, z, .. } => {
            let direction = if *clockwise { "C" } else { "A" };
            format!("{direction} {},{} {}", short(to.x), short(to.y), short(z.z))
        }
    }
}

/// Formats a number with up to three decimals.
pub(crate) fn short(number: f64) -> String {
    let number = format!("{number:.3}");
    let number = number.trim_end_matches('0').trim_end_matches('.');
    if number == "-0" { "0".to_owned() } else { number.to_owned() }
}

/// Returns how each move is counted: class, length, and feed unless it is the rapid one.
#[track_caller]
pub(crate) fn counts(drawing: &str) -> Vec<String> {
    let count = |count: &Count| {
        let feed = count.feed.map(|feed| format!(" {}", short(feed))).unwrap_or_default();
        format!("{:?} {}{feed}", count.class, short(count.length))
    };
    let of_step = |step: &ProgramStep| match step {
        ProgramStep::Move { count: counted, .. } => Some(count(counted)),
        ProgramStep::Comment(_) => None,
    };
    program(drawing).steps.iter().filter_map(of_step).collect()
}
