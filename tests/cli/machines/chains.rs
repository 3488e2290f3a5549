//! Tests random chains: lines, arcs with any pair of angles, and polylines with arcs, some in blocks that are inserted rotated, mirrored and
//! scaled. Each is milled at its drawn length, and every post gives the moves of the native program. (book: language/chains-and-passes)
//! `PATHBUILD_CHAINS=1000` sets the number of chains.

use std::fmt::Write;

use camino::Utf8PathBuf;
use pathbuild_gcode::dialect::{Charset, Dialect};
use pathbuild_gcode::interpret::{Options, interpret};
use pathbuild_gcode::native::{self, WriteOptions};
use pathbuild_post::{BUILT_IN, Language, load};
use pathbuild_testkit::sheet;
use pathbuild_toolpath::{Correction, MoveClass, Program, ProgramStep};
use pathbuild_workspace::{Inputs, config};
use rayon::prelude::*;

use super::changes::Dice;
use super::programs::{Named, of_inputs};
use super::{fault, say, shown, texts};
use crate::support::Place;

/// Text of the start marker. With T5 I1 B2 the passes are at 4, 3 and 2.
const PARAMETERS: &str = "T5 O2 S9 I1 B2 MPlate";
const PASSES: f64 = 3.0;

/// Number of chains in a run, unless `PATHBUILD_CHAINS` is set.
const CHAINS: usize = 60;

/// Number of chains in a drawing.
const IN_DRAWING: usize = 20;

#[test]
fn random_chains_are_milled_as_drawn_by_every_post() {
    let count = std::env::var("PATHBUILD_CHAINS").ok().and_then(|count| count.parse().ok());
    let count: usize = count.unwrap_or(CHAINS);
    let drawings: Vec<usize> = (0..count.div_ceil(IN_DRAWING)).collect();
    let faults: Vec<String> = drawings.par_iter().flat_map(|number| of_drawing(*number)).collect();
    say(&format!("{} random chains", drawings.len() * IN_DRAWING));
    assert!(faults.is_empty(), "{} faults\n{}", faults.len(), shown(&faults));
}

/// Returns the faults of the chains in a drawing.
fn of_drawing(number: usize) -> Vec<String> {
    let chains: Vec<Chain> =
        (0..IN_DRAWING).map(|index| Chain::random((number * IN_DRAWING + index) as u64)).collect();
    let layers = chains.iter().zip(1..).map(|(chain, index)| chain.layer(index));
    let text: String = layers.collect();
    let drawing = sheet(&text).unwrap_or_else(|error| panic!("{error:?}\n{text}")).to_dxf();
    let place = Place::new().file("1000.dxf", drawing);
    let directory = Utf8PathBuf::from_path_buf(place.path().to_owned()).unwrap();
    let (mut settings, _) = config::load(
        &pathbuild_db::system::OsSystem::shared(),
        &config::Overrides::default(),
        &Inputs::default(),
        &directory,
    );
    let general = &mut settings.general;
    (general.feed.value, general.rapid.value) = (Some(150.0), Some(1000.0));
    let programs = of_inputs(settings, vec![directory.join("1000.dxf").into_string()], "drawing");
    let mut faults = Vec::new();
    for (chain, index) in chains.iter().zip(1..) {
        let name = format!("1000.{index}P");
        match programs.iter().find(|it| *it.program.path == *name) {
            Some(it) => {
                faults.extend(of_chain(chain, it).map(|fault| format!("{fault}\n{}", chain.layer(index))));
            }
            None => faults.push(format!("no program of\n{}", chain.layer(index))),
        }
    }
    faults
}

fn of_chain(chain: &Chain, it: &Named) -> Option<String> {
    let (milled, drawn) = (milled(&it.program), PASSES * chain.length);
    if (milled - drawn).abs() > 0.001 * drawn {
        return Some(format!("{}: {milled} mm are milled, {drawn} mm drawn", it.name));
    }
    let options = WriteOptions {
        correction: Correction::default(),
        lang: pathbuild_diagnostic::Lang::En,
        charset: Charset::Ascii,
        rapid: 1000.0,
    };
    let text = native::write_program(&it.program, "", &options, usize::MAX).unwrap();
    if let Err(problem) = native::read_back(&text, &it.program) {
        return Some(format!("{}: {problem:?}", it.name));
    }
    let read = interpret(text.as_bytes(), Dialect::LinuxCnc, &Options::default());
    if let Some(problem) = read.problems.iter().find(|problem| problem.is_error()) {
        return Some(format!("{}: {}", it.name, texts(std::slice::from_ref(problem))));
    }
    let mut posts = BUILT_IN.iter().filter(|post| post.language != Language::Native);
    posts.find_map(|post| fault(post.name, &load(post.name).unwrap(), it))
}

fn milled(program: &Program) -> f64 {
    let length = |step: &ProgramStep| match step {
        ProgramStep::Move { count, .. } if count.class == MoveClass::Milling => count.length,
        _ => 0.0,
    };
    program.steps.iter().map(length).sum()
}

/// A chain from (0, 0), as statements of the test kit.
struct Chain {
    lines: Vec<String>,
    end: [f64; 2],
    /// Length of the chain in mm.
    length: f64,
    /// The insertion of the block, if the chain's elements are in one.
    insertion: Option<Insertion>,
}

/// An insertion of a block that makes the block's origin coincide with the drawing's.
struct Insertion {
    scale: [f64; 2],
    degrees: f64,
}

impl Chain {
    fn random(seed: u64) -> Self {
        let mut dice = Dice::new(seed);
        let mut chain = Self { lines: Vec::new(), end: [0.0; 2], length: 0.0, insertion: None };
        for _ in 0..=dice.below(6) {
            match dice.below(4) {
                0 => chain.line(&mut dice),
                1 => chain.polyline(&mut dice),
                _ => chain.arc(&mut dice),
            }
        }
        if dice.below(3) == 0 {
            chain.insert(&mut dice);
        }
        chain
    }

    fn line(&mut self, dice: &mut Dice) {
        let [x, y] = self.end;
        let to = [x + dice.between(1.0, 30.0), y + dice.between(-30.0, 30.0)];
        self.lines.push(format!("mill {x},{y} {},{}", to[0], to[1]));
        self.length += (to[0] - x).hypot(to[1] - y);
        self.end = to;
    }

    /// Adds an arc with random angles, up to a full turn.
    fn arc(&mut self, dice: &mut Dice) {
        let radius = dice.between(1.0, 25.0);
        let from = dice.between(0.0, 360.0);
        let sweep = if dice.below(8) == 0 { 360.0 } else { dice.between(2.0, 357.0) };
        let is_clockwise = dice.below(2) == 0;
        let to = if is_clockwise { from - sweep } else { from + sweep };
        let (sin, cos) = libm::sincos(from.to_radians());
        let centre = [self.end[0] - radius * cos, self.end[1] - radius * sin];
        let (sin, cos) = libm::sincos(to.to_radians());
        let turn = if is_clockwise { " cw" } else { "" };
        self.lines.push(format!(
            "mill arc centre {},{} r {radius} from {from} to {to}{turn}",
            centre[0], centre[1]
        ));
        self.length += sweep.to_radians() * radius;
        if sweep < 360.0 {
            self.end = [centre[0] + radius * cos, centre[1] + radius * sin];
        }
    }

    /// Adds two segments, one of which is an arc.
    fn polyline(&mut self, dice: &mut Dice) {
        let [x, y] = self.end;
        let chord = [dice.between(2.0, 20.0), dice.between(-20.0, 20.0)];
        let bulge = dice.between(-2.0, 2.0);
        let bulge = if bulge.abs() < 0.1 { 1.0 } else { bulge };
        let middle = [x + chord[0], y + chord[1]];
        let to = [middle[0] + dice.between(1.0, 10.0), middle[1]];
        self.lines.push(format!(
            "mill polyline {x},{y} bulge {bulge} {},{} {},{}",
            middle[0], middle[1], to[0], to[1]
        ));
        let angle = 4.0 * libm::atan(bulge.abs());
        let radius = chord[0].hypot(chord[1]) / (2.0 * libm::sin(angle / 2.0));
        self.length += angle * radius + (to[0] - middle[0]);
        self.end = to;
    }

    fn insert(&mut self, dice: &mut Dice) {
        let factor = dice.between(0.5, 2.0);
        let sign = if dice.below(2) == 0 { -1.0 } else { 1.0 };
        let insertion = Insertion { scale: [sign * factor, factor], degrees: dice.between(0.0, 360.0) };
        let (sin, cos) = libm::sincos(insertion.degrees.to_radians());
        let [x, y] = [self.end[0] * insertion.scale[0], self.end[1] * insertion.scale[1]];
        self.end = [x * cos - y * sin, x * sin + y * cos];
        self.length *= factor;
        self.insertion = Some(insertion);
    }

    fn layer(&self, index: usize) -> String {
        let mut text = format!("layer 1000.{index}P\nstart 0,0 \"{PARAMETERS}\"\n");
        let lines = self.lines.join("\n");
        match &self.insertion {
            None => writeln!(text, "{lines}").unwrap(),
            Some(Insertion { scale, degrees }) => writeln!(
                text,
                "block B{index}\n{lines}\nendblock\ninsert B{index} at 0,0 scale {},{} rotate {degrees}",
                scale[0], scale[1]
            )
            .unwrap(),
        }
        writeln!(text, "end {},{}", self.end[0], self.end[1]).unwrap();
        text
    }
}
