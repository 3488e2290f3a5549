//! Compiles drawings in text form.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_dxf::{Options, Units};
use pathbuild_path::{
    Bindings, Curve, DoubtThresholds, Item, Language, LineTypeAliases, PartiallyBoundPath, Path, PathPattern,
    RawFile, RawPath, WalkedPath, Xy, bind_leniently, raw_file, walk,
};
use pathbuild_testkit::sheet;

pub(crate) struct Compiled {
    pub(crate) path: Option<Path>,
    pub(crate) walked: WalkedPath,
    /// The findings, in the order of the stages.
    pub(crate) found: Vec<Diagnostic>,
}

impl Compiled {
    #[track_caller]
    pub(crate) fn first_chain(&self) -> Vec<Curve> {
        let (Some(path), Some(Item::Chain(chain))) = (&self.path, self.walked.items.first()) else {
            panic!()
        };
        self.walked.members(chain).iter().map(|member| member.curve(path)).collect()
    }
}

/// Thresholds that disable doubts about values that are odd in tests of other rules.
const NO_DOUBTS: DoubtThresholds = DoubtThresholds {
    below_plate: f64::INFINITY,
    infeed: f64::INFINITY,
    mark_depth: f64::INFINITY,
    has_cycles: true,
    text_margin: 0.0,
    hole_margin: 0.0,
    ..DoubtThresholds::DEFAULT
};

pub(crate) fn language() -> Language {
    Language {
        path_pattern: PathPattern::default(),
        keep_out: None,
        part: None,
        line_types: LineTypeAliases::default(),
        text_limit: 65_536,
        doubts: NO_DOUBTS,
        tools: pathbuild_path::PathTools::default(),
        join_tolerance: 0.0,
    }
}

pub(crate) fn read(drawing: &str) -> RawFile {
    read_as(drawing, &language())
}

pub(crate) fn read_as(drawing: &str, language: &Language) -> RawFile {
    let sheet = sheet(drawing).unwrap_or_else(|faults| panic!("{faults:?} in\n{drawing}"));
    let options = Options {
        keep_layer: &|layer| language.path_pattern.layer(layer).is_some(),
        note_text: None,
        units: Units::Header,
        approximate_curves: 0.0,
        max_entities: 10_000,
        max_text: 65_536,
        compatible: false,
    };
    raw_file(&pathbuild_dxf::read(&sheet.to_dxf(), &options), language)
}

/// Reads the only path of a drawing, without binding its parameters.
pub(crate) fn raw(drawing: &str) -> RawPath {
    let mut paths = read(drawing).paths;
    assert_eq!(paths.len(), 1, "paths in\n{drawing}");
    paths.remove(0).0
}

/// Compiles the first path of a drawing with example values.
pub(crate) fn compile(drawing: &str) -> Compiled {
    let (raw, _) = read(drawing).paths.into_iter().next().expect("there is a path");
    compile_raw(&raw, &Bindings::check_values(&raw.definitions), &language())
}

/// Compiles a path stage by stage. Each stage suppresses findings that follow from earlier ones.
pub(crate) fn compile_raw(raw: &RawPath, bindings: &Bindings, language: &Language) -> Compiled {
    let mut compiled = Compiled { path: None, walked: WalkedPath::default(), found: raw.diagnostics.clone() };
    let PartiallyBoundPath { path, problems } = bind_leniently(raw, bindings, language);
    compiled.found.extend(problems);
    if let Some(path) = &path {
        compiled.walked = walk(path, language.join_tolerance);
        compiled.found.extend(compiled.walked.diagnostics.iter().cloned());
    }
    compiled.path = path.filter(|path| !path.has_faults());
    compiled
}

/// Returns the codes of findings with their letters.
pub(crate) fn codes(found: &[Diagnostic]) -> Vec<String> {
    let code = |found: &Diagnostic| {
        let letter = found.arguments.iter().find(|(name, _)| *name == "letter");
        let letter = letter.map(|(_, letter)| format!(" {}", letter.render(pathbuild_diagnostic::Lang::En)));
        format!("{}{}", found.code(), letter.unwrap_or_default())
    };
    found.iter().map(code).collect()
}

/// Returns the codes of the findings about the first path of a drawing.
pub(crate) fn wrong(drawing: &str) -> Vec<String> {
    codes(&compile(drawing).found)
}

/// Returns a drawing of one path, with the text of its start at (0, 0) and further statements.
pub(crate) fn path(parameters: &str, statements: &str) -> String {
    format!("layer 1234.1P\nstart 0,0 \"{parameters}\"\n{statements}")
}

/// Returns the operations along the first path of a drawing, one line for each item, with chains in brackets.
#[track_caller]
pub(crate) fn items(drawing: &str) -> Vec<String> {
    let compiled = compile(drawing);
    let errors: Vec<&Diagnostic> = compiled.found.iter().filter(|found| found.is_error()).collect();
    assert!(errors.is_empty(), "{errors:?} in\n{drawing}");
    items_of(&compiled)
}

/// Returns the operations along a compiled path in the same form; none if it has errors.
pub(crate) fn items_of(compiled: &Compiled) -> Vec<String> {
    let Some(path) = &compiled.path else { return Vec::new() };
    compiled.walked.items.iter().map(|it| item(path, &compiled.walked, it)).collect()
}

fn item(path: &Path, walked: &WalkedPath, item: &Item) -> String {
    match item {
        Item::Chain(chain) => {
            let member = |member: &pathbuild_path::ChainSegment| {
                let back = if member.is_return { " back" } else { "" };
                let curve = member.curve(path);
                format!("{}{back}", ends(curve.start(), curve.end()))
            };
            format!("[{}]", walked.members(chain).iter().map(member).collect::<Vec<_>>().join(", "))
        }
        Item::Hole { segment, .. } => format!("hole {}", point(path.ends(&path.segments[*segment])[0])),
        Item::Helix { helix, .. } => {
            let helix = &path.helices[*helix as usize];
            format!("helix {} r{}", point(helix.centre), helix.radius)
        }
        Item::Sweep(sweep) => format!("sweep {}", ends(sweep.start, sweep.end)),
        Item::Subpath(subpath) => format!("subpath {}", ends(subpath.start, subpath.end)),
    }
}

fn ends(start: Xy, end: Xy) -> String {
    format!("{} {}", point(start), point(end))
}

fn point(point: Xy) -> String {
    format!("{},{}", point.x, point.y)
}
