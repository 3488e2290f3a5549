//! The configuration of `FluidNC`, a YAML file.
//!
//! Source: "Config File" of the `FluidNC` wiki. Rates are in mm/min, accelerations in mm/s². `FluidNC` gives anchors, aliases and tags no meaning;
//! an alias is stored as text and never expanded.

use pathbuild_diagnostic::messages::import as say;
use pathbuild_diagnostic::{Diagnostic, Text};
use saphyr_parser::{Event, Parser};

use super::{Description, Entries, broken_description};

/// Upper bound on the depth of nested sections. Real files have up to five.
const MAX_SECTION_DEPTH: usize = 64;

/// Whether the text has a section for axes.
pub(super) fn is_configuration(text: &str) -> bool {
    text.lines().any(|line| line.trim_end() == "axes:")
}

pub(super) fn read(text: &str) -> Result<Description, Box<Diagnostic>> {
    let mut entries = entries(text)?;
    let axes = |name: &str| ["x", "y", "z"].map(|axis| format!("axes/{axis}/{name}"));
    for (key, name) in [
        ("rates", "max_rate_mm_per_min"),
        ("accelerations", "acceleration_mm_per_sec2"),
        ("travel", "max_travel_mm"),
    ] {
        let names = axes(name);
        entries.set_axes(key, names.each_ref().map(String::as_str), 1.0);
    }
    entries.set_number("junction-deviation", "junction_deviation_mm", 1.0);
    spindle(&mut entries);
    Ok(entries.finish("FluidNC"))
}

/// Sets the speeds of the spindle from its speed map, if there is exactly one such map. The map of a laser is ignored, because it contains powers.
fn spindle(entries: &mut Entries) {
    let is_map = |name: &str| {
        name.strip_suffix("/speed_map")
            .is_some_and(|section| !section.contains('/') && !section.eq_ignore_ascii_case("laser"))
    };
    let maps: Vec<String> =
        entries.iter().map(|entry| entry.name.clone()).filter(|name| is_map(name)).collect();
    let [map] = maps.as_slice() else {
        if maps.len() > 1 {
            entries.report(Diagnostic::new(&say::SEVERAL_SPINDLES).quoting("names", maps.join(", ")));
        }
        return;
    };
    let Some(entry) = entries.take(map).cloned() else { return };
    let Some(points) = entry.value.split_whitespace().map(point).collect::<Option<Vec<_>>>() else {
        return entries.report_invalid_value(&entry, &SPEED_MAP);
    };
    let first = points.first().map(|(speed, _)| *speed);
    let standing = points.iter().filter(|(_, power)| *power == 0.0).map(|(speed, _)| *speed);
    let from = standing.reduce(f64::max).or(first);
    let to = points.iter().map(|(speed, _)| *speed).reduce(f64::max);
    match from.zip(to) {
        Some((from, to)) => entries.set_range(from, to, entry.line, &[map]),
        None => entries.report_invalid_value(&entry, &SPEED_MAP),
    }
}

static SPEED_MAP: Text =
    Text { en: "a map such as `0=0% 24000=100%`", de: "eine Tabelle wie `0=0% 24000=100%`" };

/// Reads `24000=100.000%`: a speed in 1/min, and the power for it.
fn point(text: &str) -> Option<(f64, f64)> {
    let (speed, power) = text.split_once('=')?;
    let power: f64 = power.trim_end_matches('%').parse().ok()?;
    let speed: f64 = speed.parse().ok()?;
    (speed.is_finite() && power.is_finite()).then_some((speed, power))
}

/// Flattens the file into entries such as `axes/x/max_travel_mm`.
fn entries(text: &str) -> Result<Entries, Box<Diagnostic>> {
    let mut walk = Walk::default();
    for event in Parser::new_from_str(text) {
        let (event, span) = event.map_err(|error| broken_description(error.info(), error.marker().line()))?;
        let line = span.start.line();
        match event {
            Event::MappingStart(..) => walk.open(Level::Mapping { key: None }, line)?,
            Event::SequenceStart(..) => walk.open(Level::Sequence { index: 0 }, line)?,
            Event::MappingEnd | Event::SequenceEnd => walk.close(),
            Event::Scalar(value, ..) => walk.scalar(&value, line),
            Event::Alias(..) => walk.scalar("*", line),
            _ => {}
        }
    }
    Ok(walk.entries)
}

/// A mapping or a sequence that is being read.
#[derive(Debug)]
enum Level {
    Mapping { key: Option<String> },
    Sequence { index: usize },
}

#[derive(Debug, Default)]
struct Walk {
    levels: Vec<Level>,
    entries: Entries,
}

impl Walk {
    fn open(&mut self, level: Level, line: usize) -> Result<(), Box<Diagnostic>> {
        if self.levels.len() == MAX_SECTION_DEPTH {
            return Err(broken_description("sections are nested too deeply", line));
        }
        self.levels.push(level);
        Ok(())
    }

    fn close(&mut self) {
        self.levels.pop();
        self.next();
    }

    /// Proceeds to the next key or item of the innermost level that is open.
    fn next(&mut self) {
        match self.levels.last_mut() {
            Some(Level::Mapping { key }) => *key = None,
            Some(Level::Sequence { index }) => *index += 1,
            None => {}
        }
    }

    fn scalar(&mut self, value: &str, line: usize) {
        if let Some(Level::Mapping { key: key @ None }) = self.levels.last_mut() {
            *key = Some(value.to_owned());
            return;
        }
        let names = self.levels.iter().map(|level| match level {
            Level::Mapping { key } => key.clone().unwrap_or_default(),
            Level::Sequence { index } => index.to_string(),
        });
        let name = names.collect::<Vec<_>>().join("/");
        self.entries.add(name, value, line);
        self.next();
    }
}
