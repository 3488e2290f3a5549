//! Determines the cutters of a program and the height of its material, from options, the drawing, the configuration, and the program itself. (book:
//! program/reading)

use pathbuild_diagnostic::messages::{gcode as say, posts};
use pathbuild_diagnostic::{Code, Diagnostic, Message, Severity, Text};
use pathbuild_gcode::dialect::Dialect;
use pathbuild_gcode::header::{CuttingTool, Header, StatedCutter};
use pathbuild_gcode::native::path_of_title;
use pathbuild_gcode::provenance::Provenance;
use pathbuild_gcode::verify::{BlindRapids, ByTool, Cutter, DepthRules, Stock, StockSpan};
use pathbuild_motion::Turning;

use super::against::ReferenceProgram;
use super::checks::{Assumption, MissingCheckReason, Outcome, RapidValues, ValueSource};
use super::{Verifier, VerifyOptions, is_converted_correction};
use crate::config::types::Tool;
use crate::program::Program;

/// The findings about rapid moves at heights that only the controller knows.
static RAPIDS_OF_WRONG_LENGTH: [&Message; 4] = [
    &say::RAPID_WITH_OLD_LENGTH,
    &say::RAPID_WITHOUT_LENGTH,
    &say::RAPID_BEFORE_LENGTH,
    &say::RAPID_WITH_OTHER_LENGTH,
];

/// All sources for the cutters of a program and for the height of its material.
pub(super) struct Sources<'s> {
    verifier: &'s Verifier<'s>,
    program: &'s Program,
    header: &'s Header,
    cutters: Option<Vec<(u32, Cutter)>>,
    stock: Option<Stock>,
}

/// The diameters of a cutting tool in mm, by source.
struct ToolDiameters {
    given: Option<f64>,
    drawn: Option<f64>,
    /// Widths of the cutter according to the configuration.
    table: Option<Cutter>,
    /// Whether the number in the program is that of the tool in the spindle. This does not hold for a native program, which always selects T1, so
    /// there the header takes precedence over the configuration.
    is_numbered: bool,
    header: Option<StatedCutter>,
}

impl ToolDiameters {
    fn origin(&self) -> Option<ValueSource> {
        let table = self.table.filter(|_| self.is_numbered);
        let table = table.map(|table| table.diameter);
        let known = [
            (self.given, ValueSource::Option),
            (self.drawn, ValueSource::Drawing),
            (table, ValueSource::Table),
        ];
        let first = known.into_iter().find_map(|(value, origin)| value.map(|_| origin));
        first.or(self.header.map(|_| ValueSource::Program))
    }

    /// Returns the widths according to the first known source of these: command line, drawing, configuration, header. If another one disagrees, the
    /// smaller diameter is used for removing material, and the larger one for collisions. Only the configuration and the header know the shape.
    fn cutter(&self) -> Option<Cutter> {
        let table = self.table.filter(|_| self.is_numbered);
        let known = [self.given, self.drawn, table.map(|table| table.diameter)];
        let Some(first) = known.into_iter().flatten().next() else {
            return self.header.map(|header| header.widths());
        };
        let is_same = |diameter: f64| differing_values(Some(first), Some(diameter)).is_none();
        let cutter = table.filter(|table| is_same(table.diameter)).unwrap_or(Cutter::flat(first));
        let header = self.header.filter(|header| !header.has_diameter(first)).map(|header| header.diameter);
        let others = known.into_iter().flatten().filter(|diameter| !is_same(*diameter)).chain(header);
        Some(others.fold(cutter, Cutter::combined_with_diameter))
    }
}

impl<'s> Sources<'s> {
    pub(super) fn new(verifier: &'s Verifier<'s>, program: &'s Program, header: &'s Header) -> Self {
        let mut sources = Self { verifier, program, header, cutters: None, stock: None };
        sources.cutters = sources.known_cutters();
        sources.stock = sources.known_stock();
        sources
    }

    /// Returns the material that the program cuts, if its cutters and surface are known.
    pub(super) fn stock(&self) -> Option<&Stock> {
        self.stock.as_ref()
    }

    /// Returns the cutters, each with the position in the order of execution from which it applies; `None` if the cutter of any cut is unknown, or if
    /// the program has no cuts and neither an option nor the drawing states a cutter.
    pub(super) fn cutters(&self) -> Option<&[(u32, Cutter)]> {
        self.cutters.as_deref()
    }

    /// Determines the material. Its surface is taken from the command line, else from the drawing if it has only one, else from the program itself.
    /// Without such a drawing, the higher surface is used where the command line and the program disagree.
    fn known_stock(&self) -> Option<Stock> {
        let stock = match (self.options().surface, self.drawn_surface()) {
            (Some(given), Some(_)) => self.uniform(given),
            (Some(given), None) => match self.stated_stock() {
                Some(stated) => Some(stated.raised_to(given)),
                None => self.uniform(given),
            },
            (None, Some(drawn)) => self.uniform(drawn),
            (None, None) => self.stated_stock(),
        };
        stock.map(|stock| self.with_configured_limits(stock).with_probes(self.header.is_probing))
    }

    /// Returns the material that the program states: up to the heights at which a native program's plunges begin to cut, else up to the surface in
    /// the header.
    fn stated_stock(&self) -> Option<Stock> {
        let cutters = self.cutters()?;
        let native = (self.program.dialect == Dialect::Native)
            .then(|| Stock::of_native_text(&self.program.at_nominal_heights(), cutters.first()?.1));
        native.flatten().or_else(|| self.uniform(self.header.surface?))
    }

    fn uniform(&self, surface: f64) -> Option<Stock> {
        let span = |(order, cutter): &(u32, Cutter)| StockSpan { order: *order, surface, cutter: *cutter };
        Some(Stock::of_pieces(self.cutters()?.iter().map(span).collect()))
    }

    /// Returns the source of the cutters. If the program has several tools, this is the least reliable of their sources.
    pub(super) fn cutter_origin(&self) -> Option<ValueSource> {
        let given = self
            .options()
            .cutter
            .map(|_| ValueSource::Option)
            .or(self.drawn_cutter().map(|_| ValueSource::Drawing));
        self.header.tools.iter().filter_map(|tool| self.diameters(tool).origin()).max().or(given)
    }

    /// Returns the source of the surface, and the surface's greatest height in mm.
    pub(super) fn surface(&self) -> Option<(ValueSource, f64)> {
        let highest = self.stock().and_then(Stock::highest);
        match (self.options().surface, self.drawn_surface()) {
            (Some(given), _) if highest.is_none_or(|highest| highest == given) => {
                Some((ValueSource::Option, given))
            }
            (None, Some(drawn)) => Some((ValueSource::Drawing, drawn)),
            (Some(_), _) | (None, None) => Some((ValueSource::Program, highest?)),
        }
    }

    /// Whether the surface is known and has the same height everywhere.
    pub(super) fn is_level(&self) -> bool {
        self.stock().is_some_and(Stock::is_level)
    }

    /// Whether only the program itself states the cutter or the surface.
    pub(super) fn is_known_only_from_program(&self) -> bool {
        let is_surface_known = self.options().surface.or(self.drawn_surface()).is_some();
        !is_surface_known || self.cutter_origin() == Some(ValueSource::Program)
    }

    /// Whether pathbuild interprets all words of the program that may move the tool.
    pub(super) fn are_moves_known(&self) -> bool {
        self.program.are_moves_known()
    }

    /// Returns PB777 if all cuts end above the surface that an option states: the program then cuts nothing, or its Z 0 is on the table. Returns
    /// nothing if the surface is compared with a drawing or contradicts the program, which is reported already.
    pub(super) fn cuts_above_surface_problem(&self, lowest_cut: Option<f64>) -> Option<Diagnostic> {
        let is_compared = self.verifier.against.is_some() || self.surface_disagreement().is_some();
        let given = self.options().surface.filter(|_| !is_compared)?;
        let lowest = lowest_cut.filter(|lowest| *lowest > given + TOLERANCE)?;
        Some(Diagnostic::new(&say::CUTS_ABOVE_SURFACE).with("found", lowest).with("given", given))
    }

    /// Returns the outcome of the check of rapid moves. `blind` counts the rapid moves that start at an unknown position, `found` are the findings of
    /// all rules.
    pub(super) fn rapids(
        &self,
        is_limit_reached: bool,
        blind: Option<BlindRapids>,
        lowest_cut: Option<f64>,
        found: &[Diagnostic],
    ) -> Outcome {
        if is_limit_reached {
            return Outcome::NotMade(MissingCheckReason::TooLarge);
        }
        let Some((cutter_origin, cutters)) = self.cutter_origin().zip(self.cutters()) else {
            return Outcome::NotMade(MissingCheckReason::NoCutter);
        };
        let Some((surface_origin, surface)) = self.surface() else {
            return Outcome::NotMade(match self.verifier.against {
                Some(_) => MissingCheckReason::SeveralSurfaces,
                None if is_converted_correction(self.program) => MissingCheckReason::MeasuredSurface,
                None => MissingCheckReason::NoSurface,
            });
        };
        if !self.are_moves_known() {
            return Outcome::NotMade(MissingCheckReason::NotFollowed);
        }
        if self.cuts_above_surface_problem(lowest_cut).is_some() {
            return Outcome::NotMade(MissingCheckReason::NoCutBelow);
        }
        if found
            .iter()
            .any(|problem| RAPIDS_OF_WRONG_LENGTH.iter().any(|message| message.key == problem.message.key))
        {
            return Outcome::NotMade(MissingCheckReason::WrongLength);
        }
        let cutters = match self.options().cutter.or(self.drawn_cutter()) {
            Some(given) => vec![given],
            None => cutters.iter().map(|(_, cutter)| cutter.diameter).collect(),
        };
        let values =
            RapidValues { cutters, cutter_origin, surface, is_level: self.is_level(), surface_origin };
        let has_machine_values =
            self.program.read.problems.iter().any(|problem| problem.code() == Code::MachineValue);
        match blind {
            Some(blind) => Outcome::Incomplete(values, blind),
            None if has_machine_values => Outcome::Assumed(values, Assumption::MachineValues),
            None if self.is_known_only_from_program() => Outcome::Assumed(values, Assumption::Stock),
            None => Outcome::Made(Some(values)),
        }
    }

    /// Reports rapid moves at cutting depth if the cutter is unknown, or if the surface is unknown or stated only by the comments of another CAM
    /// program. Lines with an error or with a finding of the same code are left out. A cutter that is not known may be as wide as
    /// [`MAX_ASSUMED_DIAMETER`].
    pub(super) fn doubtful_rapids(&self, rules: DepthRules, found: &[Diagnostic]) -> Vec<Diagnostic> {
        let is_surface_known = self.options().surface.is_some()
            || self.verifier.against.is_some()
            || self.program.dialect == Dialect::Native
            || self.header.is_of_pathbuild;
        if is_surface_known && self.cutters().is_some() {
            return Vec::new();
        }
        let widest = [(0, Cutter::flat(MAX_ASSUMED_DIAMETER))];
        let stock = Stock::with_unknown_surface(self.cutters().unwrap_or(&widest));
        let mut doubts =
            rules.finish(&self.program.at_nominal_heights(), &self.with_configured_limits(stock));
        let is_same_line = |error: &Diagnostic, doubt: &Diagnostic| error.place.line == doubt.place.line;
        doubts.retain(|doubt| match doubt.code() {
            Code::LimitReached => found.iter().all(|problem| problem.code() != Code::LimitReached),
            code => !found
                .iter()
                .any(|known| (known.is_error() || known.code() == code) && is_same_line(known, doubt)),
        });
        // This check only raises doubts, so a limit that stops it is not an error of the program.
        for doubt in &mut doubts {
            doubt.severity = Severity::Warning;
            if self.cutters().is_none() && doubt.code() == Code::RapidAtDepth {
                doubt.message = &say::RAPID_FAR_FROM_CUTS;
                doubt.arguments.push(("widest", MAX_ASSUMED_DIAMETER.into()));
            }
        }
        doubts
    }

    fn with_configured_limits(&self, stock: Stock) -> Stock {
        let limits = &self.verifier.settings.limits;
        stock.with_cells(limits.verify_cells.value).with_pieces(limits.verify_pieces.value)
    }

    fn known_cutters(&self) -> Option<Vec<(u32, Cutter)>> {
        let given = self.options().cutter.or(self.drawn_cutter());
        let native = self.native_entry().filter(|_| self.program.dialect == Dialect::Native);
        let widths = |tool: &CuttingTool| {
            let cutter = self.diameters(tool).cutter()?;
            // The header of a native program states no shape.
            let corner_radius = native.map_or(cutter.corner_radius, |tool| tool.cutter().corner_radius);
            Some((tool.order, Cutter { corner_radius, ..cutter }))
        };
        let mut cutters: Vec<(u32, Cutter)> = self.header.tools.iter().map(widths).collect::<Option<_>>()?;
        // The cutter from the command line or the drawing is in the spindle from the beginning.
        match (given, cutters.first_mut()) {
            (Some(given), None) => cutters.push((0, Cutter::flat(given))),
            (Some(_), Some((from, _))) => *from = 0,
            (None, _) => {}
        }
        (!cutters.is_empty()).then_some(cutters)
    }

    /// Reports contradictory values for cutter or surface in the header, the command line, the tool table and the drawing.
    pub(super) fn disagreements(&self) -> Vec<Diagnostic> {
        let mut found = Vec::new();
        let mut reported = Vec::new();
        for tool in &self.header.tools {
            let diameters = self.diameters(tool);
            let key = (tool.number, diameters.header.map(|header| header.diameter.to_bits()));
            if !reported.contains(&key) {
                reported.push(key);
                found.extend(disagreements_of(tool, &diameters));
            }
        }
        let compared = |message, place, values: Option<(f64, f64)>| {
            let problem = |(found, drawn)| {
                let problem = Diagnostic::new(message).with("place", place);
                problem.with("found", found).with("drawn", drawn)
            };
            values.map(problem)
        };
        found.extend(compared(
            &say::OTHER_CUTTER_DRAWN,
            &CUTTER,
            differing_values(self.options().cutter, self.drawn_cutter()),
        ));
        let surface = self.drawn_surface();
        found.extend(compared(
            &say::OTHER_SURFACE_DRAWN,
            &HEADER,
            differing_values(self.header.surface, surface),
        ));
        found.extend(compared(
            &say::OTHER_SURFACE_DRAWN,
            &SURFACE,
            differing_values(self.options().surface, surface),
        ));
        found.extend(self.surface_disagreement());
        found
    }

    /// Compares the surface of the command line with the highest surface that the program states, unless there is a drawing.
    fn surface_disagreement(&self) -> Option<Diagnostic> {
        let given = self.options().surface.filter(|_| self.verifier.against.is_none());
        let stated = self.header.surface.or_else(|| self.stated_stock()?.highest());
        let (given, stated) = differing_values(given, stated)?;
        let is_in_header = self.header.surface.is_some();
        let message = if is_in_header { &say::OTHER_SURFACE_GIVEN } else { &say::PLUNGES_ABOVE_SURFACE };
        Some(Diagnostic::new(message).with("found", stated).with("given", given))
    }

    /// Warns about tools that are not in the table, unless it is empty.
    pub(super) fn unknown_tool_warnings(&self) -> Vec<Diagnostic> {
        let table_numbers: Vec<u32> =
            self.verifier.table.entries.iter().filter_map(|entry| entry.index).collect();
        let mut unknown: Vec<(u32, u32)> = Vec::new();
        for (line, number) in &self.header.changes {
            let is_new = unknown.iter().all(|(_, met)| met != number);
            if is_new && !table_numbers.is_empty() && !table_numbers.contains(number) && self.is_numbered() {
                unknown.push((*line, *number));
            }
        }
        let warning = |(line, number)| {
            Diagnostic::new(&posts::TOOL_NOT_IN_TABLE).with("index", u64::from(number)).at_line(line, None)
        };
        unknown.into_iter().map(warning).collect()
    }

    fn entry(&self, tool: &CuttingTool) -> Option<&'s Tool> {
        let number = tool.number?;
        let entry = self.verifier.table.entries.iter().position(|entry| entry.index == Some(number))?;
        self.tools().get(entry)
    }

    /// Returns the configured tool for the path and the cutter O that the header of a native program names.
    fn native_entry(&self) -> Option<&'s Tool> {
        let (provenance, title) = Provenance::of_head(&self.program.text)?;
        let entry = self.verifier.table.position(path_of_title(&title)?, provenance.cutter?)?;
        self.tools().get(entry)
    }

    /// Returns the configured tools that cut. Empty for XpertMILL, whose layers are not tools.
    pub(super) fn cutting_tools(&self) -> ByTool<Option<&'s Tool>> {
        if self.program.dialect == Dialect::Xpertmill {
            return Vec::new();
        }
        let native = self.native_entry();
        let entry =
            |tool: &CuttingTool| (tool.order, if self.is_numbered() { self.entry(tool) } else { native });
        self.header.tools.iter().map(entry).collect()
    }

    /// Returns the directions of rotation of the tools. Where the tool is not known, as in programs without T, this is the direction that all
    /// configured tools have in common.
    pub(super) fn directions(&self) -> ByTool<Option<Turning>> {
        let all: Vec<Option<Turning>> = self.tools().iter().map(Tool::turning).collect();
        let common =
            all.first().copied().flatten().filter(|first| all.iter().all(|turning| *turning == Some(*first)));
        let direction = |tool: &CuttingTool| {
            let entry = self.entry(tool).filter(|_| self.is_numbered());
            (tool.order, entry.map_or(common, Tool::turning))
        };
        self.header.tools.iter().map(direction).collect()
    }

    /// Whether T is the number of a tool: XpertMILL's layers are not tools, and native programs always contain T1.
    fn is_numbered(&self) -> bool {
        !matches!(self.program.dialect, Dialect::Xpertmill | Dialect::Native)
    }

    fn tools(&self) -> &'s [Tool] {
        &self.verifier.settings.tables.tools.value
    }

    fn options(&self) -> &'s VerifyOptions {
        &self.verifier.options
    }

    fn drawn_cutter(&self) -> Option<f64> {
        self.verifier.against.as_ref().and_then(ReferenceProgram::cutter)
    }

    fn drawn_surface(&self) -> Option<f64> {
        self.verifier.against.as_ref().and_then(ReferenceProgram::surface)
    }

    fn diameters(&self, tool: &CuttingTool) -> ToolDiameters {
        let entry = self.entry(tool);
        let (given, drawn, header) = (self.options().cutter, self.drawn_cutter(), tool.cutter);
        // XpertMILL's layers are not tools, but may be numbered like them.
        let is_only_source = given.or(drawn).is_none() && header.is_none();
        let may_be_tool = |_: &f64| self.program.dialect != Dialect::Xpertmill || is_only_source;
        let table = entry.map(Tool::cutter).filter(|cutter| may_be_tool(&cutter.diameter));
        ToolDiameters { given, drawn, table, header, is_numbered: self.program.dialect != Dialect::Native }
    }
}

fn disagreements_of(tool: &CuttingTool, diameters: &ToolDiameters) -> Vec<Diagnostic> {
    let ToolDiameters { given, drawn, header, is_numbered, .. } = *diameters;
    let table = diameters.table.map(|table| table.diameter);
    let other_than_header = |value: Option<f64>| {
        let header = header.filter(|header| value.is_some_and(|value| !header.has_diameter(value)))?;
        Some((header.diameter, value?))
    };
    let index = u64::from(tool.number.unwrap_or_default());
    let given_other = |place, (found, given)| {
        let problem = Diagnostic::new(&say::OTHER_CUTTER_GIVEN).with("place", place);
        problem.with("found", found).with("given", given)
    };
    let mut found = Vec::new();
    found.extend(other_than_header(given).map(|values| given_other(&HEADER, values)));
    found.extend(
        differing_values(table.filter(|_| is_numbered), given).map(|values| given_other(&TABLE, values)),
    );
    // This is an error, because the operator reads the header and inserts the tool that it names.
    found.extend(other_than_header(drawn).map(|(header, drawn)| {
        let problem = Diagnostic::new(&say::OTHER_CUTTER_DRAWN).with("place", &HEADER);
        let problem = problem.with("found", header).with("drawn", drawn);
        problem.as_error()
    }));
    found.extend(other_than_header(table).map(|(header, table)| {
        let problem = Diagnostic::new(&say::OTHER_CUTTER_IN_TABLE).with("index", index);
        problem.with("header", header).with("table", table).at_line(tool.line, None)
    }));
    found
}

/// Returns both values if they differ by more than the tolerance.
fn differing_values(one: Option<f64>, other: Option<f64>) -> Option<(f64, f64)> {
    one.zip(other).filter(|(one, other)| (one - other).abs() > TOLERANCE)
}

/// Tolerance in mm within which diameters and heights are equal.
const TOLERANCE: f64 = 1e-6;

/// Diameter in mm of the widest cutter that is assumed if none is known. A wider one may have cleared everything between two cuts.
const MAX_ASSUMED_DIAMETER: f64 = 50.0;

static HEADER: Text = Text { en: "the header", de: "der Kopf" };
static TABLE: Text = Text { en: "`[tool]`", de: "`[tool]`" };
static CUTTER: Text = Text { en: "--cutter", de: "--cutter" };
static SURFACE: Text = Text { en: "--surface", de: "--surface" };
