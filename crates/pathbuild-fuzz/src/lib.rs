//! The functions behind the fuzz targets. A target panics if pathbuild misbehaves: if it panics, hangs, reports PB006, or contradicts
//! itself. The tests of this crate run all targets on the corpora in `fuzz/corpus` and on random mutations of them.

use std::fmt::Write;
use std::sync::Arc;

use camino::Utf8Path;
use pathbuild_cache::decode;
use pathbuild_db::system::MemorySystem;
use pathbuild_db::{
    Database, Db, Limits, Role, Settings, Target, check_file, check_target, path_names, program,
};
use pathbuild_diagnostic::{Code, Diagnostic, Lang};
use pathbuild_gcode::adjust::{Inputs, Source, adjust};
use pathbuild_gcode::dialect::{Charset, Dialect};
use pathbuild_gcode::estimate::{Kinematics, seconds};
use pathbuild_gcode::interpret::{Options, guess, interpret};
use pathbuild_gcode::native::{self, WriteOptions};
use pathbuild_gcode::statistics::Summary;
use pathbuild_path::{
    FilePattern, Language, LayerPattern, LineTypeAliases, PathKey, PathOptions, PathPattern,
};
use pathbuild_post::{Job, PostDefinition, PostOptions, ToolTable, native_remark};
use pathbuild_toolpath::{Correction, Program, ZModel};
use pathbuild_workspace::config;
use pathbuild_workspace::session::{limits, reading};

/// The name of a target, and its function.
pub type FuzzTarget = (&'static str, fn(&[u8]));

/// All targets, named after their corpora in `fuzz/corpus`.
pub const TARGETS: [FuzzTarget; 8] = [
    ("dxf", dxf),
    ("texts", texts),
    ("walk", walk),
    ("post", post),
    ("gcode", gcode),
    ("values", values),
    ("config", config),
    ("cache", cache),
];

/// Runs a target.
///
/// # Panics
/// If pathbuild misbehaves, or there is no such target.
pub fn run(name: &str, data: &[u8]) {
    let target = TARGETS.iter().find(|(known, _)| *known == name);
    assert!(target.is_some(), "there is no target {name}");
    if let Some((_, run)) = target {
        run(data);
    }
}

// Targets for drawings: bytes to entities, texts to parameters, elements to programs.

/// Compiles arbitrary bytes as a drawing, ASCII or binary.
fn dxf(data: &[u8]) {
    compile(data);
}

/// Reads lines of arbitrary characters as texts of each kind of element, as layer names, and as a file name.
fn texts(data: &[u8]) {
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

/// Compiles a drawing of lines, arcs, circles and texts on a grid, which often form a path.
fn walk(data: &[u8]) {
    compile(grid_drawing(&mut Choices::new(data)).as_bytes());
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
        keep_out: LayerPattern::new("clamps").ok(),
        part: None,
        line_types: LineTypeAliases::default(),
        text_limit: 4096,
        doubts: pathbuild_path::DoubtThresholds::default(),
        tools: pathbuild_path::PathTools::default(),
        join_tolerance: 0.0,
    };
    let (files, search) = (FilePattern::default(), Vec::new());
    let fold = PathOptions { feed: Some(100.0), sweep_height: Some(20.0), ..PathOptions::default() };
    // Without this limit, a fuzzer would find slow inputs that are merely large.
    let settings = config::Settings::default();
    let limits = Limits { moves: 20_000, ..limits(&settings) };
    Settings::new(db, reading(&settings, false), Arc::new(language), files, search, Vec::new(), fold, limits);
}

/// Checks that findings can be rendered, and that none reports a bug of pathbuild.
fn judge<'d>(found: impl IntoIterator<Item = &'d Diagnostic>) {
    for diagnostic in found {
        let text = diagnostic.text(Lang::En) + &diagnostic.text(Lang::De);
        assert!(diagnostic.code() != Code::InternalError, "{text}");
        assert!(!text.contains(pathbuild_diagnostic::escaping::is_active), "{text:?}");
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
    let text = native::write_program(program, "", &options, usize::MAX).unwrap_or_default();
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

// Targets for G-code, post definitions and measured values.

const PROGRAM: &[u8] = b"%\n(P 1)\nF100\nG00 Z20.000\nG00 X0.000 Y0.000\nG01 F100.000 Z0.000\nG01 X40.000 Y0.000\nG02 F100.000 X40.000 Y-10.000 I0.000 J-5.000\nG00 Z20.000\nM30\n%\n";

/// Reads a post definition; if that succeeds, writes a program with it.
fn post(data: &[u8]) {
    for file in ["post.cbpp", "post.toml"] {
        let Ok(post) = PostDefinition::read(data, Utf8Path::new(file)) else { continue };
        let steps = interpret(PROGRAM, Dialect::Native, &Options::default()).steps;
        if let Ok(job) = Job::from_steps("1001", &steps, Dialect::Native, &native_remark) {
            _ = post.write(&job, &PostOptions::default());
        }
    }
}

/// Reads a G-code program; the first byte selects the dialect.
fn gcode(data: &[u8]) {
    let Some((choice, text)) = data.split_first() else { return };
    let dialect = Dialect::ALL[usize::from(*choice) % Dialect::ALL.len()];
    let result = interpret(text, dialect, &Options::default());
    assert!(
        result.moves().iter().all(|(_, motion)| motion.to.at.iter().all(|at| at.is_finite())),
        "a move leads nowhere"
    );
    guess(text);
    Summary::of(&result.steps, dialect == Dialect::Xpertmill);
    let machine = Kinematics { rates: [3000.0; 3], accelerations: [200.0; 3], junction_deviation: 0.01 };
    assert!(seconds(&result.steps, &machine) >= 0.0, "a program takes less than no time");
    if let Ok(job) = Job::from_steps("1001", &result.steps, dialect, &native_remark)
        && let Ok(post) = pathbuild_post::load("linuxcnc")
    {
        _ = post.write(&job, &PostOptions::default());
    }
}

const CLEAN: &[u8] = b"%\n([0.000 0.000]/T=5.000 #51)\nG00 Z20.000\nG01 F150.000 X1.000 Y0.000 Z1.000(=1.000+1.000*[#51-5.000])\nM30\n%\n";

/// Adjusts a program to measured values. The data contain the values, the program and a log, separated by lines of dashes.
fn values(data: &[u8]) {
    let mut parts = Vec::new();
    let mut rest = data;
    while let Some(at) = rest.windows(5).position(|part| part == b"\n---\n") {
        parts.push(&rest[..at]);
        rest = &rest[at + 5..];
    }
    parts.push(rest);
    let part = |number: usize, file: &'static str| {
        parts.get(number).map(|bytes| Source { file: Utf8Path::new(file), bytes })
    };
    let clean = Source { file: Utf8Path::new("a_Clean.gcode"), bytes: CLEAN };
    let inputs = Inputs {
        values: part(0, "a_Z.txt").unwrap_or(Source { file: Utf8Path::new("a_Z.txt"), bytes: b"" }),
        program: part(1, "a_Clean.gcode").unwrap_or(clean),
        log: part(2, "log"),
        max_correction: 1.0,
        below_plate: 0.5,
        model: ZModel::default(),
        shims: &[],
    };
    if let Ok(adjusted) = adjust(&inputs) {
        let (least, most) = adjusted.corrections;
        // Weights rounded to three decimals need not sum to 1, so `adjust` permits corrections that exceed the limit by this factor and amount.
        let limit = 1.002 + 0.002 + 1e-9;
        assert!(least.abs() <= limit && most.abs() <= limit, "a correction is too large");
    }
}

// Targets for the configuration and cached results.

/// Reads the text of a `pathbuild.toml`.
fn config(data: &[u8]) {
    let Ok(text) = std::str::from_utf8(data) else { return };
    for fault in config::check_text(Utf8Path::new("pathbuild.toml"), text) {
        let text = fault.text(Lang::En) + &fault.text(Lang::De);
        assert!(!text.contains(pathbuild_diagnostic::escaping::is_active), "{text:?}");
    }
}

/// Decodes cached findings.
fn cache(data: &[u8]) {
    if let Ok(found) = decode::<Diagnostic>(data) {
        _ = (found.text(Lang::En), found.help(Lang::De));
    }
}

/// A source of decisions, one per byte. After the last byte, the first alternative is always taken.
struct Choices<'a>(std::slice::Iter<'a, u8>);

impl<'a> Choices<'a> {
    fn new(data: &'a [u8]) -> Self {
        Self(data.iter())
    }

    fn has_more(&self) -> bool {
        !self.0.as_slice().is_empty()
    }

    fn below(&mut self, end: u8) -> u8 {
        self.0.next().copied().unwrap_or_default() % end
    }

    fn of<T: Copy>(&mut self, items: &[T]) -> T {
        items[usize::from(self.below(u8::try_from(items.len()).unwrap_or(u8::MAX)))]
    }

    /// Returns a coordinate in mm: on the grid, or slightly off it.
    fn coordinate(&mut self) -> f64 {
        let place = 10.0 * f64::from(self.below(6));
        match self.below(16) {
            0 => place + 0.0004,
            1 => place + 1e-7,
            2 => -place,
            3 => place * 1e4,
            _ => place,
        }
    }
}

const LINE_TYPES: [&str; 9] =
    ["CONTINUOUS", "DIVIDE", "BORDER", "CENTER", "DASHED", "HIDDEN", "DASHDOT", "DOT", "PHANTOM"];

const LAYERS: [&str; 6] = ["1001.1P", "1001.1P~A", "1001.2P", "8001.1P", "0", CLAMPS];

/// Name of the layer with clamps.
const CLAMPS: &str = "clamps";

const CLAMP_TEXTS: [&str; 6] = ["Z25", "Z4", "Z0", "25", "Z25 T2", "Z1e9"];

const WORDS: [&str; 40] = [
    "T5",
    "O2",
    "MX",
    "I1",
    "B0",
    "B-1",
    "D0.5",
    "F100",
    "S20",
    "H2",
    "C0.5",
    "A10",
    "P2",
    "U1",
    "W3",
    "R7",
    "Z30",
    "N",
    "E.*",
    ":A1",
    ":A=1;2",
    ":B=x",
    "I=A",
    "B=A",
    "F=B",
    ">1001.1P",
    ">1001.2P",
    ">8001.1P :A2",
    ">9999.1P",
    "@1001.2P",
    "Q1",
    "K2",
    "O=A",
    "T=A",
    "I0.001",
    "B-100",
    "S1e9",
    "X~",
    "\\P",
    "%%c",
];

const RADII: [f64; 9] = [0.5, 0.75, 1.0, 3.0, 1.0004, 1.001, 2.0, 7.5, 0.0];

const ANGLES: [f64; 9] = [0.0, 90.0, 180.0, 270.0, 360.0, 450.0, 36.87, -90.0, 1e-7];

/// Returns a drawing of lines, arcs, circles and texts on a grid, as the choices determine it.
fn grid_drawing(choices: &mut Choices<'_>) -> String {
    let mut text = String::from("0\nSECTION\n2\nENTITIES\n");
    // A start and an end make a valid path likely.
    entity(&mut text, "CIRCLE", "1001.1P", "PHANTOM", &[(10, 0.0), (20, 0.0), (40, 0.5)]);
    written(&mut text, "TEXT", "1001.1P", 0.0, 0.0, "T5 O2 I1 B0 MX");
    while choices.has_more() {
        any(&mut text, choices);
    }
    text.push_str("0\nENDSEC\n0\nEOF\n");
    text
}

fn any(text: &mut String, choices: &mut Choices<'_>) {
    let kind = choices.below(14);
    let layer = choices.of(&LAYERS);
    let line_type = choices.of(&LINE_TYPES);
    let (x, y) = (choices.coordinate(), choices.coordinate());
    let at = [(10, x), (20, y)];
    match kind {
        0..=4 => {
            let to = [(11, choices.coordinate()), (21, choices.coordinate())];
            entity(text, "LINE", layer, line_type, &[at, to].concat());
        }
        5 => {
            let angles = [(50, choices.of(&ANGLES)), (51, choices.of(&ANGLES))];
            let radius = [(40, 10.0 * choices.of(&RADII))];
            entity(text, "ARC", layer, line_type, &[&at[..], &radius, &angles].concat());
        }
        6 | 7 => entity(text, "CIRCLE", layer, line_type, &[at[0], at[1], (40, choices.of(&RADII))]),
        8 => entity(text, "CIRCLE", layer, "PHANTOM", &[at[0], at[1], (40, 1.0)]),
        9 => {
            let mut content =
                (0..=choices.below(5)).map(|_| choices.of(&WORDS)).collect::<Vec<_>>().join(" ");
            content.truncate(200);
            written(text, "TEXT", layer, x, y, &content);
        }
        10 => {
            let content = (0..=choices.below(3)).map(|_| choices.of(&WORDS)).collect::<Vec<_>>().join("\\P");
            written(text, "MTEXT", layer, x, y, &content);
        }
        11 => clamp(text, choices, x, y),
        12 => {
            let radius = choices.of(&RADII);
            entity(text, "CIRCLE", CLAMPS, line_type, &[at[0], at[1], (40, radius)]);
            written(text, "TEXT", CLAMPS, x, y, choices.of(&CLAMP_TEXTS));
        }
        _ => {
            let mut pairs = vec![(90, 3.0), (70, f64::from(choices.below(2)))];
            for _ in 0..3 {
                let bulge = choices.of(&[0.0, 1.0, -1.0, 0.414_213_562_373_095_1, 1e-9]);
                pairs.extend([(10, choices.coordinate()), (20, choices.coordinate()), (42, bulge)]);
            }
            entity(text, "LWPOLYLINE", layer, line_type, &pairs);
        }
    }
}

/// Draws the rectangle of a clamp, usually closed, with a height in it.
fn clamp(text: &mut String, choices: &mut Choices<'_>, x: f64, y: f64) {
    let (right, top) = (x + choices.coordinate(), y + choices.coordinate());
    let closed = if choices.below(8) == 7 { 0.0 } else { 1.0 };
    let corners = [(10, x), (20, y), (10, right), (20, y), (10, right), (20, top), (10, x), (20, top)];
    entity(text, "LWPOLYLINE", CLAMPS, "CONTINUOUS", &[&[(90, 4.0), (70, closed)][..], &corners].concat());
    let (middle, height) = ([f64::midpoint(x, right), f64::midpoint(y, top)], choices.of(&CLAMP_TEXTS));
    written(text, "TEXT", CLAMPS, middle[0], middle[1], height);
}

fn entity(text: &mut String, kind: &str, layer: &str, line_type: &str, pairs: &[(u16, f64)]) {
    _ = write!(text, "0\n{kind}\n8\n{layer}\n6\n{line_type}\n");
    for (code, value) in pairs {
        _ = write!(text, "{code}\n{value}\n");
    }
}

/// Draws a text with a height of 1 mm.
fn written(text: &mut String, kind: &str, layer: &str, x: f64, y: f64, content: &str) {
    let attachment = if kind == "MTEXT" { "71\n5\n" } else { "" };
    _ = write!(text, "0\n{kind}\n8\n{layer}\n10\n{x}\n20\n{y}\n40\n1\n{attachment}1\n{content}\n");
}
