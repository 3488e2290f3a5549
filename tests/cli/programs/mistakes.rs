//! Puts mistakes into programs automatically, and tests which ones `verify` finds.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::fs;

use insta::assert_snapshot;
use pathbuild_gcode::interpret::{Options, guess, interpret_each};
use pathbuild_motion::{Action, Axes, Move, MoveShape, Pace};
use regex::Regex;

use super::{Known, PROGRAMS, counts};
use crate::book::kept;
use crate::support::{Place, project};

/// A program: its lines, and its moves, each with the index of its line.
pub(super) struct Program {
    lines: Vec<String>,
    moves: Vec<(usize, Move)>,
    /// The index of the first line of each tool change.
    changes: Vec<usize>,
    surface: f64,
}

/// New texts of lines, by index; `None` removes the line.
pub(super) type Changes = Vec<(usize, Option<String>)>;

/// The name of a mistake in English and German, and a function that puts it into a program; the function returns `None` if the program has no
/// suitable line.
pub(super) type Mistake = ([&'static str; 2], fn(&Program) -> Option<Changes>);

pub(super) const MISTAKES: &[Mistake] = &[
    (["rapid move through stock", "Eilgang durch Material"], |program| {
        Some(program.as_rapid(program.lateral().next()?))
    }),
    (["rapid plunge", "Eintauchen im Eilgang"], |program| Some(program.as_rapid(program.plunges().next()?))),
    (["plunge at cutting feed", "Eintauchen mit Fräsvorschub"], plunge_at_cutting_feed),
    (["missing retract", "Rückzug fehlt"], missing_retract),
    (["no retract before tool change", "kein Rückzug vor dem Werkzeugwechsel"], |program| {
        program.without_lifts_before(*program.changes.get(1)?)
    }),
    (["no retract at the end", "kein Rückzug am Ende"], |program| {
        program.without_lifts_before(program.lines.len())
    }),
    (["another tool number", "andere Werkzeugnummer"], another_tool),
    (["missing tool change", "Werkzeugwechsel fehlt"], missing_tool_change),
    (["G20 for G21, or the reverse", "G20 statt G21 oder umgekehrt"], wrong_unit),
    (["G91 for G90", "G91 statt G90"], |program| program.replaced(r"G90([^.\d]|$)", "G91$1", 1)),
    (["spindle not started", "Spindel nicht eingeschaltet"], |program| {
        program.replaced(r"M0?3([^\d]|$)", "$1", 1)
    }),
    (["no spindle speed", "keine Drehzahl"], |program| program.replaced(r"S\s*[\d.]+", "", usize::MAX)),
    (["spindle speed ten times as high", "zehnfache Drehzahl"], |program| {
        program.scaled('S', 10.0, program.lateral().next()?)
    }),
    (["no feed at all", "kein Vorschub"], |program| program.replaced(r"F[\d.]+", "", usize::MAX)),
    (["cutting feed ten times as high", "zehnfacher Fräsvorschub"], |program| {
        program.scaled('F', 10.0, program.lateral().next()?)
    }),
    (["coordinate outside of the travel", "Koordinate außerhalb der Verfahrwege"], |program| {
        program.in_plane(|value| Some(format!("{}", number(value) + 900.0)))
    }),
    (["lost decimal point in X or Y", "verlorener Dezimalpunkt in X oder Y"], |program| {
        program.in_plane(without_point)
    }),
    (["lost decimal point in Z", "verlorener Dezimalpunkt in Z"], |program| {
        program.in_axis('Z', without_point)
    }),
    (["lost minus sign in X or Y", "verlorenes Minus in X oder Y"], |program| {
        program.in_plane(without_minus)
    }),
    (["lost minus sign in Z", "verlorenes Minus in Z"], |program| program.in_axis('Z', without_minus)),
    (["arc centre on the other side", "Bogenmittelpunkt auf der anderen Seite"], wrong_centre),
    (["arc in the other direction", "Bogen in der anderen Richtung"], wrong_direction),
    (["wrong plane", "falsche Ebene"], |program| program.with_arcs()?.replaced(r"G17([^.\d]|$)", "G18$1", 1)),
    (["M4 for M3", "M4 statt M3"], |program| program.replaced(r"M0?3([^\d]|$)", "M4$1", 1)),
    (["spindle stopped while cutting", "Spindel während des Fräsens gestoppt"], |program| {
        Some(program.with_line_before(program.lateral().nth(1)?, "M5"))
    }),
    (["no retract at the start", "kein Rückzug am Anfang"], no_first_lift),
    (["first move sideways and up", "erste Bewegung schräg nach oben"], first_move_aslant),
    (["retract too low", "Rückzug zu niedrig"], |program| {
        let (line, _) = program.lift_before_rapid()?;
        let height = if program.is_in_inches() { "-0.01" } else { "-0.25" };
        let height = (program.surface + number(height)).to_string();
        Some(vec![(line, Some(with_value(&program.lines[line], 'Z', |_| Some(height.clone()))?))])
    }),
    (["retract above the travel", "Rückzug über den Verfahrweg hinaus"], |program| {
        let (line, _) = program.lift_before_rapid()?;
        Some(vec![(
            line,
            Some(with_value(&program.lines[line], 'Z', |z| Some((number(z) + 100.0).to_string()))?),
        )])
    }),
    (["Z ten times as deep", "zehnfache Tiefe"], |program| {
        program.in_axis('Z', |z| (number(z) < -0.05).then(|| (number(z) * 10.0).to_string()))
    }),
    (["cut off halfway", "in der Mitte abgeschnitten"], |program| {
        let laterals: Vec<usize> = program.lateral().collect();
        let last = *laterals.get(laterals.len() / 2)?;
        Some((last + 1..program.lines.len()).map(|line| (line, None)).collect())
    }),
    (["end of program in the middle", "Programmende in der Mitte"], |program| {
        Some(program.with_line_before(program.lateral().nth(1)?, "M30"))
    }),
    (["G0 beside G1", "G0 neben G1"], |program| {
        let line = program
            .lateral()
            .find(|line| pattern(r"G0?1([^.\d]|$)").is_match(code(&program.lines[*line])))?;
        Some(vec![(line, Some(with_word(&program.lines[line], "G0")))])
    }),
    (["lost G1 after a rapid move", "verlorenes G1 nach einem Eilgang"], lost_feed_word),
    (["letter O for 0", "Buchstabe O statt 0"], |program| {
        program.in_plane(|value| value.contains('0').then(|| value.replacen('0', "O", 1)))
    }),
    (["decimal comma", "Dezimalkomma"], |program| {
        program.in_plane(|value| value.contains('.').then(|| value.replace('.', ",")))
    }),
    (["arc without centre", "Bogen ohne Mittelpunkt"], |program| {
        let line = program.arcs().next()?;
        let text =
            pattern(r"[IJKR]\s*(\[[^\]]*\]|[-+]?[\d.]+)").replace_all(&program.lines[line], "").into_owned();
        Some(vec![(line, Some(text))])
    }),
    (["another coordinate system", "anderes Koordinatensystem"], |program| {
        program.replaced(r"G54([^.\d]|$)", "G55$1", 1)
    }),
    (["length of another tool", "Länge eines anderen Werkzeugs"], |program| {
        program.replaced(r"H\s*\d+", "H9", 1)
    }),
    (["tool length cancelled", "Werkzeuglänge aufgehoben"], |program| {
        program.replaced(r"G43([^.\d]|$)", "G43$1", 1)?;
        Some(program.with_line_before(program.lateral().nth(1)?, "G49"))
    }),
];

fn number(text: &str) -> f64 {
    text.parse().unwrap()
}

fn without_point(value: &str) -> Option<String> {
    let significant = value.trim_end_matches('0');
    let has_fraction = significant.contains('.') && !significant.ends_with('.') && number(value).abs() >= 0.5;
    has_fraction.then(|| significant.replace('.', ""))
}

fn without_minus(value: &str) -> Option<String> {
    (number(value) < -0.02).then(|| value.replace('-', ""))
}

fn pattern(pattern: &str) -> Regex {
    Regex::new(&format!("(?i){pattern}")).unwrap()
}

/// Returns the part of a line before any comment.
fn code(line: &str) -> &str {
    &line[..line.find(['(', ';']).unwrap_or(line.len())]
}

/// Returns a line with another value for a letter, if it has a plain number there and `change` accepts it.
fn with_value(line: &str, letter: char, change: impl Fn(&str) -> Option<String>) -> Option<String> {
    let found = pattern(&format!(r"{letter}\s*([-+]?[\d.]+)")).captures(code(line))?.get(1)?;
    Some(format!("{}{}{}", &line[..found.start()], change(found.as_str())?, &line[found.end()..]))
}

fn has_motion(line: &str) -> bool {
    pattern(r"G(0?[0-3]|8[1-9]|80)([^\d.]|$)").is_match(code(line))
}

/// Inserts a word after the block number of a line.
fn with_word(line: &str, word: &str) -> String {
    pattern(r"^(\s*N\d+)?\s*").replace(line, format!("${{1}} {word} ")).trim_start().to_owned()
}

impl Program {
    pub(super) fn new(known: &Known) -> Self {
        let text = known.text();
        let (mut moves, mut changes) = (Vec::new(), Vec::new());
        interpret_each(text.as_bytes(), guess(text.as_bytes()).dialect, &Options::default(), &mut |step| {
            let line = step.line as usize - 1;
            match &step.action {
                Action::Move(movement) => moves.push((line, *movement)),
                Action::ChangeTool(_) => changes.push(line),
                Action::Comment(comment) if comment.trim().starts_with("M6 T") => changes.push(line),
                _ => {}
            }
        });
        Self { lines: text.lines().map(String::from).collect(), moves, changes, surface: known.surface }
    }

    pub(super) fn text(&self, changes: Changes) -> String {
        let mut lines: Vec<Option<String>> = self.lines.iter().cloned().map(Some).collect();
        for (index, line) in changes {
            lines[index] = line;
        }
        lines.into_iter().flatten().fold(String::new(), |text, line| text + &line + "\n")
    }

    /// Returns the lines of straight level cuts below the surface that are longer than 2 mm.
    fn lateral(&self) -> impl Iterator<Item = usize> + '_ {
        self.feed_lines(|movement| {
            let length = movement.length();
            movement.from.z() == movement.to.z() && length > 2.0
        })
    }

    /// Returns the lines of plunges that go deeper than all earlier cuts, so that there is material below.
    fn plunges(&self) -> impl Iterator<Item = usize> + '_ {
        let mut deepest = self.surface - 0.02;
        let moves = self.moves.iter().filter(|(_, movement)| matches!(movement.pace, Pace::Feed(_)));
        moves.filter_map(move |(line, movement)| {
            let is_deeper = movement.to.z() < deepest;
            deepest = deepest.min(movement.to.z());
            (is_deeper && movement.from.at[..2] == movement.to.at[..2]).then_some(*line)
        })
    }

    fn feed_lines(&self, is_meant: impl Fn(&Move) -> bool) -> impl Iterator<Item = usize> {
        self.moves
            .iter()
            .filter(move |(_, movement)| {
                let is_known = movement.from.known.and(movement.to.known) == Axes::ALL;
                let is_cut = matches!(movement.pace, Pace::Feed(_)) && movement.shape == MoveShape::Line;
                is_known && is_cut && movement.to.z() < self.surface - 0.02 && is_meant(movement)
            })
            .map(|(line, _)| *line)
    }

    /// Turns one cut into a rapid move, without affecting the following cuts.
    fn as_rapid(&self, line: usize) -> Changes {
        let feed = pattern(r"G0?1([^\d.]|$)");
        let text = &self.lines[line];
        let rapid =
            if feed.is_match(code(text)) { feed.replace(text, "G0$1").into() } else { with_word(text, "G0") };
        let mut changes = vec![(line, Some(rapid))];
        changes.extend(self.motion_after(line, "G1"));
        changes
    }

    /// If the next line with a move inherits its motion word, returns that line with `word` inserted.
    fn motion_after(&self, line: usize, word: &str) -> Option<(usize, Option<String>)> {
        let (next, _) = self.moves.iter().find(|(next, _)| *next > line)?;
        let text = &self.lines[*next];
        (!has_motion(text)).then(|| (*next, Some(with_word(text, word))))
    }

    fn with_line_before(&self, line: usize, text: &str) -> Changes {
        vec![(line, Some(format!("{text}\n{}", self.lines[line])))]
    }

    fn is_in_inches(&self) -> bool {
        self.lines.iter().any(|line| pattern(r"G20([^.\d]|$)").is_match(code(line)))
    }

    /// Removes the moves that raise the cutter between the last cut before a line and that line.
    fn without_lifts_before(&self, end: usize) -> Option<Changes> {
        let before = self.moves.iter().filter(|(line, _)| *line < end);
        let cut = before.rev().find(|(_, movement)| {
            matches!(movement.pace, Pace::Feed(_)) && movement.to.z() < self.surface - 0.02
        });
        let last = cut?.0;
        let is_lift = |line: &usize| {
            let text = code(&self.lines[*line]);
            pattern(r"Z").is_match(text) && !pattern(r"[XY]").is_match(text)
        };
        let lifts: Changes = (last + 1..end).filter(is_lift).map(|line| (line, None)).collect();
        let is_cycle = pattern(r"G8[1-9]").is_match(&self.lines[last]) || !has_motion(&self.lines[last]);
        let is_raised_by_cycle = is_cycle && self.ends_in_cycle(last);
        (!lifts.is_empty() && !is_raised_by_cycle).then_some(lifts)
    }

    /// Whether a line drills by a cycle, which raises the cutter itself.
    fn ends_in_cycle(&self, line: usize) -> bool {
        self.lines[line..].iter().take(3).any(|line| pattern(r"G80([^\d.]|$)").is_match(code(line)))
    }

    fn replaced(&self, from: &str, to: &str, most: usize) -> Option<Changes> {
        let from = pattern(from);
        let changed = self.lines.iter().enumerate().filter(|(_, line)| from.is_match(code(line)));
        let changes: Changes = changed
            .take(most)
            .map(|(index, line)| {
                let code = code(line);
                (index, Some(format!("{}{}", from.replace_all(code, to), &line[code.len()..])))
            })
            .collect();
        (!changes.is_empty()).then_some(changes)
    }

    /// Scales the last value of a letter up to and including a line.
    fn scaled(&self, letter: char, by: f64, end: usize) -> Option<Changes> {
        let scaled = |line: &String| with_value(line, letter, |value| Some((number(value) * by).to_string()));
        let lines = self.lines[..=end].iter().enumerate().rev();
        lines.into_iter().find_map(|(index, line)| Some(vec![(index, Some(scaled(line)?))]))
    }

    /// Changes X or Y of the first cut for which `change` accepts the value.
    fn in_plane(&self, change: fn(&str) -> Option<String>) -> Option<Changes> {
        self.in_axis('X', change).or_else(|| self.in_axis('Y', change))
    }

    fn in_axis(&self, axis: char, change: fn(&str) -> Option<String>) -> Option<Changes> {
        let lines = self.feed_lines(|_| true);
        lines
            .into_iter()
            .find_map(|line| Some(vec![(line, Some(with_value(&self.lines[line], axis, change)?))]))
    }

    /// Returns the first line that raises the cutter before a rapid move of more than 15 mm in the plane, with its move.
    fn lift_before_rapid(&self) -> Option<(usize, Move)> {
        let states_height = |line: &usize| pattern("Z").is_match(code(&self.lines[*line]));
        let pairs = self.moves.windows(2).filter(|pair| !states_height(&pair[1].0));
        let found = pairs.map(|pair| (pair[0], pair[1])).find(|((_, up), (_, aside))| {
            let is_up = up.pace == Pace::Rapid && up.from.z() < self.surface && up.to.z() > self.surface;
            let is_alone = up.from.at[..2] == up.to.at[..2];
            is_up
                && is_alone
                && aside.pace == Pace::Rapid
                && aside.length() > 15.0
                && aside.from.z() == aside.to.z()
        });
        found.map(|(lift, _)| lift)
    }

    fn arcs(&self) -> impl Iterator<Item = usize> {
        self.moves.iter().filter(|(_, movement)| movement.shape != MoveShape::Line).map(|(line, _)| *line)
    }

    fn with_arcs(&self) -> Option<&Self> {
        self.arcs().next().map(|_| self)
    }
}

fn plunge_at_cutting_feed(program: &Program) -> Option<Changes> {
    let feeds = program.lines.iter().filter_map(|line| {
        pattern(r"F\s*([\d.]+)").captures(code(line))?.get(1)?.as_str().parse::<f64>().ok()
    });
    let feed = feeds.reduce(f64::max)?.to_string();
    let line = program.plunges().next()?;
    let text = &program.lines[line];
    let changed = with_value(text, 'F', |_| Some(feed.clone()));
    let code = code(text);
    Some(vec![(line, Some(changed.unwrap_or_else(|| format!("{code} F{feed}{}", &text[code.len()..]))))])
}

/// Removes the line that raises the cutter before a rapid move of more than 15 mm in the plane.
fn missing_retract(program: &Program) -> Option<Changes> {
    let (line, _) = program.lift_before_rapid()?;
    let mut changes = vec![(line, None)];
    changes.extend(program.motion_after(line, "G0"));
    Some(changes)
}

/// Returns the line of the first move, if it only states the height.
fn first_lift(program: &Program) -> Option<usize> {
    let line = program.moves.first()?.0;
    let text = code(&program.lines[line]);
    (pattern("Z").is_match(text) && !pattern(r"[XYH]|G28|G53").is_match(text)).then_some(line)
}

fn no_first_lift(program: &Program) -> Option<Changes> {
    let line = first_lift(program)?;
    let (next, _) = *program.moves.iter().find(|(next, _)| *next > line)?;
    pattern(r"[XY]").captures(code(&program.lines[next]))?;
    let mut changes = vec![(line, None)];
    changes.extend(program.motion_after(line, "G0"));
    Some(changes)
}

/// Moves the height of the first move into the line of the next one, which goes to X and Y.
fn first_move_aslant(program: &Program) -> Option<Changes> {
    let line = first_lift(program)?;
    let height = pattern(r"Z\s*[-+]?[\d.]+").find(&program.lines[line])?.as_str();
    let (next, _) = *program.moves.iter().find(|(next, _)| *next > line)?;
    let text = program.motion_after(line, "G0").and_then(|(_, text)| text);
    let text = text.unwrap_or_else(|| program.lines[next].clone());
    let has_plane = pattern(r"[XY]").is_match(code(&text)) && !pattern("Z").is_match(code(&text));
    let before = code(&text).len();
    has_plane
        .then(|| vec![(line, None), (next, Some(format!("{} {height}{}", &text[..before], &text[before..])))])
}

/// Removes the motion word of a plunge that follows a rapid move.
fn lost_feed_word(program: &Program) -> Option<Changes> {
    let word = pattern(r"G0?1([^.\d]|$)");
    let mut deepest = program.surface - 0.02;
    for pair in program.moves.windows(2) {
        let ((rapid, before), (line, movement)) = (pair[0], pair[1]);
        let text = &program.lines[line];
        let is_stated_before = (rapid + 1..line).any(|line| word.is_match(code(&program.lines[line])));
        let is_plunge = before.pace == Pace::Rapid && movement.to.z() < deepest && !is_stated_before;
        if is_plunge && matches!(movement.pace, Pace::Feed(_)) && word.is_match(code(text)) {
            return Some(vec![(line, Some(word.replace(text, "$1").into()))]);
        }
        if matches!(movement.pace, Pace::Feed(_)) {
            deepest = deepest.min(movement.to.z());
        }
    }
    None
}

/// Returns the lines with a T word or, as FreeCAD writes it for GRBL, a comment with one.
fn tool_words(program: &Program) -> Vec<(usize, u32)> {
    let word = pattern(r"^[^(;]*?T\s*(\d+)|^\(\s*M6\s*T(\d+)");
    let lines = program.lines.iter().enumerate();
    lines
        .filter_map(|(index, line)| {
            let found = word.captures(line)?;
            let number = found.get(1).or(found.get(2))?.as_str().parse().ok()?;
            Some((index, number))
        })
        .collect()
}

fn another_tool(program: &Program) -> Option<Changes> {
    let (line, number) = *tool_words(program).first()?;
    let text = program.lines[line].replacen(&format!("T{number}"), "T9", 1);
    Some(vec![(line, Some(text))])
}

fn missing_tool_change(program: &Program) -> Option<Changes> {
    // Fusion's post for GRBL writes T without a stop: the change is missing in the program as posted, with a warning.
    program.replaced(r"M0?[06]([^.\d]|$)", "", 1)?;
    let words = tool_words(program);
    let first = words.first()?.1;
    let removed: Changes =
        words.into_iter().filter(|(_, number)| *number != first).map(|(line, _)| (line, None)).collect();
    (!removed.is_empty()).then_some(removed)
}

fn wrong_unit(program: &Program) -> Option<Changes> {
    let mut changes = program.replaced(r"G21([^.\d]|$)", "G20$1", 1);
    if changes.is_none() {
        changes = program.replaced(r"G20([^.\d]|$)", "G21$1", 1);
        let other = program.replaced(r"G70([^.\d]|$)", "G71$1", 1);
        changes = changes.map(|changes| changes.into_iter().chain(other.into_iter().flatten()).collect());
    }
    changes
}

fn wrong_centre(program: &Program) -> Option<Changes> {
    let negated = |value: &str| match number(value) {
        0.0 => None,
        centre => Some((-centre).to_string()),
    };
    program.arcs().find_map(|line| {
        let text = &program.lines[line];
        let changed = with_value(text, 'I', negated).or_else(|| with_value(text, 'J', negated))?;
        Some(vec![(line, Some(changed))])
    })
}

fn wrong_direction(program: &Program) -> Option<Changes> {
    let word = pattern(r"G0?([23])([^\d.]|$)");
    let line = program.arcs().find(|line| word.is_match(code(&program.lines[*line])))?;
    let other = if word.captures(code(&program.lines[line]))?[1] == *"2" { "G3$2" } else { "G2$2" };
    Some(vec![(line, Some(word.replace(&program.lines[line], other).into()))])
}

/// The findings that one kind of mistake causes in all programs.
#[derive(Default)]
struct Outcome {
    codes: BTreeMap<String, usize>,
    found: usize,
    missed: Vec<&'static str>,
}

#[test]
fn mistakes_are_found() {
    let mut outcomes: Vec<Outcome> = MISTAKES.iter().map(|_| Outcome::default()).collect();
    for known in PROGRAMS {
        let program = Program::new(known);
        let mut place = Place::new()
            .file("pathbuild.toml", known.configuration())
            .file("0.nc", program.text(Changes::new()));
        let mut files = vec![0];
        for (number, (_, mistake)) in (1..).zip(MISTAKES) {
            let Some(changes) = mistake(&program) else { continue };
            place = place.file(&format!("{number}.nc"), program.text(changes));
            files.push(number);
        }
        let names: Vec<String> = files.iter().map(|number| format!("{number}.nc")).collect();
        let found = counts(&place, &format!("{} {}", names.join(" "), known.options()));
        let before = found.get("0.nc").cloned().unwrap_or_default();
        for number in files.into_iter().skip(1) {
            let outcome = &mut outcomes[number - 1];
            let new = found.get(&format!("{number}.nc")).cloned().unwrap_or_default();
            let codes =
                new.into_iter().filter(|(code, count)| before.get(code).is_none_or(|old| old < count));
            let codes: Vec<String> = codes.map(|(code, _)| code).collect();
            if codes.is_empty() {
                outcome.missed.push(known.name);
            } else {
                outcome.found += 1;
            }
            for code in codes {
                *outcome.codes.entry(code).or_default() += 1;
            }
        }
    }
    let mut missed = String::new();
    for (([name, _], _), outcome) in
        MISTAKES.iter().zip(&outcomes).filter(|(_, outcome)| !outcome.missed.is_empty())
    {
        _ = writeln!(missed, "{name}: {}", outcome.missed.join(", "));
    }
    assert_snapshot!(missed);
    for (lang, head, of) in
        [("en", "mistake | found | codes", "of"), ("de", "Fehler | gefunden | Codes", "von")]
    {
        let mut table = format!("| {head} |\n| --- | --- | --- |\n");
        for ((names, _), outcome) in MISTAKES.iter().zip(&outcomes) {
            // A code may be an error in some dialects and a warning in others; list it once.
            let codes: BTreeSet<&str> = outcome.codes.keys().map(|code| code.trim_end_matches('!')).collect();
            let codes: Vec<&str> = codes.into_iter().collect();
            let (name, tried) = (names[usize::from(lang == "de")], outcome.found + outcome.missed.len());
            _ = writeln!(table, "| {name} | {} {of} {tried} | {} |", outcome.found, codes.join(", "));
        }
        assert_in_book(lang, &table);
    }
}

/// Compares the table in the book, or writes it.
fn assert_in_book(lang: &str, table: &str) {
    let file = project().join(format!("docs/{lang}/src/howto/any-program.md"));
    let page = fs::read_to_string(&file).unwrap();
    let (before, rest) = page.split_once("<!-- mistakes -->\n").unwrap();
    let (_, after) = rest.split_once("<!-- end -->").unwrap();
    let now = format!("{before}<!-- mistakes -->\n{table}<!-- end -->{after}");
    assert_eq!(kept(&file, now.as_bytes()), None);
}
