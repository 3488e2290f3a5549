use std::fmt::Write;

use super::origin::Origin;
use super::settings::Settings;

/// A key's value as TOML, and where it comes from.
pub(super) struct Shown {
    pub(super) name: &'static str,
    pub(super) value: Option<String>,
    pub(super) origin: Origin,
}

/// What holds, as TOML that says the same; with origins as comments where they are asked for.
pub fn show(settings: &Settings, with_origin: bool) -> String {
    let mut text = match &settings.file {
        Some(file) => format!("# {file}\n"),
        None => "# no pathbuild.toml\n".to_owned(),
    };
    // Tables that hold tables are shown inline, so they must stand before the first header.
    write(&mut text, settings.general.shown(), with_origin);
    write(&mut text, settings.tables.shown(), with_origin);
    let sections = [
        ("emit", settings.emit.shown()),
        ("limits", settings.limits.shown()),
        ("machine", settings.machine.shown()),
        ("warnings", settings.warnings.shown()),
        ("watch", settings.watch.shown()),
    ];
    for (name, entries) in sections {
        _ = write!(text, "\n[{name}]\n");
        write(&mut text, entries, with_origin);
    }
    text
}

fn write(text: &mut String, entries: Vec<Shown>, with_origin: bool) {
    for Shown { name, value, origin } in entries {
        let line = value.map_or_else(|| format!("# {name} is not set"), |value| format!("{name} = {value}"));
        let origin =
            if with_origin && !line.starts_with('#') { format!("  # {origin}") } else { String::new() };
        _ = writeln!(text, "{line}{origin}");
    }
}
