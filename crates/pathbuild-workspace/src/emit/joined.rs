//! Programs that join several paths: `emit --join`. (book: program/posts)

use std::ops::Add;
use std::sync::Arc;

use pathbuild_db::{
    Collision, Database, PlacedKeepOut, Target, closure, collisions, placed_keep_outs, summary,
};
use pathbuild_diagnostic::messages::{parameters, paths as messages};
use pathbuild_diagnostic::{Diagnostic, Point, words};
use pathbuild_gcode::statistics::statistics;
use pathbuild_path::approx::near;
use pathbuild_path::{Curve, Line, TipMove, Xy};
use pathbuild_toolpath::{Program, Total, kind_of_move, tip_move};

use super::plan::Job;

/// Returns PB211 for each sign that the paths do not belong in one program: different material or thickness, or a repeated path.
pub(super) fn joining_warnings(db: &Database, job: &Job, programs: &[Arc<Program>]) -> Vec<Diagnostic> {
    let thickness = differing_thickness_warning(db, job, programs);
    thickness
        .into_iter()
        .chain(differing_material_warning(db, job))
        .chain(repeated_path_warning(db, job))
        .collect()
}

/// Returns PB407 for moves of one path into the clamps of another path's drawing, and for rapid moves from one path to the next into any clamp. There
/// is one diagnostic for each clamp, path and kind of move.
pub(super) fn moves_into_clamps(db: &Database, job: &Job, programs: &[Arc<Program>]) -> Vec<Diagnostic> {
    let clamps: Vec<PlacedKeepOut> =
        job.targets.iter().flat_map(|target| placed_keep_outs(db, *target)).collect();
    if clamps.is_empty() {
        return Vec::new();
    }
    let diagnostics = |((program, traverse), target): ((&Arc<Program>, Option<TipMove>), &Target)| {
        let own =
            program.moves().filter_map(|(_, movement)| Some((kind_of_move(&movement), tip_move(&movement)?)));
        let traverse = traverse.map(|traverse| (&words::RAPID_MOVE, traverse));
        let moves = traverse.into_iter().chain(own).map(|(what, way)| ((), what, way));
        let cutter = program.largest_cutter();
        let diagnostic = |((clamp, _), ((), collision)): ((usize, _), ((), Collision))| {
            let clamp = &clamps[clamp];
            let found = collision.diagnostic(&messages::JOINED_INTO_CLAMP, cutter, clamp, 0.0);
            let found = found
                .quoting("drawing", &clamp.drawing)
                .with("clamp", Point::new(clamp.placed.at.x, clamp.placed.at.y));
            found.in_path(&program.path).in_file(target.file(db).path(db))
        };
        let found = collisions(&clamps, cutter, moves, |(), clamp| clamp);
        found.into_iter().map(diagnostic).collect::<Vec<_>>()
    };
    programs.iter().zip(traverses(programs)).zip(&job.targets).flat_map(diagnostics).collect()
}

/// Returns the sum of the programs' lengths and times, with the rapid moves from one program to the next; `rapid` is the speed of rapid moves in
/// mm/min.
pub(super) fn total(programs: &[Arc<Program>], rapid: f64) -> Total {
    let totals = programs.iter().map(|program| statistics(program, rapid).sum());
    let lengths = traverses(programs).take(programs.len()).flatten().map(|way| way.curve.length());
    totals
        .chain(lengths.map(|length| Total { length, time: length / rapid }))
        .fold(Total::default(), Add::add)
}

/// Returns PB211 for the first path with another material than the program's first path.
fn differing_material_warning(db: &Database, job: &Job) -> Option<Diagnostic> {
    let material =
        |target: &Target| summary(db, closure(db, *target).root?).signature.as_ref()?.material.clone();
    let first = job.targets.first()?;
    let expected = material(first)?;
    let differing = |target: &&Target| material(target).is_some_and(|material| material != expected);
    let target = job.targets.iter().find(differing)?;
    let problem = Diagnostic::new(&parameters::JOINED_MATERIAL).in_path(target.name(db));
    let problem = problem.quoting("material", material(target)?).quoting("other", expected);
    Some(problem.quoting("path", &**first.name(db)).in_file(target.file(db).path(db)))
}

/// Returns PB211 for the first path that the program contains twice.
fn repeated_path_warning(db: &Database, job: &Job) -> Option<Diagnostic> {
    let mut targets = job.targets.iter().enumerate();
    let (_, target) = targets.find(|(number, target)| job.targets[..*number].contains(target))?;
    let problem = Diagnostic::new(&parameters::JOINED_TWICE).in_path(target.name(db));
    Some(problem.quoting("path", &**target.name(db)).in_file(target.file(db).path(db)))
}

/// Returns PB211 for the first path with another thickness than the program's first path.
fn differing_thickness_warning(db: &Database, job: &Job, programs: &[Arc<Program>]) -> Option<Diagnostic> {
    let first = programs.first()?;
    let mut targets = programs.iter().zip(&job.targets);
    let (other, target) = targets.find(|(other, _)| !near(other.thickness, first.thickness))?;
    let problem = Diagnostic::new(&parameters::JOINED_THICKNESS).in_path(&other.path);
    let problem = problem.with("thickness", other.thickness).with("other", first.thickness);
    Some(problem.quoting("path", &*first.path).in_file(target.file(db).path(db)))
}

/// Returns, for each program, the rapid move to its start, at the greatest sweep height (S) of all programs; `None` for the first program.
fn traverses(programs: &[Arc<Program>]) -> impl Iterator<Item = Option<TipMove>> {
    let clearance = programs.iter().map(|program| program.sweep_height).fold(f64::NEG_INFINITY, f64::max);
    let ends = programs
        .iter()
        .map(|program| program.moves().last().map(|(_, last)| Xy::new(last.to.x(), last.to.y())));
    let traverse = move |start: Xy| TipMove {
        curve: Curve::Line(Line { start, end: Xy::origin() }),
        from_z: clearance,
        to_z: clearance,
    };
    std::iter::once(None).chain(ends.map(move |end| end.map(traverse)))
}
