use std::fmt;

/// Source of a setting's value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Origin {
    /// The built-in default: nothing sets the value.
    Default,
    /// A line of the configuration, counted from 1.
    File(u32),
    /// The command-line option of this name, without hyphens.
    CommandLine(&'static str),
}

/// A value with its source.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct SourcedValue<T> {
    /// The value.
    pub value: T,
    /// What set the value.
    pub origin: Origin,
}

impl<T> SourcedValue<T> {
    /// A default value.
    pub fn default(value: T) -> Self {
        Self { value, origin: Origin::Default }
    }

    /// The value of a command-line option.
    pub fn option(name: &'static str, value: T) -> Self {
        Self { value, origin: Origin::CommandLine(name) }
    }
}

impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Default => f.write_str("default"),
            Self::File(line) => write!(f, "line {line}"),
            Self::CommandLine(name) => write!(f, "--{name}"),
        }
    }
}
