//! Renders diagnostics for users: the message, its place, the faulty text underlined as in a compiler, help, notes, and the embeddings
//! that lead to the path.

use std::borrow::Cow;
use std::fmt;
use std::ops::Range;

use miette::{
    GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteError, MietteSpanContents, SourceCode,
    SourceSpan, SpanContents,
};
use pathbuild_diagnostic::{Diagnostic, Severity, TextFault, escaping};

use super::{View, view};
use pathbuild_workspace::findings::Findings;

pub(super) fn render(findings: &Findings, view: &View) -> String {
    let theme = if view.color { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
    let handler = GraphicalReportHandler::new_themed(theme)
        .with_width(view.width.unwrap_or(usize::MAX / 2))
        .with_wrap_lines(view.width.is_some())
        .with_break_words(false)
        .without_primary_span_start()
        .with_context_lines(1)
        .without_cause_chain()
        .without_syntax_highlighting();
    let mut text = String::new();
    for diagnostic in &findings.diagnostics {
        let page = Page::new(diagnostic, view);
        let mut report = String::new();
        // Rendering cannot fail: writing to a String succeeds, and labels are within their text.
        _ = handler.render_report(&mut report, &page);
        text.extend(report.split_inclusive('\n').map(|line| with_translated_label(line, view)));
        for line in &page.further {
            text.push_str("  ");
            text.push_str(line);
            text.push('\n');
        }
        text.push('\n');
    }
    text
}

/// Translates the label that miette puts in front of the help.
fn with_translated_label<'a>(line: &'a str, view: &View) -> Cow<'a, str> {
    let is_help = line.strip_prefix(HELP_COLOR).unwrap_or(line).starts_with(HELP);
    if is_help { line.replacen(HELP, view.choose(HELP, "  Tipp: "), 1).into() } else { line.into() }
}

const HELP: &str = "  help: ";
const HELP_COLOR: &str = "\u{1b}[36m";

/// A diagnostic in the form that miette renders. Code and place are in the header, because most faults have no text to underline.
#[derive(Debug)]
struct Page {
    header: String,
    message: String,
    severity: Severity,
    help: Option<String>,
    source: Option<Source>,
    label: Option<LabeledSpan>,
    further: Vec<String>,
}

impl Page {
    fn new(diagnostic: &Diagnostic, view: &View) -> Self {
        let source = diagnostic.text.as_ref().map(excerpt);
        Self {
            header: header(diagnostic, view),
            message: diagnostic.text(view.lang),
            severity: diagnostic.severity,
            help: diagnostic.help(view.lang),
            label: source.as_ref().map(|(_, span)| LabeledSpan::underline(span.clone())),
            source: source.map(|(text, _)| Source::new(text, diagnostic)),
            further: notes_and_trace(diagnostic, view),
        }
    }
}

/// Returns the part of a faulty text that is shown, and the range of the fault in it. Very long texts (such as pasted files) are cut
/// around the fault.
fn excerpt(fault: &TextFault) -> (String, Range<usize>) {
    let (text, span) = (&*fault.text, fault.span());
    let start =
        if span.start <= EXCERPT_BYTES { 0 } else { text.floor_char_boundary(span.start - EXCERPT_BYTES) };
    let last = span.end.min(span.start + EXCERPT_BYTES);
    let end = if text.len() - last <= EXCERPT_BYTES {
        text.len()
    } else {
        text.ceil_char_boundary(last + EXCERPT_BYTES)
    };
    let (before, after) = (if start > 0 { "…" } else { "" }, if end < text.len() { "…" } else { "" });
    let fault = span.start.clamp(start, end)..span.end.clamp(start, end);
    let mut excerpt = format!("{before}{}", escaping::framed(&text[start..fault.start]));
    let from = excerpt.len();
    excerpt.push_str(&escaping::framed(&text[fault.clone()]));
    let to = excerpt.len();
    excerpt.extend([&*escaping::framed(&text[fault.end..end]), after]);
    (excerpt, from..to)
}

/// Maximum number of bytes shown before, within and after a fault.
const EXCERPT_BYTES: usize = 400;

fn header(diagnostic: &Diagnostic, view: &View) -> String {
    let severity = diagnostic.severity.word(view.lang);
    let mut header = format!("{severity}[{}] {}", diagnostic.code(), diagnostic.code().name());
    let element = view::element(diagnostic, view);
    for part in view::location(diagnostic, view).into_iter().chain((!element.is_empty()).then_some(element)) {
        header.push_str(" · ");
        header.push_str(&part);
    }
    header
}

/// Returns the notes, followed by the embeddings of the path, innermost first.
fn notes_and_trace(diagnostic: &Diagnostic, view: &View) -> Vec<String> {
    let note = view.choose("note", "Hinweis");
    let notes = diagnostic.notes.iter().map(|remark| format!("{note}: {}", remark.text(view.lang)));
    let trace = diagnostic.trace.iter().rev().map(|step| view::embedding(step, view));
    notes.chain(trace).collect()
}

impl fmt::Display for Page {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Page {}

impl miette::Diagnostic for Page {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        Some(Box::new(&self.header))
    }

    fn severity(&self) -> Option<miette::Severity> {
        Some(match self.severity {
            Severity::Error => miette::Severity::Error,
            Severity::Warning => miette::Severity::Warning,
        })
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.as_ref().map(|source| source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.label
            .clone()
            .map(|label| Box::new(std::iter::once(label)) as Box<dyn Iterator<Item = LabeledSpan>>)
    }
}

/// A faulty text in the form that miette renders. A line of a text file keeps its number; texts in drawings are numbered from 1.
#[derive(Debug)]
struct Source {
    text: String,
    lines_before: usize,
}

impl Source {
    fn new(text: String, diagnostic: &Diagnostic) -> Self {
        let is_line_of_file = diagnostic.place.column.is_some();
        let line = diagnostic.place.line.filter(|_| is_line_of_file).unwrap_or(1);
        Self { text, lines_before: line.saturating_sub(1) as usize }
    }
}

impl SourceCode for Source {
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        lines_before: usize,
        lines_after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let contents = self.text.read_span(span, lines_before, lines_after)?;
        Ok(Box::new(MietteSpanContents::new(
            contents.data(),
            *contents.span(),
            contents.line() + self.lines_before,
            contents.column(),
            contents.line_count(),
        )))
    }
}
