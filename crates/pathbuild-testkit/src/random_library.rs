//! Randomly edited libraries with all kinds of correct and faulty embeddings, for tests that compare two implementations.

use std::fmt::Write;

use crate::naive::{Files, Rules};
use crate::parse::sheet;
use crate::random::Random;

/// A library in the directory `lib`, with another search directory `spare`, edited step by step.
#[derive(Debug)]
pub struct RandomLibrary {
    random: Random,
    files: Files,
    rules: Rules,
    slots: Vec<Slot>,
    /// Numbers of components that also have a definition in `spare`.
    spares: Vec<u32>,
}

/// A drawing of the library, which may be renamed or missing.
#[derive(Debug)]
struct Slot {
    kind: ComponentKind,
    file: Option<String>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum ComponentKind {
    Component(u32),
    Project(u32),
    /// The Q-project of a component.
    QProject(u32),
    /// Paths that each embed the next, deeper than allowed.
    Chain,
}

/// Properties that the embedding segment must match.
struct Signature {
    thickness: u32,
    material: &'static str,
    definitions: &'static str,
    values: &'static str,
    length: u32,
}

const COMPONENT_COUNT: u32 = 6;
const PROJECT_COUNT: u32 = 4;

/// Length in mm of the rapid moves between the embeddings of a project.
const SWEEP_LENGTH: u32 = 30;

/// Number of paths in a chain: two more than may be nested.
const CHAIN_LENGTH: u32 = 13;

impl RandomLibrary {
    /// Creates the library that follows from a seed.
    pub fn new(seed: u64) -> Self {
        let mut random = Random::new(seed, 7);
        let mut kinds: Vec<ComponentKind> =
            (1..=COMPONENT_COUNT).map(|n| ComponentKind::Component(1000 + n)).collect();
        kinds.extend((1..=PROJECT_COUNT).map(|n| ComponentKind::Project(8000 + n)));
        kinds.push(ComponentKind::QProject(1001));
        kinds.extend(random.once_in(8).then_some(ComponentKind::Chain));
        let mut rules =
            Rules { search: vec!["lib/parts".to_owned(), "spare".to_owned()], restrict: Vec::new() };
        if random.once_in(3) {
            rules.restrict =
                vec![("^8002".to_owned(), "^10".to_owned()), ("^800[0-2]".to_owned(), "P".to_owned())];
        }
        let slots = kinds.into_iter().map(|kind| Slot { kind, file: None }).collect();
        let mut workshop = Self { random, files: Files::new(), rules, slots, spares: Vec::new() };
        for slot in 0..workshop.slots.len() {
            workshop.draw(slot);
        }
        workshop
    }

    /// All files of the library, by path.
    pub fn files(&self) -> &Files {
        &self.files
    }

    /// The part of the configuration that affects the model.
    pub fn rules(&self) -> &Rules {
        &self.rules
    }

    /// Makes a random change: redraws, renames or removes a drawing, or defines a path twice. Returns the paths of the affected files.
    pub fn edit(&mut self) -> Vec<String> {
        let slot = self.random.below(self.slots.len());
        let before = self.slots[slot].file.clone();
        match self.random.below(10) {
            0 if before.is_some() => {
                let file = self.slots[slot].file.take().unwrap_or_default();
                self.files.remove(&file);
            }
            1 => self.rename(slot),
            2 | 3 => return vec![self.add_or_remove_spare()],
            _ => self.draw(slot),
        }
        before.into_iter().chain(self.slots[slot].file.clone()).collect()
    }

    /// Draws the file of a slot, for the first time or again, either correct or with a random fault.
    fn draw(&mut self, slot: usize) {
        let kind = self.slots[slot].kind;
        let file = match self.slots[slot].file.clone() {
            Some(file) => file,
            None => file_name(kind, &mut self.random),
        };
        let random = &mut self.random;
        let mut bytes = match kind {
            ComponentKind::Component(number) => component(number, random),
            ComponentKind::Project(number) => project(number, random),
            ComponentKind::QProject(number) => q_project(number, random),
            ComponentKind::Chain => chain(),
        };
        if matches!(kind, ComponentKind::Component(_)) && random.once_in(20) {
            // A truncated file, as if the CAD program had run out of disk space.
            bytes.truncate(bytes.len() * 4 / 5);
        }
        self.files.insert(file.clone(), bytes);
        self.slots[slot].file = Some(file);
    }

    fn rename(&mut self, slot: usize) {
        let Some(old) = self.slots[slot].file.take() else { return self.draw(slot) };
        let bytes = self.files.remove(&old).unwrap_or_default();
        let new = file_name(self.slots[slot].kind, &mut self.random);
        self.files.insert(new.clone(), bytes);
        self.slots[slot].file = Some(new);
    }

    /// Adds or removes a second definition of a component.
    fn add_or_remove_spare(&mut self) -> String {
        if !self.spares.is_empty() && self.random.once_in(2) {
            let number = self.spares.remove(self.random.below(self.spares.len()));
            let file = format!("spare/{number}.dxf");
            self.files.remove(&file);
            return file;
        }
        let number = 1001 + u32::try_from(self.random.below(4)).unwrap_or_default();
        let file = format!("spare/{number}.dxf");
        self.files.insert(file.clone(), component(number, &mut self.random));
        if !self.spares.contains(&number) {
            self.spares.push(number);
        }
        file
    }
}

fn file_name(kind: ComponentKind, random: &mut Random) -> String {
    match kind {
        ComponentKind::Component(1001) => "lib/parts/1001.dxf".to_owned(),
        ComponentKind::Component(n) => {
            let stem = match random.below(8) {
                0 => format!("{n}.1-{n}.9"),
                1 => format!("{n}-{}", n + 1),
                2 => format!("parts {n},1999"),
                3 => format!("without a number {}", n % 10),
                _ => n.to_string(),
            };
            format!("lib/parts/{stem}.{}", random.pick(&["dxf", "dxf", "DXF"]))
        }
        ComponentKind::Project(n) => format!("lib/projects/{n}.dxf"),
        ComponentKind::QProject(n) => format!("lib/parts/{n}_Q.dxf"),
        ComponentKind::Chain => "lib/parts/7001-7099.dxf".to_owned(),
    }
}

fn signature(number: u32) -> Signature {
    let thickness = 5 + number % 2;
    let material = if number.is_multiple_of(2) { "Plate" } else { "Block" };
    match (number / 1000, number % 4) {
        (8, 3) => Signature {
            thickness: 7,
            material: "Fixture",
            definitions: " :X1001.1P,1005.1P",
            values: " :X1005.1P",
            length: 110,
        },
        (8, _) => Signature { thickness: 7, material: "Fixture", definitions: "", values: "", length: 110 },
        (_, 1 | 3) => Signature { thickness, material, definitions: " :B0~1", values: " :B0,5", length: 40 },
        (_, 2) => {
            Signature { thickness, material, definitions: " :K?XY :A0,1", values: " :KX :A1", length: 40 }
        }
        _ => Signature { thickness, material, definitions: "", values: "", length: 40 },
    }
}

/// Writes a drawing in text form as DXF.
fn dxf(text: &str) -> Vec<u8> {
    sheet(text).unwrap_or_else(|errors| unreachable!("{}: {text}", errors[0])).to_dxf()
}

/// Returns a layer name in one of several spellings.
fn layer(name: &str, random: &mut Random) -> String {
    match random.below(8) {
        0 => name.to_lowercase(),
        1 => name.replace('.', "_"),
        _ => name.to_owned(),
    }
}

fn component(number: u32, random: &mut Random) -> Vec<u8> {
    let Signature { thickness, material, definitions, .. } = signature(number);
    let mut text = String::new();
    let paths = 1 + random.below(2);
    let faulty = if random.once_in(3) { random.below(paths) } else { paths };
    for path in 0..paths {
        let fault = if path == faulty { 1 + random.below(12) } else { 0 };
        let y = 60 * path;
        let own = layer(&format!("{number}.{}P", path + 1), random);
        let start = match fault {
            1 => format!("T{thickness} O2 I1 B0{definitions}"),
            2 => String::new(),
            3 => format!("T{} O2 I1 B0 M{material}{definitions}", thickness + 1),
            4 => format!("T{thickness} O2 I1 B0 S{thickness} M{material}{definitions}"),
            5 => format!("T{thickness} O2 I1 B0 M{material}{definitions} :Z1~0"),
            6 => format!("T{thickness} O2,5 I1 B0 M{material}{definitions}"),
            _ => format!("T{thickness} O2 I1 B0 M{material}{definitions}"),
        };
        let bottom = match (fault, number % 4) {
            (7, _) => "b1",
            (8, _) => "B=Q",
            (_, 1 | 3) => "B=B",
            (_, 2) => "B=A",
            _ => "B0,5",
        };
        let from = i32::from(fault == 9);
        let to = if fault == 10 { 41 } else { 40 };
        _ = writeln!(text, "layer {own}\nstart 0,{y}{}", quoted(&start));
        _ = writeln!(text, "mill {from},{y} {to},{y}{}\nend {to},{y}", quoted(bottom));
        if random.once_in(4) {
            _ = writeln!(text, "probe 20,{} \"T{thickness} H1 LA\"", y + 20);
        }
        if fault == 11 {
            _ = writeln!(text, "text 200,{y} \"B1\"");
        }
        if fault == 12 {
            _ = writeln!(text, "turn 20,{}", y + 10);
        }
    }
    if number == 1001 {
        proxies(&mut text, paths, random);
    }
    if random.once_in(4) {
        clamp(&mut text, random);
    }
    dxf(&text)
}

/// Draws a clamp beside the middle of the first path, beside the path that follows it in projects, or beside the rapid move in between:
/// just touching, in the way, lower or higher than the moves, or with an unclear height.
fn clamp(text: &mut String, random: &mut Random) {
    let x = random.pick(&[15, 15, 52, 82]);
    let y = random.pick(&["1", "0.75"]);
    let height = random.pick(&["0.5", "3", "9", "40"]);
    let (content, closed) = match random.below(8) {
        0 => (height.to_owned(), " closed"),
        1 => (format!("Z{height}"), ""),
        _ => (format!("Z{height}"), " closed"),
    };
    _ = writeln!(text, "layer {}", random.pick(&["clamps", "CLAMPS"]));
    _ = writeln!(text, "polyline {x},{y} {},{y} {},20 {x},20{closed}", x + 6, x + 6);
    _ = writeln!(text, "text {},10 \"{content}\"", x + 3);
}

/// Draws proxy lines for most paths.
fn proxies(text: &mut String, paths: usize, random: &mut Random) {
    _ = writeln!(text, "layer \"1001 PROXY\"");
    for path in 0..paths {
        let y = 200 + 30 * path;
        let Signature { thickness, material, values, .. } = signature(1001);
        let name = format!("1001.{}P", path + 1);
        let (content, length) = match random.below(10) {
            0 => (format!(">{name} T{} M{material}{values}", thickness + 1), 40),
            1 => (format!(">{name} T{thickness} M{material}{values}"), 42),
            2 => (format!(">1001.9P T{thickness} M{material}{values}"), 40),
            3 => continue,
            _ => (format!(">{name} T{thickness} O2 M{material}{values}"), 40),
        };
        _ = writeln!(text, "line DASHDOT 0,{y} {length},{y}{}", quoted(&content));
    }
}

fn q_project(number: u32, random: &mut Random) -> Vec<u8> {
    let Signature { thickness, material, .. } = signature(number);
    let mut text = format!("layer {number}.0Q\nstart 0,0 \"T{thickness} O2 M{material}\"\n");
    let fault = random.below(4);
    let paths = if fault == 0 { 1 } else { 2 };
    for path in 0..paths {
        let values = if fault == 1 { " :B0,75" } else { " :B0.5" };
        let content = format!(">{number}.{}P{values}", path + 1);
        _ = writeln!(text, "subpath {},0 {},0 \"{content}\"", 40 * path, 40 * path + 40);
    }
    _ = writeln!(text, "end {},0", 40 * paths);
    dxf(&text)
}

fn project(number: u32, random: &mut Random) -> Vec<u8> {
    let Signature { thickness, definitions, .. } = signature(number);
    let fault = if random.once_in(3) { 0 } else { 1 + random.below(14) };
    let faulty = random.below(2);
    let own = match fault {
        1 => "T4 O2 S20 MFixture".to_owned(),
        2 => format!("T{thickness} O2 MFixture E^99"),
        3 => format!("T{thickness} O2"),
        _ if random.once_in(4) => format!("T{thickness} O2 MFixture E^[18]00"),
        _ => format!("T{thickness} O2 MFixture"),
    };
    let mut text =
        format!("layer {}\nstart 0,0 \"{own}{definitions}\"\n", layer(&format!("{number}.1L"), random));
    let mut x = 0;
    for segment in 0..2 {
        let fault = if segment == faulty { fault } else { 0 };
        let embedded = match fault {
            // The project itself, which closes a cycle, or one with a lower number.
            4 | 5 => 8001 + u32::try_from(random.below((number - 8000) as usize)).unwrap_or_default(),
            _ => 1001 + u32::try_from(random.below(COMPONENT_COUNT as usize)).unwrap_or_default(),
        };
        let is_variable = number == 8003 && segment == 0 && fault == 0;
        let Signature { thickness, material, values, length, .. } =
            signature(if is_variable { 1001 } else { embedded });
        let name = match (embedded / 1000, is_variable) {
            (_, true) => "=X".to_owned(),
            (8, _) => format!("{embedded}.1L"),
            _ if random.once_in(6) => format!("{embedded}.1p"),
            _ => format!("{embedded}.1P"),
        };
        let height = if random.once_in(4) { " H0,75" } else { "" };
        let content = match fault {
            3 => format!(">{name} T{thickness}{values}"),
            6 => format!("T{thickness} M{material}"),
            7 => format!(">12 T{thickness} M{material}"),
            8 => format!(">{name}S T{thickness} M{material}{values}"),
            9 => format!(">1999.1P T{thickness} M{material}"),
            10 => format!(">{name} T{} M{material}{values}", thickness - 1),
            11 => format!(">{name} T{thickness} M{material}"),
            12 => format!(">{name} T{thickness} M{material}{values} :Q1"),
            13 => format!(
                ">{name} T{thickness} M{material}{}",
                values.replace("0,5", "2").replace("KX", "KQ").replace("A1", "A7")
            ),
            _ => format!(">{name} T{thickness} M{material}{values}{height}"),
        };
        let length = length + u32::from(fault == 14);
        _ = writeln!(text, "subpath {x},0 {},0 \"{content}\"", x + length);
        x += length;
        if segment == 0 {
            _ = writeln!(text, "sweep {x},0 {},0", x + SWEEP_LENGTH);
            x += SWEEP_LENGTH;
        }
    }
    _ = writeln!(text, "end {x},0");
    if random.once_in(4) {
        clamp(&mut text, random);
    }
    dxf(&text)
}

/// Returns a drawing with paths that each embed the next.
fn chain() -> Vec<u8> {
    let mut text = String::new();
    for path in 1..=CHAIN_LENGTH {
        let y = 30 * path;
        _ = writeln!(text, "layer 7001.{path}P\nstart 0,{y} \"T5 O2 I1 B0 MPlate\"");
        if path < CHAIN_LENGTH {
            _ = writeln!(text, "subpath 0,{y} 40,{y} \">7001.{}P\"", path + 1);
        } else {
            _ = writeln!(text, "mill 0,{y} 40,{y}");
        }
        _ = writeln!(text, "end 40,{y}");
    }
    dxf(&text)
}

/// Returns a quoted text after an element, or nothing if it is empty.
fn quoted(text: &str) -> String {
    if text.is_empty() { String::new() } else { format!(" \"{text}\"") }
}
