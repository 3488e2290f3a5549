//! The content of a setup sheet: checklist, facts and tables.

use super::data::{Sheet, SheetTool, distance_of_zero, distinct, localized_mm};
use super::flow::Block;
use super::{operations, shims};
use pathbuild_diagnostic::{Lang, with_decimal_separator};

use crate::scene::{BilingualText, MoveKind};
use crate::svg::canvas::mm;
use crate::svg::sheet::data::{feeds, rapid_heights, removed_box};

/// Returns the steps before running the program, in the order in which the operator carries them out.
pub(super) fn checklist(sheet: &Sheet, lang: Lang) -> Vec<Block> {
    let mut checks = vec![program(sheet, lang), material(sheet, lang)];
    checks.extend(shims::checks(sheet, lang));
    if let Some((deepest, _)) = sheet.cutting_box[2].filter(|(deepest, _)| *deepest < 0.0) {
        let depth = localized_mm(-deepest, lang);
        checks.push(lang.choose(
            format!("Sacrificial plate lies under it: it is cut {depth} mm deep"),
            format!("Opferplatte liegt darunter: sie wird {depth} mm tief angefräst"),
        ));
    }
    checks.push(clamped_text(sheet, lang));
    checks.extend(cutters(sheet, lang));
    if !sheet.starts_spindle {
        checks.push(lang.choose("Spindle is started by hand", "Spindel wird von Hand eingeschaltet").into());
    }
    checks.extend(zero(sheet, lang));
    if let Some(values) = &sheet.values {
        checks.push(lang.choose(
            format!(
                "Probing program has run, the heights are in {values}, pathbuild adjust has run without errors"
            ),
            format!(
                "Antastprogramm ist gelaufen, die Höhen stehen in {values}, pathbuild adjust lief ohne Fehler"
            ),
        ));
    }
    checks.push(
        lang.choose(
            "Air run is done, with Z0 set higher",
            "Probelauf in der Luft ist gemacht, mit höher gesetztem Z0",
        )
        .into(),
    );
    checks.extend(sheet.left_out.iter().map(|BilingualText { en, de }| {
        lang.choose(format!("{en}: that is intended"), format!("{de}: das ist so gewollt"))
    }));
    let heading = Block::Heading(lang.choose("Before the start", "Vor dem Start").into());
    std::iter::once(heading).chain(checks.into_iter().map(Block::Check)).collect()
}

fn program(sheet: &Sheet, lang: Lang) -> String {
    let (programs, hashes) = (sheet.programs.join(", "), &sheet.hashes);
    lang.choose(
        format!("Program {programs} is loaded; its first lines say {hashes}"),
        format!("Programm {programs} ist geladen; in seinen ersten Zeilen steht {hashes}"),
    )
}

fn material(sheet: &Sheet, lang: Lang) -> String {
    let thick = |material: Option<&str>| {
        let thickness = format_numbers(&shims::thicknesses(sheet, material));
        let thickness = with_decimal_separator(thickness?, lang);
        Some(lang.choose(format!("{thickness} mm thick"), format!("{thickness} mm dick")))
    };
    let materials = shims::materials(sheet);
    let sheets: Vec<Vec<String>> = match materials.as_slice() {
        [] | [_] => vec![materials.iter().map(ToString::to_string).chain(thick(None)).collect()],
        several => several
            .iter()
            .map(|material| std::iter::once((*material).to_owned()).chain(thick(Some(material))).collect())
            .collect(),
    };
    let sheets = sheets.iter().map(|facts| facts.join(", ")).filter(|facts| !facts.is_empty());
    let sheets = sheets.collect::<Vec<_>>().join("; ");
    let size = size(sheet, lang).map(|size| pieces(sheet, &size, lang));
    let facts =
        [sheets].into_iter().filter(|facts| !facts.is_empty()).chain(size).collect::<Vec<_>>().join(", ");
    lang.choose(format!("Material is ready: {facts}"), format!("Material liegt bereit: {facts}"))
}

/// Describes how much material is needed. Material at different heights, or of different names, is not one plate.
fn pieces(sheet: &Sheet, size: &str, lang: Lang) -> String {
    match shims::height_count(sheet) {
        0 | 1 if shims::materials(sheet).len() > 1 => lang.choose(
            format!("in separate pieces, which cover {size} together"),
            format!("in getrennten Stücken, die zusammen {size} bedecken"),
        ),
        0 | 1 => lang.choose(format!("at least {size}"), format!("mindestens {size}")),
        heights => lang.choose(
            format!("in separate pieces for {heights} heights, which cover {size} together"),
            format!("in getrennten Stücken für {heights} Höhen, die zusammen {size} bedecken"),
        ),
    }
}

fn clamped_text(sheet: &Sheet, lang: Lang) -> String {
    let clamps = sheet.scene.keep_outs.len();
    let highest = sheet.scene.keep_outs.iter().map(|clamp| clamp.height).reduce(f64::max);
    match highest {
        Some(highest) => lang.choose(
            format!("Clamps ({clamps}) stand as in the picture, none higher than Z {}", mm(highest)),
            format!("Spannpratzen ({clamps}) sitzen wie im Bild, keine höher als Z {}", mm(highest)),
        ),
        None => lang
            .choose(
                "Material is clamped; no clamp is in the way of a cut or a rapid move",
                "Material ist gespannt; keine Spannpratze steht einem Schnitt oder Eilgang im Weg",
            )
            .into(),
    }
}

fn cutters(sheet: &Sheet, lang: Lang) -> Vec<String> {
    let mut order = sheet.path_tools.clone();
    order.dedup();
    match (sheet.tools.as_slice(), order.as_slice()) {
        ([tool], _) => {
            let tool = tool_text(tool, lang).join(", ");
            vec![lang.choose(
                format!("Cutter is in and sharp: {tool}"),
                format!("Fräser sitzt und ist scharf: {tool}"),
            )]
        }
        (tools, [first, changes @ ..]) if sheet.has_manual_changes => {
            let first = tool_text(&tools[*first], lang).join(", ");
            let first = lang.choose(
                format!("First cutter is in and sharp: {first}"),
                format!("Der erste Fräser sitzt und ist scharf: {first}"),
            );
            vec![first, manual_changes(tools, changes, lang)]
        }
        (tools, _) => {
            let count = tools.len();
            vec![lang.choose(
                format!("Cutters ({count}) are in the places of the table, their lengths are set"),
                format!("Fräser ({count}) sitzen an den Plätzen der Tabelle, ihre Längen sind gesetzt"),
            )]
        }
    }
}

/// Describes the stops at which the operator changes the cutter.
fn manual_changes(tools: &[SheetTool], changes: &[usize], lang: Lang) -> String {
    const MAX_LISTED: usize = 12;
    let count = changes.len();
    let listed = changes
        .iter()
        .take(MAX_LISTED)
        .filter_map(|&index| tool_text(&tools[index], lang).into_iter().next());
    let more = (count > MAX_LISTED).then(|| "…".to_owned());
    let listed = listed.chain(more).collect::<Vec<_>>().join(", ");
    lang.choose(
        format!("Program stops for changes of the cutter by hand ({count}): {listed}; Z0 is set again after each"),
        format!("Das Programm hält für Werkzeugwechsel von Hand an ({count}): {listed}; nach jedem wird Z0 neu gesetzt"),
    )
}

/// Describes where to set the zero point.
fn zero(sheet: &Sheet, lang: Lang) -> Vec<String> {
    let mut checks = Vec::new();
    if let Some([low, _]) = removed_box(sheet) {
        let (across, up) = (distance_of_zero(low[0], true, lang), distance_of_zero(low[1], false, lang));
        let offset = if sheet.selects_g54 { " (G54)" } else { "" };
        checks.push(lang.choose(
            format!("X0 Y0 is set{offset}: {across} and {up} of the dashed rectangle"),
            format!("X0 Y0 ist gesetzt{offset}: {across} und {up} des gestrichelten Rechtecks"),
        ));
    }
    if let Some(tops) = shims::upper_faces(sheet) {
        let tops = format_numbers(&tops).unwrap_or_default();
        checks.push(lang.choose(
            format!("Z0 is set on the face under the shims; the material's upper face is at Z {tops}"),
            format!("Z0 ist auf der Fläche unter den Unterlagen gesetzt; die Oberseite des Materials ist bei Z {tops}"),
        ));
        return checks;
    }
    let top = thicknesses(sheet).unwrap_or_default();
    checks.push(lang.choose(
        format!("Z0 is set on the face that the material lies on; its upper face is at Z {top}"),
        format!(
            "Z0 ist auf der Fläche gesetzt, auf der das Material liegt; dessen Oberseite ist bei Z {top}"
        ),
    ));
    checks
}

/// Returns the facts that the operator should know while the program runs.
pub(super) fn facts(sheet: &Sheet, lang: Lang) -> Vec<Block> {
    let mut facts = Facts { lang, blocks: Vec::new() };
    facts.heading("Material", "Material");
    facts.fact("M", "M", materials(sheet));
    facts.fact("T", "T", thicknesses(sheet).map(|thickness| format!("{thickness} mm")));
    let is_one_piece = shims::height_count(sheet) <= 1 && shims::materials(sheet).len() <= 1;
    let [en, de] = if is_one_piece { ["at least", "mindestens"] } else { ["together", "zusammen"] };
    facts.fact(en, de, size(sheet, lang));
    if let [tool] = sheet.tools.as_slice() {
        facts.heading("Cutter", "Fräser");
        facts.fact("O", "O", Some(format!("Ø {} mm", localized_mm(tool.diameter, lang))));
        facts.fact("number T", "Nummer T", tool.number.map(|number| number.to_string()));
        facts.fact("name", "Name", tool.name.clone());
        facts.fact("spindle", "Spindel", spindle(tool, lang));
    }
    facts.heading("Feeds in mm/min", "Vorschübe in mm/min");
    let feeds = |kind| format_numbers(&feeds(sheet, kind));
    facts.fact("milling", "Fräsen", feeds(MoveKind::Mill));
    facts.fact("marking", "Markieren", feeds(MoveKind::Mark));
    facts.fact("plunging", "Eintauchen", feeds(MoveKind::Plunge));
    facts.fact("rapid", "Eilgang", sheet.rapid.map(mm));
    facts.heading("Toolpath of the cutter's tip", "Weg der Fräserspitze");
    for (axis, extent) in ["X", "Y", "Z"].into_iter().zip(sheet.cutting_box) {
        let range = |(low, high)| {
            lang.choose(format!("{} to {}", mm(low), mm(high)), format!("{} bis {}", mm(low), mm(high)))
        };
        facts.fact(axis, axis, extent.map(range));
    }
    facts.fact("deepest", "am tiefsten", sheet.cutting_box[2].map(|(low, _)| format!("Z {}", mm(low))));
    let rapids = rapid_heights(sheet);
    facts.fact("lowest rapid", "tiefster Eilgang", rapids.lowest().map(|z| format!("Z {}", mm(z))));
    let (inside, above) = rapids.across.split_at(rapids.inside);
    facts.fact("rapid across", "Eilgang quer", format_numbers(above).map(|heights| format!("Z {heights}")));
    facts.fact(
        "rapid across, inside milled areas",
        "Eilgang quer, im gefrästen Bereich",
        format_numbers(inside).map(|heights| format!("Z {heights}")),
    );
    facts.fact("rapid down to", "Eilgang hinab", rapids.down.map(|z| format!("Z {}", mm(z))));
    facts.fact("length", "Länge", Some(format!("{:.0} mm", sheet.length)));
    facts.fact("time", "Zeit", sheet.minutes.map(|minutes| format!("{minutes:.0} min")));
    facts.blocks
}

struct Facts {
    lang: Lang,
    blocks: Vec<Block>,
}

impl Facts {
    fn heading(&mut self, en: &str, de: &str) {
        self.blocks.push(Block::Heading(self.lang.choose(en, de).into()));
    }

    fn fact(&mut self, en: &str, de: &str, value: Option<String>) {
        let name = self.lang.choose(en, de).to_owned();
        self.blocks.extend(value.map(|value| Block::Fact(name, value)));
    }
}

/// Returns the tables of details, which follow the checklist and the facts.
pub(super) fn tables(sheet: &Sheet, lang: Lang) -> Vec<Block> {
    let mut blocks = Vec::new();
    let has_many_tools = sheet.tools.len() > 1;
    let mut table = |heading: &str, shares: &'static [f64], head: &[&str], rows: Vec<Vec<String>>| {
        if rows.is_empty() {
            return;
        }
        let head: Vec<String> = head.iter().map(|&text| text.to_owned()).collect();
        blocks.push(Block::Heading(heading.to_owned()));
        let continued = format!("{heading} ({})", lang.choose("continued", "Fortsetzung"));
        let row = |cells| Block::Row { cells, shares, head: head.clone(), continued: continued.clone() };
        blocks.extend(rows.into_iter().map(row));
    };
    table(
        lang.choose("Operations", "Arbeitsgänge"),
        if has_many_tools { &[0.14, 0.24, 0.38, 0.14, 0.1] } else { &[0.16, 0.26, 0.42, 0.16] },
        &[
            lang.choose("No.", "Nr."),
            lang.choose("path", "Pfad"),
            lang.choose("what", "was"),
            lang.choose("down to", "bis"),
            lang.choose("cutter", "Fräser"),
        ][..if has_many_tools { 5 } else { 4 }],
        operations::rows(sheet, lang),
    );
    table(
        lang.choose("Z-probes", "Z-Proben"),
        &[0.09, 0.37, 0.12, 0.12, 0.12, 0.18],
        &[
            "#",
            lang.choose("in the file of values", "in der Wertedatei"),
            "X",
            "Y",
            lang.choose("drawn Z", "Z gezeichnet"),
            lang.choose("measured", "gemessen"),
        ],
        probes(sheet),
    );
    table(
        lang.choose("Clamps", "Spannpratzen"),
        &[0.34, 0.24, 0.24, 0.18],
        &[lang.choose("layer", "Layer"), "X", "Y", lang.choose("up to Z", "bis Z")],
        clamps(sheet, lang),
    );
    if has_many_tools {
        table(
            lang.choose("Cutters", "Fräser"),
            &[0.06, 0.09, 0.15, 0.28, 0.24, 0.18],
            &[
                "T",
                "Ø mm",
                lang.choose("name", "Name"),
                lang.choose("cutting edges", "Schneiden"),
                lang.choose("spindle", "Spindel"),
                lang.choose("paths", "Pfade"),
            ],
            sheet.tools.iter().map(|tool| tool_row(tool, lang)).collect(),
        );
    }
    table(
        lang.choose("Embedded paths", "Eingebettete Pfade"),
        &[0.34, 0.14, 0.52],
        &["", lang.choose("times", "Anzahl"), lang.choose("drawing", "Zeichnung")],
        embedded_rows(sheet),
    );
    blocks
}

fn probes(sheet: &Sheet) -> Vec<Vec<String>> {
    let row = |probe: &super::SheetProbe| {
        vec![
            format!("#{}", probe.number),
            probe.name.clone(),
            mm(probe.at[0]),
            mm(probe.at[1]),
            mm(probe.height),
            // The operator writes the measured value here, first on paper and then in the file.
            "=".to_owned(),
        ]
    };
    sheet.probes.iter().map(row).collect()
}

fn clamps(sheet: &Sheet, lang: Lang) -> Vec<Vec<String>> {
    let to = lang.choose("to", "bis");
    let row = |clamp: &crate::scene::KeepOut| {
        let [low, high] = clamp.extent().unwrap_or_default();
        let range = |axis: usize| format!("{} {to} {}", mm(low[axis]), mm(high[axis]));
        vec![clamp.layer.clone(), range(0), range(1), mm(clamp.height)]
    };
    sheet.scene.keep_outs.iter().map(row).collect()
}

fn tool_row(tool: &SheetTool, lang: Lang) -> Vec<String> {
    vec![
        tool.number.map(|number| number.to_string()).unwrap_or_default(),
        mm(tool.diameter),
        tool.name.clone().unwrap_or_default(),
        edges(tool, lang).unwrap_or_default(),
        spindle(tool, lang).unwrap_or_default(),
        tool.paths.join(", "),
    ]
}

/// Returns a row for each embedded path, with its number of occurrences.
fn embedded_rows(sheet: &Sheet) -> Vec<Vec<String>> {
    let all = || sheet.scene.paths.iter().flat_map(|path| path.embedded.iter().skip(1));
    let each = distinct(all().map(|path| (&path.name, &path.file)));
    let row = |(name, file): (&String, &String)| {
        let times = all().filter(|path| (&path.name, &path.file) == (name, file)).count();
        let file = file.rsplit('/').next().unwrap_or_default();
        vec![name.clone(), times.to_string(), file.to_owned()]
    };
    each.into_iter().map(row).collect()
}

/// Describes a cutter in up to three texts: number, diameter and name; cutting edges; spindle speed and direction.
fn tool_text(tool: &SheetTool, lang: Lang) -> Vec<String> {
    let number = tool.number.map(|number| format!("T{number} "));
    let name = tool.name.as_ref().map(|name| format!(" ({name})"));
    let what = format!(
        "{}Ø {} mm{}",
        number.unwrap_or_default(),
        localized_mm(tool.diameter, lang),
        name.unwrap_or_default()
    );
    std::iter::once(what).chain(edges(tool, lang)).chain(spindle(tool, lang)).collect()
}

/// Describes the cutting edges of a cutter: corner radius, number and length.
fn edges(tool: &SheetTool, lang: Lang) -> Option<String> {
    let radius = Some(tool.corner_radius)
        .filter(|radius| *radius > 0.0)
        .map(|radius| format!("R {}", localized_mm(radius, lang)));
    let flutes =
        tool.flutes.map(|flutes| lang.choose(format!("{flutes} flutes"), format!("{flutes} Schneiden")));
    let length = tool.length.map(|length| {
        lang.choose(
            format!("cuts {} mm deep", mm(length)),
            format!("schneidet {} mm tief", localized_mm(length, lang)),
        )
    });
    let texts: Vec<String> = radius.into_iter().chain(flutes).chain(length).collect();
    (!texts.is_empty()).then(|| texts.join(", "))
}

fn spindle(tool: &SheetTool, lang: Lang) -> Option<String> {
    let speed =
        tool.speed.map(|speed| lang.choose(format!("{} rpm", mm(speed)), format!("{} 1/min", mm(speed))));
    let way = tool.clockwise.map(|clockwise| {
        if clockwise {
            lang.choose("clockwise", "im Uhrzeigersinn")
        } else {
            lang.choose("counterclockwise", "gegen den Uhrzeigersinn")
        }
    });
    let texts: Vec<String> = speed.into_iter().chain(way.map(str::to_owned)).collect();
    (!texts.is_empty()).then(|| texts.join(" "))
}

fn materials(sheet: &Sheet) -> Option<String> {
    let materials = shims::materials(sheet);
    (!materials.is_empty()).then(|| materials.join(" / "))
}

fn thicknesses(sheet: &Sheet) -> Option<String> {
    format_numbers(&shims::thicknesses(sheet, None))
}

/// Describes the size of the removed material in X and Y; `None` if nothing is removed.
fn size(sheet: &Sheet, lang: Lang) -> Option<String> {
    let [low, high] = removed_box(sheet)?;
    Some(format!("{} × {} mm", localized_mm(high[0] - low[0], lang), localized_mm(high[1] - low[1], lang)))
}

/// Formats a list of numbers. If there are many, only the first and the last are written.
fn format_numbers(numbers: &[f64]) -> Option<String> {
    match numbers {
        [] => None,
        [first, .., last] if numbers.len() > 4 => Some(format!("{} … {}", mm(*first), mm(*last))),
        numbers => Some(numbers.iter().copied().map(mm).collect::<Vec<_>>().join(" / ")),
    }
}
