//! The line types of entities. (book: language/line-types)

use smol_str::SmolStr;

use crate::encoding::Decoder;
use crate::fields::Value;
use crate::names::{folded, without_xref};
use crate::spellings::Spellings;

/// The line type where none is given.
pub(crate) const CONTINUOUS: SmolStr = SmolStr::new_static("CONTINUOUS");

/// The line type of an entity as written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LineType {
    /// That of its layer, also where none is written.
    ByLayer,
    /// That of the INSERT.
    ByBlock,
    /// Index of a name in [`LineTypes`].
    Named(u32),
}

/// Number of line types to reserve room for.
const USUAL: usize = 8;

/// The names of line types that entities use.
#[derive(Debug)]
pub(crate) struct LineTypes<'a> {
    by_spelling: Spellings<'a, LineType>,
    names: Vec<SmolStr>,
    continuous: SmolStr,
}

impl Default for LineTypes<'_> {
    fn default() -> Self {
        Self { by_spelling: Spellings::default(), names: Vec::with_capacity(USUAL), continuous: CONTINUOUS }
    }
}

impl<'a> LineTypes<'a> {
    /// The line type for this value of group 6.
    #[inline]
    pub(crate) fn get(&mut self, value: Option<Value<'a>>, decoder: &mut Decoder<'_>) -> LineType {
        let Some(value) = value else { return LineType::ByLayer };
        self.by_spelling.get(value.bytes).unwrap_or_else(|| self.first_use(value, decoder))
    }

    /// The name with this index: upper case, without xref prefix.
    pub(crate) fn name(&self, number: u32) -> &SmolStr {
        &self.names[number as usize]
    }

    /// The line type where none is given.
    pub(crate) fn continuous(&self) -> &SmolStr {
        &self.continuous
    }

    fn first_use(&mut self, value: Value<'a>, decoder: &mut Decoder<'_>) -> LineType {
        let name = line_type_name(&decoder.decode(value.bytes, value.line));
        let line_type = match &*name {
            "" | "BYLAYER" => LineType::ByLayer,
            "BYBLOCK" => LineType::ByBlock,
            _ => {
                self.names.push(name);
                LineType::Named(u32::try_from(self.names.len() - 1).unwrap_or(u32::MAX))
            }
        };
        self.by_spelling.insert(value.bytes, line_type);
        line_type
    }
}

/// A line type's name folded for comparison: trimmed, without xref prefix, upper case.
pub(crate) fn line_type_name(name: &str) -> SmolStr {
    folded(without_xref(name))
}
