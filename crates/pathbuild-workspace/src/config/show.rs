use std::fmt::Write;

use pathbuild_diagnostic::shown;

use super::origin::Origin;
use super::settings::Settings;

/// A key with its value as TOML, and its source.
pub(super) struct ShownSetting {
    pub(super) name: &'static str,
    pub(super) value: Option<String>,
    pub(super) origin: Origin,
}

/// Formats the settings as TOML, on request with their sources as comments.
pub fn show(settings: &Settings, with_origin: bool) -> String {
    let mut text = match &settings.file {
        Some(file) => format!("# {}\n", shown::line(file.as_str())),
        None => "# no pathbuild.toml\n".to_owned(),
    };
    // The general keys include inline tables, so they must precede the first table header.
    write(&mut text, settings.general.shown(), with_origin);
    write(&mut text, settings.tables.shown(), with_origin);
    for (name, entries) in sections(settings) {
        _ = write!(text, "\n[{name}]\n");
        write(&mut text, entries, with_origin);
    }
    text
}

/// The tables with fixed keys.
fn sections(settings: &Settings) -> [(&'static str, Vec<ShownSetting>); 5] {
    [
        ("emit", settings.emit.shown()),
        ("limits", settings.limits.shown()),
        ("machine", settings.machine.shown()),
        ("warnings", settings.warnings.shown()),
        ("watch", settings.watch.shown()),
    ]
}

/// A key with its value.
#[derive(Clone, Debug)]
pub struct Setting {
    /// Its table; empty for keys before the first table.
    pub section: &'static str,
    /// Name of the key.
    pub name: &'static str,
    /// Its value as TOML; `None` if not set.
    pub value: Option<String>,
    /// Source of the value; empty if not set.
    pub origin: String,
}

/// Lists all settings.
pub fn settings(settings: &Settings) -> Vec<Setting> {
    let general = [("", settings.general.shown()), ("", settings.tables.shown())];
    let all = general.into_iter().chain(sections(settings));
    let setting = |section| {
        move |ShownSetting { name, value, origin }: ShownSetting| {
            let origin = value.as_ref().map(|_| origin.to_string()).unwrap_or_default();
            Setting { section, name, value, origin }
        }
    };
    all.flat_map(|(section, entries)| entries.into_iter().map(setting(section))).collect()
}

fn write(text: &mut String, entries: Vec<ShownSetting>, with_origin: bool) {
    for ShownSetting { name, value, origin } in entries {
        let line = value.map_or_else(|| format!("# {name} is not set"), |value| format!("{name} = {value}"));
        let origin =
            if with_origin && !line.starts_with('#') { format!("  # {origin}") } else { String::new() };
        _ = writeln!(text, "{line}{origin}");
    }
}
