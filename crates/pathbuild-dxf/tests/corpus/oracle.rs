//! The results of ezdxf. Their columns are described in the README of the corpus.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;

use serde_json::Value;

use crate::seen::{Seen, SeenLayers};

/// The result of ezdxf for a file.
pub(crate) struct Expected {
    pub(crate) file: String,
    /// Whether ezdxf read the file without failing or repairing it.
    pub(crate) is_strict: bool,
    pub(crate) layers: SeenLayers,
    pub(crate) entities: Vec<Seen>,
}

pub(crate) fn expected(corpus: &Path) -> Vec<Expected> {
    let packed = std::fs::read(corpus.join("ezdxf.jsonl.gz")).expect("the oracle");
    let mut lines = String::new();
    flate2::read::GzDecoder::new(&*packed).read_to_string(&mut lines).expect("JSON lines");
    lines.lines().map(|line| parse(serde_json::from_str(line).expect("JSON"))).collect()
}

fn parse(mut line: Value) -> Expected {
    let mut take = |key: &str| line.get_mut(key).map(Value::take).unwrap_or_default();
    let layers: BTreeMap<String, (String, i64, i64)> =
        serde_json::from_value(take("layers")).unwrap_or_default();
    let entities: Vec<Vec<Value>> = serde_json::from_value(take("entities")).unwrap_or_default();
    let line_types =
        layers.iter().map(|(name, (line_type, ..))| (name.to_uppercase(), line_type.to_uppercase()));
    let line_types: BTreeMap<String, String> = line_types.collect();
    Expected {
        file: take("file").as_str().unwrap_or_default().to_owned(),
        is_strict: take("how") == "strict",
        layers: layers
            .iter()
            .map(|(name, (_, flags, colour))| (name.to_uppercase(), flags & 1 != 0 || *colour < 0))
            .collect(),
        entities: entities.iter().map(|columns| Columns(columns).seen(&line_types)).collect(),
    }
}

struct Columns<'a>(&'a [Value]);

impl Columns<'_> {
    fn text(&self, column: usize) -> String {
        self.0[column].as_str().unwrap_or_default().to_owned()
    }

    fn number(&self, column: usize) -> f64 {
        self.0[column].as_f64().unwrap_or_default()
    }

    fn numbers(&self, columns: std::ops::Range<usize>) -> Vec<f64> {
        columns.map(|column| self.number(column)).collect()
    }

    fn is_mirrored(&self, column: usize) -> bool {
        self.number(column) < 0.0
    }

    fn seen(&self, line_types: &BTreeMap<String, String>) -> Seen {
        let kind = self.text(0);
        let layer = unescaped(&self.text(1)).to_uppercase();
        let line_type =
            match (self.text(2).to_uppercase().as_str(), line_types.get(&layer).map_or("", String::as_str)) {
                ("" | "BYLAYER", "") | ("BYBLOCK", _) => "CONTINUOUS".to_owned(),
                ("" | "BYLAYER", of_layer) => of_layer.to_owned(),
                (own, _) => own.to_owned(),
            };
        let (texts, numbers) = match kind.as_str() {
            "LINE" => (vec![], self.numbers(4..10)),
            "CIRCLE" => (vec![], self.circle()),
            "ARC" => (vec![], self.arc()),
            "TEXT" => (vec![unescaped(&self.text(4))], self.one_line()),
            _ => {
                let plain = unescaped(&self.text(5)).replace("\\~", "\u{a0}");
                let mut numbers = self.numbers(6..11);
                // ezdxf has the nominal height, which is not that of the letters.
                if self.text(4).contains("\\H") {
                    numbers[3] = f64::NAN;
                }
                (vec![plain], numbers)
            }
        };
        Seen { kind, layer, line_type, handle: self.text(3), texts, numbers }
    }

    fn circle(&self) -> Vec<f64> {
        let [x, y, z, radius] = [4, 5, 6, 7].map(|column| self.number(column));
        if self.is_mirrored(8) { vec![-x, y, -z, radius] } else { vec![x, y, z, radius] }
    }

    fn arc(&self) -> Vec<f64> {
        let [x, y, z, radius, start, end] = [4, 5, 6, 7, 8, 9].map(|column| self.number(column));
        if self.is_mirrored(10) {
            vec![-x, y, -z, radius, 180.0 - start, 180.0 - end, 1.0]
        } else {
            vec![x, y, z, radius, start, end, 0.0]
        }
    }

    /// Returns anchor, height, rotation, alignment and mirroring of a text.
    fn one_line(&self) -> Vec<f64> {
        let [horizontal, vertical] = [9, 10].map(|column| self.number(column));
        let [x, y] = match horizontal {
            3.0 | 5.0 => [5, 6].map(|column| f64::midpoint(self.number(column), self.number(column + 2))),
            0.0 if vertical == 0.0 => [5, 6].map(|column| self.number(column)),
            _ => [7, 8].map(|column| self.number(column)),
        };
        let [height, rotation] = [11, 12].map(|column| self.number(column));
        let backwards = f64::from(u8::from(
            self.0[13].as_i64().is_some_and(|flags| flags & 2 != 0) != self.is_mirrored(14),
        ));
        let [x, rotation] = if self.is_mirrored(14) { [-x, -rotation] } else { [x, rotation] };
        let horizontal = if matches!(horizontal, 3.0..=5.0) { 1.0 } else { horizontal };
        let vertical = if self.number(9) == 4.0 { 2.0 } else { vertical };
        vec![x, y, height, rotation.rem_euclid(360.0), horizontal, vertical, backwards]
    }
}

/// Decodes `\U+XXXX`, which ezdxf leaves unchanged in files that it considers UTF-8.
fn unescaped(text: &str) -> String {
    let mut pieces = text.split("\\U+");
    let mut decoded = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let (digits, rest) = piece.split_at(4);
        let number = u32::from_str_radix(digits, 16).expect("four digits");
        decoded.push(char::from_u32(number).expect("a character"));
        decoded.push_str(rest);
    }
    decoded
}
