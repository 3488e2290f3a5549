use serde_json::{Map, Value as Json, json};

use super::kind::Key;
use super::sections::{emit, general, limits, machine, tables, warnings, watch};

/// The JSON schema (draft 2020-12) of `pathbuild.toml`.
pub fn schema() -> Json {
    let mut root = properties(general::KEYS);
    root.extend(properties(tables::KEYS));
    let sections = [
        ("emit", emit::KEYS),
        ("limits", limits::KEYS),
        ("machine", machine::KEYS),
        ("warnings", warnings::KEYS),
        ("watch", watch::KEYS),
    ];
    root.extend(sections.map(|(name, keys)| (name.to_owned(), object(&properties(keys)))));
    let mut schema = object(&root);
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!("pathbuild.toml");
    schema
}

fn object(properties: &Map<String, Json>) -> Json {
    json!({ "type": "object", "additionalProperties": false, "properties": properties })
}

fn properties(keys: &[Key]) -> Map<String, Json> {
    keys.iter().map(property).collect()
}

fn property(key: &Key) -> (String, Json) {
    let mut schema = (key.schema)();
    let meaning: Vec<&str> = key.meaning.iter().map(|line| line.trim()).collect();
    schema["description"] = json!(meaning.join(" "));
    (key.name.to_owned(), schema)
}
