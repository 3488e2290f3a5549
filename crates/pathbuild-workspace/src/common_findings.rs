//! Findings that belong to no single drawing. (book: reference/configuration, book: language/keep-outs)

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::Db;
use pathbuild_db::system::{FileKind, join};
use pathbuild_diagnostic::messages::{configuration, outputs};
use pathbuild_diagnostic::{Diagnostic, Message};

use crate::config::SourcedValue;
use crate::config::types::Pattern;
use crate::files;
use crate::memo::DrawingResult;
use crate::session::Session;

/// Returns a warning for each configuration in the searched directories that does not apply to the run. Directories outside the tree of the applied
/// configuration are skipped: for them, `--config` has chosen a configuration of another tree.
pub(crate) fn unused_configurations(session: &Session<'_>, directories: &[Utf8PathBuf]) -> Vec<Diagnostic> {
    let system = session.db().system();
    let used = session.workspace().settings.file.as_deref().map(|file| session.normalize(file));
    let tree = used.as_deref().and_then(Utf8Path::parent);
    let files = directories.iter().map(|directory| join(directory, files::FILE_NAME));
    let is_unused = |file: &Utf8PathBuf| {
        tree.is_none_or(|tree| file.starts_with(tree))
            && used.as_ref() != Some(file)
            && system.kind(file) != FileKind::Missing
    };
    let warning = |file: Utf8PathBuf| {
        let problem = match &used {
            Some(used) => {
                Diagnostic::new(&configuration::UNUSED_CONFIGURATION).quoting("used", used.as_str())
            }
            None => Diagnostic::new(&configuration::UNUSED_WITHOUT_ANY),
        };
        problem.in_file(&file)
    };
    files.filter(is_unused).map(warning).collect()
}

/// The program numbers that controls with numbered programs reserve for macros.
const MACRO_NUMBERS: RangeInclusive<u32> = 9000..=9999;

/// Returns PB530 for programs with the same number, and for programs with a number that is reserved for macros. Each program is given by its number,
/// its name, and the file to which its finding refers.
pub(crate) fn number_warnings(programs: &[(u32, String, Utf8PathBuf)]) -> Vec<Diagnostic> {
    let mut by_number: BTreeMap<u32, Vec<&(u32, String, Utf8PathBuf)>> = BTreeMap::new();
    for program in programs {
        by_number.entry(program.0).or_default().push(program);
    }
    let mut problems = Vec::new();
    for (number, programs) in by_number {
        let (_, name, file) = programs[0];
        let number_of = |problem: Diagnostic| problem.with("number", u64::from(number)).in_file(file);
        if MACRO_NUMBERS.contains(&number) {
            problems.push(number_of(Diagnostic::new(&outputs::NUMBER_RESERVED).quoting("name", &**name)));
        }
        if let Some((_, second, _)) = programs.get(1) {
            let problem = Diagnostic::new(&outputs::NUMBER_SHARED).with("count", programs.len());
            problems.push(number_of(problem.quoting("first", &**name).quoting("second", &**second)));
        }
    }
    problems
}

/// Returns PB527 for each of the patterns `keep-out` and `part` that matches no layer of the library, given the results of all its drawings. Returns
/// nothing if there are no drawings, or if one of them could not be read, because it may contain such layers; nor in compatible mode.
pub(crate) fn patterns_without_layer<'a>(
    session: &Session<'_>,
    mut library: impl Iterator<Item = &'a DrawingResult> + Clone,
) -> Vec<Diagnostic> {
    let has_all = library.clone().next().is_some() && !library.clone().any(DrawingResult::is_unread);
    if !has_all || session.is_compatible() {
        return Vec::new();
    }
    let settings = &session.workspace().settings;
    let problem = |pattern: &SourcedValue<Option<Box<str>>>, message: &'static Message| {
        let problem = Diagnostic::new(message).quoting("pattern", pattern.value.as_deref()?);
        Some(settings.locate(problem, pattern.origin))
    };
    let clamps = || problem(&settings.general.keep_out, &outputs::NO_CLAMP_LAYER);
    let parts = || problem(&settings.general.part, &outputs::NO_PART_LAYER);
    let has_clamps = library.clone().any(|drawing| drawing.layers.has_clamps);
    let has_parts = library.any(|drawing| drawing.layers.has_parts);
    let clamps = (!has_clamps).then(clamps).flatten();
    clamps.into_iter().chain((!has_parts).then(parts).flatten()).collect()
}

/// Returns PB529 for each glob of `[[severity-in]]` that matches none of these drawings of the library, and no drawing or program in the
/// configuration's tree. Globs for programs are not judged in a tree without programs, where `emit` may not have run yet.
pub(crate) fn globs_without_file<'a>(
    session: &Session<'_>,
    library: impl Iterator<Item = &'a Utf8Path>,
) -> Vec<Diagnostic> {
    let workspace = session.workspace();
    let (settings, severities) = (&workspace.settings, workspace.severities());
    let (Some(configuration_file), Some(directory)) = (&settings.file, settings.directory()) else {
        return Vec::new();
    };
    let entries = &settings.tables.severity_in.value;
    let globs = entries.iter().flat_map(|entry| entry.files.iter().map(|glob| (entry.waiver.line, glob)));
    let mut open: Vec<(u32, &Pattern)> = globs.collect();
    if open.is_empty() {
        return Vec::new();
    }
    let library: Vec<String> = library.map(|drawing| severities.configured_name(drawing)).collect();
    open.retain(|(_, glob)| !library.iter().any(|drawing| glob.matches(drawing)));
    if open.is_empty() {
        return Vec::new();
    }
    let found = session.drawings_and_programs_below(directory);
    let has_programs = found.iter().any(|file| files::is_program(file));
    let found: Vec<String> = found.iter().map(|file| severities.configured_name(file)).collect();
    let out_dir = session.out_dir().map(|directory| severities.configured_name(&directory));
    let is_for_programs = |glob: &Pattern| {
        let is_in_out_dir = |directory: &String| glob.text().starts_with(directory.as_str());
        files::is_program(Utf8Path::new(glob.text())) || out_dir.as_ref().is_some_and(is_in_out_dir)
    };
    open.retain(|(_, glob)| has_programs || !is_for_programs(glob));
    open.retain(|(_, glob)| !found.iter().any(|file| glob.matches(file)));
    let warning = |(line, glob): (u32, &Pattern)| {
        let problem = Diagnostic::new(&configuration::GLOB_WITHOUT_FILE).quoting("glob", glob.text());
        problem.in_file(configuration_file).at_line(line, Some(1))
    };
    open.into_iter().map(warning).collect()
}
