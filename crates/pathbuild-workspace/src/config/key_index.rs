//! Finds the table that a misplaced key belongs to. (PB003; book: reference/configuration)

use pathbuild_diagnostic::nearest;
use serde_json::{Map, Value as Json};

use super::schema::schema;

/// All tables of `pathbuild.toml` with their keys, taken from the schema.
#[derive(Debug)]
pub(super) struct KeyIndex {
    tables: Vec<Table>,
}

#[derive(Debug)]
struct Table {
    /// Header as written in the file, such as `[machine]` or `[tool.NAME]`; `None` for the keys before all tables.
    header: Option<String>,
    keys: Vec<String>,
}

/// A known key and its table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct KeyPlace<'a> {
    /// Header of its table; `None` for the keys before all tables.
    pub(super) header: Option<&'a str>,
    /// Name of the key.
    pub(super) key: &'a str,
    /// Whether the name is spelled exactly like the one that was searched for.
    pub(super) is_exact: bool,
}

impl KeyIndex {
    pub(super) fn new() -> Self {
        let schema = schema();
        let none = Map::new();
        let root = properties(&schema).unwrap_or(&none);
        let mut tables = vec![Table::new(None, root)];
        for (name, value) in root {
            let headers = [
                (format!("[{name}]"), properties(value)),
                (format!("[{name}.NAME]"), properties(&value["additionalProperties"])),
                (format!("[{name}]"), properties(&value["oneOf"][1])),
                (format!("[[{name}]]"), properties(&value["items"])),
            ];
            let known_tables =
                headers.into_iter().filter_map(|(header, keys)| Some(Table::new(Some(header), keys?)));
            tables.extend(known_tables);
        }
        Self { tables }
    }

    /// Finds the table of a key that its own table does not know: by this name, or else by a similar one.
    pub(super) fn find(&self, name: &str) -> Option<KeyPlace<'_>> {
        let exact = self.keys().find(|home| home.key == name);
        exact.or_else(|| {
            let near = nearest(name, self.keys().map(|home| home.key)).filter(|_| name.len() >= SHORTEST)?;
            let home = self.keys().find(|home| home.key == near)?;
            Some(KeyPlace { is_exact: false, ..home })
        })
    }

    fn keys(&self) -> impl Iterator<Item = KeyPlace<'_>> {
        self.tables.iter().flat_map(|table| {
            let header = table.header.as_deref();
            table.keys.iter().map(move |key| KeyPlace { header, key, is_exact: true })
        })
    }
}

/// Minimum length of a name for which similar names in other tables are suggested: shorter names resemble too many others.
const SHORTEST: usize = 5;

impl Table {
    fn new(header: Option<String>, keys: &Map<String, Json>) -> Self {
        Self { header, keys: keys.keys().cloned().collect() }
    }
}

fn properties(table: &Json) -> Option<&Map<String, Json>> {
    table["properties"].as_object()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_table_has_its_keys() {
        let key_index = KeyIndex::new();
        for (key, header) in [
            ("library", None),
            ("travel", Some("[machine]")),
            ("targets", Some("[emit]")),
            ("coolant", Some("[tool.NAME]")),
            ("unchecked", Some("[post]")),
            ("files", Some("[[severity-in]]")),
        ] {
            assert_eq!(key_index.find(key), Some(KeyPlace { header, key, is_exact: true }));
        }
    }

    #[test]
    fn nearly_right_names_of_five_letters_are_found() {
        let key_index = KeyIndex::new();
        let near = KeyPlace { header: Some("[machine]"), key: "rates", is_exact: false };
        assert_eq!(key_index.find("ratse"), Some(near));
        assert_eq!(key_index.find("rate"), None);
        assert_eq!(key_index.find("colour-of-the-bit"), None);
    }
}
