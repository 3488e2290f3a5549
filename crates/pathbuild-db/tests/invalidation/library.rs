//! A model of a library: its files, their paths, the embeddings, and the expected result for each path.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Library {
    pub(crate) files: BTreeMap<String, Drawing>,
}

/// A drawing with one path.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Drawing {
    /// Number of the path.
    pub(crate) path: usize,
    /// The parameter B in tenths of a millimetre.
    pub(crate) bottom: u32,
    pub(crate) embeds: Vec<usize>,
    pub(crate) remarks: u32,
}

/// The result for a path according to the specification.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Prediction {
    /// The values of B of a valid path and of everything that it embeds, in tenths of a millimetre and in the order of milling.
    Milled(Vec<u32>),
    /// The codes of the path's errors.
    Wrong(BTreeSet<&'static str>),
}

/// The directories in which paths are searched for: the drawings' own, and a search directory.
pub(crate) const DIRECTORIES: [&str; 2] = ["lib", "parts"];

pub(crate) fn name(path: usize) -> String {
    format!("{}.1P", 1001 + path)
}

pub(crate) fn file_name(directory: &str, path: usize, note: &str) -> String {
    format!("{directory}/{}{note}.dxf", 1001 + path)
}

impl Library {
    /// Creates a library of three components, and three levels of projects that embed them.
    pub(crate) fn new() -> Self {
        let embeds: [&[usize]; 6] = [&[], &[], &[], &[0, 1], &[1, 2, 3], &[4]];
        let drawing = |(path, embeds): (usize, &&[usize])| Drawing {
            path,
            bottom: 0,
            embeds: embeds.to_vec(),
            remarks: 0,
        };
        let files = embeds.iter().enumerate().map(drawing);
        Self { files: files.map(|drawing| (file_name("lib", drawing.path, ""), drawing)).collect() }
    }

    pub(crate) fn predict(&self, file: &str) -> Prediction {
        let (mut depths, mut wrong) = (Vec::new(), BTreeSet::new());
        self.follow(file, &mut Vec::new(), &mut depths, &mut wrong);
        if wrong.is_empty() { Prediction::Milled(depths) } else { Prediction::Wrong(wrong) }
    }

    fn follow<'a>(
        &'a self,
        file: &'a str,
        open: &mut Vec<&'a str>,
        depths: &mut Vec<u32>,
        wrong: &mut BTreeSet<&'static str>,
    ) {
        let drawing = &self.files[file];
        depths.push(drawing.bottom);
        open.push(file);
        for embedded in &drawing.embeds {
            match self.definitions(file, *embedded).as_slice() {
                [] => _ = wrong.insert("PB503"),
                [found] if open.contains(found) => _ = wrong.insert("PB509"),
                [found] => self.follow(found, open, depths, wrong),
                _ => _ = wrong.insert("PB504"),
            }
        }
        open.pop();
    }

    /// Returns the files that define a path, as seen from a file: those in the directories that may define it according to their names, and that file
    /// itself, whatever its name.
    fn definitions<'a>(&'a self, from: &'a str, path: usize) -> Vec<&'a str> {
        let own = directory(from);
        let is_searched = |file: &str| {
            (directory(file) == own || directory(file) == DIRECTORIES[1])
                && file[directory(file).len() + 1..].starts_with(&(1001 + path).to_string())
        };
        let defining = self.files.iter().filter(|(_, drawing)| drawing.path == path);
        defining.map(|(file, _)| file.as_str()).filter(|file| *file == from || is_searched(file)).collect()
    }

    /// Returns everything that could affect the path of a file: the drawings that it reaches, without remarks.
    pub(crate) fn reach(&self, file: &str) -> BTreeMap<&str, (u32, &[usize])> {
        let (mut reached, mut open) = (BTreeMap::new(), vec![file]);
        while let Some(next) = open.pop() {
            let Some((next, drawing)) = self.files.get_key_value(next) else { continue };
            if reached.insert(next.as_str(), (drawing.bottom, drawing.embeds.as_slice())).is_none() {
                open.extend(drawing.embeds.iter().flat_map(|embedded| self.definitions(next, *embedded)));
            }
        }
        reached
    }
}

fn directory(file: &str) -> &str {
    file.split('/').next().unwrap_or_default()
}

impl Drawing {
    /// Returns the text form: a milled line from the start to the end, then from there up to each embedded path, along it and back.
    pub(crate) fn text(&self) -> String {
        let remark = "layer REMARKS\ntext 0,-50 \"a remark\"\n".repeat(self.remarks as usize);
        let depth = f64::from(self.bottom) / 10.0;
        let mut text = format!(
            "{remark}layer {}\nstart 0,0 \"T5 O3 I1 Mx\"\nmill 0,0 20,0 \"B{depth}\"\nend 20,0\n",
            name(self.path)
        );
        for (row, embedded) in (1..).zip(&self.embeds) {
            let y = 10 * row;
            let name = name(*embedded);
            _ = writeln!(text, "sweep 20,0 20,{y}\nsubpath 20,{y} 0,{y} \">{name}\"\nsweep 0,{y} 20,0");
        }
        text
    }
}
