use std::fmt::Write;

use pathbuild_diagnostic::shown;

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
        Some(file) => format!("# {}\n", shown::line(file.as_str())),
        None => "# no pathbuild.toml\n".to_owned(),
    };
    // Tables that hold tables are shown inline, so they must stand before the first header.
    write(&mut text, settings.general.shown(), with_origin);
    write(&mut text, settings.tables.shown(), with_origin);
    for (name, entries) in sections(settings) {
        _ = write!(text, "\n[{name}]\n");
        write(&mut text, entries, with_origin);
    }
    text
}

/// The sections that are no tables of names.
fn sections(settings: &Settings) -> [(&'static str, Vec<Shown>); 5] {
    [
        ("emit", settings.emit.shown()),
        ("limits", settings.limits.shown()),
        ("machine", settings.machine.shown()),
        ("warnings", settings.warnings.shown()),
        ("watch", settings.watch.shown()),
    ]
}

/// A key with what holds.
#[derive(Clone, Debug)]
pub struct Setting {
    /// The section; empty for keys before the first.
    pub section: &'static str,
    /// The key.
    pub name: &'static str,
    /// The value as TOML; `None`: not set.
    pub value: Option<String>,
    /// Where it comes from; empty where it is not set.
    pub origin: String,
}

/// What holds, key by key.
pub fn settings(settings: &Settings) -> Vec<Setting> {
    let general = [("", settings.general.shown()), ("", settings.tables.shown())];
    let all = general.into_iter().chain(sections(settings));
    let setting = |section| {
        move |Shown { name, value, origin }: Shown| {
            let origin = value.as_ref().map(|_| origin.to_string()).unwrap_or_default();
            Setting { section, name, value, origin }
        }
    };
    all.flat_map(|(section, entries)| entries.into_iter().map(setting(section))).collect()
}

fn write(text: &mut String, entries: Vec<Shown>, with_origin: bool) {
    for Shown { name, value, origin } in entries {
        let line = value.map_or_else(|| format!("# {name} is not set"), |value| format!("{name} = {value}"));
        let origin =
            if with_origin && !line.starts_with('#') { format!("  # {origin}") } else { String::new() };
        _ = writeln!(text, "{line}{origin}");
    }
}
