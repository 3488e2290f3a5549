//! Setup sheets of programs. They are built from the results of the same queries as the programs. (book: program/sheet)

use std::sync::Arc;

use pathbuild_db::{Database, SourceFile, Target, keep_outs, placed_keep_outs, traced_program};
use pathbuild_diagnostic::{Diagnostic, Lang, Value};
use pathbuild_gcode::native;
use pathbuild_gcode::provenance::Provenance;
use pathbuild_gcode::statistics::cutting_box;
use pathbuild_motion::Turning;
use pathbuild_toolpath::Program;
use pathbuild_view::{self as view, BilingualText, Scene, ScenePath, Sheet, SheetProbe, SheetTool};

use super::joined::total;
use super::options::{OutputSettings, SheetSettings};
use super::outcome::write_error;
use super::plan::Job;
use crate::config::types::SheetFormat;
use crate::session::{OutputKind, WriteSettings, finished_parts, program_scene};

/// Renders a job's setup sheet; returns `None` if one of its drawings has changed in the meantime.
///
/// # Errors
/// PB005 if it is too large, PB004 if it cannot be generated.
pub(super) fn bytes(
    db: &Database,
    job: &Job,
    format: SheetFormat,
    settings: &OutputSettings<'_>,
) -> Result<Option<Vec<u8>>, Box<Diagnostic>> {
    let Some(sheet) = sheet(db, job, settings)? else { return Ok(None) };
    sheet_bytes(&sheet, format, settings.sheets.lang)
        .map(Some)
        .map_err(|reason| Box::new(write_error(&job.path, reason)))
}

/// Renders a setup sheet in a file format.
///
/// # Errors
/// Only for PDF: if pathbuild was built without the feature `pictures`, or because of a bug.
pub fn sheet_bytes(sheet: &Sheet, format: SheetFormat, lang: Lang) -> Result<Vec<u8>, Value> {
    match format {
        SheetFormat::No => Ok(Vec::new()),
        SheetFormat::Svg => Ok(view::sheet_svg(sheet, lang).into_bytes()),
        SheetFormat::Html => Ok(view::sheet_html(sheet, lang).into_bytes()),
        SheetFormat::Pdf => view::sheet_pdf(sheet, lang),
    }
}

/// Collects the data of a job's sheet; returns `None` if one of its drawings has changed in the meantime.
pub(super) fn sheet(
    db: &Database,
    job: &Job,
    settings: &OutputSettings<'_>,
) -> Result<Option<Sheet>, Box<Diagnostic>> {
    let mut scene = Scene::new(&job.path);
    let mut programs: Vec<Arc<Program>> = Vec::new();
    for target in &job.targets {
        let Some(traced) = traced_program(db, *target) else { return Ok(None) };
        let Some(program) = add_path(db, &mut scene, *target, traced, &settings.writing)? else {
            return Ok(None);
        };
        let tool = settings.sheets.tools.position(&program.path, program.tool);
        if let (Some(path), Some(tool)) = (scene.paths.last_mut(), tool) {
            path.tip = settings.sheets.configured_tools[tool].cutter().into();
        }
        programs.push(program);
    }
    let provenance = settings.provenances.of(&programs);
    let (tools, path_tools) = tools(&programs, &settings.sheets);
    let total = total(&programs, settings.writing.options.rapid);
    let drawings = job.targets.iter().map(|target| file_name(db, target.file(db)));
    let mut drawings: Vec<String> = drawings.collect();
    drawings.dedup();
    let names = |is_meant: fn(OutputKind) -> bool| {
        let files = job.files.iter().filter(move |(kind, _)| is_meant(*kind));
        files.map(|(_, path)| path.file_name().unwrap_or_default().to_owned())
    };
    Ok(Some(Sheet {
        title: job.path.to_string(),
        drawings,
        programs: names(OutputKind::is_program).map(|name| adjusted_name(&name)).collect(),
        values: names(|kind| kind == OutputKind::Values).next(),
        hashes: hashes(&provenance),
        head: [provenance.to_string(), job.title.clone()],
        tools,
        path_tools,
        selects_g54: settings.sheets.selects_g54,
        has_manual_changes: settings.sheets.has_manual_changes,
        starts_spindle: settings.sheets.starts_spindle,
        cutting_box: programs.iter().map(|program| cutting_box(program)).fold([None; 3], bounding_box),
        length: total.length,
        minutes: Some(total.minutes()).filter(|minutes| minutes.is_finite()),
        rapid: Some(settings.writing.options.rapid).filter(|rapid| *rapid > 0.0),
        probes: programs.iter().flat_map(|program| probes(program)).collect(),
        left_out: programs.iter().flat_map(|program| left_out(program)).collect(),
        scene,
    }))
}

/// Describes, in both languages, the entities that lie on the layers of a program's paths but are not part of the program.
fn left_out(program: &Program) -> impl Iterator<Item = BilingualText> + use<> {
    let [en, de] = [Lang::En, Lang::De].map(|lang| native::left_out_lines(program, lang));
    en.into_iter().zip(de).map(|(en, de)| BilingualText { en, de })
}

/// Adds a path to the scene, in the coordinates of its program, with the clamps in its drawing and in the drawings of the paths that it embeds.
fn add_path(
    db: &Database,
    scene: &mut Scene,
    target: Target,
    traced: &pathbuild_db::TracedProgram,
    writing: &WriteSettings,
) -> Result<Option<Arc<Program>>, Box<Diagnostic>> {
    let Some(mut path) = program_scene(db, traced, writing, None)? else { return Ok(None) };
    let [x, y] = path.zero;
    let own = keep_outs(db, target.file(db)).iter();
    scene.keep_outs.extend(own.map(|clamp| view::keep_out(clamp, [-x, -y])));
    let embedded = placed_keep_outs(db, target).into_iter().filter(|clamp| clamp.occurrence > 0);
    scene.keep_outs.extend(embedded.map(|clamp| view::keep_out(&clamp.placed, [0.0, 0.0])));
    path.zero = [0.0, 0.0];
    continue_numbers(&mut path, scene);
    path.parts = finished_parts(db, target);
    scene.paths.push(path);
    Ok(pathbuild_db::program(db, target).clone())
}

/// Numbers the elements of a path after those of the paths before it in the program.
fn continue_numbers(path: &mut ScenePath, scene: &Scene) {
    let numbers = scene.paths.iter().flat_map(|path| &path.elements).filter_map(|element| element.order);
    let last = numbers.max().unwrap_or_default();
    for number in path.elements.iter_mut().filter_map(|element| element.order.as_mut()) {
        *number += last;
    }
}

fn file_name(db: &Database, file: SourceFile) -> String {
    file.path(db).file_name().unwrap_or_default().to_owned()
}

/// Returns the name of the program that the machine finally runs: the adjusted one if there are probes.
fn adjusted_name(program: &str) -> String {
    match program.strip_suffix(OutputKind::Clean.suffix()) {
        Some(stem) => OutputKind::Milling.file(stem).into_string(),
        None => program.to_owned(),
    }
}

/// Returns the hashes that identify a program independently of the version that wrote it, so that an otherwise unchanged sheet stays the same.
fn hashes(provenance: &Provenance) -> String {
    format!("{}-{}", provenance.moves, provenance.options)
}

fn bounding_box(a: [Option<(f64, f64)>; 3], b: [Option<(f64, f64)>; 3]) -> [Option<(f64, f64)>; 3] {
    let either = |a: Option<(f64, f64)>, b: Option<(f64, f64)>| match (a, b) {
        (Some(a), Some(b)) => Some((a.0.min(b.0), a.1.max(b.1))),
        (a, b) => a.or(b),
    };
    [either(a[0], b[0]), either(a[1], b[1]), either(a[2], b[2])]
}

/// Returns the tools of the programs without duplicates, and the index of each program's tool.
fn tools(programs: &[Arc<Program>], settings: &SheetSettings) -> (Vec<SheetTool>, Vec<usize>) {
    let (mut tools, mut indexes): (Vec<SheetTool>, Vec<usize>) = (Vec::new(), Vec::new());
    for program in programs {
        let index = settings.tools.position(&program.path, program.tool);
        let entry = index.map(|index| &settings.tools.entries[index]);
        let configured = index.map(|index| &settings.configured_tools[index]);
        let tool = SheetTool {
            diameter: program.tool,
            number: entry.and_then(|entry| entry.index),
            name: entry.map(|entry| entry.name.to_string()),
            speed: entry.and_then(|entry| entry.speed),
            clockwise: entry.and_then(|entry| entry.spindle).and_then(|spindle| match spindle {
                Turning::Clockwise => Some(true),
                Turning::CounterClockwise => Some(false),
                Turning::Off | Turning::Unstated => None,
            }),
            flutes: configured.and_then(|tool| tool.flutes),
            corner_radius: configured.map_or(0.0, |tool| tool.corner_radius),
            length: configured.and_then(|tool| tool.length),
            paths: Vec::new(),
        };
        let known = tools.iter().position(|known| SheetTool { paths: Vec::new(), ..known.clone() } == tool);
        let index = known.unwrap_or_else(|| {
            tools.push(tool);
            tools.len() - 1
        });
        tools[index].paths.push(program.path.to_string());
        indexes.push(index);
    }
    (tools, indexes)
}

fn probes(program: &Program) -> impl Iterator<Item = SheetProbe> {
    program.probes.iter().enumerate().map(|(index, probe)| SheetProbe {
        number: native::FIRST_PARAMETER + index,
        name: native::probe_name(probe),
        at: [probe.at.x, probe.at.y],
        height: probe.height,
    })
}
