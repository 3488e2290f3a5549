use crate::{Code, Lang};

/// The page that `pathbuild explain` prints for a code, as Markdown: what it means, usual causes, how to mend it in the drawing.
/// `None` for a code that has no page.
pub fn page(_code: Code, _lang: Lang) -> Option<&'static str> {
    None
}
