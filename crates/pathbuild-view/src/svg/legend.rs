//! The legend below the drawing: title, kinds of lines, depth scale and findings.

use super::canvas::{
    Anchor, BAR_COLOUR, Canvas, Depths, ERROR_COLOUR, INK_COLOUR, PROBE_COLOUR, TEXT_COLOUR, WARNING_COLOUR,
    color, mm, svg_number, wrap_text,
};
use super::frame::{Frame, LINE_HEIGHT, VisibleParts};
use super::stock::MilledStock;
use super::symbols::SWEEP_COLOUR;
use crate::scene::{BilingualText, Finding, MoveKind, Point, Scene};

/// Left edge of the legend in px.
const LEFT: f64 = 40.0;

/// Letter size and width of the lines of findings, in px.
const LETTER_SIZE: f64 = 11.0;
const FINDINGS_WIDTH: f64 = Frame::WIDTH - 80.0;

/// Maximum number of lines of findings. Each line adds to the height of a picture, and thereby to its size in memory.
const MAX_LINES: usize = 40;

const DEPTH_STEPS: u32 = 24;

pub(super) struct Legend<'a> {
    scene: &'a Scene,
    depths: &'a Depths,
    shown: VisibleParts,
    scale: f64,
    top: f64,
    findings: Vec<(Option<&'a Finding>, String)>,
    /// Number of findings that the legend lists.
    pub(super) listed: usize,
    /// The stock, if the picture shows it instead of the moves.
    stock: Option<&'a MilledStock<'a>>,
    /// Height in px of the lines that the colours of the stock need in addition to their first one.
    overhang: f64,
}

impl<'a> Legend<'a> {
    /// Lays out the legend of a scene, or of its stock.
    pub(super) fn new(
        scene: &'a Scene,
        stock: Option<&'a MilledStock<'a>>,
        frame: &Frame,
        depths: &'a Depths,
        shown: VisibleParts,
    ) -> Self {
        let (findings, listed) = first_findings(scene, shown);
        let overhang = stock.map_or(0.0, |stock| stock.legend_overhang(shown, [LEFT, 0.0], Frame::WIDTH));
        Self {
            scene,
            depths,
            shown,
            scale: frame.scale(),
            top: frame.bottom(),
            findings,
            listed,
            stock,
            overhang,
        }
    }

    /// Returns the lower edge of the page in px.
    pub(super) fn bottom(&self) -> f64 {
        self.top + self.overhang + 5.0 * LINE_HEIGHT + self.findings.len() as f64 * LINE_HEIGHT
    }

    /// Draws the legend. `hidden` are the numbers of the cutting order for which the picture has no room.
    pub(super) fn draw(&self, canvas: &mut Canvas, hidden: &[u32]) {
        canvas.open(&format!("id=\"legend\" fill=\"{INK_COLOUR}\""));
        let line = |number: f64| [LEFT, self.top + number * LINE_HEIGHT];
        canvas.text(line(1.0), 14.0, Anchor::Start, "font-weight=\"bold\"", &self.scene.title);
        canvas.text(line(2.0), 10.5, Anchor::Start, &format!("fill=\"{TEXT_COLOUR}\""), &self.facts());
        if self.stock.is_none() {
            draw_line_kinds(canvas, self.scene, self.shown, line(3.0), Frame::WIDTH);
        }
        self.draw_scale_bar(canvas, self.top + 3.0 * LINE_HEIGHT);
        if let Some(stock) = self.stock {
            stock.draw_legend(canvas, self.shown, line(4.0), Frame::WIDTH);
        } else {
            let [left, y] = line(4.0);
            draw_depths(canvas, self.depths, [left, y]);
            let left = left + DEPTHS_WIDTH;
            draw_hidden_numbers(canvas, hidden, self.shown, [left, y], Frame::WIDTH - left);
        }
        for (row, (finding, line)) in self.findings.iter().enumerate() {
            let y = self.top + self.overhang + (5.0 + row as f64) * LINE_HEIGHT;
            let style = match finding {
                Some(finding) => {
                    let color = if finding.is_error { ERROR_COLOUR } else { WARNING_COLOUR };
                    format!("fill=\"{color}\" font-weight=\"bold\"")
                }
                None => String::new(),
            };
            canvas.text([LEFT, y], LETTER_SIZE, Anchor::Start, &style, line);
        }
        canvas.close();
    }

    /// Returns cutter, material and lengths of the path; empty unless the scene has exactly one path.
    fn facts(&self) -> String {
        let [path] = self.scene.paths.as_slice() else { return String::new() };
        let mut facts = Vec::new();
        if path.file != self.scene.title {
            facts.push(path.file.clone());
        }
        if let Some(tool) = path.tool {
            facts.push(format!("O {}", mm(tool)));
        }
        if let Some(thickness) = path.thickness {
            facts.push(format!("T {}", mm(thickness)));
        }
        if let Some(material) = &path.material {
            facts.push(format!("M {material}"));
        }
        if let Some(totals) = path.totals.filter(|_| !path.moves.is_empty()) {
            let length = |value: f64| format!("{value:.0} mm");
            facts.push(format!("{} {}", self.shown.choose("milling", "Fräsen"), length(totals.milling)));
            facts.push(format!(
                "{} {}",
                self.shown.choose("plunging", "Eintauchen"),
                length(totals.drilling)
            ));
            facts.push(format!("{} {}", self.shown.choose("rapid", "Eilgang"), length(totals.sweeps)));
            facts.extend(totals.minutes.map(|minutes| format!("{minutes:.0} min")));
        }
        facts.join(" · ")
    }

    /// Draws a scale bar of a round length, such as 10 or 20 mm.
    fn draw_scale_bar(&self, canvas: &mut Canvas, y: f64) {
        let steps = [
            0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 10_000.0, 100_000.0,
        ];
        let Some(length) = steps.into_iter().rev().find(|length| length * self.scale <= 200.0) else {
            return;
        };
        let (left, right) = (1100.0 - length * self.scale, 1100.0);
        canvas.path(
            &format!(
                "M{l} {t}V{b}H{r}V{t}",
                l = svg_number(left),
                r = svg_number(right),
                t = svg_number(y - 9.0),
                b = svg_number(y - 4.0)
            ),
            &format!("fill=\"none\" stroke=\"{INK_COLOUR}\""),
        );
        canvas.text([right + 6.0, y], 10.5, Anchor::Start, "", &format!("{} mm", mm(length)));
    }
}

/// Width in px of the depth scale with its labels.
const DEPTHS_WIDTH: f64 = 380.0;

/// Lists the numbers of the cutting order for which the picture has no room, if there are any.
pub(super) fn draw_hidden_numbers(
    canvas: &mut Canvas,
    numbers: &[u32],
    shown: VisibleParts,
    at: Point,
    width: f64,
) {
    if numbers.is_empty() {
        return;
    }
    let text = format!("{}: {}", shown.choose("no room for", "kein Platz für"), ranges(numbers));
    let mut lines = wrap_text(&text, width - 20.0, 10.5).into_iter();
    let first = lines.next().unwrap_or_default();
    let more = if lines.next().is_some() { " …" } else { "" };
    canvas.text(at, 10.5, Anchor::Start, &format!("fill=\"{TEXT_COLOUR}\""), &format!("{first}{more}"));
}

/// Formats ascending numbers, with a dash for three or more consecutive ones: `3, 7–9`.
pub(super) fn ranges(numbers: &[u32]) -> String {
    let runs = numbers.chunk_by(|one, next| one + 1 == *next);
    let run = |run: &[u32]| match run {
        [first, _, .., last] => format!("{first}–{last}"),
        run => run.iter().map(ToString::to_string).collect::<Vec<_>>().join(", "),
    };
    runs.map(run).collect::<Vec<_>>().join(", ")
}

/// Draws the kinds of lines that occur in the picture, from `left` to `right` and continuing on further lines. Returns the y coordinate of the last
/// line in px.
pub(super) fn draw_line_kinds(
    canvas: &mut Canvas,
    scene: &Scene,
    shown: VisibleParts,
    [left, mut y]: Point,
    right: f64,
) -> f64 {
    let moves = || scene.paths.iter().flat_map(|path| &path.moves);
    let has = |kind| moves().any(|movement| movement.kind == kind);
    let cut = color(0.6);
    let all = [
        (
            has(MoveKind::Mill),
            shown.choose("milling", "Fräsen"),
            format!("stroke=\"{cut}\" stroke-width=\"2\""),
        ),
        (
            has(MoveKind::Mark),
            shown.choose("marking", "Markieren"),
            format!("stroke=\"{cut}\" stroke-width=\"2\" stroke-dasharray=\"2 3\""),
        ),
        (
            has(MoveKind::Sweep) && shown.rapids,
            shown.choose("rapid", "Eilgang"),
            format!("stroke=\"{SWEEP_COLOUR}\" stroke-dasharray=\"6 4\""),
        ),
        (
            scene.paths.iter().any(|path| !path.bars.is_empty()),
            shown.choose("support bar", "Stützsteg"),
            format!("stroke=\"{BAR_COLOUR}\" stroke-width=\"4\""),
        ),
        (
            scene.paths.iter().any(|path| !path.probes.is_empty()),
            shown.choose("Z-probe", "Z-Probe"),
            format!("stroke=\"{PROBE_COLOUR}\" stroke-width=\"2\""),
        ),
        (
            !scene.keep_outs.is_empty(),
            shown.choose("clamp", "Spannmittel"),
            format!("stroke=\"{ERROR_COLOUR}\" stroke-dasharray=\"8 2 2 2\""),
        ),
    ];
    let mut x = left;
    for (_, name, style) in all.into_iter().filter(|(is_there, ..)| *is_there) {
        let width = 56.0 + 7.0 * name.chars().count() as f64;
        if x + width > right {
            (x, y) = (left, y + LINE_HEIGHT);
        }
        canvas.line([x, y - 4.0], [x + 28.0, y - 4.0], &style);
        canvas.text([x + 34.0, y], 10.5, Anchor::Start, "", name);
        x += width;
    }
    y
}

/// Draws the colours of depths with the depths that they stand for.
pub(super) fn draw_depths(canvas: &mut Canvas, depths: &Depths, [left, y]: Point) {
    let Some((high, low)) = depths.range else { return };
    let label = |z: f64| format!("Z {}", mm(z));
    if high <= low {
        canvas.circle([left + 10.0, y - 4.0], 6.0, &format!("fill=\"{}\"", depths.color(Some(low))));
        return canvas.text([left + 22.0, y], 10.5, Anchor::Start, "", &label(low));
    }
    let high_label = label(high);
    canvas.text([left, y], 10.5, Anchor::Start, "", &high_label);
    let mut x = left + 8.0 + 7.0 * high_label.chars().count() as f64;
    for step in 0..DEPTH_STEPS {
        let color = color(f64::from(step) / f64::from(DEPTH_STEPS - 1));
        canvas.rect([x, y - 9.0], [8.5, 10.0], &format!("fill=\"{color}\""));
        x += 8.0;
    }
    canvas.text([x + 8.0, y], 10.5, Anchor::Start, "", &label(low));
}

/// Returns the lines of the findings that fit in the legend, and the number of these findings.
fn first_findings(scene: &Scene, shown: VisibleParts) -> (Vec<(Option<&Finding>, String)>, usize) {
    let (mut all, findings) = (Vec::new(), &scene.findings);
    for (number, finding) in findings.iter().enumerate() {
        let next = lines(finding, scene.program.is_some(), shown);
        if number > 0 && all.len() + next.len() > MAX_LINES {
            let more = shown.choose(
                "further findings, circled without a number: `pathbuild check` lists them",
                "weitere Befunde, ohne Nummer eingekreist: `pathbuild check` zeigt sie",
            );
            all.push((None, format!("… {} {more}", findings.len() - number)));
            return (all, number);
        }
        all.extend(next);
    }
    (all, findings.len())
}

/// Returns the lines of a finding, with its line in a program. Only the first line refers to the finding: it is drawn bold and in the finding's colour.
fn lines<'a>(
    finding: &'a Finding,
    is_of_program: bool,
    shown: VisibleParts,
) -> Vec<(Option<&'a Finding>, String)> {
    let pick = |text: &'a BilingualText| shown.lang.choose(text.en.as_str(), text.de.as_str());
    let mut lines = Vec::new();
    let line = finding.line.filter(|_| is_of_program);
    let place = line.map(|line| format!("{} {line} · ", shown.choose("line", "Zeile"))).unwrap_or_default();
    let first = format!("{} · {place}{}: {}", finding.number, finding.code, pick(&finding.message));
    for (row, line) in wrap_text(&first, FINDINGS_WIDTH, LETTER_SIZE).into_iter().enumerate() {
        lines.push(((row == 0).then_some(finding), line));
    }
    let help = pick(&finding.help);
    if !help.is_empty() {
        lines.extend(
            wrap_text(help, FINDINGS_WIDTH, LETTER_SIZE)
                .into_iter()
                .map(|line| (None, format!("    {line}"))),
        );
    }
    lines
}
