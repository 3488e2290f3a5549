//! Reports programs on disk whose paths could not be written now: they show an earlier state of the drawing. (PB522)

use std::collections::{BTreeSet, HashMap, HashSet};

use camino::Utf8PathBuf;
use pathbuild_db::system::{Names, join};
use pathbuild_db::{Db, Target};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::outputs as messages;
use pathbuild_gcode::native;
use pathbuild_gcode::provenance::{HEAD, Provenance};

use super::Request;
use super::deliver::{ProgramOutcome, State, Task};
use super::job::{Job, output_directory, program_name};
use super::stale::is_gcode;
use crate::posting::PostProcessor;
use crate::session::Session;

/// Finds the programs on disk of targets for which nothing was written or compared. Each becomes an outcome of its own; a comparison counts
/// it as out of date.
pub(super) fn programs(
    session: &Session<'_>,
    request: &Request<'_>,
    targets: &[Target],
    jobs: &[Job],
    delivered: &[ProgramOutcome],
    diagnostics: &mut Vec<Diagnostic>,
) -> Vec<ProgramOutcome> {
    match (request.task, request.join, request.post_processor) {
        (Task::Print, ..) => Vec::new(),
        (task, Some(name), Some(post_processor)) => {
            let is_done = delivered.iter().any(|delivered| !delivered.files.is_empty());
            let joined = targets.first().filter(|_| !is_done);
            let program = joined.and_then(|first| of_joined(session, *first, name, post_processor));
            program.map(|program| older(program, name, task)).into_iter().collect()
        }
        (task, _, post_processor) => {
            let done = jobs.iter().zip(delivered).filter(|(_, delivered)| !delivered.files.is_empty());
            let done: HashSet<Target> = done.flat_map(|(job, _)| job.targets.iter().copied()).collect();
            let open = targets.iter().filter(|target| !done.contains(target));
            let mut listings = Listings::default();
            let older = |target: &Target| {
                let programs = of_target(session, *target, post_processor, &mut listings).into_iter();
                programs.map(|program| older(program, target.name(session.db()), task)).collect::<Vec<_>>()
            };
            let older = open.flat_map(older).collect();
            diagnostics.append(&mut listings.problems);
            older
        }
    }
}

/// Programs in output directories, each of which is listed once.
#[derive(Default)]
struct Listings {
    programs: HashMap<Utf8PathBuf, Vec<(String, Utf8PathBuf)>>,
    problems: Vec<Diagnostic>,
}

impl Listings {
    /// Programs in a directory whose names begin with `stem`, ignoring case.
    fn beginning(
        &mut self,
        (session, post_processor): (&Session<'_>, Option<&PostProcessor>),
        directory: &Utf8PathBuf,
        stem: &str,
    ) -> impl Iterator<Item = &Utf8PathBuf> {
        let programs = self.programs.entry(directory.clone()).or_insert_with(|| {
            let names = session.file_names_in(directory).unwrap_or_else(|problem| {
                self.problems.push(*problem);
                Names::default()
            });
            let programs = names.iter().filter(|name| is_gcode(name, post_processor));
            let mut programs: Vec<_> =
                programs.map(|name| (name.to_lowercase(), join(directory, name))).collect();
            programs.sort_unstable();
            programs
        });
        let stem = stem.to_lowercase();
        let first = programs.partition_point(|(name, _)| *name < stem);
        programs[first..]
            .iter()
            .take_while(move |(name, _)| name.starts_with(&stem))
            .map(|(_, program)| program)
    }
}

fn older(program: Utf8PathBuf, path: &str, task: Task) -> ProgramOutcome {
    let problem = Diagnostic::new(&messages::OLDER_OUTPUT)
        .quoting("name", program.file_name().unwrap_or_default())
        .quoting("path", path)
        .in_file(&program);
    let is_compared = matches!(task, Task::Compare { .. });
    let files = is_compared.then_some((program, State::Outdated)).into_iter().collect();
    ProgramOutcome { path: path.into(), files, problems: vec![problem], ..ProgramOutcome::default() }
}

/// The names begin with that of the drawing or of the path, whatever R was; the head of each program names its path.
fn of_target(
    session: &Session<'_>,
    target: Target,
    post_processor: Option<&PostProcessor>,
    listings: &mut Listings,
) -> Vec<Utf8PathBuf> {
    let (db, system) = (session.db(), session.db().system());
    let (drawing, path) = (target.file(db).path(db), &**target.name(db));
    let directory = output_directory(session, target.file(db));
    let stems = [drawing.file_stem().unwrap_or_default(), path];
    let drawing = drawing.file_name().unwrap_or_default();
    let is_of_target = |program: &Utf8PathBuf| {
        let head = system.head(program, HEAD).unwrap_or_default();
        Provenance::of_head(&head).is_some_and(|(_, found)| native::is_title(&found, drawing, path))
    };
    let mut programs = BTreeSet::new();
    for stem in stems {
        programs.extend(listings.beginning((session, post_processor), &directory, stem).cloned());
    }
    programs.into_iter().filter(is_of_target).collect()
}

/// The program that the targets were joined into earlier.
fn of_joined(
    session: &Session<'_>,
    first: Target,
    name: &str,
    post_processor: &PostProcessor,
) -> Option<Utf8PathBuf> {
    let directory = output_directory(session, first.file(session.db()));
    let program = join(&directory, program_name(name, post_processor));
    let head = session.db().system().head(&program, HEAD).unwrap_or_default();
    Provenance::of_head(&head).map(|_| program)
}
