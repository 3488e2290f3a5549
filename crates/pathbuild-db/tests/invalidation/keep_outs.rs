//! Tests clamps: an edit of one invalidates every program around it. (book: language/keep-outs)

use std::sync::Arc;

use pathbuild_db::{Role, Settings};
use pathbuild_diagnostic::TraceStep;
use pathbuild_path::{Language, LayerPattern};
use salsa::Setter;

use crate::embedding::component;
use crate::world::World;

const PROJECT: &str = "layer 8001.1P\nstart 0,0 \"T5 O3 Mx\"\nsubpath 0,0 20,0 \">1111.1P\"\nend 20,0";

fn with_clamp(y: &str) -> String {
    format!("{}\nlayer clamps\ncircle 10,{y} d 6\ntext 8,{y} \"Z90\"", component("1111.1P", "0"))
}

/// Sets the layers that contain clamps. Returns the previous settings.
fn name_clamps(world: &mut World) -> Arc<Language> {
    let settings = Settings::get(&world.db);
    let before = Arc::clone(settings.language(&world.db));
    let keep_out = LayerPattern::new("clamps").ok();
    settings.set_language(&mut world.db).to(Arc::new(Language { keep_out, ..Language::clone(&before) }));
    before
}

#[test]
fn an_edited_clamp_reaches_what_embeds_its_path() {
    let mut world = World::new(&[("lib/1111.1P.dxf", &with_clamp("8")), ("lib/8001.1P.dxf", PROJECT)]);
    let language = name_clamps(&mut world);
    world.ask("component", "lib/1111.1P.dxf", "1111.1P");
    world.ask("project", "lib/8001.1P.dxf", "8001.1P");
    let right = world.outcome("project");
    assert!(right.program.is_some(), "{right:?}");
    world.draw("lib/1111.1P.dxf", &with_clamp("2"));
    for label in ["component", "project"] {
        assert_eq!(world.codes(label), ["PB407"]);
        assert_eq!(world.outcome(label).program, None);
    }
    // The project has the finding of the component, with the subpath that leads to it.
    let trace = |label: &str| {
        let outcome = world.outcome(label);
        let step = |step: &TraceStep| format!("{} {}", step.file, step.path);
        outcome.diagnostics[0].trace.iter().map(step).collect::<Vec<_>>()
    };
    assert_eq!(trace("component"), [""; 0]);
    assert_eq!(trace("project"), ["lib/8001.1P.dxf 8001.1P"]);
    world.draw("lib/1111.1P.dxf", &with_clamp("8"));
    assert_eq!(world.outcome("project"), right);
    // A clamp without a valid height is an error of both the component and the project; without the setting it is ignored.
    world.draw("lib/1111.1P.dxf", &with_clamp("2").replace("Z90", "high"));
    assert_eq!(world.codes("project"), ["PB117", "PB511"]);
    Settings::get(&world.db).set_language(&mut world.db).to(language);
    assert_eq!(world.outcome("project").program, right.program);
}

/// Moves into clamps are reported only if all clamps have valid outlines and heights. This also holds for a path that embeds nothing.
#[test]
fn moves_into_clamps_are_looked_for_where_all_are_clear() {
    for (label, code) in [("Z90", "PB407"), ("high", "PB117")] {
        let drawing = format!("{}\ncircle 10,12 d 6\ntext 8,12 \"{label}\"", with_clamp("2"));
        let mut world = World::new(&[("lib/1111.1P.dxf", &drawing)]);
        name_clamps(&mut world);
        assert_eq!(world.judge("path", "lib/1111.1P.dxf", "1111.1P", Role::Checked), [code]);
    }
}
