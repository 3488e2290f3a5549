//! Translates the configuration into the database's settings.

use std::sync::Arc;

use pathbuild_db::{Database, Limits, Reading, Settings};
use pathbuild_path::{
    DoubtThresholds, FilePattern, Language, LayerPattern, LineTypeAliases, PartSettings, PathOptions,
    PathPattern, PathTool, PathTools, Restriction,
};

use super::normalize;
use crate::config::{self, types};
use crate::post_processor::tool_table;
use crate::workspace::Workspace;

/// Applies the configuration to the database. The configuration has no errors at this point, so its patterns compile.
pub(super) fn apply(db: &Database, context: &Workspace, is_hashed: bool) {
    let general = &context.settings.general;
    let reading = reading(&context.settings, is_hashed);
    let language = Language {
        path_pattern: PathPattern::new(&general.path_pattern.value).unwrap_or_default(),
        keep_out: general.keep_out.value.as_deref().and_then(|pattern| LayerPattern::new(pattern).ok()),
        part: part(context),
        line_types: line_type_aliases(context),
        join_tolerance: general.join_tolerance.value,
        text_limit: reading.text_length,
        doubts: doubt_thresholds(&context.settings),
        tools: path_tools(context),
    };
    let search = general.search.value.iter();
    let file_pattern = FilePattern::new(&general.file_pattern.value).unwrap_or_default();
    let search = search.map(|directory| normalize(directory, &context.working_directory)).collect();
    let rules = general.restrict.value.iter();
    let restrictions = rules.filter_map(|rule| Restriction::new(&rule.parent, &rule.child).ok()).collect();
    let fold = PathOptions {
        feed: general.feed.value,
        sweep_height: general.sweep_height.value,
        probe_feed: general.probe_feed.value,
        compatible: general.compatible.value,
    };
    let limits = limits(&context.settings);
    _ = Settings::new(db, reading, Arc::new(language), file_pattern, search, restrictions, fold, limits);
}

/// Returns the configured tools, from which a post chooses one for each path.
fn path_tools(context: &Workspace) -> PathTools {
    let tool = |tool: &types::Tool| PathTool {
        name: (&*tool.name).into(),
        is_named: tool.paths.is_some(),
        chip_load: tool.chip_load(),
        cutting_length: tool.cutting_length(),
        is_slot_cutter: tool.shape == types::CutterShape::Slot,
        corner_radius: tool.cutter().corner_radius.unwrap_or_default(),
    };
    let tools: Vec<PathTool> = context.settings.tables.tools.value.iter().map(tool).collect();
    if tools.is_empty() {
        return PathTools::default();
    }
    let table = tool_table(&context.settings);
    PathTools::new(move |path, diameter| table.position(path, diameter).map(|tool| tools[tool].clone()))
}

fn part(context: &Workspace) -> Option<PartSettings> {
    let general = &context.settings.general;
    Some(PartSettings {
        pattern: LayerPattern::new(general.part.value.as_deref()?).ok()?,
        tolerance: general.part_tolerance.value,
        is_held_otherwise: general.part_held.value == types::PartHolding::Otherwise,
    })
}

/// Returns the database's settings for reading drawings. If `is_hashed`, drawings are hashed when they are read.
pub fn reading(settings: &config::Settings, is_hashed: bool) -> Reading {
    let (general, limits) = (&settings.general, &settings.limits);
    let count = |number: u64| usize::try_from(number).unwrap_or(usize::MAX);
    Reading {
        units: general.units.value,
        approximate_curves: general.approximate_curves.value,
        file_size: limits.file_size.value,
        entities: count(limits.entities.value),
        text_length: count(limits.text_length.value),
        walk_time: limits.seconds_per_path.value,
        is_hashed,
        compatible: general.compatible.value,
    }
}

/// Returns the database's limits. Their defaults are declared in the configuration only.
pub fn limits(settings: &config::Settings) -> Limits {
    let limits = &settings.limits;
    Limits {
        moves: limits.embedding_moves.value,
        memory: limits.program_memory.value,
        paths: limits.embedded_paths.value,
    }
}

fn doubt_thresholds(settings: &config::Settings) -> DoubtThresholds {
    DoubtThresholds {
        maximum_feed: settings.machine.max_feed.value,
        has_cycles: settings.general.cycles.value,
        ..settings.warnings.thresholds()
    }
}

fn line_type_aliases(context: &Workspace) -> LineTypeAliases {
    let mut aliases = LineTypeAliases::default();
    for alias in &context.settings.tables.line_types.value {
        aliases.insert(&alias.name, alias.line_type);
    }
    aliases
}
