//! The posts included in pathbuild, in both definition languages. They can be used as they are, or as templates for other definitions.
//! (crates/pathbuild-post/posts)

use camino::Utf8Path;
use pathbuild_diagnostic::{Diagnostic, messages::posts, nearest};
use pathbuild_motion::{Arc, Coolant, Move, MoveShape, Pace, Plane, Turning};

use super::definition::PostDefinition;
use super::job::{Job, Operation, Tool};
use crate::Language;
use crate::job::{Hole, HoleKind, JobStep};

/// A post-processor included in pathbuild.
#[derive(Clone, Copy, Debug)]
pub struct BuiltIn {
    /// Name of the post on the command line.
    pub name: &'static str,
    /// Language of the definition.
    pub language: Language,
    /// One line that says which machines the post is for.
    pub description: &'static str,
    /// Text of the definition; for the native program, which has no definition, a description.
    pub text: &'static str,
}

/// All posts included in pathbuild, in listing order.
pub static BUILT_IN: &[BuiltIn] = &[
    BuiltIn {
        name: "native",
        language: Language::Native,
        description: "What pathbuild writes by default, with Z correction and statistics",
        text: NATIVE_EXPLANATION,
    },
    cambam_post("grbl", "GRBL 1.1", include_str!("../posts/grbl.cbpp")),
    cambam_post("linuxcnc", "LinuxCNC, mill", include_str!("../posts/linuxcnc.cbpp")),
    cambam_post("mach3", "Mach3 and Mach4, mill", include_str!("../posts/mach3.cbpp")),
    cambam_post("fanuc", "Fanuc and controls like it, mill", include_str!("../posts/fanuc.cbpp")),
    cambam_post("haas", "Haas mills", include_str!("../posts/haas.cbpp")),
    cambam_post("marlin", "Marlin 2 on a mill", include_str!("../posts/marlin.cbpp")),
    cambam_post("estlcam", "Estlcam CNC controller", include_str!("../posts/estlcam.cbpp")),
    BuiltIn {
        name: "din",
        language: Language::Cad6,
        description: "DIN 66025, as in the manual of CAD6",
        text: include_str!("../posts/din.toml"),
    },
    BuiltIn {
        name: "xpertmill",
        language: Language::Cad6,
        description: "XpertMILL (STEP-FOUR) import filter",
        text: include_str!("../posts/xpertmill.toml"),
    },
];

const NATIVE_EXPLANATION: &str = "\
The native program has no definition: it is what pathbuild writes without a post. A hole runs at the feed that was last set, heights
may have correction formulas, and the statistics stand at the end; the languages of definitions cannot say that. To change the words
of a program, begin with a copy of another post, such as `pathbuild post show linuxcnc`.
";

const fn cambam_post(name: &'static str, description: &'static str, text: &'static str) -> BuiltIn {
    BuiltIn { name, language: Language::CamBam, description, text }
}

/// Loads the built-in post with this name. The native program cannot be loaded, because it is not written through a definition.
///
/// # Errors
/// Fails if no built-in post has this name.
pub fn load(name: &str) -> Result<PostDefinition, Vec<Diagnostic>> {
    let definitions = || BUILT_IN.iter().filter(|post| post.language != Language::Native);
    let Some(post) = definitions().find(|post| post.name == name) else {
        let nearest = nearest(name, definitions().map(|post| post.name));
        let diagnostic =
            Diagnostic::new(&posts::POST_UNKNOWN).suggest_nearest(&posts::POST_UNKNOWN_NEAREST, nearest);
        return Err(vec![diagnostic.quoting("name", name)]);
    };
    let file = format!("{name}.{}", post.language.extension());
    PostDefinition::read(post.text.as_bytes(), Utf8Path::new(&file))
}

/// Returns programs that reveal which words a post writes. The first one is the simplest. A post that has no text for a feature refuses the
/// corresponding program.
pub fn samples() -> Vec<Job> {
    let hole = |kind| {
        JobStep::Hole(Hole {
            at: [0.0, 0.0],
            level: 5.0,
            retract: 1.0,
            bottom: -4.0,
            exit: 5.0,
            feed: Some(80.0),
            kind,
        })
    };
    let down = || vec![line(0.0, -1.0), line(10.0, -1.0)];
    let circle = Arc { plane: Plane::Xy, centre: [5.0, 0.0], clockwise: true, extra_turns: 0 };
    let arc = JobStep::Move(Move {
        from: [0.0, 0.0, -1.0].into(),
        to: [10.0, 0.0, -1.0].into(),
        shape: MoveShape::Arc(circle),
        pace: Pace::Feed(100.0),
        named: None,
    });
    let probe = JobStep::probe([None, None, Some(0.0)], Some(40.0));
    let plain = || operation(1, Coolant::FLOOD, down());
    vec![
        job(vec![plain()]),
        job(vec![plain(), operation(2, Coolant::MIST, down()), operation(1, Coolant::OFF, down())]),
        job(vec![Operation { spindle: Some(Turning::CounterClockwise), ..plain() }]),
        job(vec![operation(1, Coolant::OFF, vec![line(0.0, -1.0), arc])]),
        job(vec![operation(1, Coolant::OFF, vec![hole(HoleKind::Plain)])]),
        job(vec![operation(1, Coolant::OFF, vec![hole(HoleKind::Peck { depth: 2.0 })])]),
        job(vec![operation(1, Coolant::OFF, vec![probe])]),
        job(vec![operation(1, Coolant::OFF, [vec![JobStep::Dwell { seconds: 1.0 }], down()].concat())]),
    ]
}

fn job(operations: Vec<Operation>) -> Job {
    Job { name: "1.1P".into(), drawing: "1.dxf".into(), operations, ..Job::default() }
}

/// Creates a rapid move to the clearance plane: to the point with X and Y equal to `x`, or straight up if that is `None`.
fn rapid(x: Option<f64>) -> JobStep {
    JobStep::rapid([x, x, Some(5.0)])
}

fn line(x: f64, z: f64) -> JobStep {
    JobStep::feed([x, 0.0, z], Some(100.0))
}

fn operation(tool: u32, coolant: Coolant, steps: Vec<JobStep>) -> Operation {
    let operation = Operation::new("1.1P", Tool::new(tool, 3.0, "cutter"));
    Operation {
        part: "1.1P".into(),
        spindle: Some(Turning::Clockwise),
        speed: Some(1000.0),
        coolant: Some(coolant),
        clearance: 5.0,
        retract: 1.0,
        steps: [vec![rapid(Some(0.0))], steps, vec![rapid(None)]].concat(),
        ..operation
    }
}
