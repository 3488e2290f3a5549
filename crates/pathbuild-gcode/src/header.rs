//! Reads comments in which a program describes its tools and its stock. (book: program/reading)
//!
//! A value is read only from a keyed field of a form listed in [`FORMS`], never from free text. A value from a comment may be wrong, so it only adds
//! checks.

use std::collections::BTreeMap;

use pathbuild_diagnostic::messages::gcode as say;
use pathbuild_diagnostic::{Diagnostic, Message};
use pathbuild_motion::{Action, Group, Pace, StatedWord, Step};

use crate::interpret::INCH;
use crate::native::announces_probe;
use crate::provenance::{Provenance, head_remarks};
use crate::read::Problems;
use crate::verify::{Cutter, tool_to_insert};

/// Greatest error in mm that rounding may cause in a length of a comment, which often has two decimals. Two such lengths may differ by twice this.
const ROUNDING_TOLERANCE: f64 = 0.01;

/// Maximum difference in mm at which two lengths that are not rounded are considered equal.
const EXACT_TOLERANCE: f64 = 1e-6;

/// The unit of a length in a comment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StatedUnit {
    /// Millimetres, stated by the field itself.
    Millimetre,
    /// Inches, stated by the field itself.
    Inch,
    /// The unit that G20 or G21 selects for the program.
    OfProgram,
}

/// The shape of a cutter's tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Tip {
    /// The cutter is flat over its whole diameter.
    Flat,
    /// The corners are rounded with this radius, in the unit of the diameter.
    BullNose(f64),
    /// The tip is unknown, pointed, tapered or round.
    Unknown,
}

/// The moves for which a tool's description is valid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// The moves of the tool with this number.
    Number(u32),
    /// The moves from the comment to the first tool change after a cut.
    Following,
    /// All moves after the comment.
    Program,
}

/// A tool that a comment describes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StatedTool {
    /// The moves to which the description applies.
    pub scope: Scope,
    /// The diameter, in `unit`.
    pub diameter: f64,
    /// The shape of the tip.
    pub tip: Tip,
    /// The unit of the diameter.
    pub unit: StatedUnit,
}

/// Corners of the stock in program coordinates; a corner that the comment does not state is `None`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StatedStock {
    /// The corner with the least coordinates.
    pub low: Option<[f64; 3]>,
    /// The corner with the greatest coordinates. Its height is that of the surface.
    pub high: Option<[f64; 3]>,
    /// The unit of the coordinates.
    pub unit: StatedUnit,
}

/// The data that one comment states.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statement {
    /// The tool, if the comment describes one.
    pub tool: Option<StatedTool>,
    /// The stock, if the comment describes it.
    pub stock: Option<StatedStock>,
    /// The height of the stock's upper face in mm, if it is given without the stock.
    pub surface: Option<f64>,
    /// The number of the tool to insert, if the tool change itself is only a comment.
    pub change: Option<u32>,
}

/// A form of comment that describes tools or the stock.
#[derive(Debug)]
pub struct HeaderForm {
    /// The software that writes comments of this form.
    pub name: &'static str,
    /// Programs or documents in which the form was seen.
    pub source: &'static str,
    /// A comment in this form.
    pub sample: &'static str,
    /// The start of an earlier comment, in upper or lower case, that must occur in the program if the form by itself could be free text.
    pub signature: Option<&'static str>,
    read: fn(&str) -> Option<Statement>,
}

/// The start of the header line, in the case in which most posts write it.
const PATHBUILD: &str = "pathbuild ";

macro_rules! header_forms {
    ($($name:literal, $source:literal, $sample:literal, $($signature:expr)? => $read:ident;)*) => {
        /// The known forms. All samples were made up to fit the form, not copied from programs.
        ///
        /// Estlcam, `SheetCam` and dxf2gcode name tools by free text only, so nothing is read from their programs.
        pub static FORMS: &[HeaderForm] = &[$(HeaderForm {
            name: $name,
            source: $source,
            sample: $sample,
            signature: header_forms!(signature $($signature)?),
            read: $read,
        },)*];
    };
    (signature) => { None };
    (signature $signature:expr) => { Some($signature) };
}

header_forms! {
    "pathbuild", "provenance.rs",
        "pathbuild 0.2.0 3f2a9c0d41b7e685-09c1d2e3 grbl O2 T5", => pathbuild_tool;
    "pathbuild", "the list of tools and the tool changes of the built-in posts, and those of CamBam's definitions",
        "T2: 1.0 end mill", PATHBUILD => pathbuild_list_entry;
    "pathbuild", "the built-in post for Marlin, because Marlin has no T",
        "Insert T2, set Z zero", PATHBUILD => pathbuild_change;
    "Fusion 360", "shooshx/led_floor, cad/nc/6mm/1022_block2x2_17bit.nc; posts that Autodesk publishes",
        "T1  D=1.7 CR=0 - ZMIN=-3 - flat end mill", => fusion_tool;
    "CutViewer", "TOOL/MILL, diameter, corner radius, height, taper angle: Carbide Create, CamBam, HeeksCNC",
        "TOOL/MILL,3.17, 0.00, 12.70, 0.00", => cut_viewer_tool;
    "CutViewer", "STOCK/BLOCK, sizes, program zero from the lower corner: Carbide Create, posts for Fusion",
        "STOCK/BLOCK,100.00, 100.00, 1.00,0.00, 0.00, 1.00", => cut_viewer_stock;
    "Carbide Create", "written above STOCK/BLOCK",
        "stockMin:0.00mm, 0.00mm, -1.00mm", => carbide_create_tool;
    "VCarve", "the form named in issue 35; seen only in samples written in its style",
        "1 = End Mill {3.175 mm}", => vcarve_tool;
    "FreeCAD", "programs by grbl_post and linuxcnc_post",
        "TC: 3.175mm Endmill", "Exported by FreeCAD" => freecad_label;
    "FreeCAD", "SergeyPopovGit/CNC, Cicloid_Gear/Ecscentrick_0.5_8_12_mm_slote_33MM_cut.nc; FreeCAD calculates in millimetres",
        "Compensated Tool Path. Diameter: 6.35", "Exported by FreeCAD" => freecad_diameter;
    "FreeCAD", "grbl_post, because GRBL has no M6",
        "M6 T4.0", "Exported by FreeCAD" => freecad_change;
    "Kiri:Moto", "its list of tools",
        "tool#=1 flute=6 len=20 unit=metric", => kiri_moto_tool;
    "pcb2gcode", "programs by pcb2gcode 2.5, in mm or in",
        "MSG, Change tool bit to cutter diameter 1.5mm", => pcb2gcode_tool;
    "CamBam", "programs posted by CamBam's post-processor Default, with ( T2 : 2.0 ) before T2 M6",
        "T2 : 2.0", "Made using CamBam" => cambam_tool;
}

/// Parses a comment, without its brackets, by the first form that fits. `is_signed` reports whether a form's signature has been found.
pub fn parse_comment(
    comment: &str,
    is_signed: &dyn Fn(&str) -> bool,
) -> Option<(&'static HeaderForm, Statement)> {
    let signed = |form: &&HeaderForm| form.signature.is_none_or(is_signed);
    FORMS.iter().filter(signed).find_map(|form| Some((form, (form.read)(comment.trim())?)))
}

/// Collector of a program's tool changes and of the data in its comments. The program's steps are passed to it one by one.
#[derive(Debug, Default)]
pub struct HeaderReader {
    events: Vec<TimedEvent>,
    signatures: Vec<&'static str>,
    /// Whether comments announce probes, as those of pathbuild's probing programs do.
    announces_probes: bool,
    /// Whether the program stops without a message that names the tool to insert. The operator may change the tool there.
    has_unnamed_stop: bool,
}

/// An event, with the line of its step and the position in the order of execution.
type TimedEvent = (u32, u32, Event);

#[derive(Clone, Copy, Debug, PartialEq)]
enum Event {
    /// A T word, with the number of the tool.
    Select(u32),
    /// An M6, with the number of the tool that it inserts.
    Insert(u32),
    /// A G code for the unit, times ten.
    Unit(u16),
    /// One or more consecutive cuts.
    Cut,
    /// One or more consecutive probes of the material, straight down.
    Probe,
    Statement(Statement),
}

impl HeaderReader {
    /// Processes the next step of the program.
    pub fn step(&mut self, step: &Step) {
        let event = match &step.action {
            Action::Move(movement) if matches!(movement.pace, Pace::Feed(_)) => Event::Cut,
            Action::Move(movement) if movement.probes_down() => Event::Probe,
            Action::ChangeTool(number) => Event::Insert(number.unwrap_or(0)),
            Action::SelectTool(number) => Event::Select(*number),
            Action::Word(StatedWord { group: Some(Group::Units), code, .. }) => Event::Unit(*code),
            Action::Comment(text) => return self.comment(step.line, step.order, text),
            Action::Stop { .. } => {
                let names_tool =
                    |event: &Event| matches!(event, Event::Statement(Statement { change: Some(_), .. }));
                let last = self.events.last();
                self.has_unnamed_stop |=
                    !last.is_some_and(|(line, _, event)| *line == step.line && names_tool(event));
                return;
            }
            _ => return,
        };
        let is_repeated = matches!(event, Event::Cut | Event::Probe)
            && self.events.last().is_some_and(|(.., last)| *last == event);
        if !is_repeated {
            self.events.push((step.line, step.order, event));
        }
    }

    /// Processes the comments at the beginning of a text. Needed for programs that are translated by the definition of their post, because their
    /// steps contain no comments.
    pub fn read_head_comments(&mut self, text: &[u8]) {
        let steps = std::mem::take(&mut self.events);
        head_remarks(text).for_each(|remark| self.comment(0, 0, &remark));
        self.events.extend(steps);
    }

    fn comment(&mut self, line: u32, order: u32, text: &str) {
        self.announces_probes |= announces_probe(text);
        let signed = FORMS.iter().filter_map(|form| form.signature);
        // Some posts write only upper case.
        let begins = |signature: &&str| {
            let start = text.trim().get(..signature.len());
            start.is_some_and(|start| start.eq_ignore_ascii_case(signature))
        };
        self.signatures.extend(signed.filter(begins));
        let found = parse_comment(text, &|signature| self.signatures.contains(&signature));
        self.events.extend(found.map(|(_, statement)| (line, order, Event::Statement(statement))));
    }

    /// Returns the tools and the stock that all comments of the program describe. `inch` is ten times the G code that selects inches (200 for G20).
    pub fn finish(mut self, inch: u16) -> Header {
        let has = |searched: Event| self.events.iter().any(|(.., event)| *event == searched);
        let is_probing = self.announces_probes || has(Event::Probe) && !has(Event::Cut);
        if !is_probing {
            self.events.retain(|(.., event)| *event != Event::Probe);
        }
        let has_insertions = self.events.iter().any(|(.., event)| matches!(event, Event::Insert(_)));
        let has_selections = self.events.iter().any(|(.., event)| matches!(event, Event::Select(_)));
        let changed = |event: &Event| match event {
            Event::Insert(number) => Some(*number),
            Event::Select(number) if !has_insertions => Some(*number),
            Event::Statement(statement) if !has_insertions && !has_selections => statement.change,
            _ => None,
        };
        let changes = self.events.iter().filter_map(|(line, _, event)| Some((*line, changed(event)?)));
        let first = self.first_tool().filter(|_| !has_insertions && !has_selections);
        let mut header =
            Header { changes: first.into_iter().chain(changes).collect(), is_probing, ..Header::default() };
        let mut collector =
            Collector { in_inches: starts_in_inches(&self.events, inch), ..Collector::default() };
        collector.number = first.map(|(_, number)| number);
        collector.read_numbered_tools(&self.events, inch);
        for (line, order, event) in &self.events {
            collector.event((*line, *order), event, changed(event), inch);
        }
        if header.changes.is_empty() {
            collector.assign_only_tool();
        }
        // A program with subprograms, loops and branches need not execute all of its lines.
        if self.events.iter().all(|(line, order, _)| line == order) {
            collector.report_unselected_tools(&header.changes);
        }
        header.tools = collector.tools;
        header.surface = collector.surface;
        header.is_of_pathbuild = collector.is_of_pathbuild;
        header.problems = collector.problems.into_diagnostics();
        header
    }

    /// Returns the line and the number of the tool that is in the spindle at the beginning of a program of pathbuild without T words: the first of
    /// several tools in its list, which are listed in the order in which they cut. `None` if the program also stops where no tool is named.
    fn first_tool(&self) -> Option<(u32, u32)> {
        let number = |(line, _, event): &TimedEvent| match event {
            Event::Statement(Statement {
                tool: Some(StatedTool { scope: Scope::Number(number), .. }),
                ..
            }) => Some((*line, *number)),
            _ => None,
        };
        let mut listed = self.events.iter().filter_map(number);
        let first =
            listed.next().filter(|_| self.signatures.contains(&PATHBUILD) && !self.has_unnamed_stop)?;
        listed.any(|(_, other)| other != first.1).then_some(first)
    }
}

/// Whether the program's first unit word selects inches. It also applies to comments above it: Fusion writes its list of tools above G20 or G21.
fn starts_in_inches(events: &[TimedEvent], inch: u16) -> bool {
    let unit = |event: &Event| if let Event::Unit(code) = event { Some(*code == inch) } else { None };
    events.iter().find_map(|(.., event)| unit(event)).unwrap_or(false)
}

/// The tools and the stock of a program, as its comments describe them.
#[derive(Debug, Default)]
pub struct Header {
    /// Line and number of each tool that the program inserts (M6); if it inserts none, of each tool that it selects (T); if it has neither word, of
    /// each tool change in a comment.
    pub changes: Vec<(u32, u32)>,
    /// Whether the program only probes the material, and never cuts, or should do so according to its comments.
    pub is_probing: bool,
    /// The tools that cut, or that probe if none cuts, in the order of execution.
    pub tools: Vec<CuttingTool>,
    /// The height of the stock's upper face in mm.
    pub surface: Option<f64>,
    /// Whether a comment written by pathbuild states the height of the stock's upper face.
    pub is_of_pathbuild: bool,
    /// Contradictions between comments, and tools that comments list but the program never selects.
    pub problems: Vec<Diagnostic>,
}

/// A tool that cuts, and the step from which it is in use.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CuttingTool {
    /// The line of the step from which the tool is in use.
    pub line: u32,
    /// Position of that step in the order of execution.
    pub order: u32,
    /// The tool's T number.
    pub number: Option<u32>,
    /// The tool's widths, if comments state them.
    pub cutter: Option<StatedCutter>,
}

/// The widths of a tool in mm, as comments state them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StatedCutter {
    /// Line of the comment that describes the tool.
    pub line: u32,
    /// The diameter in mm.
    pub diameter: f64,
    /// The width in mm of the flat part of the tip, if it is known.
    pub flat: Option<f64>,
    /// Maximum difference in mm at which another diameter is considered equal to this one.
    tolerance: f64,
}

impl StatedCutter {
    fn new(line: u32, tool: &StatedTool, in_inches: bool) -> Self {
        let scale = scale(tool.unit, in_inches);
        let flat = match tool.tip {
            Tip::Flat => Some(tool.diameter),
            Tip::BullNose(radius) => Some((tool.diameter - 2.0 * radius).max(0.0)),
            Tip::Unknown => None,
        };
        // pathbuild writes all digits, so its diameters are exact.
        let tolerance =
            if tool.scope == Scope::Program { EXACT_TOLERANCE } else { ROUNDING_TOLERANCE + EXACT_TOLERANCE };
        Self { line, diameter: tool.diameter * scale, flat: flat.map(|flat| flat * scale), tolerance }
    }

    /// Whether the given diameter equals this one within the precision of the comment.
    pub fn has_diameter(&self, diameter: f64) -> bool {
        libm::fabs(self.diameter - diameter) <= self.tolerance
    }

    /// Returns the widths for the check of rapid moves. If the tip is not known to be flat, only the centre line of the moves is considered, both for
    /// removing material and for collisions, so that the tool always fits into its own cut.
    pub fn widths(&self) -> Cutter {
        let flat = self.flat.unwrap_or(0.0);
        let corner_radius = self.flat.map(|flat| (self.diameter - flat) / 2.0);
        Cutter { diameter: self.diameter, removed: flat, colliding: flat, corner_radius }
    }

    /// Returns the message if two descriptions of a tool contradict each other.
    fn contradiction(&self, other: &Self, is_numbered: bool) -> Option<&'static Message> {
        let differ =
            |one: f64, other: f64| libm::fabs(one - other) > 2.0 * ROUNDING_TOLERANCE + EXACT_TOLERANCE;
        if differ(self.diameter, other.diameter) {
            return Some(if is_numbered { &say::TOOL_STATED_TWICE } else { &say::CURRENT_TOOL_STATED_TWICE });
        }
        let (one, other) = self.flat.zip(other.flat)?;
        differ(one, other).then_some(&say::TIP_STATED_TWICE)
    }

    /// Combines two descriptions of a tool: the greater diameter, and the smaller width that is known to be flat.
    fn merged_with(&self, other: &Self) -> Self {
        let flat = [self.flat, other.flat].into_iter().flatten().reduce(f64::min);
        Self { diameter: self.diameter.max(other.diameter), flat, ..*self }
    }
}

fn scale(unit: StatedUnit, in_inches: bool) -> f64 {
    match unit {
        StatedUnit::Inch => INCH,
        StatedUnit::OfProgram if in_inches => INCH,
        StatedUnit::OfProgram | StatedUnit::Millimetre => 1.0,
    }
}

/// Collector that assigns the statements in comments to the tools that cut.
#[derive(Default)]
struct Collector {
    in_inches: bool,
    numbered: BTreeMap<u32, StatedCutter>,
    /// The tool that a comment describes for all moves after it.
    program_tool: Option<StatedCutter>,
    /// The number of the tool of the last cut, and the tool that was described for the whole program there.
    last_cut_tool: Option<(Option<u32>, StatedCutter)>,
    /// The description of the tool in use, and whether that tool has cut.
    current_tool: Option<(StatedCutter, bool)>,
    number: Option<u32>,
    /// The line and the order of the last tool change since the last cut, or else of the first description of a tool since then. The next cut begins
    /// another entry of `tools` there.
    new_tool: Option<(u32, u32)>,
    tools: Vec<CuttingTool>,
    corners: [Option<(u32, [f64; 3])>; 2],
    surface: Option<f64>,
    is_of_pathbuild: bool,
    problems: Problems,
}

impl Collector {
    /// Reads the descriptions of numbered tools, which may be anywhere in the program.
    fn read_numbered_tools(&mut self, events: &[TimedEvent], inch: u16) {
        let mut in_inches = self.in_inches;
        for (line, _, event) in events {
            match event {
                Event::Unit(code) => in_inches = *code == inch,
                Event::Statement(Statement { tool: Some(tool), .. }) => {
                    let Scope::Number(number) = tool.scope else { continue };
                    let cutter = StatedCutter::new(*line, tool, in_inches);
                    let known = self.numbered.get(&number).copied();
                    let cutter = self.combine(known, cutter, Some(number));
                    self.numbered.insert(number, cutter);
                }
                _ => {}
            }
        }
    }

    /// Reports each listed tool to which the program never changes, or only the first one if it changes to none of them. Nothing is reported for a
    /// program without tool changes, which leaves the choice of the tool to the operator.
    fn report_unselected_tools(&mut self, changes: &[(u32, u32)]) {
        let is_used = |number: &u32| changes.iter().any(|(_, change)| change == number);
        let most = match changes {
            [] => 0,
            _ if self.numbered.keys().any(is_used) => usize::MAX,
            _ => 1,
        };
        let unused = self.numbered.iter().filter(|(number, _)| !is_used(number));
        for (number, cutter) in unused.take(most) {
            self.problems.add_at_line(&say::TOOL_NEVER_SELECTED, cutter.line, |d| {
                d.with("number", u64::from(*number))
            });
        }
    }

    fn event(&mut self, place: (u32, u32), event: &Event, change: Option<u32>, inch: u16) {
        if let Some(number) = change {
            self.number = Some(number);
            self.new_tool = Some(place);
            self.current_tool = self.current_tool.filter(|(_, has_cut)| !has_cut);
        }
        match event {
            Event::Unit(code) => self.in_inches = *code == inch,
            Event::Cut | Event::Probe => self.assign_tool_to_cut(),
            Event::Statement(statement) => self.statement(place, statement),
            Event::Select(_) | Event::Insert(_) => {}
        }
    }

    fn statement(&mut self, place: (u32, u32), statement: &Statement) {
        let (line, _) = place;
        if let Some(tool) = &statement.tool {
            let cutter = StatedCutter::new(line, tool, self.in_inches);
            match tool.scope {
                Scope::Number(_) => {}
                Scope::Program => {
                    // A second header belongs to a program that was appended to the first one.
                    if self.program_tool.replace(cutter).is_some() {
                        self.new_tool.get_or_insert(place);
                    }
                }
                Scope::Following => {
                    let known = self.current_tool.filter(|(_, has_cut)| !has_cut).map(|(known, _)| known);
                    self.current_tool = Some((self.combine(known, cutter, None), false));
                    self.new_tool.get_or_insert(place);
                }
            }
        }
        if let Some(stock) = &statement.stock {
            let scale = scale(stock.unit, self.in_inches);
            for (index, corner) in [stock.low, stock.high].into_iter().enumerate() {
                let Some(corner) = corner else { continue };
                self.corner(line, index, corner.map(|coordinate| coordinate * scale));
            }
            self.surface = self.corners[1].map(|(_, high)| high[2]);
        }
        if let Some(surface) = statement.surface {
            self.header_surface(line, surface);
        }
    }

    /// Records the surface that a header of pathbuild states. If several headers contradict each other, the highest surface is used.
    fn header_surface(&mut self, line: u32, surface: f64) {
        let is_second = std::mem::replace(&mut self.is_of_pathbuild, true);
        let known = self.surface.filter(|_| is_second);
        if let Some(known) = known.filter(|known| libm::fabs(known - surface) > EXACT_TOLERANCE) {
            self.problems.add_at_line(&say::SURFACE_STATED_TWICE, line, |d| {
                d.with("one", known).with("other", surface)
            });
        }
        self.surface = Some(known.map_or(surface, |known| known.max(surface)));
    }

    /// Records a corner of the stock. If comments state different corners, the one with the greater Z is used.
    fn corner(&mut self, line: u32, index: usize, corner: [f64; 3]) {
        let Some((_, known)) = self.corners[index] else {
            self.corners[index] = Some((line, corner));
            return;
        };
        let is_near = |(one, other): (&f64, &f64)| {
            libm::fabs(one - other) <= 2.0 * ROUNDING_TOLERANCE + EXACT_TOLERANCE
        };
        if let Some(axis) = (0..3).find(|axis| !is_near((&known[*axis], &corner[*axis]))) {
            let letter = ["X", "Y", "Z"][axis];
            self.problems.add_at_line(&say::STOCK_STATED_TWICE, line, |d| {
                d.quoting("axis", letter).with("one", known[axis]).with("other", corner[axis])
            });
        }
        let highest = if known[2] > corner[2] { known } else { corner };
        self.corners[index] = Some((line, highest));
    }

    fn assign_tool_to_cut(&mut self) {
        if let Some((_, has_cut)) = &mut self.current_tool {
            *has_cut = true;
        }
        let (line, order) = match self.new_tool.take() {
            Some(place) => place,
            None if self.tools.is_empty() => (0, 0),
            None => return,
        };
        let before =
            self.last_cut_tool.filter(|(number, _)| *number == self.number).map(|(_, cutter)| cutter);
        self.last_cut_tool = self.program_tool.map(|cutter| (self.number, cutter));
        let program_tool = self.program_tool.map(|cutter| self.combine(before, cutter, self.number));
        let numbered_tool = self.number.and_then(|number| self.numbered.get(&number).copied());
        let current_tool = self.current_tool.map(|(cutter, _)| cutter);
        let stated = [program_tool, numbered_tool, current_tool].into_iter().flatten();
        let cutter = stated.fold(None, |known, next| Some(self.combine(known, next, self.number)));
        self.tools.push(CuttingTool { line, order, number: self.number, cutter });
    }

    /// Assigns the only listed tool to the cuts of a program without tool changes.
    fn assign_only_tool(&mut self) {
        let mut numbered = self.numbered.iter();
        let (Some((number, cutter)), None) = (numbered.next(), numbered.next()) else { return };
        for tool in self.tools.iter_mut().filter(|tool| tool.cutter.is_none()) {
            (tool.number, tool.cutter) = (Some(*number), Some(*cutter));
        }
    }

    /// Combines a description with a known one, and reports a contradiction between them.
    fn combine(
        &mut self,
        known: Option<StatedCutter>,
        next: StatedCutter,
        number: Option<u32>,
    ) -> StatedCutter {
        let Some(known) = known else { return next };
        if let Some(message) = known.contradiction(&next, number.is_some()) {
            self.problems.add_at_line(message, next.line.max(known.line), |d| {
                let d = d.with("number", u64::from(number.unwrap_or(0)));
                d.with("one", known.diameter).with("other", next.diameter)
            });
        }
        known.merged_with(&next)
    }
}

fn tool(scope: Scope, diameter: f64, tip: Tip, unit: StatedUnit) -> Statement {
    Statement { tool: Some(StatedTool { scope, diameter, tip, unit }), ..Statement::default() }
}

fn pathbuild_tool(comment: &str) -> Option<Statement> {
    let provenance: Provenance = comment.parse().ok()?;
    let flat = |diameter| tool(Scope::Program, diameter, Tip::Flat, StatedUnit::Millimetre);
    let stated = provenance.cutter.map_or_else(Statement::default, flat);
    Some(Statement { surface: provenance.thickness, ..stated })
}

fn pathbuild_list_entry(comment: &str) -> Option<Statement> {
    let (number, text) = comment.strip_prefix('T')?.split_once(':')?;
    let scope = Scope::Number(number.trim().parse().ok()?);
    Some(tool(scope, positive(text.split_whitespace().next()?)?, Tip::Flat, StatedUnit::OfProgram))
}

fn pathbuild_change(comment: &str) -> Option<Statement> {
    Some(Statement { change: Some(tool_to_insert(comment)?), ..Statement::default() })
}

fn fusion_tool(comment: &str) -> Option<Statement> {
    let mut parts = comment.split(" - ").map(str::trim);
    let mut words = parts.next()?.split_whitespace();
    let number = words.next()?.strip_prefix(['T', 't'])?.parse().ok()?;
    let mut field = words.next()?;
    if field.starts_with("ID=") {
        field = words.next()?;
    }
    let diameter = positive(field.strip_prefix("D=")?)?;
    let radius = not_negative(words.next()?.strip_prefix("CR=")?)?;
    let is_tapered = words.any(|word| word.starts_with("TAPER="));
    let kind = parts.find(|part| !part.starts_with("ZMIN=")).unwrap_or_default().to_ascii_lowercase();
    // V-bits also have CR=0, so only the name of the tool's type shows that the tool is flat.
    let tip = match &*kind {
        "flat end mill" | "face mill" if radius == 0.0 && !is_tapered => Tip::Flat,
        "bullnose end mill" | "bull nose end mill" if !is_tapered => Tip::BullNose(radius),
        "ball end mill" if !is_tapered && is_half(radius, diameter) => Tip::BullNose(radius),
        _ => Tip::Unknown,
    };
    Some(tool(Scope::Number(number), diameter, tip, StatedUnit::OfProgram))
}

/// Whether a corner radius is half of a diameter, up to the rounding of both.
fn is_half(radius: f64, diameter: f64) -> bool {
    (2.0 * radius - diameter).abs() <= ROUNDING_TOLERANCE + EXACT_TOLERANCE
}

fn cut_viewer_tool(comment: &str) -> Option<Statement> {
    let fields = numbers(after_key(comment, "TOOL/MILL")?)?;
    let diameter = fields.first().copied().filter(|diameter| *diameter > 0.0)?;
    // Carbide Create describes a V-bit by the width of its point and a taper angle.
    let tip = match (fields.get(1), fields.get(3)) {
        (Some(0.0), Some(0.0)) => Tip::Flat,
        (Some(radius), Some(0.0)) if *radius > 0.0 => Tip::BullNose(*radius),
        _ => Tip::Unknown,
    };
    Some(tool(Scope::Following, diameter, tip, StatedUnit::OfProgram))
}

/// Parses the stock of `CutViewer`. The origin is the position of program zero, measured from the lower corner of the block. Without it, the position
/// of the stock is unknown.
fn cut_viewer_stock(comment: &str) -> Option<Statement> {
    let fields: [f64; 6] = numbers(after_key(comment, "STOCK/BLOCK")?)?.try_into().ok()?;
    let (size, origin) = ([fields[0], fields[1], fields[2]], [fields[3], fields[4], fields[5]]);
    if size.iter().any(|side| *side <= 0.0) {
        return None;
    }
    let low = origin.map(|offset| 0.0 - offset);
    let high = [low[0] + size[0], low[1] + size[1], low[2] + size[2]];
    let stock = StatedStock { low: Some(low), high: Some(high), unit: StatedUnit::OfProgram };
    Some(Statement { stock: Some(stock), ..Statement::default() })
}

fn carbide_create_tool(comment: &str) -> Option<Statement> {
    let (key, fields) = comment.split_once(':')?;
    let unit = if fields.ends_with("mm") { StatedUnit::Millimetre } else { StatedUnit::Inch };
    let suffix = if unit == StatedUnit::Inch { "in" } else { "mm" };
    let coordinate = |field: &str| number(field.trim().strip_suffix(suffix)?);
    let corner: Vec<f64> = fields.split(',').map(coordinate).collect::<Option<_>>()?;
    let corner = Some(corner.try_into().ok()?);
    let stock = match key {
        "stockMin" => StatedStock { low: corner, high: None, unit },
        "stockMax" => StatedStock { low: None, high: corner, unit },
        _ => return None,
    };
    Some(Statement { stock: Some(stock), ..Statement::default() })
}

fn vcarve_tool(comment: &str) -> Option<Statement> {
    let (number, description) = comment.split_once(" = ")?;
    let (name, size) = description.trim().strip_suffix('}')?.split_once('{')?;
    let (diameter, unit) = size.trim().split_once(' ')?;
    let tip = match name.trim() {
        "End Mill" => Tip::Flat,
        "Ball Nose" | "Engrave" | "Form Tool" | "Drill" | "Tapered Ball Nose" => Tip::Unknown,
        // This includes V-bits: their size is an angle in degrees.
        _ => return None,
    };
    Some(tool(Scope::Number(number.trim().parse().ok()?), positive(diameter)?, tip, unit_named(unit)?))
}

/// Parses a tool of FreeCAD. Users may rename a tool, so its name does not prove that it is flat.
fn freecad_label(comment: &str) -> Option<Statement> {
    let (size, _) = comment.strip_prefix("TC: ")?.split_once(' ')?;
    let diameter = positive(size.strip_suffix("mm")?)?;
    Some(tool(Scope::Following, diameter, Tip::Unknown, StatedUnit::Millimetre))
}

fn freecad_diameter(comment: &str) -> Option<Statement> {
    let diameter = comment.strip_prefix("Compensated Tool Path. Diameter: ")?;
    let diameter = positive(diameter.trim_end_matches("mm"))?;
    Some(tool(Scope::Following, diameter, Tip::Unknown, StatedUnit::Millimetre))
}

fn freecad_change(comment: &str) -> Option<Statement> {
    let number = not_negative(comment.strip_prefix("M6 T")?)?;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number in range")]
    let change = (number.fract() == 0.0 && number <= f64::from(u32::MAX)).then_some(number as u32)?;
    Some(Statement { change: Some(change), ..Statement::default() })
}

fn kiri_moto_tool(comment: &str) -> Option<Statement> {
    let mut fields = comment.split_whitespace();
    let number = fields.next()?.strip_prefix("tool#=")?.parse().ok()?;
    let diameter = positive(fields.next()?.strip_prefix("flute=")?)?;
    let unit = match fields.find_map(|field| field.strip_prefix("unit="))? {
        "metric" => StatedUnit::Millimetre,
        "imperial" => StatedUnit::Inch,
        _ => return None,
    };
    Some(tool(Scope::Number(number), diameter, Tip::Unknown, unit))
}

/// Parses the size of a pcb2gcode cutter, which is either for outlines or for isolation. Cutters for isolation are often pointed.
fn pcb2gcode_tool(comment: &str) -> Option<Statement> {
    let text = comment.strip_prefix("MSG, Change tool bit to ")?;
    let size = text.strip_prefix("cutter diameter ").or_else(|| text.strip_prefix("mill diameter "))?;
    let (diameter, unit) = size.split_at(size.find(|letter: char| letter.is_ascii_alphabetic())?);
    Some(tool(Scope::Following, positive(diameter)?, Tip::Unknown, unit_named(unit)?))
}

/// Parses a tool of CamBam, whose diameter is 0 if the user specified none.
fn cambam_tool(comment: &str) -> Option<Statement> {
    let (number, diameter) = comment.strip_prefix('T')?.split_once(" : ")?;
    let scope = Scope::Number(number.trim().parse().ok()?);
    Some(tool(scope, positive(diameter)?, Tip::Unknown, StatedUnit::OfProgram))
}

/// Returns the text after a key and its comma. The case of the key does not matter.
fn after_key<'c>(comment: &'c str, key: &str) -> Option<&'c str> {
    let (found, fields) = comment.split_once(',')?;
    found.trim().eq_ignore_ascii_case(key).then_some(fields)
}

fn numbers(fields: &str) -> Option<Vec<f64>> {
    fields.split(',').map(number).collect()
}

fn number(text: &str) -> Option<f64> {
    text.trim().parse::<f64>().ok().filter(|number| number.is_finite())
}

fn positive(text: &str) -> Option<f64> {
    number(text).filter(|number| *number > 0.0)
}

fn not_negative(text: &str) -> Option<f64> {
    number(text).filter(|number| *number >= 0.0)
}

fn unit_named(text: &str) -> Option<StatedUnit> {
    match text.trim() {
        "mm" => Some(StatedUnit::Millimetre),
        "in" | "inch" | "inches" => Some(StatedUnit::Inch),
        _ => None,
    }
}
