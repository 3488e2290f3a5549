//! What is asked of a path by whoever embeds it or judges it: little, so that it stays in memory when the path itself does not, and so that
//! an edit that changes none of it ends here.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::{Bindings, Definition, Path, PathName, RawPath, SegmentKind, Walked};
use pathbuild_toolpath::own_moves;
use smol_str::SmolStr;

use super::hints::with_other_layers;
use super::instance::{BoundPath, Instance, bind_raw, chains, path, walk};
use super::raw::NameKey;
use super::surveys::surveyed;
use crate::database::Db;
use crate::inputs::SourceFile;

/// What is known of a path before its variables have values.
#[derive(Clone, Debug, PartialEq)]
pub struct Head {
    /// As its layer spells it.
    pub name: PathName,
    /// Whether its drawing alone is in order.
    pub is_sound: bool,
    /// The variables that it defines.
    pub definitions: Vec<Definition>,
}

/// What came of a path with values for its variables.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Summary {
    /// What is wrong with its drawing or its values.
    pub problems: Vec<Diagnostic>,
    /// The path in short, where none of these is an error.
    pub brief: Option<Brief>,
}

/// A path in short. Lengths in mm.
#[derive(Clone, Debug, PartialEq)]
pub struct Brief {
    /// As its layer spells it.
    pub name: PathName,
    /// O.
    pub tool: f64,
    /// T.
    pub thickness: f64,
    /// M.
    pub material: Option<SmolStr>,
    /// R.
    pub output_suffix: SmolStr,
    /// How far its end is from its start.
    pub size: f64,
    /// Whether anything in it is milled at the feed of the options.
    pub needs_feed: bool,
    /// Whether it has Z-probes of its own.
    pub has_probes: bool,
    /// Whether it has subpath segments.
    pub has_subpaths: bool,
    /// What is wrong with the sweep height that it has where it is embedded or checked.
    pub sweep_problems: Vec<Diagnostic>,
    /// What is wrong with the way along it.
    pub walk_problems: Vec<Diagnostic>,
    /// About how many moves it has without what it embeds.
    pub moves: u64,
}

/// What is known of a path of a file before its variables have values.
pub fn head<'db>(db: &'db dyn Db, file: SourceFile, name: NameKey<'db>) -> Option<&'db Head> {
    match surveyed(db, file) {
        Some(survey) => survey.path(&name.name(db)).map(|path| &path.head),
        None => query::head(db, file, name).as_ref(),
    }
}

/// Binds a path, walks along it, and keeps what others need to know.
pub fn summary<'db>(db: &'db dyn Db, instance: Instance<'db>) -> &'db Summary {
    let survey = surveyed(db, instance.file(db));
    let path = survey.and_then(|survey| survey.path(&instance.name(db).name(db)));
    let known = path.and_then(|path| path.summary_with(instance.bindings(db)));
    known.unwrap_or_else(|| query::summary(db, instance))
}

/// As they are asked where drawings are not surveyed.
mod query {
    use super::{Head, Summary, new_summary, summary_of_kept};
    use crate::database::Db;
    use crate::inputs::SourceFile;
    use crate::queries::instance::Instance;
    use crate::queries::raw::{NameKey, raw_path};

    #[salsa::tracked]
    pub(super) fn head<'db>(db: &'db dyn Db, file: SourceFile, name: NameKey<'db>) -> Option<Head> {
        raw_path(db, file, name).map(Head::new)
    }

    #[salsa::tracked]
    pub(super) fn summary<'db>(db: &'db dyn Db, instance: Instance<'db>) -> Summary {
        if db.keeps_paths() {
            return summary_of_kept(db, instance);
        }
        let raw = instance.raw(db);
        raw.map(|raw| new_summary(db, instance.file(db), raw, instance.bindings(db)).0).unwrap_or_default()
    }
}

impl Head {
    pub(super) fn new(raw: &RawPath) -> Self {
        Self { name: raw.name.clone(), is_sound: raw.is_sound(), definitions: raw.definitions.clone() }
    }
}

impl Summary {
    /// Whether there is nothing to say of the path itself.
    pub(super) fn is_clear(&self) -> bool {
        let is_clear = |brief: &Brief| brief.sweep_problems.is_empty() && brief.walk_problems.is_empty();
        self.problems.is_empty() && self.brief.as_ref().is_some_and(is_clear)
    }

    /// Whether the path has subpath segments.
    pub(super) fn has_subpaths(&self) -> bool {
        self.brief.as_ref().is_some_and(|brief| brief.has_subpaths)
    }
}

/// The summary of a path that was read from a file, with values for its variables; and the path, where nothing is an error.
pub(super) fn new_summary(
    db: &dyn Db,
    file: SourceFile,
    raw: &RawPath,
    bindings: &Bindings,
) -> (Summary, Option<Path>) {
    let BoundPath { path, diagnostics } = bind_raw(db, raw, bindings);
    let brief = path.as_ref().map(|path| brief(db, file, path, &walk(db, path)));
    (Summary { problems: diagnostics, brief }, path)
}

/// The same of a path that is kept as it was bound and walked along, since a program will be made of it.
fn summary_of_kept<'db>(db: &'db dyn Db, instance: Instance<'db>) -> Summary {
    let bound = path(db, instance);
    let brief = |path| brief(db, instance.file(db), path, chains(db, instance));
    let brief = bound.path.as_ref().map(brief);
    Summary { problems: bound.diagnostics.clone(), brief }
}

fn brief(db: &dyn Db, file: SourceFile, path: &Path, walked: &Walked) -> Brief {
    let with_hints = |found| with_other_layers(db, file, &path.name, found);
    Brief {
        name: path.name.clone(),
        tool: path.tool,
        thickness: path.thickness,
        material: path.material.clone(),
        output_suffix: path.output_suffix.clone(),
        size: (path.end - path.start).norm(),
        needs_feed: path.needs_feed(),
        has_probes: !path.probes.is_empty(),
        has_subpaths: path.segments.iter().any(|segment| matches!(segment.kind, SegmentKind::Subpath(_))),
        sweep_problems: path.check_sweep_height(path.embedded_sweep_height()),
        moves: own_moves(path, walked),
        walk_problems: walked.diagnostics.iter().cloned().map(with_hints).collect(),
    }
}
