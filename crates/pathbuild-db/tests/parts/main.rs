//! Tests the part check: which findings it reports for drawings, and which it must not. (book: language/part)
#![allow(clippy::unwrap_used, reason = "a test that cannot set up its files has failed")]
#![allow(clippy::format_push_string, reason = "drawings are texts, which are put together piece by piece")]
#![allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "small numbers of corners")]

mod drawings;
mod embedded;
mod outlines;
mod random;
mod rings;

use std::sync::Arc;
use std::time::Duration;

use pathbuild_db::system::MemorySystem;
use pathbuild_db::{
    Database, Db, Limits, Reading, Role, Settings, Target, check_file, check_target, path_names, program,
};
use pathbuild_diagnostic::{Diagnostic, Lang};
use pathbuild_dxf::Units;
use pathbuild_path::{
    DoubtThresholds, FilePattern, Language, LayerPattern, LineTypeAliases, PartSettings, PathOptions,
    PathPattern, PathTool, PathTools,
};
use pathbuild_testkit::sheet;

/// The settings of a check.
struct PartTest<'t> {
    /// Regular expression of the key `part`; `None` if the key is not set.
    pattern: Option<&'t str>,
    tolerance: f64,
    /// Radius in mm of the corners of all cutters.
    corner_radius: f64,
    is_held_otherwise: bool,
    is_compatible: bool,
}

impl Default for PartTest<'_> {
    fn default() -> Self {
        Self {
            pattern: Some("Part"),
            tolerance: 0.02,
            corner_radius: 0.0,
            is_held_otherwise: false,
            is_compatible: false,
        }
    }
}

impl PartTest<'_> {
    /// Returns the findings about all drawings and their paths.
    fn diagnostics(&self, files: &[(&str, &str)]) -> Vec<Diagnostic> {
        let db = self.database(files);
        let mut found = Vec::new();
        for (name, _) in files {
            let file = db.file((*name).into());
            found.extend(check_file(&db, file).iter().cloned());
            for path in path_names(&db, file) {
                let target = Target::new(&db, file, path.as_str().into(), Role::Checked);
                let own: Vec<Diagnostic> = check_target(&db, target).cloned().collect();
                let is_refused = own.iter().any(Diagnostic::is_error);
                assert_eq!(program(&db, target).is_none(), is_refused, "{own:?}");
                found.extend(own);
            }
        }
        found
    }

    /// Returns the codes of these findings, in ascending order and each once.
    fn codes(&self, files: &[(&str, &str)]) -> Vec<String> {
        let mut codes: Vec<String> =
            self.diagnostics(files).iter().map(|found| found.code().to_string()).collect();
        codes.sort();
        codes.dedup();
        codes
    }

    fn database(&self, files: &[(&str, &str)]) -> Database {
        let corner_radius = self.corner_radius;
        let tool = move |path: &str, diameter: f64| {
            let is_slot_cutter = path.ends_with('S') && (diameter - 2.0).abs() < 1e-9;
            Some(PathTool {
                name: "mill".into(),
                is_named: false,
                chip_load: None,
                cutting_length: None,
                is_slot_cutter,
                corner_radius,
            })
        };
        let system = Arc::new(MemorySystem::default());
        for (name, text) in files {
            let sheet = sheet(text).unwrap_or_else(|faults| panic!("{faults:?} in\n{text}"));
            system.put(*name, sheet.to_dxf());
        }
        let db = Database::new(system);
        let part = self.pattern.map(|pattern| PartSettings {
            pattern: LayerPattern::new(pattern).unwrap(),
            tolerance: self.tolerance,
            is_held_otherwise: self.is_held_otherwise,
        });
        let language = Language {
            path_pattern: PathPattern::default(),
            keep_out: None,
            part,
            line_types: LineTypeAliases::default(),
            text_limit: 65_536,
            doubts: DoubtThresholds::default(),
            tools: PathTools::new(tool),
            join_tolerance: 0.0,
        };
        let reading = Reading {
            units: Units::Header,
            approximate_curves: 0.0,
            file_size: 1 << 24,
            entities: 100_000,
            text_length: 65_536,
            walk_time: Duration::from_mins(1),
            is_hashed: false,
            compatible: self.is_compatible,
        };
        let limits = Limits { moves: 10_000_000, memory: 1 << 30, paths: 1000 };
        let fold = PathOptions {
            feed: Some(100.0),
            sweep_height: Some(20.0),
            compatible: self.is_compatible,
            ..PathOptions::default()
        };
        let (search, rules) = (Vec::new(), Vec::new());
        Settings::new(&db, reading, Arc::new(language), FilePattern::default(), search, rules, fold, limits);
        db
    }
}

/// Returns the codes for a single drawing with the usual settings.
fn codes(drawing: &str) -> Vec<String> {
    PartTest::default().codes(&[("1234.1P.dxf", drawing)])
}

/// Returns the messages for a single drawing with the usual settings.
fn messages(drawing: &str) -> Vec<String> {
    let found = PartTest::default().diagnostics(&[("1234.1P.dxf", drawing)]);
    found.iter().map(|found| format!("{} {}", found.code(), found.text(Lang::En))).collect()
}

fn number(found: &Diagnostic, name: &str) -> f64 {
    let value = found.arguments.iter().find(|(known, _)| *known == name).map(|(_, value)| value);
    match value {
        Some(pathbuild_diagnostic::Value::Number(number)) => number.0,
        Some(pathbuild_diagnostic::Value::Count(count)) => *count as f64,
        other => panic!("{name}: {other:?} in {found:?}"),
    }
}
