//! What is to be done for one path: which files it becomes.

use std::collections::{BTreeMap, BTreeSet};

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::{SourceFile, Target, path_names};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::outputs as messages;

use super::deliver::{Delivered, cannot_write};
use crate::context::Context;
use crate::session::{CheckedTarget, Emitted, OutputKind, Provenance, Session, stem_fault};

/// A path without errors, and the files that it becomes.
pub(super) struct Job {
    /// The path.
    pub(super) target: Target,
    /// The drawings that it is made from, its own first.
    pub(super) sources: Vec<SourceFile>,
    /// The path's name, as the drawing spells it.
    pub(super) path: Box<str>,
    /// The name of its files without what tells them apart, with the directory.
    pub(super) stem: Utf8PathBuf,
    /// Its files.
    pub(super) files: Vec<(OutputKind, Utf8PathBuf)>,
    /// Out of what it is made.
    pub(super) provenance: Provenance,
}

impl Job {
    /// The path and its drawing, for messages.
    fn name(&self, session: &Session<'_>) -> String {
        let db = session.db();
        format!("{} ({})", self.path, self.target.file(db).path(db))
    }

    /// What came of it when it was not finished.
    pub(super) fn given_up(&self, session: &Session<'_>, problem: Diagnostic) -> Delivered {
        let problem = problem.in_file(self.target.file(session.db()).path(session.db())).in_path(&self.path);
        Delivered { problems: vec![problem], ..Delivered::default() }
    }
}

/// The jobs for the paths that are right. Two that would write the same file are both refused (PB514).
pub(super) fn jobs(
    context: &Context,
    session: &Session<'_>,
    checked: &[CheckedTarget],
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<Job> {
    let mut jobs = Vec::new();
    for checked in checked {
        let Some(emitted) = &checked.emitted else { continue };
        match job(context, session, checked, emitted) {
            Ok(job) => jobs.push(job),
            Err(problem) => diagnostics.push(*problem),
        }
    }
    let refused = clashes(session, &jobs, diagnostics);
    let mut index = 0..;
    jobs.retain(|_| index.next().is_none_or(|index| !refused.contains(&index)));
    jobs
}

fn job(
    context: &Context,
    session: &Session<'_>,
    checked: &CheckedTarget,
    emitted: &Emitted,
) -> Result<Job, Box<Diagnostic>> {
    let db = session.db();
    let file = checked.target.file(db);
    let is_alone = path_names(db, file).len() == 1;
    let name = if is_alone { file.path(db).file_stem().unwrap_or_default() } else { &emitted.path };
    let name = format!("{name}{}", emitted.suffix);
    if stem_fault(&name) {
        let reason = context.choose(
            "R holds a character that cannot be in a file's name",
            "R enthält ein Zeichen, das in keinem Dateinamen stehen kann",
        );
        return Err(Box::new(cannot_write(&name, reason).in_file(file.path(db)).in_path(&emitted.path)));
    }
    let stem = output_directory(context, session, file).join(name);
    let files = OutputKind::of(emitted.has_probes).iter();
    Ok(Job {
        target: checked.target,
        sources: checked.files.clone(),
        path: emitted.path.clone(),
        files: files.map(|kind| (*kind, Utf8PathBuf::from(format!("{stem}{}", kind.suffix())))).collect(),
        stem,
        provenance: Provenance::new(db, &emitted.path, &checked.files, &context.settings),
    })
}

/// Where the files of a drawing's paths go: beside it, or where the configuration says.
pub(super) fn output_directory(context: &Context, session: &Session<'_>, drawing: SourceFile) -> Utf8PathBuf {
    match &context.settings.general.out_dir.value {
        Some(directory) => session.normal(directory),
        None => drawing.path(session.db()).parent().unwrap_or(Utf8Path::new("")).to_owned(),
    }
}

/// The jobs that would write the same file as another. Case does not count, since on some systems it does not.
fn clashes(session: &Session<'_>, jobs: &[Job], diagnostics: &mut Vec<Diagnostic>) -> BTreeSet<usize> {
    let mut owners: BTreeMap<String, (&Utf8Path, Vec<usize>)> = BTreeMap::new();
    for (index, job) in jobs.iter().enumerate() {
        for (_, path) in &job.files {
            owners.entry(path.as_str().to_lowercase()).or_insert((path, Vec::new())).1.push(index);
        }
    }
    let mut refused = BTreeSet::new();
    for (path, owners) in owners.into_values().filter(|(_, owners)| owners.len() > 1) {
        // Of several files that both would write the first tells all.
        if owners.iter().any(|owner| !refused.contains(owner)) {
            let db = session.db();
            let problem = Diagnostic::new(&messages::SAME_OUTPUT)
                .with("name", path.file_name().unwrap_or_default())
                .with("first", jobs[owners[0]].name(session))
                .with("second", jobs[owners[1]].name(session))
                .in_file(jobs[owners[0]].target.file(db).path(db));
            diagnostics.push(problem);
        }
        refused.extend(owners);
    }
    refused
}
