//! Changes in words.

use pathbuild_diagnostic::{Lang, Number};

use super::{ChangeKind, Group};

/// The change of a group of moves, for example "0.5 mm deeper, feed 150 instead of 300".
pub fn phrase(group: &Group, lang: Lang) -> String {
    match lang {
        Lang::En => english(group.kind),
        Lang::De => german(group.kind),
    }
}

/// The number of moves in a group, for example `12 moves`.
pub fn moves(group: &Group, lang: Lang) -> String {
    let word = match (group.moves, lang) {
        (1, Lang::En) => "move",
        (_, Lang::En) => "moves",
        (1, Lang::De) => "Bewegung",
        (_, Lang::De) => "Bewegungen",
    };
    format!("{} {word}", group.moves)
}

fn english(kind: Option<ChangeKind>) -> String {
    match kind {
        None => "other rapid moves".into(),
        Some(ChangeKind::Added) => "added".into(),
        Some(ChangeKind::Removed) => "removed".into(),
        Some(ChangeKind::Reordered) => "the same in the end, in another order or by other passes".into(),
        Some(ChangeKind::Shifted([x, y])) => format!("shifted by ({}, {}) mm", Number(x), Number(y)),
        Some(ChangeKind::Altered { raised, feed, passes }) => {
            let height = (raised != 0.0).then(|| {
                let way = if raised < 0.0 { "deeper" } else { "higher" };
                format!("{} mm {way}", Number(raised.abs()))
            });
            let feed = feed.map(|[was, is]| {
                let way = if is > was { "faster" } else { "slower" };
                format!("{way}: F{} instead of F{}", Number(is), Number(was))
            });
            let passes = passes.map(|[was, is]| format!("passes: {is} instead of {was}"));
            height.into_iter().chain(feed).chain(passes).collect::<Vec<_>>().join(", ")
        }
    }
}

fn german(kind: Option<ChangeKind>) -> String {
    match kind {
        None => "andere Eilgänge".into(),
        Some(ChangeKind::Added) => "dazugekommen".into(),
        Some(ChangeKind::Removed) => "weggefallen".into(),
        Some(ChangeKind::Reordered) => {
            "am Ende dasselbe, in anderer Reihenfolge oder anderen Durchgängen".into()
        }
        Some(ChangeKind::Shifted([x, y])) => format!("um ({}, {}) mm verschoben", Number(x), Number(y)),
        Some(ChangeKind::Altered { raised, feed, passes }) => {
            let height = (raised != 0.0).then(|| {
                let way = if raised < 0.0 { "tiefer" } else { "höher" };
                format!("{} mm {way}", Number(raised.abs()).prose(Lang::De))
            });
            let feed = feed.map(|[was, is]| {
                let way = if is > was { "schneller" } else { "langsamer" };
                format!("{way}: F{} statt F{}", Number(is), Number(was))
            });
            let passes = passes.map(|[was, is]| format!("Durchgänge: {is} statt {was}"));
            height.into_iter().chain(feed).chain(passes).collect::<Vec<_>>().join(", ")
        }
    }
}
