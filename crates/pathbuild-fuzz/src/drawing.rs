//! Targets for drawings: bytes to entities, texts to parameters, elements to programs.

use std::sync::Arc;

use pathbuild_db::system::MemorySystem;
use pathbuild_db::{
    Database, Db, Limits, Role, Settings, Target, check_file, check_target, path_names, program,
};
use pathbuild_diagnostic::{Code, Diagnostic, Lang};
use pathbuild_gcode::native::{self, Charset, Header, WriteOptions};
use pathbuild_path::{
    FilePattern, KeepOutPattern, Language, LineTypeAliases, PathKey, PathOptions, PathPattern,
};
use pathbuild_post::{Job, PostOptions, ToolTable};
use pathbuild_toolpath::{Correction, Program};
use pathbuild_workspace::config;
use pathbuild_workspace::session::{limits, reading};

use crate::drawn::{Choices, dxf as drawn, written};

/// Arbitrary bytes as a drawing, ASCII or binary.
pub(crate) fn dxf(data: &[u8]) {
    compile(data);
}

/// Lines of arbitrary characters as texts of each kind of element, as layer names, and as a file name.
pub(crate) fn texts(data: &[u8]) {
    let text = String::from_utf8_lossy(data);
    let mut lines = text.lines();
    let mut line = || lines.next().unwrap_or_default().trim_end();
    let mut drawing = String::from("0\nSECTION\n2\nENTITIES\n");
    let places = [(0.0, 0.0), (20.0, 0.0), (60.0, 0.0), (100.0, 0.0)];
    let elements = [
        "CIRCLE\n8\n1001.1P\n6\nPHANTOM\n10\n0\n20\n0\n40\n0.5\n",
        "LINE\n8\n1001.1P\n6\nCONTINUOUS\n10\n0\n20\n0\n11\n40\n21\n0\n",
        "LINE\n8\n1001.1P\n6\nDASHDOT\n10\n40\n20\n0\n11\n80\n21\n0\n",
        "CIRCLE\n8\n1001.1P\n6\nCONTINUOUS\n10\n100\n20\n0\n40\n3\n",
    ];
    for (element, (x, y)) in elements.iter().zip(places) {
        drawing.extend(["0\n", element]);
        written(&mut drawing, "TEXT", "1001.1P", x, y, line());
    }
    written(&mut drawing, "MTEXT", "1001.1P", 20.0, 0.0, line());
    let (layer, name) = (line(), line());
    written(&mut drawing, "TEXT", layer, 0.0, 0.0, "T5 O2 I1 B0 MX");
    drawing.push_str("0\nCIRCLE\n8\n1001.1P\n6\nPHANTOM\n10\n80\n20\n0\n40\n1\n0\nENDSEC\n0\nEOF\n");
    compile(drawing.as_bytes());
    let pattern = PathPattern::default();
    _ = FilePattern::default().ranges(name);
    _ = PathKey::new(name, &pattern);
    if pattern.matches(name) {
        assert!(pattern.is_layer(name), "{name:?} is a path's name, but no layer's");
    }
}

/// Lines, arcs, circles and texts on a grid, which often form a path.
pub(crate) fn walk(data: &[u8]) {
    compile(drawn(&mut Choices::new(data)).as_bytes());
}

/// Compiles a drawing completely and renders all findings.
fn compile(bytes: &[u8]) {
    let system = Arc::new(MemorySystem::default());
    system.put("1001.dxf", bytes);
    let db = Database::new(system);
    settle(&db);
    let file = db.file("1001.dxf".into());
    judge(check_file(&db, file));
    for name in path_names(&db, file) {
        for role in [Role::Checked, Role::Emitted] {
            let target = Target::new(&db, file, name.as_str().into(), role);
            judge(check_target(&db, target));
            if let Some(program) = program(&db, target) {
                write(program);
            }
        }
    }
}

fn settle(db: &Database) {
    let language = Language {
        path_pattern: PathPattern::default(),
        keep_out: KeepOutPattern::new("clamps").ok(),
        line_types: LineTypeAliases::default(),
        text_limit: 4096,
        doubts: pathbuild_path::DoubtThresholds::default(),
        join_tolerance: 0.0,
    };
    let (files, search) = (FilePattern::default(), Vec::new());
    let fold = PathOptions { feed: Some(100.0), sweep_height: Some(20.0), ..PathOptions::default() };
    // Without this limit, a fuzzer would find slow inputs that are merely large.
    let settings = config::Settings::default();
    let limits = Limits { moves: 20_000, ..limits(&settings) };
    Settings::new(db, reading(&settings, false), Arc::new(language), files, search, Vec::new(), fold, limits);
}

/// Checks that findings can be rendered and are not bugs.
fn judge<'d>(found: impl IntoIterator<Item = &'d Diagnostic>) {
    for diagnostic in found {
        let text = diagnostic.text(Lang::En) + &diagnostic.text(Lang::De);
        assert!(diagnostic.code() != Code::InternalError, "{text}");
        assert!(!text.contains(pathbuild_diagnostic::shown::acts), "{text:?}");
        _ = (diagnostic.help(Lang::En), diagnostic.help(Lang::De));
    }
}

/// Writes a program natively and through posts, and reads it back.
fn write(program: &Program) {
    let options = WriteOptions {
        lang: Lang::En,
        charset: Charset::Ascii,
        rapid: 1000.0,
        correction: Correction::default(),
    };
    let text = native::program(program, &Header::default(), &options);
    if let Err(problem) = native::read_back(&text, program) {
        judge(&[*problem]);
    }
    for name in ["linuxcnc", "grbl"] {
        let Ok(post) = pathbuild_post::load(name) else { continue };
        let (job, warnings) = Job::from_programs("1001", &[program], &ToolTable::default(), false);
        judge(&warnings);
        match post.write(&job, &PostOptions::default()) {
            Ok(output) => judge(&output.warnings),
            Err(problems) => judge(&problems),
        }
    }
}
