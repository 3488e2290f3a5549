//! The posts included in pathbuild, in both definition languages: ready for use, and templates for one's own. (crates/pathbuild-post/posts)

use camino::Utf8Path;
use pathbuild_diagnostic::{Diagnostic, messages::posts, nearest};

use super::definition::Post;
use crate::Language;

/// A post included in pathbuild.
#[derive(Clone, Copy, Debug)]
pub struct BuiltIn {
    /// Name on the command line.
    pub name: &'static str,
    /// Language of the definition.
    pub language: Language,
    /// One line saying which machines it is for.
    pub description: &'static str,
    /// Text of the definition, or for the native program a description of it.
    pub text: &'static str,
}

/// All posts included in pathbuild, in listing order.
pub static BUILT_IN: &[BuiltIn] = &[
    BuiltIn {
        name: "native",
        language: Language::Native,
        description: "What pathbuild writes by default, with Z correction and statistics",
        text: NATIVE,
    },
    cambam("grbl", "GRBL 1.1", include_str!("../posts/grbl.cbpp")),
    cambam("linuxcnc", "LinuxCNC, mill", include_str!("../posts/linuxcnc.cbpp")),
    cambam("mach3", "Mach3 and Mach4, mill", include_str!("../posts/mach3.cbpp")),
    cambam("fanuc", "Fanuc and controls like it, mill", include_str!("../posts/fanuc.cbpp")),
    cambam("haas", "Haas mills", include_str!("../posts/haas.cbpp")),
    cambam("marlin", "Marlin 2 on a mill", include_str!("../posts/marlin.cbpp")),
    cambam("estlcam", "Estlcam CNC controller", include_str!("../posts/estlcam.cbpp")),
    BuiltIn {
        name: "din",
        language: Language::Cad6,
        description: "DIN 66025, as in the manual of CAD6",
        text: include_str!("../posts/din.toml"),
    },
    BuiltIn {
        name: "xpertmill",
        language: Language::Cad6,
        description: "XpertMILL (STEP-FOUR) import filter",
        text: include_str!("../posts/xpertmill.toml"),
    },
];

const NATIVE: &str = "\
The native program has no definition: it is what pathbuild writes without a post. A hole runs at the feed that was last set, heights
may have correction formulas, and the statistics stand at the end; the languages of definitions cannot say that. To change the words
of a program, begin with a copy of another post, such as `pathbuild post show linuxcnc`.
";

const fn cambam(name: &'static str, description: &'static str, text: &'static str) -> BuiltIn {
    BuiltIn { name, language: Language::CamBam, description, text }
}

/// Loads the built-in post with this name. The native program does not count: it is not written through a post.
///
/// # Errors
/// Fails if no built-in post has this name.
pub fn load(name: &str) -> Result<Post, Vec<Diagnostic>> {
    let definitions = || BUILT_IN.iter().filter(|post| post.language != Language::Native);
    let Some(post) = definitions().find(|post| post.name == name) else {
        let diagnostic = match nearest(name, definitions().map(|post| post.name)) {
            Some(nearest) => Diagnostic::new(&posts::POST_UNKNOWN_NEAREST).quoting("nearest", nearest),
            None => Diagnostic::new(&posts::POST_UNKNOWN),
        };
        return Err(vec![diagnostic.quoting("name", name)]);
    };
    let file = format!("{name}.{}", post.language.extension());
    Post::read(post.text.as_bytes(), Utf8Path::new(&file))
}
