//! `pathbuild emit`: the files of one or more paths. (spec/05-command-line.md, spec/60-gcode.md)

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::Written;
use pathbuild_db::{Db, MissingOption, Role, Target, check_file, path_names};
use pathbuild_diagnostic::messages::{files, outputs as messages, probes};
use pathbuild_diagnostic::{Diagnostic, Point, Value};
use pathbuild_gcode::native::{Charset, Header, WriteOptions};
use pathbuild_path::PathName;
use pathbuild_toolpath::{Correction, Outside, Program, Statistics, ZModel};

use crate::args::EmitArgs;
use crate::config::types;
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::report::{Findings, judge};
use crate::session::{CheckedTarget, Output, Session, Wanted, outputs};

/// Runs the command.
pub fn run(context: &Context, args: &EmitArgs) -> ExitStatus {
    let session = Session::new(context);
    if args.inputs.inputs.is_empty() {
        return context.nothing_named("emit");
    }
    let wanted = session.wanted(&args.inputs);
    let mut emission = Emission { context, session: &session, args, diagnostics: Vec::new() };
    let targets = emission.targets(wanted);
    let made = session.make(&targets);
    if let Some(refusal) = emission.missing_options(&made) {
        return context.usage(&refusal);
    }
    emission.write(&made)
}

struct Emission<'a> {
    context: &'a Context,
    session: &'a Session<'a>,
    args: &'a EmitArgs,
    diagnostics: Vec<Diagnostic>,
}

/// The files of one target, ready to be written.
struct Ready<'a> {
    made: &'a CheckedTarget,
    outputs: Vec<Output>,
}

impl Emission<'_> {
    /// The paths to emit: a drawing must hold just one, unless it lies in a directory that was named.
    fn targets(&mut self, wanted: Wanted) -> Vec<Target> {
        let db = self.session.db();
        self.diagnostics.extend(wanted.problems);
        let mut targets = Vec::new();
        for drawing in wanted.drawings {
            let found = check_file(db, drawing.file);
            self.diagnostics.extend_from_slice(found);
            let is_unreadable = found.iter().any(Diagnostic::is_error);
            let file = drawing.file.path(db);
            match path_names(db, drawing.file).as_slice() {
                [] if is_unreadable || !drawing.is_named => {}
                [] => self.diagnostics.push(self.no_path(file)),
                [_, _, ..] if drawing.is_named => {
                    self.diagnostics.push(several_paths(file, path_names(db, drawing.file)));
                }
                names => targets.extend(names.iter().map(|name| self.target(drawing.file, name))),
            }
        }
        for path in &wanted.paths {
            self.diagnostics.extend_from_slice(check_file(db, path.file));
            targets.push(self.target(path.file, &path.name));
        }
        targets
    }

    fn target(&self, file: pathbuild_db::SourceFile, name: &PathName) -> Target {
        Target::new(self.session.db(), file, name.as_str().into(), Role::Emitted)
    }

    fn no_path(&self, file: &Utf8Path) -> Diagnostic {
        let pattern = &*self.context.settings.general.path_pattern.value;
        Diagnostic::new(&messages::NO_PATH).with("pattern", pattern).in_file(file)
    }

    /// A value that a program needs and nobody gives is wrong usage; what has errors is not asked for it.
    fn missing_options(&self, made: &[CheckedTarget]) -> Option<String> {
        let general = &self.context.settings.general;
        let sound = || made.iter().filter(|made| !made.diagnostics.iter().any(Diagnostic::is_error));
        let is_missing = |option| sound().any(|made| made.missing_options.contains(&option));
        let missing = [
            (is_missing(MissingOption::Feed), "feed", "the milling feed in mm/min of paths without F"),
            (
                is_missing(MissingOption::SweepHeight),
                "sweep-height",
                "the sweep height in mm of paths without S",
            ),
            (
                general.rapid.value.is_none() && sound().next().is_some(),
                "rapid",
                "the rapid feed in mm/min, for times",
            ),
        ];
        let lines = missing.iter().filter(|(is_missing, ..)| *is_missing).map(|(_, name, what)| {
            format!("missing {what}: give --{name}, or set `{name}` in pathbuild.toml")
        });
        let lines: Vec<String> = lines.collect();
        (!lines.is_empty()).then(|| lines.join("\n"))
    }

    fn write(mut self, made: &[CheckedTarget]) -> ExitStatus {
        for made in made {
            for file in &made.files {
                self.diagnostics.extend_from_slice(check_file(self.session.db(), *file));
            }
            self.diagnostics.extend_from_slice(&made.diagnostics);
        }
        let mut ready: Vec<Ready<'_>> = made.iter().filter_map(|made| self.ready(made)).collect();
        self.refuse_same_names(&mut ready);
        for ready in &ready {
            if let Err(problem) = self.write_one(ready) {
                self.diagnostics.push(*problem);
            }
        }
        let findings = Findings::new(judge(self.diagnostics, &self.context.settings));
        self.context.show(&findings);
        if findings.errors() > 0 { ExitStatus::Errors } else { ExitStatus::Success }
    }

    fn ready<'m>(&mut self, made: &'m CheckedTarget) -> Option<Ready<'m>> {
        let program = made.program.as_ref()?;
        let db = self.session.db();
        let file = made.target.file(db).path(db);
        let general = &self.context.settings.general;
        let is_alone = path_names(db, made.target.file(db)).len() == 1;
        let stem = if is_alone { file.file_stem().unwrap_or_default() } else { &program.path };
        let stem = format!("{stem}{}", program.output_suffix);
        if stem.contains(['/', '\\']) || stem.contains(char::is_control) {
            let reason = self.context.choose(
                "R holds a character that cannot be in a file's name",
                "R enthält ein Zeichen, das in keinem Dateinamen stehen kann",
            );
            self.diagnostics.push(cannot_write(&stem, reason).in_file(file).in_path(&program.path));
            return None;
        }
        let options = self.write_options();
        if let Some(problem) = self.too_many_pieces(program, options.correction) {
            self.diagnostics.push(problem.in_file(file).in_path(&program.path));
            return None;
        }
        let outside = options.correction.outside(program).map(|outside| outside_probes(&outside));
        self.diagnostics.extend(outside.map(|warning| warning.in_file(file).in_path(&program.path)));
        let directory = general.out_dir.value.as_deref().or(file.parent()).unwrap_or(Utf8Path::new(""));
        let header = Header { provenance: self.provenance() };
        let feed = general.probe_feed.value.or(general.feed.value).unwrap_or_default();
        Some(Ready { made, outputs: outputs(program, directory, &stem, &header, feed, &options) })
    }

    fn provenance(&self) -> String {
        format!("pathbuild {}", env!("CARGO_PKG_VERSION"))
    }

    fn write_options(&self) -> WriteOptions {
        let general = &self.context.settings.general;
        let charset = match general.charset.value {
            types::Charset::Ascii => Charset::Ascii,
            types::Charset::Utf8 => Charset::Utf8,
        };
        let model = match general.z_model.value {
            types::ZModel::Idw4 => ZModel::Idw4,
            types::ZModel::Plane => ZModel::Plane,
            types::ZModel::Tin => ZModel::Tin,
        };
        WriteOptions {
            lang: self.context.lang(),
            charset,
            rapid: general.rapid.value.unwrap_or_default(),
            correction: Correction { model, longest: self.context.settings.z_split() },
        }
    }

    /// PB005: what comes of cutting moves is limited like the moves themselves.
    fn too_many_pieces(&self, program: &Program, correction: Correction) -> Option<Diagnostic> {
        let limit = self.context.settings.limits.embedding_moves.value;
        let count = correction.count(program);
        (count > limit).then(|| {
            Diagnostic::new(&files::LIMIT)
                .with("what", format!("the number of moves, cut by z-split ({count}),"))
                .with("limit", limit)
                .with("key", "embedding-moves")
        })
    }

    /// Two outputs of one name: neither is written. Case does not count, since on some systems it does not.
    fn refuse_same_names(&mut self, ready: &mut Vec<Ready<'_>>) {
        let mut owners: std::collections::BTreeMap<String, Vec<usize>> = std::collections::BTreeMap::new();
        for (index, ready) in ready.iter().enumerate() {
            for output in &ready.outputs {
                owners.entry(output.path.as_str().to_lowercase()).or_default().push(index);
            }
        }
        let db = self.session.db();
        let mut refused = Vec::new();
        for owners in owners.into_values().filter(|owners| owners.len() > 1) {
            let name = |index: usize| {
                format!(
                    "{} ({})",
                    ready[index].made.target.name(db),
                    ready[index].made.target.file(db).path(db)
                )
            };
            let output = ready[owners[0]].outputs[0].path.file_name().unwrap_or_default();
            let problem = Diagnostic::new(&messages::SAME_OUTPUT)
                .with("name", output)
                .with("first", name(owners[0]))
                .with("second", name(owners[1]))
                .in_file(ready[owners[0]].made.target.file(db).path(db));
            self.diagnostics.push(problem);
            refused.extend(owners);
        }
        let mut index = 0;
        ready.retain(|_| {
            index += 1;
            !refused.contains(&(index - 1))
        });
    }

    fn write_one(&self, ready: &Ready<'_>) -> Result<(), Box<Diagnostic>> {
        for output in ready.outputs.iter().filter(|output| output.holds_values) {
            self.check_values(output)?;
        }
        for output in &ready.outputs {
            let system = self.session.db().system();
            let is_kept = output.holds_values && self.has_same_probes(output);
            let written = if is_kept {
                Ok(Written::Unchanged)
            } else {
                system.write(&output.path, output.text.as_bytes())
            };
            let written = written.map_err(|reason| Box::new(cannot_write(output.path.as_str(), &reason)))?;
            self.say_written(&output.path, written, ready);
        }
        Ok(())
    }

    /// PB605: values that somebody measured are not overwritten.
    fn check_values(&self, output: &Output) -> Result<(), Box<Diagnostic>> {
        let Some(present) = self.present(&output.path) else { return Ok(()) };
        if self.args.force
            || without_values(&present) == without_values(&output.text)
            || without_values(&present) == present.trim_end()
        {
            return Ok(());
        }
        let name = output.path.file_name().unwrap_or_default();
        Err(Box::new(Diagnostic::new(&probes::VALUES_PRESENT).with("name", name).in_file(&output.path)))
    }

    fn has_same_probes(&self, output: &Output) -> bool {
        let present = self.present(&output.path);
        !self.args.force
            && present.is_some_and(|present| without_values(&present) == without_values(&output.text))
    }

    fn present(&self, path: &Utf8Path) -> Option<String> {
        let bytes = self.session.db().system().read(path, 1 << 24).ok()?;
        Some(String::from_utf8_lossy(&bytes).replace("\r\n", "\n"))
    }

    fn say_written(&self, path: &Utf8PathBuf, written: Written, ready: &Ready<'_>) {
        let state = match written {
            Written::Changed => self.context.choose("written", "geschrieben"),
            Written::Unchanged => self.context.choose("unchanged", "unverändert"),
        };
        let program = ready.made.program.as_ref();
        let rapid = self.context.settings.general.rapid.value.unwrap_or_default();
        let sum = program.map(|program| Statistics::of(program, rapid).sum()).unwrap_or_default();
        self.context.printer.status(format_args!(
            "{path}: {state}, {:.0} mm, {:.0} min",
            sum.length,
            sum.minutes()
        ));
    }
}

fn cannot_write(name: &str, reason: &str) -> Diagnostic {
    Diagnostic::new(&files::CANNOT_WRITE).with("name", name).with("reason", reason)
}

fn outside_probes(outside: &Outside) -> Diagnostic {
    Diagnostic::new(&probes::OUTSIDE)
        .with("distance", outside.distance)
        .with("at", Point::new(outside.at.x, outside.at.y))
}

fn several_paths(file: &Utf8Path, names: &[PathName]) -> Diagnostic {
    let list: Value = names.iter().map(PathName::as_str).collect();
    Diagnostic::new(&messages::SEVERAL_PATHS)
        .with("names", list)
        .with("first", names[0].as_str())
        .in_file(file)
}

/// A file of values with everything behind `=` taken away.
fn without_values(text: &str) -> String {
    let lines = text
        .lines()
        .map(|line| line.split_inclusive('=').filter(|part| part.ends_with('=')).collect::<String>());
    lines.collect::<Vec<_>>().join("\n")
}
