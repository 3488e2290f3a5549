//! `pathbuild machine import`: compares descriptions of the machine with the configuration, and imports them. (book: howto/machine)

use std::fmt::Write;

use camino::{Utf8Path, Utf8PathBuf};
use pathbuild_db::system::join;
use pathbuild_diagnostic::messages::import as say;
use pathbuild_diagnostic::{Diagnostic, Value, escaping};
use pathbuild_workspace::config::check_text;
use pathbuild_workspace::files::{self, FILE_NAME};
use pathbuild_workspace::machine::{
    self, Change, DescribedValue, Description, EditedConfiguration, Entry, Target,
};
use serde_json::json;

use crate::args::{MachineArgs, MachineCommand};
use crate::context::Context;
use crate::exit::ExitStatus;
use crate::render::Format;

/// Prints the differences, and writes the new values if requested. Nothing is written if a file cannot be read.
pub fn run(context: &Context, args: &MachineArgs) -> ExitStatus {
    let MachineCommand::Import { files, units, write } = &args.command;
    let mut diagnostics = Vec::new();
    let mut texts = Vec::new();
    for file in files {
        match machine::text(&*context.system, &context.working_directory.join(file)) {
            Ok(text) => texts.push((file.as_path(), text)),
            Err(reason) => diagnostics.push(unreadable_error(file, reason)),
        }
    }
    let unit = machine::table_unit(*units, &texts).unwrap_or_else(|problem| {
        diagnostics.push(*problem);
        None
    });
    let mut descriptions = Vec::new();
    for (file, text) in &texts {
        match machine::read(file, text, unit, &|name| tool_bit(context, file, name)) {
            Ok(mut description) => {
                diagnostics.append(&mut description.problems);
                descriptions.push((*file, description));
            }
            Err(problem) => diagnostics.push(*problem),
        }
    }
    let (values, problems) = machine::merge(&descriptions);
    diagnostics.extend(problems);
    if !diagnostics.iter().any(Diagnostic::is_error) {
        let compared = compare(context, &values, &descriptions, *write);
        diagnostics.extend(compared.unwrap_or_else(|problems| problems));
    }
    context.conclude(diagnostics)
}

fn text(context: &Context, file: &Utf8Path) -> Result<String, Value> {
    files::read(&*context.system, file, machine::MAX_DESCRIPTION_BYTES)
}

fn unreadable_error(file: &Utf8Path, reason: Value) -> Diagnostic {
    Diagnostic::new(&say::DESCRIPTION_UNREADABLE).with("reason", reason).in_file(file)
}

/// Returns the text of a tool bit that a FreeCAD library names. The bit is a file beside the library, or in the directory `Bit` beside the
/// library's directory. Other directories are not read.
fn tool_bit(context: &Context, library: &Utf8Path, name: &str) -> Result<String, Value> {
    let name = Utf8Path::new(name).file_name().unwrap_or(name);
    let library = context.working_directory.join(library);
    let directory = library.parent().unwrap_or(Utf8Path::new(""));
    let sibling = directory.parent().map(|parent| parent.join("Bit").join(name));
    text(context, &directory.join(name))
        .or_else(|reason| sibling.map_or(Err(reason), |file| text(context, &file)))
}

/// A file, and the description of a machine or of tools that was read from it.
type DescribedFile<'f> = (&'f Utf8Path, Description);

/// Shows the values of the descriptions and those of the configuration, and writes them if requested. Returns warnings.
///
/// # Errors
/// The reasons why the values cannot be written.
fn compare(
    context: &Context,
    values: &[(Target, DescribedValue)],
    descriptions: &[DescribedFile<'_>],
    write: bool,
) -> Result<Vec<Diagnostic>, Vec<Diagnostic>> {
    let file = configuration_file(context);
    let is_there = files::is_named(&file);
    let old = if is_there {
        text(context, &file).map_err(|reason| vec![unreadable_error(&file, reason)])?
    } else {
        String::new()
    };
    let edited = machine::edit(&file, &old, values).map_err(|problem| vec![*problem])?;
    let EditedConfiguration { text: new, changes, problems } = edited;
    let faults = check_text(&file, &new);
    if faults.iter().any(Diagnostic::is_error) {
        return Err(faults);
    }
    show(context, &file, &changes, descriptions);
    if new == old {
        context.printer.status(context.choose("nothing differs", "nichts weicht ab"));
    } else if !write {
        let hint = "nothing was written; --write writes the values";
        context.printer.status(context.choose(hint, "nichts geschrieben; --write übernimmt die Werte"));
    } else if is_there {
        files::replace(context, &file, &new).map_err(|problem| vec![*problem])?;
    } else {
        files::create(context, &[(file, new.as_bytes())])?;
    }
    Ok(problems)
}

/// Returns the configuration file of the run. If there is none, returns the path in the working directory at which it would be created.
fn configuration_file(context: &Context) -> Utf8PathBuf {
    context.settings.file.clone().unwrap_or_else(|| join(&context.working_directory, FILE_NAME))
}

fn show(context: &Context, file: &Utf8Path, changes: &[Change], descriptions: &[DescribedFile<'_>]) {
    if context.format == Format::Json {
        for Change { table, key, old, new, source, is_new } in changes {
            let row = json!({ "table": table, "key": key, "old": old, "new": new, "from": source, "differs": is_new });
            context.row("value", row);
        }
        for (file, Description { format, unused, .. }) in descriptions {
            for Entry { name, value, line } in unused {
                let row = json!({ "file": context.file(file), "format": format, "line": line, "name": name, "value": value });
                context.row("unused", row);
            }
        }
        return;
    }
    let mut text = String::new();
    let mut table = "";
    for change in changes {
        if table != change.table {
            table = &change.table;
            _ = writeln!(text, "{} [{table}]", escaping::line(context.file(file).as_str()));
        }
        change_lines(&mut text, change);
    }
    let has_unused = |(_, description): &&DescribedFile<'_>| !description.unused.is_empty();
    for (file, Description { format, unused, .. }) in descriptions.iter().filter(has_unused) {
        // All tools of a library have the same entries, so name each entry once.
        let mut names: Vec<&str> = Vec::new();
        for entry in unused {
            if !names.contains(&entry.name.as_str()) {
                names.push(&entry.name);
            }
        }
        let no_key = context.choose("no key for", "kein Schlüssel für");
        let file = escaping::line(file.as_str());
        _ = writeln!(text, "{file} ({format}): {no_key} {}", escaping::line(&names.join(", ")));
    }
    context.printer.result(text);
}

fn change_lines(text: &mut String, change: &Change) {
    let Change { key, old, new, source, is_new, .. } = change;
    if let Some(old) = old.as_ref().filter(|_| *is_new) {
        _ = writeln!(text, "  - {key} = {}", escaping::line(old));
    }
    let sign = if *is_new { '+' } else { '=' };
    _ = writeln!(text, "  {sign} {key} = {}  ({})", escaping::line(new), escaping::line(source));
}
