//! `pathbuild diff`: shows how changed drawings change the moves. (book: program/comparing)

mod output;
mod revision;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::Role;
use pathbuild_db::system::{FileKind, is_drawing};
use pathbuild_diagnostic::messages::outputs;
use pathbuild_diagnostic::{Diagnostic, Lang, escaping};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::interpret::{Heights, Options, Program as _, interpret};
use pathbuild_gcode::provenance::{HEAD_BYTES, Provenance};
use pathbuild_view::{GcodeSource, ScenePath, gcode_path};
use pathbuild_workspace::baseline::Baseline;
use pathbuild_workspace::diff::{
    Comparison, MachineStates, PathChangeKind, PathDiff, ProgramDiff, StateKind, Tree, compare_moves,
    compare_trees,
};
use pathbuild_workspace::emit::{ShownText, missing_values};
use pathbuild_workspace::post_processor::{PostArguments, PostProcessor};
use pathbuild_workspace::program::read;
use pathbuild_workspace::session::Session;
use pathbuild_workspace::verify::{Verifier, VerifyOptions, incomparable_with_path};
use pathbuild_workspace::{Failure, Inputs, Workspace};

use crate::args::DiffArgs;
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::render::Format;

use output::Output;
use revision::Revision;

/// Runs the command. Changed paths do not count as errors. Paths that have errors now, and therefore cannot be compared, do.
///
/// # Errors
/// If the sides cannot be read or have nothing in common to compare.
pub fn run(context: &Context, args: &DiffArgs) -> Result<ExitStatus, Failure> {
    let output = Output::of(context, args.output.as_deref()).map_err(Failure::Usage)?;
    let pictures = output.has_pictures().then(|| context.lang());
    let comparison = match sides(context, args)? {
        [Side::Drawings(old), Side::Drawings(new)] => drawings(context, &old, &new, pictures),
        [Side::Program(old), Side::Program(new)] => compare_two_programs(*old, *new, pictures),
        _ => {
            let reason = context.choose(
                "compare a program with a path or with another program",
                "ein Programm mit einem Pfad oder einem anderen Programm vergleichen",
            );
            return Err(Failure::Usage(reason.to_owned()));
        }
    };
    Ok(finish(context, &output, &comparison))
}

fn drawings(
    context: &Context,
    old: &ComparedDrawings,
    new: &ComparedDrawings,
    pictures: Option<Lang>,
) -> Comparison {
    let mut sessions = [Session::new(&old.workspace), Session::new(&new.workspace)];
    let [before, after] = &mut sessions;
    let mut before = Tree { session: before, inputs: &old.inputs, root: &old.root };
    let mut after = Tree { session: after, inputs: &new.inputs, root: &new.root };
    let mut comparison = compare_trees(&mut before, &mut after, pictures);
    for (problems, side) in comparison.problems.iter_mut().zip([old, new]) {
        side.name_files(context, problems);
    }
    comparison
}

/// Compares two programs, or a program and a path.
fn compare_two_programs(old: ComparedProgram, new: ComparedProgram, pictures: Option<Lang>) -> Comparison {
    let changed = || {
        let changed = compare_moves(&old.path, &new.path, pictures);
        let mut states = old.states.changes(&new.states);
        // Corrections by measured heights show as changed moves, so they are listed separately only if no move has changed.
        states.retain(|state| state.kind != StateKind::Correction || changed.groups.is_empty());
        let is_same = changed.groups.is_empty() && states.is_empty();
        (!is_same).then(|| PathChangeKind::Changed(Box::new(ProgramDiff { states, ..changed })))
    };
    let has_errors = [&old, &new].map(|program| !program.are_moves_known);
    let outcome = PathChangeKind::of_errors(has_errors).or_else(changed);
    let files = [&old, &new].map(|seen| Some(seen.path.file.clone().into()));
    let name = new.path.name.clone();
    let paths =
        outcome.into_iter().map(|outcome| PathDiff { name: name.clone(), files: files.clone(), outcome });
    let paths = paths.collect();
    Comparison { paths, path_count: 1, problems: [old.problems, new.problems] }
}

fn finish(context: &Context, output: &Output, comparison: &Comparison) -> ExitStatus {
    let findings = context.findings(comparison.problems.concat());
    match context.format {
        Format::Json => output::rows(context, comparison),
        format if format.is_for_machines() => {}
        _ => context.printer.result(output::text(comparison, context.lang())),
    }
    context.show(&findings);
    if let Err(problem) = output.deliver(context, comparison) {
        return context.fail(vec![*problem]);
    }
    let is_broken =
        |path: &PathDiff| matches!(path.outcome, PathChangeKind::Broken | PathChangeKind::StillBroken);
    // Errors of old drawings do not decide the status, unless something was not compared because of them.
    let decides = |problem: &&Diagnostic| {
        !problem.file.as_deref().is_some_and(is_drawing) || !Baseline::may_accept(problem)
    };
    let [old, new] = &comparison.problems;
    let has_errors = context.has_error(old.iter().filter(decides).chain(new));
    if has_errors || comparison.paths.iter().any(is_broken) {
        ExitStatus::Errors
    } else {
        ExitStatus::Success
    }
}

pub(super) enum Side {
    Drawings(Box<ComparedDrawings>),
    Program(Box<ComparedProgram>),
}

/// A drawing, or the drawings below a directory, with their configuration.
pub(super) struct ComparedDrawings {
    pub(super) workspace: Workspace,
    pub(super) inputs: Inputs,
    pub(super) root: Utf8PathBuf,
    /// The revision from which the drawings were checked out. It owns their files.
    revision: Option<Revision>,
}

/// A program, or the program of a path.
pub(super) struct ComparedProgram {
    pub(super) path: ScenePath,
    /// The states of the machine; of a path's program only the cutter.
    pub(super) states: MachineStates,
    /// Whether pathbuild interprets all words of the program that may move the tool.
    pub(super) are_moves_known: bool,
    pub(super) problems: Vec<Diagnostic>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum ArgumentKind {
    Drawings,
    Program,
    /// The name of a revision, or of a path if the other argument is a program.
    Name,
}

/// Resolves both sides of the comparison, the old one first.
pub(super) fn sides(context: &Context, args: &DiffArgs) -> Result<[Side; 2], Failure> {
    let new = args.new.as_deref().unwrap_or(".");
    let arguments = [args.old.as_str(), new];
    let kinds = arguments.map(|argument| kind_of(context, argument));
    let is_program = |kind: &ArgumentKind| *kind == ArgumentKind::Program;
    let beside = kinds.iter().position(is_program).map(|place| Utf8Path::new(arguments[place]));
    let is_one_drawing = |argument: &&&str| is_drawing_file(context, Utf8Path::new(argument));
    let drawing = arguments.iter().find(is_one_drawing).map(|argument| Utf8Path::new(*argument));
    let side = |argument: &str, kind_of| match (kind_of, beside) {
        (ArgumentKind::Program, _) => {
            let heights =
                if kinds.contains(&ArgumentKind::Name) { Heights::Nominal } else { Heights::AsWritten };
            program(context, Utf8Path::new(argument), heights, args).map(Box::new).map(Side::Program)
        }
        (ArgumentKind::Name, Some(program)) => {
            path(context, argument, program, args).map(Box::new).map(Side::Program)
        }
        (ArgumentKind::Drawings, _) => drawings_side(context, argument.into(), None),
        (ArgumentKind::Name, None) => {
            let revision = revision::check_out(context, argument).map_err(Failure::Usage)?;
            let place = match drawing {
                Some(drawing) => {
                    revision.place_of(context, drawing).ok_or_else(|| not_in_repository(context, drawing))?
                }
                None => revision.root.clone(),
            };
            drawings_side(context, place, Some(revision))
        }
    };
    Ok([side(&args.old, kinds[0])?, side(new, kinds[1])?])
}

fn not_in_repository(context: &Context, drawing: &Utf8Path) -> Failure {
    Failure::Usage(context.phrase(
        "{} is not in the repository of the working directory: run `diff` in the repository of the drawing",
        "{} ist nicht im Repository des Arbeitsverzeichnisses: `diff` im Repository der Zeichnung aufrufen",
        &escaping::line(drawing.as_str()),
    ))
}

fn is_drawing_file(context: &Context, place: &Utf8Path) -> bool {
    is_drawing(place) && context.system.kind(place) == FileKind::File
}

fn kind_of(context: &Context, argument: &str) -> ArgumentKind {
    let place = Utf8Path::new(argument);
    let is_drawing = is_drawing(place);
    match context.system.kind(place) {
        FileKind::Directory => ArgumentKind::Drawings,
        FileKind::File if is_drawing => ArgumentKind::Drawings,
        FileKind::File => ArgumentKind::Program,
        _ if argument == "." => ArgumentKind::Drawings,
        FileKind::Missing => ArgumentKind::Name,
    }
}

fn drawings_side(context: &Context, place: Utf8PathBuf, revision: Option<Revision>) -> Result<Side, Failure> {
    let is_drawing = is_drawing(&place);
    let named = Inputs::of_files([&place]);
    let (workspace, mut faults) = context.workspace_of_inputs(&named);
    if !faults.is_empty() {
        if let Some(revision) = &revision {
            revision.name_files(context, &mut faults);
        }
        return Err(Failure::Refused(faults));
    }
    let root = if is_drawing { place.parent().unwrap_or(Utf8Path::new("")).to_owned() } else { place };
    let absolute =
        |place: &Utf8Path| pathbuild_workspace::config::clean(&context.working_directory.join(place));
    // If a directory's own configuration names a library, the directory stands for the whole library.
    let is_library = !is_drawing
        && workspace.has_library()
        && workspace.settings.directory().is_some_and(|directory| absolute(directory) == absolute(&root));
    if let Some(revision) = &revision {
        refuse_submodules(context, revision, is_library.then_some(&workspace))?;
    }
    let inputs = if is_library { Inputs::default() } else { named };
    Ok(Side::Drawings(Box::new(ComparedDrawings { workspace, inputs, root, revision })))
}

/// Refuses to compare with a revision that lacks drawings because they are in a submodule. `library` is the workspace whose library is compared;
/// `None` if the directory itself is compared.
fn refuse_submodules(
    context: &Context,
    revision: &Revision,
    library: Option<&Workspace>,
) -> Result<(), Failure> {
    let absolute =
        |place: &Utf8PathBuf| pathbuild_workspace::config::clean(&context.working_directory.join(place));
    let directories: Vec<Utf8PathBuf> = match library {
        Some(workspace) => {
            let general = &workspace.settings.general;
            general.library.value.iter().chain(&general.search.value).map(absolute).collect()
        }
        None => vec![revision.root.clone()],
    };
    let session = Session::new(context);
    let mut lacking = revision.submodules.iter().filter(|[checked_out, now]| {
        let is_compared = directories
            .iter()
            .any(|directory| directory.starts_with(checked_out) || checked_out.starts_with(directory));
        is_compared && session.drawings_below(now).next().is_some()
    });
    let Some([_, submodule]) = lacking.next() else { return Ok(()) };
    Err(Failure::Usage(context.phrase(
        "a revision does not have the drawings of the submodule {}: run `diff` in the submodule, or compare two directories",
        "eine Revision hat die Zeichnungen des Submoduls {} nicht: `diff` im Submodul aufrufen oder zwei Verzeichnisse vergleichen",
        submodule.as_str(),
    )))
}

impl ComparedDrawings {
    /// Names the files of a revision in diagnostics as the user knows them. Removes the error that the revision has no drawings: in that case, all
    /// drawings are new.
    pub(super) fn name_files(&self, context: &Context, problems: &mut Vec<Diagnostic>) {
        let Some(revision) = &self.revision else { return };
        problems.retain(|problem| *problem.message != outputs::NO_DRAWING);
        revision.name_files(context, problems);
    }
}

/// Returns the reader of programs, which knows the words of the configured post definition, as in `verify`.
fn reader<'c>(context: &'c Context, args: &DiffArgs) -> Result<Verifier<'c>, Failure> {
    let options = VerifyOptions { reading: args.reading.options(), ..VerifyOptions::default() };
    Verifier::new(&mut Session::new(context), options)
}

/// Reads a program. With nominal heights, for comparing it with a path, the corrections by measured heights are undone, so that the program is the one that was drawn.
fn program(
    context: &Context,
    file: &Utf8Path,
    heights: Heights,
    args: &DiffArgs,
) -> Result<ComparedProgram, Failure> {
    let found = |problem: Box<Diagnostic>| Failure::Found(vec![*problem]);
    let text = read(&context.settings, &*context.system, file).map_err(found)?;
    let mut program = reader(context, args)?.read(file, text).map_err(found)?;
    if heights == Heights::Nominal {
        if let Some(problem) = incomparable_with_path(&program) {
            return Err(Failure::Found(vec![problem]));
        }
        let mut steps = Vec::with_capacity(program.read.steps.len());
        program.at_nominal_heights().each(&mut |step| steps.push(step.clone()));
        program.read.steps = steps;
    }
    Ok(ComparedProgram {
        path: program.scene_path(context),
        states: MachineStates::of(&program),
        are_moves_known: program.are_moves_known(),
        problems: program.read.problems,
    })
}

/// Returns the program of a path in the working directory, for comparing it with a program in a file.
fn path(
    context: &Context,
    name: &str,
    beside: &Utf8Path,
    args: &DiffArgs,
) -> Result<ComparedProgram, Failure> {
    let post_processor = post_processor_of(context, beside);
    let text = ShownText::Emitted(post_processor.as_ref());
    let inputs = Inputs { inputs: vec![name.to_owned()] };
    Session::new(context).with_stable_files(|session| {
        let selection = session.select(&inputs);
        let [path] = selection.paths.as_slice() else {
            let reason = || {
                context.phrase(
                    "{} is neither a directory nor a program nor one path",
                    "{} ist weder ein Verzeichnis noch ein Programm noch ein einzelner Pfad",
                    &format!("{name:?}"),
                )
            };
            let problems = session.with_hints(selection.problems);
            return Err(if problems.is_empty() {
                Failure::Usage(reason())
            } else {
                Failure::Found(problems)
            });
        };
        let seen = session.scene(path.file, std::slice::from_ref(&path.name), text);
        if seen.diagnostics.iter().any(Diagnostic::is_error) {
            return Err(Failure::Found(session.with_hints(seen.diagnostics)));
        }
        let target = session.db().target(path.file, path.name.as_str(), Role::Emitted);
        let checked = session.check(&[target]);
        let mut missing = checked.iter().flat_map(|checked| &checked.missing_options).peekable();
        if missing.peek().is_some() {
            return Err(Failure::Usage(missing_values(context, missing.map(|option| option.name()))));
        }
        let path = seen.scene.paths.into_iter().next().unwrap_or_default();
        let cutter = path.tool;
        let path = match post_processor {
            Some(_) if path.native.is_some() => with_post_output(context, path, args)?,
            _ => with_printed_program(path),
        };
        let states = MachineStates::of_drawing(cutter);
        let problems = [seen.diagnostics, seen.refusals].concat();
        Ok(ComparedProgram { path, states, are_moves_known: true, problems })
    })
}

/// Returns the post-processor that wrote a program, judging by its header: the configured one, or the built-in one for its dialect. The path's
/// program is then written by the same post-processor, so that rounding and additional moves do not count as differences.
fn post_processor_of(context: &Context, program: &Utf8Path) -> Option<PostProcessor> {
    let head = context.system.read_head(program, HEAD_BYTES).ok()?;
    let (Provenance { dialect, .. }, _) = Provenance::of_head(&head)?;
    let post_processor = |name| {
        let arguments = PostArguments {
            dialect: dialect.map(|dialect| dialect.name().into()),
            ..PostArguments::default()
        };
        let found = PostProcessor::for_run(context, name, arguments).ok().flatten();
        found.filter(|post_processor| post_processor.reading_dialect() == dialect)
    };
    post_processor(None).or_else(|| post_processor(Some(dialect?.name())))
}

/// Replaces a path's program by the text of its post-processor, read in the same way as a program in a file.
fn with_post_output(context: &Context, path: ScenePath, args: &DiffArgs) -> Result<ScenePath, Failure> {
    let text = path.gcode.unwrap_or_default().into_bytes();
    let program = reader(context, args)?.read(Utf8Path::new(&path.file), text);
    let program = program.map_err(|problem| Failure::Found(vec![*problem]))?;
    Ok(ScenePath { name: path.name, totals: path.totals, ..program.scene_path(context) })
}

/// Replaces a path's program by its native text as read back, so that numbers are rounded as printed.
fn with_printed_program(path: ScenePath) -> ScenePath {
    let text = path.gcode.unwrap_or_default();
    let options = Options { heights: Heights::Nominal, ..Options::default() };
    let read = interpret(text.as_bytes(), Dialect::Native, &options);
    let source = GcodeSource {
        file: &path.file,
        steps: &read.steps,
        text: text.as_bytes(),
        tool: path.tool,
        rapid: None,
    };
    ScenePath { name: path.name, totals: path.totals, ..gcode_path(&source) }
}
