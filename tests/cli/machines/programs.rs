//! The programs of the recorded cases, without duplicates.

use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

use camino::{Utf8Path, Utf8PathBuf};
use clap::Parser;
use pathbuild::args::Cli;
use pathbuild_db::system::OsSystem;
use pathbuild_db::{Role, program};
use pathbuild_motion::Step;
use pathbuild_toolpath::Program;
use pathbuild_workspace::config::Settings;
use pathbuild_workspace::session::Session;
use pathbuild_workspace::{Inputs, SilentReporter, Workspace, config};
use rayon::prelude::*;

use crate::conformance::recorded::{self, Run, What};
use crate::support;

#[derive(Clone)]
pub(crate) struct Named {
    pub(crate) name: String,
    pub(crate) program: Arc<Program>,
}

/// Returns all programs of the cases; of equal ones, only the first.
pub(crate) fn programs() -> &'static [Named] {
    static PROGRAMS: OnceLock<Vec<Named>> = OnceLock::new();
    PROGRAMS.get_or_init(|| {
        let fixtures = support::project().join("fixtures/conformance");
        let mut folders: Vec<_> = ["cases", "turns"].map(|name| fixtures.join(name)).into();
        folders.extend(support::shared("conformance/foreign"));
        let found: Vec<Named> = recorded::runs(&folders).par_iter().flat_map(of_run).collect();
        let mut distinct: BTreeMap<String, Named> = BTreeMap::new();
        for named in found {
            distinct.entry(format!("{:?}", named.program)).or_insert(named);
        }
        assert!(distinct.len() > 100, "{}", distinct.len());
        let mut programs: Vec<Named> = distinct.into_values().collect();
        programs.sort_by(|a, b| a.name.cmp(&b.name));
        programs
    })
}

/// Returns the programs of a run, without those of erroneous paths.
fn of_run(run: &Run) -> Vec<Named> {
    let What::Compile(arguments) = &run.what else { return Vec::new() };
    let case = Utf8PathBuf::from_path_buf(run.case.clone()).unwrap();
    let line = [vec!["pathbuild".to_owned()], arguments.clone()].concat();
    let cli = Cli::try_parse_from(&line).unwrap();
    let (mut settings, faults) =
        config::load(&OsSystem::shared(), &cli.common.overrides(), &Inputs::default(), &case);
    if !faults.is_empty() {
        return Vec::new();
    }
    let general = &mut settings.general;
    for value in [&mut general.feed.value, &mut general.rapid.value, &mut general.sweep_height.value] {
        value.get_or_insert(100.0);
    }
    let inputs = cli.command.inputs().inputs.into_iter().map(|input| absolute(&case, input)).collect();
    of_inputs(settings, inputs, &run.name())
}

/// Returns the programs of drawings and paths, without erroneous ones.
pub(crate) fn of_inputs(settings: Settings, inputs: Vec<String>, name: &str) -> Vec<Named> {
    let workspace = Workspace {
        settings,
        system: Arc::new(OsSystem),
        own_lang: None,
        system_lang: None,
        working_directory: Utf8PathBuf::new(),
        jobs: Some(1),
        cache: None,
        reporter: Arc::new(SilentReporter),
        is_date_decisive: Arc::default(),
    };
    let session = Session::new(&workspace);
    let wanted = session.select(&Inputs { inputs });
    let mut targets: Vec<_> = wanted
        .paths
        .iter()
        .map(|path| session.db().target(path.file, path.name.as_str(), Role::Emitted))
        .collect();
    for file in wanted.whole_drawings(&session) {
        targets.extend(session.targets(file, &Role::Emitted));
    }
    let checked = session.check(&targets);
    let sound = checked.iter().filter(|checked| checked.emitted.is_some());
    let named = sound.filter_map(|checked| {
        let program = program(session.db(), checked.target).clone()?;
        Some(Named { name: format!("{name} {}", program.path), program })
    });
    named.collect()
}

/// Returns an input as a file in the directory of its case, if there is such a file.
fn absolute(case: &Utf8Path, input: String) -> String {
    let file = case.join(&input);
    if file.as_std_path().exists() { file.into_string() } else { input }
}

/// Returns the moves of a program as steps, as its native text would give, with step numbers in place of lines.
pub(crate) fn steps_of(program: &Program) -> Vec<Step> {
    program.moves().map(|(line, it)| Step::of_move(line, it)).collect()
}
