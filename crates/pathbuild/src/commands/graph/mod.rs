//! `pathbuild graph`, `deps` and `rdeps`: show which path embeds which. (book: reference/commands)

mod dot;
mod json;
mod label;
mod list;
mod mermaid;
mod tree;

use std::collections::HashSet;

use pathbuild_db::{Role, SourceFile, Target, check_file};
use pathbuild_diagnostic::Diagnostic;
use pathbuild_path::PathName;

use crate::args::{Format, GraphArgs};
use crate::context::Context;
use crate::exit::ExitStatus;
use pathbuild_workspace::session::{Direction, Graph, Selection, Session};

/// Runs `graph`: lists all embeddings of the given paths; without arguments, those of the library.
pub fn graph(context: &Context, args: &GraphArgs) -> ExitStatus {
    let mut session = Session::new(context);
    if args.inputs.inputs.is_empty() && !session.has_library() {
        return context.refuse_empty_input();
    }
    let (arguments, graph) = session.with_stable_files(|session| {
        let arguments = GraphArguments::new(session, session.select(&args.inputs));
        let graph = session.graph(&arguments.targets);
        (arguments, graph)
    });
    print(context, &graph, |graph| list::list(graph, context.lang()));
    arguments.finish(context, &graph)
}

/// Runs `deps`: shows what paths embed, level by level.
pub fn deps(context: &Context, args: &GraphArgs) -> ExitStatus {
    let mut session = Session::new(context);
    if args.inputs.inputs.is_empty() && !session.has_library() {
        return context.refuse_empty_input();
    }
    let (arguments, graph) = session.with_stable_files(|session| {
        let arguments = GraphArguments::new(session, session.select(&args.inputs));
        let graph = session.graph(&arguments.targets);
        (arguments, graph)
    });
    print(context, &graph, |graph| tree::tree(graph, Direction::Down, context.lang()));
    arguments.finish(context, &graph)
}

/// Runs `rdeps`: shows what embeds the given paths, level by level, among all paths of the library; without a library, among those in and
/// below the working directory.
pub fn rdeps(context: &Context, args: &GraphArgs) -> ExitStatus {
    if args.inputs.inputs.is_empty() {
        return context.usage(
            context.choose("name drawings or paths for rdeps", "für rdeps Zeichnungen oder Pfade nennen"),
        );
    }
    let mut session = Session::new(context);
    let (arguments, whole) = session.with_stable_files(|session| {
        let mut arguments = GraphArguments::new(session, session.select(&args.inputs));
        let whole = session.graph(&arguments.with_all_others(session));
        (arguments, whole)
    });
    let db = session.db();
    let named = arguments.targets.iter().flat_map(|target| {
        let name = PathName::new(target.name(db));
        whole.nodes_of(&name, target.file(db).path(db))
    });
    let mut roots: Vec<usize> = Vec::new();
    for root in named {
        if !roots.contains(&root) {
            roots.push(root);
        }
    }
    let graph = whole.part(&roots, Direction::Up);
    print(context, &graph, |graph| tree::tree(graph, Direction::Up, context.lang()));
    arguments.finish(context, &whole)
}

/// The resolved arguments.
struct GraphArguments {
    targets: Vec<Target>,
    files: Vec<SourceFile>,
    problems: Vec<Diagnostic>,
}

impl GraphArguments {
    fn new(session: &Session<'_>, selection: Selection) -> Self {
        let db = session.db();
        let files = selection.whole(session);
        session.parse_ahead(&files);
        let mut targets: Vec<Target> =
            files.iter().flat_map(|file| session.targets(*file, &Role::Checked)).collect();
        let is_whole: HashSet<SourceFile> = files.iter().copied().collect();
        let named = selection.paths.iter().filter(|path| !is_whole.contains(&path.file));
        targets.extend(named.map(|path| session.target(path, Role::Checked)));
        let mut problems = selection.problems;
        let broken = files.iter().flat_map(|file| check_file(db, *file)).filter(|problem| problem.is_error());
        problems.extend(broken.cloned());
        let problems = session.with_hints(problems);
        Self { targets, files, problems }
    }

    /// The requested targets, and all others that may embed them.
    fn with_all_others(&mut self, session: &Session<'_>) -> Vec<Target> {
        let (files, problems) = session.all_drawings();
        self.problems.extend(problems);
        session.parse_ahead(&files);
        let arguments: HashSet<SourceFile> = self.files.iter().copied().collect();
        let others = files.into_iter().filter(|file| !arguments.contains(file));
        let others = others.flat_map(|file| session.targets(file, &Role::Checked));
        self.targets.iter().copied().chain(others).collect()
    }

    /// Shows diagnostics, and reports where the graph is incomplete.
    fn finish(self, context: &Context, graph: &Graph) -> ExitStatus {
        let unknown = graph.nodes.iter().filter(|node| !node.is_sound).count();
        if unknown > 0 {
            context.printer.status(format_args!(
                "{}: {unknown} ({})",
                context.choose(
                    "paths with errors, which may embed more than is shown",
                    "Pfade mit Fehlern, die mehr einbetten können als gezeigt"
                ),
                context.choose("pathbuild check shows them", "pathbuild check zeigt sie")
            ));
        }
        let problems = self.problems.into_iter().chain(graph.problems.iter().cloned());
        let findings = context.findings(problems.collect());
        context.show(&findings);
        if findings.errors() > 0 { ExitStatus::Errors } else { ExitStatus::Success }
    }
}

fn print(context: &Context, graph: &Graph, text: impl Fn(&Graph) -> String) {
    match context.format {
        Format::Dot => context.printer.result(dot::dot(graph)),
        Format::Mermaid => context.printer.result(mermaid::mermaid(graph)),
        Format::Json => context.row("graph", json::json(context, graph)),
        _ => context.printer.result(text(graph)),
    }
}
