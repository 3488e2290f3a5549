//! The line types of entities. (book: language/line-types)

use smol_str::SmolStr;

use crate::encoding::Decoder;
use crate::fields::Value;
use crate::names::{folded, without_xref};
use crate::spellings::Spellings;

/// What is taken where nothing is said.
pub(crate) const CONTINUOUS: SmolStr = SmolStr::new_static("CONTINUOUS");

/// What an entity says about its line type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum LineType {
    /// That of its layer, which it also has when it says nothing.
    ByLayer,
    /// That of the INSERT it comes with.
    ByBlock,
    /// The name of this number in [`LineTypes`].
    Named(u32),
}

/// How many line types the entities of a drawing usually have at most.
const USUAL: usize = 8;

/// The names of line types found on entities.
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
    /// The line type of an entity with this group 6.
    #[inline]
    pub(crate) fn get(&mut self, value: Option<Value<'a>>, decoder: &mut Decoder<'_>) -> LineType {
        let Some(value) = value else { return LineType::ByLayer };
        self.by_spelling.get(value.bytes).unwrap_or_else(|| self.first_use(value, decoder))
    }

    /// The name of this number: upper case, without xref prefix.
    pub(crate) fn name(&self, number: u32) -> &SmolStr {
        &self.names[number as usize]
    }

    /// What is taken where nothing is said.
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

/// A line type's name as it is compared: trimmed, without xref prefix, upper case.
pub(crate) fn line_type_name(name: &str) -> SmolStr {
    folded(without_xref(name))
}
