//! Describes changes of moves in words. (book: program/comparing)

use pathbuild_diagnostic::{Lang, Number, counted};

use super::{ChangeKind, Group};

/// Describes the change of a group of moves, for example "0.5 mm deeper, slower: F150 instead of F300".
pub fn phrase(group: &Group, lang: Lang) -> String {
    let choose = |en, de| lang.choose(en, de);
    match group.kind {
        None => choose("other rapid moves", "andere Eilgänge").into(),
        Some(ChangeKind::Added) => choose("added", "dazugekommen").into(),
        Some(ChangeKind::Removed) => choose("removed", "weggefallen").into(),
        Some(ChangeKind::Reordered) => choose(
            "the same in the end, in another order or by other passes",
            "am Ende dasselbe, in anderer Reihenfolge oder anderen Durchgängen",
        )
        .into(),
        Some(ChangeKind::Shifted([x, y])) => {
            let by = format!("({}, {}) mm", Number(x), Number(y));
            choose("shifted by {}", "um {} verschoben").replace("{}", &by)
        }
        Some(ChangeKind::Altered { raised, feed, passes }) => {
            let height = |raised: f64| {
                let way = if raised < 0.0 { choose("deeper", "tiefer") } else { choose("higher", "höher") };
                format!("{} mm {way}", Number(raised.abs()).prose(lang))
            };
            let [least, most] = raised;
            let heights = if least == most { vec![least] } else { vec![least.min(0.0), most.max(0.0)] };
            let up_to = if least == most { "" } else { choose("up to ", "bis zu ") };
            let heights = heights.into_iter().filter(|raised| *raised != 0.0);
            let heights = heights.map(|raised| format!("{up_to}{}", height(raised)));
            let instead = choose("instead of", "statt");
            let feed = feed.map(|[was, is]| {
                let way =
                    if is > was { choose("faster", "schneller") } else { choose("slower", "langsamer") };
                format!("{way}: F{} {instead} F{}", Number(is), Number(was))
            });
            let passes =
                passes.map(|[was, is]| format!("{}: {is} {instead} {was}", choose("passes", "Durchgänge")));
            heights.chain(feed).chain(passes).collect::<Vec<_>>().join(", ")
        }
    }
}

/// Describes the number of moves in a group, for example `12 moves`.
pub fn moves(group: &Group, lang: Lang) -> String {
    counted(group.moves, [["move", "moves"], ["Bewegung", "Bewegungen"]], lang)
}
