//! The ini file of a `LinuxCNC` machine.
//!
//! Source: "INI Configuration" of the `LinuxCNC` documentation. Velocities are per second, in the unit of `[TRAJ]LINEAR_UNITS`.

use pathbuild_diagnostic::messages::import as say;
use pathbuild_diagnostic::{Diagnostic, Text};

use super::entries::rounded;
use super::{Description, Entries, LengthUnit, Quantity, broken_description};

/// Whether the text has a section that only `LinuxCNC` has.
pub(super) fn is_ini(text: &str) -> bool {
    let is_section = |line: &str| {
        let line = line.trim();
        ["[EMC]", "[TRAJ]"].contains(&line) || line.starts_with("[AXIS_") || line.starts_with("[JOINT_")
    };
    text.lines().any(is_section)
}

pub(super) fn read(text: &str) -> Result<Description, Box<Diagnostic>> {
    let mut entries = entries(text)?;
    let Some(scale) = unit(&mut entries) else { return Ok(entries.finish(FORMAT)) };
    let names = |name: &str| {
        // Up to version 2.7 the sections of the axes have numbers.
        let is_numbered = entries.iter().all(|entry| !entry.name.starts_with("AXIS_X/"));
        let axes = if is_numbered { ["0", "1", "2"] } else { ["X", "Y", "Z"] };
        axes.map(|axis| format!("AXIS_{axis}/{name}"))
    };
    let [rates, accelerations, lower, upper] =
        ["MAX_VELOCITY", "MAX_ACCELERATION", "MIN_LIMIT", "MAX_LIMIT"].map(names);
    entries.set_axes("rates", rates.each_ref().map(String::as_str), scale * 60.0);
    entries.set_axes("accelerations", accelerations.each_ref().map(String::as_str), scale);
    travel(&mut entries, &lower, &upper, scale);
    for name in ["TRAJ/MAX_LINEAR_VELOCITY", "TRAJ/MAX_VELOCITY"] {
        if entries.get(name).is_some() {
            entries.set_number("maximum-feed", name, scale * 60.0);
            break;
        }
    }
    entries.set_speeds("SPINDLE_0/MIN_FORWARD_VELOCITY", "SPINDLE_0/MAX_FORWARD_VELOCITY");
    Ok(entries.finish(FORMAT))
}

/// Travel in mm above which an axis is considered unlimited: LinuxCNC's default limits are farther apart than this.
const MIN_UNLIMITED_TRAVEL: f64 = 1e9;

const FORMAT: &str = "LinuxCNC";

static UNIT: Text = Text { en: "mm or inch", de: "mm oder inch" };

pub(super) fn length_unit(text: &str) -> Option<LengthUnit> {
    let mut entries = entries(text).ok().filter(|_| is_ini(text))?;
    named_unit(&entries.take("TRAJ/LINEAR_UNITS")?.value)
}

fn named_unit(name: &str) -> Option<LengthUnit> {
    match name.to_ascii_lowercase().as_str() {
        "mm" | "metric" => Some(LengthUnit::Millimetre),
        "in" | "inch" | "imperial" => Some(LengthUnit::Inch),
        _ => None,
    }
}

/// Returns the factor that converts lengths to mm; reports a missing or unknown unit.
fn unit(entries: &mut Entries) -> Option<f64> {
    let Some(entry) = entries.take("TRAJ/LINEAR_UNITS").cloned() else {
        entries.report(Diagnostic::new(&say::UNIT_MISSING));
        return None;
    };
    let unit = named_unit(&entry.value);
    if unit.is_none() {
        entries.report_invalid_value(&entry, &UNIT);
    }
    unit.map(LengthUnit::millimetres)
}

/// Sets `travel` to the distances between the limits, which are in machine coordinates.
fn travel(entries: &mut Entries, lower: &[String; 3], upper: &[String; 3], scale: f64) {
    let mut ends = |names: &[String; 3]| {
        let readings = names.each_ref().map(|name| entries.number(name));
        readings.into_iter().map(|reading| Some(reading?.number)).collect::<Option<Vec<f64>>>()
    };
    let Some((low, high)) = ends(lower).zip(ends(upper)) else { return };
    let sizes: Vec<f64> = low.iter().zip(&high).map(|(low, high)| rounded((high - low) * scale)).collect();
    if sizes.iter().all(|size| 0.0 < *size && *size < MIN_UNLIMITED_TRAVEL) {
        let names: Vec<&str> = lower.iter().zip(upper).flat_map(|(low, high)| [&**low, &**high]).collect();
        entries.set("travel", Quantity::Numbers(sizes), &names);
    } else {
        entries.report(Diagnostic::new(&say::NO_TRAVEL));
    }
}

fn entries(text: &str) -> Result<Entries, Box<Diagnostic>> {
    // LinuxCNC looks up values with `IniFile::Find`, which returns the first match.
    let mut entries = Entries::with_first_effective();
    let mut section = "";
    for (index, line) in text.lines().enumerate() {
        let line = line.trim();
        if line.is_empty() || line.starts_with([';', '#']) && !line.starts_with("#INCLUDE") {
            continue;
        }
        if let Some(name) = line.strip_prefix('[') {
            let Some((name, _)) = name.split_once(']') else {
                return Err(broken_description("a section without `]`", index + 1));
            };
            section = name.trim();
        } else if let Some((name, value)) = line.split_once('=') {
            entries.add(format!("{section}/{}", name.trim()), without_comment(value), index + 1);
        } else {
            if line.starts_with("#INCLUDE") {
                let problem = Diagnostic::new(&say::NOT_INCLUDED).quoting("line", line);
                entries.report(problem.at_line(u32::try_from(index + 1).ok(), None));
            }
            entries.add(line, "", index + 1);
        }
    }
    Ok(entries)
}

/// Removes the comment that may follow a value after a space.
fn without_comment(value: &str) -> &str {
    let value = value.trim();
    let comments = [" #", " ;", "\t#", "\t;"];
    let end = comments.iter().filter_map(|comment| value.find(comment)).min();
    value[..end.unwrap_or(value.len())].trim_end()
}
