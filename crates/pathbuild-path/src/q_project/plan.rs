//! What a Q-project is to embed.

use super::{Component, values};
use crate::approx::near;
use crate::letter::Letter;
use crate::path::Path;
use crate::raw::RawPath;
use crate::read::ProxyLine;

/// A path of a Q-project that is to be drawn: all that is milled with one cutter.
#[derive(Clone, Debug, PartialEq)]
pub struct QProject {
    /// T, O and M of its path: the greatest T of what it embeds.
    pub parameters: String,
    /// What it embeds, in the order of the drawing's paths.
    pub lines: Vec<QProjectLine>,
}

/// A subpath segment that is to be drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct QProjectLine {
    /// From its start to its end, in mm.
    pub length: f64,
    /// Its text.
    pub text: String,
}

/// The Q-project of a component: a path for each O, in the order in which they first appear, each embedded path as its first proxy line
/// says, else with its own values. Paths with errors are left out.
pub fn plan_q_project(component: &Component<'_>) -> Vec<QProject> {
    let mut by_cutter: Vec<Vec<(Path, QProjectLine)>> = Vec::new();
    for planned in component.paths.iter().filter_map(|raw| line(component, raw)) {
        let is_same = |group: &&mut Vec<(Path, QProjectLine)>| near(group[0].0.tool, planned.0.tool);
        match by_cutter.iter_mut().find(is_same) {
            Some(group) => group.push(planned),
            None => by_cutter.push(vec![planned]),
        }
    }
    by_cutter.into_iter().map(of_cutter).collect()
}

/// The path that embeds these, which have the same O.
fn of_cutter(planned: Vec<(Path, QProjectLine)>) -> QProject {
    let first = &planned[0].0;
    let thickness = planned.iter().map(|(path, _)| path.thickness).fold(first.thickness, f64::max);
    let material = first.material.as_ref().map(|material| format!(" M{material}")).unwrap_or_default();
    let parameters = format!("T{thickness} O{}{material}", first.tool);
    QProject { parameters, lines: planned.into_iter().map(|(_, line)| line).collect() }
}

fn line(component: &Component<'_>, raw: &RawPath) -> Option<(Path, QProjectLine)> {
    let proxy = component.proxies(&raw.name).first().copied();
    let path = component.path(raw, proxy)?;
    let line = QProjectLine { length: (path.end - path.start).norm(), text: text(raw, &path, proxy) };
    Some((path, line))
}

/// The text of a proxy line, and what it leaves open.
fn text(raw: &RawPath, path: &Path, proxy: Option<&ProxyLine>) -> String {
    let mut pieces = vec![format!(">{}", path.name)];
    if let Some(proxy) = proxy {
        let others = proxy.text().pieces().iter();
        let others = others.filter_map(|piece| Some((piece.letter?, proxy.text().value(piece))));
        let others = others.filter(|(letter, value)| {
            !matches!(letter, Letter::Embed | Letter::Variable) && !value.contains('=')
        });
        pieces.extend(others.map(|(letter, value)| format!("{}{value}", letter.as_char())));
    }
    let is_open = |letter| proxy.is_none_or(|proxy| proxy.value(letter).is_none());
    let own = [
        path.material.as_ref().map(|material| (Letter::M, material.to_string())),
        Some((Letter::T, path.thickness.to_string())),
        Some((Letter::O, path.tool.to_string())),
    ];
    let own = own.into_iter().flatten().filter(|(letter, _)| is_open(*letter));
    pieces.extend(own.map(|(letter, value)| format!("{}{value}", letter.as_char())));
    pieces.extend(values(raw, proxy).iter().map(|(variable, value)| format!(":{variable}{value}")));
    pieces.join(" ")
}
