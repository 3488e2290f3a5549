//! The settings that GRBL and grblHAL print for `$$`.
//!
//! Source: "Grbl v1.1 Configuration" (wiki of gnea/grbl) and the settings list of grblHAL. Lengths are in mm even if `$13` selects inches, which
//! applies to positions in status reports only.

use pathbuild_diagnostic::Diagnostic;
use pathbuild_diagnostic::messages::import as say;

use super::{Description, Entries};

/// Whether a line of the text is a numbered setting.
pub(super) fn is_listing(text: &str) -> bool {
    text.lines().any(|line| setting(line).is_some())
}

pub(super) fn read(text: &str) -> Description {
    let mut entries = Entries::default();
    for (index, line) in text.lines().enumerate() {
        if let Some((name, value)) = setting(line) {
            entries.add(name, value, index + 1);
        } else if !is_surrounding_line(line) {
            entries.add(line.trim(), "", index + 1);
        }
    }
    entries.set_axes("rates", ["$110", "$111", "$112"], 1.0);
    entries.set_axes("accelerations", ["$120", "$121", "$122"], 1.0);
    entries.set_axes("travel", ["$130", "$131", "$132"], 1.0);
    entries.set_number("junction-deviation", "$11", 1.0);
    // In laser mode, the spindle's speed limits are limits of the beam's power.
    if entries.get("$32").is_some_and(|mode| mode.value == "1") {
        let problem = Diagnostic::new(&say::LASER);
        let line = entries.take("$32").and_then(|mode| mode.line);
        entries.report(problem.at_line(line, None));
    } else {
        entries.set_speeds("$31", "$30");
    }
    entries.finish("GRBL")
}

/// Splits a setting such as `$110=500.000 (x max rate, mm/min)` into name and value.
fn setting(line: &str) -> Option<(&str, &str)> {
    let (name, value) = line.trim().split_once('=')?;
    let name = name.trim_end();
    let digits = name.strip_prefix('$')?;
    let is_number = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    let value = value.split_once('(').map_or(value, |(value, _)| value).trim();
    is_number.then_some((name, value))
}

/// Whether a line contains no setting, but is printed around the settings by a controller or a sender.
fn is_surrounding_line(line: &str) -> bool {
    let line = line.trim().trim_start_matches('>').trim_start();
    line.is_empty()
        || matches!(line, "ok" | "$$")
        || line.starts_with(['[', '<', ';', '(', '#'])
        || line.to_ascii_lowercase().starts_with("grbl")
}
