//! Plans the content of a Q-project.

use super::{Component, values};
use crate::approx::near;
use crate::letter::Letter;
use crate::path::Path;
use crate::raw::RawPath;
use crate::read::ProxyLine;

/// A planned path of a Q-project, for everything milled with one cutter.
#[derive(Clone, Debug, PartialEq)]
pub struct QProject {
    /// T, O and M of the path: T is the maximum of the embedded paths.
    pub parameters: String,
    /// Its segments, in the order of the drawing's paths.
    pub lines: Vec<QProjectLine>,
}

/// A planned subpath segment.
#[derive(Clone, Debug, PartialEq)]
pub struct QProjectLine {
    /// Its length in mm.
    pub length: f64,
    /// Its text.
    pub text: String,
}

/// Plans the Q-project of a component: one path for each O, in order of first appearance. Each embedded path uses the values of its first
/// proxy line, or its own. Paths with errors are left out.
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

/// The path that embeds these paths, all of which have the same O.
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

/// The text of a proxy line, completed by the values it leaves open.
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
